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

/// A three-arm transplanting mechanism: fixed sun, turning carrier, arms on the planets of bent chains.
///
/// The carrier's axis is the origin; theta is the carrier's turn from its start, positive in the direction in which it turns. Every
/// arm does what the first does, later by its share of a turn; arms are counted from 0.
///
/// Args:
///     pitch: Pitch curve of the sun; the planets are equal, the intermediate gears follow.
///     carrier_start: Direction of the first intermediate gear's axis from the sun's at the start, rad.
///     bend: From the leg sun - intermediate to the leg intermediate - planet, rad.
///     arm_mounting_angle: Direction of the tip from the planet's zero, rad.
///     tip_distance: Of the tip from the planet's axis, mm.
///     pusher_offset: Distance of the pusher's axis, which ends at the tip, from the planet's axis, mm.
///     planet_reference: Angle from the planet's zero to the second leg at the start, rad; default: the intermediate's turn
///         over the first abs(bend) of carrier turn.
///     arms: 1 to 6.
///     direction: "clockwise" or "counter-clockwise".
///     tooth_count: Of every gear; default: there are no teeth to judge.
///     center_distance: mm; it follows from the pitch curve, and is checked if given.
///     picking: Carrier turn at which the first arm picks, rad; default: where its tip enters the tray, or reaches
///         farthest towards it.
///     planting: Carrier turn at which the first arm plants, rad; default: where its tip is lowest.
///     rate_per_minute: Seedlings planted.
///     plant_spacing: Distance of the plants along the row, mm.
///     planting_depth: Of the lowest tip below the ground, mm.
///     tray_distance: Of the tray's surface from the carrier's axis, mm.
///     tray_inclination: Elevation of the direction in which the arms enter the tray, rad.
///     seedling_height: Up to which a planted stem must not be pushed, mm.
///     seedling_width: Of a planted stem, mm.
///     clamp_length: Back from the tip, mm: what passes between seedlings.
///     housing_offset: Of the gearbox from the largest pitch radius, mm.
///     tool: What cuts the gears; the rack of ISO 53, profile A, by default.
///     shift: Profile shift coefficient of sun and planets, in modules; the intermediate gears have the opposite one.
///     addendum: "full" or "fitted".
///     backlash: Backlash of each mesh along the normal, mm.
///     sun: Body of the sun.
///     intermediate: Body of the intermediate gears.
///     planet: Body of the planets.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule; PitchError, GearPairError and MechanismError where it cannot exist.
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
