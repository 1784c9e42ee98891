use nalgebra::{Rotation3, Translation3, Vector3};

use super::{FrameJet, Joint, JointKind, Machine, PointJet, Quantity};
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
}

impl Machine {
    /// Where every link stands at an input, in the first link's frame, with derivatives by the input.
    #[must_use]
    pub fn pose(&self, input: f64) -> Vec<FrameJet> {
        let mut frames: Vec<Option<FrameJet>> = vec![None; self.links.len()];
        if let Some(first) = frames.first_mut() {
            *first = Some(FrameJet::identity());
        }
        // A joint may stand before the one that carries its parent: one more pass for each link in the way.
        for _ in 0..self.joints.len() {
            let mut open = false;
            for joint in &self.joints {
                if frames[joint.child].is_some() {
                    continue;
                }
                match frames[joint.parent] {
                    None => open = true,
                    Some(parent) => {
                        let own = joint.frame(&joint.law.at(input));
                        frames[joint.child] = Some(parent.then(&own));
                    }
                }
            }
            if !open {
                break;
            }
        }
        let found = frames.into_iter();
        found
            .map(|frame| frame.unwrap_or_else(FrameJet::identity))
            .collect()
    }

    /// A point at an input, in the first link's frame.
    #[must_use]
    pub fn point(&self, point: usize, input: f64) -> PointJet {
        let point = &self.points[point];
        self.link_frame(point.link, input).point(point.at)
    }

    /// One link at an input: only the joints that carry it are worked out.
    #[must_use]
    pub fn link_frame(&self, link: usize, input: f64) -> FrameJet {
        let carrier = self.joints.iter().find(|joint| joint.child == link);
        match carrier {
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
