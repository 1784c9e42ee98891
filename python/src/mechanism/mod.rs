//! All that machines of every family can do.

mod held;

use std::path::PathBuf;
use std::sync::Arc;

use centrode_export::ExportError;
use centrode_optimise::Settings;
use pyo3::prelude::{
    Bound, PyAny, PyAnyMethods, PyDictMethods, PyResult, PyTypeMethods, Python, pymethods,
};
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::array::{Course, Values};
use crate::design::{object, of_class, path_loaded, read};
use crate::error::{Answer, tolerance as within};
use crate::forces::Names;
use crate::made::{Reduced, by_design};
use crate::word::Word;
use crate::{files, record, search, solid};

pub(crate) use held::Mechanism;

#[pymethods]
impl Mechanism {
    /// The machine of a design file's text, if it is of this class.
    ///
    /// Raises:
    ///     DesignError: The design breaks a rule, or is of another family; its `key`, `line` and `column` give the position.
    ///
    /// >>> import centrode as ct
    /// >>> ct.GearPair.from_toml(ct.template("gear-pair")).driver.tooth_count
    /// 23
    /// >>> ct.ThreeArm.from_toml(ct.template("three-arm")).arms
    /// 3
    /// >>> ct.MovingBox.from_toml(ct.template("moving-box")).scheme
    /// 'elliptic-gear'
    #[classmethod]
    fn from_toml<'py>(cls: &Bound<'py, PyType>, text: &str) -> Answer<Bound<'py, PyAny>> {
        let py = cls.py();
        let machine = object(py, &read(py, text.as_bytes())?)?;
        of_class(cls, machine)
    }

    /// The machine of a design file, if it is of this class.
    ///
    /// Raises:
    ///     DesignError: The design breaks a rule, or is of another family.
    ///     OSError: The file cannot be read.
    #[classmethod]
    fn load<'py>(cls: &Bound<'py, PyType>, path: PathBuf) -> Answer<Bound<'py, PyAny>> {
        of_class(cls, path_loaded(cls.py(), path)?)
    }

    /// The design file of the machine; `from_toml` reads it back.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> print(pair.to_toml()[:21])
    /// family = "gear-pair"
    /// <BLANKLINE>
    fn to_toml(&self) -> Answer<String> {
        Ok(self.0.design().to_toml()?)
    }

    /// Name in the design.
    #[getter]
    fn name(&self) -> &str {
        self.0.design().name()
    }

    /// Title in the design.
    #[getter]
    fn title(&self) -> &str {
        self.0.design().title()
    }

    /// Description of the machine in one line.
    #[getter]
    fn definition(&self) -> String {
        self.0.definition()
    }

    /// Runs the complete check of the machine: figures, findings, goals.
    ///
    /// >>> import centrode as ct
    /// >>> report = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23)).check()
    /// >>> report.ok
    /// True
    /// >>> report.values["transmission_error_max"] < 1e-8
    /// True
    /// >>> report = ct.SpiralShaft.for_moved_distance(2.05).check()
    /// >>> [finding.rule for finding in report.findings]
    /// ['slider-tilts', 'crossing-while-picking', 'flat-slider']
    /// >>> report = ct.Feeder.from_toml(ct.template("feeder")).check()
    /// >>> report.ok, len(report.goals)
    /// (True, 10)
    fn check<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyAny>> {
        let report = self.ask(py, |machine| machine.check())?;
        Ok(record::report(py, &report, self.0.design())?)
    }

    /// Writes a certificate of the contact of a gear pair at every driver angle, as `centrode prove` does; returns the
    /// path.
    ///
    /// The certificate is only a claim; `tools/proof_checker.py` proves or rejects it. If the gears lose contact
    /// somewhere in the cycle, there is no certificate, and the error states the position.
    ///
    /// Args:
    ///     path: File to write.
    ///     pair: Name of a pair of the machine; default: its only pair.
    ///
    /// Raises:
    ///     MechanismError: There is no such pair, there are several, or the pair has no certificate.
    ///
    /// >>> import centrode as ct, json, pathlib, tempfile
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> with tempfile.TemporaryDirectory() as directory:
    /// ...     json.loads(pair.prove(pathlib.Path(directory, "pair.proof")).read_text())["half_width"]
    /// 4e-10
    #[pyo3(signature = (path, *, pair=None))]
    fn prove(&self, py: Python<'_>, path: PathBuf, pair: Option<String>) -> Answer<PathBuf> {
        let proof = self.ask(py, move |machine| machine.proof(pair.as_deref()))??;
        files::_write(py, path, proof.file().map_err(ExportError::from)?)
    }

    /// The goals, each with figure, range, margin and progress; empty for a family without goals.
    ///
    /// >>> import centrode as ct
    /// >>> goals = ct.ThreeArm.from_toml(ct.template("three-arm")).goals()
    /// >>> print(goals[1])
    /// goal 2: clamp above horizontal at picking 0.0107538 rad, met
    fn goals<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyTuple>> {
        let report = self.ask(py, |machine| machine.check_motion())?;
        Ok(record::goals(py, &report.goals)?)
    }

    /// The table of motion at inputs (rad): each column by its heading, of the shape of `phi`.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), mean_ratio=(2, 1))
    /// >>> pair.motion([1.0, 2.0])["driven_angle_rad"].round(12)
    /// array([0.5, 1. ])
    fn motion<'py>(&self, py: Python<'py>, phi: Values) -> Answer<Bound<'py, PyDict>> {
        let machine = self.links(py)?;
        let columns = PyDict::new(py);
        for (index, column) in machine.columns.iter().enumerate() {
            let machine = Arc::clone(&machine);
            let value = move |phi| machine.value(&machine.columns[index].quantity, phi);
            columns.set_item(&column.name, Course::each(phi.clone(), value))?;
        }
        Ok(columns)
    }

    /// Poses of all links at inputs (rad), in the frame of the first link: for each name an array of the shape of `phi`
    /// and then (4, 4), lengths in mm.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> pair.frames(0.0)["driven"][:3, 3].round(9)
    /// array([40.,  0.,  0.])
    fn frames<'py>(&self, py: Python<'py>, phi: Values) -> Answer<Bound<'py, PyDict>> {
        self.framed(py, phi)
    }

    /// Forces at inputs (rad) that turn at constant speed: the torque of the input and the forces on joints, pins,
    /// rollers and teeth.
    ///
    /// The links have the mass of their bodies, and the loads of the design are included. Wear and backlash are not
    /// included; friction is included only in grooves and on rails.
    ///
    /// Args:
    ///     phi: Inputs, rad.
    ///     speed: Speed of the input, rad/s; default: the design's, or 1 if the design gives none. Zero: at rest.
    ///
    /// Raises:
    ///     MechanismError: A part cannot be made, a link is held more than once, or no force balances the load.
    ///
    /// >>> import centrode as ct
    /// >>> forces = ct.Feeder.from_toml(ct.template("feeder")).forces([0.0, 1.0], speed=0)
    /// >>> forces.drives["crank_joint"].round(1)
    /// array([93.7, 79.8])
    /// >>> forces.joints["coupler_joint"].shape
    /// (2, 2)
    #[pyo3(signature = (phi, *, speed=None))]
    fn forces<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        speed: Option<f64>,
    ) -> Answer<Bound<'py, PyAny>> {
        self.forces_by(py, phi, speed, Names::OF_LINKS)
    }

    /// The parts to make or buy for the machine, in the order of its parts list.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> print(*pair.parts(), sep="\n")
    /// 1 x Driver gear, 20 teeth
    /// 1 x Driven gear, 20 teeth
    fn parts<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyTuple>> {
        let machine = self.links(py)?;
        Ok(record::parts(py, &machine)?)
    }

    /// The parts that are straight extrusions, by the names of their files, with exact edges and heights, for CAD
    /// kernels.
    ///
    /// Args:
    ///     parts: Names of parts, as in their file names; default: all.
    ///     tolerance: Sides shorter than this, mm, are removed, because a CAD kernel treats them as points.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> {name: len(solid.contours) for name, solid in pair.solids().items()}
    /// {'driver': 1, 'driven': 1}
    #[pyo3(signature = (*, parts=None, tolerance=1e-6))]
    fn solids<'py>(
        &self,
        py: Python<'py>,
        parts: Option<Vec<String>>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyDict>> {
        self.kept_solids(py, parts, tolerance)
    }

    /// The links with their bodies and the joints that carry them; each link comes after the link that carries it.
    ///
    /// Args:
    ///     tolerance: As for `solids`.
    ///     bodies: Whether to include the bodies, which takes longer.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> [(link.name, link.joint and link.joint.kind) for link in pair.links()]
    /// [('base', None), ('driver', 'turning'), ('driven', 'turning')]
    #[pyo3(name = "links", signature = (tolerance=1e-6, *, bodies=true))]
    fn linked<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
        bodies: bool,
    ) -> Answer<Bound<'py, PyTuple>> {
        let shortest = within(tolerance, self.0.accuracy())?;
        solid::links(py, &*self.links(py)?, bodies.then_some(shortest))
    }

    /// Searches for a better machine, starting from this one. The table [optimise] of the design lists the parameters
    /// that may change; a table [bounds], if present, gives their bounds.
    ///
    /// Args:
    ///     method: "guided", "cma-es", "de" or "ga".
    ///     seed: Random seed; one seed gives the same result on any number of cores.
    ///     evaluations: Maximum number of points evaluated; the current generation is finished.
    ///     population: Points per generation; default: depends on the method.
    ///     progress: Called with the number of evaluations, and violation and objective of the best point; False ends the
    ///         search.
    ///
    /// Raises:
    ///     MechanismError: There is no search for such a design.
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
    ) -> Answer<Bound<'py, PyAny>> {
        let settings = Settings {
            seed,
            population,
            evaluations,
            ..Settings::default()
        };
        let strategy = Word::of("method", method)?;
        let (family, machine) = (*self.family()?, Arc::clone(&self.0));
        search::optimised(py, family, machine, strategy, settings, progress.as_ref())
    }

    /// Response of goals and figures to one number of the design: for each name, the figure at each value; NaN if there
    /// is no machine.
    ///
    /// Args:
    ///     parameter: Key in the design file, such as "arm.tip_distance", or name of a parameter, such as "r1", "crank"
    ///         or "pivot_x".
    ///     values: Values of the parameter in the unit of the design file: mm, degrees.
    ///     depth: Depth of the check at every value: "motion" (goals and figures that need no teeth), "made" (for a gear
    ///         pair also its teeth as cut) or "whole" (everything that `check` reports).
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.response("r1", [15, 21, 27])["trajectory-height"].round(1).tolist()
    /// [377.8, 370.8, 363.1]
    /// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
    /// >>> np.degrees(feeder.response("frame", [129.5, 130])["swing"]).round(3).tolist()
    /// [179.691, 180.225]
    #[pyo3(signature = (parameter, values, *, depth="motion"))]
    fn response<'py>(
        &self,
        py: Python<'py>,
        parameter: &str,
        values: Vec<f64>,
        depth: &str,
    ) -> Answer<Bound<'py, PyDict>> {
        self.answers(py, parameter, values, Word::of("depth", depth)?)
    }

    /// The contents of the files of the machine, by file name, without writing them; `export` writes them.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> sorted(pair.files(formats=["stl"]))
    /// ['driven.stl', 'driver.stl']
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> list(arms.files(formats=["dxf"], parts=["sun", "cam"]))
    /// ['sun.dxf', 'cam.dxf']
    /// >>> sorted(ct.SpiralShaft(amplitude=1.28).files(formats=["stl"], tolerance=0.1))
    /// ['pin.stl', 'shaft.stl', 'slider.stl']
    /// >>> sorted(ct.Feeder.from_toml(ct.template("feeder")).files(formats=["stl"]))[:2]
    /// ['coupler.stl', 'crank.stl']
    #[pyo3(signature = (*, formats=None, parts=None, tolerance=None, dxf_version="R2010", dxf_curves="arcs", layers="cut", kerf=None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<files::Named>,
        parts: Option<Vec<String>>,
        tolerance: Option<f64>,
        dxf_version: &str,
        dxf_curves: &str,
        layers: &str,
        kerf: Option<f64>,
    ) -> Answer<Bound<'py, PyDict>> {
        let written = [dxf_version, dxf_curves, layers];
        let bundle = self.bundle(py, formats, parts, tolerance, written, kerf)?;
        Ok(files::contents(py, &bundle)?)
    }

    /// Writes the files of the machine into a directory, which is created if it does not exist; returns their paths.
    ///
    /// Every part is written once, also if the machine has several of it. Every file is written completely or not at all,
    /// and is the same in every run.
    ///
    /// Args:
    ///     directory: Directory for the files.
    ///     formats: Any of "dxf", "svg", "sheet", "pdf", "stl", "step", "3mf", "csv", "urdf" and "mjcf", or the name of a
    ///         receiver: "laser", "print", "cad", "drawing" or "simulation", or "all". Default: "dxf", "svg", "pdf",
    ///         "step" and "3mf".
    ///     parts: Names of parts, as in their file names, or "assembly"; default: all. Motion and simulator models are
    ///         always of the whole machine. Not for a family whose parts have no names.
    ///     tolerance: Maximum distance of every arc, point sequence and mesh from the exact curve or surface, mm;
    ///         default: 1e-3, and 0.01 for "print".
    ///     dxf_version: "R2010" or "R12".
    ///     dxf_curves: "arcs", "splines" or "chords" (straight lines within the tolerance).
    ///     layers: "cut", only the contours to cut; or "all", in drawings of parts also reference curves, which do not
    ///         plot.
    ///     kerf: Width of the cut, mm: moves the contours of the cutting files outwards by half of it, and holes inwards;
    ///         default: that of the design, otherwise 0.
    ///     force: Whether to replace also files in the directory that are not from an export, or that were changed since.
    ///
    /// Raises:
    ///     ExportError: A part does not exist, a file cannot be created or written, or `force` is required to replace a
    ///         file.
    ///
    /// >>> import centrode as ct, tempfile
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> with tempfile.TemporaryDirectory() as directory:
    /// ...     [path.name for path in pair.export(directory, formats=["dxf"])]
    /// ['driver.dxf', 'driven.dxf', 'assembly.dxf']
    #[pyo3(signature = (directory, *, formats=None, parts=None, tolerance=None, dxf_version="R2010", dxf_curves="arcs", layers="cut", kerf=None, force=false))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn export(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        formats: Option<files::Named>,
        parts: Option<Vec<String>>,
        tolerance: Option<f64>,
        dxf_version: &str,
        dxf_curves: &str,
        layers: &str,
        kerf: Option<f64>,
        force: bool,
    ) -> Answer<Vec<PathBuf>> {
        let written = [dxf_version, dxf_curves, layers];
        let bundle = self.bundle(py, formats, parts, tolerance, written, kerf)?;
        files::written(py, bundle, directory, force)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let (class, machine) = (slf.get_type().name()?, slf.get());
        let (name, definition) = (machine.name(), machine.definition());
        Ok(format!("{class}({name:?}, {definition})"))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Answer<Reduced<'py>> {
        by_design(py, self.0.design())
    }
}
