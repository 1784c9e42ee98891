use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Number;

/// Coefficients of a Taylor polynomial: value, slope, half the second derivative, and so on.
///
/// Five of them are enough for the third derivative of a function given by its integral, four for the
/// jerk of a linkage, two for a sensitivity, one for a position. They are numbers, or several side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<const ORDERS: usize = 5, T = f64>(pub [T; ORDERS]);

impl<const ORDERS: usize, T: Number> Taylor<ORDERS, T> {
    /// The series of a constant.
    #[inline(always)]
    pub fn constant(value: T) -> Self {
        let mut c = [T::from(0.0); ORDERS];
        c[0] = value;
        Self(c)
    }

    /// The series of the variable at a value: slope one.
    #[inline(always)]
    pub fn variable(value: T) -> Self {
        let mut series = Self::constant(value);
        if let Some(slope) = series.0.get_mut(1) {
            *slope = T::from(1.0);
        }
        series
    }

    /// Value and first three derivatives.
    #[inline(always)]
    pub fn derivatives(&self) -> [T; 4] {
        let known = |k: usize| self.0.get(k).copied().unwrap_or(T::from(0.0));
        [
            known(0),
            known(1),
            known(2) * T::from(2.0),
            known(3) * T::from(6.0),
        ]
    }

    /// Pair of series with `s' = a' c` and `c' = sign a' s`.
    #[inline(always)]
    fn circular(self, (s0, c0): (T, T), sign: f64) -> (Self, Self) {
        let (mut s, mut c) = (Self::constant(s0), Self::constant(c0));
        for k in 1..ORDERS {
            for i in 1..=k {
                let slope = self.0[i] * T::from(i as f64 / k as f64);
                s.0[k] = s.0[k] + slope * c.0[k - i];
                c.0[k] = c.0[k] + slope * s.0[k - i] * T::from(sign);
            }
        }
        (s, c)
    }

    /// Sine and cosine.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        self.circular(self.0[0].sin_cos(), -1.0)
    }

    /// Sine and cosine, from their known values.
    #[inline(always)]
    pub(crate) fn sin_cos_from(self, value: (T, T)) -> (Self, Self) {
        self.circular(value, -1.0)
    }

    /// The series of the direction of (x, y), where this series is y. The slope is exact for any scale of x and y; the value is
    /// the principal one.
    #[inline(always)]
    pub fn atan2(self, x: Self) -> Self {
        let y = self;
        let mut a = Self::constant(y.0[0].atan2(x.0[0]));
        let inverse = T::from(1.0) / (x.0[0] * x.0[0] + y.0[0] * y.0[0]);
        for k in 1..ORDERS {
            // a' (x² + y²) = x y' - y x': each product occurs twice, with opposite signs.
            let mut turning = T::from(0.0);
            for i in k / 2 + 1..=k {
                let cross = x.0[k - i] * y.0[i] - y.0[k - i] * x.0[i];
                turning = turning + cross * T::from((2 * i - k) as f64 / k as f64);
            }
            for i in 1..k {
                let mut square = T::from(0.0);
                for j in 0..=k - i {
                    square = square + x.0[j] * x.0[k - i - j] + y.0[j] * y.0[k - i - j];
                }
                turning = turning - a.0[i] * square * T::from(i as f64 / k as f64);
            }
            a.0[k] = turning * inverse;
        }
        a
    }

    /// Square root; zero has the series zero.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        let mut s = [T::from(0.0); ORDERS];
        s[0] = self.0[0].sqrt();
        let nothing = |lane: usize| self.0.iter().all(|c| c.lane(lane) == 0.0);
        if (0..T::COUNT).all(nothing) {
            return self;
        }
        let inverse = T::from(0.5) / s[0];
        for k in 1..ORDERS {
            let mut known = T::from(0.0);
            for i in 1..k {
                known = known + s[i] * s[k - i];
            }
            s[k] = (self.0[k] - known) * inverse;
        }
        Self(s)
    }

    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let mut q = [T::from(0.0); ORDERS];
        let r = T::from(1.0) / self.0[0];
        q[0] = r;
        for k in 1..ORDERS {
            let mut known = T::from(0.0);
            for i in 1..=k {
                known = known + self.0[i] * q[k - i];
            }
            q[k] = -known * r;
        }
        Self(q)
    }
}

impl<const ORDERS: usize> Taylor<ORDERS> {
    /// The series of the slope; its last coefficient is not known and set to zero.
    pub fn differentiated(&self) -> Self {
        Self(std::array::from_fn(|k| {
            self.0.get(k + 1).map_or(0.0, |next| (k + 1) as f64 * next)
        }))
    }

    /// Sine and cosine of the variable times a number, from their values.
    pub(crate) fn wave(slope: f64, (sin, cos): (f64, f64)) -> (Self, Self) {
        let (mut s, mut c) = ([0.0; ORDERS], [0.0; ORDERS]);
        (s[0], c[0]) = (sin, cos);
        for k in 1..ORDERS {
            let step = slope * (1.0 / k as f64);
            s[k] = step * c[k - 1];
            c[k] = -(step * s[k - 1]);
        }
        (Self(s), Self(c))
    }

    /// The series of `y` with the value `value` and `y' g = a'`, where `a` is this series.
    fn integral_over(self, value: f64, g: Self) -> Self {
        let mut y = [0.0; ORDERS];
        y[0] = value;
        for k in 1..ORDERS {
            let known: f64 = (1..k).map(|i| i as f64 * y[i] * g.0[k - i]).sum();
            y[k] = (self.0[k] - known / k as f64) / g.0[0];
        }
        Self(y)
    }

    pub(crate) fn sinh_cosh(self) -> (Self, Self) {
        self.circular((self.0[0].sinh(), self.0[0].cosh()), 1.0)
    }

    pub(crate) fn tanh(self) -> Self {
        // For a large argument sinh and cosh overflow, so the exponential is used; for a small one this would lose the last
        // digits.
        if self.0[0].abs() < 1.0 {
            let (sinh, cosh) = self.sinh_cosh();
            return sinh / cosh;
        }
        let sign = self.0[0].signum();
        let (one, e) = (Self::constant(1.0), (self * (-2.0 * sign)).exp());
        (one - e) / (one + e) * sign
    }

    pub(crate) fn exp(self) -> Self {
        let mut e = [0.0; ORDERS];
        e[0] = self.0[0].exp();
        for k in 1..ORDERS {
            let sum: f64 = (1..=k).map(|i| i as f64 * self.0[i] * e[k - i]).sum();
            e[k] = sum / k as f64;
        }
        Self(e)
    }

    /// Natural logarithm.
    pub fn ln(self) -> Self {
        self.integral_over(self.0[0].ln(), self)
    }

    /// Arc tangent, rad.
    pub fn atan(self) -> Self {
        self.integral_over(self.0[0].atan(), Self::constant(1.0) + self * self)
    }

    /// Arc sine, rad.
    pub fn asin(self) -> Self {
        let g = (Self::constant(1.0) - self * self).sqrt();
        self.integral_over(self.0[0].asin(), g)
    }

    /// Power of the series to a constant exponent.
    pub(crate) fn power(self, p: f64) -> Self {
        // An integer power has derivatives at zero and below it, too; the recurrence divides by the value.
        if p == p.trunc() && p.abs() <= 64.0 {
            let whole = self.whole_power(p.abs() as u32);
            return if p < 0.0 {
                Self::constant(1.0) / whole
            } else {
                whole
            };
        }
        let mut r = [0.0; ORDERS];
        r[0] = self.0[0].powf(p);
        for k in 1..ORDERS {
            let sum: f64 = (1..=k)
                .map(|i| (p * i as f64 - (k - i) as f64) * self.0[i] * r[k - i])
                .sum();
            r[k] = sum / (k as f64 * self.0[0]);
        }
        Self(r)
    }

    fn whole_power(self, mut p: u32) -> Self {
        let (mut out, mut square) = (Self::constant(1.0), self);
        while p > 0 {
            if p & 1 == 1 {
                out = out * square;
            }
            square = square * square;
            p >>= 1;
        }
        out
    }
}

impl<const ORDERS: usize, T: Number> Add for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + b.0[k]))
    }
}

impl<const ORDERS: usize, T: Number> Sub for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - b.0[k]))
    }
}

impl<const ORDERS: usize, T: Number> Neg for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl<const ORDERS: usize, T: Number> Mul for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| {
            let first = self.0[0] * b.0[k];
            (1..=k).fold(first, |sum, i| sum + self.0[i] * b.0[k - i])
        }))
    }
}

impl<const ORDERS: usize> Div for Taylor<ORDERS> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let mut q = [0.0; ORDERS];
        for k in 0..ORDERS {
            let known: f64 = (1..=k).map(|i| b.0[i] * q[k - i]).sum();
            q[k] = (self.0[k] - known) / b.0[0];
        }
        Self(q)
    }
}

impl<const ORDERS: usize, T: Number> Mul<f64> for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: f64) -> Self {
        Self(self.0.map(|c| c * T::from(k)))
    }
}

impl<const ORDERS: usize, T: Number> Add<f64> for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, k: f64) -> Self {
        self.0[0] = self.0[0] + T::from(k);
        self
    }
}

impl<const ORDERS: usize, T: Number> Sub<f64> for Taylor<ORDERS, T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, k: f64) -> Self {
        self + -k
    }
}
