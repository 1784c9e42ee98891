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

/// A planar machine composed in its design file of bodies that turn, slide or are fixed, laws and dyads.
///
/// Made by `from_toml` or `load`; `template("machine")` is a design to start from. The input `phi` is the angle of the
/// driving shaft, rad.
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
    /// Names of the bodies: the frame first, each body after those on which it depends.
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

    /// Position of a point at inputs, mm, or a derivative with respect to the input: an array of the shape of `phi` and
    /// then (2,).
    ///
    /// Args:
    ///     name: `body.point`, or only the point if no other body has a point of that name.
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

    /// Position of a body at inputs: x and y of its origin, mm, and its angle, rad, without jumps, or their derivatives
    /// with respect to the input: an array of the shape of `phi` and then (3,).
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

    /// Clearance between two bodies with their plates and gears, or between a body and an obstacle, mm.
    ///
    /// Without `phi`: the minimum over the cycle, proven between samples to within `tolerance` (mm), and its input, rad.
    /// With inputs: an array of the shape of `phi`. Negative if they overlap: the depth of penetration. Infinite if they
    /// have no common height along the shafts.
    ///
    /// Args:
    ///     first: Name of a body or an obstacle.
    ///     second: Name of another body or obstacle.
    ///     phi: Inputs, rad; default: the whole cycle.
    ///     tolerance: Accuracy, mm.
    ///
    /// Raises:
    ///     DesignError: There is no such body or obstacle, or both belong to one body.
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

    /// Forces at inputs (rad) that turn at constant speed, by the names in the design.
    ///
    /// `input`: required torque of the input, N mm. `joints`: force on each body, by its name, N along x and y of the
    /// frame. `closures`: force on the second body of the pin that closes a dyad, N, by both bodies. `meshes`: force
    /// along the normal of the teeth that move a body, N, by its name. `drives`: torque (N mm) or force (N) of the drive
    /// that moves a body; zero for bodies moved by teeth or a dyad.
    ///
    /// Inertia, weight and the loads of the design are included; friction and backlash are not.
    ///
    /// Args:
    ///     phi: Inputs, rad.
    ///     speed: Speed of the input, rad/s; default: the design's. Zero: at rest.
    ///
    /// Raises:
    ///     MechanismError: A part cannot be made, a body is held more than once, or no force balances the load.
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

    /// Transmission angle of a dyad at inputs, rad: pi / 2 is the best value, and 0 means stretched or folded.
    ///
    /// For a dyad RRR it is the angle between the bars at their joint, from 0 to pi; for the others an angle between two
    /// lines, from 0 to pi / 2. The figure ``transmission_angle_min`` of a check, and goals, use pi minus the angle for
    /// an angle above pi / 2.
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
