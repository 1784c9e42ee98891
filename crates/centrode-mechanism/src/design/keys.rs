use std::ops::Range;

use toml::de::{DeTable, DeValue};

/// Places of all keys of a file.
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

impl Keys {
    pub(super) fn new(root: &DeTable<'_>) -> Self {
        let mut keys = Self::default();
        keys.add(root, "");
        keys
    }

    fn add(&mut self, table: &DeTable<'_>, prefix: &str) {
        for (key, value) in table {
            let path = format!("{prefix}{}", key.get_ref());
            let list = value.get_ref().as_array();
            let length = |one: &DeValue<'_>| one.as_array().map(|list| list.len());
            self.0.push(Entry {
                path: path.clone(),
                key: key.span(),
                value: value.span(),
                length: length(value.get_ref()),
                inner: list.map_or_else(Vec::new, |list| {
                    list.iter().map(|one| length(one.get_ref())).collect()
                }),
            });
            // The parser refuses deep nesting, so this recursion is shallow.
            if let DeValue::Table(inner) = value.get_ref() {
                self.add(inner, &format!("{path}."));
            }
        }
    }

    /// Byte offset of a key, or of the nearest list or table around it that is there.
    pub(super) fn offset(&self, path: &str) -> Option<usize> {
        let mut path = path;
        loop {
            if let Some(entry) = self.0.iter().find(|e| e.path == path) {
                return Some(entry.key.start);
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }

    /// The first list that is longer than what was read of it: its key, its length, and how much was read.
    ///
    /// Serde reads a list of fixed length and leaves the rest.
    pub(super) fn cut(&self, read: &toml::Table) -> Option<(String, usize, usize)> {
        self.0.iter().find_map(|entry| {
            let (way, last) = entry.path.rsplit_once('.').unwrap_or(("", &entry.path));
            let steps = way.split('.').filter(|step| !step.is_empty());
            let table = steps
                .into_iter()
                .try_fold(read, |table, step| table.get(step)?.as_table())?;
            let kept = table.get(last)?.as_array()?;
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

    /// The innermost key whose name or value holds the byte `offset`.
    pub(super) fn around(&self, offset: usize) -> Option<&str> {
        let holds = |e: &&Entry| e.key.contains(&offset) || e.value.contains(&offset);
        let innermost = self.0.iter().filter(holds).max_by_key(|e| e.path.len());
        innermost.map(|e| e.path.as_str())
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
