//! Checks and searches of a mechanism: contact, clearance, undercut, goals.

mod arm_clearance;
mod check;
mod contact;
mod feeder;
mod figure;
mod gear_train;
mod goal;
mod incomplete_contact;
pub mod interference;
mod kinetostatics;
pub mod optimise;
mod pusher;
mod remedy;
mod report;
mod response;
mod shaft;
mod swing_spread;
mod three_arm;
mod variants;

pub use arm_clearance::{ArmClearance, ArmClearanceCourse, ArmClearanceError, between_arms};
pub use check::{check, check_contact};
pub use contact::Contact;
pub use feeder::{Attainable, FeederForces, FeederForcesError, check_feeder, check_strokes};
pub use figure::Figure;
pub use gear_train::{TrainTeeth, carrier_turn};
pub use goal::Goal;
pub use incomplete_contact::IncompleteContact;
pub use kinetostatics::{CrankMotion, ForceError, Forces, Kinetostatics, LinkMass, Load, Reaction};
pub use report::{Finding, Place, Report, Severity, Table};
pub use response::{Answer, Response};
pub use shaft::{check_moving_box, check_shaft};
pub use swing_spread::{SixBarTolerances, SwingSpread};
pub use three_arm::{
    arm_clearance_course, check_arms, check_three_arm, check_three_arm_teeth, goals,
};
pub use variants::{Variants, VariantsError};
