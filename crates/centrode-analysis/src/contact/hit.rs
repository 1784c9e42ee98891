//! Points at which two gears meet when one of them turns.

use centrode_geometry::{Point, Vector};

use super::{meeting::Meeting, touch::Pose};

/// Contact at which the gears meet when the driven gear turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    /// Turn of the driven gear from the first pose, rad.
    pub(super) turn: f64,
    /// Distance of the driven axis from the common normal, mm.
    pub(super) lever: f64,
    /// Parts of driver and driven gear.
    pub(super) parts: (usize, usize),
    /// Whether a corner of the driver touches.
    pub(super) at_corner: bool,
    pub(super) meeting: Meeting,
}

impl Hit {
    /// Parameters on the two parts.
    pub(super) fn at(&self) -> (f64, f64) {
        (self.meeting.u, self.meeting.v)
    }

    /// Tangents there: the driver's, and the driven gear's as it is turned.
    pub(super) fn tangents(&self) -> [Vector; 2] {
        let ((sin, cos), t) = (self.turn.sin_cos(), self.meeting.driven.1);
        let turned = Vector::new(cos * t.x - sin * t.y, sin * t.x + cos * t.y);
        [self.meeting.driver.1, turned]
    }

    /// The point on the driver and its outward normal there, in the driver's axes.
    pub(super) fn touch(&self, pose: &Pose) -> (Point, Vector) {
        let [on_driver, on_driven] = self.tangents();
        let tangent = [on_driver, -on_driven][usize::from(self.at_corner)];
        let normal = Vector::new(tangent.y, -tangent.x) / tangent.norm();
        let point = pose.place(&Point::from(self.meeting.driver.0));
        (point, pose.turn(&normal))
    }
}
