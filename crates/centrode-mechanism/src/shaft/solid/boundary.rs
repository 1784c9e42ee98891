//! The boundary of the grooved shaft on exact surfaces.

use std::collections::HashMap;
use std::f64::consts::PI;

use centrode_geometry::{Shell, ShellCurve, ShellEdge, ShellFace, ShellSurface};
use nalgebra::{DMatrix, DVector};

use super::plan::{Level, Plan};
use super::surface::Surface;
use super::{ShaftBody, ends};
use crate::shaft::{Groove, Wall};

/// Degree of the walls' edges.
const DEGREE: usize = 9;
/// Numbers of even lines tried, until every edge is met.
const LINES: [u32; 4] = [8, 16, 32, MOST_LINES];
/// Greatest number of even lines.
pub(super) const MOST_LINES: u32 = 64;
/// Distance within which an edge must be met, mm: below the resolution of CAD kernels.
const MET: f64 = 1e-7;

/// Shell under construction; vertices and edges are shared.
#[derive(Debug, Default)]
pub(super) struct Boundary {
    shell: Shell,
    vertices: HashMap<[u64; 3], usize>,
    edges: HashMap<(usize, usize, u8), usize>,
}

/// Kinds of curves, to distinguish edges between the same ends.
const STRAIGHT: u8 = 0;
const ROUND: u8 = 1;
const FREE: u8 = 2;

impl Boundary {
    pub(super) fn vertex(&mut self, at: [f64; 3]) -> usize {
        let vertices = &mut self.shell.vertices;
        let key = at.map(|x| (x + 0.0).to_bits());
        *self.vertices.entry(key).or_insert_with(|| {
            vertices.push(at);
            vertices.len() - 1
        })
    }

    fn edge(&mut self, from: usize, to: usize, kind: u8, curve: ShellCurve) -> (usize, bool) {
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
    pub(super) fn place(&self, vertex: usize) -> [f64; 3] {
        self.shell.vertices[vertex]
    }

    /// A straight edge, walked from one vertex to the other.
    pub(super) fn line(&mut self, from: usize, to: usize) -> (usize, bool) {
        self.edge(from, to, STRAIGHT, ShellCurve::Line)
    }

    /// Straight edges from vertex to vertex.
    pub(super) fn lines(&mut self, through: &[usize]) -> Vec<(usize, bool)> {
        let mut sides = Vec::new();
        for pair in through.windows(2) {
            if pair[0] != pair[1] {
                sides.push(self.line(pair[0], pair[1]));
            }
        }
        sides
    }

    /// An arc about the axis, counter-clockwise from the first vertex to the second.
    pub(super) fn arc(&mut self, from: usize, to: usize, radius: f64) -> (usize, bool) {
        self.edge(from, to, ROUND, ShellCurve::Circle { radius })
    }

    /// A polynomial edge, walked from its first point to its last.
    pub(super) fn free(&mut self, points: Vec<[f64; 3]>) -> (usize, bool) {
        let [from, to] = [points[0], points[points.len() - 1]].map(|p| self.vertex(p));
        self.edge(from, to, FREE, ShellCurve::Bezier(points))
    }

    pub(super) fn face(&mut self, surface: ShellSurface, bounds: Vec<Vec<(usize, bool)>>) {
        self.shell.faces.push(ShellFace { surface, bounds });
    }
}

/// Reverses a side.
pub(super) fn back((edge, forward): (usize, bool)) -> (usize, bool) {
    (edge, !forward)
}

/// Builds the whole boundary; `None` where the edges are too wild to be met by smooth pieces.
pub(super) fn shell(groove: &Groove, body: &ShaftBody, thick: [f64; 2]) -> Option<Shell> {
    let fit = Fit::new();
    LINES.iter().find_map(|&count| {
        let floor = Level {
            half: 0.5 * groove.width(),
            radius: groove.radius() - groove.depth(),
        };
        let plan = Plan::smooth(groove, floor, count);
        let mut boundary = Boundary::default();
        grooved(&mut boundary, &fit, &plan, groove.radius(), thick)?;
        ends::close(&mut boundary, body, groove.radius(), thick, &plan.lines);
        Some(boundary.shell).filter(Shell::is_closed)
    })
}

/// Adds the grooved length: land, floor and walls. `None` where a piece misses its edge.
fn grooved(
    boundary: &mut Boundary,
    fit: &Fit,
    plan: &Plan<'_>,
    radius: f64,
    thick: [f64; 2],
) -> Option<()> {
    let mut surface = Surface::new(plan, radius, thick);
    surface.find();
    let floor = plan.levels[0].radius;
    let count = plan.lines.len();
    let on = |line: usize, land: bool| surface.heights_on(line % count, land);
    let strips = surface.tops_by_line();
    for (line, tops) in strips.iter().enumerate() {
        let start = plan.lines[line];
        let end = plan.lines.get(line + 1).copied().unwrap_or(2.0 * PI);
        let angles = [start, plan.lines[(line + 1) % count]];
        // Both edges of every wall, from this line to the next.
        let mut walls = Vec::new();
        for &(edge, heights) in tops {
            let at = |phi: f64| plan.height(edge, phi);
            let top = fit.edge(radius, [start, end], angles, heights, &at)?;
            let foot = fit.edge(floor, [start, end], angles, heights, &at)?;
            let raised = plan.edge(edge).wall == Wall::Left;
            let sides = (boundary.free(top.clone()), boundary.free(foot.clone()));
            wall(boundary, [foot, top], sides, raised);
            walls.push((heights, sides));
        }
        for k in 0..=walls.len() {
            // Land first, then floor and land by turns.
            let land = k % 2 == 0;
            let r = if land { radius } else { floor };
            let mut ring = |side: usize, z: f64| {
                let (sin, cos) = angles[side].sin_cos();
                boundary.vertex([r * cos, r * sin, z])
            };
            let low = k.checked_sub(1).map_or([thick[0]; 2], |k| walls[k].0);
            let high = walls.get(k).map_or([thick[1]; 2], |w| w.0);
            let [left, right] = [0, 1].map(|side| {
                let within = |z: &f64| *z > low[side] && *z < high[side];
                let between: Vec<f64> = on(line + side, land).into_iter().filter(within).collect();
                let all = [low[side]].into_iter().chain(between).chain([high[side]]);
                all.map(|z| ring(side, z)).collect::<Vec<usize>>()
            });
            let of = |sides: ((usize, bool), (usize, bool))| if land { sides.0 } else { sides.1 };
            let bottom = match k.checked_sub(1) {
                Some(k) => of(walls[k].1),
                None => boundary.arc(left[0], right[0], r),
            };
            let above = match walls.get(k) {
                Some(wall) => of(wall.1),
                None => boundary.arc(left[left.len() - 1], right[right.len() - 1], r),
            };
            let mut bound = vec![bottom];
            bound.extend(boundary.lines(&right));
            bound.push(back(above));
            let down: Vec<usize> = left.into_iter().rev().collect();
            bound.extend(boundary.lines(&down));
            boundary.face(ShellSurface::Cylinder { radius: r }, vec![bound]);
        }
    }
    Some(())
}

/// Adds one wall: straight from the foot outwards. `raised` where the land is above it.
fn wall(
    boundary: &mut Boundary,
    points: [Vec<[f64; 3]>; 2],
    (top, foot): ((usize, bool), (usize, bool)),
    raised: bool,
) {
    let last = points[0].len() - 1;
    let [feet, tops] = [0, 1].map(|k| [points[k][0], points[k][last]].map(|p| boundary.vertex(p)));
    let out = [0, 1].map(|side| boundary.line(feet[side], tops[side]));
    let bound = if raised {
        vec![foot, out[1], back(top), back(out[0])]
    } else {
        vec![out[0], top, back(out[1]), back(foot)]
    };
    // Round the shaft crossed with outwards points down.
    let surface = ShellSurface::Ruled {
        points,
        outward: raised,
    };
    boundary.face(surface, vec![bound]);
}

/// Fit of Bézier points to points on a curve.
struct Fit {
    /// Parameters of the points on the curve, 0 to 1.
    nodes: Vec<f64>,
    /// Map from points on the curve to Bézier points.
    inverse: DMatrix<f64>,
}

impl Fit {
    fn new() -> Self {
        let nodes: Vec<f64> = (0..=DEGREE)
            .map(|i| 0.5 - 0.5 * (PI * i as f64 / DEGREE as f64).cos())
            .collect();
        let matrix = DMatrix::from_fn(DEGREE + 1, DEGREE + 1, |i, j| bernstein(nodes[i])[j]);
        // The nodes are distinct, so it has an inverse.
        let inverse = matrix.try_inverse().unwrap_or_default();
        Self { nodes, inverse }
    }

    /// The edge at a radius between two angles; its ends are at the angles and heights given, which differ
    /// from the curve's by rounding. `None` where the curve is not met.
    fn edge(
        &self,
        radius: f64,
        [start, end]: [f64; 2],
        angles: [f64; 2],
        heights: [f64; 2],
        at: &dyn Fn(f64) -> f64,
    ) -> Option<Vec<[f64; 3]>> {
        let place = |x: f64| {
            let phi = start + (end - start) * x;
            [radius * phi.cos(), radius * phi.sin(), at(phi)]
        };
        let places: Vec<[f64; 3]> = self.nodes.iter().map(|&x| place(x)).collect();
        let columns = [0, 1, 2].map(|axis| {
            let values = DVector::from_iterator(DEGREE + 1, places.iter().map(|p| p[axis]));
            &self.inverse * values
        });
        let mut points: Vec<[f64; 3]> = (0..=DEGREE)
            .map(|i| [columns[0][i], columns[1][i], columns[2][i]])
            .collect();
        for (side, i) in [0, DEGREE].into_iter().enumerate() {
            let (sin, cos) = angles[side].sin_cos();
            points[i] = [radius * cos, radius * sin, heights[side]];
        }
        let met = self.nodes.windows(2).all(|pair| {
            let x = 0.5 * (pair[0] + pair[1]);
            let weights = bernstein(x);
            let exact = place(x);
            (0..3).all(|axis| {
                let sum: f64 = points.iter().zip(&weights).map(|(p, w)| p[axis] * w).sum();
                (sum - exact[axis]).abs() <= MET
            })
        });
        met.then_some(points)
    }
}

/// Weights of the Bézier points at a parameter.
fn bernstein(x: f64) -> [f64; DEGREE + 1] {
    let mut weights = [0.0; DEGREE + 1];
    weights[0] = 1.0;
    for degree in 1..=DEGREE {
        for i in (0..=degree).rev() {
            let from = if i > 0 { weights[i - 1] * x } else { 0.0 };
            weights[i] = weights[i] * (1.0 - x) + from;
        }
    }
    weights
}

/// Bézier points of a curve in space that a polynomial of the walls' degree meets.
pub(super) fn bezier(place: &dyn Fn(f64) -> [f64; 3]) -> Vec<[f64; 3]> {
    let fit = Fit::new();
    let places: Vec<[f64; 3]> = fit.nodes.iter().map(|&x| place(x)).collect();
    let columns = [0, 1, 2].map(|axis| {
        let values = DVector::from_iterator(DEGREE + 1, places.iter().map(|p| p[axis]));
        &fit.inverse * values
    });
    let mut points: Vec<[f64; 3]> = (0..=DEGREE)
        .map(|i| [columns[0][i], columns[1][i], columns[2][i]])
        .collect();
    points[0] = places[0];
    points[DEGREE] = places[DEGREE];
    points
}
