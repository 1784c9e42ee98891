//! Synthesis of a machine from the path required of its tip.
//!
//! A carrier turns about a fixed axis and supports an arm, whose tip runs along the path. The carrier turns once for one run
//! of the path, and the arm turns once against it in the opposite direction, as the planet of a train does whose sun is fixed
//! and whose mean ratio is 1. Stretched once and folded once, the two bars follow from the path and the axis alone.
//!
//! And of the law of a crank from what is required of the output of the machine it drives: [`Timing`].

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
