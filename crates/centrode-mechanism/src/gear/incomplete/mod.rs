//! Intermittent (incomplete) gears: a driver with teeth on an arc alone, and the motion and rest it gives its mate.

mod cams;
mod drive;
mod law;
mod pair;
mod radial;
mod spec;

pub use cams::Cam;
pub use drive::{IncompleteDrive, IncompleteError};
pub use law::IncompleteLaw;
pub use pair::IncompletePair;
pub use spec::{IncompletePairError, IncompletePairSpec, Pins};

#[cfg(test)]
mod tests;
