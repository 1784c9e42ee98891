use std::path::{Path, PathBuf};

use centrode_export::Bundle;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::error;

/// The files, name to contents.
pub(crate) fn contents<'py>(py: Python<'py>, bundle: &Bundle) -> PyResult<Bound<'py, PyDict>> {
    let files = PyDict::new(py);
    for (name, bytes) in bundle.files() {
        files.set_item(name, PyBytes::new(py, bytes))?;
    }
    Ok(files)
}

/// Writes the files into a directory; gives their paths.
pub(crate) fn written(py: Python<'_>, bundle: &Bundle, directory: &Path) -> PyResult<Vec<PathBuf>> {
    // Not left behind to run out unheard: it changes the disk.
    py.detach(|| bundle.write_to(directory))
        .map_err(|e| error::of_bundle(py, &e))
}
