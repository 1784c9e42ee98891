//! The three-arm transplanting mechanism: three arms on the planets of a non-circular gear train.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

pub mod design;
mod fastened;
mod figures;
mod gearbox;
pub mod making;
mod mesh;
mod parameter;
mod pose;
mod pusher;
mod seedling;
mod shafts;
mod sweep;
mod train;
mod trajectory;
mod tray;

pub use figures::Figures;
pub use gearbox::GearboxBody;
pub use mesh::{GearMesh, MeshPose};
pub use parameter::{Parameter, UnknownParameter};
pub use pose::{Chain, LinkMotion, PointMotion, ThreeArmLink};
pub use pusher::{Pusher, PusherError};
pub use seedling::SeedlingClearance;
pub use sweep::{Sweep, SweepError};
pub use train::{ArmOnCarrier, Train, TrainJet};
pub use trajectory::{Extreme, PickingRule, PlantingRule, Trajectory};
pub use tray::TrayBody;

use centrode_gear::{FlankCount, GearPair, GearPairError, Member, PlannedPair, Rolling};
use centrode_spec::{MechanismError, SpecError};
use design::ThreeArmDesign;

/// A three-arm transplanting mechanism, resolved: exact pitch curves, exact motion of every link.
///
/// The carrier's axis is the origin. The input is the carrier's turn from its start, positive in its own sense of rotation.
/// Every arm moves like the first one, later by its share of a turn.
#[derive(Clone, Debug)]
pub struct ThreeArm {
    design: ThreeArmDesign,
    definition: String,
    train: Train,
    trajectory: Trajectory,
}

/// Reason why a design gives no three-arm mechanism.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThreeArmError {
    /// The gears do not exist.
    #[error(transparent)]
    Gears(#[from] GearPairError),
    /// No arm passes the tray's surface.
    #[error(
        "tray.distance is {distance} mm, but the arms reach only from {minimum} to {maximum} mm in that direction"
    )]
    TrayOutOfReach {
        /// Distance in the design, mm.
        distance: f64,
        /// Minimum reach of the tip, mm.
        minimum: f64,
        /// Maximum reach of the tip, mm.
        maximum: f64,
    },
}

impl From<SpecError> for ThreeArmError {
    fn from(error: SpecError) -> Self {
        Self::Gears(error.into())
    }
}

impl ThreeArmError {
    /// Key of the design file at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Gears(error) => error.key(),
            Self::TrayOutOfReach { .. } => "tray.distance".into(),
        }
    }
}

impl From<ThreeArmError> for MechanismError {
    fn from(error: ThreeArmError) -> Self {
        match error {
            ThreeArmError::Gears(error) => error.into(),
            other => Self::new(other.key(), other),
        }
    }
}

impl ThreeArm {
    /// Rolls the pitch curves and finds the inputs at which the arms pick and plant. It cuts no teeth.
    ///
    /// # Errors
    /// [`ThreeArmError`] with the violated rule and its numbers.
    pub fn resolve(design: &ThreeArmDesign) -> Result<Self, ThreeArmError> {
        design.validate()?;
        let (definition, rolling) = PlannedPair::roll(&design.pair())?;
        let train = Train::new(design, Arc::new(rolling));
        let mut mechanism = Self {
            design: design.clone(),
            definition,
            train,
            trajectory: Trajectory::default(),
        };
        mechanism.trajectory = Trajectory::new(&mechanism)?;
        Ok(mechanism)
    }

    /// Design of the mechanism.
    #[must_use]
    pub fn design(&self) -> &ThreeArmDesign {
        &self.design
    }

    /// Description of the sun's pitch curve.
    #[must_use]
    pub fn definition(&self) -> &str {
        &self.definition
    }

    /// Number of arms.
    #[must_use]
    pub fn arms(&self) -> u32 {
        self.design.arms
    }

    /// The gear train of the first arm.
    #[must_use]
    pub fn train(&self) -> &Train {
        &self.train
    }

    /// Sun and intermediate gear as a rolling pair.
    #[must_use]
    pub fn rolling(&self) -> &Rolling {
        self.train.rolling()
    }

    /// Distance of the axes of two gears in mesh, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        self.rolling().center_distance()
    }

    /// Module, mm, if the tooth count is given: pitch length / (pi x tooth count).
    #[must_use]
    pub fn module(&self) -> Option<f64> {
        let length = self.rolling().pitch_length(Member::Driver);
        let teeth = self.design.gear_tooth_count();
        teeth.map(|z| length / (PI * f64::from(z)))
    }

    /// Extremes of the tip's path in the machine's frame, and the working points of the arms.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Input at which an arm picks, in `[0, 2 pi)`.
    #[must_use]
    pub fn picking(&self, arm: u32) -> f64 {
        self.later(self.trajectory.picking, arm)
    }

    /// Input at which an arm plants, in `[0, 2 pi)`.
    #[must_use]
    pub fn planting(&self, arm: u32) -> f64 {
        self.later(self.trajectory.planting, arm)
    }

    /// Travel of the machine per radian of carrier turn, mm.
    #[must_use]
    pub fn advance(&self) -> f64 {
        f64::from(self.arms()) * self.design.work.plant_spacing / TAU
    }

    /// Speed of the carrier, rad/s, at the design's rate.
    #[must_use]
    pub fn carrier_speed(&self) -> f64 {
        self.design.work.rate_per_minute / 60.0 * TAU / f64::from(self.arms())
    }

    /// Sun and intermediate gear with their teeth. The planets are the same part as the sun, and the intermediate gears are all
    /// one part: the sun meets each of them at the same teeth, at different inputs.
    ///
    /// # Errors
    /// [`GearPairError`] if the teeth cannot be laid out or cut.
    pub fn pair(&self) -> Result<GearPair, GearPairError> {
        GearPair::cached(&self.design.pair()).map(|pair| GearPair::clone(&pair))
    }

    /// Counts the sound flanks of the sun (and so of each planet) and of each intermediate gear at full height.
    ///
    /// # Errors
    /// [`GearPairError`] without a tooth count, or if the teeth cannot be laid out.
    pub fn flank_counts(&self) -> Result<[FlankCount; 2], GearPairError> {
        FlankCount::new(&self.design.pair(), self.rolling())
    }

    /// Direction of the clamp from the arm's zero, rad: that of the tip turned by asin(H/S).
    #[must_use]
    pub fn clamp_mounting(&self) -> f64 {
        let arm = &self.design.arm;
        arm.mounting_angle + (arm.pusher_offset / arm.tip_distance).asin()
    }

    /// The pairs of sun and intermediate gear, and of planet and intermediate gear, with teeth. They differ in the driver's
    /// body only.
    ///
    /// # Errors
    /// [`GearPairError`] if the teeth cannot be laid out or cut, or a bore cuts into them.
    pub fn pairs(&self) -> Result<[GearPair; 2], GearPairError> {
        let sun = self.pair()?;
        let planet = sun.with_driver_body(&self.design.planet)?;
        Ok([sun, planet])
    }

    /// Input at which the first arm has the pose that the given arm has at `input`.
    #[must_use]
    pub fn own_input(&self, input: f64, arm: u32) -> f64 {
        input - TAU * f64::from(arm) / f64::from(self.arms())
    }

    fn later(&self, input: f64, arm: u32) -> f64 {
        (input + TAU * f64::from(arm) / f64::from(self.arms())).rem_euclid(TAU)
    }
}

#[cfg(test)]
mod tests;
