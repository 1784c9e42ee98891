use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::design::{Direction, ThreeArmDesign};
use centrode_gear::Rolling;
use centrode_kinematics::transmission::{MotionJet, Transmission};

/// The gear train of one arm: the fixed sun, an intermediate gear and a planet on the turning carrier.
///
/// At the input theta, the carrier's turn, the carrier is at phi = `carrier_start` -+ theta and meets the sun at
/// the sun's polar angle psi = -+ theta (upper sign: clockwise). With the pair's transmission function f, the
/// intermediate gear is at phi + f(psi). It meets the planet at the planet's polar angle
/// chi = f^-1(f(psi) - bend - pi). The planet, a gear like the sun, is then at phi + bend + pi - chi, and the arm's
/// zero at phi + bend - reference + chi(0) - chi.
///
/// Both stages are the same exact integral, evaluated forwards and backwards. The mean ratios are 1, so after one carrier
/// turn every gear is in its first position again.
///
/// Source: Yin et al. 2021, DOI 10.25165/j.ijabe.20211405.6844, eqs. (4) to (10), derived again: the printed limits of
/// (9) leave out the pi, and (10) as printed does not give the published angles.
#[derive(Clone, Debug)]
pub struct Train {
    rolling: Arc<Rolling>,
    sign: f64,
    carrier_start: f64,
    bend: f64,
    reference: f64,
    /// Polar angle of the planet that is in mesh at the start.
    chi: f64,
}

/// Angles of the links of one chain from the x axis, rad, with their derivatives by carrier turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainJet {
    /// Direction of the intermediate gear's axis from the sun's.
    pub carrier: MotionJet,
    /// The intermediate gear, in its frame as the driven gear of a [`GearPair`](centrode_gear::GearPair).
    pub intermediate: MotionJet,
    /// The planet, in its frame as a driver.
    pub planet: MotionJet,
    /// The arm's zero, fixed to the planet.
    pub arm: MotionJet,
}

/// Adds a number to a jet: the position is moved, the derivatives do not change.
pub(super) fn moved(jet: MotionJet, by: f64) -> MotionJet {
    MotionJet {
        position: jet.position + by,
        ..jet
    }
}

impl Train {
    pub(super) fn new(design: &ThreeArmDesign, rolling: Arc<Rolling>) -> Self {
        let sign = design.direction.sign();
        let chi = rolling.driver_jet(-design.bend - PI).position;
        let reference = design
            .planet_reference
            .unwrap_or_else(|| -rolling.driven_angle(sign * design.bend.abs()));
        Self {
            rolling,
            sign,
            carrier_start: design.carrier_start,
            bend: design.bend,
            reference,
            chi,
        }
    }

    /// Sun and intermediate gear as a rolling pair. Planet and intermediate gear are the same pair, with the planet as its driver.
    #[must_use]
    pub fn rolling(&self) -> &Arc<Rolling> {
        &self.rolling
    }

    /// Sense of rotation of the carrier.
    #[must_use]
    pub fn direction(&self) -> Direction {
        if self.sign > 0.0 {
            Direction::CounterClockwise
        } else {
            Direction::Clockwise
        }
    }

    /// Sign: 1 for a carrier that turns counter-clockwise, -1 for clockwise.
    pub(super) fn sign(&self) -> f64 {
        self.sign
    }

    /// Direction of the intermediate gear's axis at the start, which is also the sun's zero, rad.
    #[must_use]
    pub fn carrier_start(&self) -> f64 {
        self.carrier_start
    }

    /// Angle from the chain's first leg to its second, rad.
    #[must_use]
    pub fn bend(&self) -> f64 {
        self.bend
    }

    /// Angle from the arm's zero to the chain's second leg at the start, rad.
    #[must_use]
    pub fn planet_reference(&self) -> f64 {
        self.reference
    }

    /// Angle from the planet gear's own zero to the arm's, rad.
    #[must_use]
    pub fn arm_on_planet(&self) -> f64 {
        self.chi - self.reference - PI
    }

    /// Angles of the links at a carrier turn, which may be any real number.
    #[must_use]
    pub fn at(&self, input: f64) -> TrainJet {
        let carrier = MotionJet::uniform(self.carrier_start + self.sign * input, self.sign);
        let psi = MotionJet::uniform(self.sign * input, self.sign);
        let turned = self.rolling.driven_jet(psi.position).after(&psi);
        let met = moved(turned, -self.bend - PI);
        let chi = self.rolling.driver_jet(met.position).after(&met);
        let leg = moved(carrier, self.bend);
        TrainJet {
            carrier,
            intermediate: carrier.plus(1.0, &turned),
            planet: moved(leg.plus(-1.0, &chi), PI),
            arm: moved(leg.plus(-1.0, &chi), self.chi - self.reference),
        }
    }

    /// Turn of the arm against the carrier as a function of the carrier's turn: the input of a cam that is fixed to the carrier.
    #[must_use]
    pub fn arm_on_carrier(&self) -> ArmOnCarrier {
        ArmOnCarrier {
            train: self.clone(),
        }
    }

    /// Inputs in one turn at which a derivative of the train may jump, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        let ends = Transmission::breaks(self.rolling.as_ref());
        let first = ends.iter().map(|phi| self.sign * phi);
        let second = ends.iter().map(|&chi| {
            let met = self.rolling.driven_angle(chi) + self.bend + PI;
            self.sign * self.rolling.driver_jet(met).position
        });
        let mut all: Vec<f64> = first.chain(second).map(|b| b.rem_euclid(TAU)).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        all
    }
}

/// Angle of the arm's zero against the carrier, as a function of the carrier's turn.
#[derive(Clone, Debug)]
pub struct ArmOnCarrier {
    train: Train,
}

impl Transmission for ArmOnCarrier {
    fn at(&self, input: f64) -> MotionJet {
        let TrainJet { carrier, arm, .. } = self.train.at(input);
        arm.plus(-1.0, &carrier)
    }

    fn advance(&self) -> f64 {
        -self.train.sign * TAU
    }

    fn breaks(&self) -> Vec<f64> {
        self.train.breaks()
    }
}
