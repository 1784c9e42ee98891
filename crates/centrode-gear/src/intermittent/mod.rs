//! Intermittent gears: a driver with teeth on an arc of its rim, and the motion and dwell of its mate.

mod cams;
mod drive;
mod law;
mod pair;
mod radial;
mod spec;

pub use cams::Cam;
pub use drive::{IntermittentDrive, IntermittentError};
pub use law::IntermittentLaw;
pub use pair::IntermittentPair;
pub use spec::{IntermittentPairError, IntermittentPairSpec, Pins};

#[cfg(test)]
mod tests;
