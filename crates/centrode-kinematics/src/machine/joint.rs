use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Constant, plain};
use crate::transmission::Transmission;

/// Component of an axis, or turn in rad, that counts as zero: a direction in the drawing plane or along its normal.
const PLANE: f64 = 1e-12;

/// Connection of a link to the one that carries it, and its motion there.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Index of the link that carries.
    pub parent: usize,
    /// Index of the link carried.
    pub child: usize,
    /// How it moves.
    pub kind: JointKind,
    /// Place of the child's origin in the parent's frame where the coordinate is zero, mm.
    pub origin: [f64; 3],
    /// Turn of the child's frame there about the parent's x, then y, then z, rad.
    pub turn: [f64; 3],
    /// Unit vector of the axis in the child's frame.
    pub axis: [f64; 3],
    /// The coordinate by the input: rad about the axis, or mm along it.
    #[serde(with = "plain::laws")]
    #[schemars(with = "plain::laws::File")]
    pub law: Arc<dyn Transmission>,
    /// Index of the joint whose position determines the position of this one through a cam or groove; `None` if the input does.
    pub leader: Option<usize>,
    /// Column of the torque that resists this joint, N mm.
    pub load: Option<usize>,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum JointKind {
    /// Not at all.
    #[default]
    Fixed,
    /// Turning without end.
    Turning,
    /// Sliding between two values of its coordinate, mm.
    Sliding([f64; 2]),
}

impl Joint {
    /// A joint that carries a link with its frame on the parent's, and does not move.
    #[must_use]
    pub fn fixed(parent: usize, child: usize) -> Self {
        Self {
            parent,
            child,
            kind: JointKind::Fixed,
            origin: [0.0; 3],
            turn: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            law: Arc::new(Constant(0.0)),
            leader: None,
            load: None,
        }
    }

    /// A pin along z.
    #[must_use]
    pub fn turning(parent: usize, child: usize, law: Arc<dyn Transmission>) -> Self {
        Self {
            kind: JointKind::Turning,
            law,
            ..Self::fixed(parent, child)
        }
    }

    /// A slide along an axis of the child, between two values of its coordinate, mm.
    #[must_use]
    pub fn sliding(
        parent: usize,
        child: usize,
        axis: [f64; 3],
        range: [f64; 2],
        law: Arc<dyn Transmission>,
    ) -> Self {
        Self {
            kind: JointKind::Sliding(range),
            axis,
            law,
            ..Self::fixed(parent, child)
        }
    }

    /// The joint with the child's origin at a point of the parent, mm.
    #[must_use]
    pub fn at(self, origin: [f64; 3]) -> Self {
        Self { origin, ..self }
    }

    /// The joint with the child's frame turned about the parent's x, then y, then z, rad.
    #[must_use]
    pub fn turned(self, turn: [f64; 3]) -> Self {
        Self { turn, ..self }
    }

    /// Whether it keeps the carried link in the plane of the one that carries it: it turns about z, or slides square to z.
    #[must_use]
    pub fn is_planar(&self) -> bool {
        let [x, y, z] = self.axis.map(|along| along.abs() <= PLANE);
        let flat = self.turn[..2].iter().all(|turn| turn.abs() <= PLANE);
        flat && match self.kind {
            JointKind::Fixed => true,
            JointKind::Turning => x && y,
            JointKind::Sliding(_) => z,
        }
    }

    /// The joint that follows another one through a cam or a groove.
    #[must_use]
    pub fn led_by(self, leader: usize) -> Self {
        Self {
            leader: Some(leader),
            ..self
        }
    }
}
