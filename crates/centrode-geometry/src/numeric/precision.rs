//! The five relative differences below which values count as equal. None is a length: each is a fraction of the size of the
//! compared values, or of the range of a parameter.

/// Relative difference within which two values that are computed in many steps count as equal. Ten times larger takes 0.1 nm in
/// 10 mm for rounding; ten times smaller takes the rounding of long computations for a difference.
pub const COMPUTED: f64 = 1e-9;

/// Difference, relative to the range, within which two results of an iteration count as equal. Ten times larger joins the two
/// crossings of a very small loop; ten times smaller makes two crossings of one.
pub(crate) const ITERATED: f64 = 1e-11;

/// Relative difference within which two values that follow from written numbers in a few steps count as equal. Ten times larger
/// takes digits that were written for rounding; a thousand times smaller refuses sums of written numbers.
pub const WRITTEN: f64 = 1e-12;

/// Rounding error of a point on a curve, relative to the size of the curve. Ten times larger hides crossings near cusps; ten
/// times smaller reports crossings that are rounding.
pub(crate) const POSITION: f64 = 64.0 * f64::EPSILON;

/// Difference below which two values of this size are equal except for rounding.
#[must_use]
pub fn rounding(size: f64) -> f64 {
    4.0 * f64::EPSILON * size.abs()
}
