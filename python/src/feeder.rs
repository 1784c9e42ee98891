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

/// A willow-cutting feeder: a picking six-bar that rests while it is filled, driven by an intermittent gear.
///
/// Made by `from_toml` or `load`; `template("feeder")` is a design to start from. The input `phi` is the angle the
/// intermittent gear has turned since the effector left its place under the store, rad; a cycle is one turn.
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

    /// The crank's angle at an input, rad.
    fn crank_angle(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.crank(phi).position)
    }

    /// The effector's angle at an input, rad, without jumps.
    fn effector_angle(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.effector(phi).position)
    }

    /// The effector's angle and its first three derivatives by the input: an array of the shape of `phi` and then (4,).
    fn effector_motion(&self, phi: Values) -> Course {
        self.rows(phi, |feeder, phi| row(&feeder.effector(phi)))
    }

    /// The effector's tip E at an input, mm: an array of the shape of `phi` and then (2,).
    fn tip(&self, phi: Values) -> Course {
        self.rows(phi, |feeder, phi| feeder.tip(phi).coords.into())
    }

    /// Speed of the tip at an input and at the design's speed, mm/s.
    fn tip_speed(&self, phi: Values) -> Course {
        self.each(phi, |feeder, phi| feeder.tip_speed(phi))
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
    /// (7, 2). Those on the crank at A, on the coupler at B, on the rocker at D and, from the coupler, at C, on the slider
    /// from the coupler at C, on the effector at F, and on the slider from the slot.
    ///
    /// Raises:
    ///     MechanismError: A link cannot be cut from plate, or what is carried is no mass.
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

    /// Cuttings fed in a minute.
    #[getter]
    fn feed_rate(&self) -> f64 {
        self.0.feed_rate()
    }

    /// This feeder with its bounds widened by as little as lets all its goals be reached, its lengths there, and its
    /// pivot in the middle of the places that give its swing; and the share by which they were widened.
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
