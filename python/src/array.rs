//! `NumPy` arrays in and out.

use centrode_geometry::Point;
use numpy::ndarray::{Array2, ArrayD};
use numpy::{AllowTypeChange, IntoPyArray, PyArray2, PyArrayDyn, PyArrayLike1, PyArrayLikeDyn};
use pyo3::prelude::{Bound, PyResult, Python};

use crate::error::Error;

/// A list of numbers: anything `NumPy` can make a one-dimensional float array of.
pub(crate) type Numbers<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// Numbers in an array of any shape, or a single one.
pub(crate) type Values<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// The numbers, or none.
pub(crate) fn list(numbers: Option<Numbers<'_>>) -> Vec<f64> {
    numbers.map_or_else(Vec::new, |n| n.as_array().to_vec())
}

/// A function applied to each number; the answer has the shape of the question.
pub(crate) fn each<'py>(
    py: Python<'py>,
    values: &Values<'py>,
    f: impl Fn(f64) -> f64,
) -> Bound<'py, PyArrayDyn<f64>> {
    let answer: ArrayD<f64> = values.as_array().mapv(f);
    answer.into_pyarray(py)
}

/// Points as an (N, 2) array.
pub(crate) fn points<'py>(
    py: Python<'py>,
    points: &[Point],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers: Vec<f64> = points.iter().flat_map(|p| [p.x, p.y]).collect();
    let rows = Array2::from_shape_vec([points.len(), 2], numbers);
    Ok(rows
        .map_err(|error| Error::new_err(error.to_string()))?
        .into_pyarray(py))
}
