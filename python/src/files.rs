//! Files in the requested formats, in memory or on disk.

use std::path::PathBuf;

use centrode::family::PartName;
use centrode_export::Options;
use centrode_formats::{Bundle, Format, write_file};
use centrode_geometry::Tolerance;
use pyo3::prelude::{Bound, PyResult, Python, pyfunction};
use pyo3::types::{PyBytes, PyDict, PyDictMethods};

use crate::error::{Answer, Raised};
use crate::wait::wait;
use crate::word::Word;

/// Formats by their names, all that are known if none are named.
pub(crate) fn formats(names: Option<Vec<String>>, known: &[Format]) -> Answer<Vec<Format>> {
    let Some(names) = names else {
        return Ok(known.to_vec());
    };
    let format = |name: &String| {
        name.parse().map_err(|_| {
            let known: Vec<&str> = known.iter().map(|format| format.name()).collect();
            Raised::word("formats", name, &known)
        })
    };
    names.iter().map(format).collect()
}

/// Parts by their names, if they are parts of the family; one that lists none names them after its design.
pub(crate) fn parts(names: Option<Vec<String>>, known: &[PartName]) -> Answer<Option<Vec<String>>> {
    let known: Vec<&str> = known.iter().map(|part| part.name).collect();
    if known.is_empty() {
        return Ok(names);
    }
    let mut requested = names.iter().flatten();
    match requested.find(|word| !known.contains(&word.as_str())) {
        Some(word) => Err(Raised::word("parts", word, &known)),
        None => Ok(names),
    }
}

/// How files are written.
pub(crate) fn options(
    tolerance: Tolerance,
    dxf_version: &str,
    dxf_curves: &str,
) -> Answer<Options> {
    let mut options = Options::new(tolerance);
    options.dxf_version = Word::of("dxf_version", dxf_version)?;
    options.dxf_curves = Word::of("dxf_curves", dxf_curves)?;
    Ok(options)
}

/// The files, name to contents.
pub(crate) fn contents<'py>(py: Python<'py>, bundle: &Bundle) -> PyResult<Bound<'py, PyDict>> {
    let files = PyDict::new(py);
    for (name, bytes) in bundle.files() {
        files.set_item(name, PyBytes::new(py, bytes))?;
    }
    Ok(files)
}

/// Exports the files into a directory; gives their paths.
pub(crate) fn written(
    py: Python<'_>,
    bundle: Bundle,
    directory: PathBuf,
    force: bool,
) -> Answer<Vec<PathBuf>> {
    Ok(wait(py, move || bundle.export_to(&directory, force))??)
}

/// Writes one file whole or not at all; gives its path.
#[pyfunction]
pub(crate) fn _write(py: Python<'_>, path: PathBuf, contents: Vec<u8>) -> Answer<PathBuf> {
    let to = path.clone();
    wait(py, move || write_file(&to, contents))??;
    Ok(path)
}
