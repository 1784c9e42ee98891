use std::collections::BTreeMap;
use std::sync::Arc;

use centrode_export::{Options, cam as export};
use centrode_gear::cam::{Cam, Contact, Extreme, design as spec};
use pyo3::prelude::{Bound, PyAny, PyRef, PyResult, Python, pyclass, pymethods};
use pyo3::types::{PyDict, PyDictMethods};

use super::parts::{Follower, Segment};
use crate::array::{Course, Rows, Values, row};
use crate::error::{Answer, plain_tolerance};
use crate::files;
use crate::keywords::{Call, fill};
use crate::made::{Made, Reduced, native};
use crate::record::Keywords;
use crate::solid::Sides;
use crate::wait::wait;

/// An extreme as the pair of cam angle and value.
type Peak = (f64, f64);

/// A disc cam in its own frame. At cam angle zero, the x axis points along the slide, or to the pivot of the arm.
///
/// Args:
///     follower: Follower of the cam.
///     segments: Motion of the follower in one turn; the spans must add up to a whole turn.
///     base_radius: Radius of the base circle, mm.
///     rotation: Direction in which the cam turns, "counter-clockwise" or "clockwise".
///     start: Cam angle at which the first segment begins, rad.
///     body: Width, bore and material.
///     name: Name, used for file names.
///     title: One line for drawings.
///
/// >>> import centrode as ct
/// >>> from math import pi
/// >>> cam = ct.DiscCam(
/// ...     ct.cam.translating_roller(roller_radius=7),
/// ...     [ct.cam.rise(span=2 * pi / 3, lift=9), ct.cam.dwell(span=pi / 3), ct.cam.return_(span=pi, lift=9)],
/// ...     base_radius=40,
/// ... )
/// >>> cam.motion([2.5])
/// array([[9., 0., 0., 0.]])
/// >>> round(cam.limits["rise_pressure_angle"][1], 3)
/// 0.166
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct DiscCam {
    cam: Arc<Cam>,
    made: Made,
}

impl DiscCam {
    pub(crate) fn new(cam: Cam, made: Made) -> Self {
        let cam = Arc::new(cam);
        Self { cam, made }
    }

    /// A number of the contact at cam angles.
    fn each(&self, theta: Values, of: fn(&Contact) -> f64) -> Course {
        let cam = Arc::clone(&self.cam);
        Course::each(theta, move |input| of(&cam.disc().contact(input)))
    }

    /// Numbers of the contact at cam angles.
    fn rows<const COUNT: usize>(&self, theta: Values, of: fn(&Contact) -> [f64; COUNT]) -> Course {
        let cam = Arc::clone(&self.cam);
        let row = move |input| of(&cam.disc().contact(input));
        Course::arrays(theta, &[COUNT], row)
    }
}

fn peak(extreme: Extreme) -> Peak {
    (extreme.input, extreme.value)
}

#[pymethods]
impl DiscCam {
    #[new]
    #[pyo3(signature = (follower, segments, *, base_radius, **keywords), text_signature = "(follower, segments, *, base_radius, rotation='counter-clockwise', start=0.0, body=None, name='cam', title='')")]
    fn make<'py>(
        py: Python<'py>,
        follower: PyRef<'py, Follower>,
        segments: Vec<PyRef<'py, Segment>>,
        base_radius: f64,
        keywords: Option<Bound<'py, PyDict>>,
    ) -> Answer<Self> {
        let again = keywords
            .as_ref()
            .map_or_else(|| Ok(PyDict::new(py)), |k| k.copy())?;
        let again = Keywords(again)
            .with("follower", &follower)?
            .with("segments", &segments)?
            .with("base_radius", base_radius)?;
        let made = Made::call(native(py, "DiscCam")?, Vec::new(), again)?;
        let motion = spec::MotionSpec {
            start: 0.0,
            segments: segments.iter().map(|segment| segment.0.clone()).collect(),
        };
        let mut design = spec::CamSpec::new(base_radius, follower.0.clone(), motion);
        let call = Call::new("DiscCam.__new__", keywords);
        fill!(call, design, "": rotation, body, name, title);
        fill!(call, design.motion, "": start);
        call.end()?;
        let cam = wait(py, move || Cam::resolve(&design))??;
        Ok(Self::new(cam, made))
    }

    /// Name.
    #[getter]
    fn name(&self) -> &str {
        self.cam.name()
    }

    /// Whether the follower swings: its motion is then in rad, otherwise in mm.
    #[getter]
    fn swings(&self) -> bool {
        self.cam.disc().follower().swings()
    }

    /// Radius of the base circle, mm.
    #[getter]
    fn base_radius(&self) -> f64 {
        self.cam.disc().base_radius()
    }

    /// Angle between a swinging arm and the line of centres with the follower on the base circle, rad; zero for a slide.
    #[getter]
    fn start_angle(&self) -> f64 {
        self.cam.disc().start_angle()
    }

    /// Minimum and maximum distance of the profile from the axis, mm.
    #[getter]
    fn radii(&self) -> (f64, f64) {
        self.cam.radii()
    }

    /// Position, velocity, acceleration and jerk of the follower at cam angles, (N, 4): mm or rad, and derivatives per
    /// radian of cam angle.
    fn motion(&self, theta: Values) -> Course {
        self.rows(theta, |contact| row(&contact.motion))
    }

    /// Points of the profile that touch the follower at cam angles, (N, 2), mm.
    fn points(&self, theta: Values) -> Course {
        self.rows(theta, |contact| contact.point.coords.into())
    }

    /// Unit normals of the profile at the points of contact at cam angles, (N, 2), pointing out of the cam.
    fn normals(&self, theta: Values) -> Course {
        self.rows(theta, |contact| contact.normal.into())
    }

    /// Centres of the roller at cam angles, (N, 2), mm; NaN for a flat face.
    fn roller(&self, theta: Values) -> Course {
        self.rows(theta, |contact| {
            contact.roller.map_or([f64::NAN; 2], |at| [at.x, at.y])
        })
    }

    /// Pressure angles at cam angles, (N,), rad: from the direction of lift to the normal.
    fn pressure_angle(&self, theta: Values) -> Course {
        self.each(theta, |contact| contact.pressure_angle)
    }

    /// Curvature of the profile at cam angles, (N,), 1/mm: positive where it is convex.
    fn curvature(&self, theta: Values) -> Course {
        self.each(theta, |contact| contact.curvature)
    }

    /// Curvature of the path of the roller's centre at cam angles, (N,), 1/mm; NaN for a flat face.
    fn pitch_curvature(&self, theta: Values) -> Course {
        self.each(theta, |contact| contact.pitch_curvature.unwrap_or(f64::NAN))
    }

    /// Corners of a polygon within the tolerance of the profile, (N, 2), mm, counter-clockwise.
    #[pyo3(signature = (tolerance=1e-3))]
    fn profile(&self, tolerance: f64) -> Answer<Rows<2>> {
        let tolerance = plain_tolerance(tolerance)?;
        let outline = self.cam.profile().outline();
        Ok(Rows::new(&outline.flatten(tolerance)))
    }

    /// Corners of a polygon within the tolerance of the path of the roller's centre; None for a flat face.
    #[pyo3(signature = (tolerance=1e-3))]
    fn pitch_curve(&self, tolerance: f64) -> Answer<Option<Rows<2>>> {
        let tolerance = plain_tolerance(tolerance)?;
        let path = self.cam.disc().pitch_curve(tolerance.scaled(1e-3))?;
        Ok(path.map(|path| Rows::new(&path.flatten(tolerance))))
    }

    /// Ranges of the cam angle at which undercut removes the contact, rad; empty for a sound cam.
    #[getter]
    fn undercut(&self) -> Vec<(f64, f64)> {
        self.cam.profile().undercut().to_vec()
    }

    /// Maximum "lift", "velocity", "acceleration" and "jerk" of the follower, each with its cam angle.
    #[getter]
    fn peaks(&self) -> BTreeMap<&'static str, Peak> {
        let peaks = self.cam.disc().peaks();
        BTreeMap::from([
            ("lift", peak(peaks.lift)),
            ("velocity", peak(peaks.velocity)),
            ("acceleration", peak(peaks.acceleration)),
            ("jerk", peak(peaks.jerk)),
        ])
    }

    /// Limits of the cam, each with its cam angle: "rise_pressure_angle" and "return_pressure_angle", rad;
    /// "largest_roller", mm, for rollers only; "minimum_radius" of the convex profile, mm, zero or negative if it is
    /// undercut; "largest_wheel" that can grind it, mm; and "regularity", positive for a sound cam.
    #[getter]
    fn limits(&self) -> BTreeMap<&'static str, Peak> {
        let limits = self.cam.disc().limits();
        let mut named = BTreeMap::from([
            ("rise_pressure_angle", peak(limits.rise_pressure_angle)),
            ("return_pressure_angle", peak(limits.return_pressure_angle)),
            ("minimum_radius", peak(limits.minimum_radius)),
            ("largest_wheel", peak(limits.largest_wheel)),
            ("regularity", peak(limits.regularity)),
        ]);
        named.extend(limits.largest_roller.map(|r| ("largest_roller", peak(r))));
        named
    }

    /// The minimum base radius, mm, with which the pressure angle is below `rise` during the rise and below `fall` during
    /// the return, rad (default: no limit for the return); `None` if there is no such radius.
    #[pyo3(signature = (*, rise, fall=None))]
    fn minimum_base_radius(
        &self,
        py: Python<'_>,
        rise: f64,
        fall: Option<f64>,
    ) -> PyResult<Option<f64>> {
        let cam = self.cam.clone();
        let fall = fall.unwrap_or(std::f64::consts::FRAC_PI_2);
        wait(py, move || cam.disc().minimum_base_radius(rise, fall))
    }

    /// The contents of the files of the cam, by file name, without writing them.
    ///
    /// Args:
    ///     formats: Any of "dxf", "svg", "stl", "step", "3mf" and "csv", or "all", or the name of a receiver: "laser",
    ///         "print" or "cad". Default: "dxf", "svg", "step" and "3mf".
    ///     tolerance: Maximum distance of every arc and mesh from the exact curve, mm; default: 1e-3, and 0.01 for
    ///         "print".
    ///
    /// Raises:
    ///     ExportError: A file cannot be made.
    #[pyo3(signature = (*, formats=None, tolerance=None))]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<files::Named>,
        tolerance: Option<f64>,
    ) -> Answer<Bound<'py, PyDict>> {
        let (formats, usual) = files::formats(formats, &export::FORMATS)?;
        let options = Options::new(plain_tolerance(tolerance.unwrap_or(usual))?);
        let cam = self.cam.clone();
        let bundle = wait(py, move || export::files(&cam, &formats, &options))??;
        Ok(files::contents(py, &bundle)?)
    }

    /// Solid of the cam with its bore, from z = 0 to its width, with exact edges, for CAD kernels; see `Gear.solid`.
    ///
    /// >>> import centrode as ct
    /// >>> segments = [ct.cam.rise(span=3, lift=5), ct.cam.return_(span=2 * 3.141592653589793 - 3, lift=5)]
    /// >>> cam = ct.DiscCam(ct.cam.translating_roller(roller_radius=5), segments, base_radius=30)
    /// >>> {edge.kind for edge in cam.solid().contours[0]}
    /// {'spline'}
    #[pyo3(signature = (tolerance=1e-6))]
    fn solid<'py>(&self, py: Python<'py>, tolerance: f64) -> Answer<Bound<'py, PyAny>> {
        let shortest = plain_tolerance(tolerance)?;
        let name = self.cam.name();
        let solid = export::solid(&self.cam)?;
        Ok(Sides::new(name, solid, shortest)?.record(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Reduced<'py> {
        self.made.reduced(py)
    }

    fn __repr__(&self) -> String {
        let disc = self.cam.disc();
        format!(
            "DiscCam({}, base_radius={:?})",
            self.cam.name(),
            disc.base_radius()
        )
    }
}
