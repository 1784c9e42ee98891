//! A dyad of a composed machine that becomes one of another type.

mod course;
#[cfg(test)]
mod tests;
mod writing;

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::Arc;

use crate::FAMILIES;
use crate::geometry::{Point, Vector};
use crate::mechanism::composed::Composed;
use serde_json::{Map, Value as Json, json};
use toml_edit::DocumentMut;

use self::course::{Course, Frame, ends, unit, written};
pub(super) use self::writing::put_point;
use super::edit::{Step, container};
use super::kind::{MOST, mechanism, sound};

/// Inputs of a period at which the new dyad may stand as the old.
const STANDS: usize = 6;
/// Most designs that are tried.
const TRIES: usize = 64;
/// Directions of a line that are tried.
const DIRECTIONS: u32 = 4;
/// Room of a bar beyond what it must reach, as a share of that.
const ROOM: f64 = 1.02;
/// Distance below which two points are one, and that of a point beside another in its place, mm.
const NEAR: f64 = 1e-3;
const BESIDE: f64 = 20.0;
/// Sine of the angle of two lines below which they hold badly.
const FLAT: f64 = 0.3;

/// Changes the type of the dyad at a path; none where there is no such dyad, or it is of this type.
///
/// Its bodies, and what they are held by, stay. Where there is such a machine, all stands at some input as it did; points that the old type gave
/// its bodies, and others are held by, are written out.
pub(super) fn retyped(document: &DocumentMut, steps: &[Step], word: &str) -> Option<DocumentMut> {
    let [Step::Name(dyads), Step::Name(name)] = steps else {
        return None;
    };
    if dyads != "dyads" {
        return None;
    }
    let text = document.to_string();
    let design = serde_json::to_value(text.parse::<toml::Table>().ok()?).ok()?;
    let spec = design.get("dyads")?.get(name)?;
    if spec.get("type")? == word {
        return None;
    }
    let path = format!("dyads.{name}");
    let retype = Retype {
        document,
        spec,
        design: &design,
        name,
        word,
    };
    let course = machine(&text).and_then(|machine| Course::new(&machine, name, spec));
    let made: Vec<DocumentMut> = retype.made(course.as_ref());
    let mut fallback = None;
    for made in made.iter().take(TRIES) {
        let may_lose = if fallback.is_none() { MOST } else { 0 };
        match fitted(made.clone(), may_lose) {
            Some((found, false)) => return Some(found),
            Some((found, true)) => fallback = Some(found),
            None => {}
        }
    }
    let first = made.into_iter().next()?;
    // Where nothing helps the fault is elsewhere.
    fallback
        .or_else(|| sound(first.clone(), &path, MOST))
        .or(Some(first))
}

/// The design as a mechanism, and whether one of at most so many tables went for that: goals of figures that are no more, and cams cut to a body that now slides
/// in the place of turning.
fn fitted(mut document: DocumentMut, most: usize) -> Option<(DocumentMut, bool)> {
    for gone in 0..=most {
        let error = match mechanism(&document.to_string()) {
            Ok(()) => return Some((document, gone > 0)),
            Err(error) => error,
        };
        let mut path = error.key.split('.');
        let (table, name) = (path.next()?, path.next()?);
        if !(table == "goals" || table == "cams" && path.next() == Some("cut_to")) {
            return None;
        }
        let all = container(document.as_item_mut(), &[Step::named(table)], true)?;
        all.as_table_like_mut()?.remove(name)?;
    }
    None
}

fn machine(text: &str) -> Option<Arc<Composed>> {
    let mechanism = FAMILIES.read(text.as_bytes()).ok()?.mechanism().ok()?;
    mechanism.downcast::<Composed>()
}

/// A new form of the dyad: its keys, the point of a line that its holder gets, and the frames of both bodies where it stands as before.
struct Form {
    keys: Map<String, Json>,
    point: Option<[f64; 2]>,
    stand: usize,
    frames: [Frame; 2],
}

/// Rounds to a millionth: numbers in the file are to be read, and others are to close with them.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// Change of the type of a dyad.
struct Retype<'a> {
    document: &'a DocumentMut,
    spec: &'a Json,
    design: &'a Json,
    name: &'a str,
    word: &'a str,
}

impl Retype<'_> {
    /// Designs with the new type, the nearest to the old first.
    fn made(&self, course: Option<&Course>) -> Vec<DocumentMut> {
        let Some(held) = ends(self.spec) else {
            return Vec::new();
        };
        let swapped = [held[1].clone(), held[0].clone()];
        let Some(course) = course else {
            let forms = self.plain().into_iter();
            return forms
                .filter_map(|form| self.with(&form, &held, None, false))
                .collect();
        };
        let reversed = course.clone().reversed();
        let mut all = Vec::new();
        for (course, held, is_turned) in [(course, &held, false), (&reversed, &swapped, true)] {
            for form in self.forms(course) {
                all.extend(self.with(&form, held, Some(course), is_turned));
            }
        }
        let plain = self.plain();
        all.extend(
            plain
                .iter()
                .filter_map(|form| self.with(form, &held, None, false)),
        );
        all
    }

    /// Joint's name: the old one, else one that is free.
    fn joint(&self) -> String {
        written(self.spec, "joint").unwrap_or_else(|| self.free("joint", |_| true))
    }

    /// A name that no point of a body has, `word` or `word-2` and so on.
    fn free(&self, word: &str, counts: impl Fn(&str) -> bool) -> String {
        let mut taken = BTreeSet::new();
        let of = |table: &Json, taken: &mut BTreeSet<String>| {
            for kind in ["points", "corners"] {
                let names = table.get(kind).and_then(Json::as_object);
                taken.extend(names.into_iter().flat_map(|names| names.keys().cloned()));
            }
        };
        if counts("frame") {
            self.design
                .get("frame")
                .into_iter()
                .for_each(|frame| of(frame, &mut taken));
        }
        let bodies = self.design.get("bodies").and_then(Json::as_object);
        for (_, body) in bodies
            .into_iter()
            .flatten()
            .filter(|(name, _)| counts(name))
        {
            of(body, &mut taken);
        }
        let dyads = self.design.get("dyads").and_then(Json::as_object);
        let joints = dyads.into_iter().flatten();
        taken.extend(joints.filter_map(|(_, dyad)| written(dyad, "joint")));
        let names = (1..).map(|i| match i {
            1 => word.to_owned(),
            _ => format!("{word}-{i}"),
        });
        names
            .into_iter()
            .find(|name| !taken.contains(name))
            .unwrap_or_default()
    }

    /// Keys of the new type where nothing is known of the motion.
    fn plain(&self) -> Vec<Form> {
        let keys = match self.word {
            "RRR" => json!({ "joint": self.joint(), "lengths": [100.0, 100.0], "side": "left" }),
            "RRP" => {
                json!({ "joint": self.joint(), "lengths": [100.0], "side": "forward", "line_deg": 0.0 })
            }
            "RPR" => json!({ "side": "forward" }),
            "PRP" => json!({ "joint": self.joint(), "line_deg": 0.0, "second_line_deg": 90.0 }),
            "RPP" => json!({ "line_deg": 0.0, "slot_deg": 90.0 }),
            _ => return Vec::new(),
        };
        let keys = keys.as_object().cloned().unwrap_or_default();
        let frames = [Frame::along(Point::origin(), Vector::new(1.0, 0.0)); 2];
        vec![Form {
            keys,
            point: None,
            stand: 0,
            frames,
        }]
    }

    /// Forms of the new type between two ends.
    fn forms(&self, course: &Course) -> Vec<Form> {
        let stands = (0..STANDS).map(|i| i * course.count() / STANDS);
        let stands: Vec<usize> = stands.collect();
        match self.word {
            "RRR" => self.two_bars(course, &stands),
            "RPR" => stands
                .iter()
                .take(1)
                .map(|&stand| guide(course, stand))
                .collect(),
            "RRP" | "RPP" | "PRP" => self.on_lines(course, &stands),
            _ => Vec::new(),
        }
    }

    fn two_bars(&self, course: &Course, stands: &[usize]) -> Vec<Form> {
        let form = |stand: usize, joint: Point| {
            let [a, b] = [0, 1].map(|end| course.ends[end][stand]);
            let [one, other] = [joint - a, joint - b];
            let side = if (b - a).perp(&one) > 0.0 {
                "left"
            } else {
                "right"
            };
            let lengths = [short(one.norm()), short(other.norm())];
            let keys = json!({ "joint": self.joint(), "lengths": lengths, "side": side });
            Form {
                keys: keys.as_object().cloned().unwrap_or_default(),
                point: None,
                stand,
                frames: [Frame::along(a, one), Frame::along(b, other)],
            }
        };
        let mut found = Vec::new();
        for &stand in stands {
            found.extend(course.joint.iter().map(|joint| form(stand, joint[stand])));
        }
        // Bars of one length close as long as they reach.
        for side in [1.0, -1.0] {
            let [a, b] = [0, 1].map(|end| course.ends[end][0]);
            let (way, length) = (b - a, 0.75 * course.farthest());
            let high = (length.powi(2) - 0.25 * way.norm_squared()).max(0.0).sqrt();
            let across = Vector::new(-way.y, way.x) / way.norm().max(1e-12);
            found.push(form(0, a + way * 0.5 + across * (side * high)));
        }
        found
    }

    /// Forms with a line on the holder of the second end.
    fn on_lines(&self, course: &Course, stands: &[usize]) -> Vec<Form> {
        let local = |at: &Point, stand: usize| course.holders[1][stand].seen(*at);
        let mut found = Vec::new();
        for &stand in stands {
            let a = course.ends[0][stand];
            let joint = course.joint.as_ref().map_or_else(
                || a + (course.ends[1][stand] - a) * 0.5,
                |joint| joint[stand],
            );
            let place = local(&joint, stand);
            let last = course.count() - 1;
            let beside = [stand.saturating_sub(1), (stand + 1).min(last)].map(|at| {
                course
                    .joint
                    .as_ref()
                    .map_or_else(|| local(&course.ends[0][at], at), |j| local(&j[at], at))
            });
            let tangent = beside[1] - beside[0];
            let tangent = tangent.y.atan2(tangent.x);
            for turn in 0..DIRECTIONS {
                let angle = tangent + f64::from(turn) * FRAC_PI_4;
                found.extend(self.on_line(course, stand, (joint, place, angle)));
            }
        }
        // The line through the second end itself.
        let place = local(&course.ends[1][0], 0);
        for turn in 0..DIRECTIONS {
            let angle = f64::from(turn) * FRAC_PI_4;
            let through = course.ends[1][0];
            if let Some(form) = self.on_line(course, 0, (through, place, angle)) {
                found.push(Form {
                    point: None,
                    ..form
                });
            }
        }
        found
    }

    /// The new form with its joint at a place where it stands, on a line on the holder of the second end.
    fn on_line(
        &self,
        course: &Course,
        stand: usize,
        (joint, place, angle): (Point, Point, f64),
    ) -> Option<Form> {
        let a = course.ends[0][stand];
        let line = unit(course.holders[1][stand].angle + angle);
        let bar = joint - a;
        let degrees = short(angle.to_degrees());
        let mut point = place;
        let (keys, first) = match self.word {
            "RRP" => {
                let reach = ROOM * course.off(place, angle);
                let length = short(bar.norm().max(reach));
                if length <= 0.0 {
                    return None;
                }
                let side = if line.dot(&bar) >= 0.0 {
                    "forward"
                } else {
                    "backward"
                };
                let keys = json!({ "joint": self.joint(), "lengths": [length], "side": side, "line_deg": degrees });
                (keys, Frame::along(a, bar))
            }
            "RPP" => {
                let slot = line.perp(&bar).atan2(line.dot(&bar));
                let slot = if slot.sin().abs() < FLAT {
                    FRAC_PI_2
                } else {
                    slot
                };
                let mut keys = json!({ "line_deg": degrees, "slot_deg": short(slot.to_degrees()) });
                if let Some(joint) = written(self.spec, "joint") {
                    keys["joint"] = joint.into();
                }
                (keys, Frame::along(a, unit(line.y.atan2(line.x) + slot)))
            }
            _ => {
                let [own, other] = [0, 1].map(|end| course.holders[end][stand].angle);
                let across = line.y.atan2(line.x) + FRAC_PI_2;
                let way = match bar.norm() > 0.0 && line.perp(&bar.normalize()).abs() > FLAT {
                    true => bar.y.atan2(bar.x),
                    false => across,
                };
                // Lines on two bodies that turn against each other are parallel now and then.
                let turned = |i: usize| course.holders[1][i].angle - course.holders[0][i].angle;
                let most = (0..course.count()).map(|i| (turned(i) - turned(stand)).abs());
                let is_alone = most.fold(0.0, f64::max) > 1.2;
                // Then both are on the holder of the second end, one of them through that end.
                let end = course.holders[1][stand].seen(course.ends[1][stand]);
                let to_end = place - end;
                if to_end.norm() < NEAR {
                    point += unit(angle) * BESIDE;
                }
                let alone = match to_end.norm() > NEAR
                    && unit(angle).perp(&to_end.normalize()).abs() > FLAT
                {
                    true => to_end.y.atan2(to_end.x),
                    false => across - other,
                };
                let from = if is_alone { alone } else { way - own };
                let keys = json!({
                    "joint": self.joint(),
                    "line_deg": short(from.to_degrees()),
                    "second_line_deg": degrees,
                    "alone": is_alone,
                });
                (
                    keys,
                    Frame::along(joint, unit(if is_alone { across } else { way })),
                )
            }
        };
        Some(Form {
            keys: keys.as_object().cloned().unwrap_or_default(),
            point: Some([short(point.x), short(point.y)]),
            stand,
            frames: [first, Frame::along(joint, line)],
        })
    }
}

/// A guide that turns about the second end, through a block on the first.
fn guide(course: &Course, stand: usize) -> Form {
    let [a, b] = [0, 1].map(|end| course.ends[end][stand]);
    let keys = json!({ "side": "forward" });
    Form {
        keys: keys.as_object().cloned().unwrap_or_default(),
        point: None,
        stand,
        frames: [Frame::along(a, a - b), Frame::along(b, a - b)],
    }
}
