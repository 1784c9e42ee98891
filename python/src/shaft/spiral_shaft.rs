use std::sync::Arc;

use centrode_gear::cam::law::LawSpec;
use centrode_groove as mechanism;
use centrode_groove::{
    RotatedSine, Sine, SpeedFormula, SpeedLaw, SpeedTable, SpiralShaftDesign, Wall,
};
use pyo3::prelude::{
    Bound, PyAny, PyAnyMethods, PyClassInitializer, PyDictMethods, PyResult, Python, pyclass,
    pymethods,
};
use pyo3::types::{PyDict, PyType};

use super::BoxDrive;
use crate::array::{Course, MeshRows, Rows, Values, mesh};
use crate::design::Class;
use crate::error::{Answer, Raised, plain_tolerance};
use crate::keywords::{Call, fill};
use crate::wait::wait;

/// A spiral shaft of variable speed: the law of the slider, the groove out and back, and the forces on the slider.
///
/// The input is the angle of the shaft; it is 0 where the slider leaves the first hole. The whole cycle out and back
/// takes `cycle` radians.
///
/// Args:
///     lead: Lead, mm per turn: the distance between neighbouring holes.
///     holes: Number of holes across the box.
///     radius: Radius of the shaft, mm.
///     amplitude: Amplitude of the sine, mm; 0 for a plain shaft.
///     harmonic: Number of slow points per turn.
///     phase: Shaft angle of a slow point, rad.
///     rotated: Whether the sine is rotated onto the helix, equations (3) to (5) of Zhou et al. 2018; otherwise it is the
///         integral of the speed.
///     speed: Speeds at equal steps of a turn, instead of a sine; only their ratios matter.
///     expression: Formula in `phi` for the speed, instead of a sine.
///     moved_distance: Distance by which the box must move in the picking window, mm. The sine is slow where the first
///         seedling is picked, and its amplitude is computed.
///     window: Shaft angle during which a seedling is picked, rad.
///     pick: Shaft angle in the middle of the first picking, rad.
///     pot_width: Width of a pot, mm; the box may move by a sixth of it while a seedling is picked.
///     reversal_angle: Shaft angle of one reversal, rad: a whole number of half turns.
///     reversal_law: Law by which the speed changes sign: name of a motion law, such as "harmonic" or "cycloidal".
///     return_offset: Distance of the return groove from the forward groove, mm.
///     groove_width: Width of the groove along the normal on the surface, mm.
///     groove_depth: Depth of the groove, mm.
///     slider_length: Length of the slider over its round ends, mm.
///     slider_clearance: Width of the groove minus that of the slider, mm.
///     speed_rpm: Speed of the shaft, r/min.
///     mass: Moved mass, kg.
///     groove_friction: Coefficient of friction between slider and groove.
///     rail_friction: Coefficient of friction between box and rails.
///     goals: Goals by name, each a dict with the keys of the design file: figure, and minimum, maximum or between, such as
///         {"fast": {"figure": "moved_distance", "maximum": 2.1}}.
///     vary: Numbers that a search may move, with their minimum and maximum, such as {"law.amplitude": (0, 1.6)}.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule.
///
/// >>> import centrode as ct
/// >>> shaft = ct.SpiralShaft(lead=20, holes=14, radius=15, amplitude=1.28, harmonic=1)
/// >>> round(shaft.moved(-0.5236, 0.5236), 3)
/// 2.053
#[pyclass(frozen, extends = BoxDrive, module = "centrode")]
#[derive(Debug)]
pub(crate) struct SpiralShaft(pub(crate) Arc<mechanism::SpiralShaft>);

impl Class for SpiralShaft {
    type Machine = mechanism::SpiralShaft;

    fn start(shaft: Arc<mechanism::SpiralShaft>) -> PyClassInitializer<Self> {
        BoxDrive::start(&shaft).add_subclass(Self(shaft))
    }

    fn machine(&self) -> &Arc<mechanism::SpiralShaft> {
        &self.0
    }
}

#[pymethods]
impl SpiralShaft {
    #[new]
    #[pyo3(signature = (**keywords), text_signature = "(*, lead=20.0, holes=14, radius=15.0, amplitude=0.0, harmonic=1, phase=0.0, rotated=False, speed=None, expression=None, moved_distance=None, window=1.0471975511965976, pick=0.0, pot_width=18.0, reversal_angle=None, reversal_law='harmonic', return_offset=0.0, groove_width=10.0, groove_depth=4.0, slider_length=None, slider_clearance=None, speed_rpm=200.0, mass=10.0, groove_friction=0.1, rail_friction=0.15, goals=None, vary=None, name='spiral-shaft', title='')")]
    fn new(
        py: Python<'_>,
        keywords: Option<Bound<'_, PyDict>>,
    ) -> Answer<PyClassInitializer<Self>> {
        let call = Call::new("SpiralShaft.__new__", keywords);
        let mut design = SpiralShaftDesign::default();
        fill!(call, design, "": goals, vary, name, title, lead, holes, radius, moved_distance, window, pick, pot_width, return_offset);
        fill!(call, design.groove, "groove.": groove_width = width, groove_depth = depth);
        fill!(call, design.load, "load.": speed_rpm, mass, groove_friction, rail_friction);
        let (reversal, slider) = (&mut design.reversal, &mut design.slider);
        for (keyword, length) in [
            ("reversal_angle", &mut reversal.angle),
            ("slider_length", &mut slider.length),
            ("slider_clearance", &mut slider.clearance),
        ] {
            *length = call.optional(keyword, keyword)?.unwrap_or(*length);
        }
        if let Some(word) = call.take::<String>("reversal_law", "reversal.law")? {
            reversal.law = LawSpec::named(&word).ok_or_else(|| {
                let known = LawSpec::NAMED.map(|(name, _)| name);
                Raised::word("reversal.law", &word, &known)
            })?;
        }
        let mut sine = Sine::default();
        fill!(call, sine, "law.": amplitude, harmonic, phase);
        let rotated = call.take("rotated", "law.kind")?.unwrap_or(false);
        let speed = call.optional("speed", "law.speed")?;
        let expression = call.optional("expression", "law.expression")?;
        call.end()?;
        design.law = match (speed, expression) {
            _ if design.moved_distance.is_some() => SpeedLaw::Sine(Sine {
                amplitude: 0.0,
                phase: design.pick,
                ..sine
            }),
            (Some(speed), _) => SpeedLaw::Table(SpeedTable {
                speed,
                interpolation: None,
            }),
            (None, Some(expression)) => SpeedLaw::Formula(SpeedFormula { expression }),
            (None, None) if rotated => SpeedLaw::RotatedSine(RotatedSine {
                amplitude: sine.amplitude,
                harmonic: sine.harmonic,
                phase: sine.phase,
            }),
            (None, None) => SpeedLaw::Sine(sine),
        };
        Self::made(py, design)
    }

    /// Makes the shaft whose box moves by `moved_distance` (mm) in the picking window; the amplitude is computed.
    ///
    /// >>> import centrode as ct
    /// >>> shaft = ct.SpiralShaft.for_moved_distance(2.05, lead=20)
    /// >>> round(shaft.amplitude, 6)
    /// 1.283333
    /// >>> round(shaft.speed_ratio[0], 6)  # minimum speed over the mean
    /// 0.596829
    #[classmethod]
    #[pyo3(signature = (moved_distance, **keywords))]
    fn for_moved_distance<'py>(
        cls: &Bound<'py, PyType>,
        moved_distance: f64,
        keywords: Option<Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let keywords = keywords.unwrap_or_else(|| PyDict::new(cls.py()));
        keywords.set_item("moved_distance", moved_distance)?;
        cls.call((), Some(&keywords))
    }

    /// Lead, mm per turn.
    #[getter]
    fn lead(&self) -> f64 {
        self.0.law().lead()
    }

    /// Shaft angle during which a seedling is picked, rad.
    #[getter]
    fn window(&self) -> f64 {
        self.0.design().window
    }

    /// Shaft angle in the middle of the first picking, rad.
    #[getter]
    fn pick(&self) -> f64 {
        self.0.design().pick
    }

    /// Amplitude of the sine, mm; None for another law.
    #[getter]
    fn amplitude(&self) -> Option<f64> {
        self.0.amplitude()
    }

    /// Minimum and maximum speed of the strokes, divided by their mean speed.
    #[getter]
    fn speed_ratio(&self) -> (f64, f64) {
        self.0.speed_ratio()
    }

    /// Lead angle of the groove on the shaft's surface, rad; negative on the return stroke.
    fn lead_angle(&self, theta: Values) -> Course {
        self.each(theta, |s, t| s.groove().lead_angle(t))
    }

    /// Curvature of the developed centre line, 1/mm.
    fn curvature(&self, theta: Values) -> Course {
        self.each(theta, |s, t| s.groove().curvature(t))
    }

    /// The developed groove: "center" line, "left" wall and "right" wall, each (N, 2), mm, not wrapped round.
    ///
    /// x is the arc length R theta, y the position along the shaft. The polylines are within `tolerance` (mm).
    ///
    /// >>> import centrode as ct
    /// >>> developed = ct.SpiralShaft(amplitude=1.28).developed(0.01)
    /// >>> sorted(developed)
    /// ['center', 'left', 'right']
    #[pyo3(signature = (tolerance=1e-3))]
    fn developed<'py>(&self, py: Python<'py>, tolerance: f64) -> Answer<Bound<'py, PyDict>> {
        let tolerance = plain_tolerance(tolerance)?;
        let shaft = Arc::clone(&self.0);
        let ways = wait(py, move || {
            let groove = shaft.groove();
            [
                groove.way(0.0, tolerance),
                groove.wall_way(Wall::Left, tolerance),
                groove.wall_way(Wall::Right, tolerance),
            ]
        })?;
        let developed = PyDict::new(py);
        for (name, way) in ["center", "left", "right"].into_iter().zip(&ways) {
            developed.set_item(name, Rows::new(way))?;
        }
        Ok(developed)
    }

    /// Crossings of the groove with itself, (N, 4): shaft angle out (rad), shaft angle back (rad), position (mm), and the
    /// length without walls that the slider must bridge (mm).
    ///
    /// >>> import centrode as ct
    /// >>> crossings = ct.SpiralShaft.for_moved_distance(2.05).crossings()
    /// >>> len(crossings), round(float(crossings[:, 3].max()), 1)
    /// (27, 40.1)
    fn crossings(&self) -> Rows<4> {
        let crossings = self.0.groove().crossings();
        let rows = crossings.iter().map(|c| [c.out, c.back, c.position, c.gap]);
        Rows(rows.collect())
    }

    /// The shaft as a closed triangle mesh: vertices (V, 3), mm, and faces (F, 3), counter-clockwise outside.
    ///
    /// The shaft is along z; z = 0 is the position of the slider at the first hole.
    #[pyo3(signature = (tolerance=1e-2))]
    fn mesh(&self, py: Python<'_>, tolerance: f64) -> Answer<MeshRows> {
        let tolerance = plain_tolerance(tolerance)?;
        let shaft = Arc::clone(&self.0);
        Ok(mesh(wait(py, move || shaft.mesh(tolerance))??))
    }
}
