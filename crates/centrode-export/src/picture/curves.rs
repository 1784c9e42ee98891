use serde::ser::SerializeSeq as _;
use serde::{Serialize, Serializer};

use super::{Curve, path};

/// Curves as JSON: inputs equal to those of the previous curve are null.
#[derive(Clone, Copy, Debug)]
pub struct CurveList<'a>(pub &'a [Curve]);

#[derive(Serialize)]
struct Stated<'a> {
    chart: &'a str,
    name: &'a str,
    unit: &'a str,
    count: bool,
    input: Option<Drawn<'a>>,
    value: Drawn<'a>,
}

struct Drawn<'a>(&'a [f64]);

impl Serialize for Drawn<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        path::drawn(self.0, serializer)
    }
}

impl Serialize for CurveList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.0.len()))?;
        let mut before: Option<&[f64]> = None;
        for curve in self.0 {
            let input = &curve.input[..];
            list.serialize_element(&Stated {
                chart: &curve.chart,
                name: curve.name,
                unit: curve.unit,
                count: curve.count,
                input: (before != Some(input)).then_some(Drawn(input)),
                value: Drawn(&curve.value),
            })?;
            before = Some(input);
        }
        list.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_told_where_they_change() {
        let curve = |input: &[f64]| Curve::new(["chart", "", "mm"], input, vec![0.5; input.len()]);
        let curves = [&[0.0, 1.0][..], &[0.0, 1.0], &[0.0], &[0.0, 1.0]].map(curve);
        let stated = serde_json::to_value(CurveList(&curves)).expect("JSON");
        let inputs = [0, 1, 2, 3].map(|i| stated[i]["input"].as_array().map(Vec::len));
        assert_eq!(inputs, [Some(2), None, Some(1), Some(2)]);
        assert_eq!(stated[1]["value"], serde_json::json!([0.5, 0.5]));
        assert_eq!(stated[3], serde_json::to_value(&curves[0]).expect("JSON"));
    }
}
