//! Figures of many variants of one design.

use std::collections::BTreeMap;

use centrode_analysis::{Variants, VariantsError};
use centrode_machines::three_arm::design::ThreeArmDesign;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, Python};
use pyo3::types::{PyDict, PyDictMethods};

use crate::array::Values;
use crate::error::{Answer, Raised};
use crate::sweep::count;
use crate::wait::wait;

/// Maximum number of inputs that memory holds.
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
