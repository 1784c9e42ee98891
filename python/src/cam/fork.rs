//! The fork that moves a push rod, and the cam that moves it.

use std::sync::Arc;

use centrode_gear::cam::design::MotionSpec;
use centrode_gear::cam::{Cam, CamError, Fork as Mechanism, Lever, Motion, RodJoint};
use centrode_kinematics::transmission::MotionJet;
use pyo3::prelude::{Bound, PyAnyMethods, PyRef, PyResult, Python, pyclass, pymethods};

use super::disc::DiscCam;
use super::parts::Segment;
use crate::array::{Course, Values};
use crate::body::Body;
use crate::error::{Answer, Raised};
use crate::made::{Made, Reduced, by};
use crate::record::Keywords;
use crate::wait::wait;
use crate::word::Word;

const JOINTS: [&str; 2] = ["pin-on-rod", "pin-on-fork"];

/// A swinging follower with the cam roller at one end and a push rod at the other.
///
/// b is the angle between the lever and the perpendicular to the axis of the rod, positive towards retraction; b0 is this
/// angle with the rod fully extended. The retraction is l (tan b - tan b0) for a pin on the rod in a slot of the fork,
/// and l (sin b - sin b0) for a pin on the fork in a slot across the rod.
///
/// Args:
///     roller_radius: Radius of the roller, mm.
///     center_distance: Distance of the fork's pivot from the cam's axis, mm.
///     arm_length: Distance of the roller's centre from the pivot, mm.
///     lever_length: l, mm: distance of the rod's axis, or of the pin on the fork, from the pivot.
///     lever_start: Angle b0, rad.
///     lifts: Direction in which the fork turns when the cam lifts it.
///     joint: "pin-on-rod" or "pin-on-fork".
///
/// Raises:
///     DesignError: A value breaks a rule.
///
/// >>> import centrode as ct
/// >>> fork = ct.cam.Fork(roller_radius=5, center_distance=52, arm_length=45, lever_length=40, lever_start=-0.15)
/// >>> round(fork.retraction(0.25), 6)
/// 10.058796
#[pyclass(frozen, eq, module = "centrode.cam")]
#[derive(Debug, PartialEq)]
pub(crate) struct Fork(pub(crate) Mechanism);

impl Fork {
    fn lever(&self) -> &Lever {
        self.0.rod.lever()
    }
}

#[pymethods]
impl Fork {
    #[new]
    #[pyo3(signature = (*, roller_radius, center_distance, arm_length, lever_length, lever_start=0.0, lifts="counter-clockwise", joint="pin-on-rod"))]
    fn new(
        roller_radius: f64,
        center_distance: f64,
        arm_length: f64,
        lever_length: f64,
        lever_start: f64,
        lifts: &str,
        joint: &str,
    ) -> Answer<Self> {
        let lever = Lever {
            length: lever_length,
            start: lever_start,
        };
        let fork = Mechanism {
            roller_radius,
            center_distance,
            arm_length,
            lifts: Word::of("lifts", lifts)?,
            rod: match joint {
                "pin-on-rod" => RodJoint::PinOnRod(lever),
                "pin-on-fork" => RodJoint::PinOnFork(lever),
                _ => return Err(Raised::word("joint", joint, &JOINTS)),
            },
        };
        fork.validate()?;
        Ok(Self(fork))
    }

    /// Radius of the roller, mm.
    #[getter]
    fn roller_radius(&self) -> f64 {
        self.0.roller_radius
    }

    /// Distance of the pivot from the cam's axis, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.0.center_distance
    }

    /// Distance of the roller's centre from the pivot, mm.
    #[getter]
    fn arm_length(&self) -> f64 {
        self.0.arm_length
    }

    /// Length of the lever that moves the rod, mm.
    #[getter]
    fn lever_length(&self) -> f64 {
        self.lever().length
    }

    /// Angle between the lever and the perpendicular to the rod's axis with the rod fully extended, rad.
    #[getter]
    fn lever_start(&self) -> f64 {
        self.lever().start
    }

    /// Direction in which the fork turns when the cam lifts it.
    #[getter]
    fn lifts(&self) -> &'static str {
        self.0.lifts.word()
    }

    /// Joint of fork and rod, "pin-on-rod" or "pin-on-fork".
    #[getter]
    fn joint(&self) -> &'static str {
        match self.0.rod {
            RodJoint::PinOnFork(_) => "pin-on-fork",
            _ => "pin-on-rod",
        }
    }

    /// Retraction of the rod, mm, at swing angles of the fork, rad.
    fn retraction(&self, swing: Values) -> Course {
        let rod = self.0.rod;
        Course::each(swing, move |swing| rod.retraction(&at_rest(swing)).position)
    }

    /// Swing of the fork, rad, for retractions of the rod, mm; NaN if a pin on the fork cannot reach so far.
    ///
    /// >>> import centrode as ct
    /// >>> fork = ct.cam.Fork(roller_radius=5, center_distance=52, arm_length=45, lever_length=40)
    /// >>> round(fork.swing(40.0), 6)
    /// 0.785398
    fn swing(&self, retraction: Values) -> Course {
        let rod = self.0.rod;
        Course::each(retraction, move |retraction| {
            rod.swing(&at_rest(retraction)).position
        })
    }

    /// The cam that moves the rod as required.
    ///
    /// Args:
    ///     segments: Motion of the rod during one turn of the arm about the cam, with lifts in mm.
    ///     base_radius: Radius of the base circle, mm; the roller is on it when the rod is fully extended.
    ///     rotation: Direction in which the cam turns, seen from the arm.
    ///     start: Cam angle at which the first segment begins, rad.
    ///     body: Width, bore and material.
    ///     name: Name, used for file names.
    ///
    /// Raises:
    ///     CamError: The fork or the rod cannot follow the motion.
    ///
    /// >>> import centrode as ct
    /// >>> from math import pi
    /// >>> fork = ct.cam.Fork(roller_radius=5, center_distance=52, arm_length=45, lever_length=40, lever_start=-0.15)
    /// >>> back = [ct.cam.rise(span=2, lift=9), ct.cam.dwell(span=2), ct.cam.return_(span=2 * pi - 4, lift=9)]
    /// >>> cam = fork.cam(back, base_radius=22)
    /// >>> round(float(fork.retraction(cam.motion([3.0])[0, 0])), 9)
    /// 9.0
    #[pyo3(signature = (segments, *, base_radius, rotation="counter-clockwise", start=0.0, body=None, name="cam"))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn cam<'py>(
        slf: &Bound<'py, Self>,
        py: Python<'py>,
        segments: Vec<PyRef<'py, Segment>>,
        base_radius: f64,
        rotation: &str,
        start: f64,
        body: Option<PyRef<'py, Body>>,
        name: &str,
    ) -> Answer<DiscCam> {
        let again = Keywords::new(py)
            .with("segments", &segments)?
            .with("base_radius", base_radius)?
            .with("rotation", rotation)?
            .with("start", start)?
            .with("body", body.as_ref())?
            .with("name", name)?;
        let made = Made::call(slf.getattr("cam")?, Vec::new(), again)?;
        let motion = MotionSpec {
            start,
            segments: segments.iter().map(|segment| segment.0.clone()).collect(),
        };
        if motion.swings() == Some(true) {
            return Err(Raised::rule(
                "segments",
                "must have lift, not swing: a rod slides",
            ));
        }
        let (fork, rotation) = (slf.get().0.clone(), Word::of("rotation", rotation)?);
        let body = body.map(|body| body.0.clone()).unwrap_or_default();
        let name = name.to_owned();
        let cam = wait(py, move || -> Result<Cam, CamError> {
            let motion = Arc::new(Motion::resolve(&motion)?);
            Cam::new(fork.cam(motion, base_radius, rotation)?, &name, body)
        })?;
        Ok(DiscCam::new(cam?, made))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py)
            .with("roller_radius", self.roller_radius())?
            .with("center_distance", self.center_distance())?
            .with("arm_length", self.arm_length())?
            .with("lever_length", self.lever_length())?
            .with("lever_start", self.lever_start())?
            .with("lifts", self.lifts())?
            .with("joint", self.joint())?;
        by("Fork", keywords)
    }

    fn __repr__(&self) -> String {
        format!(
            "Fork({}, arm_length={:?}, lever_length={:?})",
            self.joint(),
            self.0.arm_length,
            self.lever().length,
        )
    }
}

/// Motion of a fixed position.
fn at_rest(position: f64) -> MotionJet {
    MotionJet::at_rest(position)
}
