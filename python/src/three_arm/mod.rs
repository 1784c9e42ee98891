mod methods;
mod variants;

use std::sync::Arc;

use centrode_machines::three_arm as mechanism;
use centrode_machines::three_arm::PointMotion;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::{PyClassInitializer, pyclass};

use crate::array::{Course, Values};
use crate::design::Class;
use crate::error::Answer;
use crate::mechanism::Mechanism;

/// A three-arm transplanting mechanism: a fixed sun, a turning carrier, and arms on the planets of bent gear chains.
///
/// The origin is the axis of the carrier; theta is the carrier angle from its start, positive in its direction of
/// rotation. Every arm has the motion of the first, delayed by its share of a turn. Arms are counted from 0.
///
/// Args:
///     pitch: Pitch curve of the sun; the planets have the same curve, and that of the intermediate gears follows from
///         it.
///     carrier_start: Direction of the first intermediate gear's axis from the sun's at the start, rad.
///     bend: Angle from the leg sun - intermediate to the leg intermediate - planet, rad.
///     arm_mounting_angle: Angle from the planet's zero direction to the tip, rad.
///     tip_distance: Distance of the tip from the planet's axis, mm.
///     pusher_offset: Distance of the pusher's axis, which ends at the tip, from the planet's axis, mm.
///     planet_reference: Angle from the planet's zero direction to the second leg at the start, rad; default: the
///         rotation of the intermediate gear over the first abs(bend) of the carrier angle.
///     arms: Number of arms, 1 to 6.
///     direction: Rotation of the carrier, "clockwise" or "counter-clockwise".
///     tooth_count: Tooth count of every gear; default: none, and the teeth are not checked.
///     center_distance: Centre distance, mm; it follows from the pitch curve, and is checked if given.
///     picking: Carrier angle at which the first arm picks, rad; default: where its tip enters the tray, or reaches
///         farthest towards it.
///     planting: Carrier angle at which the first arm plants, rad; default: where its tip is lowest.
///     rate_per_minute: Seedlings planted per minute.
///     plant_spacing: Distance of the plants along the row, mm.
///     planting_depth: Depth of the lowest tip position below the ground, mm.
///     tray_distance: Distance of the tray's surface from the carrier's axis, mm.
///     tray_inclination: Elevation of the direction in which the arms enter the tray, rad.
///     seedling_height: Height up to which a planted stem must not be pushed, mm.
///     seedling_width: Width of a planted stem, mm.
///     clamp_length: Length of the clamp back from the tip, mm: the part that passes between seedlings.
///     housing_offset: Distance of the outside of the gearbox from the largest pitch radius, mm.
///     tool: Tool that cuts the gears; default: the rack of ISO 53, profile A.
///     shift: Profile shift coefficient of sun and planets, in modules; that of the intermediate gears is its negative.
///     addendum: "full" or "fitted".
///     backlash: Backlash of each mesh along the normal, mm.
///     sun: Body of the sun.
///     intermediate: Body of the intermediate gears.
///     planet: Body of the planets.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule; PitchError, GearPairError or MechanismError if the mechanism cannot exist.
///
/// >>> import centrode as ct, math
/// >>> pitch = ct.pitch.bspline(
/// ...     degree=2,
/// ...     radius=[21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24],
/// ...     angle=[math.radians(d) for d in (20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345)],
/// ... )
/// >>> arms = ct.ThreeArm(
/// ...     pitch, carrier_start=math.radians(86), bend=math.radians(-53), arm_mounting_angle=math.radians(-29),
/// ...     tip_distance=145, pusher_offset=65, picking=math.radians(20), planting=math.radians(191),
/// ... )
/// >>> round(arms.center_distance, 6)
/// 82.04634
/// >>> round(math.degrees(arms.clamp_angle(math.radians(20))), 6)
/// 0.616147
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct ThreeArm(Arc<mechanism::ThreeArm>);

impl Class for ThreeArm {
    type Machine = mechanism::ThreeArm;

    fn start(arms: Arc<mechanism::ThreeArm>) -> PyClassInitializer<Self> {
        Mechanism::start(&arms).add_subclass(Self(arms))
    }

    fn machine(&self) -> &Arc<mechanism::ThreeArm> {
        &self.0
    }
}

impl ThreeArm {
    /// An arm that is there.
    fn arm(&self, arm: i64) -> Answer<u32> {
        let arms = self.0.arms();
        let there = u32::try_from(arm).ok().filter(|&arm| arm < arms);
        there.ok_or_else(|| {
            let message = format!("arm {arm} of {arms}, counted from 0");
            PyIndexError::new_err(message).into()
        })
    }

    fn of_tip(
        &self,
        theta: Values,
        arm: i64,
        over_ground: bool,
        part: fn(&PointMotion) -> [f64; 2],
    ) -> Answer<Course> {
        let arm = self.arm(arm)?;
        Ok(self.rows(theta, move |arms, theta| {
            let tip = arms.tip(theta, arm);
            if over_ground {
                part(&arms.over_ground(&tip, theta))
            } else {
                part(&tip)
            }
        }))
    }
}
