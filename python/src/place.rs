use centrode_gear::design::{Phase, TipShortening};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyErr, PyResult};

use crate::word::Word;

/// Position of the teeth: a word, or pitches from the polar angle zero to the middle of a tooth.
#[derive(Debug)]
pub(crate) struct Place(pub(crate) Phase);

impl<'a, 'py> FromPyObject<'a, 'py> for Place {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(word) = object.extract::<&str>() {
            return Ok(Self(Word::of("teeth.phase", word)?));
        }
        let pitches = object
            .extract()
            .map_err(|_| PyTypeError::new_err("phase must be a word or a number of pitches"))?;
        Ok(Self(Phase::Pitches(pitches)))
    }
}

/// Change of every addendum: a word, or a coefficient in modules.
#[derive(Debug)]
pub(crate) struct Shortening(pub(crate) TipShortening);

impl<'a, 'py> FromPyObject<'a, 'py> for Shortening {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(word) = object.extract::<&str>() {
            return Ok(Self(Word::of("teeth.tip_shortening", word)?));
        }
        let coefficient = object
            .extract()
            .map_err(|_| PyTypeError::new_err("tip_shortening must be a word or a number"))?;
        Ok(Self(TipShortening::By(coefficient)))
    }
}
