use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyAnyMethods, PyErr, PyResult};

use crate::error::{Answer, Raised};

/// A whole number as given, to be checked once its key is known.
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
    pub(crate) fn of(self, key: &str) -> Answer<u32> {
        self.within(key, 0, u32::MAX)
    }

    /// The number, or an error that names the key and its range.
    pub(crate) fn within(self, key: &str, minimum: u32, maximum: u32) -> Answer<u32> {
        let given = match self {
            Self::Fits(count) if (minimum..=maximum).contains(&count) => return Ok(count),
            Self::Fits(count) => count.to_string(),
            Self::Absurd(text) => text,
        };
        let rule = format!("must be a whole number from {minimum} to {maximum}, not {given}");
        Err(Raised::rule(key, &rule))
    }
}
