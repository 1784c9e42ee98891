use std::path::PathBuf;
use std::sync::Arc;

use centrode::FAMILIES;
use centrode::family::{Family, Mechanism, Resolved};
use centrode_mechanism::design::DesignFile;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{
    Bound, IntoPyObject, PyAny, PyAnyMethods, PyModule, PyResult, Python, pyfunction,
};

use crate::error::{not_in_python, not_of_family, of_design, unknown_word};
use crate::feeder::Feeder;
use crate::gear_pair::GearPair;
use crate::moving_box::MovingBox;
use crate::spiral_shaft::SpiralShaft;
use crate::three_arm::ThreeArm;
use crate::wait::wait;

/// A design file is read no farther than this, bytes.
pub(crate) const LARGEST: usize = DesignFile::LARGEST + 1;

/// The class of one family's mechanisms.
pub(crate) trait Class: for<'py> IntoPyObject<'py> {
    /// A mechanism of the family.
    type Mechanism: Resolved;

    fn of(mechanism: Arc<Self::Mechanism>) -> Self;

    /// The mechanism of a design file's text, if it is of this family.
    fn read(py: Python<'_>, text: &str) -> PyResult<Self> {
        let mechanism = read(py, text.as_bytes())?.downcast().map(Self::of);
        mechanism.ok_or_else(not_of_family::<Self>)
    }

    /// Family of the class.
    fn family() -> Family {
        Family::of::<Self::Mechanism>()
    }
}

/// Makes an object of a mechanism, if that is of its family.
type Make = for<'py> fn(Python<'py>, &Arc<dyn Mechanism>) -> Option<PyResult<Bound<'py, PyAny>>>;

/// The classes of all families.
const CLASSES: [Make; 5] = [
    made::<GearPair>,
    made::<ThreeArm>,
    made::<SpiralShaft>,
    made::<MovingBox>,
    made::<Feeder>,
];

/// The object of a mechanism, if that is of the class.
pub(crate) fn made<'py, C: Class>(
    py: Python<'py>,
    mechanism: &Arc<dyn Mechanism>,
) -> Option<PyResult<Bound<'py, PyAny>>> {
    let mechanism = Arc::clone(mechanism).downcast()?;
    Some(C::of(mechanism).into_bound_py_any(py))
}

fn read(py: Python<'_>, bytes: &[u8]) -> PyResult<Arc<dyn Mechanism>> {
    let file = FAMILIES.read(bytes).map_err(|e| of_design(&e))?;
    wait(py, move || file.mechanism())?.map_err(|e| of_design(&e))
}

/// The mechanism of a design file's bytes.
#[pyfunction]
pub(crate) fn _load<'py>(py: Python<'py>, contents: &[u8]) -> PyResult<Bound<'py, PyAny>> {
    let mechanism = read(py, contents)?;
    let made = CLASSES.iter().find_map(|make| make(py, &mechanism));
    made.ok_or_else(|| not_in_python(mechanism.design().family().word))?
}

/// The object that the Python part of the package loads from a path: it names the path in its errors.
pub(crate) fn path_loaded(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyAny>> {
    let load = PyModule::import(py, "centrode._design")?.getattr("load")?;
    load.call1((path,))
}

/// A commented design file to start from, itself a good design.
///
/// >>> import centrode as ct
/// >>> ct.template("gear-pair").splitlines()[0]
/// '# A non-circular gear pair. Lengths in millimetres, angles in degrees.'
#[pyfunction]
#[pyo3(signature = (family="gear-pair"))]
pub(crate) fn template(family: &str) -> PyResult<&'static str> {
    let template = FAMILIES.template(family);
    template.ok_or_else(|| unknown_word("family", family, &FAMILIES.words()))
}

/// The JSON schema of the design files of a family, or of all, as text.
#[pyfunction]
#[pyo3(signature = (family=None))]
pub(crate) fn _schema(family: Option<&str>) -> PyResult<String> {
    let Some(word) = family else {
        return Ok(FAMILIES.json_schema().to_string());
    };
    let family = FAMILIES.named(word);
    let family = family.ok_or_else(|| unknown_word("family", word, &FAMILIES.words()))?;
    Ok(family.design.json_schema().to_string())
}
