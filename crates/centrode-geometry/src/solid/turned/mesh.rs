use std::f64::consts::FRAC_PI_2;

use super::{Turned, TurnedSection};
use crate::curve::BezierFit;
use crate::solid::triangulation::triangulate;
use crate::{
    Point,
    numeric::{COMPUTED, Tolerance},
    solid::{Mesh, ShellCurve, ShellFace, ShellSide, ShellSurface, SolidError},
};

/// Minimum number of chords per quarter turn, so that a coarse circle is still a circle.
const MIN_CHORDS: f64 = 3.0;
/// Maximum number of chords per quarter turn: limits the size of a mesh at a very small tolerance.
const MAX_CHORDS: f64 = 2048.0;
/// Maximum number of parts of a slotted cone; in each the edges of the slot are straight. It limits the size of a mesh at a very
/// small tolerance.
const MAX_PARTS: f64 = 256.0;

/// Mesh of a body from the edges and faces of its shell; every arc has the same number of chords.
pub(super) fn mesh(body: &Turned, tolerance: Tolerance) -> Result<Mesh, SolidError> {
    let body = body.with_straight_edges(tolerance);
    let widest = body.sections.iter().flat_map(|section| section.radii);
    let widest = widest.fold(0.0, f64::max);
    // The sagitta of a chord is the radius minus its distance from the axis.
    let half = (1.0 - (tolerance.mm() / widest).min(1.0)).acos();
    let chords = (0.5 * FRAC_PI_2 / half)
        .ceil()
        .clamp(MIN_CHORDS, MAX_CHORDS) as u32;
    let shell = body.shell();
    let mut mesh = Mesh {
        vertices: shell.vertices.clone(),
        faces: Vec::new(),
    };
    // Vertices along every edge, from its start to its end.
    let edges: Vec<Vec<u32>> = shell
        .edges
        .iter()
        .map(|edge| {
            let ends = edge.ends.map(|end| end as u32);
            let [from, to] = edge.ends.map(|end| shell.vertices[end]);
            let radius = match &edge.curve {
                ShellCurve::Circle { radius } => *radius,
                // A quarter of a half round end. Other polynomial edges are straight here.
                ShellCurve::Bezier(points) if (from[1] - to[1]).abs() > COMPUTED * widest => {
                    let between = (1..chords).map(|i| {
                        let x = f64::from(i) / f64::from(chords);
                        mesh.vertices.push(BezierFit::at(points, x));
                        mesh.vertices.len() as u32 - 1
                    });
                    let mut along = vec![ends[0]];
                    along.extend(between);
                    along.push(ends[1]);
                    return along;
                }
                _ => return ends.to_vec(),
            };
            let start = from[1].atan2(from[0]);
            let sweep = (to[1].atan2(to[0]) - start).rem_euclid(std::f64::consts::TAU);
            let between = (1..chords).map(|i| {
                let angle = start + sweep * f64::from(i) / f64::from(chords);
                mesh.vertices
                    .push([radius * angle.cos(), radius * angle.sin(), from[2]]);
                mesh.vertices.len() as u32 - 1
            });
            let mut along = vec![ends[0]];
            along.extend(between);
            along.push(ends[1]);
            along
        })
        .collect();
    let vertices_along = |&ShellSide { edge, forward }: &ShellSide| -> Vec<u32> {
        let along = &edges[edge];
        match forward {
            true => along.clone(),
            false => along.iter().rev().copied().collect(),
        }
    };
    for ShellFace { surface, bounds } in &shell.faces {
        let sides = || -> Vec<Vec<u32>> { bounds[0].iter().map(vertices_along).collect() };
        match surface {
            ShellSurface::Ruled { .. } => {
                mesh.faces.extend(wall(&sides()));
                continue;
            }
            ShellSurface::Plane { .. } => {}
            _ if bounds[0].len() > 4 => {
                let faces = over_end(&mesh.vertices, &sides());
                mesh.faces.extend(faces);
                continue;
            }
            _ => {}
        }
        let ShellSurface::Plane { normal, .. } = surface else {
            // Bottom, right, top and left of a round face.
            let (bottom, mut top) = (vertices_along(&bounds[0][0]), vertices_along(&bounds[0][2]));
            top.reverse();
            for (low, high) in bottom.windows(2).zip(top.windows(2)) {
                mesh.faces.push([low[0], low[1], high[1]]);
                mesh.faces.push([low[0], high[1], high[0]]);
            }
            continue;
        };
        let rings: Vec<Vec<u32>> = bounds
            .iter()
            .map(|bound| {
                let sides = bound.iter().map(vertices_along);
                sides
                    .flat_map(|mut side| {
                        side.pop();
                        side
                    })
                    .collect()
            })
            .collect();
        let flat = |vertex: &u32| projected(mesh.vertices[*vertex as usize], *normal);
        let contours: Vec<Vec<Point>> = rings
            .iter()
            .map(|ring| ring.iter().map(flat).collect())
            .collect();
        let all: Vec<u32> = rings.into_iter().flatten().collect();
        let triangles = triangulate(&contours, tolerance)?;
        let faces = triangles.iter().map(|face| face.map(|i| all[i as usize]));
        mesh.faces.extend(faces);
    }
    Ok(mesh)
}

/// Triangles of a cylinder over the end of the slot, between an arc and the two quarters of the end, in the order of the angles
/// of their vertices.
fn over_end(vertices: &[[f64; 3]], sides: &[Vec<u32>]) -> Vec<[u32; 3]> {
    let joined = |one: &[u32], other: &[u32]| [one, &other[1..]].concat();
    // Both run counter-clockwise about the axis; the quarters are below the arc or above it.
    let (low, mut high) = match sides[1].len() > 2 {
        true => (joined(&sides[0], &sides[1]), sides[3].clone()),
        false => (sides[0].clone(), joined(&sides[2], &sides[3])),
    };
    high.reverse();
    let angle = |vertex: u32| {
        let [x, y, _] = vertices[vertex as usize];
        y.atan2(x)
    };
    let (mut i, mut j) = (0, 0);
    let mut faces = Vec::new();
    while i + 1 < low.len() || j + 1 < high.len() {
        let is_low = match (low.get(i + 1), high.get(j + 1)) {
            (Some(&one), Some(&other)) => angle(one) <= angle(other),
            (next, _) => next.is_some(),
        };
        if is_low {
            faces.push([low[i], low[i + 1], high[j]]);
            i += 1;
        } else {
            faces.push([low[i], high[j + 1], high[j]]);
            j += 1;
        }
    }
    faces
}

/// Triangles of a quarter of the wall of a half round end: between its two long sides, which have equal numbers of chords, and
/// through corners of neighbours on the straight sides.
fn wall(sides: &[Vec<u32>]) -> Vec<[u32; 3]> {
    let first = sides.iter().position(|side| side.len() > 2).unwrap_or(0);
    let mut around = sides.iter().cycle().skip(first).take(sides.len());
    // One long side, and the other in the opposite direction.
    let one = around.next().cloned().unwrap_or_default();
    let mut other = Vec::new();
    let mut corners = [Vec::new(), Vec::new()];
    for side in around {
        if side.len() > 2 {
            other.clone_from(side);
        } else {
            let end = usize::from(other.is_empty());
            corners[end].push(side[0]);
        }
    }
    // The first vertex of the straight sides is an end of a long one.
    let between = |end: usize| corners[end].iter().skip(1).copied();
    let [first_corners, last_corners] = [0, 1].map(|end| between(end).collect::<Vec<u32>>());
    other.reverse();
    let last = one.len() - 2;
    let mut faces = Vec::new();
    for (i, (low, high)) in one.windows(2).zip(other.windows(2)).enumerate() {
        let mut contour = vec![low[0], low[1]];
        if i == last {
            contour.extend(&last_corners);
        }
        contour.extend([high[1], high[0]]);
        if i == 0 {
            contour.extend(&first_corners);
        }
        // Fan of triangles from a corner on a straight side, from which all other vertices are visible.
        let from = match (
            i == 0 && !first_corners.is_empty(),
            i == last && !last_corners.is_empty(),
        ) {
            (true, _) => contour.len() - 1,
            (_, true) => 2,
            _ => 0,
        };
        contour.rotate_left(from);
        faces.extend(
            contour[1..]
                .windows(2)
                .map(|pair| [contour[0], pair[0], pair[1]]),
        );
    }
    faces
}

/// Coordinates of a point in a plane with this normal, seen against the normal.
fn projected([x, y, z]: [f64; 3], normal: [f64; 3]) -> Point {
    match normal {
        [a, _, _] if a != 0.0 => Point::new(a * y, z),
        [_, b, _] if b != 0.0 => Point::new(-b * x, z),
        [_, _, c] => Point::new(c * x, y),
    }
}

impl Turned {
    /// The body with its slotted cones divided so that the edges of the slot are straight within a tolerance.
    fn with_straight_edges(&self, tolerance: Tolerance) -> Self {
        let parts = |section: &TurnedSection| -> Vec<TurnedSection> {
            let [low, high] = section.radii;
            let Some(slot) = self.slot.filter(|_| section.slotted && low != high) else {
                return vec![*section];
            };
            // Maximum second derivative of the edge's x with respect to the radius.
            let edge = self
                .edge_distance(section.minimum_radius())
                .unwrap_or(slot.floor);
            let bend = 0.25 * slot.width * slot.width / edge.powi(3);
            let chord = (bend * section.length.powi(2) / (8.0 * tolerance.mm())).sqrt();
            let count = chord.ceil().clamp(1.0, MAX_PARTS);
            let at = |i: f64| low + (high - low) * i / count;
            (0..count as u32)
                .map(|i| TurnedSection {
                    length: section.length / count,
                    radii: [at(f64::from(i)), at(f64::from(i) + 1.0)],
                    slotted: true,
                })
                .collect()
        };
        Self {
            sections: self.sections.iter().flat_map(parts).collect(),
            ..self.clone()
        }
    }
}
