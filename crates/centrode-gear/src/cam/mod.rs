//! Disc cams: motion laws, follower motion, exact profile.

mod contact;
pub mod design;
mod disc;
mod fork;
pub mod law;
mod limits;
mod motion;
mod part;
mod profile;

pub use centrode_geometry::Extreme;
pub use contact::Contact;
pub use disc::{CamError, DiscCam};
pub use fork::{Fork, Lever, RodJoint};
pub use limits::Limits;
pub use motion::{Join, Motion, MotionError, Peaks};
pub use part::Cam;
pub use profile::Profile;

#[cfg(test)]
mod tests;
