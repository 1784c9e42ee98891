use std::sync::Arc;

use centrode_analysis::FeederForces;
use centrode_analysis::forces::Forces;
use centrode_machines::feeder as mechanism;
use centrode_synthesis::optimise::feeder::Widened;
use pyo3::prelude::{Py, PyClassInitializer, Python, pyclass, pymethods};

use crate::array::{Course, Values, row};
use crate::design::Class;
use crate::error::{Answer, Raised};
use crate::mechanism::Mechanism;
use crate::six_bar::SixBar;
use crate::wait::wait;

fn forces(
    feeder: &mechanism::Feeder,
    inputs: &[f64],
    moving: bool,
    carried: Option<f64>,
) -> Answer<Vec<Forces>> {
    let carried = carried.unwrap_or(feeder.design().drive.carried_mass);
    let system = FeederForces::new(feeder, carried)?;
    let forces = inputs.iter().map(|&input| system.at(input, moving));
    Ok(forces.collect::<Result<_, _>>()?)
}

/// A feeder of willow cuttings: a picking six-bar that rests while it is filled, driven by an intermittent gear.
///
/// Made by `from_toml` or `load`; `template("feeder")` is a design to start from. The input `phi` is the angle by which
/// the intermittent gear has turned since the effector left its position under the store, rad. A cycle is one turn.
///
/// >>> import centrode as ct
/// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
/// >>> round(feeder.feed_rate, 4)
/// 55.5556
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Feeder(Arc<mechanism::Feeder>);

impl Class for Feeder {
    type Machine = mechanism::Feeder;

    fn start(feeder: Arc<mechanism::Feeder>) -> PyClassInitializer<Self> {
        Mechanism::start(&feeder).add_subclass(Self(feeder))
    }

    fn machine(&self) -> &Arc<mechanism::Feeder> {
        &self.0
    }
}

#[pymethods]
impl Feeder {
    /// The six-bar.
    ///
    /// >>> import centrode as ct
    /// >>> import math
    /// >>> six = ct.Feeder.from_toml(ct.template("feeder")).six_bar
    /// >>> round(math.degrees(six.minimum_transmission_angle), 3)
    /// 40.001
    #[getter]
    fn six_bar(&self) -> SixBar {
        SixBar(*self.0.six_bar())
    }

    /// Angle of the crank at an input, rad.
    fn crank_angle(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.crank(phi).position)
    }

    /// Angle of the effector at an input, rad, without jumps.
    fn effector_angle(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.effector(phi).position)
    }

    /// Angle of the effector and its first three derivatives with respect to the input: an array of the shape of `phi`
    /// and then (4,).
    fn effector_motion(&self, phi: Values) -> Course {
        self.rows(phi, |feeder, phi| row(&feeder.effector(phi)))
    }

    /// Tip E of the effector at an input, mm: an array of the shape of `phi` and then (2,).
    fn tip(&self, phi: Values) -> Course {
        self.rows(phi, |feeder, phi| feeder.tip(phi).coords.into())
    }

    /// Speed of the tip at an input and at the design's speed, mm/s.
    fn tip_speed(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.tip_speed(phi))
    }

    /// Torque required at the crank at an input, N mm, counter-clockwise positive. The links have the mass of their
    /// plates, the y axis points up, and there is no friction.
    ///
    /// Args:
    ///     phi: Inputs, rad.
    ///     moving: Whether the inertia of the links at the design's speed is included; otherwise the links are at rest.
    ///     carried: Mass at the tip of the effector, kg; default: that of the design.
    ///
    /// Raises:
    ///     MechanismError: A link cannot be cut from plate, or `carried` is not a valid mass.
    ///
    /// >>> import centrode as ct
    /// >>> feeder = ct.Feeder.from_toml(ct.template("feeder"))
    /// >>> feeder.crank_torque([0.0, 1.0], moving=False).round(1)
    /// array([93.7, 79.8])
    #[pyo3(signature = (phi, *, moving=true, carried=None))]
    fn crank_torque(&self, phi: Values, moving: bool, carried: Option<f64>) -> Course {
        let feeder = Arc::clone(&self.0);
        Course::together(phi, &[], move |phi| {
            let forces = forces(&feeder, phi, moving, carried)?;
            Ok(forces.iter().map(FeederForces::torque).collect())
        })
    }

    /// Forces in the joints at an input, N, with the arguments of `crank_torque`: an array of the shape of `phi` and then
    /// (7, 2). In order: on the crank at A, on the coupler at B, on the rocker at D, on the rocker from the coupler at C,
    /// on the slider from the coupler at C, on the effector at F, and on the slider from the slot.
    ///
    /// Raises:
    ///     MechanismError: A link cannot be cut from plate, or `carried` is not a valid mass.
    #[pyo3(signature = (phi, *, moving=true, carried=None))]
    fn joint_forces(&self, phi: Values, moving: bool, carried: Option<f64>) -> Course {
        let feeder = Arc::clone(&self.0);
        Course::together(phi, &[7, 2], move |phi| {
            let forces = forces(&feeder, phi, moving, carried)?;
            let joints = forces.iter().flat_map(FeederForces::joints);
            Ok(joints.flat_map(<[f64; 2]>::from).collect())
        })
    }

    /// Crank angle at which the effector rests and is filled, rad.
    #[getter]
    fn start(&self) -> f64 {
        self.0.start()
    }

    /// Inputs at which the feed stroke and the return end, rad.
    #[getter]
    fn strokes(&self) -> (f64, f64) {
        let [feed, back] = self.0.strokes();
        (feed.to, back.to)
    }

    /// Input angle for which the effector rests in each cycle, rad.
    #[getter]
    fn dwell_angle(&self) -> f64 {
        self.0.drive().dwell_angle()
    }

    /// Time for which the effector rests in each cycle, s.
    #[getter]
    fn dwell_time(&self) -> f64 {
        self.0.dwell_time()
    }

    /// Speed of the intermittent gear, rad/s.
    #[getter]
    fn speed(&self) -> f64 {
        self.0.speed()
    }

    /// Cuttings fed per minute.
    #[getter]
    fn feed_rate(&self) -> f64 {
        self.0.feed_rate()
    }

    /// This feeder with the minimum widening of its bounds with which all goals can be reached, and the share by which
    /// the bounds were widened. The lengths are those of the widened bounds, and the pivot is in the middle of the
    /// positions that give the swing.
    ///
    /// Raises:
    ///     MechanismError: The bounds need no widening, or no widening helps.
    fn widened(&self, py: Python<'_>) -> Answer<(Py<Self>, f64)> {
        let feeder = Arc::clone(&self.0);
        let Widened { design, share } = wait(py, move || Widened::search(feeder.design()))??;
        let feeder = mechanism::Feeder::resolve(&design);
        let feeder = feeder.map_err(|error| Raised::no_search(&error.to_string()))?;
        Ok((Self::object(py, feeder)?, share))
    }
}
