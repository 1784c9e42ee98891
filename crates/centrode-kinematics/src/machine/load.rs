use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Quantity;

/// Standard acceleration of free fall, mm/s².
pub const STANDARD_GRAVITY: f64 = 9806.65;

/// A load on a machine next to the weight and inertia of its links.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Load {
    /// A force at a point of a link.
    Force {
        /// Index of the link.
        link: usize,
        /// Point of action in the link's frame, mm.
        at: [f64; 3],
        /// Components along x, y, z, N.
        force: [Quantity; 3],
        /// Axes of the components.
        axes: Axes,
    },
    /// A torque on a link.
    Torque {
        /// Index of the link.
        link: usize,
        /// Components about x, y, z, N mm.
        torque: [Quantity; 3],
        /// Axes of the components.
        axes: Axes,
    },
    /// A mass that a link carries at a point: it adds weight and inertia.
    Mass {
        /// Index of the link.
        link: usize,
        /// Place in the link's frame, mm.
        at: [f64; 3],
        /// Mass, kg.
        mass: f64,
    },
    /// A force along the axis of a joint (N), or a torque about it (N mm), on the link carried and back on the one that
    /// carries: a spring, a brake, the friction of a rail.
    Joint {
        /// Index of the joint.
        joint: usize,
        /// Size, positive where it drives the coordinate up.
        effort: Quantity,
    },
}

/// Axes of the components of a load.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axes {
    /// Those of the first link's frame, which is fixed.
    #[default]
    World,
    /// Those of the loaded link's own frame.
    Link,
}

impl Load {
    /// The quantities that define its size.
    #[must_use]
    pub fn sizes(&self) -> &[Quantity] {
        match self {
            Self::Force { force: all, .. } | Self::Torque { torque: all, .. } => all,
            Self::Joint { effort, .. } => std::slice::from_ref(effort),
            Self::Mass { .. } => &[],
        }
    }

    /// The quantities that define its size, to be replaced.
    pub fn sizes_mut(&mut self) -> &mut [Quantity] {
        match self {
            Self::Force { force: all, .. } | Self::Torque { torque: all, .. } => all,
            Self::Joint { effort, .. } => std::slice::from_mut(effort),
            Self::Mass { .. } => &mut [],
        }
    }

    /// Numbers of the load that must be finite.
    pub(super) fn numbers(&self) -> &[f64] {
        match self {
            Self::Force { at, .. } => at,
            Self::Mass { at, .. } => at,
            Self::Torque { .. } | Self::Joint { .. } => &[],
        }
    }
}
