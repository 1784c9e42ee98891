//! Words and numbers for the position and the height of teeth.

use centrode_mechanism::gear::design::{Addendum, Phase};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyErr, PyResult};

use crate::error::unknown_word;

/// Position of the teeth: a word, or pitches from the polar angle zero to the middle of a tooth.
#[derive(Debug)]
pub(crate) enum Place {
    /// Left out.
    Auto,
    /// A word.
    Word(String),
    /// Pitches.
    Pitches(f64),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Place {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(word) = object.extract() {
            return Ok(Self::Word(word));
        }
        let pitches = object
            .extract()
            .map_err(|_| PyTypeError::new_err("phase must be a word or a number of pitches"))?;
        Ok(Self::Pitches(pitches))
    }
}

const PHASES: [(&str, Phase); 4] = [
    ("auto", Phase::Auto),
    ("tooth", Phase::Tooth),
    ("space", Phase::Space),
    ("congruent", Phase::Congruent),
];

impl Place {
    /// The place as a design has it.
    pub(crate) fn phase(self) -> PyResult<Phase> {
        let word = match self {
            Self::Auto => return Ok(Phase::Auto),
            Self::Pitches(pitches) => return Ok(Phase::Pitches(pitches)),
            Self::Word(word) => word,
        };
        let found = PHASES.iter().find(|(name, _)| *name == word);
        found
            .map(|(_, phase)| *phase)
            .ok_or_else(|| unknown_word("teeth.phase", &word, &PHASES.map(|(name, _)| name)))
    }
}

/// The height of the teeth by its word.
pub(crate) fn addendum(word: &str) -> PyResult<Addendum> {
    match word {
        "full" => Ok(Addendum::Full),
        "fitted" => Ok(Addendum::Fitted),
        _ => Err(unknown_word("teeth.addendum", word, &["full", "fitted"])),
    }
}
