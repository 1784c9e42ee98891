//! Intermittent (incomplete) gears: a driver with teeth on an arc alone, and the motion and rest it gives its mate.

mod drive;
mod pair;
mod radial;
mod spec;

pub use drive::{IncompleteDrive, IncompleteError};
pub use pair::{Cam, IncompleteLaw, IncompletePair};
pub use spec::{IncompletePairError, IncompletePairSpec, Pins};

#[cfg(test)]
mod tests;
