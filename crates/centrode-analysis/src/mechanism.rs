use centrode_mechanism::mechanism::Mechanism;

use crate::feeder::check_strokes;
use crate::three_arm::check_arms;
use crate::{Report, check, check_feeder, check_moving_box, check_shaft, check_three_arm};

/// Checks a mechanism of whatever family.
#[must_use]
pub fn check_mechanism(mechanism: &Mechanism) -> Report {
    match mechanism {
        Mechanism::GearPair(pair) => check(pair),
        Mechanism::ThreeArm(mechanism) => check_three_arm(mechanism),
        Mechanism::SpiralShaft(shaft) => check_shaft(shaft),
        Mechanism::MovingBox(machine) => check_moving_box(machine),
        Mechanism::Feeder(machine) => check_feeder(machine),
    }
}

/// As [`check_mechanism`], but without what every tooth, and of a three-arm mechanism the cams, are asked for: goals, figures
/// and findings of the motion, some ten times sooner.
#[must_use]
pub fn check_motion(mechanism: &Mechanism) -> Report {
    match mechanism {
        Mechanism::ThreeArm(mechanism) => check_arms(mechanism),
        Mechanism::Feeder(feeder) => check_strokes(feeder),
        other => check_mechanism(other),
    }
}
