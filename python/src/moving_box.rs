use std::path::PathBuf;
use std::sync::Arc;

use centrode_analysis::check_moving_box;
use centrode_mechanism::design::Design as _;
use centrode_mechanism::gear::GearPair as Gears;
use centrode_mechanism::shaft as mechanism;
use centrode_mechanism::shaft::{EllipticGears, Load, MovingBoxDesign, Scheme, SliderForce};
use pyo3::prelude::{Bound, PyAny, PyRef, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::array::{Values, each};
use crate::bundle;
use crate::count::Count;
use crate::design::Class;
use crate::error::{finite, of_design, of_pair, of_shaft, unknown_word};
use crate::gear_pair::GearPair;
use crate::made::{Reduced, by_design};
use crate::record;
use crate::spiral_shaft::SpiralShaft;
use crate::wait::wait;

/// The words for the schemes.
const SCHEMES: [(&str, Scheme); 3] = [
    ("shaft", Scheme::Shaft),
    ("elliptic-gear", Scheme::EllipticGear),
    ("both", Scheme::Both),
];

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
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct MovingBox {
    pub(crate) machine: Arc<mechanism::MovingBox>,
}

impl Class for MovingBox {
    type Mechanism = mechanism::MovingBox;

    fn of(machine: Arc<mechanism::MovingBox>) -> Self {
        Self { machine }
    }
}

impl PartialEq for MovingBox {
    fn eq(&self, other: &Self) -> bool {
        self.machine.design() == other.machine.design()
    }
}

impl MovingBox {
    fn over<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        f: impl Fn(&mechanism::MovingBox, f64) -> f64 + Send + 'static,
    ) -> PyResult<Bound<'py, PyAny>> {
        let machine = Arc::clone(&self.machine);
        each(py, phi, move |phi| f(&machine, phi))
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
    ) -> PyResult<Self> {
        let mut design = MovingBoxDesign {
            name: name.into(),
            title: title.into(),
            ..MovingBoxDesign::default()
        };
        let mut plain = true;
        if let Some(shaft) = shaft {
            design.shaft = shaft.shaft.design().clone();
            let (slow, fast) = shaft.shaft.speed_ratio();
            plain = fast - slow <= 1e-12;
        }
        let given = [eccentricity, speed_ratio, moved_distance];
        let geared = given.iter().any(Option::is_some);
        design.scheme = match scheme {
            Some(word) => {
                let known = SCHEMES.iter().find(|(name, _)| *name == word);
                known
                    .map(|(_, scheme)| *scheme)
                    .ok_or_else(|| unknown_word("scheme", word, &SCHEMES.map(|(name, _)| name)))?
            }
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
        let machine = wait(py, move || mechanism::MovingBox::resolve(&design))?;
        let machine = Arc::new(machine.map_err(|e| of_shaft(&e))?);
        Ok(Self { machine })
    }

    /// The moving box of a design file's text.
    ///
    /// >>> import centrode as ct
    /// >>> ct.MovingBox.from_toml(ct.template("moving-box")).scheme
    /// 'elliptic-gear'
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Class::read(py, text)
    }

    /// The design file of the moving box; `from_toml` reads it back.
    fn to_toml(&self) -> PyResult<String> {
        self.machine.design().to_toml().map_err(|e| of_design(&e))
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        &self.machine.design().name
    }

    /// Title, as written in the design.
    #[getter]
    fn title(&self) -> &str {
        &self.machine.design().title
    }

    /// Scheme that slows the box down: "shaft", "elliptic-gear" or "both".
    #[getter]
    fn scheme(&self) -> &'static str {
        let scheme = self.machine.design().scheme;
        let known = SCHEMES.iter().find(|(_, s)| *s == scheme);
        known.map_or("", |(name, _)| name)
    }

    /// The shaft.
    #[getter]
    fn shaft(&self) -> SpiralShaft {
        SpiralShaft {
            shaft: Arc::new(self.machine.shaft().clone()),
        }
    }

    /// Eccentricity of the gears' pitch ellipses; None without gears.
    #[getter]
    fn eccentricity(&self) -> Option<f64> {
        self.machine.drive().map(|drive| drive.eccentricity)
    }

    /// The elliptic gears, cut; None without gears.
    ///
    /// >>> import centrode as ct
    /// >>> ct.MovingBox(speed_ratio=3).gear_pair().check().ok
    /// True
    fn gear_pair(&self, py: Python<'_>) -> PyResult<Option<GearPair>> {
        let machine = &self.machine;
        let drive = machine.drive();
        let Some(design) = drive.and_then(|drive| machine.design().gear_pair(drive)) else {
            return Ok(None);
        };
        let pair = wait(py, move || Gears::resolve(&design))?.map_err(|e| of_pair(&e))?;
        let pair = Arc::new(pair);
        Ok(Some(GearPair { pair }))
    }

    /// Input turn of the whole way out and back, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.machine.motion().period()
    }

    /// Distance the box moves while a seedling is picked on a stroke, mm.
    #[getter]
    fn moved_in_window(&self) -> f64 {
        self.machine.moved_in_window()
    }

    /// Angle of the shaft, rad.
    fn shaft_angle<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.shaft_turn(phi).position)
    }

    /// Turn of the shaft per turn of the input.
    fn shaft_speed<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.shaft_turn(phi).velocity)
    }

    /// Place of the box, mm, over the whole way out and back.
    fn position<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.motion().at(phi).position)
    }

    /// Speed of the box, mm/rad.
    fn velocity<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.motion().at(phi).velocity)
    }

    /// Acceleration of the box, mm/rad^2.
    fn acceleration<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.motion().at(phi).acceleration)
    }

    /// Jerk of the box, mm/rad^3.
    fn jerk<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, phi, |m, phi| m.motion().at(phi).jerk)
    }

    /// Distance a stroke moves the box from one input angle to another, mm, as if it had no end.
    ///
    /// >>> import centrode as ct, math
    /// >>> machine = ct.MovingBox(speed_ratio=3)
    /// >>> round(machine.moved(-math.pi / 6, math.pi / 6), 6)
    /// 1.954217
    fn moved(&self, start: f64, stop: f64) -> PyResult<f64> {
        let at = |phi: f64| self.machine.stroke_at(phi).position;
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
    ) -> PyResult<Bound<'py, PyAny>> {
        let usual = self.machine.shaft().load();
        let load = Load {
            speed_rpm: speed_rpm.unwrap_or(usual.speed_rpm),
            mass: mass.unwrap_or(usual.mass),
            groove_friction: groove_friction.unwrap_or(usual.groove_friction),
            rail_friction: rail_friction.unwrap_or(usual.rail_friction),
        };
        load.validate().map_err(|e| of_shaft(&e.into()))?;
        let part = |of: fn(SliderForce) -> f64| {
            self.over(py, phi.clone(), move |m, phi| of(m.force(phi, &load)))
        };
        let parts = [
            part(|f| f.normal)?,
            part(|f| f.transverse)?,
            part(|f| f.torque)?,
            part(|f| f.push)?,
        ];
        record::slider_force(py, parts)
    }

    /// Checks the shaft and the box's motion; its tables hold the schemes beside a plain shaft, and the forces
    /// beside those by the paper's equations.
    ///
    /// >>> import centrode as ct
    /// >>> report = ct.MovingBox(moved_distance=2.05).check()
    /// >>> table = report.tables[0]
    /// >>> [(name, round(row[0], 4)) for name, row in table.rows.items()]
    /// [('plain shaft', 3.3333), ('the groove alone', 3.3333), ('the gears alone', 2.05), ('as designed', 2.05)]
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let machine = Arc::clone(&self.machine);
        let report = wait(py, move || check_moving_box(&machine))?;
        record::report(py, &report)
    }

    /// The files of the machine, name to contents, without writing them; `export` writes them.
    #[pyo3(signature = (*, formats=None, tolerance=1e-2, dxf_version="R2010", dxf_curves="arcs"))]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let bundle = bundle::of(
            py,
            &self.machine,
            formats,
            tolerance,
            dxf_version,
            dxf_curves,
        )?;
        bundle::contents(py, &bundle)
    }

    /// Writes the machine's files into a directory, which is made if it is missing; gives their paths.
    ///
    /// Args:
    ///     directory: Where to.
    ///     formats: As of a gear pair; all if left out.
    ///     tolerance: Greatest distance of every point sequence and mesh from the exact surface, mm.
    ///     dxf_version: "R2010" or "R12".
    ///     dxf_curves: "arcs" or "splines".
    ///
    /// Raises:
    ///     ExportError: A file cannot be made or written.
    #[pyo3(signature = (directory, *, formats=None, tolerance=1e-2, dxf_version="R2010", dxf_curves="arcs"))]
    fn export(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        formats: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Vec<PathBuf>> {
        let bundle = bundle::of(
            py,
            &self.machine,
            formats,
            tolerance,
            dxf_version,
            dxf_curves,
        )?;
        bundle::written(py, bundle, directory)
    }

    fn __repr__(&self) -> String {
        format!(
            "MovingBox({:?}, scheme={:?})",
            self.machine.design().name,
            self.scheme()
        )
    }
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by_design(py, self.machine.design())
    }
}
