use thiserror::Error;

use super::SampleNoise;
use crate::RollingError;

/// Reason why a pitch curve does not exist.
///
/// Angles are polar angles around the shaft axis, degrees.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PitchError {
    /// A number is NaN or infinite.
    #[error("{key} must be a finite number, not {value}")]
    NotFinite {
        /// Key of the number.
        key: &'static str,
        /// Value given.
        value: f64,
    },
    /// A length, module or ratio is zero or negative.
    #[error("{key} must be greater than 0, not {value}")]
    NotPositive {
        /// Key of the number.
        key: &'static str,
        /// Value given.
        value: f64,
    },
    /// An eccentricity outside its range.
    #[error("eccentricity must be at least 0 and less than 1, not {0}")]
    Eccentricity(f64),
    /// A whole number outside its range.
    #[error("{key} must be {minimum} to {maximum}, not {value}")]
    OutOfRange {
        /// Key of the number.
        key: &'static str,
        /// Value given.
        value: u64,
        /// Minimum value allowed.
        minimum: u64,
        /// Maximum value allowed.
        maximum: u64,
    },
    /// A gear with fewer than three teeth.
    #[error("tooth_count must be at least 3, not {0}")]
    ToothCount(u32),
    /// Module without tooth count, or vice versa for a shape without a size.
    #[error("{given} is given without {missing}: the two together set the size of the curve")]
    SizeIncomplete {
        /// The key that is given.
        given: &'static str,
        /// The key that is missing.
        missing: &'static str,
    },
    /// A curve so long or so short that powers of its lengths overflow or underflow.
    #[error(
        "{key} gives a pitch curve {length:e} mm long; the length must be {minimum:e} to {maximum:e} mm"
    )]
    Size {
        /// The key that sets the size.
        key: &'static str,
        /// Length of one turn, mm.
        length: f64,
        /// Minimum length allowed, mm.
        minimum: f64,
        /// Maximum length allowed, mm.
        maximum: f64,
    },
    /// Nothing sets the size of the curve.
    #[error("the size of the curve is not given: give module and tooth_count, or {0}")]
    NoSize(&'static str),
    /// The size is set twice.
    #[error("{0} and {1} both set the size of the curve: give one of them")]
    SizeTwice(&'static str, &'static str),
    /// Two lists that belong together differ in length.
    #[error("{first} has {first_length} values but {second} has {second_length}")]
    LengthMismatch {
        /// First key.
        first: &'static str,
        /// Its length.
        first_length: usize,
        /// Second key.
        second: &'static str,
        /// Its length.
        second_length: usize,
    },
    /// Too few points for the degree.
    #[error("{key} has {count} values; a closed curve of this kind needs at least {minimum}")]
    TooFewPoints {
        /// Key of the list.
        key: &'static str,
        /// Its length.
        count: usize,
        /// Fewest allowed.
        minimum: usize,
    },
    /// Too many points.
    #[error("{key} has {count} values; the limit is {limit}")]
    TooManyPoints {
        /// Key of the list.
        key: &'static str,
        /// Its length.
        count: usize,
        /// Most allowed.
        limit: usize,
    },
    /// A closed chain of Bezier arcs needs a multiple of its degree.
    #[error("{key} has {count} values, not a multiple of the degree {degree}")]
    ArcsIncomplete {
        /// Key of the list.
        key: &'static str,
        /// Its length.
        count: usize,
        /// Degree of every arc.
        degree: u32,
    },
    /// A key is missing, or does not belong to the others given.
    #[error("{key} {rule}")]
    Key {
        /// The key.
        key: &'static str,
        /// Rule it breaks.
        rule: &'static str,
    },
    /// Listed polar angles do not increase within one turn.
    #[error(
        "angle_deg must increase, within one turn: value {index} is {value} deg after {before} deg, so the control polygon crosses itself"
    )]
    AnglesNotIncreasing {
        /// Index of the value, from zero.
        index: usize,
        /// The angle, degrees.
        value: f64,
        /// The angle before it, degrees.
        before: f64,
    },
    /// The radius is zero or negative somewhere.
    #[error("the radius falls to {radius:.6} mm at {angle:.3} deg; it must stay above 0")]
    RadiusNotPositive {
        /// Key of the shape.
        key: &'static str,
        /// Polar angle, degrees.
        angle: f64,
        /// Radius there, mm.
        radius: f64,
    },
    /// The polar angle turns back.
    #[error(
        "the curve turns back or crosses itself near {angle:.3} deg, radius {radius:.6} mm: its polar angle must increase over the whole turn about the shaft axis"
    )]
    SelfCrossing {
        /// Key of the shape.
        key: &'static str,
        /// Polar angle, degrees.
        angle: f64,
        /// Radius there, mm.
        radius: f64,
    },
    /// The curve turns clockwise about the shaft axis.
    #[error("the points run clockwise round the shaft axis: list them counter-clockwise")]
    Clockwise {
        /// Key of the shape.
        key: &'static str,
    },
    /// The curve does not wind exactly once about the shaft axis.
    #[error(
        "the curve goes {turns} times round the shaft axis at the origin; it must go round once"
    )]
    NotAroundAxis {
        /// Key of the shape.
        key: &'static str,
        /// Number of turns, counter-clockwise positive.
        turns: i32,
    },
    /// The ends of the cycle do not meet.
    #[error("the curve is open: {what} is {start} at the start of the turn and {end} at its end")]
    OpenCurve {
        /// Key of the shape.
        key: &'static str,
        /// Name of the quantity.
        what: &'static str,
        /// Value at the start.
        start: f64,
        /// Value at the end.
        end: f64,
    },
    /// A function has no finite value somewhere in the cycle.
    #[error(
        "{key} or one of its derivatives is not a finite number at phi = {angle:.3} deg: its value there is {value}"
    )]
    Undefined {
        /// Key of the function.
        key: &'static str,
        /// Driver angle, degrees.
        angle: f64,
        /// The value.
        value: f64,
    },
    /// A formula with features too narrow to be followed.
    #[error(
        "{key} changes within about {width:.1e} rad, but features narrower than {minimum:.1e} rad cannot be resolved: use a gentler step, a wider bump or slower waves"
    )]
    Steep {
        /// Key of the function.
        key: &'static str,
        /// Approximate width of the narrowest feature, rad.
        width: f64,
        /// Minimum width that can be followed, rad.
        minimum: f64,
    },
    /// The driven gear stops or turns back.
    #[error(
        "d driven / d driver falls to {ratio:.6} at phi = {angle:.3} deg; it must stay above 0"
    )]
    RatioNotPositive {
        /// Key of the function.
        key: &'static str,
        /// Driver angle, degrees.
        angle: f64,
        /// The ratio there.
        ratio: f64,
    },
    /// The driven gear's turns in one driver turn are not a ratio of small whole numbers.
    #[error(
        "one driver turn gives {turns} driven turns, which is not a ratio of whole numbers up to {limit}: the driven pitch curve would not close"
    )]
    RatioNotRational {
        /// Key of the function.
        key: &'static str,
        /// Driven turns in one driver turn.
        turns: f64,
        /// Largest whole number tried.
        limit: u32,
    },
    /// The mean of the samples is not the mean ratio of the pair.
    #[error(
        "the samples give {mean:.6} driven turns per driver turn, but the mean ratio {}:{} needs {:.6}: that is {:.1} % off, and at most {} % is scaled away. Is this the right column, and is mean_ratio right?",
        .ratio.0, .ratio.1, f64::from(.ratio.1) / f64::from(.ratio.0),
        100.0 * (.mean * f64::from(.ratio.0) / f64::from(.ratio.1) - 1.0).abs(), 100.0 * .limit
    )]
    MeanOff {
        /// Key of the samples.
        key: &'static str,
        /// Driven turns per driver turn by the samples.
        mean: f64,
        /// Turns of driver and driven gear in one whole cycle.
        ratio: (u32, u32),
        /// Maximum relative change of the samples.
        limit: f64,
    },
    /// The curve of noisy samples is not possible.
    #[error(
        "noisy-law: the samples scatter by {:.2e} (rms), so that the curvature of the pitch curve is {:.1} times that of a circle by noise alone (maximum {:.2}). Write smooth = {{ harmonics = {} }}",
        .0.deviation, .0.curvature, .0.limit, .0.harmonics
    )]
    Noisy(SampleNoise),
    /// A file of samples that was not read.
    #[error(
        "the file {0} is named, but this design was read without its folder: save the design next to the file and open it from there, or write the samples into the design"
    )]
    NotRead(String),
    /// No number of harmonics comes near enough to the samples.
    #[error(
        "tolerance {tolerance} is not reached with {limit} harmonics, the maximum for these samples: the largest distance from a sample is {residual:.3e}"
    )]
    NotSmoothed {
        /// Tolerance as written, in the unit of the samples.
        tolerance: f64,
        /// Maximum number of harmonics.
        limit: usize,
        /// Largest distance with all of them, in the unit of the samples.
        residual: f64,
    },
    /// The curve changes so fast that no sampling follows it reliably.
    #[error("the curve changes too fast near {angle:.3} deg to be resolved")]
    TooRough {
        /// Key of the shape.
        key: &'static str,
        /// Polar angle, degrees.
        angle: f64,
    },
    /// The curve whose conjugate is required does not exist.
    #[error("of: {0}")]
    Of(Box<PitchError>),
    /// No closed curve rolls on the one given.
    #[error("{0}")]
    NoConjugate(Box<RollingError>),
    /// A formula that cannot be read.
    #[error("{key}: {reason} at character {column}")]
    Expression {
        /// Key of the formula.
        key: &'static str,
        /// Reason.
        reason: String,
        /// Position in the formula, from one.
        column: usize,
    },
}

impl PitchError {
    /// Key of the pitch curve's description that is at fault.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::NotFinite { key, .. }
            | Self::NotPositive { key, .. }
            | Self::OutOfRange { key, .. }
            | Self::Size { key, .. }
            | Self::TooFewPoints { key, .. }
            | Self::TooManyPoints { key, .. }
            | Self::ArcsIncomplete { key, .. }
            | Self::Key { key, .. }
            | Self::RadiusNotPositive { key, .. }
            | Self::SelfCrossing { key, .. }
            | Self::Clockwise { key }
            | Self::NotAroundAxis { key, .. }
            | Self::OpenCurve { key, .. }
            | Self::Undefined { key, .. }
            | Self::Steep { key, .. }
            | Self::TooRough { key, .. }
            | Self::RatioNotPositive { key, .. }
            | Self::RatioNotRational { key, .. }
            | Self::MeanOff { key, .. }
            | Self::Expression { key, .. } => key,
            Self::Eccentricity(_) => "eccentricity",
            Self::ToothCount(_) => "tooth_count",
            Self::SizeIncomplete { given, .. } => given,
            Self::NoSize(key) | Self::SizeTwice(key, _) => key,
            Self::LengthMismatch { second, .. } => second,
            Self::AnglesNotIncreasing { .. } => "angle_deg",
            Self::Of(_) => "of",
            Self::NoConjugate(_) => "mean_ratio",
            Self::NotSmoothed { .. } => "smooth.tolerance",
            Self::Noisy(_) => "smooth",
            Self::NotRead(_) => "file",
        }
    }
}

/// Returns `value`, if finite.
pub(crate) fn finite(key: &'static str, value: f64) -> Result<f64, PitchError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(PitchError::NotFinite { key, value })
    }
}

/// Returns `value`, if finite and greater than zero.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<f64, PitchError> {
    if finite(key, value)? > 0.0 {
        Ok(value)
    } else {
        Err(PitchError::NotPositive { key, value })
    }
}

/// Returns `value`, if in `[0, 1)`.
pub(crate) fn eccentricity(value: f64) -> Result<f64, PitchError> {
    if (0.0..1.0).contains(&finite("eccentricity", value)?) {
        Ok(value)
    } else {
        Err(PitchError::Eccentricity(value))
    }
}

/// Returns `value`, if in `minimum..=maximum`.
pub(crate) fn in_range(
    key: &'static str,
    value: u32,
    minimum: u32,
    maximum: u32,
) -> Result<u32, PitchError> {
    if (minimum..=maximum).contains(&value) {
        Ok(value)
    } else {
        Err(PitchError::OutOfRange {
            key,
            value: value.into(),
            minimum: minimum.into(),
            maximum: maximum.into(),
        })
    }
}
