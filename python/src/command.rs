use std::ffi::OsString;
use std::panic::catch_unwind;

use pyo3::prelude::{Python, pyfunction};

/// Exit status of a program that panics.
const PANICKED: u8 = 101;

/// Run the command line with its arguments and give its exit status.
#[pyfunction]
pub(crate) fn _run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| catch_unwind(|| centrode::cli::run(arguments)).unwrap_or(PANICKED))
}
