//! Families of machine: the one list of them, and the parts of the lower crates that each binds.
//!
//! An entry of [`FAMILIES`] makes a [`Mechanism`] of a design file; through it every program checks a machine, draws it, writes
//! its files and searches a better one without the name of a family. Here, too, a panic becomes an [`InternalFault`].
//! It may not know: the command line, the design page, its server, Python, or how any file is laid out.

mod contact;
mod feeder;
mod gear_pair;
mod handles;
mod internal_fault;
mod limit;
mod machine;
mod mechanism;
mod moving_box;
mod open;
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
