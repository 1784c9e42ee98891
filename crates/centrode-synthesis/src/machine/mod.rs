//! Composed machines made from paths, and gears that drive a machine's crank.

mod driven;
mod reversed;

pub use driven::{GearDrive, GearDriveError, GearDriveSpec};
pub use reversed::{ReversedMachine, ReversedMachineError};
pub(crate) use reversed::{free_backlash, free_body};
