//! `NumPy` arrays in and out.

use centrode_geometry::Point;
use numpy::ndarray::{Array2, ArrayD};
use numpy::{IntoPyArray, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::{
    Borrowed, Bound, FromPyObject, Py, PyAny, PyAnyMethods, PyErr, PyResult, Python,
};
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyDictMethods};

use crate::error::finite;
use crate::wait::wait;

/// Numbers in an array of any shape, or a single one: whatever `NumPy` makes real numbers of.
#[derive(Clone, Debug)]
pub(crate) struct Values(ArrayD<f64>);

/// A list of numbers.
#[derive(Debug)]
pub(crate) struct Numbers(Vec<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Values {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        static ASARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let py = object.py();
        if let Ok(number) = object.extract::<f64>() {
            return Ok(Self(ArrayD::from_elem(vec![], number)));
        }
        let asarray = ASARRAY.import(py, "numpy", "asarray")?;
        if object.is_none() {
            return Err(PyTypeError::new_err("must be real numbers, not None"));
        }
        let given = asarray.call1((object,))?;
        let dtype = given.getattr("dtype")?;
        let kind: String = dtype.getattr("kind")?.extract()?;
        // A forced cast would drop the imaginary part, and read words and dates as numbers.
        if !matches!(kind.as_str(), "b" | "i" | "u" | "f" | "O") {
            return Err(PyTypeError::new_err(format!(
                "must be real numbers, not {dtype}"
            )));
        }
        let options = PyDict::new(py);
        options.set_item("dtype", "float64")?;
        let array = asarray.call((given,), Some(&options))?;
        let array = array.cast_into::<PyArrayDyn<f64>>()?;
        Ok(Self(array.readonly().as_array().to_owned()))
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let Values(array) = Values::extract(object)?;
        if array.ndim() == 1 {
            Ok(Self(array.iter().copied().collect()))
        } else {
            Err(PyValueError::new_err(format!(
                "must be a list of numbers, not an array of {} dimensions",
                array.ndim()
            )))
        }
    }
}

impl Values {
    /// The length of a list, none for a single number; none at all for an array of more dimensions.
    pub(crate) fn length(&self) -> Option<Option<usize>> {
        match self.0.shape() {
            [] => Some(None),
            [length] => Some(Some(*length)),
            _ => None,
        }
    }

    /// The numbers, if all are finite: a function of an angle has no value anywhere else.
    fn finite(self) -> PyResult<Self> {
        for &value in &self.0 {
            finite("every input", value)?;
        }
        Ok(self)
    }

    pub(crate) fn into_flat(self) -> Vec<f64> {
        self.0.iter().copied().collect()
    }
}

impl Numbers {
    pub(crate) fn into_vec(self) -> Vec<f64> {
        self.0
    }
}

/// The numbers, or none.
pub(crate) fn list(numbers: Option<Numbers>) -> Vec<f64> {
    numbers.map_or_else(Vec::new, Numbers::into_vec)
}

/// Applies a function to each number; the answer has the shape of the question.
pub(crate) fn each(
    py: Python<'_>,
    values: Values,
    f: impl Fn(f64) -> f64 + Send + 'static,
) -> PyResult<Bound<'_, PyAny>> {
    let Values(mut values) = values.finite()?;
    if let (0, Some(&value)) = (values.ndim(), values.first()) {
        return f(value).into_bound_py_any(py);
    }
    let answer = wait(py, move || {
        values.mapv_inplace(f);
        values
    })?;
    Ok(answer.into_pyarray(py).into_any())
}

/// Applies a function to each number; the answer has the shape of the question and then that of one
/// answer, `tail`.
pub(crate) fn each_array<const COUNT: usize>(
    py: Python<'_>,
    values: Values,
    tail: &[usize],
    f: impl Fn(f64) -> [f64; COUNT] + Send + 'static,
) -> PyResult<Py<PyAny>> {
    let Values(values) = values.finite()?;
    let shape = [values.shape(), tail].concat();
    let answer: Vec<f64> = wait(py, move || values.iter().flat_map(|&v| f(v)).collect())?;
    Ok(shaped(shape, answer)?.into_pyarray(py).into_any().unbind())
}

/// Applies a function of all numbers at once, like [`each`].
pub(crate) fn together(
    py: Python<'_>,
    values: Values,
    f: impl Fn(&[f64]) -> PyResult<Vec<f64>> + Send + 'static,
) -> PyResult<Bound<'_, PyAny>> {
    let Values(values) = values.finite()?;
    let shape = values.shape().to_vec();
    let answer = wait(py, move || f(&Values(values).into_flat()))??;
    if let ([], &[number]) = (&shape[..], &answer[..]) {
        return number.into_bound_py_any(py);
    }
    Ok(shaped(shape, answer)?.into_pyarray(py).into_any())
}

/// Applies a function of all numbers at once, like [`each_array`].
pub(crate) fn together_array<const COUNT: usize>(
    py: Python<'_>,
    values: Values,
    tail: &[usize],
    f: impl Fn(&[f64]) -> PyResult<Vec<[f64; COUNT]>> + Send + 'static,
) -> PyResult<Py<PyAny>> {
    let Values(values) = values.finite()?;
    let shape = [values.shape(), tail].concat();
    let answer = wait(py, move || f(&Values(values).into_flat()))??;
    Ok(shaped(shape, answer.into_flattened())?
        .into_pyarray(py)
        .into_any()
        .unbind())
}

fn shaped(shape: Vec<usize>, numbers: Vec<f64>) -> PyResult<ArrayD<f64>> {
    let array = ArrayD::from_shape_vec(shape, numbers);
    array.map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Applies a function to each number, like [`each_array`], with one axis more.
pub(crate) fn each_row<'py, const COLUMNS: usize>(
    py: Python<'py>,
    values: Values,
    f: impl Fn(f64) -> [f64; COLUMNS] + Send + 'static,
) -> PyResult<Bound<'py, PyAny>> {
    Ok(each_array(py, values, &[COLUMNS], f)?.into_bound(py))
}

/// Rows of numbers as an (N, COLUMNS) array.
pub(crate) fn rows<'py, T: numpy::Element, const COLUMNS: usize>(
    py: Python<'py>,
    rows: impl ExactSizeIterator<Item = [T; COLUMNS]>,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let count = rows.len();
    let numbers: Vec<T> = rows.flatten().collect();
    let array = Array2::from_shape_vec([count, COLUMNS], numbers);
    Ok(array
        .map_err(|error| PyValueError::new_err(error.to_string()))?
        .into_pyarray(py))
}

/// Points as an (N, 2) array.
pub(crate) fn points<'py>(
    py: Python<'py>,
    points: &[Point],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    rows(py, points.iter().map(|p| [p.x, p.y]))
}
