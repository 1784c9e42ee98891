use centrode_gear::design as spec;
use centrode_spec::SpecError;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyResult, Python};

use crate::error::Answer;
use crate::keywords::Field;
use crate::table::table;

table! {
    /// A basic rack; default: ISO 53, profile A. Lengths are in modules.
    ///
    /// Args:
    ///     pressure_angle: Pressure angle, rad.
    ///     addendum_coefficient: Height of the gear's tooth above the pitch curve.
    ///     dedendum_coefficient: Depth of the gear's tooth below the pitch curve, to which the tool cuts.
    ///     tip_radius_coefficient: Radius of the tool's tip, which generates the fillet.
    ///
    /// >>> import math, centrode as ct
    /// >>> ct.Rack().dedendum_coefficient
    /// 1.25
    /// >>> round(math.degrees(ct.Rack().pressure_angle), 12)
    /// 20.0
    "centrode" Rack(spec::Rack) from spec::Rack::default(), keys "tool.", rules |rack| valid(spec::ToolSpec::Rack(rack.clone()));
    needed {}
    usual {
        /// Pressure angle, rad.
        pressure_angle: f64,
        /// Height of the gear's tooth above the pitch curve, in modules.
        addendum_coefficient: f64,
        /// Depth of the gear's tooth below the pitch curve, in modules.
        dedendum_coefficient: f64,
        /// Radius of the tool's tip, in modules.
        tip_radius_coefficient: f64,
    }
}

table! {
    /// A pinion-type cutter with involute teeth. Lengths are in modules.
    ///
    /// Args:
    ///     tooth_count: Teeth of the cutter.
    ///     pressure_angle: Pressure angle, rad.
    ///     addendum_coefficient: Height of the gear's tooth above the pitch curve.
    ///     dedendum_coefficient: Depth of the gear's tooth below the pitch curve: the addendum of the cutter.
    ///     tip_radius_coefficient: Radius of the cutter's tip corner, which generates the fillet.
    ///
    /// >>> import centrode as ct
    /// >>> ct.Shaper(tooth_count=20).tip_radius_coefficient
    /// 0.2
    "centrode" Shaper(spec::Shaper) from spec::Shaper::default(), keys "tool.", rules |shaper| valid(spec::ToolSpec::Shaper(shaper.clone()));
    needed {
        /// Teeth of the cutter.
        tooth_count: u32,
    }
    usual {
        /// Pressure angle, rad.
        pressure_angle: f64,
        /// Height of the gear's tooth above the pitch curve, in modules.
        addendum_coefficient: f64,
        /// Depth of the gear's tooth below the pitch curve, in modules.
        dedendum_coefficient: f64,
        /// Radius of the cutter's tip corner, in modules.
        tip_radius_coefficient: f64,
    }
}

impl Field for spec::ToolSpec {
    fn none() -> Option<Self> {
        Some(Self::default())
    }

    fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        if let Ok(Rack(rack)) = object.extract() {
            return Ok(Self::Rack(rack));
        }
        let shaper = object.extract().map(|Shaper(shaper)| Self::Shaper(shaper));
        Ok(shaper.map_err(|_| PyTypeError::new_err("tool must be a Rack or a Shaper"))?)
    }
}

fn valid(tool: spec::ToolSpec) -> Result<(), SpecError> {
    tool.validate().map_err(|mut error| {
        error.key = format!("tool.{}", error.key);
        error
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
