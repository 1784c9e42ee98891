//! `NumPy` arrays in and out.

use centrode_geometry::{Cancel, Mesh, Point, checkpoint};
use centrode_kinematics::transmission::MotionJet;
use numpy::ndarray::{Array2, ArrayD};
use numpy::{Element, IntoPyArray, PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::{
    Borrowed, Bound, FromPyObject, IntoPyObject, Py, PyAny, PyAnyMethods, PyErr, PyResult, Python,
};
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyDictMethods};
use rayon::prelude::{IndexedParallelIterator, ParallelIterator, ParallelSlice, ParallelSliceMut};

use crate::error::{Answer, Raised, finite};
use crate::wait::{at_once, wait, wait_here};

/// Numbers in an array of any shape, or a single one: whatever `NumPy` makes real numbers of.
#[derive(Clone, Debug)]
pub(crate) struct Values {
    shape: Vec<usize>,
    /// Row after row.
    flat: Vec<f64>,
}

/// A list of numbers.
#[derive(Debug)]
pub(crate) struct Numbers(Vec<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Values {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        static ASARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let py = object.py();
        if let Ok(number) = object.extract::<f64>() {
            return Ok(Self {
                shape: Vec::new(),
                flat: vec![number],
            });
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
        let array = array.readonly();
        let flat = match array.as_slice() {
            Ok(flat) if array.is_c_contiguous() => flat.to_vec(),
            _ => array.as_array().iter().copied().collect(),
        };
        Ok(Self {
            shape: array.shape().to_vec(),
            flat,
        })
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let Values { shape, flat } = Values::extract(object)?;
        if shape.len() == 1 {
            Ok(Self(flat))
        } else {
            Err(PyValueError::new_err(format!(
                "must be a list of numbers, not an array of {} dimensions",
                shape.len()
            )))
        }
    }
}

impl Values {
    /// The length of a list, none for a single number; none at all for an array of more dimensions.
    pub(crate) fn length(&self) -> Option<Option<usize>> {
        match self.shape[..] {
            [] => Some(None),
            [length] => Some(Some(length)),
            _ => None,
        }
    }

    /// The numbers, if all are finite: a function of an angle has no value anywhere else.
    pub(crate) fn finite(self) -> Answer<Self> {
        match self.flat.iter().find(|value| !value.is_finite()) {
            Some(&value) => finite("every input", value).map(|_| self),
            None => Ok(self),
        }
    }

    /// Points of the plane, from an array (N, 2).
    pub(crate) fn points(self, key: &str) -> Answer<Vec<Point>> {
        let rows = self.rows::<2>(key)?;
        Ok(rows.into_iter().map(Point::from).collect())
    }

    /// Rows of an array of so many columns.
    pub(crate) fn rows<const COLUMNS: usize>(self, key: &str) -> Answer<Vec<[f64; COLUMNS]>> {
        match self.shape[..] {
            [_, columns] if columns == COLUMNS => Ok(self.flat.as_chunks::<COLUMNS>().0.to_vec()),
            _ => {
                let shape = &self.shape;
                let rule = format!("must be an array of the shape (N, {COLUMNS}), not {shape:?}");
                Err(Raised::rule(key, &rule))
            }
        }
    }

    pub(crate) fn into_flat(self) -> Vec<f64> {
        self.flat
    }
}

impl Numbers {
    /// The inputs, if all are finite and none is farther than that, rad: a far angle is not known well enough.
    pub(crate) fn up_to(self, farthest: f64) -> Answer<Vec<f64>> {
        for &input in &self.0 {
            if finite("every input", input)?.abs() > farthest {
                let rule = format!("must be from {} to {farthest} rad, not {input}", -farthest);
                return Err(Raised::rule("every input", &rule));
            }
        }
        Ok(self.0)
    }

    pub(crate) fn into_vec(self) -> Vec<f64> {
        self.0
    }
}

/// The numbers, or none.
pub(crate) fn list(numbers: Option<Numbers>) -> Vec<f64> {
    numbers.map_or_else(Vec::new, Numbers::into_vec)
}

/// Numbers in a block of answers that is worked out and handed over at once.
const BLOCK: usize = 1 << 14;

/// Writes the answers at a block of numbers, one after the other.
type OfBlock = dyn Fn(&[f64], &mut [f64]) + Send + Sync;

/// Numbers of the answers at all numbers.
type OfAll = dyn FnOnce(&[f64]) -> Answer<Vec<f64>> + Send;

enum Answers {
    /// Worked out block by block, on every core.
    Blocks(Box<OfBlock>),
    /// Worked out together.
    All(Box<OfAll>),
}

/// Answers at numbers, worked out as they are handed to Python: of the shape of the numbers, and then of that of one
/// answer.
pub(crate) struct Course {
    values: Values,
    tail: Vec<usize>,
    answers: Answers,
}

impl Course {
    /// A number for each.
    pub(crate) fn each(values: Values, f: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::arrays(values, &[], move |value| [f(value)])
    }

    /// An array for each, its shape `tail`.
    pub(crate) fn arrays<const COUNT: usize>(
        values: Values,
        tail: &[usize],
        f: impl Fn(f64) -> [f64; COUNT] + Send + Sync + 'static,
    ) -> Self {
        Self::by_blocks(values, tail, move |block, answers| {
            put(block, answers, |&value| {
                checkpoint();
                f(value)
            });
        })
    }

    /// Arrays of the shape `tail` that are worked out, and written, for many numbers at once.
    pub(crate) fn by_blocks(
        values: Values,
        tail: &[usize],
        f: impl Fn(&[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        Self {
            values,
            tail: tail.to_vec(),
            answers: Answers::Blocks(Box::new(f)),
        }
    }

    /// Arrays of the shape `tail` that are worked out for all numbers together.
    pub(crate) fn together(
        values: Values,
        tail: &[usize],
        f: impl FnOnce(&[f64]) -> Answer<Vec<f64>> + Send + 'static,
    ) -> Self {
        Self {
            values,
            tail: tail.to_vec(),
            answers: Answers::All(Box::new(f)),
        }
    }
}

impl<'py> IntoPyObject<'py> for Course {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Values { shape, flat: given } = self.values.finite()?;
        let each: usize = self.tail.iter().product();
        let shape = [shape, self.tail].concat();
        // Other threads are not worth waking for one number.
        let is_one = given.len() == 1;
        let found = match self.answers {
            Answers::Blocks(f) if given.len() * each > BLOCK => {
                let block = (BLOCK / each.max(1)).max(1);
                return in_blocks(py, shape, (&given, block, each), &*f);
            }
            Answers::Blocks(f) => {
                let mut found = vec![0.0; given.len() * each];
                if is_one {
                    at_once(|| f(&given, &mut found))?;
                } else {
                    wait_here(py, || f(&given, &mut found))?;
                }
                found
            }
            Answers::All(f) if is_one => at_once(|| f(&given))??,
            Answers::All(f) => wait(py, move || f(&given))??,
        };
        if let ([], &[number]) = (&shape[..], &found[..]) {
            return number.into_bound_py_any(py);
        }
        let array = ArrayD::from_shape_vec(shape, found);
        let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(array.into_pyarray(py).into_any())
    }
}

/// Answers worked out side by side and written straight to their array: `NumPy` has memory of its own for great arrays, in
/// which pages come many at once.
fn in_blocks<'py>(
    py: Python<'py>,
    shape: Vec<usize>,
    (given, block, each): (&[f64], usize, usize),
    f: &OfBlock,
) -> PyResult<Bound<'py, PyAny>> {
    static EMPTY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let array = EMPTY.import(py, "numpy", "empty")?.call1((shape,))?;
    let array = array.cast_into::<PyArrayDyn<f64>>()?;
    let mut room = array.readwrite();
    let room = room.as_slice_mut()?;
    wait_here(py, || {
        let under = Cancel::current();
        let answers = room.par_chunks_mut(block * each);
        let blocks = given.par_chunks(block).zip(answers).panic_fuse();
        blocks.for_each(|(of_given, of_answers)| {
            let _scope = under.enter();
            f(of_given, of_answers);
        });
    })?;
    Ok(array.into_any())
}

/// Writes the numbers of each item to their position among the answers.
pub(crate) fn put<T, const COUNT: usize>(
    things: &[T],
    answers: &mut [f64],
    numbers: impl Fn(&T) -> [f64; COUNT],
) {
    let (answers, _) = answers.as_chunks_mut();
    for (answer, thing) in answers.iter_mut().zip(things) {
        *answer = numbers(thing);
    }
}

/// A coordinate and its first three derivatives.
pub(crate) fn row(jet: &MotionJet) -> [f64; 4] {
    [jet.position, jet.velocity, jet.acceleration, jet.jerk]
}

/// Rows of numbers, handed over as an (N, COLUMNS) array.
#[derive(Clone, Debug)]
pub(crate) struct Rows<const COLUMNS: usize, T = f64>(pub(crate) Vec<[T; COLUMNS]>);

impl Rows<2> {
    pub(crate) fn new(points: &[Point]) -> Self {
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
