use std::f64::consts::{PI, TAU};

use super::{Turned, TurnedSection};
use crate::solid::{ShellBuilder, ShellSide, ShellSurface};

/// Circle about the axis with its vertices.
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

    /// Vertex `i`, counted on around the circle.
    pub(super) fn at(&self, i: usize) -> usize {
        self.vertices[i % self.len()]
    }

    /// Index of its last vertex.
    pub(super) fn last(&self) -> usize {
        self.len() - 1
    }

    /// The arc from a vertex to the next.
    pub(super) fn arc(&self, builder: &mut ShellBuilder, i: usize) -> ShellSide {
        builder.arc(self.at(i), self.at(i + 1), self.radius)
    }

    /// All arcs except the last, which lies over a slot; counter-clockwise seen from above.
    pub(super) fn arcs_outside_slot(&self, builder: &mut ShellBuilder) -> Vec<ShellSide> {
        (0..self.last()).map(|i| self.arc(builder, i)).collect()
    }

    /// All arcs, counter-clockwise seen from above.
    pub(super) fn all_arcs(&self, builder: &mut ShellBuilder) -> Vec<ShellSide> {
        (0..self.len()).map(|i| self.arc(builder, i)).collect()
    }
}

impl Turned {
    /// Angles of the vertices of a circle, rad: quarters of a turn, or, if it contains the slot, from one edge of the slot around
    /// to the other. The last arc is then the one over the slot.
    pub(super) fn angles(&self, radius: f64) -> Vec<f64> {
        let slot = self.slot.filter(|_| self.edge_distance(radius).is_some());
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

/// Cylinder or cone of a section that begins at the height `bottom`, mm.
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
        radius: section.minimum_radius(),
        widens,
    }
}

/// A bound, reversed if `sign` is negative: counter-clockwise seen against a normal of that sign.
pub(super) fn oriented(mut bound: Vec<ShellSide>, sign: f64) -> Vec<ShellSide> {
    if sign < 0.0 {
        bound = bound.into_iter().rev().map(ShellSide::reversed).collect();
    }
    bound
}

/// Plane across the axis; its normal points up for `sign` = 1 and down for -1.
pub(super) fn plane_across(height: f64, sign: f64) -> ShellSurface {
    ShellSurface::Plane {
        point: [0.0, 0.0, height],
        normal: [0.0, 0.0, sign],
    }
}
