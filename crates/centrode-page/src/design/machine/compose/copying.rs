//! Copies of parts.

use serde_json::Value as Json;
use toml_edit::{Item, Value};

use super::adding::degrees;
use super::references::bodies_of;
use super::scene::Scene;
use super::writing::insert;
use super::{Composed, Refusal, naming};
use crate::design::edit::{Step, container, set};

/// Adds a copy of a part: a body half a turn further, a dyad on its other side, everything else as it is.
pub(super) fn copied(mut scene: Scene, key: &str) -> Result<Composed, Box<Refusal>> {
    let refused = |why: String| Box::new(Refusal::because(why));
    let none = || refused(format!("{key} cannot be copied"));
    let (table, name) = key.split_once('.').ok_or_else(none)?;
    let item = |scene: &Scene, table: &str, name: &str| {
        let all = scene.document.get(table)?.as_table_like()?;
        all.get(name).cloned()
    };
    let mut new = item(&scene, table, name).ok_or_else(none)?;
    if new.is_inline_table() {
        new = new.into_table().map_or_else(|same| same, Item::Table);
    }
    let copy = naming::part(&scene.design, name);
    let put = |item: &mut Item, path: &[Step], value: Value| {
        let (last, around) = path.split_last()?;
        set(container(item, around, true)?, last, value)
    };
    match table {
        "dyads" => {
            let bodies = bodies_of(&scene.design["dyads"][name]);
            let joint = scene.design["dyads"][name]["joint"]
                .as_str()
                .map(str::to_owned);
            let made = [0, 1].map(|i| naming::part(&scene.design, &bodies[i]));
            let pin = naming::point(&scene.design, &made[0]);
            for (i, body) in made.iter().enumerate() {
                let path = [Step::named("bodies"), Step::Index(i)];
                put(&mut new, &path, body.as_str().into()).ok_or_else(none)?;
            }
            if joint.is_some() {
                put(&mut new, &[Step::named("joint")], pin.as_str().into());
            }
            let side = match scene.design["dyads"][name]["side"].as_str() {
                Some("left") => Some("right"),
                Some("right") => Some("left"),
                Some("forward") => Some("backward"),
                Some("backward") => Some("forward"),
                _ => None,
            };
            if let Some(side) = side {
                put(&mut new, &[Step::named("side")], side.into());
            }
            insert(&mut scene.document, "dyads", &copy, new)?;
            // Corners and further points of the bodies come with them, mirrored like the dyad.
            for (old, made) in bodies.iter().zip(&made) {
                let Some(mut own) = item(&scene, "bodies", old) else {
                    continue;
                };
                if let Some(corners) = own.get_mut("corners").and_then(Item::as_table_like_mut) {
                    for (_, corner) in corners.iter_mut() {
                        follow(corner, joint.as_deref(), &pin, side.is_some());
                    }
                }
                let points = own.get_mut("points").and_then(Item::as_table_like_mut);
                if let (Some(points), true) = (points, side.is_some()) {
                    for (_, at) in points.iter_mut() {
                        mirror(at);
                    }
                }
                insert(&mut scene.document, "bodies", made, own)?;
            }
        }
        "bodies" if scene.design["bodies"][name].get("law").is_some() => {
            let law = &scene.design["bodies"][name]["law"];
            let turns = scene.design["bodies"][name].get("slides_deg").is_none();
            let start = law.get("start_deg").and_then(Json::as_f64).unwrap_or(0.0);
            if turns && law.get("follows").is_none() {
                let path = ["law", "start_deg"].map(Step::named);
                let turned = degrees((start + 180.0).to_radians());
                put(&mut new, &path, turned.into());
            }
            insert(&mut scene.document, table, &copy, new)?;
        }
        "bodies" | "pairs" | "gears" | "cams" | "loads" | "obstacles" | "goals" | "copies"
        | "meshes" => {
            insert(&mut scene.document, table, &copy, new)?;
        }
        _ => return Err(none()),
    }
    scene.reread();
    scene.finish(&format!("{table}.{copy}"), Composed::default())
}

/// A corner of the copy: measured from the copied joint, on the other side where the dyad is mirrored.
fn follow(corner: &mut Item, joint: Option<&str>, pin: &str, mirrored: bool) {
    for i in 0..2 {
        let own = corner.get("from").and_then(|from| from.get(i)?.as_str());
        if own.is_some()
            && own == joint
            && let Some(from) = corner.get_mut("from")
        {
            let _ = set(from, &Step::Index(i), pin.into());
        }
    }
    let side = corner.get("side").and_then(Item::as_str);
    let side = match side.filter(|_| mirrored) {
        Some("left") => "right",
        Some("right") => "left",
        _ => return,
    };
    let _ = set(corner, &Step::named("side"), side.into());
}

/// Mirrors a point at the x axis of its body.
fn mirror(at: &mut Item) {
    let y = at
        .get(1)
        .and_then(|y| y.as_float().or(y.as_integer().map(|y| y as f64)));
    if let Some(y) = y {
        let _ = set(at, &Step::Index(1), (0.0 - y).into());
    }
}
