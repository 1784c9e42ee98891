//! Wishes about a machine as Python gives them.

use centrode_synthesis::reverse::Wishes;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python};
use pyo3::types::{IntoPyDict, PyDict};

use crate::error::{Answer, Raised};

/// Wishes of a dict with the keys of the design file; arrays are read as lists.
pub(super) fn read(wishes: &Bound<'_, PyDict>) -> Answer<Wishes> {
    let py = wishes.py();
    let as_list = py
        .import("operator")?
        .call_method1("methodcaller", ("tolist",))?;
    let keywords = [("default", as_list)].into_py_dict(py)?;
    let text = py
        .import("json")?
        .call_method("dumps", (wishes,), Some(&keywords))?;
    let text: String = text.extract()?;
    let reader = &mut serde_json::Deserializer::from_str(&text);
    serde_path_to_error::deserialize(reader).map_err(|error| {
        let key = match error.path().to_string() {
            path if path == "." => "wishes".to_owned(),
            path => format!("wishes.{path}"),
        };
        let stated = error.inner().to_string();
        // Its position in the text means nothing to the caller.
        let stated = stated.split(" at line ").next().unwrap_or_default();
        Raised::sentence(&key, format!("{key}: {stated}"))
    })
}

/// The dict of wishes.
pub(super) fn keywords<'py>(py: Python<'py>, wishes: &Wishes) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(wishes).unwrap_or_default();
    py.import("json")?.call_method1("loads", (text,))
}
