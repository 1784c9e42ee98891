use std::collections::BTreeMap;
use std::sync::Arc;

use centrode_analysis::between_arms;
use centrode_machines::three_arm::ThreeArmLink;
use centrode_machines::three_arm::design::{ArmSpec, ThreeArmDesign};
use pyo3::prelude::{
    Bound, Py, PyAny, PyClassInitializer, PyDictMethods, PyRef, Python, pymethods,
};
use pyo3::types::PyDict;

use super::{ThreeArm, variants};
use crate::array::{Course, Rows, Values};
use crate::cam::{DiscCam, Fork};
use crate::design::Class;
use crate::error::{Answer, plain_tolerance};
use crate::gear_pair::GearPair;
use crate::keywords::{Call, fill};
use crate::made::Made;
use crate::pitch::Pitch;
use crate::record;
use crate::wait::wait;

#[pymethods]
impl ThreeArm {
    #[new]
    #[pyo3(signature = (pitch, *, carrier_start, bend, arm_mounting_angle, tip_distance, pusher_offset, **keywords), text_signature = "(pitch, *, carrier_start, bend, arm_mounting_angle, tip_distance, pusher_offset, planet_reference=None, arms=3, direction='clockwise', tooth_count=None, center_distance=None, picking=None, planting=None, rate_per_minute=180.0, plant_spacing=140.0, planting_depth=10.0, tray_distance=None, tray_inclination=0.0, seedling_height=60.0, seedling_width=4.0, clamp_length=60.0, housing_offset=10.0, tool=None, shift=0.0, addendum='full', backlash=0.0, sun=None, intermediate=None, planet=None, name='three-arm', title='')")]
    #[expect(clippy::too_many_arguments, reason = "keywords that must be given")]
    fn new(
        py: Python<'_>,
        pitch: PyRef<'_, Pitch>,
        carrier_start: f64,
        bend: f64,
        arm_mounting_angle: f64,
        tip_distance: f64,
        pusher_offset: f64,
        keywords: Option<Bound<'_, PyDict>>,
    ) -> Answer<PyClassInitializer<Self>> {
        let arm = ArmSpec::new(arm_mounting_angle, tip_distance, pusher_offset);
        let mut design = ThreeArmDesign::new(pitch.spec.clone(), carrier_start, bend, arm);
        let call = Call::new("ThreeArm.__new__", keywords);
        fill!(call, design, "": name, title, arms, direction, planet_reference, tooth_count, center_distance);
        fill!(call, design, "": tool, shift, sun, intermediate, planet);
        fill!(call, design.arm, "arm.": clamp_length);
        fill!(call, design.teeth, "teeth.": addendum, backlash);
        fill!(call, design.gearbox, "gearbox.": housing_offset);
        fill!(call, design.work, "work.": picking, planting, rate_per_minute, plant_spacing, planting_depth);
        fill!(call, design.tray, "tray.": tray_distance = distance, tray_inclination = inclination);
        fill!(call, design.seedling, "seedling.": seedling_height = height, seedling_width = width);
        call.end()?;
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

    /// Centre distance of two gears in mesh, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.0.center_distance()
    }

    /// Module, mm, if the tooth count is given: pitch length / (pi x tooth count).
    #[getter]
    fn module(&self) -> Option<f64> {
        self.0.module()
    }

    /// Planet reference angle `phi_30`: angle at the start from the planet's zero direction to the second leg of the
    /// chain, rad.
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

    /// Speed of the carrier at the planting rate of the design, rad/s.
    #[getter]
    fn carrier_speed(&self) -> f64 {
        self.0.carrier_speed()
    }

    /// Carrier angle at which an arm picks, rad.
    #[pyo3(signature = (arm=0))]
    fn picking(&self, arm: i64) -> Answer<f64> {
        Ok(self.0.picking(self.arm(arm)?))
    }

    /// Carrier angle at which an arm plants, rad.
    #[pyo3(signature = (arm=0))]
    fn planting(&self, arm: i64) -> Answer<f64> {
        Ok(self.0.planting(self.arm(arm)?))
    }

    /// Tip of an arm at carrier angles (rad), (N, 2), mm: in the machine's frame, or over the ground while the machine
    /// moves.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.tip(np.radians([20, 191])).round(3)
    /// array([[ 243.621,   29.807],
    ///        [ -68.003, -251.994]])
    #[pyo3(signature = (theta, arm=0, *, over_ground=false))]
    fn tip(&self, theta: Values, arm: i64, over_ground: bool) -> Answer<Course> {
        self.of_tip(theta, arm, over_ground, |m| m.position.coords.into())
    }

    /// Velocity of an arm's tip, (N, 2), mm per radian of carrier angle; multiply by `carrier_speed` for mm/s.
    #[pyo3(signature = (theta, arm=0, *, over_ground=false))]
    fn tip_velocity(&self, theta: Values, arm: i64, over_ground: bool) -> Answer<Course> {
        self.of_tip(theta, arm, over_ground, |m| m.velocity.into())
    }

    /// Acceleration of an arm's tip, (N, 2), mm per squared radian of carrier angle.
    #[pyo3(signature = (theta, arm=0))]
    fn tip_acceleration(&self, theta: Values, arm: i64) -> Answer<Course> {
        self.of_tip(theta, arm, false, |m| m.acceleration.into())
    }

    /// Elevation of an arm's clamp above the horizontal, seen towards the tray, in (-pi, pi], rad.
    #[pyo3(signature = (theta, arm=0))]
    fn clamp_angle(&self, theta: Values, arm: i64) -> Answer<Course> {
        let arm = self.arm(arm)?;
        Ok(self.each(theta, move |arms, theta| arms.clamp_elevation(theta, arm)))
    }

    /// Pose of every link, by its name: x, y (mm) and angle (rad) of its frame, (N, 3).
    ///
    /// Gears have the frames of the gears of a gear pair. The x axis of an arm has the direction of its clamp.
    ///
    /// >>> import centrode as ct
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> sorted(arms.pose(0.0))[:4]
    /// ['arm-0', 'arm-1', 'arm-2', 'carrier']
    fn pose<'py>(&self, py: Python<'py>, theta: Values) -> Answer<Bound<'py, PyDict>> {
        let mut links = vec![
            ("sun".to_owned(), ThreeArmLink::Sun),
            ("carrier".into(), ThreeArmLink::Carrier),
        ];
        for k in 0..self.0.arms() {
            links.push((format!("intermediate-{k}"), ThreeArmLink::Intermediate(k)));
            links.push((format!("planet-{k}"), ThreeArmLink::Planet(k)));
            links.push((format!("arm-{k}"), ThreeArmLink::Arm(k)));
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

    /// The cam of each arm; it is fixed to the carrier, on the axis of the planet.
    ///
    /// The cam angle is the rotation of the arm relative to the carrier since the start.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be made.
    #[getter]
    fn cam(slf: &Bound<'_, Self>) -> Answer<DiscCam> {
        let pusher = slf.get().0.pusher()?;
        let made = Made::part_of(slf.clone().into_any(), "cam")?;
        Ok(DiscCam::new(pusher.cam().clone(), made))
    }

    /// The fork of each arm, between cam and push rod.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be made.
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

    /// Contour of an arm for clearance checks, (N, 2), mm, in the frame of the arm in `pose`: corners of a closed
    /// polygon, counter-clockwise. Its distance from the exact contour is at most `tolerance` (mm).
    ///
    /// Raises:
    ///     MechanismError: The arm's parts do not fit each other.
    #[pyo3(signature = (tolerance=1e-3))]
    fn arm_contour(&self, tolerance: f64) -> Answer<Rows<2>> {
        let tolerance = plain_tolerance(tolerance)?;
        let arm = self.0.arm_body()?;
        Ok(Rows::new(&arm.outline().flatten(tolerance)))
    }

    /// Minimum clearance between the arms over a whole turn, proven between samples to within `tolerance` (mm); None for
    /// one arm.
    ///
    /// Raises:
    ///     MechanismError: The arm's parts do not fit each other.
    ///
    /// >>> import centrode as ct
    /// >>> close = ct.ThreeArm.from_toml(ct.template("three-arm")).arm_clearance()
    /// >>> round(close.minimum, 1), close.lower_bound > close.minimum - 0.04
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

    /// Figures of many variants of this mechanism, by name: goals 2 to 4 and 6 to 8, centre distance and length of the
    /// pitch curves.
    ///
    /// A variant takes about twenty microseconds. Figures are NaN if a variant is not a valid mechanism or has a number
    /// that a design file does not allow. `centrode.sweep` distributes many variants over an executor.
    ///
    /// Args:
    ///     parameters: Values by the name of the parameter: "r1" to "r99" and "theta1" to "theta99" for radius and polar
    ///         angle of a control point, "carrier_start", "bend", "mounting_angle", "tip_distance", "pusher_offset",
    ///         "planet_reference", "picking", "planting"; arrays of one length, or single numbers; mm, degrees.
    ///     inputs: Inputs per turn at which the path of the tip is sampled before its extremes are refined.
    ///
    /// Returns:
    ///     Arrays by name, angles in radians: "pick-angle", "push-angle", "angle-difference", "gearbox-clearance",
    ///     "trajectory-height", "module", "center_distance", "pitch_length".
    ///
    /// Raises:
    ///     DesignError: There is no such parameter, or the sun is not a B-spline in the polar plane.
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

    /// Sun and intermediate gear with their teeth; the planets are equal to the sun.
    ///
    /// Raises:
    ///     GearPairError: The teeth cannot be cut, or the tooth count is missing.
    fn gear_pair(&self, py: Python<'_>) -> Answer<Py<GearPair>> {
        let arms = Arc::clone(&self.0);
        GearPair::object(py, wait(py, move || arms.pair())??)
    }

    /// Retraction of an arm's push rod at carrier angles (rad), mm; 0: fully extended.
    ///
    /// Raises:
    ///     MechanismError: Cam and fork cannot be made.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    /// >>> arms.push_rod(np.radians([20, 191, 206, 221])).round(6) + 0.0
    /// array([25. , 25. , 12.5,  0. ])
    #[pyo3(signature = (theta, arm=0))]
    fn push_rod(&self, theta: Values, arm: i64) -> Answer<Course> {
        let arm = self.arm(arm)?;
        let pusher = self.0.pusher()?;
        Ok(self.each(theta, move |arms, theta| {
            pusher.retraction(arms.own_input(theta, arm)).position
        }))
    }
}
