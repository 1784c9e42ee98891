use thiserror::Error;

use centrode_gear::pitch::PitchError;
use centrode_spec::{MechanismError, SpecError};

/// Reason why a spiral shaft does not exist.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ShaftError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A table or formula of the speed cannot be read.
    #[error(transparent)]
    Speed(#[from] PitchError),
    /// The slider would stop or run back on a stroke.
    #[error(
        "amplitude is {amplitude} mm, but must be below {limit:.6} mm for the harmonic {harmonic} and a lead of {lead} mm: otherwise the slider stops or runs back"
    )]
    Amplitude {
        /// Amplitude, mm.
        amplitude: f64,
        /// Waves per turn.
        harmonic: u32,
        /// Lead, mm per turn.
        lead: f64,
        /// Amplitude at which the speed falls to zero, mm.
        limit: f64,
    },
    /// A speed law whose speed falls to zero.
    #[error(
        "the speed must stay above zero, but at {angle_deg:.4} deg it is {ratio:.6} of its mean"
    )]
    SpeedNotPositive {
        /// Shaft angle, deg.
        angle_deg: f64,
        /// Speed there over its mean.
        ratio: f64,
    },
    /// A distance that no amplitude gives.
    #[error(
        "moved_distance must be between {minimum:.6} mm, where the slider stops, and {maximum:.6} mm, where its speed is constant, not {required} mm"
    )]
    MovedDistance {
        /// Required distance, mm.
        required: f64,
        /// Lower bound, mm.
        minimum: f64,
        /// Upper bound, mm.
        maximum: f64,
    },
    /// A window that holds whole waves, over which no amplitude changes the distance.
    #[error(
        "window_deg is {window_deg} deg, a whole number of waves of the harmonic {harmonic}: the distance over it does not depend on the amplitude"
    )]
    Window {
        /// Width of the window, deg.
        window_deg: f64,
        /// Waves per turn.
        harmonic: u32,
    },
    /// Reversals after which the groove does not meet its own start.
    #[error(
        "the reversal must take a whole number of half turns, so that the groove closes on the shaft; it is {0} deg"
    )]
    ReversalAngle(f64),
    /// A law that does not change the speed smoothly and symmetrically from one direction to the other.
    #[error(
        "the law {law} does not reverse the slider: its acceleration must be zero at both ends, and its two halves must be equal"
    )]
    ReversalLaw {
        /// Name of the law.
        law: &'static str,
    },
    /// A slider that reverses more than once in a reversal.
    #[error("the slider changes direction {0} times in one reversal: use a larger reversal angle")]
    TurnsRound(usize),
    /// A groove that leaves no land between neighbouring turns.
    #[error(
        "the groove is {width} mm wide, but the next turn of the groove is only {room:.6} mm away along the normal"
    )]
    GrooveWidth {
        /// Width of the groove, mm.
        width: f64,
        /// Minimum normal distance of neighbouring turns, mm.
        room: f64,
    },
    /// A groove as deep as the shaft is thick.
    #[error(
        "the groove is {depth} mm deep and reaches {limit} of the shaft, whose radius is {radius} mm"
    )]
    GrooveDepth {
        /// Depth, mm.
        depth: f64,
        /// Radius of the shaft, mm.
        radius: f64,
        /// Part that the groove reaches.
        limit: &'static str,
    },
    /// A bend that a slider of the groove's width cannot follow.
    #[error(
        "the bend radius of the groove is {radius:.6} mm at {angle_deg:.3} deg, less than half its width of {width} mm: no slider can follow it; use a larger reversal angle"
    )]
    Bend {
        /// Minimum radius of curvature on the development, mm.
        radius: f64,
        /// Position, deg of shaft turn.
        angle_deg: f64,
        /// Width of the groove, mm.
        width: f64,
    },
    /// A groove whose edges smooth surfaces cannot follow.
    #[error(
        "the edges of the groove change direction too fast: {0} lines round the shaft are not enough for smooth surfaces"
    )]
    Boundary(u32),
    /// An error inside a table of a larger design.
    #[error("{error}")]
    Inside {
        /// The table.
        table: &'static str,
        /// Error there.
        error: Box<ShaftError>,
    },
}

impl ShaftError {
    /// Error with its key seen from outside a table.
    #[must_use]
    pub(super) fn inside(self, table: &'static str) -> Self {
        match self {
            Self::Spec(error) => Self::Spec(error.inside(table)),
            other => Self::Inside {
                table,
                error: Box::new(other),
            },
        }
    }

    /// Key of the design at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::Speed(error) => format!("law.{}", error.key()),
            Self::Amplitude { .. } => "law.amplitude".into(),
            Self::SpeedNotPositive { .. } => "law".into(),
            Self::MovedDistance { .. } => "moved_distance".into(),
            Self::Window { .. } => "window_deg".into(),
            Self::ReversalAngle(_) | Self::TurnsRound(_) | Self::Bend { .. } => {
                "reversal.angle_deg".into()
            }
            Self::ReversalLaw { .. } => "reversal.law".into(),
            Self::Boundary(_) => "law".into(),
            Self::GrooveWidth { .. } => "groove.width".into(),
            Self::GrooveDepth { .. } => "groove.depth".into(),
            Self::Inside { table, error } => format!("{table}.{}", error.key()),
        }
    }
}

impl From<ShaftError> for MechanismError {
    fn from(error: ShaftError) -> Self {
        match error {
            ShaftError::Spec(error) => error.into(),
            other => Self::new(other.key(), other),
        }
    }
}
