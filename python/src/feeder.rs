use std::path::PathBuf;
use std::sync::Arc;

use centrode_analysis::check_feeder;
use centrode_export::Bundle;
use centrode_export::feeder as files;
use centrode_mechanism::design::Design;
use centrode_mechanism::feeder as mechanism;
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::array::{Values, each, each_array};
use crate::bundle;
use crate::design::Loaded;
use crate::error::{of_design, of_feeder_files, plain_tolerance};
use crate::format;
use crate::record;
use crate::six_bar::SixBar;
use crate::wait::wait;

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

impl PartialEq for Feeder {
    fn eq(&self, other: &Self) -> bool {
        self.feeder.design() == other.feeder.design()
    }
}

impl Feeder {
    fn bundle(
        &self,
        py: Python<'_>,
        formats: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Bundle> {
        let tolerance = plain_tolerance(tolerance)?;
        let (formats, options) = format::within(tolerance, formats, dxf_version, dxf_curves)?;
        let feeder = Arc::clone(&self.feeder);
        wait(py, move || files::files(&feeder, &formats, &options))?
            .map_err(|e| of_feeder_files(&e))
    }
}

#[pymethods]
impl Feeder {
    /// The feeder of a design file's text.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Loaded::read(py, text.as_bytes())?.feeder()
    }

    /// The design file of the feeder; `from_toml` reads it back.
    fn to_toml(&self) -> PyResult<String> {
        let design = Design::Feeder(Box::new(self.feeder.design().clone()));
        design.to_toml().map_err(|e| of_design(&e))
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
        let bundle = self.bundle(py, formats, tolerance, dxf_version, dxf_curves)?;
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
        let bundle = self.bundle(py, formats, tolerance, dxf_version, dxf_curves)?;
        bundle::written(py, &bundle, &directory)
    }

    fn __repr__(&self) -> String {
        let [crank, coupler, rocker, frame] = self.feeder.six_bar().four_bar().lengths();
        format!(
            "Feeder({:?}, crank={crank:?}, coupler={coupler:?}, rocker={rocker:?}, frame={frame:?})",
            self.feeder.design().name
        )
    }
}
