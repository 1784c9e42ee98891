//! Synthesis of a machine from the required path of its tip.
//!
//! A carrier turns about a fixed axis and supports an arm, whose tip follows the path. Per cycle of the path the
//! carrier makes one turn, and the arm makes one turn relative to it in the opposite direction. The planet of a train
//! with a fixed sun and a mean ratio of 1 moves in this manner. The two bars are stretched once and folded once per
//! cycle, so the path and the axis determine their lengths.
//!
//! The module also has the synthesis of the law of a crank from the required output of its machine: [`Timing`].

mod chain;
mod csv;
mod curvature;
mod design;
mod distance;
mod drawn;
mod error;
mod limit;
mod map;
mod path;
mod poses;
mod sharpness;
mod split;
mod three_arm;
mod timing;
mod wishes;

pub use crate::machine::{
    GearDrive, GearDriveError, GearDriveSpec, ReversedMachine, ReversedMachineError,
};
pub use chain::{ChainJet, TwoBar};
pub use csv::RequiredPoints;
pub use design::{Aim, PathDesign, PathSpec};
pub use drawn::{DrawingError, DrawnPath};
pub use error::{AxisFault, PathError};
pub use map::{AxisMap, AxisRange, PossibleAxis};
pub use path::RequiredPath;
pub use poses::{Harmonics, KeyPose, KeyPoses, PoseError};
pub(crate) use sharpness::leg;
pub use split::{Split, SplitError, SplitKind};
pub use three_arm::NotPosed;
pub use timing::{Required, Section, Timing, TimingError};
pub use wishes::{KeepOut, RequiredDirection, RequiredRange, RequiredTurn, Wishes};

#[cfg(test)]
mod tests;
