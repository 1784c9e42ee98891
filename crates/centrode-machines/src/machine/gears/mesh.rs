use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::Recent;

use centrode_gear::Rolling;
use centrode_kinematics::transmission::{
    FromFn, MotionJet, Remembered, Transmission, crossings, repeated, sorted,
};

/// Maximum number of cached laws of meshed bodies: a machine has a few, and as many for every copy.
const CACHED: usize = 32;

/// Sum of a constant and joint coordinates: the angle of a body, or of a gear on it, without jumps.
#[derive(Clone, Debug, Default)]
pub(in crate::machine) struct Angle {
    /// The constant, rad.
    pub(in crate::machine) start: f64,
    /// The coordinates.
    pub(in crate::machine) terms: Vec<Arc<dyn Transmission>>,
}

impl PartialEq for Angle {
    /// True for equal constants and for coordinates that are the same objects.
    fn eq(&self, other: &Self) -> bool {
        let same = |(one, two): (&Arc<dyn Transmission>, _)| Arc::ptr_eq(one, two);
        self.start == other.start
            && self.terms.len() == other.terms.len()
            && self.terms.iter().zip(&other.terms).all(same)
    }
}

impl Angle {
    /// The angle with a constant added.
    pub(in crate::machine) fn plus(&self, more: f64) -> Self {
        Self {
            start: self.start + more,
            terms: self.terms.clone(),
        }
    }

    /// Angle at an input.
    pub(in crate::machine) fn at(&self, input: f64) -> MotionJet {
        let start = MotionJet::at_rest(self.start);
        let sum = |sum: MotionJet, law: &Arc<dyn Transmission>| sum.plus(1.0, &law.at(input));
        self.terms.iter().fold(start, sum)
    }

    /// Inputs below `period` where a derivative may jump, ascending.
    pub(in crate::machine) fn breaks(&self, period: f64) -> Vec<f64> {
        let of = |law: &Arc<dyn Transmission>| repeated(&**law, period);
        self.terms.iter().flat_map(of).collect()
    }
}

/// Two pitch curves that roll on each other, on axes that may move.
///
/// With lambda the direction from the driver's axis to the driven gear's, alpha and beta the angles of the two gears and f the
/// driven angle of the pair by the driver's polar angle: the driver's pitch point is at the polar angle lambda - alpha, so
/// beta = lambda + f(lambda - alpha), and alpha = lambda - f^-1(beta - lambda).
#[derive(Clone, Debug)]
pub(super) struct RollingMesh {
    pub(in crate::machine) rolling: Arc<Rolling>,
    /// Direction from the driver's axis to the driven gear's.
    pub(in crate::machine) lambda: Angle,
}

impl PartialEq for RollingMesh {
    /// True for pitch curves that are the same object, and equal directions.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.rolling, &other.rolling) && self.lambda == other.lambda
    }
}

impl RollingMesh {
    /// Angle of the driven gear from that of the driver.
    pub(in crate::machine) fn driven(&self, driver: &MotionJet, input: f64) -> MotionJet {
        let lambda = self.lambda.at(input);
        let phi = lambda.plus(-1.0, driver);
        let turned = self.rolling.driven_jet(phi.position).after(&phi);
        lambda.plus(1.0, &turned)
    }

    /// Angle of the driver from that of the driven gear.
    pub(in crate::machine) fn driver(&self, driven: &MotionJet, input: f64) -> MotionJet {
        let lambda = self.lambda.at(input);
        let turned = driven.plus(-1.0, &lambda);
        let phi = self.rolling.driver_jet(turned.position).after(&turned);
        lambda.plus(-1.0, &phi)
    }
}

/// Coordinate of a body that a mesh moves: its angle against the body that carries it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MeshedBody {
    pub(in crate::machine) mesh: RollingMesh,
    /// Whether the body's gear is the driven one of its pair.
    pub(in crate::machine) is_driven: bool,
    /// Angle of the other gear.
    pub(in crate::machine) other: Angle,
    /// Angle of the carrier plus the angle at which the body's gear is mounted.
    pub(in crate::machine) carrier: Angle,
}

impl MeshedBody {
    fn at(&self, input: f64) -> MotionJet {
        let other = self.other.at(input);
        let own = match self.is_driven {
            true => self.mesh.driven(&other, input),
            false => self.mesh.driver(&other, input),
        };
        own.plus(-1.0, &self.carrier.at(input))
    }

    /// The driver's polar angle at an input.
    fn polar(&self, input: f64) -> f64 {
        let lambda = self.mesh.lambda.at(input).position;
        let other = self.other.at(input);
        let driver = match self.is_driven {
            true => other.position,
            false => self.mesh.driver(&other, input).position,
        };
        lambda - driver
    }

    /// Inputs at which a derivative may jump: breaks of its angles, and inputs at which a break of the pitch curve is in mesh.
    fn breaks(&self, period: f64) -> Vec<f64> {
        let mut found = self.other.breaks(period);
        found.extend(self.carrier.breaks(period));
        let rolling = &self.mesh.rolling;
        let (bends, cycle) = (rolling.breaks(), rolling.period());
        let met = crossings(|input| self.polar(input), &bends, cycle, period, &found);
        sorted(found.into_iter().chain(met), period)
    }

    /// The coordinate as a function of the input, starting within half a turn of zero, and its growth over a period, in turns.
    ///
    /// Law and values are cached: most changes of a machine do not change its trains.
    pub(in crate::machine) fn law(self, period: f64) -> (Arc<dyn Transmission>, f64) {
        static LAWS: Recent<(MeshedBody, f64), (Arc<dyn Transmission>, f64), CACHED> =
            Recent::new();
        let key = (self, period);
        LAWS.get(&key, || key.0.clone().new_law(period))
    }

    fn new_law(mut self, period: f64) -> (Arc<dyn Transmission>, f64) {
        self.carrier.start += TAU * (self.at(0.0).position / TAU).round();
        let advance = self.at(period).position - self.at(0.0).position;
        let whole = TAU * (advance / TAU).round();
        let breaks = self.breaks(period);
        let law = FromFn::new(period, whole, breaks, move |input| self.at(input));
        // Values are cached: trains and dyads built on this law evaluate it at the same inputs.
        (Arc::new(Remembered::new(law)), advance / TAU)
    }
}
