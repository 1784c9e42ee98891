use std::ops::Range;

use serde::de::Unexpected;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::path::{Path, at};

/// Positions of all keys of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Keys(Vec<Entry>);

#[derive(Clone, Debug)]
struct Entry {
    path: String,
    key: Range<usize>,
    value: Range<usize>,
    /// Length of a list.
    length: Option<usize>,
    /// Lengths of the lists in it.
    inner: Vec<Option<usize>>,
}

/// Visits every value of a table by its key, with the position of its key, entries of lists by their number.
///
/// The parser refuses deep nesting, so this recursion is shallow.
fn visit<'t>(
    table: &'t DeTable<'t>,
    path: &mut Path,
    found: &mut impl FnMut(&str, Range<usize>, &'t Spanned<DeValue<'t>>),
) {
    for (key, value) in table {
        path.name(key.get_ref(), |path| {
            visit_value(value, path, key.span(), found);
        });
    }
}

/// Visits a value and everything in it.
fn visit_value<'t>(
    value: &'t Spanned<DeValue<'t>>,
    path: &mut Path,
    key: Range<usize>,
    found: &mut impl FnMut(&str, Range<usize>, &'t Spanned<DeValue<'t>>),
) {
    found(path.written(), key, value);
    match value.get_ref() {
        DeValue::Table(table) => visit(table, path, found),
        DeValue::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                path.index(i, |path| visit_value(value, path, value.span(), found));
            }
        }
        _ => {}
    }
}

/// Description of an unexpected value, as in the messages of serde.
fn unexpected(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(word) => format!("string {word:?}"),
        DeValue::Integer(whole) => format!("integer `{whole}`"),
        DeValue::Float(number) => match number.as_str().parse() {
            Ok(number) => Unexpected::Float(number).to_string(),
            Err(_) => String::new(),
        },
        DeValue::Boolean(truth) => format!("boolean `{truth}`"),
        DeValue::Datetime(_) | DeValue::Table(_) => "map".into(),
        DeValue::Array(_) => "sequence".into(),
    }
}

/// Whether serde's message about a value may refer to this one.
fn is_on(message: &str, value: &DeValue<'_>) -> bool {
    if let Some(length) = message.strip_prefix("invalid length ") {
        let length = length.split(',').next().and_then(|n| n.parse().ok());
        return value.as_array().map(|list| list.len()) == length;
    }
    let given = ["invalid type: ", "invalid value: "];
    let given = given.iter().find_map(|start| message.strip_prefix(start));
    let given = given.and_then(|rest| rest.split_once(", expected "));
    given.is_some_and(|(given, _)| given == unexpected(value))
}

/// Key and position of the value that a message of serde refers to, if serde names only the table or list around it.
///
/// Serde reads a table whose `kind` decides its other keys into a buffer first, and loses the positions of these keys.
pub(super) fn inside(
    text: &str,
    around: &str,
    offset: usize,
    message: &str,
) -> Option<(String, usize)> {
    let root = DeTable::parse(text).ok()?;
    let name = message.strip_prefix("unknown field `");
    let name = name.and_then(|rest| rest.split('`').next());
    let mut found: Vec<(String, usize)> = Vec::new();
    let mut is_known = false;
    visit(
        root.get_ref(),
        &mut Path::default(),
        &mut |path, key, value| {
            let below = path.strip_prefix(around);
            let last = path.rsplit('.').next();
            let is_here = name.map_or_else(
                || is_on(message, value.get_ref()),
                |name| last == Some(name),
            );
            match below {
                Some("") => is_known |= is_here,
                Some(rest) if is_here && rest.starts_with(['.', '[']) => {
                    let start = if name.is_some() {
                        key.start
                    } else {
                        value.span().start
                    };
                    found.push((path.to_owned(), start));
                }
                _ => {}
            }
        },
    );
    if is_known {
        return None;
    }
    let Some(name) = name else {
        // One of several equal values may be correct: only if all are entries of one list, the first is reported.
        let list = |path: &str| path[..path.rfind('[').unwrap_or(path.len())].to_owned();
        let first = list(&found.first()?.0);
        let is_one = found.iter().all(|(path, _)| list(path) == first);
        return is_one.then(|| found.remove(0));
    };
    let depth = |path: &str| path.matches('.').count();
    let nearest = found.iter().map(|(path, _)| depth(path)).min()?;
    found.retain(|(path, _)| depth(path) == nearest);
    // A key may be known in one table of a list and unknown in another.
    match found.len() {
        1 => found.pop(),
        _ => Some((format!("{around}.{name}"), offset)),
    }
}

impl Keys {
    pub(super) fn new(root: &DeTable<'_>) -> Self {
        let mut keys = Self::default();
        let length = |one: &DeValue<'_>| one.as_array().map(|list| list.len());
        visit(root, &mut Path::default(), &mut |path, key, value| {
            let is_entry = path.ends_with(']');
            // Only those entries of lists that are tables have keys of their own.
            if is_entry && !value.get_ref().is_table() {
                return;
            }
            let list = value.get_ref().as_array();
            keys.0.push(Entry {
                path: path.to_owned(),
                key,
                value: value.span(),
                length: length(value.get_ref()),
                inner: list.map_or_else(Vec::new, |list| {
                    list.iter().map(|one| length(one.get_ref())).collect()
                }),
            });
        });
        keys
    }

    /// Byte offset of a key, or of the nearest list or table around it that is in the file.
    pub(super) fn offset(&self, path: &str) -> Option<usize> {
        let mut path = path;
        loop {
            if let Some(entry) = self.0.iter().find(|e| e.path == path) {
                return Some(entry.key.start);
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }

    /// Byte ranges of the name and the value of a key that is written as `name = value`.
    pub(super) fn line(&self, path: &str, text: &str) -> Option<[Range<usize>; 2]> {
        let entry = self.0.iter().find(|e| e.path == path)?;
        let between = text.get(entry.key.end..entry.value.start)?;
        (between.trim() == "=").then(|| [entry.key.clone(), entry.value.clone()])
    }

    /// The first list of which only a part was read: its key, its length, and the number of entries read.
    ///
    /// Serde reads a list of fixed length and leaves the rest.
    pub(super) fn cut(&self, read: &toml::Value) -> Option<(String, usize, usize)> {
        self.0.iter().find_map(|entry| {
            let kept = at(read, &entry.path)?.as_array()?;
            if let Some(length) = entry.length.filter(|length| *length > kept.len()) {
                return Some((entry.path.clone(), length, kept.len()));
            }
            let mut pairs = entry.inner.iter().zip(kept).enumerate();
            pairs.find_map(|(i, (length, kept))| {
                let kept = kept.as_array()?.len();
                let length = length.filter(|length| *length > kept)?;
                Some((format!("{}[{i}]", entry.path), length, kept))
            })
        })
    }

    /// The innermost key whose name or value contains the byte `offset`.
    pub(super) fn around(&self, offset: usize) -> Option<&str> {
        let holds = |e: &&Entry| e.key.contains(&offset) || e.value.contains(&offset);
        let innermost = self.0.iter().filter(holds).max_by_key(|e| e.path.len())?;
        // If a list and its first entry begin at the same byte, the error may be in any entry.
        let list = innermost.path.strip_suffix(']');
        let list = list.and_then(|path| path.rsplit_once('['));
        let list = list.and_then(|(list, _)| self.0.iter().find(|e| e.path == list));
        let list = list.filter(|list| list.value.start == offset);
        Some(&list.unwrap_or(innermost).path)
    }
}

/// Line and column of a byte offset, both from one; the column counts characters.
pub(super) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let before = &text[..offset];
    let start = before.rfind('\n').map_or(0, |i| i + 1);
    let line = before.matches('\n').count() + 1;
    (line, before[start..].chars().count() + 1)
}
