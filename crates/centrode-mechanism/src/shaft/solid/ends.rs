//! Chamfers, shoulders, journals and keyway of the exact boundary.

use std::f64::consts::{PI, TAU};

use centrode_geometry::ShellSurface;

use super::ShaftBody;
use super::boundary::{Boundary, back, bezier};
use crate::gear::design::Keyway;

/// Rings of vertices about the axis between which faces lie, all at the same angles.
struct Ring {
    radius: f64,
    height: f64,
    vertices: Vec<usize>,
}

impl Ring {
    fn new(boundary: &mut Boundary, angles: &[f64], radius: f64, height: f64) -> Self {
        let at = |angle: &f64| {
            let (sin, cos) = angle.sin_cos();
            [radius * cos, radius * sin, height]
        };
        Self {
            radius,
            height,
            vertices: angles.iter().map(|a| boundary.vertex(at(a))).collect(),
        }
    }

    fn len(&self) -> usize {
        self.vertices.len()
    }

    fn at(&self, i: usize) -> usize {
        self.vertices[i % self.len()]
    }

    /// The arc from a vertex to the next.
    fn arc(&self, boundary: &mut Boundary, i: usize) -> (usize, bool) {
        boundary.arc(self.at(i), self.at(i + 1), self.radius)
    }

    /// All arcs, counter-clockwise seen from above.
    fn round(&self, boundary: &mut Boundary) -> Vec<(usize, bool)> {
        (0..self.len()).map(|i| self.arc(boundary, i)).collect()
    }
}

/// Closes both ends beyond the thick part, whose rims have vertices at the angles `lines`.
pub(super) fn close(
    boundary: &mut Boundary,
    body: &ShaftBody,
    radius: f64,
    thick: [f64; 2],
    lines: &[f64],
) {
    for (end, way) in thick.into_iter().zip([-1.0, 1.0]) {
        let c = body.chamfer;
        let rim = Ring::new(boundary, lines, radius, end);
        let root = if c > 0.0 {
            let root = Ring::new(boundary, lines, radius - c, end + way * c);
            band(boundary, &rim, &root, way, lines.len());
            root
        } else {
            rim
        };
        let keyway = body.keyway.filter(|_| way < 0.0);
        journal(boundary, body, &root, way, keyway);
    }
}

/// Faces between two rings over the first `count` arcs, the second ring beyond the first along `way`.
fn band(boundary: &mut Boundary, first: &Ring, second: &Ring, way: f64, count: usize) {
    let (low, high) = if way > 0.0 {
        (first, second)
    } else {
        (second, first)
    };
    for i in 0..count {
        let bottom = low.arc(boundary, i);
        let top = high.arc(boundary, i);
        let right = boundary.line(low.at(i + 1), high.at(i + 1));
        let left = boundary.line(low.at(i), high.at(i));
        let surface = surface(low, high);
        boundary.face(surface, vec![vec![bottom, right, back(top), back(left)]]);
    }
}

/// The cylinder or cone through two rings.
fn surface(low: &Ring, high: &Ring) -> ShellSurface {
    if low.radius == high.radius {
        return ShellSurface::Cylinder { radius: low.radius };
    }
    let widens = high.radius > low.radius;
    let narrow = if widens { low } else { high };
    ShellSurface::Cone {
        height: narrow.height,
        radius: narrow.radius,
        widens,
    }
}

/// A bound seen from the side `way` points to.
fn seen(mut bound: Vec<(usize, bool)>, way: f64) -> Vec<(usize, bool)> {
    if way < 0.0 {
        bound = bound.into_iter().rev().map(back).collect();
    }
    bound
}

fn flat(height: f64, way: f64) -> ShellSurface {
    ShellSurface::Plane {
        point: [0.0, 0.0, height],
        normal: [0.0, 0.0, way],
    }
}

/// Shoulder, journal and its end beyond a ring.
fn journal(
    boundary: &mut Boundary,
    body: &ShaftBody,
    root: &Ring,
    way: f64,
    keyway: Option<Keyway>,
) {
    let (radius, c) = (0.5 * body.journal_diameter, body.chamfer);
    let shoulder = root.height;
    let tip = shoulder + way * (body.journal_length - c);
    let tip = if c > 0.0 { tip + way * c } else { tip };
    let angles = angles(keyway, radius);
    let base = Ring::new(boundary, &angles, radius, shoulder);
    let outer = seen(root.round(boundary), way);
    let inner = seen(base.round(boundary), -way);
    boundary.face(flat(shoulder, way), vec![outer, inner]);
    let edge = tip - way * c;
    let all = base.len();
    let Some(key) = keyway else {
        let last = Ring::new(boundary, &angles, radius, edge);
        band(boundary, &base, &last, way, all);
        let face = if c > 0.0 {
            let face = Ring::new(boundary, &angles, radius - c, tip);
            band(boundary, &last, &face, way, all);
            face
        } else {
            last
        };
        let bound = seen(face.round(boundary), way);
        boundary.face(flat(tip, way), vec![bound]);
        return;
    };
    let inner_end = Ring::new(boundary, &angles, radius, tip - way * body.keyway_length);
    band(boundary, &base, &inner_end, way, all);
    let last = Ring::new(boundary, &angles, radius, edge);
    // The last arc is the one over the slot.
    band(boundary, &inner_end, &last, way, all - 1);
    let mut stations = vec![inner_end, last];
    if c > 0.0 {
        let face = Ring::new(boundary, &self::angles(keyway, radius - c), radius - c, tip);
        stations.push(face);
        chamfered(boundary, key, &stations[1], &stations[2]);
    }
    slot(boundary, key, radius - key.depth, &stations, way);
}

/// The chamfer of a slotted journal: at the slot its edges are where a plane beside the axis cuts a cone.
fn chamfered(boundary: &mut Boundary, key: Keyway, wide: &Ring, narrow: &Ring) {
    let count = wide.len() - 1;
    // The slotted journal is at the lower end: the narrow ring below.
    let sides: Vec<(usize, bool)> = (0..=count)
        .map(|i| {
            if i == 0 || i == count {
                let side = if i == 0 { 0.5 } else { -0.5 };
                slanted(boundary, key, side, narrow, wide)
            } else {
                boundary.line(narrow.at(i), wide.at(i))
            }
        })
        .collect();
    for i in 0..count {
        let bottom = narrow.arc(boundary, i);
        let top = wide.arc(boundary, i);
        let bound = vec![bottom, sides[i + 1], back(top), back(sides[i])];
        boundary.face(surface(narrow, wide), vec![bound]);
    }
}

/// The edge of a slot's side on the chamfer, from the narrow ring to the wide one.
fn slanted(
    boundary: &mut Boundary,
    key: Keyway,
    side: f64,
    narrow: &Ring,
    wide: &Ring,
) -> (usize, bool) {
    let y = side * key.width;
    let ends = if side > 0.0 {
        [narrow.at(0), wide.at(0)]
    } else {
        [narrow.at(narrow.len() - 1), wide.at(wide.len() - 1)]
    };
    let mut points = bezier(&|x| {
        let radius = narrow.radius + (wide.radius - narrow.radius) * x;
        let height = narrow.height + (wide.height - narrow.height) * x;
        [(radius * radius - y * y).max(0.0).sqrt(), y, height]
    });
    let last = points.len() - 1;
    points[0] = boundary.place(ends[0]);
    points[last] = boundary.place(ends[1]);
    boundary.free(points)
}

/// The slot itself and the flat end of its journal: stations at the slot's inner end, where the chamfer begins,
/// and at the tip.
fn slot(boundary: &mut Boundary, key: Keyway, foot: f64, stations: &[Ring], way: f64) {
    let [first, last] = [&stations[0], &stations[stations.len() - 1]];
    let count = first.len() - 1;
    let sides = [-0.5, 0.5].map(|side| side * key.width);
    let feet =
        [first.height, last.height].map(|height| sides.map(|y| boundary.vertex([foot, y, height])));
    let (wall, tip) = (feet[0], feet[1]);
    // The slot's inner end, over the arc it removes, and the journal's end with the slot in it.
    let mut bound = vec![
        boundary.line(wall[0], first.at(count)),
        first.arc(boundary, count),
    ];
    bound.extend(boundary.lines(&[first.at(0), wall[1], wall[0]]));
    boundary.face(flat(first.height, way), vec![seen(bound, way)]);
    let mut bound: Vec<(usize, bool)> = (0..count).map(|i| last.arc(boundary, i)).collect();
    bound.extend(boundary.lines(&[last.at(count), tip[0], tip[1], last.at(0)]));
    boundary.face(flat(last.height, way), vec![seen(bound, way)]);
    // Its floor faces outwards along x, seen with z upwards; the tip is the lower end.
    let bound = boundary.lines(&[tip[0], tip[1], wall[1], wall[0], tip[0]]);
    let plane = |point: [f64; 3], normal: [f64; 3]| ShellSurface::Plane { point, normal };
    boundary.face(
        plane([foot, 0.0, last.height], [1.0, 0.0, 0.0]),
        vec![bound],
    );
    for (side, i) in [(0, count), (1, 0)] {
        let mut up = vec![];
        // From the tip to the slot's inner end along the journal's surface.
        if let [_, wide, narrow] = stations {
            let half = if side == 0 { -0.5 } else { 0.5 };
            up.push(slanted(boundary, key, half, narrow, wide));
        }
        up.push(boundary.line(stations[1].at(i), first.at(i)));
        let mut bound = vec![boundary.line(tip[side], last.at(i))];
        bound.extend(up);
        bound.extend(boundary.lines(&[first.at(i), wall[side], tip[side]]));
        // Along x, then along z: seen against y, as the side at the greater y is.
        let normal = if side == 1 { -1.0 } else { 1.0 };
        let bound = if side == 1 {
            bound
        } else {
            bound.into_iter().rev().map(back).collect()
        };
        boundary.face(
            plane([foot, sides[side], 0.0], [0.0, normal, 0.0]),
            vec![bound],
        );
    }
}

/// Angles of a ring: quarters, or, beside a slot, from its upper edge round to its lower one, the last arc the
/// one over the slot.
fn angles(keyway: Option<Keyway>, radius: f64) -> Vec<f64> {
    match keyway {
        None => (0..4).map(|i| 0.5 * PI * f64::from(i)).collect(),
        Some(key) => {
            let edge = (0.5 * key.width / radius).asin();
            let step = (TAU - 2.0 * edge) / 4.0;
            (0..=4).map(|i| edge + step * f64::from(i)).collect()
        }
    }
}
