use serde_json::{Map, Value};

use super::field::{Choice, Kind};

/// Requirements of a part of the JSON schema, for the value that is there.
pub(super) enum Requirements<'a> {
    /// A table with known keys; if it has a tag, the tag determines them.
    Table {
        tag: Option<&'a str>,
        words: Vec<Choice>,
        properties: Vec<(String, &'a Value)>,
        required: Vec<&'a str>,
    },
    /// A table whose tag is not a known word.
    Tagged { tag: &'a str, words: Vec<Choice> },
    /// A value.
    Leaf(Leaf),
}

/// A value of the design file.
pub(super) struct Leaf {
    pub(super) kind: Kind,
    pub(super) choices: Vec<Choice>,
    pub(super) minimum: Option<f64>,
    pub(super) maximum: Option<f64>,
}

/// Requirements of the schema `sub`, a part of `root`, where `value` is written.
pub(super) fn shape<'a>(root: &'a Value, sub: &'a Value, value: &Value) -> Requirements<'a> {
    let sub = followed(root, sub);
    let options = ["oneOf", "anyOf"]
        .into_iter()
        .find_map(|k| sub.get(k)?.as_array());
    if let Some(options) = options {
        let options: Vec<&Value> = options
            .iter()
            .filter(|o| o.get("type").and_then(Value::as_str) != Some("null"))
            .map(|o| followed(root, o))
            .collect();
        if let [only] = options.as_slice()
            && tag_of(only).is_none()
        {
            return shape(root, only, value);
        }
        if let Some(tag) = options.first().and_then(|o| tag_of(o)) {
            return tagged(tag, &options, value);
        }
        return Requirements::Leaf(choice(&options));
    }
    if let Some(properties) = sub.get("properties").and_then(Value::as_object) {
        return table(None, Vec::new(), sub, properties);
    }
    if let Some(item) = sub
        .get("additionalProperties")
        .filter(|item| item.is_object())
    {
        // A table with names chosen by the user: the names that are written.
        let names = value.as_object().into_iter().flatten();
        return Requirements::Table {
            tag: None,
            words: Vec::new(),
            properties: names.map(|(name, _)| (name.clone(), item)).collect(),
            required: Vec::new(),
        };
    }
    Requirements::Leaf(leaf(root, sub))
}

/// Schema to which a reference leads.
fn followed<'a>(root: &'a Value, sub: &'a Value) -> &'a Value {
    let mut here = sub;
    while let Some(target) = here.get("$ref").and_then(Value::as_str) {
        match root.pointer(target.trim_start_matches('#')) {
            Some(next) => here = next,
            None => break,
        }
    }
    here
}

/// Mark on a part of the schema: next to the part, or in the schema to which it refers, apart from null.
pub(super) fn marked<'a>(root: &'a Value, sub: &'a Value, mark: &str) -> Option<&'a Value> {
    let options = sub.get("anyOf").and_then(Value::as_array);
    let options = options.into_iter().flatten();
    let places = [sub, followed(root, sub)].into_iter();
    let mut places = places.chain(options.map(|option| followed(root, option)));
    places.find_map(|place| place.get(mark))
}

/// Key whose single allowed word distinguishes an alternative from the others.
fn tag_of(option: &Value) -> Option<&str> {
    let properties = option.get("properties")?.as_object()?;
    properties
        .iter()
        .find(|(_, p)| p.get("const").is_some())
        .map(|(name, _)| name.as_str())
}

fn tagged<'a>(tag: &'a str, options: &[&'a Value], value: &Value) -> Requirements<'a> {
    let word = |o: &Value| {
        o["properties"][tag]["const"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    };
    let words = options
        .iter()
        .map(|o| Choice {
            word: word(o),
            doc: described(o),
        })
        .collect();
    let chosen = value.get(tag).and_then(Value::as_str);
    let option = options.iter().find(|o| Some(word(o).as_str()) == chosen);
    match option.and_then(|o| Some((o, o.get("properties")?.as_object()?))) {
        Some((option, properties)) => table(Some(tag), words, option, properties),
        None => Requirements::Tagged { tag, words },
    }
}

fn table<'a>(
    tag: Option<&'a str>,
    words: Vec<Choice>,
    sub: &'a Value,
    properties: &'a Map<String, Value>,
) -> Requirements<'a> {
    let required = sub.get("required").and_then(Value::as_array);
    let required = required
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect();
    let properties = properties.iter();
    Requirements::Table {
        tag,
        words,
        properties: properties.map(|(name, sub)| (name.clone(), sub)).collect(),
        required,
    }
}

/// A choice of words, to which a number may be added.
fn choice(options: &[&Value]) -> Leaf {
    let mut choices = Vec::new();
    let mut number = false;
    for option in options {
        if let Some(word) = option.get("const").and_then(Value::as_str) {
            choices.push(Choice {
                word: word.into(),
                doc: described(option),
            });
        } else if let Some(words) = option.get("enum").and_then(Value::as_array) {
            let words = words.iter().filter_map(Value::as_str);
            choices.extend(words.map(|w| Choice {
                word: w.into(),
                doc: String::new(),
            }));
        } else {
            number = true;
        }
    }
    let kind = match (choices.is_empty(), number) {
        (true, _) => Kind::Text,
        (false, true) => Kind::Either,
        (false, false) => Kind::Choice,
    };
    Leaf {
        kind,
        choices,
        minimum: None,
        maximum: None,
    }
}

fn leaf(root: &Value, sub: &Value) -> Leaf {
    if let Some(words) = sub.get("enum") {
        let option = Value::Object(Map::from_iter([("enum".to_owned(), words.clone())]));
        return choice(&[&option]);
    }
    let kind = match type_of(sub) {
        "number" => Kind::Number,
        "integer" => Kind::Integer,
        "boolean" => Kind::Switch,
        "array" => match sub
            .get("items")
            .map_or("", |items| type_of(followed(root, items)))
        {
            "integer" => Kind::Integers,
            _ => Kind::Numbers,
        },
        _ => Kind::Text,
    };
    let bound = |keys: [&str; 2]| keys.into_iter().find_map(|k| sub.get(k)?.as_f64());
    Leaf {
        kind,
        choices: Vec::new(),
        minimum: bound(["minimum", "exclusiveMinimum"]),
        maximum: bound(["maximum", "exclusiveMaximum"]),
    }
}

/// The type of a value, apart from null.
fn type_of(sub: &Value) -> &str {
    match sub.get("type") {
        Some(Value::String(one)) => one,
        Some(Value::Array(some)) => some
            .iter()
            .filter_map(Value::as_str)
            .find(|t| *t != "null")
            .unwrap_or_default(),
        _ => "",
    }
}

/// The description, in one line.
pub(super) fn described(sub: &Value) -> String {
    let doc = sub
        .get("description")
        .and_then(Value::as_str)
        .unwrap_or_default();
    doc.split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace('`', "")
}
