use std::collections::HashMap;

use crate::solid::{Shell, ShellCurve, ShellEdge, ShellFace, ShellSurface};

/// Shell under construction; vertices and edges are shared.
#[derive(Debug, Default)]
pub struct ShellBuilder {
    shell: Shell,
    vertices: HashMap<[u64; 3], usize>,
    edges: HashMap<(usize, usize, u8), usize>,
}

/// Edge of a bound, and whether it is walked from its first end to its second.
pub type ShellSide = (usize, bool);

/// Kinds of curves, to distinguish edges between the same ends.
const STRAIGHT: u8 = 0;
const ROUND: u8 = 1;
const FREE: u8 = 2;

impl ShellBuilder {
    /// Vertex at a place, the one there is where there is one.
    pub fn vertex(&mut self, at: [f64; 3]) -> usize {
        let vertices = &mut self.shell.vertices;
        let key = at.map(|x| (x + 0.0).to_bits());
        *self.vertices.entry(key).or_insert_with(|| {
            vertices.push(at);
            vertices.len() - 1
        })
    }

    fn edge(&mut self, from: usize, to: usize, kind: u8, curve: ShellCurve) -> ShellSide {
        if let Some(&edge) = self.edges.get(&(to, from, kind))
            && kind != ROUND
        {
            return (edge, false);
        }
        let edges = &mut self.shell.edges;
        let edge = *self.edges.entry((from, to, kind)).or_insert_with(|| {
            edges.push(ShellEdge {
                ends: [from, to],
                curve,
            });
            edges.len() - 1
        });
        (edge, true)
    }

    /// Position of a vertex.
    #[must_use]
    pub fn place(&self, vertex: usize) -> [f64; 3] {
        self.shell.vertices[vertex]
    }

    /// A straight edge, walked from one vertex to the other.
    pub fn line(&mut self, from: usize, to: usize) -> ShellSide {
        self.edge(from, to, STRAIGHT, ShellCurve::Line)
    }

    /// Straight edges from vertex to vertex.
    pub fn lines(&mut self, through: &[usize]) -> Vec<ShellSide> {
        let mut sides = Vec::new();
        for pair in through.windows(2) {
            if pair[0] != pair[1] {
                sides.push(self.line(pair[0], pair[1]));
            }
        }
        sides
    }

    /// An arc about the axis, counter-clockwise from the first vertex to the second.
    pub fn arc(&mut self, from: usize, to: usize, radius: f64) -> ShellSide {
        self.edge(from, to, ROUND, ShellCurve::Circle { radius })
    }

    /// A polynomial edge, walked from its first point to its last.
    pub fn free(&mut self, points: Vec<[f64; 3]>) -> ShellSide {
        let [from, to] = [points[0], points[points.len() - 1]].map(|p| self.vertex(p));
        self.edge(from, to, FREE, ShellCurve::Bezier(points))
    }

    /// Adds a face with its bounds, the outer one first.
    pub fn face(&mut self, surface: ShellSurface, bounds: Vec<Vec<ShellSide>>) {
        self.shell.faces.push(ShellFace { surface, bounds });
    }

    /// The shell of all faces.
    #[must_use]
    pub fn finish(self) -> Shell {
        self.shell
    }

    /// A side walked the other way.
    #[must_use]
    pub fn back((edge, forward): ShellSide) -> ShellSide {
        (edge, !forward)
    }
}
