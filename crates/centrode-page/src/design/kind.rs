use super::edit::{Step, container, written};
use super::field::{Field, keys_next_to, tables};
use super::start::{Measures, starts};
use centrode_families::FAMILIES;
use centrode_spec::DesignError;
use serde_json::{Map, Value as Json};
use toml_edit::{DocumentMut, InlineTable, Item, Value};

/// Maximum number of keys of other tables that are removed for a new kind.
pub(super) const MOST: usize = 3;

/// Changes the kind of the table at a path; `None` if the table has no kinds, or does not have this kind.
///
/// Keys that the new kind also has stay, the others are removed, and its required keys get a value. If the design is then no
/// mechanism, copied keys are dropped, and after them optional keys outside the table.
pub(super) fn switched(document: &DocumentMut, steps: &[Step], kind: &str) -> Option<DocumentMut> {
    let text = document.to_string();
    let names: Vec<&str> = steps.iter().filter_map(Step::name).collect();
    let keys = keys_next_to(&text, &names.join("."), kind)?;
    let design = serde_json::to_value(text.parse::<toml::Table>().ok()?).ok()?;
    let mut old = &design;
    for name in &names {
        old = old.get(name)?;
    }
    if steps.len() != names.len() || old.get("kind").is_some_and(|now| now == kind) {
        return None;
    }
    let shared = old.as_object()?.keys().map(String::as_str);
    let shared: Vec<&str> = shared
        .filter(|key| *key != "kind" && keys.contains_key(*key))
        .collect();
    let switch = Switch {
        document,
        steps,
        kind,
    };
    let mut starts = starts(kind, &Measures::new(&design, &names, old));
    for start in &mut starts {
        start.retain(|key, value| key != "kind" && keys.get(key) != Some(value));
    }
    let first = switch.with(&shared, starts.first().unwrap_or(&Map::new()))?;
    for sacrifice in [0, MOST] {
        for start in &starts {
            if let Some(found) = switch.search(&shared, start, sacrifice) {
                return Some(found);
            }
        }
    }
    // No start gives a mechanism: the fault is elsewhere.
    Some(first)
}

/// Change of a table to another kind.
struct Switch<'a> {
    document: &'a DocumentMut,
    steps: &'a [Step],
    kind: &'a str,
}

impl Switch<'_> {
    /// Finds a design that is a mechanism with as many of the shared keys as possible.
    fn search(
        &self,
        shared: &[&str],
        start: &Map<String, Json>,
        sacrifice: usize,
    ) -> Option<DocumentMut> {
        let tried = |kept: &[&str], start: &Map<String, Json>| {
            let table = self.steps.iter().filter_map(Step::name);
            let table: Vec<&str> = table.collect();
            sound(self.with(kept, start)?, &table.join("."), sacrifice)
        };
        // The shared keys may be enough, for example points instead of a formula: then no start is needed.
        let whole = tried(shared, start).or_else(|| tried(shared, &Map::new()));
        if whole.is_some() {
            return whole;
        }
        let size = ["module", "diametral_pitch", "tooth_count"];
        let mut kept: Vec<&str> = shared
            .iter()
            .copied()
            .filter(|k| size.contains(k))
            .collect();
        let mut found = tried(&kept, start)?;
        for key in shared.iter().filter(|key| !size.contains(key)) {
            kept.push(key);
            match tried(&kept, start) {
                Some(better) => found = better,
                None => drop(kept.pop()),
            }
        }
        Some(found)
    }

    /// Design with these keys of the old table, and all others of the start.
    fn with(&self, kept: &[&str], start: &Map<String, Json>) -> Option<DocumentMut> {
        let mut made = self.document.clone();
        let table = container(made.as_item_mut(), self.steps, true)?.as_table_like_mut()?;
        let strange: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
        for key in strange
            .iter()
            .filter(|key| *key != "kind" && !kept.contains(&key.as_str()))
        {
            table.remove(key);
        }
        match table.get_mut("kind").and_then(Item::as_value_mut) {
            Some(kind) => super::edit::replace(kind, self.kind.into()),
            None => drop(table.insert("kind", Item::Value(self.kind.into()))),
        }
        for (key, value) in start
            .iter()
            .filter(|(key, _)| !kept.contains(&key.as_str()))
        {
            table.insert(key, Item::Value(fresh(value)?));
        }
        Some(made)
    }
}

/// A value of a new key, tables among them.
pub(super) fn fresh(value: &Json) -> Option<Value> {
    let Json::Object(table) = value else {
        return written(value);
    };
    let pairs = table.iter().map(|(key, value)| Some((key, fresh(value)?)));
    Some(Value::InlineTable(pairs.collect::<Option<InlineTable>>()?))
}

/// Returns the design if it is a mechanism after at most `sacrifice` optional keys at fault outside a table are removed.
pub(super) fn sound(
    mut document: DocumentMut,
    table: &str,
    sacrifice: usize,
) -> Option<DocumentMut> {
    for left in (0..=sacrifice).rev() {
        let text = document.to_string();
        let error = match mechanism(&text) {
            Ok(()) => return Some(document),
            Err(error) => error,
        };
        if left == 0 {
            break;
        }
        let fields = tables(&text).into_iter().flat_map(|table| table.fields);
        let blamed = fields
            .filter(Field::may_go)
            .find(|field| field.key == error.key)?;
        if blamed.key.starts_with(&format!("{table}.")) {
            return None;
        }
        let (around, name) = blamed.key.rsplit_once('.').unwrap_or(("", &blamed.key));
        let steps: Vec<Step> = around
            .split('.')
            .filter(|s| !s.is_empty())
            .map(Step::named)
            .collect();
        let table = container(document.as_item_mut(), &steps, true)?;
        table.as_table_like_mut()?.remove(name);
    }
    None
}

/// Error of a design that is no mechanism.
pub(super) fn mechanism(text: &str) -> Result<(), DesignError> {
    FAMILIES
        .read(text.as_bytes())
        .and_then(|file| file.mechanism().map(drop))
}

#[cfg(test)]
pub(super) mod tests {
    use std::fs;
    use std::path::Path;

    use super::super::edit::{Edit, edited};
    use super::*;

    /// Every shipped design and template, by name.
    pub(in super::super) fn designs() -> Vec<(String, String)> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/designs");
        let files = fs::read_dir(folder).expect("there");
        let shipped = files.map(|file| {
            let path = file.expect("readable").path();
            let text = fs::read_to_string(&path).expect("readable");
            (path.display().to_string(), text)
        });
        let templates = FAMILIES.0.iter().map(|family| {
            let design = family.design;
            (design.word.to_owned(), design.template.to_owned())
        });
        shipped.chain(templates).collect()
    }

    fn kind_of(text: &str, key: &str) -> Option<Field> {
        let mut fields = tables(text).into_iter().flat_map(|table| table.fields);
        fields.find(|field| field.key == key)
    }

    fn changed(text: &str, key: &str, word: &str) -> String {
        let text = edited(text, &[Edit::word(key, word)]).expect("edited");
        let now = kind_of(&text, key).expect("the table is there still");
        assert_eq!(now.value, word, "{key} in {text}");
        text
    }

    fn value(text: &str, key: &str) -> Option<toml::Value> {
        let table: toml::Table = text.parse().expect("TOML");
        let mut here = toml::Value::Table(table);
        for name in key.split('.') {
            here = here.get(name)?.clone();
        }
        Some(here)
    }

    /// Changes one table of a design from kinds to others, one of `stride` pairs of them; returns the number of ways.
    fn every_way(name: &str, text: &str, key: &str, stride: usize) -> usize {
        let mut words = kind_of(text, key).expect("a kind").words();
        let table = key.trim_end_matches("kind");
        if key.starts_with("cams.") && key.ends_with(".follower.kind") {
            // A motion may be none of a flat face, and a body that slides carries no gear: that is reported at its position.
            let own = value(text, key).expect("written");
            let own = own.as_str().expect("a word");
            let swings = |word: &str| word.starts_with("swinging");
            let cam = key.trim_end_matches("follower.kind");
            words.retain(|word| *word != own);
            assert_eq!(words.len(), 3, "{name}");
            for to in &words {
                if let Err(error) = mechanism(&changed(text, key, to)) {
                    let stated = error.to_string();
                    let carries = swings(own) && !swings(to) && stated.contains("gear");
                    assert!(
                        carries || error.key.starts_with(cam),
                        "{name}: {to}: {stated}"
                    );
                }
            }
            words = vec![own.to_owned()];
        }
        let mut ways = 0;
        for (i, from) in words.iter().enumerate() {
            let first = changed(text, key, from);
            for to in words.iter().skip(i % stride).step_by(stride) {
                let second = changed(&first, key, to);
                let found = mechanism(&second);
                if key.ends_with("reversal.law.kind") && to == "constant-velocity" {
                    // A speed that jumps reverses no slider: there is no such mechanism.
                    assert!(found.is_err_and(|error| key.starts_with(&error.key)));
                    ways += 1;
                    continue;
                }
                assert!(
                    found.is_ok(),
                    "{name}: {key} from {from} to {to}: {found:?}\n{second}"
                );
                for size in ["module", "tooth_count"].map(|size| format!("{table}{size}")) {
                    let kept = kind_of(&second, &size).and(value(&first, &size));
                    let pair = ["module", "tooth_count"]
                        .map(|size| value(&first, &format!("{table}{size}")));
                    if pair.iter().all(Option::is_some) {
                        assert_eq!(
                            kept,
                            value(&second, &size),
                            "{name}: {size} from {from} to {to}"
                        );
                    }
                }
                ways += 1;
            }
        }
        ways
    }

    #[test]
    fn a_diametral_pitch_stays_with_a_new_kind() {
        let mut all = designs();
        all.sort();
        let mut all = all.into_iter().map(|(_, text)| text);
        let sized =
            all.find(|text| text.contains("\n[pitch]\nkind") && text.contains("\nmodule = "));
        let text = sized.expect("a pair with a module");
        let text = text.replacen("\nmodule = ", "\ndiametral_pitch = ", 1);
        for kind in ["circle", "lobed-ellipse", "polar", "ratio"] {
            let new = changed(&text, "pitch.kind", kind);
            for key in ["pitch.diametral_pitch", "pitch.tooth_count"] {
                assert_eq!(value(&new, key), value(&text, key), "{kind}: {new}");
            }
        }
    }

    #[test]
    fn kinds_of_every_table_become_others_and_stay_a_mechanism() {
        every_table(5);
    }

    #[test]
    #[ignore = "a campaign"]
    fn every_kind_of_every_table_becomes_every_other_and_stays_a_mechanism() {
        every_table(1);
    }

    fn every_table(stride: usize) {
        let mut ways = 0;
        std::thread::scope(|scope| {
            let all = designs().into_iter().map(|(name, text)| {
                scope.spawn(move || {
                    let fields = tables(&text).into_iter().flat_map(|table| table.fields);
                    let kinds = fields.filter(|field| field.key.ends_with("kind"));
                    // A body has one motion: the tables of the others are not there.
                    let kinds = kinds.filter(|field| {
                        let law = field.key.split_once(".law.");
                        law.and_then(|(body, rest)| Some((body, rest.split_once('.')?.0)))
                            .is_none_or(|(body, motion)| {
                                !body.starts_with("bodies.")
                                    || value(&text, &format!("{body}.law.{motion}")).is_some()
                            })
                    });
                    kinds
                        .map(|kind| every_way(&name, &text, &kind.key, stride))
                        .sum::<usize>()
                })
            });
            let all: Vec<_> = all.collect();
            ways = all
                .into_iter()
                .map(|one| one.join().expect("no panic"))
                .sum();
        });
        // Eleven pitch curves of eleven designs alone.
        assert!(ways > 11 * 11 * 11 / stride, "{ways}");
    }
}
