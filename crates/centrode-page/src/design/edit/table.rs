//! Tables that are added to a design with the values of a template.

use std::sync::OnceLock;

use centrode_families::FAMILIES;
use serde_json::{Map, Value as Json};
use toml_edit::{DocumentMut, Item, Table};

use super::super::field::{Table as Fields, tables};
use super::super::kind::{fresh, mechanism};
use super::{Step, complete, container, steps};

/// Maximum number of keys that give way to the new table because they exclude it.
const MOST: usize = 3;

/// Text with a table that was not in it: with the values of a template, with its required keys alone, or empty, whichever first
/// gives a mechanism. Keys next to it that exclude it are removed.
///
/// # Errors
/// The reason in words if there is no such mechanism.
pub fn with_table(text: &str, key: &str) -> Result<String, String> {
    let parsed = text.parse::<DocumentMut>();
    let document = parsed.map_err(|error| format!("the text is not TOML: {error}"))?;
    let path = steps(key).ok_or_else(|| format!("{key} cannot be added"))?;
    let all = tables(text);
    let Some(own) = all.iter().find(|table| table.key == key && table.absent) else {
        return Err(format!("{key} cannot be added"));
    };
    let needed = named(own).filter(|(_, value, needed)| *needed && !value.is_null());
    let needed: Map<String, Json> = needed.map(|(name, value, _)| (name, value)).collect();
    let mut of_template = needed.clone();
    of_template.extend(sample(text, own));
    let mut reason = None;
    for values in [of_template, needed, Map::new()] {
        let Some(made) = added(&document, &path, &values) else {
            continue;
        };
        match settled(made, &path) {
            Ok(text) => return Ok(text),
            Err(error) => reason = reason.or(Some(error)),
        }
    }
    Err(reason.unwrap_or_else(|| format!("{key} cannot be added")))
}

/// Names of the keys of a table, with their defaults, and whether they are required.
fn named(table: &Fields) -> impl Iterator<Item = (String, Json, bool)> + '_ {
    let fields = table.fields.iter();
    fields.filter_map(|field| {
        let name = field.key.rsplit('.').next()?.to_owned();
        Some((name, field.value.clone(), !field.is_optional()))
    })
}

/// Whether every required key of a table has a default, or a value in a template.
pub(in crate::design) fn can_be_added(text: &str, table: &Fields) -> bool {
    let values = sample(text, table);
    named(table)
        .all(|(name, value, needed)| !needed || !value.is_null() || values.contains_key(&name))
}

/// The document with the table; `None` if there is no place for it.
fn added(document: &DocumentMut, path: &[Step], values: &Map<String, Json>) -> Option<DocumentMut> {
    let mut made = document.clone();
    let (last, around) = path.split_last()?;
    complete(&mut made, around);
    let parent = container(made.as_item_mut(), around, false)?;
    // A short table within the table of a part is written in one line.
    let new = if parent.is_inline_table() || !around.is_empty() {
        Item::Value(fresh(&values.clone().into())?)
    } else {
        let mut table = Table::new();
        for (name, value) in values {
            table.insert(name, Item::Value(fresh(value)?));
        }
        Item::Table(table)
    };
    parent.as_table_like_mut()?.insert(last.name()?, new);
    Some(made)
}

/// The text if it is a mechanism, without the keys next to the table that exclude it.
fn settled(mut document: DocumentMut, path: &[Step]) -> Result<String, String> {
    let (own, around) = path.split_last().ok_or_else(String::new)?;
    for _ in 0..=MOST {
        let text = document.to_string();
        let reason = match mechanism(&text) {
            Ok(()) => return Ok(text),
            Err(error) => error.message(),
        };
        let other = excluded(&reason, own);
        let parent = container(document.as_item_mut(), around, true);
        let gone = other.and_then(|name| parent?.as_table_like_mut()?.remove(name));
        if gone.is_none() {
            return Err(reason);
        }
    }
    Err(format!("more than {MOST} keys exclude this table"))
}

/// The key that a reason names as excluding the new one.
fn excluded<'a>(reason: &'a str, own: &Step) -> Option<&'a str> {
    let (before, other) = reason.rsplit_once(" cannot be given together with ")?;
    let named = before
        .rsplit(['.', ' ', ':'])
        .find(|word| !word.is_empty())?;
    [other, named]
        .into_iter()
        .find(|name| Some(*name) != own.name())
}

/// Values of the first template with a table of this name, that of the design's own family before the others: those of the keys
/// that the table has.
fn sample(text: &str, table: &Fields) -> Map<String, Json> {
    static TEMPLATES: OnceLock<Vec<(String, Json)>> = OnceLock::new();
    let all = TEMPLATES.get_or_init(|| {
        let words = FAMILIES.words().into_iter();
        let texts = words.filter_map(|word| Some((word.to_owned(), FAMILIES.template(word)?)));
        let read = texts.filter_map(|(word, text)| {
            let table = text.parse::<toml::Table>().ok()?;
            Some((word, serde_json::to_value(table).ok()?))
        });
        read.collect()
    });
    let name = table.key.rsplit('.').next().unwrap_or_default();
    let is_own = |word: &str| text.contains(&format!("family = \"{word}\""));
    let own = all.iter().filter(|(word, _)| is_own(word));
    let others = all.iter().filter(|(word, _)| !is_own(word));
    let mut found = own
        .chain(others)
        .filter_map(|(_, template)| table_named(template, name));
    let mut values = found.next().unwrap_or_default();
    let has = |key: &String| named(table).any(|(name, ..)| name == *key);
    values.retain(|key, value| has(key) && !value.is_object());
    values
}

/// The first table of a name in a value.
fn table_named(value: &Json, name: &str) -> Option<Map<String, Json>> {
    let own = value.as_object()?;
    match own.get(name).and_then(Json::as_object) {
        Some(found) if !found.is_empty() => Some(found.clone()),
        _ => own.values().find_map(|inner| table_named(inner, name)),
    }
}
