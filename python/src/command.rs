use std::ffi::OsString;

use pyo3::prelude::{Python, pyfunction};

/// Run the command line with its arguments and give its exit status.
#[pyfunction]
pub(crate) fn _run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| centrode::cli::run(arguments))
}
