use centrode_gear::FlankCount;
use centrode_machines::three_arm::design::GoalsSpec;
use centrode_machines::three_arm::{Figures, ThreeArm};

use super::ArmClearance;
use crate::{Goal, Unit};

/// Goals of a mechanism with the values of its figures. The goals of arms, seedlings and flanks have no values yet.
#[must_use]
pub fn three_arm_goals(figures: &Figures, required: &GoalsSpec) -> Vec<Goal> {
    let angle = |number, name, title, value: f64, required: [f64; 2]| {
        Goal::new(number, name, title, Unit::Angle)
            .range(required.map(Some), required[1] - required[0])
            .with(value)
    };
    // If any clearance is enough, the scale is the paper's own clearance of 20 mm.
    let size = |required: f64| if required > 0.0 { required } else { 20.0 };
    let length = |number, name, title, value: Option<f64>, required: f64| {
        Goal::new(number, name, title, Unit::Millimetre)
            .minimum(required, size(required))
            .with(value)
    };
    Goal::listed(vec![
        length(
            1,
            "arm-clearance",
            "clearance between arms",
            None,
            required.arm_clearance,
        ),
        angle(
            2,
            "pick-angle",
            "clamp above horizontal at picking",
            figures.pick_angle,
            required.pick_angle,
        ),
        angle(
            3,
            "push-angle",
            "clamp below horizontal at planting",
            figures.push_angle,
            required.push_angle,
        ),
        angle(
            4,
            "angle-difference",
            "turn from picking to planting",
            figures.angle_difference,
            required.angle_difference,
        ),
        length(
            5,
            "seedling-clearance",
            "clearance from planted seedlings",
            None,
            required.seedling_clearance,
        ),
        length(
            6,
            "gearbox-clearance",
            "height of gearbox above ground",
            Some(figures.gearbox_clearance),
            required.gearbox_clearance,
        ),
        length(
            7,
            "trajectory-height",
            "height of the trajectory",
            Some(figures.trajectory_height),
            required.trajectory_height,
        ),
        length(8, "module", "module", figures.module, required.module),
        Goal::new(
            8,
            "sound-teeth",
            "undercut or short full-height flanks",
            Unit::Count,
        )
        .maximum(0.0, 10.0),
    ])
}

pub(super) fn all_goals(
    mechanism: &ThreeArm,
    arms: Option<&ArmClearance>,
    teeth: Option<&[FlankCount; 2]>,
) -> Vec<Goal> {
    let mut goals = three_arm_goals(&mechanism.figures(), &mechanism.design().goals);
    for goal in &mut goals {
        let value = match &*goal.name {
            "arm-clearance" => match arms.and_then(|found| found.arms) {
                Some(found) => found.minimum,
                None => continue,
            },
            "seedling-clearance" => mechanism.seedling_clearance().value,
            "sound-teeth" => match teeth {
                Some(teeth) => f64::from(teeth.iter().map(|t| t.unsound).sum::<u32>()),
                None => continue,
            },
            _ => continue,
        };
        *goal = goal.clone().with(value);
    }
    goals
}
