//! Contacts that the driven gear reaches when it turns about its axis.

use centrode_geometry::{Point, Vector};

use super::meeting_points::MeetingPoints;
use crate::contact::contour::Pose;

/// Contact at which the gears meet when the driven gear turns.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct AngularContact {
    /// Rotation of the driven gear from the first pose, rad.
    pub(in crate::contact) turn: f64,
    /// Distance of the driven axis from the common normal, mm.
    pub(in crate::contact) lever: f64,
    /// Parts of driver and driven gear.
    pub(in crate::contact) parts: (usize, usize),
    /// Whether a corner of the driver touches.
    pub(super) at_corner: bool,
    pub(super) meeting: MeetingPoints,
}

/// Point of contact on the driver and the driver's outward normal there, in the driver's axes.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct ContactNormal {
    pub(in crate::contact) point: Point,
    pub(in crate::contact) normal: Vector,
}

impl AngularContact {
    /// Parameters on the two parts.
    pub(in crate::contact) fn parameters(&self) -> (f64, f64) {
        (self.meeting.driver.u, self.meeting.driven.u)
    }

    /// Tangents at the contact: the driver's, and the driven gear's after its rotation.
    pub(in crate::contact) fn tangents(&self) -> [Vector; 2] {
        let ((sin, cos), t) = (self.turn.sin_cos(), self.meeting.driven.tangent);
        let turned = Vector::new(cos * t.x - sin * t.y, sin * t.x + cos * t.y);
        [self.meeting.driver.tangent, turned]
    }

    /// The contact on the driver.
    pub(super) fn contact_normal(&self, pose: &Pose) -> ContactNormal {
        let [on_driver, on_driven] = self.tangents();
        let tangent = [on_driver, -on_driven][usize::from(self.at_corner)];
        let normal = Vector::new(tangent.y, -tangent.x) / tangent.norm();
        let point = Point::from(self.meeting.driver.point);
        ContactNormal {
            point: pose.point_to_driver(&point),
            normal: pose.vector_to_driver(&normal),
        }
    }
}
