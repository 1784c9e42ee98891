use crate::arm::ArmError;
use centrode_gear::cam::CamError;
use centrode_spec::SpecError;

/// Reason why an arm's push rod cannot be moved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PusherError {
    /// A value outside its range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// There is no such arm.
    #[error(transparent)]
    Arm(#[from] ArmError),
    /// There is no such cam.
    #[error(transparent)]
    Cam(#[from] CamError),
    /// The rod has no time to rest in its thrown-out position.
    #[error(
        "drawing back over {closing} deg, holding over {hold} deg and throwing out over {release} deg take more than a turn"
    )]
    NoRest {
        /// Carrier turn over which the rod is drawn back, deg.
        closing: f64,
        /// Carrier turn from picking to planting, deg.
        hold: f64,
        /// Carrier turn over which the rod is thrown out, deg.
        release: f64,
    },
    /// The pivot is not between the planet's axis and the pusher's.
    #[error(
        "the fork's pivot is {pivot_distance} mm from the planet's axis, but the pusher's axis only {pusher_offset} mm"
    )]
    Pivot {
        /// Distance of the pivot, mm.
        pivot_distance: f64,
        /// Distance of the pusher's axis, mm.
        pusher_offset: f64,
    },
    /// The holes of pivot and roller overlap.
    #[error("the roller's pin is {arm_length} mm from the pivot, but their holes need {needed} mm")]
    Holes {
        /// Distance of the two axes, mm.
        arm_length: f64,
        /// Half the sum of both diameters, mm.
        needed: f64,
    },
    /// Cam, fork and rod do not fit next to each other.
    #[error(
        "rod, fork and cam need {needed} mm behind the middle of the housing, but only {room} mm is available"
    )]
    Depth {
        /// Width that they need, mm.
        needed: f64,
        /// The room inside the rear cover, mm.
        room: f64,
    },
    /// The rear end of the rod does not reach the fork's pin.
    #[error(
        "with the rod thrown out, the fork's pin is {pin} mm in front of the planet's axis, but the rod starts at {rod} mm: lengthen arm.body.housing.tube_back or shorten the stroke"
    )]
    RodEnd {
        /// Position of the pin along the pusher's axis, mm.
        pin: f64,
        /// Position at which the rod begins, with room for the pin's hole, mm.
        rod: f64,
    },
    /// At its highest position the roller hits the housing's drum.
    #[error(
        "the roller reaches {reach} mm from the planet's axis, but the housing leaves {room} mm"
    )]
    Roller {
        /// Maximum reach of the roller, mm.
        reach: f64,
        /// Inner radius of the drum, mm.
        room: f64,
    },
}

impl PusherError {
    /// Key of the design file at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::Arm(ArmError::Spec(error)) => format!("arm.{}", error.key),
            Self::Arm(_) => "arm.body".into(),
            Self::Cam(CamError::Bore { .. }) => "cam.body.bore".into(),
            Self::Cam(CamError::Spec(error)) if error.key == "base_radius" => {
                "cam.base_radius".into()
            }
            Self::Cam(CamError::Spec(_) | CamError::Reach { .. }) | Self::Roller { .. } => {
                "fork".into()
            }
            Self::Cam(_) => "cam".into(),
            Self::NoRest { .. } => "cam.closing_deg".into(),
            Self::Pivot { .. } => "fork.pivot_distance".into(),
            Self::Holes { .. } => "fork.arm_length".into(),
            Self::Depth { .. } => "cam.body.width".into(),
            Self::RodEnd { .. } => "arm.body.housing.tube_back".into(),
        }
    }
}
