use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use centrode_analysis::optimise::Settings;
use centrode_analysis::{between_arms, check_three_arm};
use centrode_export::Bundle;
use centrode_export::three_arm as files;
use centrode_mechanism::design::Design as _;
use centrode_mechanism::gear::design::{BodySpec, TeethSpec};
use centrode_mechanism::three_arm as mechanism;
use centrode_mechanism::three_arm::design::{
    ArmSpec, Direction, GearboxSpec, SeedlingSpec, ThreeArmDesign, TraySpec, WorkSpec,
};
use centrode_mechanism::three_arm::{Link, PointMotion};
use numpy::PyArray2;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyRef, PyResult, Python, pyclass, pymethods};
use pyo3::types::{PyDict, PyTuple};

use crate::array::{Values, each, each_row, points};
use crate::body::Body;
use crate::bundle;
use crate::cam::{DiscCam, Fork};
use crate::count::{Count, optional};
use crate::design::{Class, path_loaded};
use crate::error::{
    not_of_family, of_arm, of_design, of_files, of_pair, of_pusher, of_three_arm, plain_tolerance,
    unknown_word,
};
use crate::format;
use crate::gear_pair::GearPair;
use crate::made::{Made, Reduced, by_design};
use crate::pitch::Pitch;
use crate::place::addendum as addendum_of;
use crate::record;
use crate::search;
use crate::tool::Tool;
use crate::variants;
use crate::wait::wait;

/// A three-arm transplanting mechanism: fixed sun, turning carrier, arms on the planets of bent chains.
///
/// The carrier's axis is the origin; theta is the carrier's turn from its start, positive whichever way it turns. Every
/// arm does what the first does, later by its share of a turn; arms are counted from 0.
///
/// Args:
///     pitch: Pitch curve of the sun; the planets are alike, the intermediate gears follow.
///     carrier_start: Direction of the first intermediate gear's axis from the sun's at the start, rad.
///     bend: From the leg sun - intermediate to the leg intermediate - planet, rad.
///     arm_mounting_angle: Direction of the tip from the planet's zero, rad.
///     tip_distance: Of the tip from the planet's axis, mm.
///     pusher_offset: Distance of the pusher's axis, which ends at the tip, from the planet's axis, mm.
///     planet_reference: The planet's zero behind the second leg at the start, rad; left out, the intermediate's turn
///         over the first abs(bend) of carrier turn.
///     arms: 1 to 6.
///     direction: "clockwise" or "counter-clockwise".
///     tooth_count: Of every gear; left out, there are no teeth to judge.
///     center_distance: mm; it follows from the pitch curve, and is checked if given.
///     picking: Carrier turn at which the first arm picks, rad; left out, where its tip enters the tray, or reaches
///         farthest towards it.
///     planting: Carrier turn at which the first arm plants, rad; left out, where its tip is lowest.
///     rate_per_minute: Seedlings planted.
///     plant_spacing: Distance of the plants along the row, mm.
///     planting_depth: Of the lowest tip below the ground, mm.
///     tray_distance: Of the tray's surface from the carrier's axis, mm.
///     tray_inclination: Elevation of the direction in which the arms enter the tray, rad.
///     seedling_height: Up to which a planted stem must not be pushed, mm.
///     seedling_width: Of a planted stem, mm.
///     clamp_length: Back from the tip, mm: what passes between seedlings.
///     housing_offset: Of the gearbox from the largest pitch radius, mm.
///     tool: What cuts the gears; the rack of ISO 53, profile A, if left out.
///     addendum: "full" or "fitted".
///     backlash: Play of each mesh along the normal, mm.
///     sun: Body of the sun.
///     intermediate: Body of the intermediate gears.
///     planet: Body of the planets.
///     name: Short name: letters, digits, "-" and "_".
///     title: One line for drawings and reports.
///
/// Raises:
///     DesignError: A value breaks a rule; PitchError, GearPairError and MechanismError where it cannot exist.
///
/// >>> import centrode as ct, math
/// >>> pitch = ct.pitch.bspline(
/// ...     degree=2,
/// ...     radius=[21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24],
/// ...     angle=[math.radians(d) for d in (20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345)],
/// ... )
/// >>> arms = ct.ThreeArm(
/// ...     pitch, carrier_start=math.radians(86), bend=math.radians(-53), arm_mounting_angle=math.radians(-29),
/// ...     tip_distance=145, pusher_offset=65, picking=math.radians(20), planting=math.radians(191),
/// ... )
/// >>> round(arms.center_distance, 6)
/// 82.04634
/// >>> round(math.degrees(arms.clamp_angle(math.radians(20))), 6)
/// 0.616147
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct ThreeArm(pub(crate) Arc<mechanism::ThreeArm>);

impl Class for ThreeArm {
    type Mechanism = mechanism::ThreeArm;

    fn of(arms: Arc<mechanism::ThreeArm>) -> Self {
        Self(arms)
    }
}

impl PartialEq for ThreeArm {
    fn eq(&self, other: &Self) -> bool {
        self.0.design() == other.0.design()
    }
}

impl ThreeArm {
    /// An arm that is there.
    fn arm(&self, arm: u32) -> PyResult<u32> {
        let arms = self.0.arms();
        if arm < arms {
            Ok(arm)
        } else {
            Err(PyIndexError::new_err(format!(
                "arm {arm} of {arms}, counted from 0"
            )))
        }
    }

    fn bundle(
        &self,
        py: Python<'_>,
        formats: Option<Vec<String>>,
        parts: Option<Vec<String>>,
        tolerance: f64,
        (dxf_version, dxf_curves): (&str, &str),
    ) -> PyResult<Bundle> {
        let tolerance = plain_tolerance(tolerance)?;
        let (formats, mut options) = format::within(tolerance, formats, dxf_version, dxf_curves)?;
        let known = files::Part::ALL.map(files::Part::name);
        if let Some(word) = parts
            .iter()
            .flatten()
            .find(|word| !known.contains(&word.as_str()))
        {
            return Err(unknown_word("parts", word, &known));
        }
        options.parts = parts;
        let arms = Arc::clone(&self.0);
        wait(py, move || files::files(&arms, &formats, &options))?.map_err(|e| of_files(&e))
    }

    fn of_tip<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
        over_ground: bool,
        part: fn(&PointMotion) -> [f64; 2],
    ) -> PyResult<Bound<'py, PyAny>> {
        let arm = self.arm(arm)?;
        let arms = Arc::clone(&self.0);
        each_row(py, theta, move |theta| {
            let tip = arms.tip(theta, arm);
            if over_ground {
                part(&arms.over_ground(&tip, theta))
            } else {
                part(&tip)
            }
        })
    }
}

fn body(body: Option<PyRef<'_, Body>>) -> BodySpec {
    body.map_or_else(BodySpec::default, |b| b.0.clone())
}

fn direction(word: &str) -> PyResult<Direction> {
    match word {
        "clockwise" => Ok(Direction::Clockwise),
        "counter-clockwise" => Ok(Direction::CounterClockwise),
        _ => {
            let known = ["clockwise", "counter-clockwise"];
            Err(unknown_word("direction", word, &known))
        }
    }
}

#[pymethods]
impl ThreeArm {
    #[new]
    #[pyo3(signature = (pitch, *, carrier_start, bend, arm_mounting_angle, tip_distance, pusher_offset, planet_reference=None, arms=Count::Fits(3), direction="clockwise", tooth_count=None, center_distance=None, picking=None, planting=None, rate_per_minute=180.0, plant_spacing=140.0, planting_depth=10.0, tray_distance=None, tray_inclination=0.0, seedling_height=60.0, seedling_width=4.0, clamp_length=60.0, housing_offset=10.0, tool=None, addendum="full", backlash=0.0, sun=None, intermediate=None, planet=None, name="three-arm", title=""), text_signature = "(pitch, *, carrier_start, bend, arm_mounting_angle, tip_distance, pusher_offset, planet_reference=None, arms=3, direction='clockwise', tooth_count=None, center_distance=None, picking=None, planting=None, rate_per_minute=180.0, plant_spacing=140.0, planting_depth=10.0, tray_distance=None, tray_inclination=0.0, seedling_height=60.0, seedling_width=4.0, clamp_length=60.0, housing_offset=10.0, tool=None, addendum='full', backlash=0.0, sun=None, intermediate=None, planet=None, name='three-arm', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        pitch: PyRef<'_, Pitch>,
        carrier_start: f64,
        bend: f64,
        arm_mounting_angle: f64,
        tip_distance: f64,
        pusher_offset: f64,
        planet_reference: Option<f64>,
        arms: Count,
        direction: &str,
        tooth_count: Option<Count>,
        center_distance: Option<f64>,
        picking: Option<f64>,
        planting: Option<f64>,
        rate_per_minute: f64,
        plant_spacing: f64,
        planting_depth: f64,
        tray_distance: Option<f64>,
        tray_inclination: f64,
        seedling_height: f64,
        seedling_width: f64,
        clamp_length: f64,
        housing_offset: f64,
        tool: Option<Tool<'_>>,
        addendum: &str,
        backlash: f64,
        sun: Option<PyRef<'_, Body>>,
        intermediate: Option<PyRef<'_, Body>>,
        planet: Option<PyRef<'_, Body>>,
        name: &str,
        title: &str,
    ) -> PyResult<Self> {
        let arm = ArmSpec {
            clamp_length,
            ..ArmSpec::new(arm_mounting_angle, tip_distance, pusher_offset)
        };
        let design = ThreeArmDesign {
            name: name.into(),
            title: title.into(),
            arms: arms.of("arms")?,
            direction: self::direction(direction)?,
            planet_reference,
            tooth_count: optional("tooth_count", tooth_count)?,
            center_distance,
            tool: tool.map(|t| t.spec()).unwrap_or_default(),
            teeth: TeethSpec {
                addendum: addendum_of(addendum)?,
                backlash,
                ..TeethSpec::default()
            },
            gearbox: GearboxSpec {
                housing_offset,
                ..GearboxSpec::default()
            },
            work: WorkSpec {
                picking,
                planting,
                rate_per_minute,
                plant_spacing,
                planting_depth,
            },
            tray: TraySpec {
                distance: tray_distance,
                inclination: tray_inclination,
                ..TraySpec::default()
            },
            seedling: SeedlingSpec {
                height: seedling_height,
                width: seedling_width,
            },
            sun: body(sun),
            intermediate: body(intermediate),
            planet: body(planet),
            ..ThreeArmDesign::new(pitch.spec.clone(), carrier_start, bend, arm)
        };
        let mechanism = wait(py, move || mechanism::ThreeArm::resolve(&design))?;
        Ok(Self(Arc::new(mechanism.map_err(|e| of_three_arm(&e))?)))
    }

    /// The mechanism of a design file.
    ///
    /// Raises:
    ///     DesignError: The design breaks a rule, or is of another family.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let loaded = path_loaded(py, path)?;
        let arms = loaded.cast::<Self>();
        let arms = arms.map_err(|_| not_of_family::<Self>())?;
        Ok(Self(Arc::clone(&arms.get().0)))
    }

    /// The mechanism of a design file's text.
    ///
    /// >>> import centrode as ct
    /// >>> ct.ThreeArm.from_toml(ct.template("three-arm")).arms
    /// 3
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        Class::read(py, text)
    }

    /// The design file of the mechanism; `from_toml` reads it back.
    fn to_toml(&self) -> PyResult<String> {
        self.0.design().to_toml().map_err(|e| of_design(&e))
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        &self.0.design().name
    }

    /// Title, as written in the design.
    #[getter]
    fn title(&self) -> &str {
        &self.0.design().title
    }

    /// Number of arms.
    #[getter]
    fn arms(&self) -> u32 {
        self.0.arms()
    }

    /// Pitch curve of the sun.
    #[getter]
    fn pitch(&self) -> PyResult<Pitch> {
        Pitch::resolve(self.0.design().pitch.clone())
    }

    /// Distance of the axes of two gears in mesh, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.0.center_distance()
    }

    /// Module, mm, if the tooth count is given: pitch length / (pi x tooth count).
    #[getter]
    fn module(&self) -> Option<f64> {
        self.0.module()
    }

    /// The planet's zero behind the chain's second leg at the start, rad.
    #[getter]
    fn planet_reference(&self) -> f64 {
        self.0.train().planet_reference()
    }

    /// Height of the tip's path in the machine's frame, mm.
    #[getter]
    fn trajectory_height(&self) -> f64 {
        self.0.trajectory().height()
    }

    /// Height of the ground in the machine's frame, mm.
    #[getter]
    fn ground(&self) -> f64 {
        self.0.ground()
    }

    /// Speed of the carrier at the design's rate, rad/s.
    #[getter]
    fn carrier_speed(&self) -> f64 {
        self.0.carrier_speed()
    }

    /// Carrier turn at which an arm picks, rad.
    #[pyo3(signature = (arm=0))]
    fn picking(&self, arm: u32) -> PyResult<f64> {
        Ok(self.0.picking(self.arm(arm)?))
    }

    /// Carrier turn at which an arm plants, rad.
    #[pyo3(signature = (arm=0))]
    fn planting(&self, arm: u32) -> PyResult<f64> {
        Ok(self.0.planting(self.arm(arm)?))
    }

    /// Tip of an arm at carrier turns (rad), (N, 2), mm: in the machine's frame, or over ground as the machine travels.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.tip(np.radians([20, 191])).round(3)
    /// array([[ 243.621,   29.807],
    ///        [ -68.003, -251.994]])
    #[pyo3(signature = (theta, arm=0, *, over_ground=false))]
    fn tip<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
        over_ground: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.of_tip(py, theta, arm, over_ground, |m| m.position.coords.into())
    }

    /// Velocity of an arm's tip, (N, 2), mm for a radian of carrier turn; times `carrier_speed` it is mm/s.
    #[pyo3(signature = (theta, arm=0, *, over_ground=false))]
    fn tip_velocity<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
        over_ground: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.of_tip(py, theta, arm, over_ground, |m| m.velocity.into())
    }

    /// Acceleration of an arm's tip, (N, 2), mm for a radian of carrier turn squared.
    #[pyo3(signature = (theta, arm=0))]
    fn tip_acceleration<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.of_tip(py, theta, arm, false, |m| m.acceleration.into())
    }

    /// Elevation of an arm's clamp above the horizontal, seen towards the tray, in (-pi, pi], rad.
    #[pyo3(signature = (theta, arm=0))]
    fn clamp_angle<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arm = self.arm(arm)?;
        let arms = Arc::clone(&self.0);
        each(py, theta, move |theta| arms.clamp_elevation(theta, arm))
    }

    /// Pose of every link: by name x, y (mm) and turn (rad) of its frame, (N, 3).
    ///
    /// Gears are in the frames of a gear pair's gears; an arm's x axis points as its clamp does.
    ///
    /// >>> import centrode as ct
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> sorted(arms.pose(0.0))[:4]
    /// ['arm-0', 'arm-1', 'arm-2', 'carrier']
    fn pose<'py>(&self, py: Python<'py>, theta: Values) -> PyResult<Bound<'py, PyDict>> {
        let mut links = vec![
            ("sun".to_owned(), Link::Sun),
            ("carrier".into(), Link::Carrier),
        ];
        for k in 0..self.0.arms() {
            links.push((format!("intermediate-{k}"), Link::Intermediate(k)));
            links.push((format!("planet-{k}"), Link::Planet(k)));
            links.push((format!("arm-{k}"), Link::Arm(k)));
        }
        let poses = PyDict::new(py);
        for (name, link) in links {
            let arms = Arc::clone(&self.0);
            let rows = each_row(py, theta.clone(), move |theta| {
                let stands = arms.link(link, theta);
                let at = stands.origin.position;
                [at.x, at.y, stands.angle.position]
            })?;
            poses.set_item(name, rows)?;
        }
        Ok(poses)
    }

    /// The cam of each arm, fixed to the carrier about the planet's axis.
    ///
    /// The cam angle is the turn the arm has made against the carrier since the start.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be.
    #[getter]
    fn cam(slf: &Bound<'_, Self>) -> PyResult<DiscCam> {
        let pusher = slf.get().0.pusher().map_err(|e| of_pusher(&e))?;
        let made = Made::part_of(slf.clone().into_any(), "cam")?;
        Ok(DiscCam::new(pusher.cam().clone(), made))
    }

    /// The fork of each arm, between cam and push rod.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be.
    ///
    /// >>> import centrode as ct
    /// >>> fork = ct.ThreeArm.from_toml(ct.template("three-arm")).fork
    /// >>> fork.joint, round(fork.retraction(fork.swing(25.0)), 9)
    /// ('pin-on-rod', 25.0)
    #[getter]
    fn fork(&self) -> PyResult<Fork> {
        let pusher = self.0.pusher().map_err(|e| of_pusher(&e))?;
        Ok(Fork(pusher.fork().clone()))
    }

    /// Contour that an arm must keep clear with, (N, 2), mm, in the frame in which `pose` gives it: corners of a closed
    /// polygon, counter-clockwise, nowhere farther than `tolerance` (mm) from the exact contour.
    ///
    /// Raises:
    ///     MechanismError: The arm's parts do not fit each other.
    #[pyo3(signature = (tolerance=1e-3))]
    fn arm_contour<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let tolerance = plain_tolerance(tolerance)?;
        let arm = self.0.arm_body().map_err(|e| of_arm(&e))?;
        points(py, &arm.outline().flatten(tolerance))
    }

    /// Least clearance of the arms over a whole turn, proven between samples to within `tolerance` (mm); None for one
    /// arm.
    ///
    /// Raises:
    ///     MechanismError: The arm's parts do not fit each other.
    ///
    /// >>> import centrode as ct
    /// >>> close = ct.ThreeArm.from_toml(ct.template("three-arm")).arm_clearance()
    /// >>> round(close.least, 1), close.lower_bound > close.least - 0.04
    /// (62.6, True)
    #[pyo3(signature = (tolerance=1e-2))]
    fn arm_clearance<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let tolerance = plain_tolerance(tolerance)?;
        let arm = self.0.arm_body().map_err(|e| of_arm(&e))?;
        let arms = Arc::clone(&self.0);
        let found = wait(py, move || between_arms(&arms, &arm, tolerance))?;
        let found = found.map_err(|e| of_arm(&e))?;
        found.map(|found| record::clearance(py, &found)).transpose()
    }

    /// The goals: figure, range, margin and progress of each.
    ///
    /// >>> import centrode as ct
    /// >>> goals = ct.ThreeArm.from_toml(ct.template("three-arm")).goals()
    /// >>> print(goals[1])
    /// goal 2: clamp above horizontal at picking 0.0107538 rad, met
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let arms = Arc::clone(&self.0);
        let report = wait(py, move || check_three_arm(&arms))?;
        record::goals(py, &report.goals)
    }

    /// Checks the goals, where the arms work, and what teeth the pitch curves can bear.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let arms = Arc::clone(&self.0);
        let report = wait(py, move || check_three_arm(&arms))?;
        record::report(py, &report)
    }

    /// Searches for a better mechanism around this one; the table [optimise] of its design says what may move.
    ///
    /// Args:
    ///     method: "guided", "cma-es", "de" or "ga".
    ///     seed: Same seed, same answer, on any number of cores.
    ///     evaluations: Most points looked at; the generation under way is finished.
    ///     population: Points a generation; by the method if left out.
    ///     progress: Called with evaluations, violation and objective of the best so far; False ends the search.
    ///
    /// Raises:
    ///     MechanismError: There is no search for such a design.
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
        let design = self.0.design();
        search::optimised::<Self>(py, design, method, settings, progress.as_ref())
    }

    /// Response of goals and figures to one number of the design: by name, a figure at each value, NaN where there is
    /// no mechanism.
    ///
    /// Args:
    ///     parameter: Key of the design file, "arm.tip_distance", or a parameter's name, "r1".
    ///     values: In the file's unit: mm, degrees.
    ///     whole: Ask for the teeth and the cam, too, which takes some ten times as long.
    ///
    /// >>> import centrode as ct
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.response("r1", [15, 21, 27])["trajectory-height"].round(1).tolist()
    /// [377.8, 370.8, 363.1]
    #[pyo3(signature = (parameter, values, *, whole=false))]
    fn response<'py>(
        &self,
        py: Python<'py>,
        parameter: &str,
        values: Vec<f64>,
        whole: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        search::response::<Self>(py, self.0.design(), parameter, values, whole)
    }

    /// Figures of many variants of this mechanism, about twenty microseconds each: goals 2 to 4 and 6 to 8, centre distance and
    /// length of the pitch curves, by name; NaN where a variant is no mechanism. `centrode.sweep` spreads more of them over
    /// an executor.
    ///
    /// Args:
    ///     parameters: Values by the parameter's name: "r1" to "r99" and "theta1" to "theta99" for radius and polar angle of a
    ///         control point, "carrier_start", "bend", "mounting_angle", "tip_distance", "pusher_offset", "planet_reference",
    ///         "picking", "planting"; arrays of one length, or single numbers; mm, degrees.
    ///     inputs: Inputs a turn at which the tip's path is looked at before its extremes are sharpened.
    ///
    /// Returns:
    ///     Arrays by name, angles in radians: "pick-angle", "push-angle", "angle-difference", "gearbox-clearance",
    ///     "trajectory-height", "module", "center_distance", "pitch_length".
    ///
    /// Raises:
    ///     DesignError: No such parameter, or the sun is no B-spline in the polar plane.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.sweep({"r1": [15, 21, 27], "tip_distance": 145})["trajectory-height"].round(1).tolist()
    /// [377.8, 370.8, 363.1]
    #[pyo3(signature = (parameters, *, inputs=360))]
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        parameters: BTreeMap<String, Values>,
        inputs: usize,
    ) -> PyResult<Bound<'py, PyDict>> {
        variants::sweep(py, self.0.design(), parameters, inputs)
    }

    /// Sun and intermediate gear with their teeth; the planets are the sun's part again.
    ///
    /// Raises:
    ///     GearPairError: No teeth can be laid out or cut, or the tooth count is missing.
    fn gear_pair(&self, py: Python<'_>) -> PyResult<GearPair> {
        let arms = Arc::clone(&self.0);
        let pair = wait(py, move || arms.pair())?.map_err(|e| of_pair(&e))?;
        Ok(GearPair {
            pair: Arc::new(pair),
        })
    }

    /// Retraction of an arm's push rod at carrier turns (rad), mm: 0 thrown out.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.push_rod(np.radians([20, 191, 206, 221])).round(6) + 0.0
    /// array([25. , 25. , 12.5,  0. ])
    #[pyo3(signature = (theta, arm=0))]
    fn push_rod<'py>(
        &self,
        py: Python<'py>,
        theta: Values,
        arm: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arm = self.arm(arm)?;
        let arms = Arc::clone(&self.0);
        let pusher = arms.pusher().map_err(|e| of_pusher(&e))?;
        each(py, theta, move |theta| {
            pusher.retraction(arms.own_input(theta, arm)).position
        })
    }

    /// The files of the mechanism, name to contents, without writing them; `export` writes them.
    ///
    /// >>> import centrode as ct
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> list(arms.files(formats=["dxf"], parts=["sun", "cam"]))
    /// ['sun.dxf', 'cam.dxf']
    #[pyo3(signature = (*, formats=None, parts=None, tolerance=1e-3, dxf_version="R2010", dxf_curves="arcs"))]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<Vec<String>>,
        parts: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let written = (dxf_version, dxf_curves);
        let bundle = self.bundle(py, formats, parts, tolerance, written)?;
        bundle::contents(py, &bundle)
    }

    /// Writes the mechanism's files into a directory, which is made if it is missing; gives their paths.
    ///
    /// Every part is written once, however many there are; every file whole or not at all, the same from run to run.
    ///
    /// Args:
    ///     directory: Where to.
    ///     formats: Any of "dxf", "svg", "sheet", "pdf", "stl", "step", "3mf", "csv", "urdf" and "mjcf"; all if left out.
    ///     parts: Any of "sun", "intermediate", "planet", "cam", "fork", "roller", "carrier", "housing", "cover-rear",
    ///         "cover-front", "clamp", "push-rod" and "assembly"; all if left out. Motion and models are of the whole.
    ///     tolerance: Greatest distance of every arc, point sequence and mesh from the exact curve, mm.
    ///     dxf_version: "R2010" or "R12".
    ///     dxf_curves: "arcs" or "splines".
    ///
    /// Raises:
    ///     ExportError: A part does not exist, or a file cannot be made or written.
    #[pyo3(signature = (directory, *, formats=None, parts=None, tolerance=1e-3, dxf_version="R2010", dxf_curves="arcs"))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn export(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        formats: Option<Vec<String>>,
        parts: Option<Vec<String>>,
        tolerance: f64,
        dxf_version: &str,
        dxf_curves: &str,
    ) -> PyResult<Vec<PathBuf>> {
        let written = (dxf_version, dxf_curves);
        let bundle = self.bundle(py, formats, parts, tolerance, written)?;
        bundle::written(py, bundle, directory)
    }

    fn __repr__(&self) -> String {
        format!(
            "ThreeArm({:?}, {} arms, {}, center_distance={:?})",
            self.name(),
            self.arms(),
            self.0.definition(),
            self.center_distance(),
        )
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        by_design(py, self.0.design())
    }
}
