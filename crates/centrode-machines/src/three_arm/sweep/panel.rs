use std::ops::{Add, Div, Mul, Sub};

use wide::f64x4;

use super::spline::Polynomial;
use centrode_gear::pitch::HIGHEST_DEGREE;

/// Number of nodes of a panel. The nearest poles of the integrand are so far away, in panel widths, that the neglected
/// terms of its series are below 1e-10.
pub(super) const NODES: usize = 10;
pub(super) const COEFFICIENTS: usize = NODES + 1;

/// Number of parameters evaluated at once, in the lanes of a vector register.
pub(super) const LANES: usize = 4;

/// One parameter, or [`LANES`] parameters at once.
pub(super) trait Places:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
}

impl Places for f64 {}
impl Places for f64x4 {}

/// A part of the pitch curve; all its functions are polynomials of s in [-1, 1].
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub(super) driven: [f64; COEFFICIENTS],
    pub(super) angle: Polynomial,
    pub(super) radius: Polynomial,
}

/// Value of a function at a parameter, and its first two derivatives by s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evaluation<T = f64> {
    pub(super) value: T,
    pub(super) rate: T,
    pub(super) change: T,
}

impl<T: Places> Evaluation<T> {
    /// Step towards a value by Halley's method.
    #[inline]
    pub(super) fn step(&self, to: T) -> T {
        let inverse = T::from(1.0) / self.rate;
        let newton = (to - self.value) * inverse;
        newton - T::from(0.5) * self.change * inverse * newton * newton
    }
}

impl Panel {
    pub(super) const EMPTY: Self = Self {
        driven: [0.0; COEFFICIENTS],
        angle: [0.0; HIGHEST_DEGREE + 1],
        radius: [0.0; HIGHEST_DEGREE + 1],
    };
}

/// Function that increases along the pitch curve.
pub(super) trait Monotone: Copy {
    /// Evaluates the function in a panel; the first `C` coefficients of the panel's polynomials may differ from zero.
    fn evaluate<const C: usize, T: Places>(self, panel: &Panel, s: T) -> Evaluation<T>;
}

/// The polar angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct PolarAngle;

/// The driven angle of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrivenAngle {
    pub(super) center_distance: f64,
}

impl Monotone for PolarAngle {
    #[inline]
    fn evaluate<const C: usize, T: Places>(self, panel: &Panel, s: T) -> Evaluation<T> {
        let (value, rate, change) = twice(&panel.angle[..C], s);
        Evaluation {
            value,
            rate,
            change,
        }
    }
}

impl Monotone for DrivenAngle {
    #[inline]
    fn evaluate<const C: usize, T: Places>(self, panel: &Panel, s: T) -> Evaluation<T> {
        let a = T::from(self.center_distance);
        let c = panel.driven.map(T::from);
        // Even and odd powers are summed separately: two short chains of operations instead of a long one.
        let ss = s * s;
        let (mut even, mut odd) = (c[COEFFICIENTS - 1], c[COEFFICIENTS - 2]);
        let mut k = COEFFICIENTS - 3;
        while k >= 2 {
            even = even * ss + c[k];
            odd = odd * ss + c[k - 1];
            k -= 2;
        }
        even = even * ss + c[0];
        let (_, turn, turn_change) = twice(&panel.angle[..C], s);
        let (r, slope, _) = twice(&panel.radius[..C], s);
        let rest = T::from(1.0) / (a - r);
        let ratio = r * rest;
        Evaluation {
            value: even + odd * s,
            rate: turn * ratio,
            change: turn_change * ratio + turn * slope * a * rest * rest,
        }
    }
}

/// Quintic that is -1 and 1 at the ends of [0, 1], and has there the first and second derivatives of an inverse function.
#[inline]
pub(super) fn inverse_quintic([[d0, e0], [d1, e1]]: [[f64; 2]; 2]) -> [f64; 6] {
    [
        -1.0,
        d0,
        0.5 * e0,
        20.0 - 6.0 * d0 - 4.0 * d1 - 1.5 * e0 + 0.5 * e1,
        8.0 * d0 + 7.0 * d1 + 1.5 * e0 - e1 - 30.0,
        12.0 - 3.0 * d0 - 3.0 * d1 - 0.5 * e0 + 0.5 * e1,
    ]
}

/// Value and derivative of a polynomial.
#[inline]
pub(super) fn horner(c: &[f64], s: f64) -> (f64, f64) {
    let (value, rate, _) = twice(c, s);
    (value, rate)
}

/// Value and the first two derivatives of a polynomial.
#[inline]
pub(super) fn twice<T: Places>(c: &[f64], s: T) -> (T, T, T) {
    let zero = T::from(0.0);
    let (mut value, mut rate, mut change) = (zero, zero, zero);
    for &k in c.iter().rev() {
        change = change * s + rate;
        rate = rate * s + value;
        value = value * s + T::from(k);
    }
    (value, rate, change + change)
}
