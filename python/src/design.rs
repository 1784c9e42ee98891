use std::path::PathBuf;
use std::sync::Arc;

use centrode_mechanism::design::{Design, DesignFile};
use centrode_mechanism::mechanism::Mechanism;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyModule, PyResult, Python, pyfunction};

use crate::error::{not_in_python, not_of_family, of_design, unknown_word};
use crate::feeder::Feeder;
use crate::gear_pair::GearPair;
use crate::moving_box::MovingBox;
use crate::spiral_shaft::SpiralShaft;
use crate::three_arm::ThreeArm;
use crate::wait::wait;

/// A design file is read no farther than this, bytes.
pub(crate) const LARGEST: usize = DesignFile::LARGEST + 1;

/// A mechanism and the design it was made from.
pub(crate) enum Loaded {
    /// A gear pair.
    GearPair(GearPair),
    /// A three-arm mechanism.
    ThreeArm(ThreeArm),
    /// A spiral shaft.
    SpiralShaft(SpiralShaft),
    /// A moving box.
    MovingBox(MovingBox),
    /// A feeder.
    Feeder(Feeder),
}

impl Loaded {
    /// The mechanism of a design file.
    pub(crate) fn read(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        let file = DesignFile::read(bytes).map_err(|e| of_design(&e))?;
        let design = file.design().clone();
        let mechanism = wait(py, move || file.mechanism())?.map_err(|e| of_design(&e))?;
        Ok(match (design, mechanism) {
            (Design::GearPair(design), Mechanism::GearPair(pair)) => Self::GearPair(GearPair {
                design: Arc::new(*design),
                pair: Arc::from(pair),
            }),
            (_, Mechanism::ThreeArm(mechanism)) => Self::ThreeArm(ThreeArm(Arc::from(mechanism))),
            (_, Mechanism::SpiralShaft(shaft)) => Self::SpiralShaft(SpiralShaft {
                shaft: Arc::from(shaft),
            }),
            (_, Mechanism::MovingBox(machine)) => Self::MovingBox(MovingBox {
                machine: Arc::from(machine),
            }),
            (_, Mechanism::Feeder(feeder)) => Self::Feeder(Feeder {
                feeder: Arc::from(feeder),
            }),
            (_, other) => return Err(not_in_python(other.family())),
        })
    }

    pub(crate) fn gear_pair(self) -> PyResult<GearPair> {
        match self {
            Self::GearPair(pair) => Ok(pair),
            _ => Err(not_of_family("gear-pair")),
        }
    }

    pub(crate) fn three_arm(self) -> PyResult<ThreeArm> {
        match self {
            Self::ThreeArm(mechanism) => Ok(mechanism),
            _ => Err(not_of_family("three-arm")),
        }
    }

    pub(crate) fn feeder(self) -> PyResult<Feeder> {
        match self {
            Self::Feeder(feeder) => Ok(feeder),
            _ => Err(not_of_family("feeder")),
        }
    }

    pub(crate) fn spiral_shaft(self) -> PyResult<SpiralShaft> {
        match self {
            Self::SpiralShaft(shaft) => Ok(shaft),
            _ => Err(not_of_family("spiral-shaft")),
        }
    }

    pub(crate) fn moving_box(self) -> PyResult<MovingBox> {
        match self {
            Self::MovingBox(machine) => Ok(machine),
            _ => Err(not_of_family("moving-box")),
        }
    }
}

/// The mechanism of a design file's bytes.
#[pyfunction]
pub(crate) fn _load<'py>(py: Python<'py>, contents: &[u8]) -> PyResult<Bound<'py, PyAny>> {
    match Loaded::read(py, contents)? {
        Loaded::GearPair(pair) => pair.into_bound_py_any(py),
        Loaded::ThreeArm(mechanism) => mechanism.into_bound_py_any(py),
        Loaded::SpiralShaft(shaft) => shaft.into_bound_py_any(py),
        Loaded::MovingBox(machine) => machine.into_bound_py_any(py),
        Loaded::Feeder(feeder) => feeder.into_bound_py_any(py),
    }
}

/// What the Python part of the package loads from a path: it names the path in its errors.
pub(crate) fn path_loaded(py: Python<'_>, path: PathBuf) -> PyResult<Loaded> {
    let load = PyModule::import(py, "centrode._design")?.getattr("load")?;
    let loaded = load.call1((path,))?;
    if let Ok(pair) = loaded.cast::<GearPair>() {
        let GearPair { design, pair } = pair.get();
        return Ok(Loaded::GearPair(GearPair {
            design: Arc::clone(design),
            pair: Arc::clone(pair),
        }));
    }
    if let Ok(shaft) = loaded.cast::<SpiralShaft>() {
        let shaft = Arc::clone(&shaft.get().shaft);
        return Ok(Loaded::SpiralShaft(SpiralShaft { shaft }));
    }
    if let Ok(machine) = loaded.cast::<MovingBox>() {
        let machine = Arc::clone(&machine.get().machine);
        return Ok(Loaded::MovingBox(MovingBox { machine }));
    }
    if let Ok(feeder) = loaded.cast::<Feeder>() {
        let feeder = Arc::clone(&feeder.get().feeder);
        return Ok(Loaded::Feeder(Feeder { feeder }));
    }
    let arms = loaded.cast::<ThreeArm>()?;
    Ok(Loaded::ThreeArm(ThreeArm(Arc::clone(&arms.get().0))))
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

/// The JSON schema of the design files of a family, or of all, as text.
#[pyfunction]
#[pyo3(signature = (family=None))]
pub(crate) fn _schema(family: Option<&str>) -> PyResult<String> {
    let Some(family) = family else {
        return Ok(Design::json_schema().to_string());
    };
    let schema = Design::json_schema_of(family);
    let schema = schema.ok_or_else(|| unknown_word("family", family, &Design::FAMILIES))?;
    Ok(schema.to_string())
}
