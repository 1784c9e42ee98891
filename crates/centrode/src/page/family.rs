//! What each family of mechanism shows of itself.

use centrode::analysis::{
    Contact, Report, TrainTeeth, check_contact, check_mechanism, check_three_arm_teeth,
};
use centrode::export::page::{Curve, Picture};
use centrode::mechanism::design::Design;
use centrode::mechanism::mechanism::Mechanism;

use super::{feeder, gear_pair, shaft, three_arm};

/// The picture that is there at once.
pub(super) fn picture(design: &Design, mechanism: &Mechanism) -> Picture {
    match mechanism {
        Mechanism::GearPair(pair) => gear_pair::picture(design, pair),
        Mechanism::ThreeArm(arms) => three_arm::picture(arms),
        Mechanism::SpiralShaft(part) => shaft::picture(part),
        Mechanism::MovingBox(machine) => shaft::box_picture(machine),
        Mechanism::Feeder(machine) => feeder::picture(machine),
    }
}

/// Whether that lacks what takes longer to make.
pub(super) fn is_coarse(mechanism: &Mechanism) -> bool {
    matches!(mechanism, Mechanism::ThreeArm(_) | Mechanism::Feeder(_))
}

/// The picture with what takes longer to make; `None` where nothing is left out at first, or nothing can be made.
pub(super) fn detailed(mechanism: &Mechanism) -> Option<Picture> {
    match mechanism {
        Mechanism::GearPair(_) | Mechanism::SpiralShaft(_) | Mechanism::MovingBox(_) => None,
        Mechanism::ThreeArm(arms) => three_arm::with_teeth(arms),
        Mechanism::Feeder(machine) => feeder::with_teeth(machine),
    }
}

/// The curves that are there at once.
pub(super) fn curves(mechanism: &Mechanism) -> Vec<Curve> {
    match mechanism {
        Mechanism::GearPair(pair) => centrode::export::gear_pair::curves(pair),
        Mechanism::ThreeArm(arms) => centrode::export::three_arm::curves(arms),
        Mechanism::SpiralShaft(part) => centrode::export::shaft::shaft_curves(part),
        Mechanism::MovingBox(machine) => shaft::box_curves(machine),
        Mechanism::Feeder(machine) => centrode::export::feeder::curves(machine),
    }
}

/// What the checks say, and the curves they leave.
pub(super) fn checked(mechanism: &Mechanism) -> (Report, Vec<Curve>) {
    match mechanism {
        Mechanism::GearPair(pair) => {
            let contact = Contact::of(pair);
            let curves = gear_pair::contact_curves(&contact);
            (check_contact(pair, &contact), curves)
        }
        Mechanism::ThreeArm(arms) => {
            let teeth = TrainTeeth::of(arms);
            let found = check_three_arm_teeth(arms, &teeth);
            (
                found,
                three_arm::checked_curves(arms, teeth.ok().flatten().as_ref()),
            )
        }
        Mechanism::Feeder(machine) => (check_mechanism(mechanism), feeder::checked_curves(machine)),
        Mechanism::SpiralShaft(_) | Mechanism::MovingBox(_) => {
            (check_mechanism(mechanism), Vec::new())
        }
    }
}
