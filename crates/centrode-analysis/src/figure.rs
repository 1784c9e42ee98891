use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};

use crate::Unit;

/// Figures that are shown together, as rows and columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureGroup {
    /// Heading of the rows.
    pub heading: &'static str,
    /// Headings of the columns; empty for a single column without a heading.
    pub columns: &'static [&'static str],
    /// The rows.
    pub rows: &'static [FigureRow],
}

/// Figures of one kind in a row: one figure per column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureRow {
    /// Title for a person.
    pub title: &'static str,
    /// Key of the figure in [`Report::values`](crate::Report::values), per column; an empty string if the column has no
    /// figure.
    pub keys: &'static [&'static str],
    /// Unit of the figures.
    pub unit: Unit,
}

pub(crate) const fn row(
    title: &'static str,
    keys: &'static [&'static str],
    unit: Unit,
) -> FigureRow {
    FigureRow { title, keys, unit }
}

/// A number in JSON. Infinities and NaN, which JSON does not have, are the strings `"Infinity"`, `"-Infinity"` and `"NaN"`,
/// which `float` of Python and `Number` of JavaScript read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JsonNumber(pub f64);

impl Serialize for JsonNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            value if value.is_finite() => serializer.serialize_f64(value),
            value if value.is_nan() => serializer.serialize_str("NaN"),
            value if value > 0.0 => serializer.serialize_str("Infinity"),
            _ => serializer.serialize_str("-Infinity"),
        }
    }
}

impl JsonSchema for JsonNumber {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number; infinities and NaN are strings, because JSON has no numbers for them.",
            "anyOf": [
                { "type": "number" },
                { "enum": ["Infinity", "-Infinity", "NaN"] },
            ],
        })
    }
}

/// Writes a figure that may be absent.
pub(crate) fn option<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    value.map(JsonNumber).serialize(serializer)
}

/// Writes a list of figures that may be absent.
pub(crate) fn options<S: Serializer>(
    values: &[Option<f64>],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| value.map(JsonNumber)))
}

/// Writes figures by name.
pub(crate) fn values<S: Serializer>(
    values: &BTreeMap<&'static str, f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(
        values
            .iter()
            .map(|(name, &value)| (name, JsonNumber(value))),
    )
}

/// Writes rows of figures, each with its name.
pub(crate) fn rows<S: Serializer>(
    rows: &[(String, Vec<f64>)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let figures = |row: &[f64]| row.iter().copied().map(JsonNumber).collect::<Vec<_>>();
    serializer.collect_seq(rows.iter().map(|(name, row)| (name, figures(row))))
}
