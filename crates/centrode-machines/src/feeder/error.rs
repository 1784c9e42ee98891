use thiserror::Error;

use centrode_gear::{IntermittentError, IntermittentPairError};
use centrode_kinematics::linkage::{FourBarError, SixBarError};
use centrode_spec::{MechanismError, SpecError};

/// Error of a feeder that cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FeederError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// There is no such four-bar.
    #[error(transparent)]
    FourBar(#[from] FourBarError),
    /// There is no such six-bar.
    #[error(transparent)]
    SixBar(#[from] SixBarError),
    /// There is no such intermittent drive.
    #[error(transparent)]
    Drive(#[from] IntermittentError),
    /// The gears cannot be cut.
    #[error(transparent)]
    Gears(#[from] IntermittentPairError),
    /// A cycle after which the crank is not back at its rest position.
    #[error(
        "{teeth} teeth turn the crank by {teeth}/{driven} of a turn each cycle: a feeder needs one whole turn, so teeth must be {driven}"
    )]
    NotOneTurn {
        /// Number of pitches driven in one cycle.
        teeth: u32,
        /// Number of pitches of the driven gear.
        driven: u32,
    },
    /// The slider comes so close to the effector's pivot that its slot meets the pivot's hole.
    #[error(
        "the slot for the slider would start {start:.4} mm from the effector's pivot, whose hole has a radius of {radius} mm: use a shorter slider or a thinner pin, or move the pivot away from the slider's path"
    )]
    SlotMeetsPivot {
        /// Distance of the slot's start from the pivot, mm.
        start: f64,
        /// Radius of the pivot's hole, mm.
        radius: f64,
    },
    /// Two holes of a plate overlap.
    #[error(
        "holes {} and {} of the {part} overlap: their axes are {distance:.4} mm apart, but the holes need {reach:.4} mm",
        joints[0],
        joints[1]
    )]
    HolesMeet {
        /// The plate.
        part: &'static str,
        /// Letters of the joints.
        joints: [String; 2],
        /// Distance of their centres, mm.
        distance: f64,
        /// Sum of the radii of the holes, with keyways, mm.
        reach: f64,
    },
    /// A part has no area.
    #[error("the {0} has no contour")]
    NoPlate(&'static str),
}

impl FeederError {
    /// Key of the design at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::SixBar(SixBarError::PivotOnPath { .. }) => "linkage.pivot".into(),
            Self::FourBar(_) | Self::SixBar(_) => "linkage.crank".into(),
            Self::Drive(IntermittentError::Entry { .. }) => "gears.entry_deg".into(),
            Self::Gears(error) => format!("gears.{}", error.key()),
            Self::SlotMeetsPivot { .. } => "plates.slider_length".into(),
            Self::HolesMeet { .. } => "plates.pin_diameter".into(),
            Self::NoPlate(_) => "plates".into(),
            Self::Drive(_) | Self::NotOneTurn { .. } => "gears.teeth".into(),
        }
    }
}

impl From<FeederError> for MechanismError {
    fn from(error: FeederError) -> Self {
        match error {
            FeederError::Spec(error) => error.into(),
            other => Self::new(other.key(), other),
        }
    }
}
