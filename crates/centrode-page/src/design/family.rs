use centrode_families::FAMILIES;
use serde_json::{Map, Value as Json};
use toml_edit::{DocumentMut, Item};

use super::edit::{Step, container, set, written};
use super::field::tables;
use super::kind::{fresh, mechanism};

/// Names of numbers that mean the same in every table.
const ALIKE: [&str; 6] = [
    "module",
    "tooth_count",
    "pressure_angle_deg",
    "backlash",
    "material",
    "speed_rpm",
];

/// Tables of requirements and searches: their numbers are only copied among these tables.
const WISHES: [&str; 3] = ["goals", "bounds", "optimise"];

/// A key of a design, and its value.
type Entry = (String, Json);

/// Design of another family, with those keys of this design with which it is a mechanism; `None` if the design is of that family,
/// or there is no such family.
///
/// It starts from the template of the family. A key is copied to the same path, else to one with the same ending (`lead`,
/// `shaft.lead`), and a few keys that mean the same everywhere are copied by their names alone.
pub(super) fn turned(document: &DocumentMut, word: &str) -> Option<DocumentMut> {
    let old = serde_json::to_value(document.to_string().parse::<toml::Table>().ok()?).ok()?;
    if old.get("family").is_some_and(|now| now == word) {
        return None;
    }
    let template = FAMILIES.template(word)?;
    let required = entries(template, &old);
    let start: DocumentMut = template.parse().ok()?;
    let (kept, lost) = with_as_many(start, &required);
    // A key that did not fit before the others were set may fit now.
    Some(with_as_many(kept, &lost).0)
}

/// Keys of a template's family for which a design has values.
fn entries(template: &str, old: &Json) -> Vec<Entry> {
    let mut written = Vec::new();
    list("", old, &mut written);
    let mut found: Vec<Entry> = Vec::new();
    for table in tables(template) {
        let inside = |key: &str| {
            let mut around = found.iter().map(|(key, _)| key);
            around.any(|table| {
                key.strip_prefix(table.as_str())
                    .is_some_and(|rest| rest.starts_with('.'))
            })
        };
        if inside(&table.key) {
            continue;
        }
        // A table with a kind is copied as a whole: its numbers mean nothing without the kind.
        if let Some((_, value)) = written.iter().find(|(key, value)| {
            value.is_object() && (*key == table.key || same_end(key, &table.key))
        }) {
            found.push((table.key, value.clone()));
            continue;
        }
        for field in table.fields {
            let value = value_for(&field.key, &written);
            found.extend(value.map(|value| (field.key, value)));
        }
    }
    found.retain(|(key, _)| key != "family");
    found
}

/// All keys of a table, those of inner tables by their paths; a table with a kind counts as one key.
fn list(path: &str, value: &Json, out: &mut Vec<Entry>) {
    match value {
        Json::Object(table) if path.is_empty() || !table.contains_key("kind") => {
            for (key, value) in table {
                let path = match path {
                    "" => key.clone(),
                    _ => format!("{path}.{key}"),
                };
                list(&path, value, out);
            }
        }
        _ => out.push((path.to_owned(), value.clone())),
    }
}

/// Value of a design for a key of another family.
fn value_for(key: &str, written: &[Entry]) -> Option<Json> {
    let wish = |key: &str| WISHES.contains(&key.split('.').next().unwrap_or_default());
    let plain = written.iter().filter(|(_, value)| !value.is_object());
    let same = plain.clone().find(|(old, _)| old == key);
    let alike = || {
        if wish(key) {
            return None;
        }
        let mut others = plain.clone().filter(|(old, _)| !wish(old));
        let end = others.clone().find(|(old, _)| same_end(old, key));
        end.or_else(|| others.find(|(old, _)| ALIKE.contains(&last(key)) && last(old) == last(key)))
    };
    if let Some((_, value)) = same.or_else(alike) {
        return Some(value.clone());
    }
    // Keys within a table with a kind.
    let kinds = written.iter().filter_map(|(_, value)| value.as_object());
    let name = last(key);
    let inside = kinds.filter(|_| ALIKE.contains(&name) && !wish(key));
    inside.filter_map(|table| table.get(name)).next().cloned()
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// Whether one path is the end of the other, and has several names or is a number that means the same everywhere.
fn same_end(one: &str, other: &str) -> bool {
    let ends = |long: &str, short: &str| {
        long.strip_suffix(short)
            .is_some_and(|rest| rest.ends_with('.'))
    };
    ends(one, other) || ends(other, one)
}

/// Design with those entries with which it is a mechanism, and the entries that do not fit.
fn with_as_many(start: DocumentMut, required: &[Entry]) -> (DocumentMut, Vec<Entry>) {
    if required.is_empty() {
        return (start, Vec::new());
    }
    let sound = |made: &DocumentMut| mechanism(&made.to_string()).is_ok();
    let mut made = start.clone();
    let all = required
        .iter()
        .all(|(key, value)| put(&mut made, key, value).is_some());
    if all && sound(&made) {
        return (made, Vec::new());
    }
    if let [(key, value)] = required {
        // The size of a curve may be given elsewhere.
        let sized = ["tooth_count", "module", "diametral_pitch"];
        for left in 1..=sized.len() {
            let mut table = value.as_object().cloned().unwrap_or_default();
            let before = table.len();
            table.retain(|name, _| !sized[..left].contains(&name.as_str()));
            let mut made = start.clone();
            if table.len() < before
                && put(&mut made, key, &Json::Object(table)).is_some()
                && sound(&made)
            {
                return (made, Vec::new());
            }
        }
        return (start, required.to_vec());
    }
    let (first, second) = required.split_at(required.len() / 2);
    let (made, mut lost) = with_as_many(start, first);
    let (made, more) = with_as_many(made, second);
    lost.extend(more);
    (made, lost)
}

/// Sets a key; a table replaces the whole content of the old one.
fn put(document: &mut DocumentMut, key: &str, value: &Json) -> Option<()> {
    let mut steps: Vec<Step> = key.split('.').map(Step::named).collect();
    let Json::Object(new) = value else {
        let last = steps.pop()?;
        let parent = container(document.as_item_mut(), &steps, false)?;
        return set(parent, &last, written(value)?);
    };
    let table = container(document.as_item_mut(), &steps, false)?.as_table_like_mut()?;
    let old: Map<String, Json> = table
        .iter()
        .map(|(key, _)| (key.to_owned(), Json::Null))
        .collect();
    for key in old.keys().filter(|key| !new.contains_key(*key)) {
        table.remove(key);
    }
    for (key, value) in new {
        let value = fresh(value)?;
        match table.get_mut(key).and_then(Item::as_value_mut) {
            Some(there) => super::edit::replace(there, value),
            None => drop(table.insert(key, Item::Value(value))),
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::super::edit::{Edit, edited};
    use super::super::kind::tests::designs;
    use super::*;

    fn value(text: &str, key: &str) -> Option<toml::Value> {
        let mut here = toml::Value::Table(text.parse().expect("TOML"));
        for name in key.split('.') {
            here = here.get(name)?.clone();
        }
        Some(here)
    }

    #[test]
    fn every_design_becomes_a_mechanism_of_every_other_family() {
        let mut ways = 0;
        std::thread::scope(|scope| {
            let all = designs().into_iter().map(|(name, text)| {
                scope.spawn(move || {
                    let own = value(&text, "family").expect("written");
                    let others = FAMILIES.words().into_iter();
                    let others = others.filter(|word| own.as_str() != Some(word));
                    let made = others.map(|word| {
                        let made = edited(&text, &[Edit::word("family", word)]).expect("edited");
                        let error = mechanism(&made).err();
                        assert!(error.is_none(), "{name} as {word}: {error:?} in {made}");
                        assert_eq!(value(&made, "family"), Some(word.into()), "{name}");
                        for key in ["name", "title"] {
                            let old = value(&text, key);
                            assert!(
                                old.is_none() || value(&made, key) == old,
                                "{name} as {word}: {key}"
                            );
                        }
                    });
                    made.count()
                })
            });
            let all: Vec<_> = all.collect();
            ways = all
                .into_iter()
                .map(|one| one.join().expect("no panic"))
                .sum();
        });
        assert!(ways > 24 * 5, "{ways}");
    }

    #[test]
    fn what_the_new_family_knows_is_kept() {
        let template = |word: &str| FAMILIES.template(word).expect("a template");
        let turned =
            |text: &str, word: &str| edited(text, &[Edit::word("family", word)]).expect("edited");
        let pair = template("gear-pair").replace("module = 2.25", "module = 3");
        let pair = pair
            .replace("first-angle", "third-angle")
            .replace("backlash = 0.05", "backlash = 0.07");
        let feeder = turned(&pair, "feeder");
        assert_eq!(value(&feeder, "gears.module"), Some(3.into()), "{feeder}");
        assert_eq!(
            value(&feeder, "gears.backlash"),
            Some(0.07.into()),
            "{feeder}"
        );
        assert_eq!(
            value(&feeder, "drawing.projection"),
            Some("third-angle".into()),
            "{feeder}"
        );
        let arms = turned(&pair, "three-arm");
        let kind = value(&arms, "pitch.kind");
        assert_eq!(kind, Some("ellipse".into()), "{arms}");
        let shaft = template("spiral-shaft").replace("lead = 20 ", "lead = 22 ");
        let shaft = shaft
            .replace("depth = 4", "depth = 3.5")
            .replace("speed_rpm = 200", "speed_rpm = 150");
        let moved = turned(&shaft, "moving-box");
        assert_eq!(value(&moved, "shaft.lead"), Some(22.into()), "{moved}");
        assert_eq!(
            value(&moved, "shaft.groove.depth"),
            Some(3.5.into()),
            "{moved}"
        );
        assert_eq!(
            value(&moved, "shaft.load.speed_rpm"),
            Some(150.into()),
            "{moved}"
        );
        let machine = turned(&shaft, "machine");
        assert_eq!(
            value(&machine, "input.speed_rpm"),
            Some(150.into()),
            "{machine}"
        );
        let again = turned(&moved, "spiral-shaft");
        for key in ["lead", "groove.depth", "load.speed_rpm", "name", "title"] {
            assert_eq!(value(&again, key), value(&shaft, key), "{key}");
        }
    }

    #[test]
    fn the_family_as_it_is_changes_nothing() {
        let text = FAMILIES.template("feeder").expect("a template");
        let same = edited(text, &[Edit::word("family", "feeder")]).expect("edited");
        assert_eq!(same, text);
        let unknown = edited(text, &[Edit::word("family", "clock")]).expect("edited");
        assert_eq!(value(&unknown, "family"), Some("clock".into()));
    }
}
