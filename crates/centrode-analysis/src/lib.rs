//! Checks of a mechanism: contact of teeth, clearance, forces, undercut, goals.
//!
//! A check returns a [`Report`]: figures with units, and findings with measured value, limit, position in the cycle and
//! remedy. The contact analysis shares no code with the generator of the teeth. [`prove`] writes a certificate of the
//! contact for an independent checker. Only [`interference`] uses parry, for the distance of bodies.
//! The crate contains no drawings and no file formats, and changes no design.

mod cam;
mod contact;
mod feeder;
mod figure;
pub mod forces;
mod gear_pair;
mod goal;
pub mod interference;
mod intermittent_contact;
mod key_pressure;
mod machine;
mod no_screws;
mod progress;
mod report;
mod rounding;
mod severity;
mod shaft;
mod side_by_side;
pub mod six_bar;
mod sweep;
mod three_arm;
mod unit;

pub use contact::{
    Contact, ContactExtremes, Proof, ProofError, ProofMeeting, ProofStretch, SeatJump, prove,
};
pub use feeder::{
    Attainable, FIGURES as FEEDER_FIGURES, FeederForces, FeederForcesError, SixBarTolerances,
    SwingSpread, check_feeder, check_strokes, feeder_goals, six_bar_goals,
};
pub use figure::{FigureGroup, FigureRow, JsonNumber};
pub use gear_pair::{
    FIGURES as PAIR_FIGURES, MAX_TEETH, PairRemedy, SLIGHT_TRANSMISSION_ERROR, check,
    check_contact, check_made, check_planned, pitch_overlap, remedies,
};
pub use goal::Goal;
pub use intermittent_contact::IntermittentContact;
pub use machine::{
    NoSoundTeeth, SoundTeeth, check_machine, check_machine_goals, check_machine_motion,
    machine_clearance, machine_collisions, machine_figures, machine_goals, machine_layers,
    with_sound_teeth,
};
pub use progress::Progress;
pub use report::{Finding, FlankPlace, Place, Report, ReportFile, Table};
pub use severity::Severity;
pub use shaft::{FIGURES as SHAFT_FIGURES, check_moving_box, check_shaft};
pub use side_by_side::prepare_threads;
pub use sweep::{Answer, Sweep};
pub use three_arm::{
    ArmClearance, ArmClearanceCourse, ArmClearanceError, FIGURES as THREE_ARM_FIGURES, TrainTeeth,
    Variants, VariantsError, arm_clearance_course, between_arms, carrier_turn, check_arms,
    check_three_arm, check_three_arm_teeth, three_arm_goals, three_arm_reached,
};
pub use unit::Unit;
