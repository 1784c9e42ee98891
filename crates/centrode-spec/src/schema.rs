use std::cmp::Reverse;
use std::collections::BTreeSet;

use schemars::Schema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::DesignFamily;

/// The JSON schema of the design files of some families.
#[must_use]
pub fn json_schema<F: AsRef<DesignFamily>>(families: &[F]) -> Value {
    let mut generator = SchemaSettings::default().into_generator();
    let alternatives: Vec<Value> = families
        .iter()
        .map(|family| {
            let family: &DesignFamily = family.as_ref();
            let mut schema = (family.schema)(&mut generator);
            family.tag(&mut schema);
            schema.insert("description".into(), json!(family.about));
            schema.to_value()
        })
        .collect();
    without_nulls(json!({
        "oneOf": alternatives,
        "description": "Design of a mechanism; the key `family` selects its family.",
        "title": "Design",
        "$schema": generator.settings().meta_schema,
        "$defs": generator.take_definitions(true),
    }))
}

/// Drops the null defaults of optional keys: TOML has no null.
fn without_nulls(mut schema: Value) -> Value {
    match &mut schema {
        Value::Object(keys) => {
            keys.retain(|_, value| !value.is_null());
            keys.values_mut()
                .for_each(|value| *value = without_nulls(value.take()));
        }
        Value::Array(list) => {
            list.iter_mut()
                .for_each(|value| *value = without_nulls(value.take()));
        }
        _ => {}
    }
    schema
}

impl DesignFamily {
    /// The JSON schema of the family's design files.
    #[must_use]
    pub fn json_schema(&self) -> Value {
        let mut generator = SchemaSettings::default().into_generator();
        let mut schema = (self.schema)(&mut generator);
        schema.insert("title".into(), json!((self.title)()));
        schema.insert("$schema".into(), json!(generator.settings().meta_schema));
        let definitions = generator.take_definitions(true);
        if !definitions.is_empty() {
            schema.insert("$defs".into(), Value::Object(definitions));
        }
        self.tag(&mut schema);
        without_nulls(schema.to_value())
    }

    /// Keys of a name in the family's design files, the four nearest to the position `key` in a file: `teeth.backlash`,
    /// `cams.NAME.motion`.
    ///
    /// Keys at the position of `key` itself, which other kinds of its table may have, are omitted.
    pub(super) fn keys_named(&self, name: &str, key: &str) -> Vec<String> {
        let mut found = self.keys(&|found| found == name);
        found.retain(|path| !is_at(path, key));
        found.sort_by_cached_key(|path| {
            let shared = common(path, key);
            (Reverse(shared), path.matches(['.', '[']).count())
        });
        let mut seen = Vec::new();
        found.retain(|path| {
            let is_new = !seen.contains(path);
            seen.push(path.clone());
            is_new
        });
        found.truncate(4);
        found
    }

    /// Names of the keys that the table of a key may have.
    pub(super) fn keys_next_to(&self, key: &str) -> Vec<String> {
        let table = |path: &str| {
            path.rsplit_once('.')
                .map_or(String::new(), |(table, _)| table.into())
        };
        let mut found = self.keys(&|_| true);
        found.retain(|path| is_at(&table(path), &table(key)));
        let name = |path: &String| path[path.rfind('.').map_or(0, |dot| dot + 1)..].to_owned();
        found.iter().map(name).collect()
    }

    /// Names of all keys of the family's design files, without their tables.
    pub(super) fn key_names(&self) -> BTreeSet<String> {
        let keys = self.keys(&|_| true).into_iter();
        keys.map(|key| key[key.rfind('.').map_or(0, |dot| dot + 1)..].to_owned())
            .collect()
    }

    /// All keys of the family's design files whose name passes `is_required`.
    fn keys(&self, is_required: &dyn Fn(&str) -> bool) -> Vec<String> {
        let schema = self.json_schema();
        let mut found = Vec::new();
        named_in(
            &schema,
            &schema,
            is_required,
            &mut Vec::new(),
            "",
            &mut found,
        );
        found
    }

    /// Adds the key that names the family.
    fn tag(&self, schema: &mut Schema) {
        let word = json!({ "type": "string", "const": self.word });
        if let Some(properties) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) {
            properties.insert("family".into(), word);
        }
        match schema.get_mut("required").and_then(|r| r.as_array_mut()) {
            Some(required) => required.push("family".into()),
            None => {
                schema.insert("required".into(), json!(["family"]));
            }
        }
    }
}

/// The names of the tables and the key that make up a path, without the numbers of entries.
fn parts(key: &str) -> Vec<&str> {
    let parts = key.split('.').map(|part| part.split('[').next());
    parts.map(Option::unwrap_or_default).collect()
}

/// Number of leading parts that a key of the schema, with `NAME` and `[]` in it, and a written key have in common.
fn common(path: &str, key: &str) -> usize {
    let (path, key) = (parts(path), parts(key));
    let pairs = path.iter().zip(&key);
    pairs.take_while(|(p, k)| **p == "NAME" || p == k).count()
}

/// Whether a key of the schema, with `NAME` and `[]` in it, matches the written key.
fn is_at(path: &str, key: &str) -> bool {
    let depth = parts(path).len();
    depth == parts(key).len() && common(path, key) == depth
}

/// Collects the keys whose name passes `is_required` at and below a schema; a schema inside itself is not entered again.
fn named_in<'s>(
    root: &'s Value,
    here: &'s Value,
    is_required: &dyn Fn(&str) -> bool,
    around: &mut Vec<&'s str>,
    path: &str,
    found: &mut Vec<String>,
) {
    let reference = here.get("$ref").and_then(Value::as_str);
    let reference = reference.and_then(|r| r.strip_prefix('#'));
    if let Some(place) = reference.filter(|place| !around.contains(place)) {
        around.push(place);
        if let Some(there) = root.pointer(place) {
            named_in(root, there, is_required, around, path, found);
        }
        around.pop();
    }
    for (key, there) in here
        .get("properties")
        .and_then(Value::as_object)
        .into_iter()
        .flatten()
    {
        let dot = if path.is_empty() { "" } else { "." };
        let path = format!("{path}{dot}{key}");
        if is_required(key) {
            found.push(path.clone());
        }
        named_in(root, there, is_required, around, &path, found);
    }
    if let Some(there) = here.get("additionalProperties") {
        named_in(
            root,
            there,
            is_required,
            around,
            &format!("{path}.NAME"),
            found,
        );
    }
    if let Some(there) = here.get("items") {
        named_in(
            root,
            there,
            is_required,
            around,
            &format!("{path}[]"),
            found,
        );
    }
    for words in ["oneOf", "anyOf", "allOf", "prefixItems"] {
        let list = here.get(words).and_then(Value::as_array);
        for there in list.into_iter().flatten() {
            named_in(root, there, is_required, around, path, found);
        }
    }
}
