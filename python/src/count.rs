use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyAnyMethods, PyErr, PyResult};

use crate::error::design_error;

/// A whole number as given, to be looked at once its key is known.
#[derive(Debug)]
pub(crate) enum Count {
    /// One that fits.
    Fits(u32),
    /// One that is negative or absurdly large.
    Absurd(String),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Count {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match object.extract::<u32>() {
            Ok(count) => Ok(Self::Fits(count)),
            Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => {
                Ok(Self::Absurd(object.str()?.extract()?))
            }
            Err(error) => Err(error),
        }
    }
}

impl Count {
    /// The number, or an error that names the key.
    pub(crate) fn of(self, key: &str) -> PyResult<u32> {
        match self {
            Self::Fits(count) => Ok(count),
            Self::Absurd(text) => Err(design_error(
                key,
                &format!("must be a whole number from 0 to {}, not {text}", u32::MAX),
            )),
        }
    }
}

/// The number, if there is one.
pub(crate) fn optional(key: &str, count: Option<Count>) -> PyResult<Option<u32>> {
    count.map(|c| c.of(key)).transpose()
}
