//! Points at which the gears touch at one driver angle.
//!
//! Reading order:
//!
//! 1. `meshing`: the pair under analysis, with its search distances and its cache.
//! 2. `facing_points`: points of two parts with a common normal, by Newton's method.
//! 3. `proximity`: all such points in one pose.
//! 4. `meeting_points`, `angular_contact`: points that meet when the driven gear turns.
//! 5. `turn_search`: the first of these meetings.
//! 6. `seated_pose`: the driven gear turned until it rests on the driver.

mod angular_contact;
mod facing_points;
mod meeting_points;
mod meshing;
mod proximity;
mod seated_pose;
mod turn_search;

pub(super) use angular_contact::{AngularContact, ContactNormal};
pub(super) use facing_points::{Foot, facing_driven_corner, facing_driver_corner, foot};
pub(crate) use meshing::Meshing;
pub(super) use meshing::{FacingFlanks, has_complete_teeth};
#[cfg(test)]
pub(super) use proximity::CandidatePair;
pub(super) use proximity::{Proximity, ProximityKind, ROUNDED};
pub(super) use seated_pose::{SEATED, SeatedPose};
