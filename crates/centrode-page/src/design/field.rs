use std::sync::OnceLock;

use centrode_families::FAMILIES;
use serde::Serialize;
use serde_json::{Map, Value};

use super::edit::can_be_added;
use super::schema::{Requirements, described, marked, shape};

/// Mark of the schema for keys that change the shape of bodies, but not the motion.
const DETAIL: &str = "x-detail";
/// Mark of the schema with the symbol that a paper uses.
const SYMBOL: &str = "x-symbol";

/// Table of the design file as a form: one field per key.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Table {
    /// Path of the table, `driver.keyway`; empty for the keys before the first table.
    pub(crate) key: String,
    doc: String,
    /// Whether it is optional as a whole.
    optional: bool,
    /// Whether it is not in the file and has no effect without being there.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) absent: bool,
    /// Whether it can be added with the values of a template.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) addable: bool,
    /// Whether the table is in the file and may be removed from it.
    #[serde(skip)]
    pub(crate) may_go: bool,
    /// Whether the key changes only the shape of bodies, not the motion.
    #[serde(skip)]
    pub(crate) detail: bool,
    pub(crate) fields: Vec<Field>,
}

/// A key of the design file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Field {
    /// Path of the key, `teeth.backlash`.
    pub(crate) key: String,
    doc: String,
    /// Symbol of the paper, `gamma_0`.
    #[serde(skip_serializing_if = "Option::is_none")]
    symbol: Option<String>,
    unit: &'static str,
    kind: Kind,
    /// The words to choose from, if there are any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    choices: Vec<Choice>,
    /// Value as written, else the default; null if there is neither.
    pub(crate) value: Value,
    /// Whether the key is written in the file.
    written: bool,
    /// Whether the key is optional.
    optional: bool,
    /// Whether the key changes only the shape of bodies, not the motion.
    #[serde(skip)]
    pub(crate) detail: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    minimum: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    maximum: Option<f64>,
}

impl Field {
    /// Whether the key is in the file and is optional.
    pub(crate) fn may_go(&self) -> bool {
        self.written && self.optional
    }

    /// Whether the key may be omitted.
    pub(crate) fn is_optional(&self) -> bool {
        self.optional
    }

    /// The words to choose from.
    #[cfg(test)]
    pub(crate) fn words(&self) -> Vec<String> {
        self.choices
            .iter()
            .map(|choice| choice.word.clone())
            .collect()
    }
}

/// Kind of value of a field.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    Number,
    Integer,
    Switch,
    Text,
    /// One of the choices.
    Choice,
    /// One of the choices, or a number.
    Either,
    /// A list of numbers.
    Numbers,
    /// A list of whole numbers.
    Integers,
}

/// A word of a choice.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Choice {
    pub(crate) word: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) doc: String,
}

/// Tables of a design file, from the schema of its family and the text; empty if the text is not TOML.
pub(crate) fn tables(text: &str) -> Vec<Table> {
    let Ok(written) = text.parse::<toml::Table>() else {
        return Vec::new();
    };
    let Ok(written) = serde_json::to_value(written) else {
        return Vec::new();
    };
    let mut out = Vec::new();
    add(
        schema(),
        "",
        String::new(),
        false,
        Some(&written),
        None,
        &mut out,
    );
    // Tables within a detail are details, too, and those within an absent table are absent.
    for inner in 1..out.len() {
        let (around, rest) = out.split_at_mut(inner);
        let own = &mut rest[0];
        let key = own.key.clone();
        let holds = |table: &Table| key.starts_with(&format!("{}.", table.key));
        own.detail |= around.iter().any(|table| table.detail && holds(table));
        let is_within = around.iter().any(|table| table.absent && holds(table));
        own.addable = own.absent && !is_within && can_be_added(text, own);
        own.absent |= is_within;
    }
    out
}

/// Keys allowed in a table next to a tag of the given word, with their defaults, null if there is none; `None` if the table has
/// no such tag.
pub(crate) fn keys_next_to(text: &str, table: &str, word: &str) -> Option<Map<String, Value>> {
    let written = serde_json::to_value(text.parse::<toml::Table>().ok()?).ok()?;
    let mut here = schema();
    let mut value = written;
    for name in table.split('.').filter(|name| !name.is_empty()) {
        let Requirements::Table { properties, .. } = shape(schema(), here, &value) else {
            return None;
        };
        here = properties.iter().find(|(key, _)| key == name)?.1;
        value = value.get(name).cloned().unwrap_or_default();
    }
    let tagged = Value::Object(Map::from_iter([("kind".to_owned(), word.into())]));
    match shape(schema(), here, &tagged) {
        Requirements::Table {
            tag: Some(_),
            properties,
            ..
        } => {
            let default = |sub: &Value| sub.get("default").cloned().unwrap_or_default();
            let keys = properties.iter();
            Some(keys.map(|(key, sub)| (key.clone(), default(sub))).collect())
        }
        _ => None,
    }
}

/// Required keys of a table absent from the file, with their effective defaults.
pub(crate) fn required(text: &str, table: &str) -> Vec<(String, Value)> {
    let tables = tables(text);
    let fields = tables.into_iter().filter(|t| t.key == table);
    let needed = fields
        .flat_map(|t| t.fields)
        .filter(|field| !field.optional && !field.value.is_null());
    needed
        .filter_map(|field| {
            let name = field.key.rsplit('.').next()?;
            Some((name.to_owned(), field.value))
        })
        .collect()
}

/// Effective list of a key; `None` for any other key.
pub(crate) fn list(text: &str, key: &str) -> Option<Value> {
    let mut fields = tables(text).into_iter().flat_map(|table| table.fields);
    let field = fields.find(|field| field.key == key)?;
    field.value.is_array().then_some(field.value)
}

fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| FAMILIES.json_schema())
}

fn add(
    sub: &Value,
    key: &str,
    doc: String,
    optional: bool,
    written: Option<&Value>,
    default: Option<&Value>,
    out: &mut Vec<Table>,
) {
    let nothing = Value::Null;
    let shown = written.or(default).unwrap_or(&nothing);
    let (tag, words, properties, required) = match shape(schema(), sub, shown) {
        Requirements::Table {
            tag,
            words,
            properties,
            required,
        } => (tag, words, properties, required),
        // The written word is not a known tag: only the choice can be shown.
        Requirements::Tagged { tag, words } => (Some(tag), words, Vec::new(), Vec::new()),
        Requirements::Leaf(_) => return,
    };
    let at = out.len();
    out.push(Table {
        key: key.into(),
        doc,
        optional,
        absent: optional && written.is_none() && (tag.is_some() || !properties.is_empty()),
        addable: false,
        may_go: false,
        detail: marked(schema(), sub, DETAIL).is_some(),
        fields: Vec::new(),
    });
    let path = |name: &str| {
        if key.is_empty() {
            name.to_owned()
        } else {
            format!("{key}.{name}")
        }
    };
    let mut fields = Vec::new();
    if let Some(tag) = tag {
        let value = shown.get(tag).cloned().unwrap_or_default();
        fields.push(Field {
            key: path(tag),
            doc: "Kind".into(),
            symbol: None,
            unit: "",
            kind: Kind::Choice,
            choices: words,
            written: written.is_some_and(|w| w.get(tag).is_some()),
            value,
            optional: false,
            detail: false,
            minimum: None,
            maximum: None,
        });
    }
    for (name, sub) in properties
        .iter()
        .filter(|(name, _)| Some(name.as_str()) != tag)
    {
        let own = written.and_then(|w| w.get(name));
        let default = default.and_then(|d| d.get(name)).or(sub.get("default"));
        let required = required.iter().any(|r| r == name);
        match shape(schema(), sub, own.or(default).unwrap_or(&nothing)) {
            Requirements::Table { .. } | Requirements::Tagged { .. } => {
                let optional = !required && default.is_none();
                let inner = out.len();
                add(
                    sub,
                    &path(name),
                    described(sub),
                    optional,
                    own,
                    default,
                    out,
                );
                out[inner].may_go = own.is_some() && !required;
            }
            Requirements::Leaf(leaf) => {
                let words = described(sub);
                fields.push(Field {
                    key: path(name),
                    symbol: symbol(sub),
                    unit: unit(name, &words),
                    doc: words,
                    kind: leaf.kind,
                    choices: leaf.choices,
                    value: own.or(default).cloned().unwrap_or_default(),
                    written: own.is_some(),
                    optional: !required,
                    detail: marked(schema(), sub, DETAIL).is_some(),
                    minimum: leaf.minimum,
                    maximum: leaf.maximum,
                });
            }
        }
    }
    out[at].fields = fields;
}

/// Symbol of a key in its paper.
fn symbol(sub: &Value) -> Option<String> {
    let mark = marked(schema(), sub, SYMBOL)?;
    Some(mark.as_str()?.to_owned())
}

/// Unit in which a key is written, from its name or else from its description.
fn unit(name: &str, doc: &str) -> &'static str {
    if name.ends_with("_deg") {
        return "°";
    }
    // Longer names first, because a unit may begin with the name of another.
    const UNITS: [&str; 16] = [
        "kg/m^3", "kg mm²", "N/mm", "N mm", "mm/s", "mm/rad", "rad/s", "1/min", "r/min", "1/mm",
        "1/in", "kg", "mm", "s", "N", "rad",
    ];
    let ends =
        |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '/' || c == '^');
    let named = |part: &str| {
        UNITS
            .into_iter()
            .find(|unit| part.strip_prefix(unit).is_some_and(ends))
    };
    match doc.split(", ").skip(1).find_map(named) {
        Some("kg/m^3") => "kg/m³",
        Some("N mm") => "N·mm",
        other => other.unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(text: &str, key: &str) -> Field {
        let fields: Vec<Field> = tables(text).into_iter().flat_map(|t| t.fields).collect();
        let found = fields.iter().find(|f| f.key == key);
        found
            .unwrap_or_else(|| {
                panic!(
                    "no {key} in {:?}",
                    fields.iter().map(|f| &f.key).collect::<Vec<_>>()
                )
            })
            .clone()
    }

    #[test]
    fn every_key_of_every_template_has_a_field() {
        for family in FAMILIES.0 {
            let text = family.design.template;
            let written: toml::Table = text.parse().expect("toml");
            let mut left: Vec<(String, toml::Value)> = written.into_iter().collect();
            let fields = tables(text);
            while let Some((path, value)) = left.pop() {
                if let toml::Value::Table(inner) = value {
                    assert!(fields.iter().any(|t| t.key == path), "no table {path}");
                    left.extend(inner.into_iter().map(|(k, v)| (format!("{path}.{k}"), v)));
                } else {
                    let found = field(text, &path);
                    assert!(found.written && !found.value.is_null(), "{found:?}");
                }
            }
        }
    }

    #[test]
    fn fields_have_unit_range_and_default() {
        let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.2\nmodule = 2\ntooth_count = 23\n";
        assert_eq!(field(text, "teeth.backlash").unit, "mm");
        assert_eq!(field(text, "teeth.backlash").value, 0.0);
        assert!(!field(text, "teeth.backlash").written);
        assert_eq!(field(text, "pitch.diametral_pitch").unit, "1/in");
        assert_eq!(field(text, "tool.pressure_angle_deg").unit, "°");
        assert_eq!(field(text, "driver.density").unit, "kg/m³");
        assert_eq!(field(text, "pitch.tooth_count").kind, Kind::Integer);
        assert_eq!(field(text, "teeth.phase").kind, Kind::Either);
        assert_eq!(field(text, "teeth.addendum").choices.len(), 2);
        assert_eq!(field(text, "mean_ratio").kind, Kind::Integers);
        assert!(field(text, "pitch.kind").choices.len() > 8);
        assert!(field(text, "driver.keyway.width").value.is_null());
    }

    #[test]
    fn fields_have_the_symbol_of_the_paper() {
        let text = FAMILIES.template("three-arm").expect("a template");
        for (key, symbol) in [
            ("carrier_start_deg", "phi_0"),
            ("bend_deg", "gamma_0"),
            ("arm.tip_distance", "S"),
            ("arm.pusher_offset", "H_1"),
            ("pitch.radius", "r_i"),
        ] {
            assert_eq!(field(text, key).symbol.as_deref(), Some(symbol), "{key}");
        }
        assert_eq!(field(text, "teeth.backlash").symbol, None);
    }

    #[test]
    fn a_bad_word_leaves_the_choice() {
        let text = "family = \"gear-pair\"\n[pitch]\nkind = \"elipse\"\n";
        let kind = field(text, "pitch.kind");
        assert_eq!(kind.value, "elipse");
        assert!(kind.choices.iter().any(|c| c.word == "ellipse"));
        assert!(field("family = \"gear\"", "family").choices.len() == FAMILIES.0.len());
        assert!(tables("= not toml").is_empty());
    }

    #[test]
    fn a_kind_knows_what_stands_beside_it() {
        let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\n";
        let keys = keys_next_to(text, "pitch", "circle").expect("tagged");
        assert!(keys.contains_key("radius") && !keys.contains_key("eccentricity"));
        assert_eq!(keys_next_to(text, "teeth", "circle"), None);
    }
}
