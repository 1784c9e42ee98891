use std::f64::consts::TAU;

use centrode_geometry::{Mesh, Tolerance};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::plan::columns;
use crate::gear::design::rule::{
    Rule, broken, hole_class, not_negative, positive, shaft_class, single_line,
};
use crate::gear::design::{Keyway, SpecError};
use crate::shaft::{Groove, ShaftError};

/// Body of the shaft, apart from its groove.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct ShaftBody {
    /// Length of full cylinder beyond the groove at each end, mm.
    pub margin: f64,
    /// Radius between the groove's walls and its floor, mm.
    pub fillet: f64,
    /// Diameter of the journals at both ends, mm.
    pub journal_diameter: f64,
    /// Tolerance class of the journals, ISO 286, for the drawing.
    pub journal_fit: String,
    /// Length of each journal, mm.
    pub journal_length: f64,
    /// Chamfers at 45 deg on every end, mm.
    pub chamfer: f64,
    /// Keyway in the near journal, along x, open at its end; depth from the journal's surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keyway: Option<Keyway>,
    /// Tolerance class of the keyway's width, ISO 286, for the drawing.
    pub keyway_fit: String,
    /// Length of the keyway, mm.
    pub keyway_length: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Material, for the drawing.
    pub material: String,
}

impl Default for ShaftBody {
    fn default() -> Self {
        Self {
            margin: 8.0,
            fillet: 0.5,
            journal_diameter: 16.0,
            journal_fit: "h6".into(),
            journal_length: 25.0,
            chamfer: 1.0,
            keyway: Some(Keyway {
                width: 5.0,
                depth: 3.0,
            }),
            keyway_fit: "N9".into(),
            keyway_length: 18.0,
            density: 7850.0,
            material: "steel".into(),
        }
    }
}

impl ShaftBody {
    /// Checks the ranges, and that everything fits the groove's shaft.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn validate(&self, groove: &Groove) -> Result<(), ShaftError> {
        self.ranges(groove).map_err(|e| e.inside("body").into())
    }

    fn ranges(&self, groove: &Groove) -> Result<(), SpecError> {
        positive("margin", self.margin)?;
        not_negative("fillet", self.fillet)?;
        positive("journal_diameter", self.journal_diameter)?;
        positive("journal_length", self.journal_length)?;
        not_negative("chamfer", self.chamfer)?;
        positive("density", self.density)?;
        hole_class("keyway_fit", &self.keyway_fit)?;
        shaft_class("journal_fit", &self.journal_fit)?;
        single_line("material", &self.material)?;
        let below = |key: &str, value: f64, limit: f64| {
            if value < limit {
                return Ok(());
            }
            let rule = Rule::OutOfRange {
                value,
                least: 0.0,
                greatest: limit,
                unit: " mm",
            };
            broken(key, rule)
        };
        below("fillet", self.fillet, 0.5 * groove.width())?;
        below("fillet", self.fillet, groove.depth())?;
        let (radius, journal) = (groove.radius(), 0.5 * self.journal_diameter);
        below("journal_diameter", self.journal_diameter, 2.0 * radius)?;
        below("chamfer", self.chamfer, radius - journal)?;
        below("chamfer", self.chamfer, self.margin)?;
        below("chamfer", self.chamfer, 0.5 * journal)?;
        below("chamfer", self.chamfer, self.journal_length)?;
        if let Some(Keyway { width, depth }) = self.keyway {
            positive("keyway.width", width)?;
            positive("keyway.depth", depth)?;
            positive("keyway_length", self.keyway_length)?;
            let end = journal - self.chamfer;
            below("keyway.width", width, 1.8 * end)?;
            let edge = (end * end - 0.25 * width * width).sqrt();
            below("keyway.depth", depth, journal)?;
            below("keyway.depth", journal - depth, edge)?;
            below("keyway_length", self.keyway_length, self.journal_length)?;
            below("chamfer", self.chamfer, self.keyway_length)?;
        }
        Ok(())
    }
}

/// Shoulders and journals that close the ends of the grooved surface.
#[derive(Debug)]
pub(super) struct Rings<'a> {
    body: &'a ShaftBody,
    radius: f64,
    columns: u32,
}

impl<'a> Rings<'a> {
    pub(super) fn new(body: &'a ShaftBody, radius: f64, tolerance: Tolerance) -> Self {
        Self {
            body,
            radius,
            columns: columns(0.5 * body.journal_diameter, tolerance.mm()),
        }
    }

    /// Adds shoulders and journals; the rims are counter-clockwise seen from above. The rims' own vertices
    /// are moved in by the chamfer and doubled where the cylinder begins.
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
        let mut before: Vec<u32> = full[..open].to_vec();
        let at_start = feet(mesh, start);
        before.extend(at_start);
        // The wall at the slot's inner end, over the arc that the slot removes.
        let mut arc: Vec<u32> = full[open - 1..].to_vec();
        arc.push(full[0]);
        for pair in arc.windows(2) {
            face(mesh, [at_start[0], pair[0], pair[1]], way);
        }
        face(mesh, [at_start[0], full[0], at_start[1]], way);
        let mut stations = vec![(radius, end)];
        if c > 0.0 {
            stations.push((radius - c, end + way * c));
        }
        for (radius, z) in stations {
            let mut contour = ring(mesh, radius, z);
            contour.truncate(open);
            contour.extend(feet(mesh, z));
            band(mesh, &before, &contour, way);
            before = contour;
        }
        self.slotted_end(mesh, &before, way);
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
        // From the slot's foot one sees the round part up to where the centre sees it too.
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

    /// Vertices of the round part beside a slot, both its edges included.
    fn open_count(&self) -> usize {
        self.columns as usize + 1
    }

    /// Angles of a ring, ascending; beside a slot, from its upper edge round to its lower one, then over it.
    fn angles(&self, keyway: Option<Keyway>, radius: f64) -> Vec<f64> {
        let n = self.columns;
        let Some(Keyway { width, .. }) = keyway else {
            return (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
        };
        let edge = (0.5 * width / radius).asin();
        let step = (TAU - 2.0 * edge) / f64::from(n);
        let over = (2.0 * edge / step).ceil().max(1.0) as u32;
        let round = (0..=n).map(|i| edge + step * f64::from(i));
        let arc = (1..over).map(|i| TAU - edge + 2.0 * edge * f64::from(i) / f64::from(over));
        round.chain(arc).collect()
    }
}

fn push(mesh: &mut Mesh, vertex: [f64; 3]) -> u32 {
    mesh.vertices.push(vertex);
    (mesh.vertices.len() - 1) as u32
}

/// A triangle counter-clockwise seen from above, turned over where the surface faces down.
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
