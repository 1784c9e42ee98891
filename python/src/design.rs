use std::sync::Arc;

use centrode_mechanism::design::{Design, DesignFile};
use pyo3::prelude::{PyResult, Python, pyfunction};

use crate::error::{not_a_gear_pair, of_design, unknown_word};
use crate::gear_pair::GearPair;
use crate::wait::wait;

/// A design file is read no farther than this, bytes.
pub(crate) const LARGEST: usize = DesignFile::LARGEST + 1;

/// The gear pair of a design file.
pub(crate) fn pair_of_text(py: Python<'_>, bytes: &[u8]) -> PyResult<GearPair> {
    let file = DesignFile::read(bytes).map_err(|e| of_design(&e))?;
    let Design::GearPair(design) = file.design().clone() else {
        return Err(not_a_gear_pair());
    };
    let pair = wait(py, move || file.gear_pair())?.map_err(|e| of_design(&e))?;
    Ok(GearPair {
        design: Arc::new(design),
        pair: Arc::new(pair),
    })
}

/// The gear pair of a design file's bytes.
#[pyfunction]
pub(crate) fn _load(py: Python<'_>, contents: &[u8]) -> PyResult<GearPair> {
    pair_of_text(py, contents)
}

/// A commented design file to start from, itself a good design.
///
/// >>> import centrode as ct
/// >>> ct.template("gear-pair").splitlines()[0]
/// '# A non-circular gear pair. Lengths in millimetres, angles in degrees.'
#[pyfunction]
#[pyo3(signature = (family="gear-pair"))]
pub(crate) fn template(family: &str) -> PyResult<&'static str> {
    Design::template(family).ok_or_else(|| unknown_word("family", family, &Design::FAMILIES))
}

/// The JSON schema of the design file, as text.
#[pyfunction]
pub(crate) fn _schema() -> String {
    Design::json_schema().to_string()
}
