use centrode_mechanism::gear::design as spec;
use pyo3::prelude::{Bound, PyDictMethods, PyRef, PyResult, Python, pyclass, pymethods};
use pyo3::types::{PyDict, PyTuple};

use crate::error::of_spec;

/// Body of a gear: all but its teeth.
///
/// Args:
///     width: Face width, mm.
///     bore: Diameter of the bore, mm; 0 for none.
///     keyway: Keyway in the bore.
///     density: kg/m^3.
///     material: For the drawing.
///     bore_fit: Tolerance class of the bore, ISO 286, for the drawing.
///     keyway_fit: Tolerance class of the keyway's width, ISO 286, for the drawing.
///     heat_treatment: For the drawing.
///     accuracy: Accuracy class of the teeth, for the drawing.
///
/// >>> import centrode as ct
/// >>> ct.Body(bore=12, keyway=ct.Keyway(width=4, depth=1.8)).keyway.depth
/// 1.8
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug, PartialEq)]
pub(crate) struct Body(pub(crate) spec::BodySpec);

/// A keyway in the bore, along the body's x axis; its depth is measured from the bore's circle.
///
/// >>> import centrode as ct
/// >>> ct.Keyway(width=4, depth=1.8)
/// Keyway(width=4.0, depth=1.8)
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug, PartialEq)]
pub(crate) struct Keyway(spec::Keyway);

#[pymethods]
impl Keyway {
    #[new]
    #[pyo3(signature = (*, width, depth))]
    fn new(width: f64, depth: f64) -> Self {
        Self(spec::Keyway { width, depth })
    }

    /// Width, mm.
    #[getter]
    fn width(&self) -> f64 {
        self.0.width
    }

    /// Depth below the bore's circle, mm.
    #[getter]
    fn depth(&self) -> f64 {
        self.0.depth
    }

    fn __repr__(&self) -> String {
        let spec::Keyway { width, depth } = self.0;
        format!("Keyway(width={width:?}, depth={depth:?})")
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("width", self.0.width)?;
        keywords.set_item("depth", self.0.depth)?;
        Ok((PyTuple::empty(py), keywords))
    }
}

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (*, width=None, bore=None, keyway=None, density=None, material=None, bore_fit=None, keyway_fit=None, heat_treatment="", accuracy="", keyway_angle=0.0))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        width: Option<f64>,
        bore: Option<f64>,
        keyway: Option<PyRef<'_, Keyway>>,
        density: Option<f64>,
        material: Option<String>,
        bore_fit: Option<String>,
        keyway_fit: Option<String>,
        heat_treatment: &str,
        accuracy: &str,
        keyway_angle: f64,
    ) -> PyResult<Self> {
        let usual = spec::BodySpec::default();
        let body = spec::BodySpec {
            width: width.unwrap_or(usual.width),
            bore: bore.unwrap_or(usual.bore),
            keyway: keyway.map(|k| k.0),
            density: density.unwrap_or(usual.density),
            material: material.unwrap_or(usual.material),
            bore_fit: bore_fit.unwrap_or(usual.bore_fit),
            keyway_fit: keyway_fit.unwrap_or(usual.keyway_fit),
            heat_treatment: heat_treatment.into(),
            accuracy: accuracy.into(),
            keyway_angle,
        };
        body.validate().map_err(|e| of_spec(&e))?;
        Ok(Self(body))
    }

    /// Face width, mm.
    #[getter]
    fn width(&self) -> f64 {
        self.0.width
    }

    /// Diameter of the bore, mm; 0 for none.
    #[getter]
    fn bore(&self) -> f64 {
        self.0.bore
    }

    /// Keyway in the bore.
    #[getter]
    fn keyway(&self) -> Option<Keyway> {
        self.0.keyway.map(Keyway)
    }

    /// Direction of the keyway from the body's x axis, rad.
    #[getter]
    fn keyway_angle(&self) -> f64 {
        self.0.keyway_angle
    }

    /// Density, kg/m^3.
    #[getter]
    fn density(&self) -> f64 {
        self.0.density
    }

    /// Material, for the drawing.
    #[getter]
    fn material(&self) -> &str {
        &self.0.material
    }

    /// Tolerance class of the bore, for the drawing.
    #[getter]
    fn bore_fit(&self) -> &str {
        &self.0.bore_fit
    }

    /// Tolerance class of the keyway's width, for the drawing.
    #[getter]
    fn keyway_fit(&self) -> &str {
        &self.0.keyway_fit
    }

    /// Heat treatment, for the drawing.
    #[getter]
    fn heat_treatment(&self) -> &str {
        &self.0.heat_treatment
    }

    /// Accuracy class of the teeth, for the drawing.
    #[getter]
    fn accuracy(&self) -> &str {
        &self.0.accuracy
    }

    fn __repr__(&self) -> String {
        let spec::BodySpec {
            width,
            bore,
            density,
            material,
            bore_fit,
            keyway_fit,
            heat_treatment,
            accuracy,
            keyway_angle,
            ..
        } = &self.0;
        let keyway = self
            .keyway()
            .map_or_else(|| "None".into(), |k| k.__repr__());
        format!(
            "Body(width={width:?}, bore={bore:?}, keyway={keyway}, density={density:?}, material={material:?}, bore_fit={bore_fit:?}, keyway_fit={keyway_fit:?}, heat_treatment={heat_treatment:?}, accuracy={accuracy:?}, keyway_angle={keyway_angle:?})"
        )
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("width", self.0.width)?;
        keywords.set_item("bore", self.0.bore)?;
        keywords.set_item("keyway", self.keyway())?;
        keywords.set_item("density", self.0.density)?;
        keywords.set_item("material", &self.0.material)?;
        keywords.set_item("bore_fit", &self.0.bore_fit)?;
        keywords.set_item("keyway_fit", &self.0.keyway_fit)?;
        keywords.set_item("heat_treatment", &self.0.heat_treatment)?;
        keywords.set_item("accuracy", &self.0.accuracy)?;
        keywords.set_item("keyway_angle", self.0.keyway_angle)?;
        Ok((PyTuple::empty(py), keywords))
    }
}
