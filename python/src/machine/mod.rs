pub(crate) mod drive;

use std::sync::Arc;

use centrode_analysis::machine_clearance;
use centrode_machines::machine::{self as mechanism, BodyPoint};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{
    Bound, PyAny, PyClassInitializer, PyRef, PyResult, Python, pyclass, pymethods,
};
use pyo3::types::PyTuple;

use crate::array::{Course, Values, row};
use crate::count::Count;
use crate::design::Class;
use crate::error::{Answer, Raised, plain_tolerance};
use crate::forces::Names;
use crate::mechanism::Mechanism;
use crate::wait::wait;

/// A planar machine composed in its design file: bodies that turn, slide or are fixed, laws and dyads.
///
/// Made by `from_toml` or `load`; `template("machine")` is a design to start from. The input `phi` is the angle the driving
/// shaft has turned by, rad.
///
/// >>> import centrode as ct
/// >>> leg = ct.Machine.from_toml(ct.template("machine"))
/// >>> leg.bodies
/// ('frame', 'crank', 'lower-rod', 'rocker', 'upper-rod', 'thigh', 'tie', 'shin')
/// >>> leg.point("foot", 0.0).round(6)
/// array([-43.160111, -91.756933])
#[pyclass(frozen, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Machine(Arc<mechanism::Machine>);

impl Class for Machine {
    type Machine = mechanism::Machine;

    fn start(composed: Arc<mechanism::Machine>) -> PyClassInitializer<Self> {
        Mechanism::start(&composed).add_subclass(Self(composed))
    }

    fn machine(&self) -> &Arc<mechanism::Machine> {
        &self.0
    }
}

/// The order of a derivative, none to the third.
fn checked(order: Count) -> Answer<usize> {
    Ok(order.within("order", 0, 3)? as usize)
}

impl Machine {
    /// Positions of points at inputs, worked out side by side.
    fn at_each(&self, phi: Values, tail: &[usize], points: Vec<BodyPoint>) -> Course {
        let made = Arc::clone(&self.0);
        Course::by_blocks(phi, tail, move |phi, places| {
            made.write_places(&points, phi, places.as_chunks_mut().0);
        })
    }
}

#[pymethods]
impl Machine {
    /// Names of the bodies, the frame first, each after those that it needs.
    #[getter]
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.bodies().iter().map(|body| &body.name))
    }

    /// Names of the dyads in the order in which they close.
    #[getter]
    fn dyads<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.dyads().iter().map(|dyad| &dyad.name))
    }

    /// Names of the points, `body.point`.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let names: Vec<String> = self.0.points().map(|(name, ..)| name).collect();
        PyTuple::new(py, names)
    }

    /// Input after which the machine repeats, rad.
    #[getter]
    fn period(&self) -> f64 {
        self.0.period()
    }

    /// Speed of the input, rad/s.
    #[getter]
    fn speed(&self) -> f64 {
        self.0.speed()
    }

    /// A point at inputs, mm, or its derivative by the input: an array of the shape of `phi` and then (2,).
    ///
    /// Args:
    ///     name: `body.point`, or the point alone where no other body has one of that name.
    ///     phi: Inputs, rad.
    ///     order: 0 for the position, 1 to 3 for derivatives, mm/rad, mm/rad² and mm/rad³.
    ///
    /// Raises:
    ///     DesignError: There is no such point.
    #[pyo3(signature = (name, phi, order=Count::Fits(0)), text_signature = "($self, name, phi, order=0)")]
    fn point(&self, name: &str, phi: Values, order: Count) -> Answer<Course> {
        let Some(point) = self.0.point_named(name) else {
            let known: Vec<String> = self.0.points().map(|(name, ..)| name).collect();
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            return Err(Raised::word("name", name, &known));
        };
        let order = checked(order)?;
        Ok(match order {
            0 => self.at_each(phi, &[2], vec![point]),
            _ => self.rows(phi, move |made, phi| {
                let jet = made.point(point.body, point.at, phi);
                [jet.first, jet.second, jet.third][order - 1].into()
            }),
        })
    }

    /// All points at inputs, mm: an array of the shape of `phi` and then (len(points), 2), in the order of `points`.
    ///
    /// >>> import centrode as ct
    /// >>> leg = ct.Machine.from_toml(ct.template("machine"))
    /// >>> leg.places([0.0, 0.1]).shape == (2, len(leg.points), 2)
    /// True
    fn places(&self, phi: Values) -> Course {
        let points: Vec<BodyPoint> = self.0.points().map(|(_, point)| point).collect();
        self.at_each(phi, &[points.len(), 2], points)
    }

    /// A body at inputs: x and y of its origin, mm, and its angle, rad, without jumps, or their derivatives by the input: an
    /// array of the shape of `phi` and then (3,).
    ///
    /// Args:
    ///     name: Name of the body.
    ///     phi: Inputs, rad.
    ///     order: 0 for the position, 1 to 3 for derivatives.
    ///
    /// Raises:
    ///     DesignError: There is no such body.
    #[pyo3(signature = (name, phi, order=Count::Fits(0)), text_signature = "($self, name, phi, order=0)")]
    fn body(&self, name: &str, phi: Values, order: Count) -> Answer<Course> {
        let Some(body) = self.0.body_named(name) else {
            let known: Vec<&str> = self.0.bodies().iter().map(|b| b.name.as_str()).collect();
            return Err(Raised::word("name", name, &known));
        };
        let order = checked(order)?;
        Ok(self.rows(phi, move |made, phi| {
            let jet = made.point(body, Default::default(), phi);
            let place = [jet.point.coords, jet.first, jet.second, jet.third][order];
            [place.x, place.y, row(&made.angle(body, phi))[order]]
        }))
    }

    /// Clearance of two bodies, with their plates and gears, or of a body and an obstacle, mm, proven between samples to within
    /// `tolerance` (mm): the minimum over the cycle and the input there, rad, or at inputs an array of the shape of `phi`.
    /// Negative where they overlap: how deep one lies in the other. Infinite where they share no height along the shafts.
    ///
    /// Args:
    ///     first: Name of a body or an obstacle.
    ///     second: Name of another one.
    ///     phi: Inputs, rad; default: the whole cycle.
    ///     tolerance: Accuracy, mm.
    ///
    /// Raises:
    ///     DesignError: There is no such body or obstacle, or both are on one body.
    ///
    /// >>> import centrode as ct
    /// >>> leg = ct.Machine.from_toml(ct.template("machine") + "[obstacles.ground]\nbelow = -100")
    /// >>> minimum, phi = leg.clearance("shin", "ground")
    /// >>> round(minimum, 1), round(leg.clearance("shin", "ground", phi), 1)
    /// (4.2, 4.2)
    #[pyo3(signature = (first, second, phi=None, *, tolerance=1e-3))]
    fn clearance<'py>(
        &self,
        py: Python<'py>,
        first: &str,
        second: &str,
        phi: Option<Values>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyAny>> {
        let tolerance = plain_tolerance(tolerance)?;
        let bodies = self.0.bodies().iter().map(|body| body.name.as_str());
        let obstacles = self.0.obstacles().iter();
        let known: Vec<&str> = bodies.chain(obstacles.map(|o| o.name.as_str())).collect();
        for (key, name) in [("first", first), ("second", second)] {
            if !known.contains(&name) {
                return Err(Raised::word(key, name, &known));
            }
        }
        let ends = self.0.clearance_ends("second", [first, second]);
        let ends = ends.map_err(|_| {
            let rule = format!("must not be on the same body as {first}");
            Raised::rule("second", &rule)
        })?;
        let composed = Arc::clone(&self.0);
        let pair = wait(py, move || {
            let machine = composed.machine()?;
            let pair = machine_clearance(&composed, &machine, ends, tolerance)?;
            Ok::<_, Raised>(pair.map(Arc::new))
        })??;
        let Some(phi) = phi else {
            let period = self.0.period();
            let found = match pair {
                None => (f64::INFINITY, f64::NAN),
                Some(pair) => {
                    let found = wait(py, move || pair.over([0.0, period]))??;
                    (found.minimum, found.input)
                }
            };
            return Ok(found.into_bound_py_any(py)?);
        };
        let course = Course::together(phi.finite()?, &[], move |inputs| {
            let at = |input: &f64| match &pair {
                None => Ok(f64::INFINITY),
                Some(pair) => Ok(pair.at(*input)?.minimum),
            };
            inputs.iter().map(at).collect()
        });
        Ok(course.into_bound_py_any(py)?)
    }

    /// Forces at inputs, rad, that turn evenly, by the design's names: `input` the torque that the input needs, N mm; `joints`
    /// the force on each body by its name, N along x and y of the frame; `closures` that on the second body of the pin that
    /// closes a dyad, by both; `meshes` that along the normal of the teeth that move a body, by its name, N.
    ///
    /// Inertia, weight and the loads of the design count; friction and backlash are omitted. `drives` is the torque (N mm) or
    /// force (N) of what moves a body: zero where teeth or a dyad do.
    ///
    /// Args:
    ///     phi: Inputs, rad.
    ///     speed: Speed of the input, rad/s; default: the design's. Zero holds it still.
    ///
    /// Raises:
    ///     MechanismError: A part cannot be made, more than one thing holds a body, or no force balances the load.
    ///
    /// >>> import centrode as ct
    /// >>> forces = ct.Machine.from_toml(ct.template("machine")).forces([0.0, 1.0])
    /// >>> list(forces.joints)
    /// ['crank', 'lower-rod', 'rocker', 'upper-rod', 'thigh', 'tie', 'shin']
    /// >>> forces.joints["thigh"].shape
    /// (2, 2)
    #[pyo3(signature = (phi, *, speed=None))]
    fn forces<'py>(
        slf: PyRef<'py, Self>,
        py: Python<'py>,
        phi: Values,
        speed: Option<f64>,
    ) -> Answer<Bound<'py, PyAny>> {
        slf.as_super().forces_by(py, phi, speed, Names::OF_BODIES)
    }

    /// Transmission angle of a dyad at inputs, rad: a right angle where it holds best, 0 where it is stretched or folded.
    ///
    /// Of a dyad RRR it is the angle between the bars at their joint, from 0 to pi; of the others an angle between two
    /// lines, from 0 to pi / 2. The figure ``transmission_angle_min`` of a check, and goals, count an angle above pi / 2
    /// by what it is short of pi.
    ///
    /// Raises:
    ///     DesignError: There is no such dyad.
    fn transmission_angle(&self, name: &str, phi: Values) -> Answer<Course> {
        let Some(dyad) = self.0.dyads().iter().position(|dyad| dyad.name == name) else {
            let known: Vec<&str> = self.0.dyads().iter().map(|d| d.name.as_str()).collect();
            return Err(Raised::word("name", name, &known));
        };
        Ok(self.each(phi, move |made, phi| made.transmission_angles(phi)[dyad]))
    }
}
