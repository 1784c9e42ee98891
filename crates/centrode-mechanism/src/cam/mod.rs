//! Disc cams: motion laws, follower motion, exact profile.

mod extreme;
pub mod law;

pub use extreme::Extreme;
