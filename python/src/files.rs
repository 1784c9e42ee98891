//! Files in the requested formats, in memory or on disk.

use std::path::PathBuf;

use centrode::family::PartName;
use centrode_export::Options;
use centrode_formats::{Bundle, Format, Purpose, write_file};
use centrode_geometry::Tolerance;
use centrode_spec::CutSpec;
use pyo3::prelude::{Bound, FromPyObject, PyResult, Python, pyfunction};
use pyo3::types::{PyBytes, PyDict, PyDictMethods};

use crate::error::{Answer, Raised};
use crate::wait::wait;
use crate::word::Word;

/// Formats as a call names them: one by one, or by who receives them, or all.
#[derive(Debug, FromPyObject)]
pub(crate) enum Named {
    Word(String),
    Formats(Vec<String>),
}

/// Formats by their names, and the tolerance of an export that states none, mm.
pub(crate) fn formats(named: Option<Named>, known: &[Format]) -> Answer<(Vec<Format>, f64)> {
    let usual = Tolerance::MICROMETRE.mm();
    let among = |formats: &[Format]| {
        let formats = formats.iter().copied();
        formats.filter(|format| known.contains(format)).collect()
    };
    let names = match named {
        None => return Ok((among(&Format::USUAL), usual)),
        Some(Named::Word(word)) if word == "all" => return Ok((known.to_vec(), usual)),
        Some(Named::Word(word)) => {
            let purpose: Purpose = Word::of("formats", &word)?;
            return Ok((among(purpose.formats()), purpose.tolerance().mm()));
        }
        Some(Named::Formats(names)) => names,
    };
    let format = |name: &String| {
        name.parse().map_err(|_| {
            let known: Vec<&str> = known.iter().map(|format| format.name()).collect();
            Raised::word("formats", name, &known)
        })
    };
    let formats: Answer<Vec<Format>> = names.iter().map(format).collect();
    Ok((formats?, usual))
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
    [dxf_version, dxf_curves, layers]: [&str; 3],
    kerf: Option<f64>,
) -> Answer<Options> {
    let mut options = Options::new(tolerance);
    options.dxf_version = Word::of("dxf_version", dxf_version)?;
    options.dxf_curves = Word::of("dxf_curves", dxf_curves)?;
    options.layers = Word::of("layers", layers)?;
    CutSpec {
        kerf: kerf.unwrap_or(0.0),
    }
    .validate()?;
    options.kerf = kerf;
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
