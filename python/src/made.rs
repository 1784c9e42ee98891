use centrode_spec::Design;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyModule, PyResult, Python};
use pyo3::types::{PyBytes, PyTuple};

use crate::error::Answer;
use crate::record::Keywords;

/// Call that makes an object, or its equal: what it is pickled and copied by.
#[derive(Debug)]
pub(crate) struct Made(Py<PyAny>);

/// Value of `__reduce__`: a callable, and its arguments.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

impl Made {
    /// Makes it by calling something that can itself be pickled.
    pub(crate) fn call<'py>(
        call: Bound<'py, PyAny>,
        mut arguments: Vec<Bound<'py, PyAny>>,
        keywords: Keywords<'py>,
    ) -> PyResult<Self> {
        let py = call.py();
        arguments.insert(0, call);
        let all = PyTuple::new(py, arguments)?;
        let partial = PyModule::import(py, "functools")?.getattr("partial")?;
        Ok(Self(partial.call(all, Some(&keywords.0))?.unbind()))
    }

    /// Makes it as an attribute of another object.
    pub(crate) fn part_of<'py>(whole: Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        let py = whole.py();
        let getattr = PyModule::import(py, "builtins")?.getattr("getattr")?;
        let name = name.into_bound_py_any(py)?;
        Self::call(getattr, vec![whole, name], Keywords::new(py))
    }

    pub(crate) fn reduced<'py>(&self, py: Python<'py>) -> Reduced<'py> {
        (self.0.bind(py).clone(), PyTuple::empty(py))
    }
}

/// A function or class of the native module.
pub(crate) fn native<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    PyModule::import(py, "centrode._centrode")?.getattr(name)
}

/// Reduces to a call of the native module with keywords.
pub(crate) fn by<'py>(name: &str, keywords: Keywords<'py>) -> PyResult<Reduced<'py>> {
    let py = keywords.0.py();
    Ok(Made::call(native(py, name)?, Vec::new(), keywords)?.reduced(py))
}

/// Reduces to the file of a design.
pub(crate) fn by_design<'py>(py: Python<'py>, design: &dyn Design) -> Answer<Reduced<'py>> {
    let text = design.to_toml()?;
    let bytes = PyBytes::new(py, text.as_bytes());
    Ok((native(py, "_load")?, PyTuple::new(py, [bytes])?))
}
