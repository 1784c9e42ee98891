//! Disc cams: motion laws, follower motion, exact profile.

mod contact;
pub mod design;
mod disc;
pub(crate) mod extreme;
mod fork;
pub mod law;
mod limits;
mod motion;
mod part;
mod profile;

pub use contact::Contact;
pub use disc::{CamError, DiscCam};
pub use extreme::Extreme;
pub use fork::{Fork, Lever, RodJoint};
pub use limits::Limits;
pub use motion::{Join, Motion, MotionError, Peaks};
pub use part::Cam;
pub use profile::Profile;

#[cfg(test)]
mod tests;
