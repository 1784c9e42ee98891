//! Machines: how bodies, gears, cams and dyads become links and joints.
//!
//! The general machine of a design file is in [`machine`]. The published families, with their arm, gear train and
//! six-bar, are in [`three_arm`], [`arm`] and [`feeder`].
//! The crate checks nothing, searches nothing and writes no file.

pub mod arm;
pub mod feeder;
pub mod machine;
mod pin_hole;
mod screw_room;
pub mod three_arm;

pub use pin_hole::PinHole;
