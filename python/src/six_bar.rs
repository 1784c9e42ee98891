use std::collections::BTreeMap;

use centrode_geometry::Point;
use centrode_kinematics::linkage::{self, FourBar};
use pyo3::prelude::{Bound, PyAny, PyResult, Python, pyclass, pymethods};

use crate::array::{Course, Rows, Values, put, row};
use crate::error::Answer;
use crate::made::{Reduced, by};
use crate::record::{self, Keywords};
use crate::wait::wait_here;
use crate::word::Word;

/// A crank-rocker that swings an end effector through a slider: the picking mechanism of Ye et al. 2022.
///
/// The crank AB turns about the origin A, the rocker CD about D = (frame, 0). The slider at the joint C of coupler and
/// rocker moves along the effector, which turns about the fixed pivot F. The effector's angle is the direction from F to
/// C, without jumps. Its tip E is at the effector's length from F.
///
/// Args:
///     crank: Length AB, mm; it must be the shortest length.
///     coupler: Length BC, mm.
///     rocker: Length CD, mm.
///     frame: Length AD, mm.
///     pivot: Position of the effector's pivot F, mm.
///     effector_length: Length FE, mm.
///     branch: "upper" with C left of the line from B to D, or "lower".
///
/// Raises:
///     LinkageError: The four-bar is not a crank-rocker, or the pivot is on the path of the slider.
///     DesignError: A value is out of its range.
///
/// >>> import centrode as ct
/// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
/// >>> round(six.quick_return, 4)
/// 2.4015
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SixBar(pub(crate) linkage::SixBar);

#[pymethods]
impl SixBar {
    #[new]
    #[pyo3(signature = (*, crank, coupler, rocker, frame, pivot, effector_length, branch="upper"))]
    fn new(
        crank: f64,
        coupler: f64,
        rocker: f64,
        frame: f64,
        pivot: (f64, f64),
        effector_length: f64,
        branch: &str,
    ) -> Answer<Self> {
        let four_bar = FourBar::new(crank, coupler, rocker, frame, Word::of("branch", branch)?)?;
        let pivot = Point::new(pivot.0, pivot.1);
        Ok(Self(linkage::SixBar::new(
            four_bar,
            pivot,
            effector_length,
        )?))
    }

    /// The joints B and C and the tip E at a crank angle, mm: an array of the shape of `phi` and then (3, 2).
    ///
    /// >>> import centrode as ct
    /// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    /// >>> six.position(0.0).round(6)
    /// array([[ 77.      ,   0.      ],
    ///        [188.857143,  95.378088],
    ///        [290.519775, 127.845833]])
    fn position(&self, phi: Values) -> Course {
        let six_bar = self.0;
        Course::by_blocks(phi, &[3, 2], move |phi, joints| {
            let found = six_bar.joints_each(phi);
            put(found.as_flattened(), joints, |joint| [joint.x, joint.y]);
        })
    }

    /// Angle of the effector at a crank angle, rad; for an array, an array of the same shape.
    fn effector_angle(&self, phi: Values) -> Course {
        let six_bar = self.0;
        Course::by_blocks(phi, &[], move |phi, angles| {
            angles.copy_from_slice(&six_bar.effector_place_each(phi));
        })
    }

    /// Angle of the effector and its first three derivatives with respect to the crank angle: an array of the shape of
    /// `phi` and then (4,).
    ///
    /// >>> import centrode as ct
    /// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    /// >>> bool(abs(six.effector_motion(six.dead_centers.folded)[1]) < 1e-12)
    /// True
    fn effector_motion(&self, phi: Values) -> Course {
        let six_bar = self.0;
        Course::by_blocks(phi, &[4], move |phi, angles| {
            put(&six_bar.effector_angle_each(phi), angles, row);
        })
    }

    /// Tip E of the effector at a crank angle, mm: an array of the shape of `phi` and then (2,).
    fn effector_tip(&self, phi: Values) -> Course {
        let six_bar = self.0;
        Course::by_blocks(phi, &[2], move |phi, tips| {
            put(&six_bar.joints_each(phi), tips, |[_, _, e]| [e.x, e.y]);
        })
    }

    /// Angle at C between coupler and rocker, in (0, pi), rad; for an array, an array of the same shape.
    fn transmission_angle(&self, phi: Values) -> Course {
        let four_bar = *self.0.four_bar();
        Course::each(phi, move |phi| four_bar.transmission_angle(phi))
    }

    /// Lengths of crank, coupler, rocker and frame, mm.
    #[getter]
    fn lengths(&self) -> [f64; 4] {
        self.0.four_bar().lengths()
    }

    /// Position of the effector's pivot F, mm.
    #[getter]
    fn pivot(&self) -> (f64, f64) {
        let pivot = self.0.pivot();
        (pivot.x, pivot.y)
    }

    /// Length of the effector from its pivot to its tip, mm.
    #[getter]
    fn effector_length(&self) -> f64 {
        self.0.effector_length()
    }

    /// Swing of the effector: the angle between the ends of its motion, rad.
    ///
    /// >>> import centrode as ct
    /// >>> import math
    /// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    /// >>> round(math.degrees(six.swing), 6)
    /// 179.744327
    #[getter]
    fn swing(&self) -> f64 {
        self.0.swing()
    }

    /// Minimum angle between the lines of coupler and rocker over the cycle, rad.
    #[getter]
    fn minimum_transmission_angle(&self) -> f64 {
        self.0.four_bar().minimum_transmission_angle()
    }

    /// Swing of the rocker: the angle between the ends of its motion, rad.
    #[getter]
    fn rocker_swing(&self) -> Option<f64> {
        self.0.four_bar().rocker_swing()
    }

    /// Time ratio: time of the rocker's slow stroke divided by that of its quick stroke.
    #[getter]
    fn quick_return(&self) -> Option<f64> {
        self.0.four_bar().quick_return()
    }

    /// Crank angle of the rocker's slow stroke, rad.
    #[getter]
    fn slow_stroke(&self) -> Option<f64> {
        self.0.four_bar().slow_stroke()
    }

    /// Dead centres, at which crank and coupler are in one line.
    #[getter]
    fn dead_centers<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let dead = self.0.four_bar().dead_centers();
        dead.map(|d| record::dead_centers(py, &d)).transpose()
    }

    /// Sensitivity of the swing to each dimension, rad/mm: exact derivatives by name.
    ///
    /// >>> import centrode as ct
    /// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    /// >>> sorted(six.swing_sensitivity)
    /// ['coupler', 'crank', 'frame', 'pivot_x', 'pivot_y', 'rocker']
    #[getter]
    fn swing_sensitivity(&self) -> BTreeMap<&'static str, f64> {
        let sensitivity = self.0.swing_sensitivity();
        let [crank, coupler, rocker, frame] = sensitivity.lengths;
        BTreeMap::from([
            ("crank", crank),
            ("coupler", coupler),
            ("rocker", rocker),
            ("frame", frame),
            ("pivot_x", sensitivity.pivot.x),
            ("pivot_y", sensitivity.pivot.y),
        ])
    }

    /// Positions of the effector's pivot that give this swing (rad) with these four lengths, in order along a curve: an
    /// array (N, 2).
    ///
    /// For a swing of half a turn these are the points of the chord between the slider's dead centres. No position gives
    /// more than half a turn plus half the rocker's swing.
    ///
    /// >>> import centrode as ct
    /// >>> import math
    /// >>> six = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    /// >>> six.pivots(math.pi, 2).round(3)
    /// array([[160.729,  65.584],
    ///        [ 52.929,  68.523]])
    #[pyo3(signature = (swing, count=100))]
    fn pivots(&self, py: Python<'_>, swing: f64, count: usize) -> PyResult<Rows<2>> {
        let four_bar = self.0.four_bar();
        let pivots = wait_here(py, || linkage::SixBar::pivots(four_bar, swing, count))?;
        Ok(Rows::new(&pivots))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        self.keywords(py)?.call("SixBar")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by("SixBar", self.keywords(py)?)
    }
}

impl SixBar {
    /// The keywords that make this one.
    fn keywords<'py>(&self, py: Python<'py>) -> PyResult<Keywords<'py>> {
        let [crank, coupler, rocker, frame] = self.lengths();
        Keywords::new(py)
            .with("crank", crank)?
            .with("coupler", coupler)?
            .with("rocker", rocker)?
            .with("frame", frame)?
            .with("pivot", self.pivot())?
            .with("effector_length", self.effector_length())?
            .with("branch", self.0.four_bar().branch().word())
    }
}
