use std::collections::BTreeMap;

use serde::{Serialize, Serializer};

/// A figure in JSON: a number or, for those JSON has no number for, one of the strings `"Infinity"`, `"-Infinity"` and
/// `"NaN"`, which `float` of Python and `Number` of JavaScript read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure(pub f64);

impl Serialize for Figure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            value if value.is_finite() => serializer.serialize_f64(value),
            value if value.is_nan() => serializer.serialize_str("NaN"),
            value if value > 0.0 => serializer.serialize_str("Infinity"),
            _ => serializer.serialize_str("-Infinity"),
        }
    }
}

/// Writes a figure that may be absent.
pub(crate) fn option<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    value.map(Figure).serialize(serializer)
}

/// Writes a list of figures that may be absent.
pub(crate) fn options<S: Serializer>(
    values: &[Option<f64>],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| value.map(Figure)))
}

/// Writes figures by name.
pub(crate) fn values<S: Serializer>(
    values: &BTreeMap<&'static str, f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(values.iter().map(|(name, &value)| (name, Figure(value))))
}

/// Writes rows of figures, each with its name.
pub(crate) fn rows<S: Serializer>(
    rows: &[(String, Vec<f64>)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let figures = |row: &[f64]| row.iter().copied().map(Figure).collect::<Vec<_>>();
    serializer.collect_seq(rows.iter().map(|(name, row)| (name, figures(row))))
}
