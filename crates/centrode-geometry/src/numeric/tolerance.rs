use thiserror::Error;

/// Maximum distance, in millimetres, between a curve and its approximation.
///
/// It is the last argument of every approximating function. If you scale a shape and its tolerance by the
/// same factor, every output scales by that factor.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Tolerance(f64);

/// A tolerance that is not a positive finite length.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("tolerance must be a positive finite length in mm, not {0}")]
pub struct BadTolerance(pub f64);

impl Tolerance {
    /// One micrometre: finer than machines cut, coarser than rounding at any usual size. Ten times larger, steps show on flanks;
    /// ten times smaller, files have twice to three times as many arcs and chords.
    pub const MICROMETRE: Self = Self(1e-3);

    /// A tolerance of `mm` millimetres.
    ///
    /// # Errors
    /// [`BadTolerance`] unless `mm` is positive and finite.
    pub fn new(mm: f64) -> Result<Self, BadTolerance> {
        if mm.is_finite() && mm > 0.0 {
            Ok(Self(mm))
        } else {
            Err(BadTolerance(mm))
        }
    }

    /// The tolerance in millimetres.
    #[must_use]
    pub fn mm(self) -> f64 {
        self.0
    }

    /// The coarser of two tolerances.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    /// This tolerance times a positive factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        debug_assert!(factor > 0.0, "a tolerance scales by a positive factor");
        Self(self.0 * factor)
    }
}
