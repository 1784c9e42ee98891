use std::path::PathBuf;
use std::sync::Arc;

use centrode_analysis::check_shaft;
use centrode_mechanism::cam::law::LawSpec;
use centrode_mechanism::design::Design as _;
use centrode_mechanism::shaft as mechanism;
use centrode_mechanism::shaft::{
    GrooveSpec, Load, RotatedSine, Sine, SpeedFormula, SpeedLaw, SpeedTable, SpiralShaftDesign,
    Wall,
};
use centrode_mechanism::transmission::Transmission;
use numpy::PyArray2;
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::array::{Numbers, Values, each, points, rows};
use crate::bundle;
use crate::count::Count;
use crate::design::Class;
use crate::error::{finite, of_design, of_shaft, plain_tolerance, unknown_word};
use crate::made::{Reduced, by_design};
use crate::record;
use crate::wait::wait;

/// A variable-speed spiral shaft: the slider's law, the groove out and back, the forces on the slider.
///
/// `theta` is the shaft's angle: 0 where the slider leaves the first hole. A whole way out and back takes
/// `cycle` radians.
///
/// Args:
///     lead: Distance of neighbouring holes, mm a turn.
///     holes: Holes across the box.
///     radius: Radius of the shaft, mm.
///     amplitude: Amplitude of the sine, mm; 0 for a plain shaft.
///     harmonic: Slow places a turn.
///     phase: Shaft angle of a slow place, rad.
///     rotated: Whether the sine is turned onto the helix, equations (3) to (5) of the paper of 2018, instead of
///         being the integral of the speed.
///     speed: Speeds over equal steps of a turn instead of a sine; only their ratios count.
///     expression: A formula for the speed in `phi`, instead of a sine.
///     window: Shaft turn during which a seedling is picked, rad.
///     pick: Shaft angle in the middle of the first picking, rad.
///     pot_width: mm; the box may move by a sixth of it while a seedling is picked.
///     reversal_angle: Shaft turn of one reversal, rad: whole half turns.
///     reversal_law: How the speed changes sign: a motion law by its name, such as "harmonic" or "cycloidal".
///     return_offset: How far the return groove runs beside the forward one, mm.
///     groove_width: mm, along the normal on the surface.
///     groove_depth: mm.
///     slider_length: mm, over its round ends.
///     slider_clearance: How much narrower than the groove the slider is, mm.
///     speed_rpm: Speed of the shaft, turns a minute.
///     mass: Mass moved, kg.
///     groove_friction: Coefficient between slider and groove.
///     rail_friction: Coefficient between box and rails.
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
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct SpiralShaft {
    pub(crate) shaft: Arc<mechanism::SpiralShaft>,
}

impl Class for SpiralShaft {
    type Mechanism = mechanism::SpiralShaft;

    fn of(shaft: Arc<mechanism::SpiralShaft>) -> Self {
        Self { shaft }
    }
}

impl PartialEq for SpiralShaft {
    fn eq(&self, other: &Self) -> bool {
        self.shaft.design() == other.shaft.design()
    }
}

impl SpiralShaft {
    fn resolve(py: Python<'_>, design: SpiralShaftDesign) -> PyResult<Self> {
        let shaft = wait(py, move || mechanism::SpiralShaft::resolve(&design))?;
        let shaft = Arc::new(shaft.map_err(|e| of_shaft(&e))?);
        Ok(Self { shaft })
    }

    /// A function of the shaft's angle, for one angle or many.
    fn over<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        f: impl Fn(&mechanism::SpiralShaft, f64) -> f64 + Send + 'static,
    ) -> PyResult<Bound<'py, PyAny>> {
        let shaft = Arc::clone(&self.shaft);
        each(py, theta, move |theta| f(&shaft, theta))
    }
}

/// The design that keywords describe, its law left as it is by default.
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
fn design(
    lead: f64,
    holes: Count,
    radius: f64,
    reversal_angle: Option<f64>,
    reversal_law: &str,
    return_offset: f64,
    groove: [f64; 2],
    slider: [Option<f64>; 2],
    load: Load,
    [window, pick, pot_width]: [f64; 3],
    name: &str,
    title: &str,
) -> PyResult<SpiralShaftDesign> {
    let mut design = SpiralShaftDesign {
        name: name.into(),
        title: title.into(),
        lead,
        holes: holes.of("holes")?,
        radius,
        window,
        pick,
        pot_width,
        return_offset,
        groove: GrooveSpec {
            width: groove[0],
            depth: groove[1],
        },
        load,
        ..SpiralShaftDesign::default()
    };
    if let Some(angle) = reversal_angle {
        design.reversal.angle = angle;
    }
    design.reversal.law = LawSpec::named(reversal_law).ok_or_else(|| {
        let known = LawSpec::NAMED.map(|(name, _)| name);
        unknown_word("reversal.law", reversal_law, &known)
    })?;
    if let Some(length) = slider[0] {
        design.slider.length = length;
    }
    if let Some(clearance) = slider[1] {
        design.slider.clearance = clearance;
    }
    Ok(design)
}

/// Vertices of a mesh, (V, 3), and its faces, (F, 3).
type Arrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>);

#[pymethods]
impl SpiralShaft {
    #[new]
    #[pyo3(signature = (*, lead=20.0, holes=Count::Fits(14), radius=15.0, amplitude=0.0, harmonic=Count::Fits(1), phase=0.0, rotated=false, speed=None, expression=None, window=std::f64::consts::FRAC_PI_3, pick=0.0, pot_width=18.0, reversal_angle=None, reversal_law="harmonic", return_offset=0.0, groove_width=10.0, groove_depth=4.0, slider_length=None, slider_clearance=None, speed_rpm=200.0, mass=10.0, groove_friction=0.10, rail_friction=0.15, name="spiral-shaft", title=""), text_signature = "(*, lead=20.0, holes=14, radius=15.0, amplitude=0.0, harmonic=1, phase=0.0, rotated=False, speed=None, expression=None, window=1.0471975511965976, pick=0.0, pot_width=18.0, reversal_angle=None, reversal_law='harmonic', return_offset=0.0, groove_width=10.0, groove_depth=4.0, slider_length=None, slider_clearance=None, speed_rpm=200.0, mass=10.0, groove_friction=0.1, rail_friction=0.15, name='spiral-shaft', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        lead: f64,
        holes: Count,
        radius: f64,
        amplitude: f64,
        harmonic: Count,
        phase: f64,
        rotated: bool,
        speed: Option<Numbers>,
        expression: Option<String>,
        window: f64,
        pick: f64,
        pot_width: f64,
        reversal_angle: Option<f64>,
        reversal_law: &str,
        return_offset: f64,
        groove_width: f64,
        groove_depth: f64,
        slider_length: Option<f64>,
        slider_clearance: Option<f64>,
        speed_rpm: f64,
        mass: f64,
        groove_friction: f64,
        rail_friction: f64,
        name: &str,
        title: &str,
    ) -> PyResult<Self> {
        let mut design = design(
            lead,
            holes,
            radius,
            reversal_angle,
            reversal_law,
            return_offset,
            [groove_width, groove_depth],
            [slider_length, slider_clearance],
            Load {
                speed_rpm,
                mass,
                groove_friction,
                rail_friction,
            },
            [window, pick, pot_width],
            name,
            title,
        )?;
        let harmonic = harmonic.of("law.harmonic")?;
        design.law = match (speed, expression) {
            (Some(speed), _) => SpeedLaw::Table(SpeedTable {
                speed: speed.into_vec(),
                interpolation: None,
            }),
            (None, Some(expression)) => SpeedLaw::Formula(SpeedFormula { expression }),
            (None, None) if rotated => SpeedLaw::RotatedSine(RotatedSine {
                amplitude,
                harmonic,
                phase,
            }),
            (None, None) => SpeedLaw::Sine(Sine {
                amplitude,
                harmonic,
                phase,
            }),
        };
        Self::resolve(py, design)
    }

    /// The shaft whose box moves `moved_distance` (mm) in the picking window: its amplitude is solved.
    ///
    /// >>> import centrode as ct
    /// >>> shaft = ct.SpiralShaft.for_moved_distance(2.05, lead=20)
    /// >>> round(shaft.amplitude, 6)
    /// 1.283333
    /// >>> round(shaft.speed_ratio[0], 6)  # least speed over the mean
    /// 0.596829
    #[staticmethod]
    #[pyo3(signature = (moved_distance, *, window=std::f64::consts::FRAC_PI_3, lead=20.0, holes=Count::Fits(14), radius=15.0, harmonic=Count::Fits(1), pick=0.0, pot_width=18.0, reversal_angle=None, reversal_law="harmonic", return_offset=0.0, groove_width=10.0, groove_depth=4.0, slider_length=None, slider_clearance=None, speed_rpm=200.0, mass=10.0, groove_friction=0.10, rail_friction=0.15, name="spiral-shaft", title=""), text_signature = "(moved_distance, *, window=1.0471975511965976, lead=20.0, holes=14, radius=15.0, harmonic=1, pick=0.0, pot_width=18.0, reversal_angle=None, reversal_law='harmonic', return_offset=0.0, groove_width=10.0, groove_depth=4.0, slider_length=None, slider_clearance=None, speed_rpm=200.0, mass=10.0, groove_friction=0.1, rail_friction=0.15, name='spiral-shaft', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn for_moved_distance(
        py: Python<'_>,
        moved_distance: f64,
        window: f64,
        lead: f64,
        holes: Count,
        radius: f64,
        harmonic: Count,
        pick: f64,
        pot_width: f64,
        reversal_angle: Option<f64>,
        reversal_law: &str,
        return_offset: f64,
        groove_width: f64,
        groove_depth: f64,
        slider_length: Option<f64>,
        slider_clearance: Option<f64>,
        speed_rpm: f64,
        mass: f64,
        groove_friction: f64,
        rail_friction: f64,
        name: &str,
        title: &str,
    ) -> PyResult<Self> {
        let mut design = design(
            lead,
            holes,
            radius,
            reversal_angle,
            reversal_law,
            return_offset,
            [groove_width, groove_depth],
            [slider_length, slider_clearance],
            Load {
                speed_rpm,
                mass,
                groove_friction,
                rail_friction,
            },
            [window, pick, pot_width],
            name,
            title,
        )?;
        design.moved_distance = Some(moved_distance);
        design.law = SpeedLaw::Sine(Sine {
            amplitude: 0.0,
            harmonic: harmonic.of("law.harmonic")?,
            phase: pick,
        });
        Self::resolve(py, design)
    }

    /// The shaft of a design file's text.
    ///
    /// >>> import centrode as ct
    /// >>> ct.SpiralShaft.from_toml(ct.template("spiral-shaft")).check().ok
    /// True
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Class::read(py, text)
    }

    /// The design file of the shaft; `from_toml` reads it back.
    fn to_toml(&self) -> PyResult<String> {
        self.shaft.design().to_toml().map_err(|e| of_design(&e))
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        self.shaft.name()
    }

    /// Title, as written in the design.
    #[getter]
    fn title(&self) -> &str {
        self.shaft.title()
    }

    /// Lead, mm a turn.
    #[getter]
    fn lead(&self) -> f64 {
        self.shaft.law().lead()
    }

    /// Shaft turn during which a seedling is picked, rad.
    #[getter]
    fn window(&self) -> f64 {
        self.shaft.design().window
    }

    /// Shaft angle in the middle of the first picking, rad.
    #[getter]
    fn pick(&self) -> f64 {
        self.shaft.design().pick
    }

    /// Amplitude of the sine, mm; None for another law.
    #[getter]
    fn amplitude(&self) -> Option<f64> {
        self.shaft.amplitude()
    }

    /// Shaft turn of the whole way out and back, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.shaft.cycle()
    }

    /// Least and greatest speed of the strokes over their mean.
    #[getter]
    fn speed_ratio(&self) -> (f64, f64) {
        self.shaft.speed_ratio()
    }

    /// Distance the box moves while a seedling is picked on a stroke, mm.
    #[getter]
    fn moved_in_window(&self) -> f64 {
        self.shaft.moved_in_window()
    }

    /// Place of the slider, mm, over the whole way out and back.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> shaft = ct.SpiralShaft(amplitude=1.28)
    /// >>> shaft.position(2 * np.pi * np.arange(3)).round(9).tolist()
    /// [0.0, 20.0, 40.0]
    fn position<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.traverse().at(t).position)
    }

    /// Speed of the slider, mm/rad.
    fn velocity<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.traverse().at(t).velocity)
    }

    /// Acceleration of the slider, mm/rad^2.
    fn acceleration<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.traverse().at(t).acceleration)
    }

    /// Jerk of the slider, mm/rad^3.
    fn jerk<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.traverse().at(t).jerk)
    }

    /// Distance moved by a stroke from one shaft angle to another, mm, as if the stroke had no end.
    fn moved(&self, start: f64, stop: f64) -> PyResult<f64> {
        let (start, stop) = (finite("start", start)?, finite("stop", stop)?);
        Ok(self.shaft.law().moved(start, stop))
    }

    /// Lead angle of the groove on the shaft's surface, rad; negative on the way back.
    fn lead_angle<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.groove().lead_angle(t))
    }

    /// Curvature of the developed centre line, 1/mm.
    fn curvature<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyAny>> {
        self.over(py, theta, |s, t| s.groove().curvature(t))
    }

    /// The developed groove: "center", "left" and "right" wall, each (N, 2), mm, not wrapped round.
    ///
    /// Along x the arc R theta, along y the place on the shaft; polylines within `tolerance` (mm).
    ///
    /// >>> import centrode as ct
    /// >>> developed = ct.SpiralShaft(amplitude=1.28).developed(0.01)
    /// >>> sorted(developed)
    /// ['center', 'left', 'right']
    #[pyo3(signature = (tolerance=1e-3))]
    fn developed<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<Bound<'py, PyDict>> {
        let tolerance = plain_tolerance(tolerance)?;
        let shaft = Arc::clone(&self.shaft);
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
            developed.set_item(name, points(py, way)?)?;
        }
        Ok(developed)
    }

    /// Forces on the slider at the shaft angles `theta`; speed, mass and frictions stand in for the design's.
    ///
    /// >>> import centrode as ct
    /// >>> shaft = ct.SpiralShaft.for_moved_distance(2.05)
    /// >>> force = shaft.force(0.0, speed_rpm=200, mass=10, groove_friction=0.10, rail_friction=0.15)
    /// >>> round(force.normal, 6)
    /// 15.022814
    #[pyo3(signature = (theta, *, speed_rpm=None, mass=None, groove_friction=None, rail_friction=None))]
    fn force<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        speed_rpm: Option<f64>,
        mass: Option<f64>,
        groove_friction: Option<f64>,
        rail_friction: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let usual = self.shaft.load();
        let load = Load {
            speed_rpm: speed_rpm.unwrap_or(usual.speed_rpm),
            mass: mass.unwrap_or(usual.mass),
            groove_friction: groove_friction.unwrap_or(usual.groove_friction),
            rail_friction: rail_friction.unwrap_or(usual.rail_friction),
        };
        load.validate().map_err(|e| of_shaft(&e.into()))?;
        let part = |of: fn(mechanism::SliderForce) -> f64| {
            self.over(py, theta.clone(), move |s, t| of(s.force(t, &load)))
        };
        let parts = [
            part(|f| f.normal)?,
            part(|f| f.transverse)?,
            part(|f| f.torque)?,
            part(|f| f.push)?,
        ];
        record::slider_force(py, parts)
    }

    /// Crossings of the groove with itself, (N, 4): shaft angle out, shaft angle back, place (mm), and the
    /// length without walls (mm) a slider must bridge.
    ///
    /// >>> import centrode as ct
    /// >>> crossings = ct.SpiralShaft.for_moved_distance(2.05).crossings()
    /// >>> len(crossings), round(float(crossings[:, 3].max()), 1)
    /// (27, 40.1)
    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let crossings = self.shaft.groove().crossings();
        rows(
            py,
            crossings
                .iter()
                .map(|c| [c.out, c.back, c.position, c.gap])
                .collect::<Vec<_>>()
                .into_iter(),
        )
    }

    /// The shaft as a closed triangle mesh: vertices (V, 3), mm, and faces (F, 3), counter-clockwise outside.
    ///
    /// The shaft lies along z; z = 0 is where the slider is at the first hole.
    #[pyo3(signature = (tolerance=1e-2))]
    fn mesh<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<Arrays<'py>> {
        let tolerance = plain_tolerance(tolerance)?;
        let shaft = Arc::clone(&self.shaft);
        let mesh = wait(py, move || shaft.mesh(tolerance))?.map_err(|e| of_shaft(&e))?;
        Ok((
            rows(py, mesh.vertices.into_iter())?,
            rows(py, mesh.faces.into_iter())?,
        ))
    }

    /// Checks what the box moves while picking, the groove's crossings, the slider and the forces.
    ///
    /// >>> import centrode as ct
    /// >>> report = ct.SpiralShaft.for_moved_distance(2.05).check()
    /// >>> [finding.rule for finding in report.findings]
    /// ['slider-tilts', 'crossing-while-picking', 'flat-slider']
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let shaft = Arc::clone(&self.shaft);
        let report = wait(py, move || check_shaft(&shaft))?;
        record::report(py, &report)
    }

    /// The files of the shaft, name to contents, without writing them; `export` writes them.
    ///
    /// >>> import centrode as ct
    /// >>> sorted(ct.SpiralShaft(amplitude=1.28).files(formats=["stl"], tolerance=0.1))
    /// ['shaft.stl', 'slider.stl']
    #[pyo3(signature = (*, formats=None, tolerance=1e-2, dxf_version="R2010", dxf_curves="arcs"))]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let bundle = bundle::of(py, &self.shaft, formats, tolerance, dxf_version, dxf_curves)?;
        bundle::contents(py, &bundle)
    }

    /// Writes the shaft's files into a directory, which is made if it is missing; gives their paths.
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
        let bundle = bundle::of(py, &self.shaft, formats, tolerance, dxf_version, dxf_curves)?;
        bundle::written(py, bundle, directory)
    }

    fn __repr__(&self) -> String {
        let design = self.shaft.design();
        format!(
            "SpiralShaft({:?}, lead={:?}, holes={}, radius={:?})",
            design.name, design.lead, design.holes, design.radius
        )
    }
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by_design(py, self.shaft.design())
    }
}
