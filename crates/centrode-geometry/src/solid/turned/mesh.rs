use std::f64::consts::FRAC_PI_2;

use super::{Turned, TurnedSection};
use crate::curve::BezierFit;
use crate::solid::triangulation::triangulate;
use crate::{
    Point,
    numeric::Tolerance,
    solid::{Mesh, ShellCurve, ShellFace, ShellSurface, SolidError},
};

/// Fewest and most chords of a quarter of a turn.
const CHORDS: [f64; 2] = [3.0, 2048.0];
/// Share of the greatest radius by which the ends of an edge beside the axis may be off a plane: rounding.
const ASIDE: f64 = 1e-9;
/// Most parts of a slotted cone, whose slot's edges are straight in each.
const PARTS: f64 = 256.0;

/// Mesh of a body, by the edges and faces of its shell: arcs in chords, all of one number.
pub(super) fn mesh(body: &Turned, tolerance: Tolerance) -> Result<Mesh, SolidError> {
    let body = body.with_straight_edges(tolerance);
    let widest = body.sections.iter().flat_map(|section| section.radii);
    let widest = widest.fold(0.0, f64::max);
    // A chord's rise is the radius less its distance from the axis.
    let half = (1.0 - (tolerance.mm() / widest).min(1.0)).acos();
    let chords = (0.5 * FRAC_PI_2 / half).ceil().clamp(CHORDS[0], CHORDS[1]) as u32;
    let shell = body.shell();
    let mut mesh = Mesh {
        vertices: shell.vertices.clone(),
        faces: Vec::new(),
    };
    // Vertices along every edge, from its first end to its second.
    let edges: Vec<Vec<u32>> = shell
        .edges
        .iter()
        .map(|edge| {
            let ends = edge.ends.map(|end| end as u32);
            let [from, to] = edge.ends.map(|end| shell.vertices[end]);
            let radius = match &edge.curve {
                ShellCurve::Circle { radius } => *radius,
                // A quarter of a half round end: edges of walls beside the axis are straight.
                ShellCurve::Bezier(points) if (from[1] - to[1]).abs() > ASIDE * widest => {
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
    let walked = |&(edge, forward): &(usize, bool)| -> Vec<u32> {
        let along = &edges[edge];
        match forward {
            true => along.clone(),
            false => along.iter().rev().copied().collect(),
        }
    };
    for ShellFace { surface, bounds } in &shell.faces {
        let sides = || -> Vec<Vec<u32>> { bounds[0].iter().map(walked).collect() };
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
            let (bottom, mut top) = (walked(&bounds[0][0]), walked(&bounds[0][2]));
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
                let sides = bound.iter().map(walked);
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

/// Triangles of a cylinder over the end of the slot: between an arc and the two quarters of the end, vertex by vertex in the order of
/// their angles.
fn over_end(vertices: &[[f64; 3]], sides: &[Vec<u32>]) -> Vec<[u32; 3]> {
    let joined = |one: &[u32], other: &[u32]| [one, &other[1..]].concat();
    // Both counter-clockwise about the axis, the quarters below the arc or above it.
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

/// Triangles of a quarter of the wall of a half round end: between its long sides, of as many chords each, and through corners of
/// neighbours on the straight ones.
fn wall(sides: &[Vec<u32>]) -> Vec<[u32; 3]> {
    let first = sides.iter().position(|side| side.len() > 2).unwrap_or(0);
    let mut around = sides.iter().cycle().skip(first).take(sides.len());
    // Along one long side, and back along the other.
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
    let [before, beyond] = [0, 1].map(|end| between(end).collect::<Vec<u32>>());
    other.reverse();
    let last = one.len() - 2;
    let mut faces = Vec::new();
    for (i, (low, high)) in one.windows(2).zip(other.windows(2)).enumerate() {
        let mut contour = vec![low[0], low[1]];
        if i == last {
            contour.extend(&beyond);
        }
        contour.extend([high[1], high[0]]);
        if i == 0 {
            contour.extend(&before);
        }
        // From a corner on a straight side all others are seen.
        let from = match (
            i == 0 && !before.is_empty(),
            i == last && !beyond.is_empty(),
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

/// A point of a plane along an axis, as seen against its normal.
fn projected([x, y, z]: [f64; 3], normal: [f64; 3]) -> Point {
    match normal {
        [a, _, _] if a != 0.0 => Point::new(a * y, z),
        [_, b, _] if b != 0.0 => Point::new(-b * x, z),
        [_, _, c] => Point::new(c * x, y),
    }
}

impl Turned {
    /// The body with its slotted cones in parts, in which the slot's edges are straight within a tolerance.
    fn with_straight_edges(&self, tolerance: Tolerance) -> Self {
        let parts = |section: &TurnedSection| -> Vec<TurnedSection> {
            let [low, high] = section.radii;
            let Some(slot) = self.slot.filter(|_| section.slotted && low != high) else {
                return vec![*section];
            };
            // Greatest second derivative of the edge's distance along x by the radius.
            let edge = self.edge(section.least()).unwrap_or(slot.foot);
            let bend = 0.25 * slot.width * slot.width / edge.powi(3);
            let chord = (bend * section.length.powi(2) / (8.0 * tolerance.mm())).sqrt();
            let count = chord.ceil().clamp(1.0, PARTS);
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
