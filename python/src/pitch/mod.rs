pub(crate) mod kinds;

use centrode_gear::design::GearPairDesign;
use centrode_gear::pitch as spec;
use centrode_geometry::Jet;
use centrode_spec::{Design as _, DesignSpec as _};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyModule, Python, pyclass, pyfunction, pymethods};

use crate::array::{Numbers, Rows};
use crate::error::{Answer, finite};

/// A pitch curve around the shaft axis at the origin, proven to go round it exactly once.
///
/// Made by the functions of ``centrode.pitch``.
///
/// >>> import centrode as ct
/// >>> ct.pitch.circle(module=2, tooth_count=20)
/// Pitch(circle, R = 20 mm: module 2.0 mm, 20 teeth)
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Pitch {
    pub(crate) spec: spec::PitchSpec,
    resolved: spec::Pitch,
}

impl PartialEq for Pitch {
    fn eq(&self, other: &Self) -> bool {
        self.spec == other.spec
    }
}

impl Pitch {
    /// The exact curve of a description.
    pub(crate) fn resolve(spec: spec::PitchSpec) -> Answer<Self> {
        let resolved = spec.resolve()?;
        Ok(Self { spec, resolved })
    }

    fn along(&self, parameters: Numbers) -> Answer<Vec<Jet>> {
        let at = |t| Ok(self.resolved.curve.at(finite("every parameter", t)?));
        parameters.into_vec().into_iter().map(at).collect()
    }
}

#[pymethods]
impl Pitch {
    /// Definition of the curve in one line.
    #[getter]
    fn definition(&self) -> &str {
        &self.resolved.definition
    }

    /// Module, mm, if the tooth count is given.
    #[getter]
    fn module(&self) -> Option<f64> {
        self.resolved.module
    }

    /// Number of teeth, if given.
    #[getter]
    fn tooth_count(&self) -> Option<u32> {
        self.resolved.tooth_count
    }

    /// Mean ratio (turns of driver, turns of driven gear) implied by the definition of the curve; None if it implies
    /// none.
    #[getter]
    fn implied_ratio(&self) -> Option<(u32, u32)> {
        self.resolved.implied_ratio
    }

    /// Period of the parameter of the curve.
    #[getter]
    fn period(&self) -> f64 {
        self.resolved.curve.period()
    }

    /// Points of the curve at the given parameters, (N, 2), mm.
    ///
    /// >>> import centrode as ct
    /// >>> ct.pitch.circle(radius=10).points([0.0])
    /// array([[10.,  0.]])
    fn points(&self, parameters: Numbers) -> Answer<Rows<2>> {
        let along = self.along(parameters)?;
        let points = along.iter().map(|jet| jet.point.coords.into());
        Ok(Rows(points.collect()))
    }

    /// Curvature at the given parameters, (N,), 1/mm: positive where the curve is convex.
    ///
    /// >>> import centrode as ct
    /// >>> ct.pitch.circle(radius=10).curvature([0.0])
    /// array([0.1])
    fn curvature<'py>(
        &self,
        py: Python<'py>,
        parameters: Numbers,
    ) -> Answer<Bound<'py, PyArray1<f64>>> {
        let along = self.along(parameters)?;
        let curvature: Vec<f64> = along.iter().map(Jet::curvature).collect();
        Ok(curvature.into_pyarray(py))
    }

    fn __repr__(&self) -> String {
        let mut text = self.resolved.definition.clone();
        if let (Some(module), Some(z)) = (self.resolved.module, self.resolved.tooth_count) {
            text = format!("{text}: module {module:?} mm, {z} teeth");
        }
        format!("Pitch({text})")
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Answer<(Bound<'py, PyAny>, (String,))> {
        let text = GearPairDesign::new(self.spec.clone()).to_toml()?;
        let module = PyModule::import(py, "centrode._centrode")?;
        Ok((module.getattr("_pitch_from_toml")?, (text,)))
    }
}

/// The pitch curve of a design file: how a pitch curve is unpickled.
#[pyfunction]
pub(crate) fn _pitch_from_toml(text: &str) -> Answer<Pitch> {
    let design = GearPairDesign::from_toml(text)?;
    Pitch::resolve(design.pitch)
}
