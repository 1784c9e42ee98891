use std::sync::Arc;

use centrode_gear::GearPair as Gears;
use centrode_groove as mechanism;
use centrode_groove::{EllipticGears, MovingBoxDesign, Scheme};
use pyo3::prelude::{Bound, Py, PyClassInitializer, PyRef, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use super::{BoxDrive, SpiralShaft};
use crate::array::{Course, Values};
use crate::design::Class;
use crate::error::Answer;
use crate::gear_pair::GearPair;
use crate::keywords::{Call, fill};
use crate::wait::wait;
use crate::word::Word;

/// A seedling box that slows down while a seedling is picked: by its shaft's groove, by elliptic gears, or by both.
///
/// `phi` is the angle of the input: the shaft, or the driving gear if gears drive the shaft. The whole cycle out and back
/// takes `cycle` radians of it.
///
/// Args:
///     shaft: The shaft; default: a plain shaft with the default values of the design.
///     scheme: "shaft", "elliptic-gear" or "both"; default: "shaft" without gears, "elliptic-gear" for gears with a plain
///         shaft, "both" for gears with another shaft.
///     eccentricity: Eccentricity of the pitch ellipses.
///     speed_ratio: Maximum speed of the shaft divided by its minimum speed, instead of the eccentricity.
///     moved_distance: Distance by which a plain shaft must move the box in the picking window, mm, instead of both.
///     module: Module of the gears, mm.
///     tooth_count: Tooth count of each gear.
///     goals: Goals by name, each a dict with the keys of the design file: figure, and minimum, maximum or between, such as
///         {"fast": {"figure": "moved_distance", "maximum": 2.1}}.
///     vary: Numbers that a search may move, with their minimum and maximum, such as {"gears.eccentricity": (0, 0.5)}.
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
/// The tables of its report compare the schemes with a plain shaft, and the forces with those by the equations of the
/// paper.
///
/// >>> report = ct.MovingBox(moved_distance=2.05).check()
/// >>> table = report.tables[0]
/// >>> [(name, round(row[0], 4)) for name, row in table.rows.items()]
/// [('plain shaft', 3.3333), ('groove only', 3.3333), ('gears only', 2.05), ('as designed', 2.05)]
#[pyclass(frozen, extends = BoxDrive, module = "centrode")]
#[derive(Debug)]
pub(crate) struct MovingBox(Arc<mechanism::MovingBox>);

impl Class for MovingBox {
    type Machine = mechanism::MovingBox;

    fn start(machine: Arc<mechanism::MovingBox>) -> PyClassInitializer<Self> {
        BoxDrive::start(&machine).add_subclass(Self(machine))
    }

    fn machine(&self) -> &Arc<mechanism::MovingBox> {
        &self.0
    }
}

#[pymethods]
impl MovingBox {
    #[new]
    #[pyo3(signature = (shaft=None, **keywords), text_signature = "(shaft=None, *, scheme=None, eccentricity=None, speed_ratio=None, moved_distance=None, module=2.25, tooth_count=23, goals=None, vary=None, name='moving-box', title='')")]
    fn new(
        py: Python<'_>,
        shaft: Option<PyRef<'_, SpiralShaft>>,
        keywords: Option<Bound<'_, PyDict>>,
    ) -> Answer<PyClassInitializer<Self>> {
        let call = Call::new("MovingBox.__new__", keywords);
        let (mut design, mut gears) = (MovingBoxDesign::default(), EllipticGears::default());
        fill!(call, design, "": goals, vary, name, title);
        fill!(call, gears, "gears.": eccentricity, speed_ratio, moved_distance, module, tooth_count);
        let scheme = call.optional("scheme", "scheme")?;
        call.end()?;
        let mut plain = true;
        if let Some(shaft) = shaft {
            design.shaft = shaft.0.design().clone();
            let (slow, fast) = shaft.0.speed_ratio();
            plain = fast - slow <= 1e-12;
        }
        let given = [gears.eccentricity, gears.speed_ratio, gears.moved_distance];
        let geared = given.iter().any(Option::is_some);
        design.scheme = scheme.unwrap_or(match (geared, plain) {
            (false, _) => Scheme::Shaft,
            (true, true) => Scheme::EllipticGear,
            (true, false) => Scheme::Both,
        });
        if geared || design.scheme != Scheme::Shaft {
            design.gears = Some(gears);
        }
        Self::made(py, design)
    }

    /// Scheme that slows down the box: "shaft", "elliptic-gear" or "both".
    #[getter]
    fn scheme(&self) -> &'static str {
        self.0.design().scheme.word()
    }

    /// The shaft.
    #[getter]
    fn shaft(&self, py: Python<'_>) -> Answer<Py<SpiralShaft>> {
        SpiralShaft::object(py, self.0.shaft().clone())
    }

    /// Eccentricity of the gears' pitch ellipses; None if the box has no gears.
    #[getter]
    fn eccentricity(&self) -> Option<f64> {
        self.0.drive().map(|drive| drive.eccentricity)
    }

    /// The pair of elliptic gears with finished teeth; None if the box has no gears.
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

    /// Angle of the shaft, rad.
    fn shaft_angle(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.shaft_turn(phi).position)
    }

    /// Ratio of shaft speed to input speed.
    fn shaft_speed(&self, phi: Values) -> Course {
        self.each(phi, |m, phi| m.shaft_turn(phi).velocity)
    }
}
