//! The parts of a machine as the page lists and picks them.

use std::any::Any;

use centrode_families::Mechanism;
use centrode_kinematics::machine::JointKind;
use centrode_machines::machine::Machine;
use serde::Serialize;
use serde_json::Value as Json;

use super::references::TABLES;
use super::scene::is_empty;

/// Parts of a machine that can be picked, renamed, copied and deleted.
#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::design) struct Composition {
    /// Whether the machine has no body yet.
    empty: bool,
    /// Points by `body.point`.
    points: Vec<ComposedPoint>,
    /// Bodies in the order of the picture's links, the frame first.
    bodies: Vec<ComposedBody>,
    /// Keys of all parts.
    parts: Vec<String>,
    /// Figures that a goal may have, by the words of the design file.
    figures: Vec<String>,
}

/// A point of a body.
#[derive(Clone, Debug, Serialize)]
struct ComposedPoint {
    name: String,
    /// Index of the link it moves with.
    link: usize,
    /// Position in the axes of the link, mm.
    at: [f64; 2],
}

/// A body.
#[derive(Clone, Debug, Serialize)]
struct ComposedBody {
    name: String,
    /// Key of the part that is removed or renamed with it.
    key: String,
    /// Whether it turns on the body that carries it, by its own law or a mesh.
    turns: bool,
}

impl Composition {
    /// Keys of all parts.
    #[cfg(test)]
    pub(super) fn parts(&self) -> &[String] {
        &self.parts
    }

    /// Parts of a mechanism, if it is a composed machine.
    pub(in crate::design) fn of(mechanism: &dyn Mechanism, text: &str) -> Option<Self> {
        let any: &dyn Any = mechanism;
        let machine = any.downcast_ref::<Machine>()?;
        let design = read(text)?;
        let points = machine.points().map(|(name, point)| ComposedPoint {
            name,
            link: point.body,
            at: point.at.coords.into(),
        });
        let points: Vec<ComposedPoint> = points.collect();
        let bodies = machine.bodies().iter().map(|body| ComposedBody {
            name: body.name.clone(),
            key: format!("bodies.{}", body.name),
            turns: matches!(&body.mount, Some(mount) if mount.kind == JointKind::Turning)
                && design["bodies"]
                    .get(&body.name)
                    .is_some_and(|own| own.get("on").is_some()),
        });
        let bodies: Vec<ComposedBody> = bodies.collect();
        let of_points = points
            .iter()
            .filter(|point| point.link > 0)
            .flat_map(|point| {
                let parts = ["x", "y", "speed", "acceleration"];
                parts.map(|part| format!("{}.{part}", point.name))
            });
        let of_bodies = bodies
            .iter()
            .skip(1)
            .map(|body| format!("{}.angle", body.name));
        let dyads = machine.dyads().iter();
        let of_dyads = dyads.map(|dyad| format!("transmission({})", dyad.name));
        let figures = of_points.chain(of_bodies).chain(of_dyads).collect();
        Some(Self {
            empty: false,
            figures,
            parts: parts(&design),
            points,
            bodies,
        })
    }

    /// Parts of a machine that has no body yet: points of the frame.
    pub(in crate::design) fn empty(text: &str) -> Option<Self> {
        let design = read(text)?;
        if design.get("family").and_then(Json::as_str) != Some("machine") || !is_empty(&design) {
            return None;
        }
        let points = design["frame"]["points"].as_object().into_iter().flatten();
        let points = points.filter_map(|(name, at)| {
            let at = serde_json::from_value(at.clone()).ok()?;
            Some(ComposedPoint {
                name: format!("frame.{name}"),
                link: 0,
                at,
            })
        });
        Some(Self {
            empty: true,
            points: points.collect(),
            bodies: vec![ComposedBody {
                name: "frame".into(),
                key: String::new(),
                turns: false,
            }],
            parts: parts(&design),
            figures: Vec::new(),
        })
    }
}

fn read(text: &str) -> Option<Json> {
    serde_json::to_value(text.parse::<toml::Table>().ok()?).ok()
}

/// Keys of all parts as written: points, bodies and the rest.
fn parts(design: &Json) -> Vec<String> {
    let mut found = Vec::new();
    let points = |path: &str, own: &Json, found: &mut Vec<String>| {
        for kind in ["points", "corners"] {
            let names = own[kind].as_object().into_iter().flatten();
            found.extend(names.map(|(name, _)| format!("{path}.{kind}.{name}")));
        }
    };
    for table in TABLES {
        for (name, part) in design[table].as_object().into_iter().flatten() {
            let key = format!("{table}.{name}");
            found.push(key.clone());
            if table == "bodies" {
                points(&key, part, &mut found);
            }
            if table == "dyads" {
                let bodies =
                    super::references::bodies_of(part).map(|body| format!("bodies.{body}"));
                let written = bodies.iter().filter(|body| {
                    design["bodies"]
                        .get(body.trim_start_matches("bodies."))
                        .is_none()
                });
                found.extend(written.cloned());
            }
        }
    }
    points("frame", &design["frame"], &mut found);
    found.sort();
    found.dedup();
    found
}
