//! Spiral shafts: the law of a slider that moves back and forth at given speeds, its groove, and the moving box.
//!
//! The shaft turns by `theta` and moves the slider along its axis, z. Lengths are mm, angles rad, velocities mm per
//! radian of shaft turn.
//!
//! After M. L. Zhou et al., "New type of transverse moving box mechanism for pot seedling transplanting machine", 2018,
//! DOI 10.25165/j.ijabe.20181102.2867. Its equations are cited by their numbers, and derived again where they are
//! wrong.
//!
//! The crate knows no other machine, checks nothing and writes no file.

mod crossing;
mod design;
mod elliptic;
mod error;
mod force;
mod groove;
mod law;
mod moving_box;
mod pin;
mod published;
mod reversal;
mod schedule;
mod slider;
mod solid;
mod spiral_shaft;
mod tool_path;
mod traverse;

pub use crossing::{ClearOffset, Crossing};
pub use design::{GrooveSpec, SpiralShaftDesign};
pub use elliptic::EllipticDrive;
pub use error::ShaftError;
pub use force::{ForceRange, GRAVITY, Load};
pub use groove::{Groove, Wall};
pub use law::{
    AmplitudeFor, RotatedSine, ShaftLaw, Sine, SpeedFormula, SpeedKnots, SpeedLaw, SpeedTable,
};
pub use moving_box::{EllipticGears, MovingBox, MovingBoxDesign, Scheme};
pub use published::PublishedForce;
pub use reversal::Reversal;
pub use schedule::{Pick, Schedule, Way};
pub use slider::SliderSpec;
pub use solid::{ShaftBody, ShaftSolid};
pub use spiral_shaft::SpiralShaft;
pub use tool_path::Mill;
pub use traverse::Traverse;

#[cfg(test)]
mod tests;
