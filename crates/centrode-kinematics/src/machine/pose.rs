use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::{FrameJet, Joint, JointKind, LinkedMachine, PointJet, Quantity};
use crate::transmission::MotionJet;

impl Joint {
    /// The child's frame in the parent's at a coordinate.
    #[must_use]
    pub fn frame(&self, coordinate: &MotionJet) -> FrameJet {
        let [x, y, z] = self.turn;
        let place = Translation3::from(self.origin).to_homogeneous()
            * Rotation3::from_euler_angles(x, y, z).to_homogeneous();
        let axis = Vector3::from(self.axis);
        let moved = match self.kind {
            JointKind::Fixed => return FrameJet::still(place),
            JointKind::Turning => FrameJet::turn(axis, coordinate),
            JointKind::Sliding(_) => FrameJet::slide(axis, coordinate),
        };
        FrameJet::still(place).then(&moved)
    }

    /// The child's pose in the parent's frame at a coordinate.
    #[must_use]
    pub fn place(&self, coordinate: f64) -> Isometry3<f64> {
        let [x, y, z] = self.turn;
        let turn = UnitQuaternion::from_euler_angles(x, y, z);
        let place = Isometry3::from_parts(self.origin.into(), turn);
        let axis = Vector3::from(self.axis);
        match self.kind {
            JointKind::Fixed => place,
            JointKind::Turning => place * UnitQuaternion::from_scaled_axis(axis * coordinate),
            JointKind::Sliding(_) => place * Translation3::from(axis * coordinate),
        }
    }
}

impl LinkedMachine {
    /// Pose of every link at an input, in the first link's frame, with derivatives by the input.
    #[must_use]
    pub fn pose(&self, input: f64) -> Vec<FrameJet> {
        let own = |joint: &Joint| joint.frame(&joint.law.at(input));
        let frames = self.hung(FrameJet::identity(), |parent, joint| {
            parent.then(&own(joint))
        });
        let found = frames.into_iter();
        found
            .map(|frame| frame.unwrap_or_else(FrameJet::identity))
            .collect()
    }

    /// Poses of links at an input, in the first link's frame, without derivatives; `None` for links that are not required.
    #[must_use]
    pub fn places(&self, input: f64, required: &[bool]) -> Vec<Option<Isometry3<f64>>> {
        self.hung(Isometry3::identity(), |parent, joint| {
            let requested = required.get(joint.child) == Some(&true);
            requested.then(|| parent * joint.place(joint.law.at(input).position))
        })
    }

    /// A value for each link, computed from that of the link that carries it; `first` is that of the first link. A link without a
    /// value leaves `None` for all links that it carries.
    fn hung<T, U: Into<Option<T>>>(
        &self,
        first: T,
        next: impl Fn(&T, &Joint) -> U,
    ) -> Vec<Option<T>> {
        let mut all: Vec<Option<T>> = self.links.iter().map(|_| None).collect();
        if let Some(own) = all.first_mut() {
            *own = Some(first);
        }
        // A joint may be listed before the one that carries its parent: each pass then adds at least one link.
        for _ in 0..self.joints.len() {
            let mut open = false;
            for joint in &self.joints {
                if all[joint.child].is_some() {
                    continue;
                }
                match &all[joint.parent] {
                    None => open = true,
                    Some(parent) => all[joint.child] = next(parent, joint).into(),
                }
            }
            if !open {
                break;
            }
        }
        all
    }

    /// A point at an input, in the first link's frame.
    #[must_use]
    pub fn point(&self, point: usize, input: f64) -> PointJet {
        let point = &self.points[point];
        self.link_frame(point.link, input).point(point.at)
    }

    /// Joints that carry a link, the nearest first.
    pub fn carriers(&self, link: usize) -> impl Iterator<Item = &Joint> {
        let of = |link: usize| self.joints.iter().find(|joint| joint.child == link);
        let all = std::iter::successors(of(link), move |joint| of(joint.parent));
        // In a valid machine no joint comes twice.
        all.take(self.joints.len())
    }

    /// One link at an input: only the joints that carry it are computed.
    #[must_use]
    pub fn link_frame(&self, link: usize, input: f64) -> FrameJet {
        match self.carriers(link).next() {
            None => FrameJet::identity(),
            Some(joint) => {
                let own = joint.frame(&joint.law.at(input));
                self.link_frame(joint.parent, input).then(&own)
            }
        }
    }

    /// A quantity at an input.
    #[must_use]
    pub fn value(&self, quantity: &Quantity, input: f64) -> f64 {
        match quantity {
            Quantity::Input(factor) => factor * input,
            Quantity::Joint {
                joint,
                order,
                factor,
            } => {
                let jet = self.joints[*joint].law.at(input);
                factor
                    * match order {
                        0 => jet.position,
                        1 => jet.velocity,
                        2 => jet.acceleration,
                        _ => jet.jerk,
                    }
            }
            Quantity::Point { point, axis } => self.point(*point, input).position[*axis],
            Quantity::PointSpeed { point, factor } => {
                factor * self.point(*point, input).velocity.norm()
            }
            Quantity::Law(law) => law.at(input).position,
        }
    }

    /// Growth of a quantity over one period of the input.
    #[must_use]
    pub fn advance(&self, quantity: &Quantity) -> f64 {
        match quantity {
            Quantity::Input(factor) => factor * self.input.period,
            Quantity::Joint {
                joint,
                order: 0,
                factor,
            } => {
                let law = &self.joints[*joint].law;
                factor * law.advance() * (self.input.period / law.period()).round()
            }
            Quantity::Law(law) => law.advance() * (self.input.period / law.period()).round(),
            _ => 0.0,
        }
    }
}
