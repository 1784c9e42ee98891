//! Segments of a motion and kinds of follower: keywords as in the design file, angles in radians.

use centrode_gear::cam::design as spec;
use centrode_gear::cam::law::LawSpec;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{
    Bound, PyAny, PyAnyMethods, PyErr, PyRef, PyResult, Python, pyclass, pyfunction, pymethods,
};
use pyo3::types::PyDict;

use super::laws::{Law, law as named};
use crate::error::Answer;
use crate::keywords::{Field, build};
use crate::made::{Reduced, by};
use crate::record::Keywords;
use crate::word::Word;

/// One segment of a follower's motion; made by the functions of ``centrode.cam``.
#[pyclass(frozen, eq, module = "centrode.cam")]
#[derive(Debug, PartialEq)]
pub(crate) struct Segment(pub(crate) spec::SegmentSpec);

/// Follower of a cam with its guidance; made by the functions of ``centrode.cam``.
#[pyclass(frozen, eq, module = "centrode.cam")]
#[derive(Debug, PartialEq)]
pub(crate) struct Follower(pub(crate) spec::Follower);

/// A law, or the name of one.
impl Field for LawSpec {
    fn none() -> Option<Self> {
        Some(Self::default())
    }

    fn read(_key: &str, object: &Bound<'_, PyAny>) -> Answer<Self> {
        if let Ok(name) = object.extract::<String>() {
            return Ok(named(&name)?.spec);
        }
        let law: PyRef<'_, Law> = object.extract().map_err(PyErr::from)?;
        Ok(law.spec.clone())
    }
}

#[pymethods]
impl Segment {
    /// Cam angle of the segment, rad.
    #[getter]
    fn span(&self) -> f64 {
        self.0.span()
    }

    /// Change of the follower's position, mm or rad.
    #[getter]
    fn change(&self) -> f64 {
        self.0.change()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let travel = |name: &str, travel: &spec::Travel| {
            let keywords = Keywords::new(py)
                .with("span", travel.span)?
                .with("lift", travel.lift)?
                .with("swing", travel.swing)?
                .with("law", Law::resolve(travel.law.clone())?)?;
            by(name, keywords)
        };
        match &self.0 {
            spec::SegmentSpec::Rise(rise) => travel("rise", rise),
            spec::SegmentSpec::Return(back) => travel("return_", back),
            spec::SegmentSpec::Dwell(dwell) => {
                by("dwell", Keywords::new(py).with("span", dwell.span)?)
            }
            spec::SegmentSpec::Transition(between) => {
                let keywords = Keywords::new(py)
                    .with("span", between.span)?
                    .with("lift", between.lift)?
                    .with("swing", between.swing)?
                    .with("start_velocity", between.start_velocity)?
                    .with("start_acceleration", between.start_acceleration)?
                    .with("end_velocity", between.end_velocity)?
                    .with("end_acceleration", between.end_acceleration)?;
                by("transition", keywords)
            }
            other => Err(unpickled(other)),
        }
    }

    fn __repr__(&self) -> String {
        let kind = match self.0 {
            spec::SegmentSpec::Rise(_) => "rise",
            spec::SegmentSpec::Dwell(_) => "dwell",
            spec::SegmentSpec::Return(_) => "return",
            _ => "transition",
        };
        format!(
            "Segment({kind}, span={:?}, change={:?})",
            self.span(),
            self.change()
        )
    }
}

#[pymethods]
impl Follower {
    /// Whether the follower is a swinging arm.
    #[getter]
    fn swings(&self) -> bool {
        self.0.swings()
    }

    /// Radius of the roller, mm; None for a flat face.
    #[getter]
    fn roller_radius(&self) -> Option<f64> {
        self.0.roller_radius()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py);
        match &self.0 {
            spec::Follower::TranslatingRoller(roller) => {
                let keywords = keywords
                    .with("roller_radius", roller.roller_radius)?
                    .with("offset", roller.offset)?;
                by("translating_roller", keywords)
            }
            spec::Follower::TranslatingFlat(_) => by("translating_flat", keywords),
            spec::Follower::SwingingRoller(roller) => {
                let keywords = keywords
                    .with("roller_radius", roller.roller_radius)?
                    .with("center_distance", roller.center_distance)?
                    .with("arm_length", roller.arm_length)?
                    .with("lifts", roller.lifts.word())?;
                by("swinging_roller", keywords)
            }
            spec::Follower::SwingingFlat(face) => {
                let keywords = keywords
                    .with("center_distance", face.center_distance)?
                    .with("face_offset", face.face_offset)?
                    .with("lifts", face.lifts.word())?;
                by("swinging_flat", keywords)
            }
            other => Err(unpickled(other)),
        }
    }

    fn __repr__(&self) -> String {
        format!("Follower({:?})", self.0)
    }
}

/// A kind that this module cannot make.
fn unpickled(of: &dyn std::fmt::Debug) -> PyErr {
    PyTypeError::new_err(format!("cannot pickle {of:?}"))
}

fn travel(
    of: &'static str,
    span: f64,
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<spec::Travel> {
    Ok(build!(of, keywords, spec::Travel { span }, "": lift, swing, law))
}

/// A rise over the cam angle `span` by `lift` (mm, a slide) or `swing` (rad, an arm); default law: "cycloidal".
///
/// >>> import centrode as ct
/// >>> ct.cam.rise(span=2, lift=10, law="modified-sine")
/// Segment(rise, span=2.0, change=10.0)
#[pyfunction]
#[pyo3(signature = (*, span, **keywords), text_signature = "(*, span, lift=None, swing=None, law=None)")]
pub(crate) fn rise(span: f64, keywords: Option<Bound<'_, PyDict>>) -> Answer<Segment> {
    let travel = travel("rise", span, keywords)?;
    Ok(Segment(spec::SegmentSpec::Rise(travel)))
}

/// A return over the cam angle `span` by `lift` (mm, a slide) or `swing` (rad, an arm), both positive.
///
/// >>> import centrode as ct
/// >>> ct.cam.return_(span=0.5, lift=10, law=ct.cam.law("modified-trapezoid"))
/// Segment(return, span=0.5, change=-10.0)
#[pyfunction]
#[pyo3(signature = (*, span, **keywords), text_signature = "(*, span, lift=None, swing=None, law=None)")]
pub(crate) fn return_(span: f64, keywords: Option<Bound<'_, PyDict>>) -> Answer<Segment> {
    let travel = travel("return_", span, keywords)?;
    Ok(Segment(spec::SegmentSpec::Return(travel)))
}

/// A dwell over the cam angle `span`.
#[pyfunction]
#[pyo3(signature = (*, span))]
pub(crate) fn dwell(span: f64) -> Segment {
    Segment(spec::SegmentSpec::Dwell(spec::Dwell { span }))
}

/// A polynomial of degree five between given velocities and accelerations, per radian of cam angle.
#[pyfunction]
#[pyo3(signature = (*, span, **keywords), text_signature = "(*, span, lift=None, swing=None, start_velocity=0.0, start_acceleration=0.0, end_velocity=0.0, end_acceleration=0.0)")]
pub(crate) fn transition(span: f64, keywords: Option<Bound<'_, PyDict>>) -> Answer<Segment> {
    let between = build!("transition", keywords, spec::Transition { span }, "":
        lift, swing, start_velocity, start_acceleration, end_velocity, end_acceleration);
    Ok(Segment(spec::SegmentSpec::Transition(between)))
}

fn follower(follower: spec::Follower) -> Answer<Follower> {
    let sound = follower.validate();
    sound?;
    Ok(Follower(follower))
}

/// A translating roller follower, or knife-edge follower if the radius is 0. `offset` is the distance of the slide from
/// the cam axis, mm.
///
/// >>> import centrode as ct
/// >>> ct.cam.translating_roller(roller_radius=8).swings
/// False
#[pyfunction]
#[pyo3(signature = (*, roller_radius, offset=0.0))]
pub(crate) fn translating_roller(roller_radius: f64, offset: f64) -> Answer<Follower> {
    follower(spec::Follower::TranslatingRoller(spec::TranslatingRoller {
        roller_radius,
        offset,
    }))
}

/// A translating flat-faced follower, its face perpendicular to the slide.
#[pyfunction]
pub(crate) fn translating_flat() -> Answer<Follower> {
    follower(spec::Follower::TranslatingFlat(spec::TranslatingFlat {}))
}

/// A swinging roller follower, or knife-edge follower if the radius is 0. `lifts` is the direction in which the arm turns
/// when it is lifted.
#[pyfunction]
#[pyo3(signature = (*, roller_radius, center_distance, arm_length, lifts="counter-clockwise"))]
pub(crate) fn swinging_roller(
    roller_radius: f64,
    center_distance: f64,
    arm_length: f64,
    lifts: &str,
) -> Answer<Follower> {
    follower(spec::Follower::SwingingRoller(spec::SwingingRoller {
        roller_radius,
        center_distance,
        arm_length,
        lifts: Word::of("follower.lifts", lifts)?,
    }))
}

/// A swinging flat-faced follower. `face_offset` is the distance of the face from the pivot towards the cam, mm.
#[pyfunction]
#[pyo3(signature = (*, center_distance, face_offset=0.0, lifts="counter-clockwise"))]
pub(crate) fn swinging_flat(
    center_distance: f64,
    face_offset: f64,
    lifts: &str,
) -> Answer<Follower> {
    follower(spec::Follower::SwingingFlat(spec::SwingingFlat {
        center_distance,
        face_offset,
        lifts: Word::of("follower.lifts", lifts)?,
    }))
}
