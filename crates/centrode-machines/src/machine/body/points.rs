use centrode_spec::Named;
use std::collections::BTreeSet;

use centrode_geometry::{Point, Vector};
use nalgebra::Rotation2;

use crate::machine::copies::expansion::Expansion;
use crate::machine::design::FRAME;
use crate::machine::{
    CornerSpec, DyadKind, Machine, MachineBodySpec, MachineCamSpec, MachineDesign, MachineDyadSpec,
    MachineError,
};

/// Gap at which the sides of a triangle still meet within rounding, as a share of their sum.
const ROUNDING: f64 = 1e-14;

/// Name of the point of a follower at the centre of its roller.
pub(in crate::machine) const ROLLER: &str = "roller";

/// Name of the point of a flat-faced follower that touches the base circle of a cam cut to its motion.
pub(in crate::machine) const FACE: &str = "face";

/// Points of every body by name.
pub(in crate::machine) type BodyPoints = Named<Named<LocalPoint>>;

/// A point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::machine) struct LocalPoint {
    /// Position in the body's axes, mm.
    pub(in crate::machine) at: Point,
    /// Whether its name comes from this body, not from the body to which it is pinned.
    pub(in crate::machine) own: bool,
}

/// A point of a body of a machine; the origin of the frame by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyPoint {
    /// Index of the body.
    pub body: usize,
    /// Position in the body's axes, mm.
    pub at: Point,
}

impl BodyPoint {
    /// Whether another point is on the same body and nearer than `length`, mm.
    pub(in crate::machine) fn is_near(self, other: Self, length: f64) -> bool {
        self.body == other.body && (self.at - other.at).norm() < length
    }
}

/// A point of a body, or the body's origin, as a key of the design names it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::machine) struct Reference {
    /// The body.
    pub(in crate::machine) body: String,
    /// The point; `None` for the origin.
    pub(in crate::machine) point: Option<String>,
}

impl Reference {
    /// Reads `body.point`.
    pub(in crate::machine) fn to_point(key: &str, word: &str) -> Result<Self, MachineError> {
        let found = Self::to_body(word);
        match found.point {
            Some(_) => Ok(found),
            None => Err(MachineError::NoReference {
                key: key.into(),
                word: word.into(),
            }),
        }
    }

    /// Reads `body` or `body.point`.
    pub(in crate::machine) fn to_body(word: &str) -> Self {
        match word.split_once('.') {
            Some((body, point)) => Self {
                body: body.into(),
                point: Some(point.into()),
            },
            None => Self {
                body: word.into(),
                point: None,
            },
        }
    }

    /// Position of the point in the body's axes.
    pub(in crate::machine) fn find(
        &self,
        key: &str,
        bodies: &BodyPoints,
    ) -> Result<Point, MachineError> {
        let Some(points) = bodies.get(&self.body) else {
            return Err(MachineError::unknown(
                key,
                "body",
                self.body.clone(),
                bodies.keys().cloned(),
            ));
        };
        let Some(name) = &self.point else {
            return Ok(Point::origin());
        };
        points
            .get(name)
            .map(|p| p.at)
            .ok_or_else(|| MachineError::NoPoint {
                key: key.into(),
                body: self.body.clone(),
                point: name.clone(),
                known: points.keys().cloned().collect(),
            })
    }
}

/// Cam that a body follows, and the key that names it.
pub(in crate::machine) fn followed_cam<'a>(
    design: &'a MachineDesign,
    name: &str,
    body: &MachineBodySpec,
) -> Result<Option<(String, &'a MachineCamSpec)>, MachineError> {
    let Some(cam) = body.law.as_ref().and_then(|law| law.follows.as_ref()) else {
        return Ok(None);
    };
    let key = format!("bodies.{name}.law.follows");
    match design.cams.get(cam) {
        Some(spec) => Ok(Some((key, spec))),
        None => Err(MachineError::unknown(
            key,
            "cam",
            cam.clone(),
            design.cams.keys().cloned(),
        )),
    }
}

/// The points of every body: the given ones, and those at which it is pinned to others.
pub(in crate::machine) fn points_of(
    design: &MachineDesign,
    expansion: &Expansion,
) -> Result<BodyPoints, MachineError> {
    let mut all = BodyPoints::new();
    all.insert(FRAME.into(), Named::new());
    for (name, body) in &design.bodies {
        all.entry(name.clone()).or_default();
        if let (Some(on), None, None) = (&body.on, body.slides, &body.mesh) {
            let key = format!("bodies.{name}.on");
            let pin = Reference::to_point(&key, on)?;
            if pin.body == *name {
                let names = vec![format!("body {name}")];
                return Err(MachineError::Ring { key, names });
            }
            let pin = expansion.pin(&pin);
            add(&mut all, &key, name, &pin, Point::origin(), false)?;
        }
    }
    for (name, body) in &design.bodies {
        let Some((key, cam)) = followed_cam(design, name, body)? else {
            continue;
        };
        if let (Some(arm), Some(law)) = (cam.follower.arm(), &body.law) {
            let at = match body.slides {
                Some(_) => Point::new(arm - law.offset(), 0.0),
                None => Rotation2::new(-law.offset()) * Point::new(arm, 0.0),
            };
            add(&mut all, &key, name, ROLLER, at, true)?;
        }
    }
    for (name, dyad) in &design.dyads {
        pins(&format!("dyads.{name}"), dyad, expansion, &mut all)?;
    }
    let frame = &design.frame;
    let of_frame = (FRAME.to_owned(), (FRAME, &frame.points, &frame.corners));
    let of_bodies = design.bodies.iter().map(|(name, body)| {
        let key = format!("bodies.{name}");
        (key, (name.as_str(), &body.points, &body.corners))
    });
    for (key, (body, points, corners)) in std::iter::once(of_frame).chain(of_bodies) {
        for (point, at) in points {
            let key = format!("{key}.points.{point}");
            add(&mut all, &key, body, point, Point::from(*at), true)?;
        }
        place_corners(&format!("{key}.corners"), body, corners, &mut all)?;
    }
    for (name, cam) in &design.cams {
        Reference::to_body(&cam.on).find(&format!("cams.{name}.on"), &all)?;
        if let Some(about) = &cam.about {
            Reference::to_body(about).find(&format!("cams.{name}.about"), &all)?;
        }
    }
    Ok(all)
}

/// Adds the points at which the bodies of a dyad are pinned, each in the axes of its body.
fn pins(
    key: &str,
    dyad: &MachineDyadSpec,
    expansion: &Expansion,
    all: &mut BodyPoints,
) -> Result<(), MachineError> {
    let [first, second] = &dyad.bodies;
    for body in &dyad.bodies {
        all.entry(body.clone()).or_default();
    }
    let origin = Point::origin();
    let along = |i: usize| Point::new(dyad.lengths.get(i).copied().unwrap_or(0.0), 0.0);
    let end = |word: &Option<String>, key: &str| -> Result<String, MachineError> {
        let pin = word.as_ref().map(|word| Reference::to_point(key, word));
        let pin = pin.transpose()?;
        Ok(pin.map(|pin| expansion.pin(&pin)).unwrap_or_default())
    };
    let [from_key, to_key] = ["from", "to"].map(|end| format!("{key}.{end}"));
    let (from, to) = (end(&dyad.from, &from_key)?, end(&dyad.to, &to_key)?);
    let joint = dyad.joint.clone().unwrap_or_default();
    let joint_key = format!("{key}.joint");
    let (from_at, to_at) = ((&from, from_key.as_str()), (&to, to_key.as_str()));
    let joint_at = (&joint, joint_key.as_str());
    // Body; its key and point name; position; whether the point is named by this body.
    let made: Vec<(&String, (&String, &str), Point, bool)> = match dyad.kind {
        DyadKind::TwoBars => vec![
            (first, from_at, origin, false),
            (second, to_at, origin, false),
            (first, joint_at, along(0), true),
            (second, joint_at, along(1), false),
        ],
        DyadKind::BarAndSlider => vec![
            (first, from_at, origin, false),
            (first, joint_at, along(0), true),
            (second, joint_at, origin, false),
        ],
        DyadKind::GuideThroughBlock => vec![
            (first, from_at, origin, false),
            (second, to_at, origin, false),
        ],
        DyadKind::TwoSliders => vec![
            (first, joint_at, origin, true),
            (second, joint_at, origin, false),
        ],
        DyadKind::Yoke => vec![
            (first, from_at, origin, false),
            (second, joint_at, origin, true),
        ],
    };
    for (body, (point, key), at, own) in made {
        if !point.is_empty() {
            add(all, key, body, point, at, own)?;
        }
    }
    Ok(())
}

fn add(
    all: &mut BodyPoints,
    key: &str,
    body: &str,
    point: &str,
    at: Point,
    own: bool,
) -> Result<(), MachineError> {
    let points = all.entry(body.into()).or_default();
    if points
        .insert(point.into(), LocalPoint { at, own })
        .is_some()
    {
        return Err(MachineError::PointTwice {
            key: key.into(),
            body: body.into(),
            point: point.into(),
        });
    }
    Ok(())
}

/// Places corners of triangles, each as soon as the two points of its sides are placed.
fn place_corners(
    key: &str,
    body: &str,
    corners: &Named<CornerSpec>,
    all: &mut BodyPoints,
) -> Result<(), MachineError> {
    let mut left: Vec<(&String, &CornerSpec)> = corners.iter().collect();
    while !left.is_empty() {
        let known = all.get(body).cloned().unwrap_or_default();
        let ready = |corner: &CornerSpec| corner.from.iter().all(|p| known.contains_key(p));
        let Some(next) = left.iter().position(|(_, corner)| ready(corner)) else {
            break;
        };
        let (name, corner) = left.remove(next);
        let key = format!("{key}.{name}");
        let [p, q] = corner.from.each_ref().map(|name| known[name].at);
        let at = third_corner(&key, [p, q], corner)?;
        add(all, &key, body, name, at, true)?;
    }
    let Some((name, corner)) = left.first() else {
        return Ok(());
    };
    // Either a name that is not a point, or corners that depend on each other.
    let missing = corner
        .from
        .iter()
        .find(|p| !corners.contains_key(*p) && !all[body].contains_key(*p));
    match missing {
        Some(point) => Err(MachineError::NoPoint {
            key: format!("{key}.{name}"),
            body: body.into(),
            point: point.clone(),
            known: all[body].keys().cloned().collect(),
        }),
        None => Err(MachineError::Ring {
            key: format!("{key}.{name}"),
            names: left
                .iter()
                .map(|(name, _)| format!("{key}.{name}"))
                .collect(),
        }),
    }
}

/// Third corner of a triangle over the line from p to q: along the line by the law of cosines, the height by Heron's formula.
fn third_corner(key: &str, [p, q]: [Point; 2], corner: &CornerSpec) -> Result<Point, MachineError> {
    let [a, b] = corner.lengths;
    let way: Vector = q - p;
    let apart = way.norm();
    let missing = (apart - a - b).max((a - b).abs() - apart);
    if missing > ROUNDING * (a + b) || apart == 0.0 {
        return Err(MachineError::NoTriangle {
            key: key.into(),
            lengths: corner.lengths,
            apart,
            missing: missing.max(0.0),
        });
    }
    // Heron's formula in this form keeps its accuracy for slender triangles.
    let along = 0.5 * (apart + (a - b) * (a + b) / apart);
    let room = ((a + b + apart) * (a + b - apart)) * ((apart + a - b) * (apart - a + b));
    let height = 0.5 * room.max(0.0).sqrt() / apart;
    let unit = way / apart;
    let left = Vector::new(-unit.y, unit.x);
    Ok(p + unit * along + left * (corner.side.sign() * height))
}

impl Machine {
    /// Points on which other bodies turn, as `body.point`.
    pub(in crate::machine) fn pinned(&self) -> BTreeSet<String> {
        let design = &self.design;
        let bodies = design.bodies.values();
        let turning = bodies.filter(|body| body.slides.is_none() && body.mesh.is_none());
        let on = turning.filter_map(|body| body.on.clone());
        let dyads = design.dyads.values().flat_map(|dyad| {
            let ends = dyad.from.iter().chain(&dyad.to).cloned();
            let joint = dyad.joint.iter();
            let joint =
                joint.flat_map(|joint| dyad.bodies.iter().map(move |b| format!("{b}.{joint}")));
            ends.chain(joint).collect::<Vec<_>>()
        });
        let following = design.bodies.iter().filter(|(_, body)| {
            let law = body.law.as_ref();
            law.is_some_and(|law| law.follows.is_some())
        });
        let cut = design.cams.values().filter_map(|cam| cam.cut_to.as_ref());
        let rollers = following.map(|(name, _)| name).chain(cut);
        let rollers = rollers.map(|name| format!("{name}.{ROLLER}"));
        on.chain(dyads).chain(rollers).collect()
    }

    /// Points whose paths are of interest: moving points that hold no other body. Given points only, or joints if none is given.
    pub(in crate::machine) fn followed(&self) -> Vec<String> {
        let design = &self.design;
        let bodies = design.bodies.values();
        let held = bodies.flat_map(|body| body.on.iter().chain(&body.fixed_to));
        let dyads = design.dyads.values();
        let tied = dyads.flat_map(|dyad| [&dyad.from, &dyad.to, &dyad.line, &dyad.second_line]);
        let words: BTreeSet<&String> = held.chain(tied.flatten()).collect();
        // A joint has a name on each of its bodies.
        let joints: Vec<[String; 2]> = design
            .dyads
            .values()
            .filter_map(|dyad| {
                let joint = dyad.joint.as_ref()?;
                Some(dyad.bodies.each_ref().map(|body| format!("{body}.{joint}")))
            })
            .collect();
        let of = |name: &String| joints.iter().find(|names| names.contains(name));
        let free = |name: &String| match of(name) {
            Some(names) => !names.iter().any(|name| words.contains(name)),
            None => !words.contains(name),
        };
        let moving = self.points().filter(|(_, point)| point.body > 0);
        let all = moving.map(|(name, _)| name).filter(free);
        let (ties, given): (Vec<String>, Vec<String>) = all.partition(|name| of(name).is_some());
        if given.is_empty() { ties } else { given }
    }
}
