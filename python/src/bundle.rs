use std::path::PathBuf;
use std::sync::Arc;

use centrode::family::Mechanism;
use centrode_export::{Bundle, write_file};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::error;
use crate::format;
use crate::wait::wait;

/// The files of a mechanism, all parts of it.
pub(crate) fn of(
    py: Python<'_>,
    mechanism: &Arc<impl Mechanism>,
    formats: Option<Vec<String>>,
    tolerance: f64,
    dxf_version: &str,
    dxf_curves: &str,
) -> PyResult<Bundle> {
    let tolerance = error::plain_tolerance(tolerance)?;
    let (formats, options) = format::within(tolerance, formats, dxf_version, dxf_curves)?;
    let mechanism = Arc::clone(mechanism);
    let made = wait(py, move || mechanism.files(&formats, &options))?;
    made.map_err(|e| error::of_files(&e))
}

/// The files, name to contents.
pub(crate) fn contents<'py>(py: Python<'py>, bundle: &Bundle) -> PyResult<Bound<'py, PyDict>> {
    let files = PyDict::new(py);
    for (name, bytes) in bundle.files() {
        files.set_item(name, PyBytes::new(py, bytes))?;
    }
    Ok(files)
}

/// Writes the files into a directory; gives their paths.
pub(crate) fn written(
    py: Python<'_>,
    bundle: Bundle,
    directory: PathBuf,
) -> PyResult<Vec<PathBuf>> {
    wait(py, move || bundle.write_to(&directory))?.map_err(|e| error::of_bundle(py, &e))
}

/// Writes one file whole or not at all; gives its path.
pub(crate) fn written_file(py: Python<'_>, path: PathBuf, bytes: Vec<u8>) -> PyResult<PathBuf> {
    let to = path.clone();
    wait(py, move || write_file(&to, bytes))?.map_err(|e| error::of_bundle(py, &e))?;
    Ok(path)
}
