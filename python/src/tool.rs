use centrode_mechanism::gear::design as spec;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{
    Borrowed, Bound, FromPyObject, Py, PyAny, PyDictMethods, PyErr, PyRef, PyResult, Python,
    pyclass, pymethods,
};
use pyo3::types::{PyDict, PyTuple};

use crate::count::Count;
use crate::error::of_spec;

/// A basic rack; the defaults are ISO 53, profile A. Lengths are multiples of the module.
///
/// Args:
///     pressure_angle: rad.
///     addendum_coefficient: Height of the gear's tooth above the pitch curve.
///     dedendum_coefficient: Depth of the gear's tooth below the pitch curve; the tool cuts this far.
///     tip_radius_coefficient: Radius of the tool's tip, which leaves the fillet.
///     profile_shift_coefficient: Distance the tool is held out of the driver's blank and into the driven's.
///
/// >>> import math, centrode as ct
/// >>> ct.Rack().dedendum_coefficient
/// 1.25
/// >>> round(math.degrees(ct.Rack().pressure_angle), 12)
/// 20.0
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug, PartialEq)]
pub(crate) struct Rack(spec::Rack);

/// A pinion-type cutter with involute teeth. Lengths are multiples of the module.
///
/// Args:
///     tooth_count: Teeth of the cutter.
///     pressure_angle: rad.
///     addendum_coefficient: Height of the gear's tooth above the pitch curve.
///     dedendum_coefficient: Depth of the gear's tooth below the pitch curve; the cutter's own addendum.
///     tip_radius_coefficient: Radius of the cutter's tip corner, which leaves the fillet.
///     profile_shift_coefficient: Distance the cutter is held out of the driver's blank and into the driven's.
///
/// >>> import centrode as ct
/// >>> ct.Shaper(tooth_count=20).tip_radius_coefficient
/// 0.2
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug, PartialEq)]
pub(crate) struct Shaper(spec::Shaper);

/// Either tool.
#[derive(Debug)]
pub(crate) enum Tool<'py> {
    /// A rack.
    Rack(PyRef<'py, Rack>),
    /// A shaper.
    Shaper(PyRef<'py, Shaper>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Tool<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(rack) = object.extract() {
            return Ok(Self::Rack(rack));
        }
        let shaper = object
            .extract()
            .map_err(|_| PyTypeError::new_err("tool must be a Rack or a Shaper"))?;
        Ok(Self::Shaper(shaper))
    }
}

impl Tool<'_> {
    /// The tool as a design has it.
    pub(crate) fn spec(&self) -> spec::ToolSpec {
        match self {
            Self::Rack(rack) => spec::ToolSpec::Rack(rack.0.clone()),
            Self::Shaper(shaper) => spec::ToolSpec::Shaper(shaper.0.clone()),
        }
    }
}

fn valid(tool: &spec::ToolSpec) -> PyResult<()> {
    tool.validate().map_err(|mut error| {
        error.key = format!("tool.{}", error.key);
        of_spec(&error)
    })
}

/// The tool of a design.
pub(crate) fn object(py: Python<'_>, tool: &spec::ToolSpec) -> PyResult<Py<PyAny>> {
    match tool {
        spec::ToolSpec::Rack(rack) => Rack(rack.clone()).into_py_any(py),
        spec::ToolSpec::Shaper(shaper) => Shaper(shaper.clone()).into_py_any(py),
        _ => Ok(py.None()),
    }
}

#[pymethods]
impl Rack {
    #[new]
    #[pyo3(signature = (*, pressure_angle=None, addendum_coefficient=None, dedendum_coefficient=None, tip_radius_coefficient=None, profile_shift_coefficient=None))]
    fn new(
        pressure_angle: Option<f64>,
        addendum_coefficient: Option<f64>,
        dedendum_coefficient: Option<f64>,
        tip_radius_coefficient: Option<f64>,
        profile_shift_coefficient: Option<f64>,
    ) -> PyResult<Self> {
        let iso = spec::Rack::default();
        let rack = spec::Rack {
            pressure_angle: pressure_angle.unwrap_or(iso.pressure_angle),
            addendum_coefficient: addendum_coefficient.unwrap_or(iso.addendum_coefficient),
            dedendum_coefficient: dedendum_coefficient.unwrap_or(iso.dedendum_coefficient),
            tip_radius_coefficient: tip_radius_coefficient.unwrap_or(iso.tip_radius_coefficient),
            profile_shift_coefficient: profile_shift_coefficient
                .unwrap_or(iso.profile_shift_coefficient),
        };
        valid(&spec::ToolSpec::Rack(rack.clone()))?;
        Ok(Self(rack))
    }

    /// Pressure angle, rad.
    #[getter]
    fn pressure_angle(&self) -> f64 {
        self.0.pressure_angle
    }

    /// Height of the gear's tooth above the pitch curve, in modules.
    #[getter]
    fn addendum_coefficient(&self) -> f64 {
        self.0.addendum_coefficient
    }

    /// Depth of the gear's tooth below the pitch curve, in modules.
    #[getter]
    fn dedendum_coefficient(&self) -> f64 {
        self.0.dedendum_coefficient
    }

    /// Radius of the tool's tip, in modules.
    #[getter]
    fn tip_radius_coefficient(&self) -> f64 {
        self.0.tip_radius_coefficient
    }

    /// Profile shift of the driver, outwards positive, in modules.
    #[getter]
    fn profile_shift_coefficient(&self) -> f64 {
        self.0.profile_shift_coefficient
    }

    fn __repr__(&self) -> String {
        format!("{:?}", self.0)
            .replace(" { ", "(")
            .replace(" }", ")")
            .replace(": ", "=")
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("pressure_angle", self.0.pressure_angle)?;
        keywords.set_item("addendum_coefficient", self.0.addendum_coefficient)?;
        keywords.set_item("dedendum_coefficient", self.0.dedendum_coefficient)?;
        keywords.set_item("tip_radius_coefficient", self.0.tip_radius_coefficient)?;
        keywords.set_item(
            "profile_shift_coefficient",
            self.0.profile_shift_coefficient,
        )?;
        Ok((PyTuple::empty(py), keywords))
    }
}

#[pymethods]
impl Shaper {
    #[new]
    #[pyo3(signature = (*, tooth_count, pressure_angle=None, addendum_coefficient=None, dedendum_coefficient=None, tip_radius_coefficient=None, profile_shift_coefficient=None))]
    fn new(
        tooth_count: Count,
        pressure_angle: Option<f64>,
        addendum_coefficient: Option<f64>,
        dedendum_coefficient: Option<f64>,
        tip_radius_coefficient: Option<f64>,
        profile_shift_coefficient: Option<f64>,
    ) -> PyResult<Self> {
        let usual = spec::Shaper::default();
        let shaper = spec::Shaper {
            tooth_count: tooth_count.of("tool.tooth_count")?,
            pressure_angle: pressure_angle.unwrap_or(usual.pressure_angle),
            addendum_coefficient: addendum_coefficient.unwrap_or(usual.addendum_coefficient),
            dedendum_coefficient: dedendum_coefficient.unwrap_or(usual.dedendum_coefficient),
            tip_radius_coefficient: tip_radius_coefficient.unwrap_or(usual.tip_radius_coefficient),
            profile_shift_coefficient: profile_shift_coefficient
                .unwrap_or(usual.profile_shift_coefficient),
        };
        valid(&spec::ToolSpec::Shaper(shaper.clone()))?;
        Ok(Self(shaper))
    }

    /// Teeth of the cutter.
    #[getter]
    fn tooth_count(&self) -> u32 {
        self.0.tooth_count
    }

    /// Pressure angle, rad.
    #[getter]
    fn pressure_angle(&self) -> f64 {
        self.0.pressure_angle
    }

    /// Height of the gear's tooth above the pitch curve, in modules.
    #[getter]
    fn addendum_coefficient(&self) -> f64 {
        self.0.addendum_coefficient
    }

    /// Depth of the gear's tooth below the pitch curve, in modules.
    #[getter]
    fn dedendum_coefficient(&self) -> f64 {
        self.0.dedendum_coefficient
    }

    /// Radius of the cutter's tip corner, in modules.
    #[getter]
    fn tip_radius_coefficient(&self) -> f64 {
        self.0.tip_radius_coefficient
    }

    /// Profile shift of the driver, outwards positive, in modules.
    #[getter]
    fn profile_shift_coefficient(&self) -> f64 {
        self.0.profile_shift_coefficient
    }

    fn __repr__(&self) -> String {
        format!("{:?}", self.0)
            .replace(" { ", "(")
            .replace(" }", ")")
            .replace(": ", "=")
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("tooth_count", self.0.tooth_count)?;
        keywords.set_item("pressure_angle", self.0.pressure_angle)?;
        keywords.set_item("addendum_coefficient", self.0.addendum_coefficient)?;
        keywords.set_item("dedendum_coefficient", self.0.dedendum_coefficient)?;
        keywords.set_item("tip_radius_coefficient", self.0.tip_radius_coefficient)?;
        keywords.set_item(
            "profile_shift_coefficient",
            self.0.profile_shift_coefficient,
        )?;
        Ok((PyTuple::empty(py), keywords))
    }
}
