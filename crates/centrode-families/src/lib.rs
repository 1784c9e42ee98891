//! Families of machine: the only list of them, and access to the modules of each family in the lower crates.
//!
//! An entry of [`FAMILIES`] makes a [`Mechanism`] from a design file. Programs use the mechanism to check a machine,
//! draw it, write its files and search for a better one, independently of its family. This crate also converts a panic
//! to an [`InternalFault`].
//! It may not know: the command line, the design page, its server, Python, or how any file is laid out.

mod contact;
mod feeder;
mod figure_goals;
mod gear_pair;
mod handles;
mod internal_fault;
mod limit;
mod machine;
mod mechanism;
mod moving_box;
mod open;
mod passing;
mod proofs;
mod registry;
mod spiral_shaft;
#[cfg(test)]
mod tests;
mod three_arm;
mod widening;

pub use internal_fault::InternalFault;
pub use limit::Limit;
pub use mechanism::{Depth, FINEST, Mechanism};
pub use open::OpenDesign;
pub use proofs::{NotProved, Proved};
pub use registry::{Families, Family, PartName, Resolved};
pub use widening::{Widening, WideningError};

use centrode_gear::GearPair;
use centrode_groove::{MovingBox, SpiralShaft};
use centrode_machines::feeder::Feeder;
use centrode_machines::machine::Machine;
use centrode_machines::three_arm::ThreeArm;

/// Every family there is.
pub static FAMILIES: Families = Families(&[
    Family::new::<GearPair>(),
    Family::new::<ThreeArm>(),
    Family::new::<SpiralShaft>(),
    Family::new::<MovingBox>(),
    Family::new::<Feeder>(),
    Family::new::<Machine>(),
]);
