//! Change of the follower of a composed machine's cam to another kind.

#[cfg(test)]
mod tests;

use serde_json::{Map, Value as Json};
use toml_edit::{DocumentMut, Item, TableLike, Value};

use super::edit::{Step, container, replace, set, written};
use super::field::keys_next_to;
use super::kind::mechanism;
use super::machine::put_point;

/// Base radii that are tried, as shares of the old one: a flat face requires a less curved cam.
const BASES: [f64; 7] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.0, 4.0];
/// Lengths of a new arm that are tried, as shares of twice the base radius.
const ARMS: [f64; 4] = [0.75, 1.0, 0.5, 1.5];
/// Radius of a new roller, as a share of the base radius.
const ROLLER: f64 = 0.2;
/// Rates of a stroke at its ends.
const RATES: [&str; 4] = [
    "start_velocity",
    "end_velocity",
    "start_acceleration",
    "end_acceleration",
];
/// Angle between the directions of a new slide that are tried, degrees.
const APART: i64 = 30;
/// Position of a new pin, as a share of the base radius.
const PIN: f64 = 3.0;

/// Changes the kind of the follower at a path; `None` for anything but the follower of a cam on a body, or if it is of this kind
/// already.
///
/// Keys of both kinds stay. If a slide becomes an arm or vice versa, strokes become turns of the arm over the same length, and
/// bodies that follow the cam slide instead of turning, or vice versa.
pub(super) fn refollowed(
    document: &DocumentMut,
    steps: &[Step],
    kind: &str,
) -> Option<DocumentMut> {
    let [Step::Name(cams), Step::Name(cam), Step::Name(follower)] = steps else {
        return None;
    };
    if cams != "cams" || follower != "follower" {
        return None;
    }
    let text = document.to_string();
    let design = serde_json::to_value(text.parse::<toml::Table>().ok()?).ok()?;
    let spec = design.get("cams")?.get(cam)?;
    let old = spec.get("follower")?.as_object()?;
    let before = old.get("kind")?.as_str()?;
    if before == kind {
        return None;
    }
    let keys = keys_next_to(&text, &format!("cams.{cam}.follower"), kind)?;
    let change = Change {
        document,
        cam,
        kind,
        old,
        keys: &keys,
        base: spec
            .get("base_radius")
            .and_then(Json::as_f64)
            .unwrap_or(20.0),
        turns: swings(before) != swings(kind),
        bodies: followers(&design, cam),
    };
    let made = change.made();
    let mut sound = made
        .iter()
        .filter(|made| mechanism(&made.to_string()).is_ok());
    // If no design is a mechanism, the fault is elsewhere, for example a gear on a body that slides.
    sound.next().or(made.first()).cloned()
}

fn swings(kind: &str) -> bool {
    kind.starts_with("swinging")
}

/// Bodies that follow a cam, each with the value of its key `on`.
fn followers(design: &Json, cam: &str) -> Vec<(String, Option<String>)> {
    let bodies = design.get("bodies").and_then(Json::as_object);
    let follows = |body: &Json| {
        body.get("law")?
            .get("follows")?
            .as_str()
            .map(|own| own == cam)
    };
    let bodies = bodies.into_iter().flatten();
    let bodies = bodies.filter(|(_, body)| follows(body) == Some(true));
    let on = |body: &Json| Some(body.get("on")?.as_str()?.to_owned());
    bodies
        .map(|(name, body)| (name.clone(), on(body)))
        .collect()
}

/// Rounds to a thousandth: numbers in the file are to be read.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// Change of the kind of a follower.
struct Change<'a> {
    document: &'a DocumentMut,
    cam: &'a str,
    kind: &'a str,
    old: &'a Map<String, Json>,
    /// Keys of the new kind.
    keys: &'a Map<String, Json>,
    base: f64,
    /// Whether a slide becomes an arm, or vice versa.
    turns: bool,
    bodies: Vec<(String, Option<String>)>,
}

/// One try: shares of base radius and arm, sense in which the cam lifts, direction of a slide, and whether a new pin is made.
#[derive(Clone, Copy)]
struct Try {
    base: f64,
    arm: f64,
    lifts: &'static str,
    slide: i64,
    pinned: bool,
}

impl Change<'_> {
    /// Designs with the new kind, the one nearest to the old design first.
    fn made(&self) -> Vec<DocumentMut> {
        let swings = swings(self.kind);
        let arms = if self.is_new("arm_length") {
            &ARMS[..]
        } else {
            &ARMS[..1]
        };
        let lifts = if swings {
            &["counter-clockwise", "clockwise"][..]
        } else {
            &["counter-clockwise"]
        };
        let slides = if self.turns && !swings {
            360 / APART
        } else {
            1
        };
        let pins = if self.turns && swings {
            &[false, true][..]
        } else {
            &[false]
        };
        let mut found = Vec::new();
        for base in BASES {
            for &pinned in pins {
                for &arm in arms {
                    for &lifts in lifts {
                        let tries = (0..slides).map(|slide| Try {
                            base,
                            arm,
                            lifts,
                            slide: APART * slide,
                            pinned,
                        });
                        found.extend(tries.filter_map(|one| self.with(one)));
                    }
                }
            }
        }
        found
    }

    /// Whether the new kind has a key for which the old follower has no value.
    fn is_new(&self, key: &str) -> bool {
        self.keys.contains_key(key) && !self.old.contains_key(key)
    }

    fn with(&self, one: Try) -> Option<DocumentMut> {
        let mut made = self.document.clone();
        let cam = [Step::named("cams"), Step::named(self.cam)];
        let table = container(made.as_item_mut(), &cam, true)?;
        if one.base > 1.0 {
            let base = written(&short(one.base * self.base).into())?;
            set(table, &Step::named("base_radius"), base)?;
        }
        if self.turns {
            let arm = self
                .old
                .get("arm_length")
                .and_then(Json::as_f64)
                .unwrap_or(2.0 * one.arm * self.base);
            self.stroke(table, arm);
        }
        let follower = table
            .as_table_like_mut()?
            .get_mut("follower")?
            .as_table_like_mut()?;
        self.refill(follower, one)?;
        if self.turns {
            self.hold(&mut made, one)?;
        }
        Some(made)
    }

    /// Replaces the old keys by those of the new kind; the distance from the axis follows from the bodies.
    fn refill(&self, follower: &mut dyn TableLike, one: Try) -> Option<()> {
        let away = ["offset", "center_distance"];
        for key in self.old.keys().filter(|key| *key != "kind") {
            if !self.keys.contains_key(key) || away.contains(&key.as_str()) {
                follower.remove(key);
            }
        }
        replace(follower.get_mut("kind")?.as_value_mut()?, self.kind.into());
        for (key, value) in [
            ("roller_radius", short(ROLLER * self.base)),
            ("arm_length", short(2.0 * one.arm * self.base)),
        ] {
            if self.is_new(key) {
                follower.insert(key, Item::Value(value.into()));
            }
        }
        let own = self
            .old
            .get("lifts")
            .and_then(Json::as_str)
            .unwrap_or("counter-clockwise");
        // The first sense is the old one.
        let turned = one.lifts == "clockwise";
        let lifts = match (own, turned) {
            ("clockwise", false) | ("counter-clockwise", true) => "clockwise",
            _ => "counter-clockwise",
        };
        if self.keys.contains_key("lifts") && lifts != own {
            follower.insert("lifts", Item::Value(lifts.into()));
        }
        Some(())
    }

    /// Changes strokes of a slide to turns of an arm over the same length, or vice versa.
    fn stroke(&self, cam: &mut Item, arm: f64) {
        let Some(segments) = cam
            .get_mut("motion")
            .and_then(|motion| motion.get_mut("segments"))
        else {
            return;
        };
        let (from, to, scale) = match swings(self.kind) {
            true => ("lift", "swing_deg", (1.0 / arm).to_degrees()),
            false => ("swing_deg", "lift", 1.0_f64.to_radians() * arm),
        };
        let change = |segment: &mut dyn TableLike| {
            let value = segment.remove(from).and_then(|value| number(&value));
            if let Some(value) = value {
                segment.insert(to, Item::Value(short(value * scale).into()));
            }
            // Rates of an arm are in rad of the arm per rad of the cam.
            let rate = if swings(self.kind) { 1.0 / arm } else { arm };
            for key in RATES {
                if let Some(value) = segment.get(key).and_then(number) {
                    segment.insert(key, Item::Value((value * rate).into()));
                }
            }
        };
        if let Some(tables) = segments.as_array_of_tables_mut() {
            tables.iter_mut().for_each(|table| change(table));
        } else if let Some(list) = segments.as_array_mut() {
            list.iter_mut()
                .filter_map(Value::as_inline_table_mut)
                .for_each(|table| change(table));
        }
    }

    /// Makes bodies that follow the cam slide instead of turning, or vice versa.
    fn hold(&self, made: &mut DocumentMut, one: Try) -> Option<()> {
        for (body, on) in &self.bodies {
            let steps = [Step::named("bodies"), Step::named(body)];
            let table = container(made.as_item_mut(), &steps, true)?.as_table_like_mut()?;
            if !swings(self.kind) {
                table.insert("slides_deg", Item::Value(one.slide.into()));
                continue;
            }
            table.remove("slides_deg");
            let Some(holder) = on
                .as_ref()
                .and_then(|on| on.split('.').next())
                .filter(|_| one.pinned)
            else {
                continue;
            };
            let pin = format!("{body}-pin");
            table.insert("on", Item::Value(format!("{holder}.{pin}").into()));
            put_point(made, holder, &pin, [short(PIN * self.base), 0.0])?;
        }
        Some(())
    }
}

fn number(item: &Item) -> Option<f64> {
    item.as_float()
        .or_else(|| item.as_integer().map(|whole| whole as f64))
}
