//! Keywords of a call, read into the tables of a spec: their types and defaults are those of its fields.

use centrode_gear::design::BodySpec;
use centrode_gear::pitch::{Smooth, SmoothAngle};
use centrode_kinematics::machine::Keyway as KeywaySpec;
use centrode_spec::{DrawingSpec as Drawing, FigureGoalSpec, Named};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyErr, PyResult, Python};
use pyo3::types::{PyDict, PyDictMethods, PyMapping};

use crate::array::Numbers;
use crate::body::{Body, Keyway};
use crate::count::Count;
use crate::drawing::DrawingSpec;
use crate::error::{Answer, class};
use crate::word::Word;

/// Sets fields of a table, at a position in its design, from keywords of their names or `keyword = field`.
macro_rules! fill {
    ($call:expr, $table:expr, $place:literal: $($keyword:ident $(= $field:ident)?),*) => {
        $($crate::keywords::fill!(@ $call, $table, $place, $keyword $($field)?);)*
    };
    (@ $call:expr, $table:expr, $place:literal, $field:ident) => {
        $crate::keywords::fill!(@ $call, $table, $place, $field $field)
    };
    (@ $call:expr, $table:expr, $place:literal, $keyword:ident $field:ident) => {
        if let Some(value) = $call.take(stringify!($keyword), concat!($place, stringify!($field)))? {
            $table.$field = value;
        }
    };
}

/// A field of a spec, as a keyword gives it.
pub(crate) trait Field: Sized {
    /// Value that None represents, where it may be given.
    fn none() -> Option<Self> {
        None
    }

    /// The value of an object, or an error that names the key.
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self>;
}

/// Fields that are read as `PyO3` reads them.
macro_rules! plain {
    ($($field:ty),*) => {
        $(impl Field for $field {
            fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
                Ok(object.extract()?)
            }
        })*
    };
}

plain!(f64, bool, String, [f64; 2]);

/// Fields that a class of the module holds, with what None represents.
macro_rules! held {
    ($($field:ty: $class:ty, $none:expr;)*) => {
        $(impl Field for $field {
            fn none() -> Option<Self> {
                $none
            }

            fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
                Ok(object.extract::<$class>().map_err(PyErr::from)?.0)
            }
        })*
    };
}

held! {
    BodySpec: Body, Some(Self::default());
    Drawing: DrawingSpec, Some(Self::default());
    KeywaySpec: Keyway, None;
}

impl Field for u32 {
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        object.extract::<Count>()?.of(key)
    }
}

impl Field for [u32; 2] {
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        let [first, second] = object.extract::<[Count; 2]>()?;
        Ok([first.of(key)?, second.of(key)?])
    }
}

impl Field for Vec<f64> {
    fn none() -> Option<Self> {
        Some(Self::new())
    }

    fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        Ok(object.extract::<Numbers>()?.into_vec())
    }
}

/// Smoothings, as dictionaries of their keys.
macro_rules! smoothings {
    ($($smooth:ident),*) => {
        $(impl Field for $smooth {
            fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
                let keys = PyDict::new(object.py());
                keys.update(object.cast::<PyMapping>().map_err(PyErr::from)?)?;
                let call = Call::new("smooth", Some(keys));
                let smooth = Self {
                    harmonics: call.optional("harmonics", "pitch.smooth.harmonics")?,
                    tolerance: call.optional("tolerance", "pitch.smooth.tolerance")?,
                };
                call.end()?;
                Ok(smooth)
            }
        })*
    };
}

smoothings!(Smooth, SmoothAngle);

impl<W: Word> Field for W {
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        let word: PyResult<String> = object.extract();
        let Some((number, sentence)) = Self::NUMBER else {
            return Self::of(key, &word?);
        };
        if let Ok(word) = word {
            return Self::of(key, &word);
        }
        let given = object
            .extract()
            .map_err(|_| PyTypeError::new_err(sentence))?;
        Ok(number(given))
    }
}

impl<W: Word> Field for Vec<W> {
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        let words: Vec<String> = object.extract()?;
        words.iter().map(|word| W::of(key, word)).collect()
    }
}

impl<F: Field> Field for Named<F> {
    fn none() -> Option<Self> {
        Some(Self::new())
    }

    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        let table = object.cast::<PyDict>().map_err(PyErr::from)?;
        let entries = table.iter().map(|(name, value)| {
            let name: String = name.extract()?;
            let field = F::read(&format!("{key}.{name}"), &value)?;
            Ok((name, field))
        });
        entries.collect()
    }
}

impl Field for FigureGoalSpec {
    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        let table = object.cast::<PyDict>().map_err(PyErr::from)?;
        // The keywords that are taken are removed from the copy.
        let call = Call::new("goal", Some(table.copy()?));
        let mut goal = Self::default();
        fill!(call, goal, "": figure, title, minimum, maximum, between, scale);
        call.end()?;
        if goal.figure.is_empty() {
            return Err(PyTypeError::new_err(format!("{key} needs a figure")).into());
        }
        Ok(goal)
    }
}

impl<F: Field> Field for Option<F> {
    fn none() -> Option<Self> {
        Some(None)
    }

    fn read(key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        F::read(key, object).map(Some)
    }
}

/// The value of a keyword; that it is this one's is noted on an error as `PyO3` does.
pub(crate) fn read<F: Field>(keyword: &str, key: &str, object: &Bound<'_, PyAny>) -> Answer<F> {
    if object.is_none()
        && let Some(none) = F::none()
    {
        return Ok(none);
    }
    F::read(key, object).map_err(|error| noted(object.py(), error.into(), keyword).into())
}

fn noted(py: Python<'_>, error: PyErr, keyword: &str) -> PyErr {
    if !error.is_instance_of::<class::DesignError>(py) {
        let note = format!("while processing '{keyword}'");
        // Without it the error is as good.
        let _ = error.value(py).call_method1("add_note", (note,));
    }
    error
}

/// Keywords of a call of something, each taken once.
#[derive(Debug)]
pub(crate) struct Call<'py> {
    of: &'static str,
    keywords: Option<Bound<'py, PyDict>>,
}

impl<'py> Call<'py> {
    pub(crate) fn new(of: &'static str, keywords: Option<Bound<'py, PyDict>>) -> Self {
        Self { of, keywords }
    }

    /// The value of a keyword, if it is given.
    pub(crate) fn take<F: Field>(&self, keyword: &str, key: &str) -> Answer<Option<F>> {
        let Some(keywords) = &self.keywords else {
            return Ok(None);
        };
        let Some(object) = keywords.get_item(keyword)? else {
            return Ok(None);
        };
        keywords.del_item(keyword)?;
        read(keyword, key, &object).map(Some)
    }

    /// The value of a keyword that may also be None.
    pub(crate) fn optional<F: Field>(&self, keyword: &str, key: &str) -> Answer<Option<F>> {
        Ok(self.take::<Option<F>>(keyword, key)?.flatten())
    }

    /// An error if a keyword is left.
    pub(crate) fn end(self) -> PyResult<()> {
        let left = self.keywords.iter().flat_map(|left| left.keys()).next();
        left.map_or(Ok(()), |keyword| {
            let of = self.of;
            let sentence = format!("{of}() got an unexpected keyword argument '{keyword}'");
            Err(PyTypeError::new_err(sentence))
        })
    }
}

/// A table of fields that are known, and of those from keywords: zero, empty or none by default.
macro_rules! build {
    ($of:expr, $keywords:expr, $($table:ident)::+ { $($known:ident),* }, $place:literal: $($field:ident),*) => {{
        let call = $crate::keywords::Call::new($of, $keywords);
        let table = $($table)::+ {
            $($known,)*
            $($field: call.take(stringify!($field), concat!($place, stringify!($field)))?.unwrap_or_default(),)*
        };
        call.end()?;
        table
    }};
}

pub(crate) use {build, fill};
