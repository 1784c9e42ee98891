use centrode_mechanism::gear::pitch as spec;
use numpy::PyArray2;
use pyo3::FromPyObject;
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::array::{Numbers, list, points};
use crate::error::{DesignError, of_pitch};

/// A function of one angle: a formula in `phi`, or values at equal steps of it.
#[derive(FromPyObject)]
pub(crate) enum Law<'py> {
    /// A formula.
    Formula(String),
    /// Sampled values.
    Samples(Numbers<'py>),
}

impl Law<'_> {
    /// Formula and samples: one of them empty.
    fn parts(law: Option<Self>) -> (Option<String>, Vec<f64>) {
        match law {
            None => (None, Vec::new()),
            Some(Self::Formula(text)) => (Some(text), Vec::new()),
            Some(Self::Samples(values)) => (None, values.as_array().to_vec()),
        }
    }
}

/// A pitch curve, proved to go once round the shaft axis.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Pitch {
    pub(crate) spec: spec::PitchSpec,
    resolved: spec::Pitch,
}

#[pymethods]
impl Pitch {
    /// What the curve is, in one line.
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

    /// Turns of driver and driven gear the description asks for, if it does.
    #[getter]
    fn implied_ratio(&self) -> Option<(u32, u32)> {
        self.resolved.implied_ratio
    }

    /// Parameter over which the curve closes.
    #[getter]
    fn period(&self) -> f64 {
        self.resolved.curve.period()
    }

    /// Points of the curve at the given parameters, (N, 2), mm.
    fn points<'py>(
        &self,
        py: Python<'py>,
        parameters: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let at = |&t: &f64| self.resolved.curve.at(t).point;
        let along: Vec<_> = parameters.as_array().iter().map(at).collect();
        points(py, &along)
    }

    fn __repr__(&self) -> String {
        format!("Pitch({})", self.resolved.definition)
    }
}

fn resolve(spec: spec::PitchSpec) -> PyResult<Pitch> {
    let resolved = spec.resolve().map_err(|e| of_pitch(&e))?;
    Ok(Pitch { spec, resolved })
}

fn plane(word: &str) -> PyResult<spec::Plane> {
    match word {
        "polar" => Ok(spec::Plane::Polar),
        "cartesian" => Ok(spec::Plane::Cartesian),
        _ => Err(DesignError::new_err(format!(
            "plane must be \"polar\" or \"cartesian\", not \"{word}\""
        ))),
    }
}

fn interpolation(word: Option<&str>) -> PyResult<Option<spec::Interpolation>> {
    match word {
        None => Ok(None),
        Some("cubic") => Ok(Some(spec::Interpolation::Cubic)),
        Some("quintic") => Ok(Some(spec::Interpolation::Quintic)),
        Some("trigonometric") => Ok(Some(spec::Interpolation::Trigonometric)),
        Some(word) => Err(DesignError::new_err(format!(
            "interpolation must be \"cubic\", \"quintic\" or \"trigonometric\", not \"{word}\""
        ))),
    }
}

/// A circle around the shaft axis: an ordinary gear. Give `radius`, or `module` and `tooth_count`.
#[pyfunction]
#[pyo3(signature = (*, radius=None, module=None, tooth_count=None))]
pub(crate) fn circle(
    radius: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::Circle(spec::Circle {
        radius,
        module,
        tooth_count,
    }))
}

/// A circle whose shaft axis is not at its centre.
#[pyfunction]
#[pyo3(signature = (*, eccentricity, radius=None, module=None, tooth_count=None))]
pub(crate) fn eccentric_circle(
    eccentricity: f64,
    radius: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::EccentricCircle(spec::EccentricCircle {
        eccentricity,
        radius,
        module,
        tooth_count,
    }))
}

/// An ellipse turning about one of its foci, its far end at the polar angle zero.
#[pyfunction]
#[pyo3(signature = (*, eccentricity, semi_major_axis=None, module=None, tooth_count=None))]
pub(crate) fn ellipse(
    eccentricity: f64,
    semi_major_axis: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::Ellipse(spec::Ellipse {
        eccentricity,
        semi_major_axis,
        module,
        tooth_count,
    }))
}

/// A focal ellipse drawn together so that it repeats `lobes` times in one turn.
#[pyfunction]
#[pyo3(signature = (*, lobes, eccentricity, semi_major_axis=None, module=None, tooth_count=None))]
pub(crate) fn lobed_ellipse(
    lobes: u32,
    eccentricity: f64,
    semi_major_axis: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::LobedEllipse(spec::LobedEllipse {
        lobes,
        eccentricity,
        semi_major_axis,
        module,
        tooth_count,
    }))
}

/// A closed uniform B-spline, from control points or (`interpolate=True`) through the points.
#[pyfunction]
#[pyo3(signature = (*, radius=None, angle=None, x=None, y=None, degree=3, plane="polar", interpolate=false, module=None, tooth_count=None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn bspline(
    radius: Option<Numbers<'_>>,
    angle: Option<Numbers<'_>>,
    x: Option<Numbers<'_>>,
    y: Option<Numbers<'_>>,
    degree: u32,
    plane: &str,
    interpolate: bool,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::Bspline(spec::Bspline {
        plane: self::plane(plane)?,
        degree,
        interpolate,
        radius: list(radius),
        angle: list(angle),
        x: list(x),
        y: list(y),
        module,
        tooth_count,
    }))
}

/// A closed chain of Bezier arcs: of each arc all control points but the last.
#[pyfunction]
#[pyo3(signature = (*, radius=None, angle=None, x=None, y=None, degree=3, plane="polar", module=None, tooth_count=None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn bezier(
    radius: Option<Numbers<'_>>,
    angle: Option<Numbers<'_>>,
    x: Option<Numbers<'_>>,
    y: Option<Numbers<'_>>,
    degree: u32,
    plane: &str,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::Bezier(spec::Bezier {
        plane: self::plane(plane)?,
        degree,
        radius: list(radius),
        angle: list(angle),
        x: list(x),
        y: list(y),
        module,
        tooth_count,
    }))
}

/// A limacon of Pascal: `r = b + c cos(N phi)`.
#[pyfunction]
#[pyo3(signature = (*, mean_radius, amplitude, lobes=1, module=None, tooth_count=None))]
pub(crate) fn limacon(
    mean_radius: f64,
    amplitude: f64,
    lobes: u32,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    resolve(spec::PitchSpec::Limacon(spec::Limacon {
        mean_radius,
        amplitude,
        lobes,
        module,
        tooth_count,
    }))
}

/// Radius as a function of the polar angle: a formula in `phi`, radii, or a Fourier series.
#[pyfunction]
#[pyo3(signature = (radius=None, *, angle=None, interpolation=None, mean=None, cos=None, sin=None, module=None, tooth_count=None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn polar(
    radius: Option<Law<'_>>,
    angle: Option<Numbers<'_>>,
    interpolation: Option<&str>,
    mean: Option<f64>,
    cos: Option<Numbers<'_>>,
    sin: Option<Numbers<'_>>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    let (expression, radius) = Law::parts(radius);
    resolve(spec::PitchSpec::Polar(spec::Polar {
        expression,
        radius,
        angle: list(angle),
        interpolation: self::interpolation(interpolation)?,
        mean,
        cos: list(cos),
        sin: list(sin),
        module,
        tooth_count,
    }))
}

/// Driven angle as a function of the driver angle: a formula in `phi`, or samples over one driver turn.
#[pyfunction]
#[pyo3(signature = (driven_angle, *, interpolation=None, center_distance=None, module=None, tooth_count=None))]
pub(crate) fn from_transmission(
    driven_angle: Law<'_>,
    interpolation: Option<&str>,
    center_distance: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    let (expression, driven_angle) = Law::parts(Some(driven_angle));
    resolve(spec::PitchSpec::Transmission(spec::Transmission {
        expression,
        driven_angle,
        interpolation: self::interpolation(interpolation)?,
        center_distance,
        module,
        tooth_count,
    }))
}

/// Ratio as a function of the driver angle: a formula in `phi`, or samples over one driver turn.
#[pyfunction]
#[pyo3(signature = (ratio, *, interpolation=None, center_distance=None, module=None, tooth_count=None))]
pub(crate) fn from_ratio(
    ratio: Law<'_>,
    interpolation: Option<&str>,
    center_distance: Option<f64>,
    module: Option<f64>,
    tooth_count: Option<u32>,
) -> PyResult<Pitch> {
    let (expression, ratio) = Law::parts(Some(ratio));
    resolve(spec::PitchSpec::Ratio(spec::Ratio {
        expression,
        ratio,
        interpolation: self::interpolation(interpolation)?,
        center_distance,
        module,
        tooth_count,
    }))
}
