use std::sync::Arc;

use centrode_analysis::with_sound_teeth;
use centrode_kinematics::transmission::Transmission as _;
use centrode_spec::MechanismError;
use centrode_synthesis::reverse::{GearDrive as Found, GearDriveSpec, Timing};
use pyo3::prelude::{Py, PyRef, PyResult, Python, pyclass, pyfunction, pymethods};

use super::Machine;
use crate::array::{Course, Values};
use crate::design::Class;
use crate::error::{Answer, Raised};
use crate::made::{Reduced, by};
use crate::record::Keywords;
use crate::wait::wait;

/// Gears that drive the crank of a machine so that its output meets its goals, found by `gear_drive`.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct GearDrive {
    /// Given, for copies.
    machine: Py<Machine>,
    spec: GearDriveSpec,
    direction_deg: f64,
    timing: Arc<Timing>,
    found: Found,
}

/// Designs the pair of non-circular gears that drives a crank so that the output of the machine meets its goals.
///
/// Goals with over = "deviation" and `uniform` define where the output moves uniformly. Goals with over = "span", maximum
/// and within_deg define where it rests at an end of its stroke. All of them must have one figure. Between these ranges
/// the speed of the crank is free and changes smoothly.
///
/// Args:
///     machine: Machine whose crank turns by law = { ratio = 1 } on a point of the frame; no other body may move by the
///         input.
///     body: Name of the crank.
///     center_distance: Distance of the new shaft from the crank's axis, mm.
///     direction_deg: Direction from the crank's axis to the new shaft, degrees.
///
/// Raises:
///     MechanismError: The body is not a crank, or no gears meet the goals.
///
/// >>> import centrode as ct
/// >>> press = ct.Machine.from_toml('''
/// ... family = "machine"
/// ... frame.points = { O = [0, 0] }
/// ... bodies.crank = { on = "frame.O", law = { ratio = 1 }, points = { A = [30, 0] } }
/// ... [dyads.ram]
/// ... type = "RRP"
/// ... from = "crank.A"
/// ... lengths = [120]
/// ... line = "frame.O"
/// ... line_deg = 0
/// ... side = "forward"
/// ... bodies = ["rod", "ram"]
/// ... joint = "B"
/// ... [goals.steady]
/// ... figure = "ram.travel"
/// ... over = "deviation"
/// ... within_deg = [40, 120]
/// ... uniform = [105, 140]
/// ... maximum = 1e-4
/// ... ''')
/// >>> drive = ct.gear_drive(press, "crank", center_distance=130)
/// >>> drive.miss < 1e-5, drive.law(0.0) < drive.law(0.1)
/// (True, True)
#[pyfunction]
#[pyo3(
    signature = (machine, body="crank", *, center_distance, direction_deg=180.0),
    text_signature = "(machine, body='crank', *, center_distance, direction_deg=180.0)"
)]
pub(crate) fn gear_drive(
    py: Python<'_>,
    machine: PyRef<'_, Machine>,
    body: &str,
    center_distance: f64,
    direction_deg: f64,
) -> Answer<GearDrive> {
    let spec = GearDriveSpec {
        body: body.into(),
        center_distance,
        direction: direction_deg.to_radians(),
    };
    let composed = Arc::clone(machine.machine());
    let requested = spec.clone();
    let found = wait(py, move || Found::new(composed.design(), &requested))??;
    Ok(GearDrive {
        machine: machine.into(),
        spec,
        direction_deg,
        timing: Arc::new(found.timing.clone()),
        found,
    })
}

#[pymethods]
impl GearDrive {
    /// Minimum and maximum ratio: speed of the crank divided by that of the new shaft.
    #[getter]
    fn ratios(&self) -> (f64, f64) {
        let [minimum, maximum] = self.timing.ratios();
        (minimum.value, maximum.value)
    }

    /// Minimum and maximum position of the output, mm or rad.
    #[getter]
    fn places(&self) -> (f64, f64) {
        self.timing.places().into()
    }

    /// Maximum deviation of the output from its exact law, mm or rad, with the law as written in the design.
    #[getter]
    fn miss(&self) -> f64 {
        self.found.miss.value
    }

    /// Minimum convex radii of curvature of both pitch curves, mm: driver and driven gear.
    #[getter]
    fn minimum_radii(&self) -> (f64, f64) {
        self.found.minimum_radii.into()
    }

    /// Angle of the crank as a function of the angle of the new shaft, rad; for an array, an array of the same shape.
    fn law(&self, phi: Values) -> Course {
        let timing = Arc::clone(&self.timing);
        Course::each(phi, move |phi| timing.at(phi).position)
    }

    /// The machine with the drive; its pair has the largest teeth whose flanks alone transmit the motion.
    ///
    /// Raises:
    ///     MechanismError: There are no such teeth, or a part cannot be made.
    fn machine(&self, py: Python<'_>) -> Answer<Py<Machine>> {
        let design = self.found.design.clone();
        let composed = wait(py, move || {
            let (design, _) = with_sound_teeth(&design, |pair| pair == Found::PAIR)?;
            let made = <Machine as Class>::Machine::resolve(&design);
            Ok::<_, Raised>(made.map_err(MechanismError::from)?)
        })??;
        Machine::object(py, composed)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py)
            .with("machine", &self.machine)?
            .with("body", &self.spec.body)?
            .with("center_distance", self.spec.center_distance)?
            .with("direction_deg", self.direction_deg)?;
        by("gear_drive", keywords)
    }

    fn __repr__(&self) -> String {
        let (minimum, maximum) = self.ratios();
        format!(
            "<GearDrive: body {:?}, center_distance {}, ratio {minimum:.4} to {maximum:.4}>",
            self.spec.body, self.spec.center_distance
        )
    }
}
