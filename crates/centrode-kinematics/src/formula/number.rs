use std::ops::{Add, Div, Mul, Neg, Sub};

/// Number, or several side by side, in which closed forms and series are computed.
pub trait Number:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Square root.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle, rad.
    fn sin_cos(self) -> (Self, Self);

    /// The direction of (x, y), where this is y; not defined at (0, 0).
    fn atan2(self, x: Self) -> Self;

    /// Number of lanes.
    const COUNT: usize;

    /// Number made of a value for each lane.
    fn of_lanes(value: impl Fn(usize) -> f64) -> Self;

    /// Value of one lane; a single number has one lane.
    fn lane(self, lane: usize) -> f64;

    /// `then` where this is below a bound, `otherwise` where it is not.
    fn if_below(self, bound: f64, then: f64, otherwise: f64) -> Self;
}

impl Number for f64 {
    #[inline]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        self.atan2(x)
    }

    const COUNT: usize = 1;

    #[inline]
    fn of_lanes(value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }

    #[inline]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline]
    fn if_below(self, bound: f64, then: f64, otherwise: f64) -> Self {
        if self < bound { then } else { otherwise }
    }
}
