use std::sync::Arc;

use centrode_mechanism::gear::GearPair as Gears;
use centrode_mechanism::shaft as mechanism;
use centrode_mechanism::shaft::{EllipticGears, MovingBoxDesign, Scheme};
use pyo3::prelude::{Bound, Py, PyAny, PyClassInitializer, PyRef, Python, pyclass, pymethods};

use crate::array::{Course, Values};
use crate::count::Count;
use crate::design::Class;
use crate::error::{Answer, finite};
use crate::gear_pair::GearPair;
use crate::mechanism::Mechanism;
use crate::spiral_shaft::{SpiralShaft, forces};
use crate::wait::wait;
use crate::word::Word;

/// A seedling box that slows down while a seedling is picked: by its shaft's groove, by elliptic gears, or by both.
///
/// `phi` is the angle of the machine's input: the shaft's where nothing stands before it, else that of the driving
/// gear. A whole way out and back takes `cycle` radians of either.
///
/// Args:
///     shaft: The shaft; the one of the design's defaults, which is plain, if left out.
///     scheme: "shaft", "elliptic-gear" or "both"; left out, "shaft" without gears, "elliptic-gear" with gears
///         before a plain shaft, "both" before another.
///     eccentricity: Of the pitch ellipses.
///     speed_ratio: Greatest speed of the shaft over its least, instead of the eccentricity.
///     moved_distance: Distance a plain shaft shall move the box in the window, mm, instead of both.
///     module: Of the gears, mm.
///     tooth_count: Of each gear.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule.
///
/// >>> import centrode as ct
/// >>> machine = ct.MovingBox(moved_distance=2.05)
/// >>> round(machine.eccentricity, 6), round(machine.moved_in_window, 6)
/// (0.245228, 2.05)
/// >>> round(ct.MovingBox().moved_in_window, 3)  # a plain shaft
/// 3.333
///
/// The tables of its report hold the schemes beside a plain shaft, and the forces beside those by the paper's equations.
///
/// >>> report = ct.MovingBox(moved_distance=2.05).check()
/// >>> table = report.tables[0]
/// >>> [(name, round(row[0], 4)) for name, row in table.rows.items()]
/// [('plain shaft', 3.3333), ('the groove alone', 3.3333), ('the gears alone', 2.05), ('as designed', 2.05)]
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct MovingBox(Arc<mechanism::MovingBox>);

impl Class for MovingBox {
    type Machine = mechanism::MovingBox;

    fn of(machine: Arc<mechanism::MovingBox>) -> Self {
        Self(machine)
    }

    fn machine(&self) -> &Arc<mechanism::MovingBox> {
        &self.0
    }
}

#[pymethods]
impl MovingBox {
    #[new]
    #[pyo3(signature = (shaft=None, *, scheme=None, eccentricity=None, speed_ratio=None, moved_distance=None, module=2.25, tooth_count=Count::Fits(23), name="moving-box", title=""), text_signature = "(shaft=None, *, scheme=None, eccentricity=None, speed_ratio=None, moved_distance=None, module=2.25, tooth_count=23, name='moving-box', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        shaft: Option<PyRef<'_, SpiralShaft>>,
        scheme: Option<&str>,
        eccentricity: Option<f64>,
        speed_ratio: Option<f64>,
        moved_distance: Option<f64>,
        module: f64,
        tooth_count: Count,
        name: &str,
        title: &str,
    ) -> Answer<PyClassInitializer<Self>> {
        let mut design = MovingBoxDesign {
            name: name.into(),
            title: title.into(),
            ..MovingBoxDesign::default()
        };
        let mut plain = true;
        if let Some(shaft) = shaft {
            design.shaft = shaft.0.design().clone();
            let (slow, fast) = shaft.0.speed_ratio();
            plain = fast - slow <= 1e-12;
        }
        let given = [eccentricity, speed_ratio, moved_distance];
        let geared = given.iter().any(Option::is_some);
        design.scheme = match scheme {
            Some(word) => Word::of("scheme", word)?,
            None if !geared => Scheme::Shaft,
            None if plain => Scheme::EllipticGear,
            None => Scheme::Both,
        };
        if geared || design.scheme != Scheme::Shaft {
            design.gears = Some(EllipticGears {
                eccentricity,
                speed_ratio,
                moved_distance,
                module,
                tooth_count: tooth_count.of("gears.tooth_count")?,
                ..EllipticGears::default()
            });
        }
        Self::made(py, design)
    }

    /// What slows the box down: "shaft", "elliptic-gear" or "both".
    #[getter]
    fn scheme(&self) -> &'static str {
        self.0.design().scheme.word()
    }

    /// The shaft.
    #[getter]
    fn shaft(&self, py: Python<'_>) -> Answer<Py<SpiralShaft>> {
        SpiralShaft::object(py, self.0.shaft().clone())
    }

    /// Eccentricity of the gears' pitch ellipses; None without gears.
    #[getter]
    fn eccentricity(&self) -> Option<f64> {
        self.0.drive().map(|drive| drive.eccentricity)
    }

    /// The elliptic gears, cut; None without gears.
    ///
    /// >>> import centrode as ct
    /// >>> ct.MovingBox(speed_ratio=3).gear_pair().check().ok
    /// True
    fn gear_pair(&self, py: Python<'_>) -> Answer<Option<Py<GearPair>>> {
        let machine = &self.0;
        let drive = machine.drive();
        let Some(design) = drive.and_then(|drive| machine.design().gear_pair(drive)) else {
            return Ok(None);
        };
        let pair = wait(py, move || Gears::resolve(&design))??;
        GearPair::object(py, pair).map(Some)
    }

    /// Input turn of the whole way out and back, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.0.motion().period()
    }

    /// Distance the box moves while a seedling is picked on a stroke, mm.
    #[getter]
    fn moved_in_window(&self) -> f64 {
        self.0.moved_in_window()
    }

    /// Angle of the shaft, rad.
    fn shaft_angle(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.shaft_turn(phi).position)
    }

    /// Turn of the shaft per turn of the input.
    fn shaft_speed(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.shaft_turn(phi).velocity)
    }

    /// Place of the box, mm, over the whole way out and back.
    fn position(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.motion().at(phi).position)
    }

    /// Speed of the box, mm/rad.
    fn velocity(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.motion().at(phi).velocity)
    }

    /// Acceleration of the box, mm/rad^2.
    fn acceleration(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.motion().at(phi).acceleration)
    }

    /// Jerk of the box, mm/rad^3.
    fn jerk(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.motion().at(phi).jerk)
    }

    /// Distance a stroke moves the box from one input angle to another, mm, as if it had no end.
    ///
    /// >>> import centrode as ct, math
    /// >>> machine = ct.MovingBox(speed_ratio=3)
    /// >>> round(machine.moved(-math.pi / 6, math.pi / 6), 6)
    /// 1.954217
    fn moved(&self, start: f64, stop: f64) -> Answer<f64> {
        let at = |phi: f64| self.0.stroke_at(phi).position;
        Ok(at(finite("stop", stop)?) - at(finite("start", start)?))
    }

    /// Forces on the slider at the input angles `phi`; the input's speed, mass and frictions stand in for the
    /// design's. The torque is the shaft's.
    #[pyo3(signature = (phi, *, speed_rpm=None, mass=None, groove_friction=None, rail_friction=None))]
    fn force<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        speed_rpm: Option<f64>,
        mass: Option<f64>,
        groove_friction: Option<f64>,
        rail_friction: Option<f64>,
    ) -> Answer<Bound<'py, PyAny>> {
        let given = [speed_rpm, mass, groove_friction, rail_friction];
        forces(py, self.0.shaft().load(), given, |load, part| {
            self.each(phi.clone(), move |m, phi| part(m.force(phi, &load)))
        })
    }
}
