use std::path::PathBuf;
use std::sync::Arc;

use centrode::meshing;
use centrode_analysis::{Contact, check};
use centrode_export::gear_pair as files;
use centrode_export::gear_pair::Subject;
use centrode_export::{Bundle, Format};
use centrode_mechanism::design::Design as _;
use centrode_mechanism::gear as mechanism;
use centrode_mechanism::gear::Member;
use centrode_mechanism::gear::design::{Addendum, BodySpec, GearPairDesign, TeethSpec};
use centrode_mechanism::gear::pitch::{Conjugate, PitchSpec};
use pyo3::prelude::{Bound, Py, PyAny, PyRef, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::array::{Numbers, Values, each};
use crate::body::Body;
use crate::bundle;
use crate::count::{Count, optional};
use crate::design::Class;
use crate::drawing::DrawingSpec;
use crate::error::{of_design, of_files, of_pair, tolerance as within};
use crate::format::options;
use crate::gear::Gear;
use crate::made::{Made, Reduced, by_design};
use crate::pitch::Pitch;
use crate::place::{Place, addendum};
use crate::record;
use crate::sheet::{Sheets, layout};
use crate::tool::{self, Tool};
use crate::wait::wait;

/// Most inputs a pitch of a contact analysis.
const MOST_PER_PITCH: u32 = 10_000;

/// A non-circular gear pair: exact pitch curves, finished teeth.
///
/// The driver is centred at the origin, the driven gear at (center_distance, 0). At the driver angle phi the
/// driver has turned by -phi and the driven gear by +driven_angle(phi).
///
/// Args:
///     pitch: Pitch curve of the driver; that of the driven gear follows.
///     mean_ratio: Turns of driver : turns of driven gear, in lowest terms.
///     tooth_count: Teeth of the driver, for a pitch curve with a size of its own: the module follows.
///     center_distance: mm; it follows from pitch curve and mean ratio, and is checked if given.
///     tool: What cuts both gears; the rack of ISO 53, profile A, if left out.
///     addendum: "full": every tooth as high as the tool asks. "fitted": each as high as works.
///     phase: Where the teeth sit on the driver: "tooth" or "space" at the polar angle zero, "congruent" so that
///         both gears come out the same part, "auto", or the pitches from the polar angle zero to a tooth.
///     backlash: Play of the pair along the normal, mm.
///     backlash_angle: Play of the driven gear at most, rad, instead of `backlash`.
///     thickness_split: The driver's share of the pitch.
///     least_tip_width_coefficient: Least width of a tooth at its tip, in modules, before it is reported.
///     pin_diameter: Diameter of the measuring pins, mm; chosen if left out.
///     driver: Body of the driver.
///     driven: Body of the driven gear.
///     drawing: What the drawing sheets say.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule; GearPairError and PitchError where curve or teeth cannot exist.
///
/// >>> import centrode as ct
/// >>> pitch = ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23)
/// >>> pair = ct.GearPair(pitch)
/// >>> round(pair.center_distance, 6)
/// 52.709221
/// >>> pair.congruent
/// True
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct GearPair {
    pub(crate) pair: Arc<mechanism::GearPair>,
}

impl Class for GearPair {
    type Mechanism = mechanism::GearPair;

    fn of(pair: Arc<mechanism::GearPair>) -> Self {
        Self { pair }
    }
}

impl PartialEq for GearPair {
    fn eq(&self, other: &Self) -> bool {
        self.pair.design() == other.pair.design()
    }
}

impl GearPair {
    fn gear(slf: &Bound<'_, Self>, member: Member) -> PyResult<Gear> {
        Ok(Gear {
            pair: Arc::clone(&slf.get().pair),
            member,
            made: Made::part_of(slf.clone().into_any(), member.name())?,
        })
    }

    fn bundle(
        &self,
        py: Python<'_>,
        formats: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Bundle> {
        let (formats, options) = options(&self.pair, formats, tolerance, dxf_version, dxf_curves)?;
        let pair = Arc::clone(&self.pair);
        wait(py, move || {
            let mut options = options;
            if formats.contains(&Format::Sheet) || formats.contains(&Format::Pdf) {
                options.sheet.meshing = meshing(&check(&pair));
            }
            files::files(&pair, &formats, &options)
        })?
        .map_err(|e| of_files(&e))
    }
}

fn body(body: Option<PyRef<'_, Body>>) -> BodySpec {
    body.map_or_else(BodySpec::default, |b| b.0.clone())
}

#[pymethods]
impl GearPair {
    #[new]
    #[pyo3(signature = (pitch, *, mean_ratio=[Count::Fits(1), Count::Fits(1)], tooth_count=None, center_distance=None, tool=None, addendum="full", phase=Place::Auto, backlash=0.0, backlash_angle=None, thickness_split=0.5, least_tip_width_coefficient=0.2, pin_diameter=None, driver=None, driven=None, drawing=None, name="gear-pair", title=""), text_signature = "(pitch, *, mean_ratio=(1, 1), tooth_count=None, center_distance=None, tool=None, addendum='full', phase='auto', backlash=0.0, backlash_angle=None, thickness_split=0.5, least_tip_width_coefficient=0.2, pin_diameter=None, driver=None, driven=None, drawing=None, name='gear-pair', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        pitch: PyRef<'_, Pitch>,
        mean_ratio: [Count; 2],
        tooth_count: Option<Count>,
        center_distance: Option<f64>,
        tool: Option<Tool<'_>>,
        addendum: &str,
        phase: Place,
        backlash: f64,
        backlash_angle: Option<f64>,
        thickness_split: f64,
        least_tip_width_coefficient: f64,
        pin_diameter: Option<f64>,
        driver: Option<PyRef<'_, Body>>,
        driven: Option<PyRef<'_, Body>>,
        drawing: Option<PyRef<'_, DrawingSpec>>,
        name: &str,
        title: &str,
    ) -> PyResult<Self> {
        let [driver_turns, driven_turns] = mean_ratio;
        let design = GearPairDesign {
            name: name.into(),
            title: title.into(),
            mean_ratio: [
                driver_turns.of("mean_ratio")?,
                driven_turns.of("mean_ratio")?,
            ],
            tooth_count: optional("tooth_count", tooth_count)?,
            center_distance,
            pitch: pitch.spec.clone(),
            tool: tool.map(|t| t.spec()).unwrap_or_default(),
            teeth: TeethSpec {
                addendum: self::addendum(addendum)?,
                phase: phase.phase()?,
                backlash,
                backlash_angle,
                thickness_split,
                least_tip_width_coefficient,
                pin_diameter,
            },
            driver: body(driver),
            driven: body(driven),
            drawing: drawing.map(|d| d.0.clone()).unwrap_or_default(),
        };
        let pair = wait(py, move || mechanism::GearPair::resolve(&design))?;
        let pair = Arc::new(pair.map_err(|e| of_pair(&e))?);
        Ok(Self { pair })
    }

    /// The pair of a design file's text.
    ///
    /// >>> import centrode as ct
    /// >>> ct.GearPair.from_toml(ct.template("gear-pair")).driver.tooth_count
    /// 23
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Class::read(py, text)
    }

    /// The design file of the pair; `from_toml` reads it back.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> print(pair.to_toml()[:21])
    /// family = "gear-pair"
    /// <BLANKLINE>
    fn to_toml(&self) -> PyResult<String> {
        self.pair.design().to_toml().map_err(|e| of_design(&e))
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        self.pair.name()
    }

    /// Title, as written in the design.
    #[getter]
    fn title(&self) -> &str {
        self.pair.title()
    }

    /// Pitch curve of the driver.
    #[getter]
    fn pitch(&self) -> PyResult<Pitch> {
        Pitch::resolve(self.pair.design().pitch.clone())
    }

    /// Tool that cuts both gears.
    #[getter]
    fn tool(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        tool::object(py, &self.pair.design().tool)
    }

    /// "full" or "fitted".
    #[getter]
    fn addendum(&self) -> &'static str {
        match self.pair.design().teeth.addendum {
            Addendum::Full => "full",
            Addendum::Fitted => "fitted",
        }
    }

    /// Distance between the shafts, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.pair.center_distance()
    }

    /// Module, mm: pitch length / (pi x tooth count).
    #[getter]
    fn module(&self) -> f64 {
        self.pair.module()
    }

    /// Turns of driver : turns of driven gear.
    #[getter]
    fn mean_ratio(&self) -> (u32, u32) {
        self.pair.mean_ratio()
    }

    /// Pitches from the polar angle zero to the middle of the driver's tooth 0.
    #[getter]
    fn phase(&self) -> f64 {
        self.pair.phase()
    }

    /// Entries and layout of the drawing sheets.
    #[getter]
    fn drawing(&self) -> DrawingSpec {
        DrawingSpec(self.pair.drawing().clone())
    }

    /// Play along the common normal, mm.
    #[getter]
    fn backlash(&self) -> f64 {
        self.pair.backlash()
    }

    /// Whether both gears are the same part.
    #[getter]
    fn congruent(&self) -> bool {
        self.pair.congruent()
    }

    /// Driver angle after which both gears are as they were, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.pair.cycle()
    }

    /// The gear that is turned, at the origin.
    #[getter]
    fn driver(slf: &Bound<'_, Self>) -> PyResult<Gear> {
        Self::gear(slf, Member::Driver)
    }

    /// The gear that is driven, at (center_distance, 0).
    #[getter]
    fn driven(slf: &Bound<'_, Self>) -> PyResult<Gear> {
        Self::gear(slf, Member::Driven)
    }

    /// Driven angle at a driver angle, rad; of an array, an array of the same shape.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), mean_ratio=(2, 1))
    /// >>> round(pair.driven_angle(1.0), 12)
    /// 0.5
    /// >>> pair.driven_angle([[1, 2], [3, 4]]).round(12)
    /// array([[0.5, 1. ],
    ///        [1.5, 2. ]])
    fn driven_angle<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.driven_angle(phi))
    }

    /// Driven turn per driver turn at a driver angle, rad; of an array, an array of the same shape.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23)
    /// >>> pair = ct.GearPair(pitch)
    /// >>> round(pair.ratio(0.0), 6)
    /// 1.732051
    fn ratio<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.ratio(phi))
    }

    /// Change of the ratio per radian of driver angle; of an array, an array of the same shape.
    fn ratio_slope<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.ratio_slope(phi))
    }

    /// Curvature (1/mm) of the driver's pitch curve where it touches at a driver angle; positive where convex.
    fn driver_curvature<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.pitch_point(phi).driver_curvature)
    }

    /// Curvature (1/mm) of the driven gear's pitch curve where it touches at a driver angle; positive where convex.
    fn driven_curvature<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.pitch_point(phi).driven_curvature)
    }

    /// Angle (rad) between the common normal and the driven gear's motion, the driver pushing it on: |alpha - mu|, tan mu = r'/r.
    fn pressure_angle<'py>(&self, py: Python<'py>, phi: Values) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| pair.pitch_point(phi).pressure_angle)
    }

    /// Angle (rad) between the common normal and the driven gear's motion, the driver pushing it back: |alpha + mu|.
    fn reverse_pressure_angle<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
    ) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        each(py, phi, move |phi| {
            pair.pitch_point(phi).reverse_pressure_angle
        })
    }

    /// The driven pitch curve, with its teeth counted: the driver of a next pair.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.polar("1 + 0.1*cos(phi)", module=2, tooth_count=20), mean_ratio=(2, 1))
    /// >>> back = ct.GearPair(pair.conjugate(), mean_ratio=(1, 2))
    /// >>> back.driven.tooth_count
    /// 20
    fn conjugate(&self) -> PyResult<Pitch> {
        Pitch::resolve(PitchSpec::Conjugate(Conjugate {
            mean_ratio: self.pair.design().mean_ratio,
            module: None,
            tooth_count: Some(self.pair.driven().tooth_count()),
            of: Box::new(self.pair.design().pitch.clone()),
        }))
    }

    /// Contact analysis of the finished outlines along one whole cycle, or at given inputs.
    ///
    /// Args:
    ///     per_pitch: Inputs a pitch, spaced evenly along the pitch curve and never in step with the teeth.
    ///     inputs: Driver angles, rad, instead of these.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23))
    /// >>> bool(abs(pair.contact().transmission_error).max() < 1e-8)
    /// True
    #[pyo3(signature = (per_pitch=Count::Fits(8), *, inputs=None), text_signature = "($self, per_pitch=8, *, inputs=None)")]
    fn contact<'py>(
        &self,
        py: Python<'py>,
        per_pitch: Count,
        inputs: Option<Numbers>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let per_pitch = per_pitch.within("per_pitch", 1, MOST_PER_PITCH)?;
        let pair = Arc::clone(&self.pair);
        let contact = match inputs {
            None => wait(py, move || Contact::sampled(&pair, per_pitch)),
            Some(inputs) => {
                let inputs = inputs.into_vec();
                wait(py, move || Contact::at(&pair, &inputs))
            }
        };
        record::contact(py, contact?)
    }

    /// Checks pitch curves, every tooth, and the mesh along one whole cycle.
    ///
    /// >>> import centrode as ct
    /// >>> report = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23)).check()
    /// >>> report.ok
    /// True
    /// >>> report.values["transmission_error_max"] < 1e-8
    /// True
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let pair = Arc::clone(&self.pair);
        let report = wait(py, move || check(&pair))?;
        record::report(py, &report)
    }

    /// The drawing sheets of both gears in place: centre distance, data, motion; as `Gear.sheet`.
    #[pyo3(signature = (size=None, *, projection=None, tolerance=1e-3))]
    fn sheet(
        &self,
        py: Python<'_>,
        size: Option<&str>,
        projection: Option<&str>,
        tolerance: f64,
    ) -> PyResult<Sheets> {
        let pair = Arc::clone(&self.pair);
        let tolerance = within(tolerance, &self.pair)?;
        let sheet = layout(size, projection)?;
        wait(py, move || {
            Sheets::make(&pair, Subject::Assembly, sheet, tolerance)
        })?
        .map_err(|e| of_files(&e))
    }

    /// The files of the pair, name to contents, without writing them; `export` writes them.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> sorted(pair.files(formats=["stl"]))
    /// ['driven.stl', 'driver.stl']
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

    /// Writes the pair's files into a directory, which is made if it is missing; gives their paths.
    ///
    /// Every file is written whole or not at all, and is the same from run to run.
    ///
    /// Args:
    ///     directory: Where to.
    ///     formats: Any of "dxf", "svg", "stl", "step", "3mf", "csv", "urdf" and "mjcf"; all if left out.
    ///     tolerance: Greatest distance of every arc, point sequence and mesh from the exact curve, mm.
    ///     dxf_version: "R2010" or "R12".
    ///     dxf_curves: "arcs" or "splines".
    ///
    /// Raises:
    ///     ExportError: A file cannot be made or written.
    ///
    /// >>> import centrode as ct, tempfile
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> with tempfile.TemporaryDirectory() as directory:
    /// ...     [path.name for path in pair.export(directory, formats=["dxf"])]
    /// ['driver.dxf', 'driven.dxf', 'assembly.dxf']
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
        bundle::written(py, bundle, directory)
    }

    fn __repr__(&self) -> String {
        let pair = &self.pair;
        format!(
            "GearPair({:?}, {}, {}:{} teeth, module={:?}, center_distance={:?})",
            pair.name(),
            pair.definition(),
            pair.driver().tooth_count(),
            pair.driven().tooth_count(),
            pair.module(),
            pair.center_distance(),
        )
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by_design(py, self.pair.design())
    }
}
