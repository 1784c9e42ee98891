//! `NumPy` arrays in and out.

use centrode_geometry::{Mesh, Point};
use centrode_mechanism::transmission::MotionJet;
use numpy::ndarray::{Array2, ArrayD};
use numpy::{Element, IntoPyArray, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::{
    Borrowed, Bound, FromPyObject, IntoPyObject, Py, PyAny, PyAnyMethods, PyErr, PyResult, Python,
};
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyDictMethods};

use crate::error::{Answer, finite};
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
    pub(crate) fn finite(self) -> Answer<Self> {
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

/// Numbers of all answers, one after the other.
type Answers = dyn FnOnce(&[f64]) -> Answer<Vec<f64>> + Send;

/// Answers at numbers, worked out as they are handed to Python: of the shape of the numbers, and then of that of one
/// answer.
pub(crate) struct Course {
    values: Values,
    tail: Vec<usize>,
    answers: Box<Answers>,
}

impl Course {
    /// A number for each.
    pub(crate) fn each(values: Values, f: impl Fn(f64) -> f64 + Send + 'static) -> Self {
        Self::together(values, &[], move |all| {
            Ok(all.iter().map(|&value| f(value)).collect())
        })
    }

    /// An array for each, its shape `tail`.
    pub(crate) fn arrays<const COUNT: usize>(
        values: Values,
        tail: &[usize],
        f: impl Fn(f64) -> [f64; COUNT] + Send + 'static,
    ) -> Self {
        Self::together(values, tail, move |all| {
            Ok(all.iter().flat_map(|&value| f(value)).collect())
        })
    }

    /// Arrays of the shape `tail` that are worked out for all numbers at once.
    pub(crate) fn together(
        values: Values,
        tail: &[usize],
        f: impl FnOnce(&[f64]) -> Answer<Vec<f64>> + Send + 'static,
    ) -> Self {
        Self {
            values,
            tail: tail.to_vec(),
            answers: Box::new(f),
        }
    }
}

impl<'py> IntoPyObject<'py> for Course {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Values(values) = self.values.finite()?;
        let shape = [values.shape(), &self.tail].concat();
        let answers = self.answers;
        let given = Values(values).into_flat();
        let found = match given.as_slice() {
            // Other threads are not worth waking for one number.
            [_] => answers(&given)?,
            _ => wait(py, move || answers(&given))??,
        };
        if let ([], &[number]) = (&shape[..], &found[..]) {
            return number.into_bound_py_any(py);
        }
        let array = ArrayD::from_shape_vec(shape, found);
        let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(array.into_pyarray(py).into_any())
    }
}

/// A coordinate and its first three derivatives.
pub(crate) fn row(jet: &MotionJet) -> [f64; 4] {
    [jet.position, jet.velocity, jet.acceleration, jet.jerk]
}

/// Rows of numbers, handed over as an (N, COLUMNS) array.
pub(crate) struct Rows<const COLUMNS: usize, T = f64>(pub(crate) Vec<[T; COLUMNS]>);

impl Rows<2> {
    pub(crate) fn of(points: &[Point]) -> Self {
        Self(points.iter().map(|p| [p.x, p.y]).collect())
    }
}

impl<'py, const COLUMNS: usize, T: Element> IntoPyObject<'py> for Rows<COLUMNS, T> {
    type Target = PyArray2<T>;
    type Output = Bound<'py, PyArray2<T>>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let shape = [self.0.len(), COLUMNS];
        let array = Array2::from_shape_vec(shape, self.0.into_flattened());
        let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(array.into_pyarray(py))
    }
}

/// Vertices of a mesh, (V, 3), and its faces, (F, 3).
pub(crate) type MeshRows = (Rows<3>, Rows<3, u32>);

/// A mesh as two arrays.
pub(crate) fn mesh(mesh: Mesh) -> MeshRows {
    (Rows(mesh.vertices), Rows(mesh.faces))
}
