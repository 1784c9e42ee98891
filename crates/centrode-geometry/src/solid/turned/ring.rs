use std::f64::consts::{PI, TAU};

use super::{Turned, TurnedSection};
use crate::solid::{ShellBuilder, ShellSide, ShellSurface};

/// Circle about the axis with the vertices on it.
pub(super) struct Ring {
    pub(super) radius: f64,
    pub(super) height: f64,
    vertices: Vec<usize>,
}

impl Ring {
    pub(super) fn new(
        builder: &mut ShellBuilder,
        angles: &[f64],
        radius: f64,
        height: f64,
    ) -> Self {
        let at = |angle: &f64| {
            let (sin, cos) = angle.sin_cos();
            [radius * cos, radius * sin, height]
        };
        Self {
            radius,
            height,
            vertices: angles.iter().map(|a| builder.vertex(at(a))).collect(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }

    pub(super) fn at(&self, i: usize) -> usize {
        self.vertices[i % self.len()]
    }

    /// Number of its last vertex.
    pub(super) fn last(&self) -> usize {
        self.len() - 1
    }

    /// The arc from a vertex to the next.
    pub(super) fn arc(&self, builder: &mut ShellBuilder, i: usize) -> ShellSide {
        builder.arc(self.at(i), self.at(i + 1), self.radius)
    }

    /// Arcs but the last, which a slot has its place under, counter-clockwise seen from above.
    pub(super) fn beside_slot(&self, builder: &mut ShellBuilder) -> Vec<ShellSide> {
        (0..self.last()).map(|i| self.arc(builder, i)).collect()
    }

    /// All arcs, counter-clockwise seen from above.
    pub(super) fn round(&self, builder: &mut ShellBuilder) -> Vec<ShellSide> {
        (0..self.len()).map(|i| self.arc(builder, i)).collect()
    }
}

impl Turned {
    /// Angles of the vertices of a circle: quarters, or, where it holds the slot, from its upper edge round to its lower one,
    /// the last arc the one over the slot.
    pub(super) fn angles(&self, radius: f64) -> Vec<f64> {
        let slot = self.slot.filter(|_| self.edge(radius).is_some());
        match slot {
            None => (0..4).map(|i| 0.5 * PI * f64::from(i)).collect(),
            Some(slot) => {
                let edge = (0.5 * slot.width / radius).asin();
                let step = (TAU - 2.0 * edge) / 4.0;
                (0..=4).map(|i| edge + step * f64::from(i)).collect()
            }
        }
    }
}

/// Cylinder or cone of a section from a height on.
pub(super) fn surface(section: &TurnedSection, bottom: f64) -> ShellSurface {
    let [low, high] = section.radii;
    if low == high {
        return ShellSurface::Cylinder { radius: low };
    }
    let widens = high > low;
    ShellSurface::Cone {
        height: if widens {
            bottom
        } else {
            bottom + section.length
        },
        radius: section.least(),
        widens,
    }
}

/// A bound seen from the side `way` points to.
pub(super) fn seen(mut bound: Vec<ShellSide>, way: f64) -> Vec<ShellSide> {
    if way < 0.0 {
        bound = bound.into_iter().rev().map(ShellBuilder::back).collect();
    }
    bound
}

/// Plane across the axis.
pub(super) fn flat(height: f64, way: f64) -> ShellSurface {
    ShellSurface::Plane {
        point: [0.0, 0.0, height],
        normal: [0.0, 0.0, way],
    }
}
