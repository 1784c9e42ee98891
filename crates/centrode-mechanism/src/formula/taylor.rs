use std::ops::{Add, Div, Mul, Neg, Sub};

/// Coefficients of a Taylor polynomial: value, slope, half the second derivative, and so on.
///
/// Five of them are enough for the third derivative of a function given by its integral, four for the
/// jerk of a linkage, two for a sensitivity, one for a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Taylor<const ORDERS: usize = 5>(pub(crate) [f64; ORDERS]);

impl<const ORDERS: usize> Taylor<ORDERS> {
    pub(crate) fn constant(value: f64) -> Self {
        let mut c = [0.0; ORDERS];
        c[0] = value;
        Self(c)
    }

    pub(crate) fn variable(value: f64) -> Self {
        let mut c = [0.0; ORDERS];
        c[0] = value;
        if let Some(slope) = c.get_mut(1) {
            *slope = 1.0;
        }
        Self(c)
    }

    /// Value and first three derivatives.
    pub(crate) fn derivatives(&self) -> [f64; 4] {
        let known = |k: usize| self.0.get(k).copied().unwrap_or_default();
        [known(0), known(1), 2.0 * known(2), 6.0 * known(3)]
    }

    /// The slope's own series; its last coefficient is not known and left zero.
    pub(crate) fn differentiated(&self) -> Self {
        Self(std::array::from_fn(|k| {
            self.0.get(k + 1).map_or(0.0, |next| (k + 1) as f64 * next)
        }))
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

    /// The pair with `s' = a' c` and `c' = sign a' s`.
    fn circular(self, (s0, c0): (f64, f64), sign: f64) -> (Self, Self) {
        let (mut s, mut c) = ([0.0; ORDERS], [0.0; ORDERS]);
        (s[0], c[0]) = (s0, c0);
        for k in 1..ORDERS {
            for i in 1..=k {
                let slope = i as f64 * self.0[i] / k as f64;
                s[k] += slope * c[k - i];
                c[k] += sign * slope * s[k - i];
            }
        }
        (Self(s), Self(c))
    }

    pub(crate) fn reciprocal(self) -> Self {
        let mut q = [0.0; ORDERS];
        let r = 1.0 / self.0[0];
        q[0] = r;
        for k in 1..ORDERS {
            let known: f64 = (1..=k).map(|i| self.0[i] * q[k - i]).sum();
            q[k] = -known * r;
        }
        Self(q)
    }

    pub(crate) fn sin_cos(self) -> (Self, Self) {
        self.circular(self.0[0].sin_cos(), -1.0)
    }

    pub(crate) fn sinh_cosh(self) -> (Self, Self) {
        self.circular((self.0[0].sinh(), self.0[0].cosh()), 1.0)
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

    pub(crate) fn ln(self) -> Self {
        self.integral_over(self.0[0].ln(), self)
    }

    pub(crate) fn atan(self) -> Self {
        self.integral_over(self.0[0].atan(), Self::constant(1.0) + self * self)
    }

    pub(crate) fn asin(self) -> Self {
        let g = (Self::constant(1.0) - self * self).sqrt();
        self.integral_over(self.0[0].asin(), g)
    }

    /// The series of the direction of (x, y), where this series is y: its slope is exact however x and y
    /// are scaled, its value the principal one.
    pub(crate) fn atan2(self, x: Self) -> Self {
        let g = x * x + self * self;
        let mut a = [0.0; ORDERS];
        a[0] = self.0[0].atan2(x.0[0]);
        for k in 1..ORDERS {
            // a' g = x y' - y x'
            let mut turning = 0.0;
            for i in 1..=k {
                turning += i as f64 * (self.0[i] * x.0[k - i] - x.0[i] * self.0[k - i]);
            }
            let known: f64 = (1..k).map(|i| i as f64 * a[i] * g.0[k - i]).sum();
            a[k] = (turning - known) / (k as f64 * g.0[0]);
        }
        Self(a)
    }

    pub(crate) fn sqrt(self) -> Self {
        let mut s = [0.0; ORDERS];
        s[0] = self.0[0].sqrt();
        if self.0 == [0.0; ORDERS] {
            return self;
        }
        for k in 1..ORDERS {
            let known: f64 = (1..k).map(|i| s[i] * s[k - i]).sum();
            s[k] = (self.0[k] - known) / (2.0 * s[0]);
        }
        Self(s)
    }

    /// This series to a constant power.
    pub(crate) fn power(self, p: f64) -> Self {
        // A whole power has derivatives at zero and below it; a recurrence divides by the value.
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

impl<const ORDERS: usize> Add for Taylor<ORDERS> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + b.0[k]))
    }
}

impl<const ORDERS: usize> Sub for Taylor<ORDERS> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - b.0[k]))
    }
}

impl<const ORDERS: usize> Neg for Taylor<ORDERS> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl<const ORDERS: usize> Mul for Taylor<ORDERS> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| {
            (0..=k).map(|i| self.0[i] * b.0[k - i]).sum()
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

impl<const ORDERS: usize> Mul<f64> for Taylor<ORDERS> {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self(self.0.map(|c| c * k))
    }
}

impl<const ORDERS: usize> Add<f64> for Taylor<ORDERS> {
    type Output = Self;
    fn add(mut self, k: f64) -> Self {
        self.0[0] += k;
        self
    }
}

impl<const ORDERS: usize> Sub<f64> for Taylor<ORDERS> {
    type Output = Self;
    fn sub(mut self, k: f64) -> Self {
        self.0[0] -= k;
        self
    }
}
