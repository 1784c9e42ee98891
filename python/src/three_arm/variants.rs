//! Figures of many variants of one design.

use std::collections::BTreeMap;

use centrode_analysis::{Variants, VariantsError};
use centrode_machines::three_arm::design::ThreeArmDesign;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyResult, Python};
use pyo3::types::{PyDict, PyDictMethods};

use crate::array::Values;
use crate::error::{Answer, Raised};
use crate::wait::wait;

/// Maximum number of variants and inputs that memory holds.
const MOST: usize = 50_000_000;
const MAX_INPUTS: usize = 100_000;

/// Figures by name, one for each variant.
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    design: &ThreeArmDesign,
    parameters: BTreeMap<String, Values>,
    inputs: usize,
) -> Answer<Bound<'py, PyDict>> {
    if !(1..=MAX_INPUTS).contains(&inputs) {
        let message = format!("inputs must be 1 to {MAX_INPUTS}, not {inputs}");
        return Err(PyValueError::new_err(message).into());
    }
    let names: Vec<&String> = parameters.keys().collect();
    let variants = Variants::new(design, &names, inputs);
    let variants = variants.map_err(|error| Raised::rule(key(&error), &error.to_string()))?;
    let count = count(&parameters)?;
    let columns: Vec<Vec<f64>> = parameters.into_values().map(Values::into_flat).collect();
    let figures = wait(py, move || {
        variants.figures(count, |i, row| {
            for (value, column) in row.iter_mut().zip(&columns) {
                *value = if column.len() == 1 {
                    column[0]
                } else {
                    column[i]
                };
            }
        })
    })?;
    let named = PyDict::new(py);
    for (at, name) in Variants::FIGURES.into_iter().enumerate() {
        let column = figures.iter().map(|figures| figures[at]);
        named.set_item(name, PyArray1::from_iter(py, column))?;
    }
    Ok(named)
}

fn key(error: &VariantsError) -> &'static str {
    match error {
        VariantsError::Sweep(_) => "pitch",
        _ => "parameters",
    }
}

/// Number of variants: the length of all arrays.
fn count(parameters: &BTreeMap<String, Values>) -> PyResult<usize> {
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
