use std::collections::HashMap;

use crate::solid::{Shell, ShellCurve, ShellEdge, ShellFace, ShellSide, ShellSurface};

/// A shell under construction. Faces share its vertices and edges.
#[derive(Debug, Default)]
pub struct ShellBuilder {
    shell: Shell,
    vertices: HashMap<[u64; 3], usize>,
    edges: HashMap<([usize; 2], EdgeKind), usize>,
}

/// Kind of curve, which distinguishes edges between the same ends.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
enum EdgeKind {
    Line,
    Arc,
    Bezier,
}

impl ShellBuilder {
    /// Index of the vertex at a position; a new one if there is none.
    pub fn vertex(&mut self, at: [f64; 3]) -> usize {
        let vertices = &mut self.shell.vertices;
        let key = at.map(|x| (x + 0.0).to_bits());
        *self.vertices.entry(key).or_insert_with(|| {
            vertices.push(at);
            vertices.len() - 1
        })
    }

    /// The edge between two vertices; an existing one if there is one, except for an arc in the opposite direction: that is
    /// another curve.
    fn edge(&mut self, from: usize, to: usize, kind: EdgeKind, curve: ShellCurve) -> ShellSide {
        if let Some(&edge) = self.edges.get(&([to, from], kind))
            && kind != EdgeKind::Arc
        {
            return ShellSide {
                edge,
                forward: false,
            };
        }
        let edges = &mut self.shell.edges;
        let edge = *self.edges.entry(([from, to], kind)).or_insert_with(|| {
            edges.push(ShellEdge {
                ends: [from, to],
                curve,
            });
            edges.len() - 1
        });
        ShellSide {
            edge,
            forward: true,
        }
    }

    /// Position of a vertex, mm.
    #[must_use]
    pub fn position(&self, vertex: usize) -> [f64; 3] {
        self.shell.vertices[vertex]
    }

    /// A straight edge from one vertex to another.
    pub fn line(&mut self, from: usize, to: usize) -> ShellSide {
        self.edge(from, to, EdgeKind::Line, ShellCurve::Line)
    }

    /// Straight edges through vertices, in order.
    pub fn lines(&mut self, through: &[usize]) -> Vec<ShellSide> {
        let mut sides = Vec::new();
        for pair in through.windows(2) {
            if pair[0] != pair[1] {
                sides.push(self.line(pair[0], pair[1]));
            }
        }
        sides
    }

    /// An arc about the z axis, counter-clockwise from one vertex to another; radius in mm.
    pub fn arc(&mut self, from: usize, to: usize, radius: f64) -> ShellSide {
        self.edge(from, to, EdgeKind::Arc, ShellCurve::Circle { radius })
    }

    /// A polynomial edge from its first Bézier point to its last.
    pub fn bezier(&mut self, points: Vec<[f64; 3]>) -> ShellSide {
        let [from, to] = [points[0], points[points.len() - 1]].map(|p| self.vertex(p));
        self.edge(from, to, EdgeKind::Bezier, ShellCurve::Bezier(points))
    }

    /// Adds a face with its bounds, the outer one first.
    pub fn face(&mut self, surface: ShellSurface, bounds: Vec<Vec<ShellSide>>) {
        self.shell.faces.push(ShellFace { surface, bounds });
    }

    /// The finished shell.
    #[must_use]
    pub fn finish(self) -> Shell {
        self.shell
    }
}
