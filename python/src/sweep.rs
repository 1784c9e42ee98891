//! Many variants of one design.

use std::collections::BTreeMap;

use centrode::FAMILIES;
use centrode::family::Depth;
use centrode_analysis::Sweep;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyResult, Python, pyfunction};
use pyo3::types::{PyDict, PyDictMethods};

use crate::array::Values;
use crate::error::Answer;
use crate::wait::{at_once, wait};
use crate::word::Word;

/// Maximum number of variants that memory holds.
const MOST: usize = 50_000_000;

/// Figures of the variants of a design by name, and the reason of each variant that gives no mechanism. The values are in the
/// units of the design file.
#[pyfunction]
pub(crate) fn _sweep<'py>(
    py: Python<'py>,
    contents: &[u8],
    over: BTreeMap<String, Values>,
    depth: &str,
) -> Answer<(Bound<'py, PyDict>, Vec<Option<String>>)> {
    let depth: Depth = Word::of("depth", depth)?;
    let file = at_once(|| FAMILIES.read(contents))??;
    let count = count(&over)?;
    let keys: Vec<String> = over.keys().map(|word| file.design().key_of(word)).collect();
    let columns: Vec<Vec<f64>> = over.into_values().map(Values::into_flat).collect();
    let found = wait(py, move || {
        let variant = |i: usize| {
            let value = |column: &Vec<f64>| column[if column.len() == 1 { 0 } else { i }];
            columns.iter().map(value).collect()
        };
        let variants: Vec<Vec<f64>> = (0..count).map(variant).collect();
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        file.family().sweep(file.design(), &keys, &variants, depth)
    })??;
    let named = figures(py, &found)?;
    let reasons = found.reports.into_iter().map(Result::err).collect();
    Ok((named, reasons))
}

/// Goals and figures by name; NaN where there is none.
pub(crate) fn figures<'py>(py: Python<'py>, found: &Sweep) -> PyResult<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    for answer in found.answers() {
        let figures = answer
            .figures
            .iter()
            .map(|figure| figure.unwrap_or(f64::NAN));
        named.set_item(answer.name, PyArray1::from_iter(py, figures))?;
    }
    Ok(named)
}

/// Number of variants: the length of all arrays.
pub(crate) fn count(parameters: &BTreeMap<String, Values>) -> PyResult<usize> {
    let mut count: Option<(usize, &str)> = None;
    for (name, values) in parameters {
        let Some(length) = values.length() else {
            return Err(PyValueError::new_err(format!(
                "{name} must be a number or a list of numbers"
            )));
        };
        match (length, count) {
            (None, _) => {}
            (Some(length), Some((other, first))) if length != other => {
                return Err(PyValueError::new_err(format!(
                    "{name} has {length} values, but {first} has {other}"
                )));
            }
            (Some(length), _) => count = Some((length, name)),
        }
    }
    let count = count.map_or(1, |(count, _)| count);
    if count > MOST {
        return Err(PyValueError::new_err(format!(
            "{count} variants are too many for one call; the limit is {MOST}"
        )));
    }
    Ok(count)
}
