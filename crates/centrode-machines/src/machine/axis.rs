//! Axes of gears and cams in the axes of the body that carries the parts they move.

use centrode_geometry::Point;
use nalgebra::Isometry2;

use super::gears::mesh::Angle;
use super::resolve::Builder;
use super::{BodyPoint, Mount};
use centrode_kinematics::machine::JointKind;

impl Mount {
    /// Pose of the joint's axes in the carrier's axes.
    pub(super) fn seat(&self) -> Isometry2<f64> {
        Isometry2::new(self.at.coords, self.angle)
    }
}

impl Builder<'_> {
    /// Angle of a body as a function of the input, from the joints that carry it, without jumps of whole turns.
    pub(super) fn angle(&self, body: usize) -> Angle {
        let Some(mount) = &self.bodies[body].mount else {
            return Angle::default();
        };
        let mut angle = self.angle(mount.carrier).plus(mount.angle);
        if mount.kind == JointKind::Turning {
            angle.terms.push(std::sync::Arc::clone(&mount.law));
        }
        angle
    }

    /// Position of a point of a body in the axes of `carrier`, if the point does not move there by more than `size`, mm; `None`
    /// if it moves.
    pub(super) fn axis_on(&self, carrier: usize, mut point: BodyPoint, size: f64) -> Option<Point> {
        loop {
            if let Some(found) = self.down(carrier, point, size) {
                return Some(found);
            }
            // The same point on the body below: the joint of a fixed body, or the pin on which a body turns.
            let mount = self.bodies[point.body].mount.as_ref()?;
            point.at = match mount.kind {
                JointKind::Fixed => mount.seat() * point.at,
                JointKind::Turning if point.at.coords.norm() <= size => mount.at,
                _ => return None,
            };
            point.body = mount.carrier;
        }
    }

    /// Position of a point in the axes of `carrier`, a body that the point's body carries; `None` if the point moves there.
    fn down(&self, carrier: usize, point: BodyPoint, size: f64) -> Option<Point> {
        if carrier == point.body {
            return Some(point.at);
        }
        let mount = self.bodies[carrier].mount.as_ref()?;
        let below = self.down(mount.carrier, point, size)?;
        match mount.kind {
            JointKind::Fixed => Some(mount.seat().inverse() * below),
            JointKind::Turning if (below - mount.at).norm() <= size => Some(Point::origin()),
            _ => None,
        }
    }
}
