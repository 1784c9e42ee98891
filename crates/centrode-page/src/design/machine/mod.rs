//! Change of a dyad of a composed machine to another type.

pub(super) mod compose;
mod course;
mod forms;
#[cfg(test)]
mod tests;
mod writing;

pub(super) use self::course::Frame;
use self::course::{Course, ends, written};
pub(super) use self::writing::put_point;
use super::edit::{Step, container};
use super::kind::{MOST, mechanism, sound};
use centrode_families::FAMILIES;
use centrode_machines::machine::Machine;
use serde_json::{Map, Value as Json};
use std::collections::BTreeSet;
use std::sync::Arc;
use toml_edit::DocumentMut;

/// Maximum number of designs that are tried.
const TRIES: usize = 64;

/// Changes the type of the dyad at a path; `None` if there is no such dyad, or it is of this type.
///
/// Its bodies and the points that hold them stay. If there is such a machine, all bodies have their old pose at some input.
/// Points of the old type that hold other bodies are written into the design.
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
    // If no design is a mechanism, the fault is elsewhere.
    fallback
        .or_else(|| sound(first.clone(), &path, MOST))
        .or(Some(first))
}

/// The design as a mechanism, and whether tables were removed for that, at most `most`: goals of figures that do not exist any
/// more, and cams cut to a body that now slides instead of turning.
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

fn machine(text: &str) -> Option<Arc<Machine>> {
    let mechanism = FAMILIES.read(text.as_bytes()).ok()?.mechanism().ok()?;
    mechanism.downcast::<Machine>()
}

/// A new form of the dyad: its keys, the point of a line that its holder gets, the input at which the bodies keep their pose, and
/// the frames of both bodies there.
struct Form {
    keys: Map<String, Json>,
    point: Option<[f64; 2]>,
    stand: usize,
    frames: [Frame; 2],
}

/// Rounds to a millionth: numbers in the file stay readable, and the machine still closes with them.
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
    /// Designs with the new type, the one nearest to the old design first.
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
}
