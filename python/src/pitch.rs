use centrode_mechanism::gear::pitch as spec;
use numpy::{AllowTypeChange, PyArray2, PyArrayLike1};
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::error::{DesignError, of_pitch};

/// A list of numbers: anything `NumPy` can make a one-dimensional float array of.
type Numbers<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// A pitch curve, proved to go once round the shaft axis.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Pitch {
    #[expect(dead_code, reason = "what a gear pair is made from")]
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
        let rows: Vec<Vec<f64>> = parameters
            .as_array()
            .iter()
            .map(|&t| {
                let point = self.resolved.curve.at(t).point;
                vec![point.x, point.y]
            })
            .collect();
        if rows.is_empty() {
            return Ok(PyArray2::zeros(py, [0, 2], false));
        }
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    fn __repr__(&self) -> String {
        format!("Pitch({})", self.resolved.definition)
    }
}

fn resolve(spec: spec::PitchSpec) -> PyResult<Pitch> {
    let resolved = spec.resolve().map_err(|e| of_pitch(&e))?;
    Ok(Pitch { spec, resolved })
}

fn list(numbers: Option<Numbers<'_>>) -> Vec<f64> {
    numbers.map_or_else(Vec::new, |n| n.as_array().to_vec())
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
