use centrode_geometry::{Point, Vector};

use super::ThreeArm;
use super::figures::elevation;
use super::train::{TrainJet, moved};
use centrode_kinematics::transmission::MotionJet;

/// A link of the mechanism; chains and arms are counted from zero.
///
/// Each link has its own frame. Sun and planets: the frame of a pair's driver; intermediate gears: that of its driven gear;
/// both on their axes. Carrier: on the sun's axis, x towards the first intermediate gear. Arm: on its planet's axis, x along
/// the pusher's axis in the direction of the clamp.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum ThreeArmLink {
    /// The gear fixed to the frame.
    Sun,
    /// The carrier of all other gears.
    Carrier,
    /// The gear between sun and planet of a chain.
    Intermediate(u32),
    /// The gear that carries an arm.
    Planet(u32),
    /// An arm with its clamp and pusher.
    Arm(u32),
}

/// Motion of a point: position (mm), with derivatives by carrier turn (mm/rad, mm/rad^2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Position.
    pub position: Point,
    /// First derivative.
    pub velocity: Vector,
    /// Second derivative.
    pub acceleration: Vector,
}

impl PointMotion {
    /// Motion with derivatives by time for a carrier that turns at `speed` rad/s: mm/s and mm/s^2.
    #[must_use]
    pub fn at_speed(&self, speed: f64) -> Self {
        Self {
            position: self.position,
            velocity: self.velocity * speed,
            acceleration: self.acceleration * (speed * speed),
        }
    }

    fn plus(self, length: f64, angle: &MotionJet) -> Self {
        let (sin, cos) = angle.position.sin_cos();
        let (along, across) = (Vector::new(cos, sin), Vector::new(-sin, cos));
        let (rate, change) = (angle.velocity, angle.acceleration);
        Self {
            position: self.position + along * length,
            velocity: self.velocity + across * (length * rate),
            acceleration: self.acceleration + (across * change - along * (rate * rate)) * length,
        }
    }

    /// Motion of a fixed origin.
    #[must_use]
    pub fn at_rest() -> Self {
        Self {
            position: Point::origin(),
            velocity: Vector::zeros(),
            acceleration: Vector::zeros(),
        }
    }
}

/// Motion of one link: its origin and the turn of its frame, with derivatives by carrier turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMotion {
    /// The link's own origin.
    pub origin: PointMotion,
    /// Turn of the link's frame from the machine's, rad.
    pub angle: MotionJet,
}

impl LinkMotion {
    /// Motion of a point given in the link's frame, mm.
    #[must_use]
    pub fn point(&self, local: Point) -> PointMotion {
        let angle = moved(self.angle, local.y.atan2(local.x));
        self.origin.plus(local.coords.norm(), &angle)
    }
}

/// Intermediate gear, planet and arm of one chain, solved at one carrier turn.
#[derive(Clone, Copy, Debug)]
pub struct Chain<'a> {
    mechanism: &'a ThreeArm,
    jet: TrainJet,
}

impl Chain<'_> {
    /// Angles of the train, from which the motion of the chain follows.
    #[must_use]
    pub fn train(&self) -> &TrainJet {
        &self.jet
    }

    /// Motion of intermediate gear, planet and arm, equal to that of [`ThreeArm::link`].
    #[must_use]
    pub fn links(&self) -> [LinkMotion; 3] {
        let center_distance = self.mechanism.center_distance();
        let intermediate = PointMotion::at_rest().plus(center_distance, &self.jet.carrier);
        let planet = self.planet_axis();
        let motion = |origin, angle| LinkMotion { origin, angle };
        [
            motion(intermediate, self.jet.intermediate),
            motion(planet, self.jet.planet),
            motion(planet, self.clamp()),
        ]
    }

    fn planet_axis(&self) -> PointMotion {
        let a = self.mechanism.center_distance();
        let leg = moved(self.jet.carrier, self.mechanism.train().bend());
        let rest = PointMotion::at_rest();
        rest.plus(a, &self.jet.carrier).plus(a, &leg)
    }

    /// Motion of the arm's tip in the machine's frame.
    #[must_use]
    pub fn tip(&self) -> PointMotion {
        let spec = &self.mechanism.design().arm;
        let along = moved(self.jet.arm, spec.mounting_angle);
        self.planet_axis().plus(spec.tip_distance, &along)
    }

    /// Direction in which the arm's clamp points, from the x axis, rad.
    #[must_use]
    pub fn clamp(&self) -> MotionJet {
        moved(self.jet.arm, self.mechanism.clamp_mounting())
    }

    /// Elevation of the clamp above the horizontal, seen from the machine towards the tray, in (-pi, pi], rad.
    #[must_use]
    pub fn clamp_elevation(&self) -> f64 {
        elevation(self.clamp().position, self.mechanism.train().sign())
    }
}

impl ThreeArm {
    /// Motion of a link at a carrier turn, which may be any real number. Chain numbers beyond the last repeat the first ones.
    #[must_use]
    pub fn link(&self, link: ThreeArmLink, input: f64) -> LinkMotion {
        let rest = PointMotion::at_rest();
        match link {
            ThreeArmLink::Sun => LinkMotion {
                origin: rest,
                angle: MotionJet::at_rest(self.train().carrier_start()),
            },
            ThreeArmLink::Carrier => LinkMotion {
                origin: rest,
                angle: self.train().at(input).carrier,
            },
            ThreeArmLink::Intermediate(chain) => self.chain(chain, input).links()[0],
            ThreeArmLink::Planet(chain) => self.chain(chain, input).links()[1],
            ThreeArmLink::Arm(arm) => self.chain(arm, input).links()[2],
        }
    }

    /// Chain at a carrier turn: the train is solved once for all its links. Chain numbers beyond the last repeat the first
    /// ones.
    #[must_use]
    pub fn chain(&self, chain: u32, input: f64) -> Chain<'_> {
        Chain {
            mechanism: self,
            jet: self.train().at(self.own_input(input, chain)),
        }
    }

    /// Motion of an arm's tip in the machine's frame.
    #[must_use]
    pub fn tip(&self, input: f64, arm: u32) -> PointMotion {
        self.chain(arm, input).tip()
    }

    /// Direction in which an arm's clamp points, from the x axis, rad.
    #[must_use]
    pub fn clamp(&self, input: f64, arm: u32) -> MotionJet {
        self.chain(arm, input).clamp()
    }

    /// Motion over ground of a point in the machine's frame; at input zero the machine has travelled zero.
    #[must_use]
    pub fn over_ground(&self, motion: &PointMotion, input: f64) -> PointMotion {
        let travel = Vector::new(-self.train().sign() * self.advance(), 0.0);
        PointMotion {
            position: motion.position + travel * input,
            velocity: motion.velocity + travel,
            acceleration: motion.acceleration,
        }
    }
}
