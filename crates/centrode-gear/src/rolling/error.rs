use super::Rolling;

/// Reason why two pitch curves cannot roll on each other.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RollingError {
    /// The pitch curve does not wind once around the shaft.
    #[error(
        "the polar angle of the pitch curve changes by {turned} rad over its length; it must increase by 2 pi without turning back"
    )]
    NotAroundAxis {
        /// Polar angle swept in one round, rad.
        turned: f64,
    },
    /// The pitch curve oscillates or has kinks too often to be followed.
    #[error(
        "the pitch curve oscillates or has kinks too often: divided into up to 4096 pieces between neighbouring joints, {unsettled} pieces are still not smooth; at most {most} are allowed. Smooth the law"
    )]
    Unsettled {
        /// Number of pieces on which no polynomial represents the curve's length to a billionth.
        unsettled: usize,
        /// Maximum number of such pieces.
        most: usize,
    },
    /// The mean ratio has no closed driven curve.
    #[error(
        "mean ratio {}:{} needs a driver curve that repeats {} times per turn, but its radius differs by {difference:.3e} mm \
        between repeats: try kind = \"lobed-ellipse\", lobes = {}", ratio.0, ratio.1, ratio.1, ratio.1
    )]
    NotPeriodic {
        /// Turns of driver : turns of driven.
        ratio: (u32, u32),
        /// Maximum difference found, mm.
        difference: f64,
    },
    /// A mean ratio with a number that is zero or too large.
    #[error("both numbers of the mean ratio {}:{} must be from 1 to {}", ratio.0, ratio.1, Rolling::MAX_TURNS)]
    MeanRatio {
        /// Turns of driver : turns of driven.
        ratio: (u32, u32),
    },
    /// No centre distance closes the driven curve.
    #[error(
        "no centre distance closes the driven curve: at {center_distance} mm one driver turn turns the driven gear by {turned} rad instead of {required} rad"
    )]
    NoClosure {
        /// The last centre distance tried, mm.
        center_distance: f64,
        /// Driven angle of one driver turn, rad.
        turned: f64,
        /// Angle it should be, rad.
        required: f64,
    },
}
