use std::collections::BTreeMap;
use std::sync::Arc;

use centrode_analysis::between_arms;
use centrode_mechanism::gear::design::TeethSpec;
use centrode_mechanism::three_arm as mechanism;
use centrode_mechanism::three_arm::design::{
    ArmSpec, GearboxSpec, SeedlingSpec, ThreeArmDesign, TraySpec, WorkSpec,
};
use centrode_mechanism::three_arm::{Link, PointMotion};
use numpy::PyArray2;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::{
    Bound, Py, PyAny, PyClassInitializer, PyDictMethods, PyRef, Python, pyclass, pymethods,
};
use pyo3::types::PyDict;

use crate::array::{Course, Values, points};
use crate::body::{Body, spec_of};
use crate::cam::{DiscCam, Fork};
use crate::count::{Count, optional};
use crate::design::Class;
use crate::error::{Answer, plain_tolerance};
use crate::gear_pair::GearPair;
use crate::made::Made;
use crate::mechanism::Mechanism;
use crate::pitch::Pitch;
use crate::record;
use crate::tool::Tool;
use crate::variants;
use crate::wait::wait;
use crate::word::Word;

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
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct ThreeArm(Arc<mechanism::ThreeArm>);

impl Class for ThreeArm {
    type Machine = mechanism::ThreeArm;

    fn of(arms: Arc<mechanism::ThreeArm>) -> Self {
        Self(arms)
    }

    fn machine(&self) -> &Arc<mechanism::ThreeArm> {
        &self.0
    }
}

impl ThreeArm {
    /// An arm that is there.
    fn arm(&self, arm: u32) -> Answer<u32> {
        let arms = self.0.arms();
        if arm < arms {
            Ok(arm)
        } else {
            let message = format!("arm {arm} of {arms}, counted from 0");
            Err(PyIndexError::new_err(message).into())
        }
    }

    fn of_tip(
        &self,
        theta: Values,
        arm: u32,
        over_ground: bool,
        part: fn(&PointMotion) -> [f64; 2],
    ) -> Answer<Course> {
        let arm = self.arm(arm)?;
        Ok(self.rows(theta, move |arms, theta| {
            let tip = arms.tip(theta, arm);
            if over_ground {
                part(&arms.over_ground(&tip, theta))
            } else {
                part(&tip)
            }
        }))
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
        tool: Option<Tool>,
        addendum: &str,
        backlash: f64,
        sun: Option<PyRef<'_, Body>>,
        intermediate: Option<PyRef<'_, Body>>,
        planet: Option<PyRef<'_, Body>>,
        name: &str,
        title: &str,
    ) -> Answer<PyClassInitializer<Self>> {
        let arm = ArmSpec {
            clamp_length,
            ..ArmSpec::new(arm_mounting_angle, tip_distance, pusher_offset)
        };
        let design = ThreeArmDesign {
            name: name.into(),
            title: title.into(),
            arms: arms.of("arms")?,
            direction: Word::of("direction", direction)?,
            planet_reference,
            tooth_count: optional("tooth_count", tooth_count)?,
            center_distance,
            tool: tool.map(|tool| tool.0).unwrap_or_default(),
            teeth: TeethSpec {
                addendum: Word::of("teeth.addendum", addendum)?,
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
            sun: spec_of(sun),
            intermediate: spec_of(intermediate),
            planet: spec_of(planet),
            ..ThreeArmDesign::new(pitch.spec.clone(), carrier_start, bend, arm)
        };
        Self::made(py, design)
    }

    /// Number of arms.
    #[getter]
    fn arms(&self) -> u32 {
        self.0.arms()
    }

    /// Pitch curve of the sun.
    #[getter]
    fn pitch(&self) -> Answer<Pitch> {
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
    fn picking(&self, arm: u32) -> Answer<f64> {
        Ok(self.0.picking(self.arm(arm)?))
    }

    /// Carrier turn at which an arm plants, rad.
    #[pyo3(signature = (arm=0))]
    fn planting(&self, arm: u32) -> Answer<f64> {
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
    fn tip(&self, theta: Values, arm: u32, over_ground: bool) -> Answer<Course> {
        self.of_tip(theta, arm, over_ground, |m| m.position.coords.into())
    }

    /// Velocity of an arm's tip, (N, 2), mm for a radian of carrier turn; times `carrier_speed` it is mm/s.
    #[pyo3(signature = (theta, arm=0, *, over_ground=false))]
    fn tip_velocity(&self, theta: Values, arm: u32, over_ground: bool) -> Answer<Course> {
        self.of_tip(theta, arm, over_ground, |m| m.velocity.into())
    }

    /// Acceleration of an arm's tip, (N, 2), mm for a radian of carrier turn squared.
    #[pyo3(signature = (theta, arm=0))]
    fn tip_acceleration(&self, theta: Values, arm: u32) -> Answer<Course> {
        self.of_tip(theta, arm, false, |m| m.acceleration.into())
    }

    /// Elevation of an arm's clamp above the horizontal, seen towards the tray, in (-pi, pi], rad.
    #[pyo3(signature = (theta, arm=0))]
    fn clamp_angle(&self, theta: Values, arm: u32) -> Answer<Course> {
        let arm = self.arm(arm)?;
        Ok(self.each(theta, move |arms, theta| arms.clamp_elevation(theta, arm)))
    }

    /// Where every link stands: by name x, y (mm) and turn (rad) of its frame, (N, 3).
    ///
    /// Gears stand in the frames of a gear pair's gears; an arm's x axis points as its clamp does.
    ///
    /// >>> import centrode as ct
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> sorted(arms.pose(0.0))[:4]
    /// ['arm-0', 'arm-1', 'arm-2', 'carrier']
    fn pose<'py>(&self, py: Python<'py>, theta: Values) -> Answer<Bound<'py, PyDict>> {
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
            let rows = self.rows(theta.clone(), move |arms, theta| {
                let stands = arms.link(link, theta);
                let at = stands.origin.position;
                [at.x, at.y, stands.angle.position]
            });
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
    fn cam(slf: &Bound<'_, Self>) -> Answer<DiscCam> {
        let pusher = slf.get().0.pusher()?;
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
    fn fork(&self) -> Answer<Fork> {
        let pusher = self.0.pusher()?;
        Ok(Fork(pusher.fork().clone()))
    }

    /// What an arm must keep clear with, (N, 2), mm, in the frame in which `pose` gives it: corners of a closed
    /// polygon, counter-clockwise, nowhere farther than `tolerance` (mm) from the exact contour.
    ///
    /// Raises:
    ///     MechanismError: The arm's parts do not fit each other.
    #[pyo3(signature = (tolerance=1e-3))]
    fn arm_contour<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyArray2<f64>>> {
        let tolerance = plain_tolerance(tolerance)?;
        let arm = self.0.arm_body()?;
        Ok(points(py, &arm.outline().flatten(tolerance))?)
    }

    /// How close arms come over a whole turn, proven between samples to within `tolerance` (mm); None for one arm.
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
    ) -> Answer<Option<Bound<'py, PyAny>>> {
        let tolerance = plain_tolerance(tolerance)?;
        let arm = self.0.arm_body()?;
        let arms = Arc::clone(&self.0);
        let found = wait(py, move || between_arms(&arms, &arm, tolerance))?;
        let found = found?.map(|found| record::clearance(py, &found));
        Ok(found.transpose()?)
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
    ) -> Answer<Bound<'py, PyDict>> {
        variants::sweep(py, self.0.design(), parameters, inputs)
    }

    /// Sun and intermediate gear with their teeth; the planets are the sun's part again.
    ///
    /// Raises:
    ///     GearPairError: No teeth can be laid out or cut, or the tooth count is missing.
    fn gear_pair(&self, py: Python<'_>) -> Answer<Py<GearPair>> {
        let arms = Arc::clone(&self.0);
        GearPair::object(py, wait(py, move || arms.pair())??)
    }

    /// How far an arm's push rod is drawn back at carrier turns (rad), mm: 0 thrown out.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.push_rod(np.radians([20, 191, 206, 221])).round(6) + 0.0
    /// array([25. , 25. , 12.5,  0. ])
    #[pyo3(signature = (theta, arm=0))]
    fn push_rod(&self, theta: Values, arm: u32) -> Answer<Course> {
        let arm = self.arm(arm)?;
        let pusher = self.0.pusher()?;
        Ok(self.each(theta, move |arms, theta| {
            pusher.retraction(arms.own_input(theta, arm)).position
        }))
    }
}
