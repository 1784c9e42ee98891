use std::sync::Arc;

use centrode_analysis::{Contact, remedies};
use centrode_export::gear_pair::Subject;
use centrode_gear as mechanism;
use centrode_gear::Member;
use centrode_gear::design::GearPairDesign;
use centrode_gear::pitch::{Conjugate, PitchSpec};
use pyo3::prelude::{
    Bound, Py, PyAny, PyClassInitializer, PyRef, PyResult, Python, pyclass, pymethods,
};
use pyo3::types::{PyDict, PyTuple};

use crate::array::{Course, Numbers, Values};
use crate::count::Count;
use crate::design::Class;
use crate::drawing::DrawingSpec;
use crate::error::Answer;
use crate::gear::Gear;
use crate::keywords::{Call, fill};
use crate::made::Made;
use crate::mechanism::Mechanism;
use crate::pitch::Pitch;
use crate::record;
use crate::sheet::sheet;
use crate::tool;
use crate::wait::wait;
use crate::word::Word;

/// Most inputs a pitch of a contact analysis.
const MAX_PER_PITCH: u32 = 10_000;

/// Maximum driver angle of a contact analysis, rad: with all its digits one is known to 1e-10 rad.
const FARTHEST: f64 = 1e6;

/// A non-circular gear pair: exact pitch curves, finished teeth.
///
/// The driver is centred at the origin, the driven gear at (center_distance, 0). At the driver angle phi the
/// driver has turned by -phi and the driven gear by +driven_angle(phi).
///
/// Args:
///     pitch: Pitch curve of the driver; the pitch curve of the driven gear follows from it.
///     mean_ratio: Turns of driver : turns of driven gear, in lowest terms.
///     tooth_count: Tooth count of the driver, for a pitch curve of given size; the module follows from it.
///     center_distance: Centre distance, mm. It follows from pitch curve, mean ratio and shifts, and is checked if given.
///         For circular gears with one given shift, the other shift follows from it.
///     tool: Tool that cuts both gears; default: the rack of ISO 53, profile A.
///     addendum: "full": every tooth has the height given by the tool. "fitted": every tooth has the largest height that
///         works.
///     fit: Parameters to optimise for the contact ratio; their values given here are not used: "thickness_split",
///         "pressure_angle" of the tool, "phase". "addendum" means fitted teeth; each of the others implies it.
///     phase: Position of the teeth on the driver: "tooth" or "space" at the polar angle zero, "congruent" so that both
///         gears are equal parts, "auto", or the number of pitches from the polar angle zero to a tooth.
///     backlash: Backlash of the pair along the normal, mm.
///     backlash_angle: Maximum backlash of the driven gear, rad, instead of `backlash`.
///     thickness_split: Tooth thickness of the driver as a share of the pitch.
///     minimum_tip_width_coefficient: Tip width in modules below which a tooth is reported.
///     thickness_deviations: Upper and lower deviation of the tooth thickness from the design, mm, each within half a
///         module. They give the limits of the measurements over pins. Default: zero and minus the tolerance of DIN 3967
///         for the accuracy class.
///     pin_diameter: Diameter of the measuring pins, mm; default: chosen to fit.
///     driver: Body of the driver.
///     driven: Body of the driven gear.
///     driver_shift: Profile shift coefficient of the driver, in modules; default: minus that of the driven gear.
///     driven_shift: Profile shift coefficient of the driven gear. Only circular gears may have shifts whose sum is not zero.
///     driver_addendum: Height of the driver's teeth above the pitch curve, in modules; default: from its tool.
///     driven_addendum: Height of the driven gear's teeth above the pitch curve, in modules; default: from its tool.
///     driver_dedendum: Depth of the driver's spaces below the pitch curve, in modules; default: from its tool.
///     driven_dedendum: Depth of the driven gear's spaces below the pitch curve, in modules; default: from its tool.
///     driver_tool: Tool of the driver, with the same pressure angle; default: `tool`.
///     driven_tool: Tool of the driven gear, with the same pressure angle; default: `tool`.
///     tip_shortening: Change of every addendum: "keep-clearance" keeps the clearance given by the tool, "none", or a
///         coefficient in modules, negative for shorter teeth.
///     housing_gap: Gap between the tips and the chamber of a flow meter or pump, and between the gears and each cover, mm;
///         default: no housing.
///     housing_wall: Thickness of the wall around the chamber, mm.
///     kerf: Width of the cut that cuts both gears from a plate, mm. The check then includes the material that the cut leaves.
///         Cutting files contain the path of its middle.
///     goals: Goals by name, each a dict with the keys of the design file: figure, and minimum, maximum or between, such as
///         {"fast": {"figure": "ratio_max", "minimum": 1.9}}.
///     vary: Numbers that a search may move, with their minimum and maximum, such as {"pitch.eccentricity": (0, 0.5)}.
///     drawing: Title block and layout of the drawing sheets.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule; GearPairError or PitchError if teeth or pitch curve cannot exist.
///
/// >>> import centrode as ct
/// >>> pitch = ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23)
/// >>> pair = ct.GearPair(pitch)
/// >>> round(pair.center_distance, 6)
/// 52.709221
/// >>> pair.congruent
/// True
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct GearPair(pub(crate) Arc<mechanism::GearPair>);

impl Class for GearPair {
    type Machine = mechanism::GearPair;

    fn start(pair: Arc<mechanism::GearPair>) -> PyClassInitializer<Self> {
        Mechanism::start(&pair).add_subclass(Self(pair))
    }

    fn machine(&self) -> &Arc<mechanism::GearPair> {
        &self.0
    }
}

impl GearPair {
    fn gear(slf: &Bound<'_, Self>, member: Member) -> PyResult<Gear> {
        Ok(Gear {
            pair: Arc::clone(&slf.get().0),
            member,
            made: Made::part_of(slf.clone().into_any(), member.name())?,
        })
    }
}

#[pymethods]
impl GearPair {
    #[new]
    #[pyo3(signature = (pitch, **keywords), text_signature = "(pitch, *, mean_ratio=(1, 1), tooth_count=None, center_distance=None, tool=None, addendum='full', fit=(), phase='auto', backlash=0.0, backlash_angle=None, thickness_split=0.5, minimum_tip_width_coefficient=0.2, thickness_deviations=None, pin_diameter=None, driver=None, driven=None, driver_shift=None, driven_shift=None, driver_addendum=None, driven_addendum=None, driver_dedendum=None, driven_dedendum=None, driver_tool=None, driven_tool=None, tip_shortening='keep-clearance', housing_gap=None, housing_wall=10.0, kerf=0.0, goals=None, vary=None, drawing=None, name='gear-pair', title='')")]
    fn new(
        py: Python<'_>,
        pitch: PyRef<'_, Pitch>,
        keywords: Option<Bound<'_, PyDict>>,
    ) -> Answer<PyClassInitializer<Self>> {
        let mut design = GearPairDesign::new(pitch.spec.clone());
        let call = Call::new("GearPair.__new__", keywords);
        fill!(call, design, "": name, title, mean_ratio, tooth_count, center_distance, tool, drawing, goals, vary);
        fill!(call, design.teeth, "teeth.": addendum, fit, tip_shortening, phase, backlash, backlash_angle, thickness_split);
        fill!(call, design.teeth, "teeth.": minimum_tip_width_coefficient, thickness_deviations, pin_diameter);
        fill!(call, design.driver, "driver.": driver_shift = shift, driver_addendum = addendum);
        fill!(call, design.driver, "driver.": driver_dedendum = dedendum, driver_tool = tool, driver = body);
        fill!(call, design.driven, "driven.": driven_shift = shift, driven_addendum = addendum);
        fill!(call, design.driven, "driven.": driven_dedendum = dedendum, driven_tool = tool, driven = body);
        fill!(call, design.housing, "housing.": housing_gap = gap, housing_wall = wall);
        fill!(call, design.cut, "cut.": kerf);
        call.end()?;
        Self::made(py, design)
    }

    /// Pitch curve of the driver.
    #[getter]
    fn pitch(&self) -> Answer<Pitch> {
        Pitch::resolve(self.0.design().pitch.clone())
    }

    /// Tool that cuts both gears, unless a gear has its own tool.
    #[getter]
    fn tool(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        tool::object(py, &self.0.settled_design().tool)
    }

    /// "full" or "fitted".
    #[getter]
    fn addendum(&self) -> &'static str {
        self.0.teeth().addendum.word()
    }

    /// Names of the parameters that were optimised for the contact ratio.
    #[getter]
    fn fit(&self) -> Vec<&'static str> {
        let fit = self.0.design().teeth.fit.iter();
        fit.map(|fit| fit.word()).collect()
    }

    /// Tooth thickness of the driver as a share of the pitch.
    #[getter]
    fn thickness_split(&self) -> f64 {
        self.0.teeth().thickness_split
    }

    /// Pair with the optimised parameters written as given values; its gears are the same, and its `fit` is empty.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.ellipse(eccentricity=0.45, module=2, tooth_count=17)
    /// >>> pair = ct.GearPair(pitch, fit=["addendum", "pressure_angle"])
    /// >>> pair.settled().fit, pair.settled().tool == pair.tool
    /// ([], True)
    fn settled(&self, py: Python<'_>) -> Answer<Py<Self>> {
        let made = Self::made(py, self.0.settled_design())?;
        Ok(Py::new(py, made)?)
    }

    /// Distance between the shafts, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.0.center_distance()
    }

    /// Module, mm: pitch length / (pi x tooth count).
    #[getter]
    fn module(&self) -> f64 {
        self.0.module()
    }

    /// Tip shortening coefficient k: every addendum is longer by k modules, shorter if k is negative.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.circle(module=3, tooth_count=12)
    /// >>> pair = ct.GearPair(pitch, mean_ratio=(2, 1), driver_shift=0.6, driven_shift=0.36)
    /// >>> round(pair.center_distance, 5), round(pair.tip_shortening, 5)
    /// (56.49987, -0.12671)
    #[getter]
    fn tip_shortening(&self) -> f64 {
        self.0.tip_shortening()
    }

    /// Turns of driver : turns of driven gear.
    #[getter]
    fn mean_ratio(&self) -> (u32, u32) {
        self.0.mean_ratio()
    }

    /// Pitches from the polar angle zero to the middle of the driver's tooth 0.
    #[getter]
    fn phase(&self) -> f64 {
        self.0.phase()
    }

    /// Entries and layout of the drawing sheets.
    #[getter]
    fn drawing(&self) -> DrawingSpec {
        DrawingSpec(self.0.drawing().clone())
    }

    /// Backlash along the common normal, mm.
    #[getter]
    fn backlash(&self) -> f64 {
        self.0.backlash()
    }

    /// Whether both gears are the same part.
    #[getter]
    fn congruent(&self) -> bool {
        self.0.congruent()
    }

    /// Driver angle after which the motion of the pair repeats, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.0.cycle()
    }

    /// The driving gear, at the origin.
    #[getter]
    fn driver(slf: &Bound<'_, Self>) -> PyResult<Gear> {
        Self::gear(slf, Member::Driver)
    }

    /// The driven gear, at (center_distance, 0).
    #[getter]
    fn driven(slf: &Bound<'_, Self>) -> PyResult<Gear> {
        Self::gear(slf, Member::Driven)
    }

    /// Driven angle at a driver angle, rad; for an array, an array of the same shape.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), mean_ratio=(2, 1))
    /// >>> round(pair.driven_angle(1.0), 12)
    /// 0.5
    /// >>> pair.driven_angle([[1, 2], [3, 4]]).round(12)
    /// array([[0.5, 1. ],
    ///        [1.5, 2. ]])
    fn driven_angle(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.driven_angle(phi))
    }

    /// Ratio of driven speed to driver speed at a driver angle (rad); for an array, an array of the same shape.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23)
    /// >>> pair = ct.GearPair(pitch)
    /// >>> round(pair.ratio(0.0), 6)
    /// 1.732051
    fn ratio(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.ratio(phi))
    }

    /// Change of the ratio per radian of driver angle; for an array, an array of the same shape.
    fn ratio_slope(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.ratio_slope(phi))
    }

    /// Curvature (1/mm) of the driver's pitch curve at the pitch point, at a driver angle; positive where convex.
    fn driver_curvature(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.pitch_point(phi).driver_curvature)
    }

    /// Curvature (1/mm) of the driven gear's pitch curve at the pitch point, at a driver angle; positive where convex.
    fn driven_curvature(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.pitch_point(phi).driven_curvature)
    }

    /// Pressure angle (rad) when the driver pushes the driven gear forward: |alpha - mu|, tan mu = r'/r.
    ///
    /// It is the angle between the common normal and the motion of the driven gear.
    fn pressure_angle(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| pair.pitch_point(phi).pressure_angle)
    }

    /// Pressure angle (rad) when the driver pushes the driven gear back: |alpha + mu|.
    fn reverse_pressure_angle(&self, phi: Values) -> Course {
        self.each(phi, |pair, phi| {
            pair.pitch_point(phi).reverse_pressure_angle
        })
    }

    /// The driven pitch curve with its tooth count, to be the driver of another pair.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.polar("1 + 0.1*cos(phi)", module=2, tooth_count=20), mean_ratio=(2, 1))
    /// >>> back = ct.GearPair(pair.conjugate(), mean_ratio=(1, 2))
    /// >>> back.driven.tooth_count
    /// 20
    fn conjugate(&self) -> Answer<Pitch> {
        Pitch::resolve(PitchSpec::Conjugate(Conjugate {
            mean_ratio: self.0.design().mean_ratio,
            module: None,
            diametral_pitch: None,
            tooth_count: Some(self.0.driven().tooth_count()),
            of: Box::new(self.0.design().pitch.clone()),
        }))
    }

    /// Contact analysis of the finished outlines over one whole cycle, or at given inputs.
    ///
    /// Args:
    ///     per_pitch: Inputs per pitch, evenly spaced along the pitch curve, at different phases of successive teeth.
    ///     inputs: Driver angles to use instead, rad; at most 1e6 in either direction.
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
    ) -> Answer<Bound<'py, PyAny>> {
        let per_pitch = per_pitch.within("per_pitch", 1, MAX_PER_PITCH)?;
        let pair = Arc::clone(&self.0);
        let contact = match inputs {
            None => wait(py, move || Contact::sampled(&pair, per_pitch)),
            Some(inputs) => {
                let inputs = inputs.up_to(FARTHEST)?;
                wait(py, move || Contact::analyse_at(&pair, &inputs))
            }
        };
        Ok(record::contact(py, contact?)?)
    }

    /// Changed pairs whose flanks alone transmit the motion, each with its minimum tooth count: with full teeth, with
    /// fitted teeth, and with fitted teeth of optimised thickness, pressure angle and phase.
    ///
    /// A kind that needs more than 600 teeth is omitted. The parameters are optimised only if the present number of
    /// fitted teeth is too small. The call takes seconds.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.from_ratio("1 + 0.4*cos(phi)", module=2, tooth_count=8)
    /// >>> [(found.addendum, len(found.fit), found.minimum_tooth_count) for found in ct.GearPair(pitch).remedies()]
    /// [('full', 0, 12), ('fitted', 0, 10), ('fitted', 3, 9)]
    fn remedies<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyTuple>> {
        let pair = Arc::clone(&self.0);
        let found = wait(py, move || remedies(&pair))?;
        let made = found.iter().map(|remedy| {
            let start = Self::made(py, remedy.design.clone())?;
            let pair = Py::new(py, start)?.into_any();
            Ok(record::remedy(py, remedy, &pair)?)
        });
        Ok(PyTuple::new(py, made.collect::<Answer<Vec<_>>>()?)?)
    }

    /// The drawing sheets of the assembled pair: centre distance, data, motion; arguments as for `Gear.sheet`.
    #[pyo3(signature = (size=None, *, projection=None, tolerance=1e-3))]
    fn sheet<'py>(
        &self,
        py: Python<'py>,
        size: Option<&str>,
        projection: Option<&str>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyAny>> {
        let layout = [size, projection];
        sheet(py, &self.0, Subject::Assembly, layout, tolerance)
    }

    fn __repr__(&self) -> String {
        let pair = &self.0;
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
}
