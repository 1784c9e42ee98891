use std::path::PathBuf;
use std::sync::Arc;

use centrode_analysis::optimise::Settings;
use centrode_analysis::optimise::feeder::Widened;
use centrode_analysis::{FeederForces, Forces, check_feeder};
use centrode_mechanism::design::Design as _;
use centrode_mechanism::feeder as mechanism;
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::array::{Values, each, each_array, together, together_array};
use crate::bundle;
use crate::design::Class;
use crate::error::{no_search, of_design, of_plates};
use crate::made::{Reduced, by_design};
use crate::record;
use crate::search;
use crate::six_bar::SixBar;
use crate::wait::wait;

fn forces(
    feeder: &mechanism::Feeder,
    inputs: &[f64],
    moving: bool,
    carried: Option<f64>,
) -> PyResult<Vec<Forces>> {
    let carried = carried.unwrap_or(feeder.design().drive.carried_mass);
    let system = FeederForces::new(feeder, carried);
    let system = system.map_err(|error| of_plates(&error))?;
    let at = |&input: &f64| system.at(input, moving);
    let all: Result<_, _> = inputs.iter().map(at).collect();
    all.map_err(|error| of_plates(&error))
}

/// A willow-cutting feeder: a picking six-bar that rests while it is filled, driven by an incomplete gear.
///
/// Made by `from_toml` or `load`; `template("feeder")` is a design to start from. The input `phi` is the angle the
/// incomplete gear has turned since the effector left its place under the store, rad; a cycle is one turn.
///
/// >>> import centrode as ct
/// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
/// >>> round(feeder.feed_rate, 4)
/// 55.5556
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Feeder {
    pub(crate) feeder: Arc<mechanism::Feeder>,
}

impl Class for Feeder {
    type Mechanism = mechanism::Feeder;

    fn of(feeder: Arc<mechanism::Feeder>) -> Self {
        Self { feeder }
    }
}

impl PartialEq for Feeder {
    fn eq(&self, other: &Self) -> bool {
        self.feeder.design() == other.feeder.design()
    }
}

#[pymethods]
impl Feeder {
    /// The feeder of a design file's text.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Class::read(py, text)
    }

    /// The design file of the feeder; `from_toml` reads it back.
    fn to_toml(&self) -> PyResult<String> {
        self.feeder.design().to_toml().map_err(|e| of_design(&e))
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        &self.feeder.design().name
    }

    /// Title, as written in the design.
    #[getter]
    fn title(&self) -> &str {
        &self.feeder.design().title
    }

    /// The six-bar.
    ///
    /// >>> import centrode as ct
    /// >>> import math
    /// >>> six = ct.Feeder.from_toml(ct.template("feeder")).six_bar
    /// >>> round(math.degrees(six.least_transmission_angle), 3)
    /// 40.001
    #[getter]
    fn six_bar(&self) -> SixBar {
        SixBar(*self.feeder.six_bar())
    }

    /// The crank's angle at an input, rad.
    fn crank_angle<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        each(py, phi, move |phi| feeder.crank(phi).position)
    }

    /// The effector's angle at an input, rad, without jumps.
    fn effector_angle<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        each(py, phi, move |phi| feeder.effector(phi).position)
    }

    /// The effector's angle and its first three derivatives by the input: an array of the shape of `phi` and then (4,).
    fn effector_motion(&self, py: Python<'_>, phi: Values) -> PyResult<Py<PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        each_array(py, phi, &[4], move |phi| {
            let jet = feeder.effector(phi);
            [jet.position, jet.velocity, jet.acceleration, jet.jerk]
        })
    }

    /// The effector's tip E at an input, mm: an array of the shape of `phi` and then (2,).
    fn tip(&self, py: Python<'_>, phi: Values) -> PyResult<Py<PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        each_array(py, phi, &[2], move |phi| feeder.tip(phi).coords.into())
    }

    /// Speed of the tip at an input and at the design's speed, mm/s.
    fn tip_speed<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        each(py, phi, move |phi| feeder.tip_speed(phi))
    }

    /// Torque the crank needs at an input, N mm, counter-clockwise: the links weigh what their plates do, the y axis points
    /// up, and nothing rubs.
    ///
    /// Args:
    ///     phi: Inputs, rad.
    ///     moving: Whether the links' inertia at the design's speed is counted, or each is held still where it is.
    ///     carried: Mass at the tip of the effector, kg; left out, the design's.
    ///
    /// Raises:
    ///     MechanismError: A link cannot be cut from plate, or what is carried is no mass.
    ///
    /// >>> import centrode as ct
    /// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
    /// >>> feeder.crank_torque([0.0, 1.0], moving=False).round(1)
    /// array([89.4, 86.9])
    #[pyo3(signature = (phi, *, moving=true, carried=None))]
    fn crank_torque<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        moving: bool,
        carried: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        together(py, phi, move |phi| {
            let forces = forces(&feeder, phi, moving, carried)?;
            Ok(forces.iter().map(|f| f.torque).collect())
        })
    }

    /// Forces in the joints at an input, N, with the arguments of `crank_torque`: an array of the shape of `phi` and then
    /// (7, 2). Those on the crank at A, on the coupler at B, on the rocker at D and, from the coupler, at C, on the slider
    /// from the coupler at C, on the effector at F, and on the slider from the slot.
    ///
    /// Raises:
    ///     MechanismError: A link cannot be cut from plate, or what is carried is no mass.
    #[pyo3(signature = (phi, *, moving=true, carried=None))]
    fn joint_forces(
        &self,
        py: Python<'_>,
        phi: Values,
        moving: bool,
        carried: Option<f64>,
    ) -> PyResult<Py<PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        together_array(py, phi, &[7, 2], move |phi| {
            let forces = forces(&feeder, phi, moving, carried)?;
            let flat = |f: &Forces| -> [f64; 14] {
                std::array::from_fn(|i| f.reactions[i / 2].force[i % 2])
            };
            Ok(forces.iter().map(flat).collect())
        })
    }

    /// Crank angle at which the effector rests and is filled, rad.
    #[getter]
    fn start(&self) -> f64 {
        self.feeder.start()
    }

    /// Inputs at which the feed stroke and the return end, rad.
    #[getter]
    fn strokes(&self) -> (f64, f64) {
        let [feed, back] = self.feeder.strokes();
        (feed.to, back.to)
    }

    /// Input angle for which the effector rests in each cycle, rad.
    #[getter]
    fn dwell_angle(&self) -> f64 {
        self.feeder.drive().dwell_angle()
    }

    /// Time for which the effector rests in each cycle, s.
    #[getter]
    fn dwell_time(&self) -> f64 {
        self.feeder.dwell_time()
    }

    /// Speed of the incomplete gear, rad/s.
    #[getter]
    fn speed(&self) -> f64 {
        self.feeder.speed()
    }

    /// Cuttings fed in a minute.
    #[getter]
    fn feed_rate(&self) -> f64 {
        self.feeder.feed_rate()
    }

    /// Checks swing, transmission angle, strokes, dwell and feed rate: each goal met or by how much not.
    ///
    /// >>> import centrode as ct
    /// >>> report = ct.Feeder.from_toml(ct.template("feeder")).check()
    /// >>> report.ok, len(report.goals)
    /// (True, 10)
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let feeder = Arc::clone(&self.feeder);
        let report = wait(py, move || check_feeder(&feeder))?;
        record::report(py, &report)
    }

    /// Searches for better dimensions around this feeder; the table [optimise] of its design says what may move, and
    /// the table [bounds] how far.
    ///
    /// Args:
    ///     method: "guided", "cma-es", "de" or "ga".
    ///     seed: Same seed, same answer, on any number of cores.
    ///     evaluations: Most points looked at; the generation under way is finished.
    ///     population: Points a generation; by the method if left out.
    ///     progress: Called with evaluations, violation and objective of the best so far; False ends the search.
    ///
    /// >>> import centrode as ct
    /// >>> text = ct.template("feeder").replace("transmission_angle_deg = 40", "transmission_angle_deg = 39")
    /// >>> found = ct.Feeder.from_toml(text).optimise("de")
    /// >>> found.ended, abs(found.mechanism.six_bar.swing - 3.141592653589793) < 2e-8
    /// ('target', True)
    #[pyo3(signature = (method="guided", *, seed=1, evaluations=20_000, population=None, progress=None))]
    fn optimise<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        seed: u64,
        evaluations: u64,
        population: Option<usize>,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let settings = Settings {
            seed,
            population,
            evaluations,
            ..Settings::default()
        };
        let design = self.feeder.design();
        search::optimised::<Self>(py, design, method, settings, progress.as_ref())
    }

    /// This feeder with its bounds widened by as little as lets all its goals be reached, its lengths there, and its
    /// pivot in the middle of the places that give its swing; and the share by which they were widened.
    ///
    /// Raises:
    ///     MechanismError: The bounds hold what is wanted, or no widening helps.
    fn widened(&self, py: Python<'_>) -> PyResult<(Self, f64)> {
        let feeder = Arc::clone(&self.feeder);
        let found = wait(py, move || Widened::of(feeder.design()))?;
        let found = found.map_err(|error| no_search(&error.to_string()))?;
        let feeder = mechanism::Feeder::resolve(&found.design);
        let feeder = Arc::new(feeder.map_err(|error| no_search(&error.to_string()))?);
        Ok((Self { feeder }, found.share))
    }

    /// Response of goals and figures to one number of the design: by name, a figure at each value, NaN where there is
    /// no feeder.
    ///
    /// Args:
    ///     parameter: Key of the design file, "linkage.crank", or a dimension's name, "crank" or "pivot_x".
    ///     values: In the file's unit: mm, degrees.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
    /// >>> np.degrees(feeder.response("frame", [129.5, 130])["swing"]).round(3).tolist()
    /// [179.691, 180.225]
    fn response<'py>(
        &self,
        py: Python<'py>,
        parameter: &str,
        values: Vec<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        search::response::<Self>(py, self.feeder.design(), parameter, values, true)
    }

    /// The files of the feeder, name to contents, without writing them; `export` writes them.
    ///
    /// >>> import centrode as ct
    /// >>> sorted(ct.Feeder.from_toml(ct.template("feeder")).files(formats=["stl"]))[:2]
    /// ['coupler.stl', 'crank.stl']
    #[pyo3(signature = (*, formats=None, tolerance=1e-3, dxf_version="R2010", dxf_curves="arcs"))]
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
            &self.feeder,
            formats,
            tolerance,
            dxf_version,
            dxf_curves,
        )?;
        bundle::contents(py, &bundle)
    }

    /// Writes the feeder's files into a directory, which is made if it is missing; gives their paths.
    ///
    /// Args:
    ///     directory: Where to.
    ///     formats: Any of "dxf", "svg", "sheet", "pdf", "step", "stl", "3mf", "csv", "urdf" and "mjcf"; all if left out.
    ///     tolerance: Greatest distance of every arc and mesh from the exact contour, mm.
    ///     dxf_version: "R2010" or "R12".
    ///     dxf_curves: "arcs" or "splines".
    ///
    /// Raises:
    ///     ExportError: A file cannot be made or written.
    #[pyo3(signature = (directory, *, formats=None, tolerance=1e-3, dxf_version="R2010", dxf_curves="arcs"))]
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
            &self.feeder,
            formats,
            tolerance,
            dxf_version,
            dxf_curves,
        )?;
        bundle::written(py, bundle, directory)
    }

    fn __repr__(&self) -> String {
        let [crank, coupler, rocker, frame] = self.feeder.six_bar().four_bar().lengths();
        format!(
            "Feeder({:?}, crank={crank:?}, coupler={coupler:?}, rocker={rocker:?}, frame={frame:?})",
            self.feeder.design().name
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by_design(py, self.feeder.design())
    }
}
