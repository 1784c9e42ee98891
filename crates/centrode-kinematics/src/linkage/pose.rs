use centrode_geometry::{Jet, Point};

use super::parts::{JointId, LinkId};
use super::point_series::PointSeries;
use crate::formula::Taylor;
use crate::transmission::MotionJet;

/// Position and motion of all joints and links.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    pub(super) joints: Vec<Jet>,
    pub(super) bodies: Vec<BodyMotion>,
}

/// A link's motion: a point of it and its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion {
    /// Origin of the link's axes.
    pub origin: Jet,
    /// Direction of its first axis, principal value, rad.
    pub angle: MotionJet,
}

impl BodyMotion {
    /// A point of the link given in its own axes, mm.
    #[must_use]
    pub fn point(&self, local: Point) -> Jet {
        let angle = Taylor::<4>([
            self.angle.position,
            self.angle.velocity,
            0.5 * self.angle.acceleration,
            self.angle.jerk / 6.0,
        ]);
        let way = PointSeries::unit(angle).turned(local.coords).jet();
        Jet {
            point: self.origin.point + way.point.coords,
            first: self.origin.first + way.first,
            second: self.origin.second + way.second,
            third: self.origin.third + way.third,
        }
    }
}

impl Pose {
    /// A joint's motion.
    ///
    /// # Panics
    /// Never for a joint of the linkage that made this pose.
    #[must_use]
    pub fn joint(&self, joint: JointId) -> Jet {
        self.joints[joint.0]
    }

    /// A link's motion.
    ///
    /// # Panics
    /// Never for a link of the linkage that made this pose.
    #[must_use]
    pub fn body(&self, link: LinkId) -> BodyMotion {
        self.bodies[link.0]
    }

    /// Every joint, in the order of building.
    #[must_use]
    pub fn joints(&self) -> &[Jet] {
        &self.joints
    }

    /// Every link, the frame first.
    #[must_use]
    pub fn bodies(&self) -> &[BodyMotion] {
        &self.bodies
    }
}
