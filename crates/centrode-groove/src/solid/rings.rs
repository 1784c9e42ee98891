//! Meshes of chamfers, shoulders, journals and keyway.

use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Mesh, Tolerance};

use super::ShaftBody;
use super::plan::columns;
use centrode_kinematics::machine::Keyway;

/// Shoulders and journals that close the ends of the grooved surface.
#[derive(Debug)]
pub(super) struct Rings<'a> {
    body: &'a ShaftBody,
    radius: f64,
    columns: u32,
    /// Number of chords of a quarter of the keyway's end.
    quarter: u32,
}

impl<'a> Rings<'a> {
    pub(super) fn new(body: &'a ShaftBody, radius: f64, tolerance: Tolerance) -> Self {
        Self {
            body,
            radius,
            columns: columns(0.5 * body.journal_diameter, tolerance.mm()),
            quarter: columns(body.keyway_rounding().max(tolerance.mm()), tolerance.mm())
                .div_ceil(4),
        }
    }

    /// Adds chamfers, shoulders and journals to both rims, which are counter-clockwise seen from above. A chamfer joins a rim to
    /// new vertices on a smaller circle.
    pub(super) fn close(&self, mesh: &mut Mesh, lower: &[u32], upper: &[u32]) {
        for (rim, way) in [(lower, -1.0), (upper, 1.0)] {
            let outer = self.chamfered(mesh, rim, way);
            let z = mesh.vertices[rim[0] as usize][2] + way * self.chamfer();
            let keyway = self.body.keyway.filter(|_| way < 0.0);
            self.journal(mesh, &outer, z, way, keyway);
        }
    }

    fn chamfer(&self) -> f64 {
        self.body.chamfer
    }

    /// A cone from a rim to a smaller circle beyond it.
    fn chamfered(&self, mesh: &mut Mesh, rim: &[u32], way: f64) -> Vec<u32> {
        let c = self.chamfer();
        if c == 0.0 {
            return rim.to_vec();
        }
        let scale = (self.radius - c) / self.radius;
        let small: Vec<u32> = rim
            .iter()
            .map(|&v| {
                let [x, y, z] = mesh.vertices[v as usize];
                push(mesh, [x * scale, y * scale, z + way * c])
            })
            .collect();
        band(mesh, rim, &small, way);
        small
    }

    /// Shoulder, journal and end beyond a rim at the height `z`.
    fn journal(&self, mesh: &mut Mesh, rim: &[u32], z: f64, way: f64, keyway: Option<Keyway>) {
        let radius = 0.5 * self.body.journal_diameter;
        let c = self.chamfer();
        let end = z + way * (self.body.journal_length - c);
        let ring = |mesh: &mut Mesh, radius: f64, z: f64| -> Vec<u32> {
            let angles = self.angles(keyway, radius);
            angles
                .iter()
                .map(|a| push(mesh, [radius * a.cos(), radius * a.sin(), z]))
                .collect()
        };
        let root = ring(mesh, radius, z);
        shoulder(mesh, rim, &root, way);
        let Some(Keyway { width, depth }) = keyway else {
            let last = ring(mesh, radius, end);
            band(mesh, &root, &last, way);
            let tip = if c > 0.0 {
                let tip = ring(mesh, radius - c, end + way * c);
                band(mesh, &last, &tip, way);
                tip
            } else {
                last
            };
            let center = push(mesh, [0.0, 0.0, end + way * c]);
            for (i, &v) in tip.iter().enumerate() {
                face(mesh, [center, v, tip[(i + 1) % tip.len()]], way);
            }
            return;
        };
        // The slot: first round the open part from its upper edge to its lower one, then its foot.
        let start = end + way * (c - self.body.keyway_length);
        let full = ring(mesh, radius, start);
        band(mesh, &root, &full, way);
        let open = self.open_count();
        let foot = radius - depth;
        let feet =
            |mesh: &mut Mesh, z: f64| [-0.5, 0.5].map(|side| push(mesh, [foot, side * width, z]));
        let beside = |mesh: &mut Mesh, radius: f64, z: f64| -> Vec<u32> {
            let angles = &self.angles(keyway, radius)[..open];
            let all = angles.iter();
            all.map(|a| push(mesh, [radius * a.cos(), radius * a.sin(), z]))
                .collect()
        };
        // The arc that the slot removes, from its lower edge to its upper one.
        let mut arc: Vec<u32> = full[open - 1..].to_vec();
        arc.push(full[0]);
        let half = self.body.keyway_rounding();
        let straight = start + way * half;
        let mut before = full[..open].to_vec();
        if half > 0.0 {
            before = beside(mesh, radius, straight);
            for (first, second) in full[..open].windows(2).zip(before.windows(2)) {
                face(mesh, [first[0], first[1], second[1]], way);
                face(mesh, [first[0], second[1], second[0]], way);
            }
        }
        let at_start = feet(mesh, straight);
        let rim = [before[open - 1], before[0]];
        self.slot_end(mesh, &arc, rim, at_start, way);
        before.extend(at_start);
        let mut stations = vec![(radius, end)];
        if c > 0.0 {
            stations.push((radius - c, end + way * c));
        }
        for (radius, z) in stations {
            let mut contour = beside(mesh, radius, z);
            contour.extend(feet(mesh, z));
            band(mesh, &before, &contour, way);
            before = contour;
        }
        self.slotted_end(mesh, &before, way);
    }

    /// The end of the slot, between the arc that it removes and the lower and upper corners where its straight walls begin, on
    /// the rim and at its foot.
    fn slot_end(&self, mesh: &mut Mesh, arc: &[u32], rim: [u32; 2], feet: [u32; 2], way: f64) {
        let half = self.body.keyway_rounding();
        if half == 0.0 {
            // A plane wall.
            for pair in arc.windows(2) {
                face(mesh, [feet[0], pair[0], pair[1]], way);
            }
            face(mesh, [feet[0], arc[arc.len() - 1], feet[1]], way);
            return;
        }
        let radius = 0.5 * self.body.journal_diameter;
        let [foot, _, z] = mesh.vertices[feet[0] as usize];
        let n = self.quarter;
        let crest = arc[arc.len() / 2];
        // Along the half circle, on the journal and on the floor.
        let (mut outer, mut inner) = (vec![rim[0]], vec![feet[0]]);
        for i in 1..2 * n {
            let (sin, cos) = (FRAC_PI_2 * (f64::from(i) / f64::from(n) - 1.0)).sin_cos();
            let (y, z) = (half * sin, z - way * half * cos);
            outer.push(match i == n {
                true => crest,
                false => push(mesh, [(radius * radius - y * y).sqrt(), y, z]),
            });
            inner.push(push(mesh, [foot, y, z]));
        }
        outer.push(rim[1]);
        inner.push(feet[1]);
        for (low, high) in inner.windows(2).zip(outer.windows(2)) {
            face(mesh, [low[0], high[0], high[1]], way);
            face(mesh, [low[0], high[1], low[1]], way);
        }
        for low in inner[1..].windows(2) {
            face(mesh, [inner[0], low[0], low[1]], way);
        }
        let middle = n as usize;
        corner(mesh, &arc[..=arc.len() / 2], &outer[..=middle], way);
        let back = |run: &[u32]| run.iter().rev().copied().collect::<Vec<u32>>();
        let (arc, outer) = (back(&arc[arc.len() / 2..]), back(&outer[middle..]));
        corner(mesh, &arc, &outer, -way);
    }

    /// The flat end of a slotted journal.
    fn slotted_end(&self, mesh: &mut Mesh, contour: &[u32], way: f64) {
        let open = self.open_count();
        let (round, feet) = contour.split_at(open);
        let z = mesh.vertices[feet[0] as usize][2];
        let center = push(mesh, [0.0, 0.0, z]);
        let angle = |v: u32| {
            let [x, y, _] = mesh.vertices[v as usize];
            y.atan2(x).rem_euclid(TAU)
        };
        // A corner of the slot's foot has an open view of the round part up to the line through it from the centre.
        let limits = [angle(feet[1]), angle(feet[0])];
        let first = round.iter().position(|&v| angle(v) > limits[0]);
        let last = round.iter().rposition(|&v| angle(v) < limits[1]);
        let (first, last) = (first.unwrap_or(0), last.unwrap_or(open - 1));
        let mut fan = Vec::new();
        for pair in round[..=first].windows(2) {
            fan.push([feet[1], pair[0], pair[1]]);
        }
        fan.push([center, feet[1], round[first]]);
        for pair in round[first..=last].windows(2) {
            fan.push([center, pair[0], pair[1]]);
        }
        fan.push([center, round[last], feet[0]]);
        for pair in round[last..].windows(2) {
            fan.push([feet[0], pair[0], pair[1]]);
        }
        fan.push([center, feet[0], feet[1]]);
        for triangle in fan {
            face(mesh, triangle, way);
        }
    }

    /// Number of vertices of the round part next to a slot, both its edges included.
    fn open_count(&self) -> usize {
        self.columns as usize + 1
    }

    /// Angles of a ring, ascending; next to a slot, from its upper edge round to its lower one, then over it.
    fn angles(&self, keyway: Option<Keyway>, radius: f64) -> Vec<f64> {
        let n = self.columns;
        let Some(Keyway { width, .. }) = keyway else {
            return (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
        };
        let edge = (0.5 * width / radius).asin();
        let step = (TAU - 2.0 * edge) / f64::from(n);
        // An even number of chords: the crest of a half round end is one of their ends.
        let over = 2 * (edge / step).ceil().max(1.0) as u32;
        let round = (0..=n).map(|i| edge + step * f64::from(i));
        let arc = (1..over).map(|i| TAU - edge + 2.0 * edge * f64::from(i) / f64::from(over));
        round.chain(arc).collect()
    }
}

fn push(mesh: &mut Mesh, vertex: [f64; 3]) -> u32 {
    mesh.vertices.push(vertex);
    (mesh.vertices.len() - 1) as u32
}

/// A triangle counter-clockwise seen from above, reversed where the surface faces down.
fn face(mesh: &mut Mesh, [a, b, c]: [u32; 3], way: f64) {
    mesh.faces
        .push(if way > 0.0 { [a, b, c] } else { [a, c, b] });
}

/// Quadrangles between two rings of equal count, the second beyond the first along `way`.
fn band(mesh: &mut Mesh, first: &[u32], second: &[u32], way: f64) {
    let n = first.len();
    for i in 0..n {
        let j = (i + 1) % n;
        face(mesh, [first[i], first[j], second[j]], way);
        face(mesh, [first[i], second[j], second[i]], way);
    }
}

/// The cylinder between an arc and a quarter of a slot's half round end. Both lead from the slot's wall to the crest, which they
/// share.
///
/// The vertices are taken in the order of their distances from the crest. The whole quarter is visible from the arc's first
/// vertex.
fn corner(mesh: &mut Mesh, arc: &[u32], quarter: &[u32], way: f64) {
    let aside = |v: u32| mesh.vertices[v as usize][1].abs();
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::new();
    while i + 1 < arc.len() || j + 1 < quarter.len() {
        let of_quarter = i + 1 >= arc.len()
            || (j + 1 < quarter.len() && aside(quarter[j + 1]) >= aside(arc[i + 1]));
        if of_quarter {
            triangles.push([arc[i], quarter[j + 1], quarter[j]]);
            j += 1;
        } else {
            triangles.push([arc[i], arc[i + 1], quarter[j]]);
            i += 1;
        }
    }
    for triangle in triangles {
        // At the crest both chains end at one vertex.
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            face(mesh, triangle, way);
        }
    }
}

/// The flat ring between an outer and an inner circle of vertices, each ascending in angle from anywhere.
fn shoulder(mesh: &mut Mesh, outer: &[u32], inner: &[u32], way: f64) {
    let angle = |v: u32| {
        let [x, y, _] = mesh.vertices[v as usize];
        y.atan2(x).rem_euclid(TAU)
    };
    let sorted = |ring: &[u32]| -> Vec<(f64, u32)> {
        let mut ring: Vec<(f64, u32)> = ring.iter().map(|&v| (angle(v), v)).collect();
        ring.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (first, vertex) = ring[0];
        ring.push((first + TAU, vertex));
        ring
    };
    let (out, ins) = (sorted(outer), sorted(inner));
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::new();
    while i + 1 < out.len() || j + 1 < ins.len() {
        let of_outer = j + 1 >= ins.len() || (i + 1 < out.len() && out[i + 1].0 <= ins[j + 1].0);
        if of_outer {
            triangles.push([ins[j].1, out[i].1, out[i + 1].1]);
            i += 1;
        } else {
            triangles.push([ins[j].1, out[i].1, ins[j + 1].1]);
            j += 1;
        }
    }
    for triangle in triangles {
        face(mesh, triangle, way);
    }
}
