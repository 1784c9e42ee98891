use centrode_mechanism::gear::design as spec;
use pyo3::FromPyObject;
use pyo3::prelude::{PyRef, pyclass, pymethods};

/// A basic rack; the defaults are ISO 53, profile A. Lengths are multiples of the module.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Rack(spec::Rack);

/// A pinion-type cutter with involute teeth. Lengths are multiples of the module.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Shaper(spec::Shaper);

/// Either tool.
#[derive(FromPyObject)]
pub(crate) enum Tool<'py> {
    /// A rack.
    Rack(PyRef<'py, Rack>),
    /// A shaper.
    Shaper(PyRef<'py, Shaper>),
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
    ) -> Self {
        let iso = spec::Rack::default();
        Self(spec::Rack {
            pressure_angle: pressure_angle.unwrap_or(iso.pressure_angle),
            addendum_coefficient: addendum_coefficient.unwrap_or(iso.addendum_coefficient),
            dedendum_coefficient: dedendum_coefficient.unwrap_or(iso.dedendum_coefficient),
            tip_radius_coefficient: tip_radius_coefficient.unwrap_or(iso.tip_radius_coefficient),
            profile_shift_coefficient: profile_shift_coefficient
                .unwrap_or(iso.profile_shift_coefficient),
        })
    }

    fn __repr__(&self) -> String {
        format!("{:?}", self.0)
    }
}

#[pymethods]
impl Shaper {
    #[new]
    #[pyo3(signature = (*, tooth_count, pressure_angle=None, addendum_coefficient=None, dedendum_coefficient=None, tip_radius_coefficient=None, profile_shift_coefficient=None))]
    fn new(
        tooth_count: u32,
        pressure_angle: Option<f64>,
        addendum_coefficient: Option<f64>,
        dedendum_coefficient: Option<f64>,
        tip_radius_coefficient: Option<f64>,
        profile_shift_coefficient: Option<f64>,
    ) -> Self {
        let usual = spec::Shaper::default();
        Self(spec::Shaper {
            tooth_count,
            pressure_angle: pressure_angle.unwrap_or(usual.pressure_angle),
            addendum_coefficient: addendum_coefficient.unwrap_or(usual.addendum_coefficient),
            dedendum_coefficient: dedendum_coefficient.unwrap_or(usual.dedendum_coefficient),
            tip_radius_coefficient: tip_radius_coefficient.unwrap_or(usual.tip_radius_coefficient),
            profile_shift_coefficient: profile_shift_coefficient
                .unwrap_or(usual.profile_shift_coefficient),
        })
    }

    fn __repr__(&self) -> String {
        format!("{:?}", self.0)
    }
}
