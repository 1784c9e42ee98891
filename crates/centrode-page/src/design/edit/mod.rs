mod table;

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, Value};

use super::family::turned;
use super::field::{list, required};
use super::follower::refollowed;
use super::kind::switched;
use super::machine::retyped;
use super::plane::moved;
pub(super) use table::can_be_added;
pub use table::with_table;

/// A new value for a key of the design file.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Edit {
    /// Path of the key, `teeth.backlash`, `pitch.radius[3]`.
    key: String,
    /// New value; null removes the key.
    value: Json,
}

impl Edit {
    /// A number for a key; whole numbers are written without a fraction.
    pub fn number(key: &str, value: f64, whole: bool) -> Self {
        Self {
            key: key.into(),
            value: if whole {
                (value as i64).into()
            } else {
                value.into()
            },
        }
    }

    /// Removes a key or a table.
    pub fn removal(key: &str) -> Self {
        Self {
            key: key.into(),
            value: Json::Null,
        }
    }

    /// A word for a key.
    pub(crate) fn word(key: &str, word: &str) -> Self {
        Self {
            key: key.into(),
            value: word.into(),
        }
    }

    /// A list of numbers for a key.
    pub fn list(key: &str, values: &[f64]) -> Self {
        Self {
            key: key.into(),
            value: values.into(),
        }
    }
}

/// Reason why an edit cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// The text is not TOML.
    #[error("the text is not TOML: {0}")]
    Syntax(#[from] toml_edit::TomlError),
    /// Nothing can be set at the key.
    #[error("{key} cannot be set")]
    Key {
        /// The key.
        key: String,
    },
    /// The value cannot be written in a design file.
    #[error("{key}: {value} cannot be written in a design file")]
    Value {
        /// The key.
        key: String,
        /// The value.
        value: Json,
    },
}

/// A step of a path: a key, or an index in a list.
#[derive(Clone, Debug, Eq, PartialEq)]
pub(super) enum Step {
    Name(String),
    Index(usize),
}

impl Step {
    /// The step into a table.
    pub(super) fn named(name: &str) -> Self {
        Self::Name(name.into())
    }

    /// Name of the key; `None` for the index in a list.
    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Name(name) => Some(name),
            Self::Index(_) => None,
        }
    }
}

/// Text with the edits made; comments, order and all other values stay as they are.
///
/// A new `kind` changes its table, a new `type` its dyad, and a new `family` the whole design, so that it stays a mechanism; a
/// new `plane` leaves points at their positions. A new table gets its required keys, with the values that apply if the table is
/// omitted.
///
/// # Errors
/// [`EditError`] if the text is not TOML, or a key or value cannot be written.
pub fn edited(text: &str, edits: &[Edit]) -> Result<String, EditError> {
    let mut document: DocumentMut = text.parse()?;
    for edit in edits {
        let unknown = || EditError::Key {
            key: edit.key.clone(),
        };
        let mut steps = steps(&edit.key).ok_or_else(unknown)?;
        let last = steps.pop().ok_or_else(unknown)?;
        if !edit.value.is_null() {
            complete(&mut document, &steps);
        }
        if let (Some(name), Json::String(word)) = (last.name(), &edit.value)
            && let Some(made) = match name {
                "kind" => refollowed(&document, &steps, word)
                    .or_else(|| switched(&document, &steps, word)),
                "type" => retyped(&document, &steps, word),
                "family" if steps.is_empty() => turned(&document, word),
                "plane" => moved(&document, &steps, word),
                _ => None,
            }
        {
            document = made;
            continue;
        }
        let parent = container(document.as_item_mut(), &steps, edit.value.is_null());
        let Some(parent) = parent else {
            if edit.value.is_null() {
                continue;
            }
            return Err(unknown());
        };
        if edit.value.is_null() {
            take_out(parent, &last).ok_or_else(unknown)?;
        } else {
            let value = written(&edit.value).ok_or_else(|| EditError::Value {
                key: edit.key.clone(),
                value: edit.value.clone(),
            })?;
            set(parent, &last, value).ok_or_else(unknown)?;
        }
    }
    Ok(document.to_string())
}

/// Steps of a path; `None` for a text that is not a path.
fn steps(path: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (name, rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            return None;
        }
        steps.push(Step::Name(name.into()));
        for index in rest.split_terminator(']') {
            steps.push(Step::Index(index.strip_prefix('[')?.parse().ok()?));
        }
    }
    Some(steps)
}

/// Adds the missing tables of a path, with their required keys.
fn complete(document: &mut DocumentMut, steps: &[Step]) {
    let mut path = String::new();
    for (depth, step) in (1..).zip(steps) {
        let Step::Name(name) = step else { return };
        if !path.is_empty() {
            path.push('.');
        }
        path.push_str(name);
        if container(document.as_item_mut(), &steps[..depth], true).is_some() {
            continue;
        }
        let text = document.to_string();
        if let Some(value) = list(&text, &path).and_then(|list| written(&list)) {
            // The path leads into a list whose default applies: the default is written first.
            if let Some(parent) = container(document.as_item_mut(), &steps[..depth - 1], true) {
                let _ = set(parent, step, value);
            }
            return;
        }
        let needed = required(&text, &path);
        let Some(table) = container(document.as_item_mut(), &steps[..depth], false) else {
            return;
        };
        for (name, value) in needed {
            if let Some(value) = written(&value) {
                // A path that leads nowhere is reported by the function that sets the value.
                let _ = set(table, &Step::Name(name), value);
            }
        }
    }
}

/// The table or list at the path; missing tables are added unless `only_there`.
pub(super) fn container<'a>(
    root: &'a mut Item,
    steps: &[Step],
    only_there: bool,
) -> Option<&'a mut Item> {
    let mut here = root;
    for step in steps {
        here = match step {
            Step::Index(index) => here.get_mut(*index)?,
            Step::Name(name) => {
                let inline = here.is_inline_table();
                let table = here.as_table_like_mut()?;
                if !table.contains_key(name) {
                    if only_there {
                        return None;
                    }
                    let new = if inline {
                        Item::Value(Value::InlineTable(InlineTable::new()))
                    } else {
                        Item::Table(Table::new())
                    };
                    table.insert(name, new);
                }
                table.get_mut(name)?
            }
        };
    }
    Some(here)
}

fn take_out(parent: &mut Item, last: &Step) -> Option<()> {
    match last {
        Step::Name(name) => {
            parent.as_table_like_mut()?.remove(name);
        }
        Step::Index(index) => {
            let list = parent.as_array_mut()?;
            if *index >= list.len() {
                return None;
            }
            list.remove(*index);
        }
    }
    Some(())
}

pub(super) fn set(parent: &mut Item, last: &Step, value: Value) -> Option<()> {
    let there = match last {
        Step::Index(index) => parent.get_mut(*index)?,
        Step::Name(name) => {
            let table = parent.as_table_like_mut()?;
            match table.get(name) {
                Some(item) if !item.is_none() => table.get_mut(name)?,
                _ => {
                    table.insert(name, Item::Value(value));
                    return Some(());
                }
            }
        }
    };
    replace(there.as_value_mut()?, value);
    Some(())
}

/// Replaces a value by another, and retains the blanks and comments around the old one.
pub(super) fn replace(old: &mut Value, mut new: Value) {
    if let (Value::Array(old), Value::Array(new)) = (&mut *old, &new) {
        while old.len() > new.len() {
            old.remove(old.len() - 1);
        }
        for (old, new) in old.iter_mut().zip(new) {
            replace(old, new.clone());
        }
        for new in new.iter().skip(old.len()) {
            append(old, new.clone());
        }
        return;
    }
    *new.decor_mut() = old.decor().clone();
    *old = new;
}

/// Adds a value to a list, on a line of its own if the last value has one.
fn append(list: &mut Array, mut value: Value) {
    let last = list.iter().last();
    let before = last.and_then(|last| last.decor().prefix()?.as_str());
    // A comment before the last value belongs to the value before that one.
    match before.and_then(|before| before.rsplit_once('\n')) {
        Some((_, blank)) => {
            *value.decor_mut() = toml_edit::Decor::new(format!("\n{blank}"), "");
            list.push_formatted(value);
        }
        None => list.push(value),
    }
}

/// Value as it is written in a design file; `None` for a table and for numbers that are not finite.
pub(super) fn written(value: &Json) -> Option<Value> {
    Some(match value {
        Json::Bool(b) => (*b).into(),
        Json::String(s) => s.as_str().into(),
        Json::Number(n) => match n.as_i64() {
            Some(whole) => whole.into(),
            None => n.as_f64().filter(|f| f.is_finite())?.into(),
        },
        Json::Array(list) => list.iter().map(written).collect::<Option<Array>>()?.into(),
        Json::Null | Json::Object(_) => return None,
    })
}

#[cfg(test)]
mod tests;
