//! All that machines can do whose shaft moves a box out and back.

use std::sync::Arc;

use centrode::family::Mechanism as Mechanical;
use centrode_groove::{Load, MovingBox, SpiralShaft};
use centrode_kinematics::machine::GuideForce;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use pyo3::prelude::{Bound, PyAny, PyClassInitializer, Python, pyclass, pymethods};

use crate::array::{Course, Values};
use crate::error::{Answer, finite};
use crate::mechanism::Mechanism;
use crate::record;

/// A machine with a grooved shaft that moves a box out and back: `SpiralShaft` or `MovingBox`.
///
/// `phi` is the angle of its input. The whole cycle out and back takes `cycle` radians.
#[pyclass(frozen, subclass, extends = Mechanism, module = "centrode")]
#[derive(Debug)]
pub(crate) struct BoxDrive(Arc<dyn Drive>);

/// A box and its drive.
pub(crate) trait Drive: Mechanical {
    fn motion(&self) -> &dyn Transmission;

    fn moved(&self, start: f64, stop: f64) -> f64;

    fn moved_in_window(&self) -> f64;

    fn load(&self) -> Load;

    fn force(&self, input: f64, load: &Load) -> GuideForce;
}

impl Drive for SpiralShaft {
    fn motion(&self) -> &dyn Transmission {
        self.traverse()
    }

    fn moved(&self, start: f64, stop: f64) -> f64 {
        self.law().moved(start, stop)
    }

    fn moved_in_window(&self) -> f64 {
        self.moved_in_window()
    }

    fn load(&self) -> Load {
        *self.load()
    }

    fn force(&self, input: f64, load: &Load) -> GuideForce {
        self.force(input, load)
    }
}

impl Drive for MovingBox {
    fn motion(&self) -> &dyn Transmission {
        self.motion().as_ref()
    }

    fn moved(&self, start: f64, stop: f64) -> f64 {
        self.stroke_at(stop).position - self.stroke_at(start).position
    }

    fn moved_in_window(&self) -> f64 {
        self.moved_in_window()
    }

    fn load(&self) -> Load {
        *self.shaft().load()
    }

    fn force(&self, input: f64, load: &Load) -> GuideForce {
        self.force(input, load)
    }
}

impl BoxDrive {
    /// The machine as what a new object of a subclass begins with.
    pub(crate) fn start<D: Drive>(drive: &Arc<D>) -> PyClassInitializer<Self> {
        let drive_of = Self(Arc::clone(drive) as Arc<dyn Drive>);
        Mechanism::start(drive).add_subclass(drive_of)
    }

    fn at(&self, phi: Values, part: fn(&MotionJet) -> f64) -> Course {
        let drive = Arc::clone(&self.0);
        Course::each(phi, move |phi| part(&drive.motion().at(phi)))
    }
}

#[pymethods]
impl BoxDrive {
    /// Input angle of the whole cycle out and back, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.0.motion().period()
    }

    /// Distance by which the box moves during a stroke while a seedling is picked, mm.
    #[getter]
    fn moved_in_window(&self) -> f64 {
        self.0.moved_in_window()
    }

    /// Position of the box, mm, over the whole cycle out and back.
    ///
    /// >>> import centrode as ct, numpy as np
    /// >>> shaft = ct.SpiralShaft(amplitude=1.28)
    /// >>> shaft.position(2 * np.pi * np.arange(3)).round(9).tolist()
    /// [0.0, 20.0, 40.0]
    fn position(&self, phi: Values) -> Course {
        self.at(phi, |motion| motion.position)
    }

    /// Speed of the box, mm/rad.
    fn velocity(&self, phi: Values) -> Course {
        self.at(phi, |motion| motion.velocity)
    }

    /// Acceleration of the box, mm/rad^2.
    fn acceleration(&self, phi: Values) -> Course {
        self.at(phi, |motion| motion.acceleration)
    }

    /// Jerk of the box, mm/rad^3.
    fn jerk(&self, phi: Values) -> Course {
        self.at(phi, |motion| motion.jerk)
    }

    /// Distance by which a stroke moves the box from one input angle to another, mm, for a stroke without end.
    ///
    /// >>> import centrode as ct, math
    /// >>> machine = ct.MovingBox(speed_ratio=3)
    /// >>> round(machine.moved(-math.pi / 6, math.pi / 6), 6)
    /// 1.954217
    fn moved(&self, start: f64, stop: f64) -> Answer<f64> {
        Ok(self.0.moved(finite("start", start)?, finite("stop", stop)?))
    }

    /// Forces on the slider at the input angles `phi`. Input speed, mass and friction coefficients, if given, replace
    /// those of the design. The torque is that of the shaft.
    ///
    /// >>> import centrode as ct
    /// >>> shaft = ct.SpiralShaft.for_moved_distance(2.05)
    /// >>> force = shaft.force(0.0, speed_rpm=200, mass=10, groove_friction=0.10, rail_friction=0.15)
    /// >>> round(force.normal, 6)
    /// 15.022814
    #[pyo3(signature = (phi, *, speed_rpm=None, mass=None, groove_friction=None, rail_friction=None))]
    fn force<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        speed_rpm: Option<f64>,
        mass: Option<f64>,
        groove_friction: Option<f64>,
        rail_friction: Option<f64>,
    ) -> Answer<Bound<'py, PyAny>> {
        let usual = self.0.load();
        let load = Load {
            speed_rpm: speed_rpm.unwrap_or(usual.speed_rpm),
            mass: mass.unwrap_or(usual.mass),
            groove_friction: groove_friction.unwrap_or(usual.groove_friction),
            rail_friction: rail_friction.unwrap_or(usual.rail_friction),
        };
        load.validate()?;
        let part = |part: fn(GuideForce) -> f64| {
            let drive = Arc::clone(&self.0);
            Course::each(phi.clone(), move |phi| part(drive.force(phi, &load)))
        };
        let parts = [
            part(|f| f.normal),
            part(|f| f.transverse),
            part(|f| f.torque),
            part(|f| f.push),
        ];
        Ok(record::slider_force(py, parts)?)
    }
}
