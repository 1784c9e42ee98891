//! Disc cams: motion laws, follower motion, exact profile.

pub mod design;
mod extreme;
pub mod law;
mod motion;

pub use extreme::Extreme;
pub use motion::{Join, Motion, MotionError, Peaks};
