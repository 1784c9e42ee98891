use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Extreme, Jet, Point, Vector, maximum_of_samples, rounding};

use super::distance::{Distance, Series, taylor};
use super::limit::squares;
use super::path::PathSamples;
use super::{AxisFault, RequiredPath};
use centrode_kinematics::formula::Taylor;
use centrode_kinematics::machine::Piecewise;
use centrode_kinematics::transmission::{
    FromFn, Inverse, MotionJet, Transmission, TransmissionError, sorted,
};
use centrode_machines::three_arm::design::Direction;

/// Minimum speed of a body at which it counts as turning, as a share of its mean speed.
const MIN_SPEED: f64 = 1e-6;
/// Maximum difference of angles that counts as rounding, rad.
const ROUNDING: f64 = 1e-6;

/// Carrier and arm whose tip runs along a path: both lengths, and the angles of both as functions of the path's parameter.
///
/// With R and rho the maximum and the minimum distance of the path from the axis the bars are (R + rho)/2 and (R - rho)/2 long.
/// If the axis lies inside the path, the longer bar is the carrier; if it lies outside, the shorter one. With the other choice
/// the carrier would not make a whole turn. With u the square of the distance, c and s the lengths and beta the angle of the arm
/// against the carrier, `4 c s sin^2(beta/2) = R^2 - u` and `4 c s cos^2(beta/2) = u - rho^2`: beta makes one whole turn, in the
/// opposite direction to the carrier's.
#[derive(Clone, Debug)]
pub struct TwoBar {
    path: RequiredPath,
    distance: Distance,
    carrier: f64,
    arm: f64,
    /// Sense of rotation of the carrier while the tip moves along the path: 1 counter-clockwise, -1 clockwise.
    sense: f64,
    /// Direction of the carrier when carrier and arm are stretched, rad.
    start: f64,
    minimum_ratio: Extreme,
    maximum_ratio: Extreme,
}

/// Angles of both bars at a parameter of the path, with their first two derivatives by it, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainJet {
    /// Direction of the carrier from its axis.
    pub carrier: [f64; 3],
    /// Angle of the arm against the carrier: zero, plus or minus whole turns, where stretched.
    pub elbow: [f64; 3],
}

impl TwoBar {
    /// The chain with its carrier's axis at a position.
    ///
    /// `direction` is the sense of rotation of the carrier while the tip moves along the path. It is free if the axis lies
    /// outside the path; default: the sense with the smaller maximum |ln| of the ratio.
    ///
    /// # Errors
    /// [`AxisFault`] with the rule broken and the position on the path: the distance from the axis must have one maximum and one
    /// minimum, and the carrier and the arm against it must turn in one direction.
    pub fn new(
        path: &RequiredPath,
        axis: Point,
        direction: Option<Direction>,
    ) -> Result<Self, AxisFault> {
        let distance = Distance::new(path, axis)?;
        let winding = winding(path, axis);
        let required = direction.map(Direction::sign);
        match winding {
            0 => {}
            1 | -1 => {
                let sense = f64::from(winding);
                if required.is_some_and(|required| required != sense) {
                    let sense = if sense > 0.0 {
                        "counter-clockwise"
                    } else {
                        "clockwise"
                    };
                    return Err(AxisFault::Sense { sense });
                }
                return Self::of_sense(path, distance, sense, true);
            }
            turns => return Err(AxisFault::Winding { turns }),
        }
        if let Some(sense) = required {
            return Self::of_sense(path, distance, sense, false);
        }
        let [one, other] = [1.0, -1.0].map(|s| Self::of_sense(path, distance.clone(), s, false));
        match (one, other) {
            (Ok(one), Ok(other)) if other.unevenness() < one.unevenness() => Ok(other),
            (Ok(one), _) => Ok(one),
            (Err(_), Ok(other)) => Ok(other),
            (Err(fault), Err(_)) => Err(fault),
        }
    }

    fn of_sense(
        path: &RequiredPath,
        distance: Distance,
        sense: f64,
        is_inside: bool,
    ) -> Result<Self, AxisFault> {
        let [far, near] = distance.reach;
        let [long, short] = [0.5 * (far + near), 0.5 * (far - near)];
        let (carrier, arm) = if is_inside {
            (long, short)
        } else {
            (short, long)
        };
        let start = path.at(distance.far).point - distance.axis;
        let none = Extreme {
            input: 0.0,
            value: 1.0,
        };
        let mut chain = Self {
            path: path.clone(),
            distance,
            carrier,
            arm,
            sense,
            start: start.y.atan2(start.x),
            minimum_ratio: none,
            maximum_ratio: none,
        };
        chain.check()?;
        Ok(chain)
    }

    /// Finds the extremes of the ratio, and checks that both bars turn in one direction.
    fn check(&mut self) -> Result<(), AxisFault> {
        let minimum = MIN_SPEED * TAU / self.path.period();
        let looks = PathSamples::new(&self.path, usize::MAX);
        let mut known = Vec::with_capacity(looks.samples.len());
        for sample in &looks.samples {
            let speeds = self.speeds(sample.at, &sample.jet);
            // These samples already refuse most impossible axes; a speed that is not a number is refused, too.
            let turns_on = speeds[0] > minimum;
            if !turns_on {
                return Err(AxisFault::CarrierTurnsBack {
                    carrier: self.carrier,
                    at: sample.jet.point,
                });
            }
            known.push(speeds);
        }
        let maximum = |of: fn([f64; 2]) -> f64| {
            let samples: Vec<f64> = known.iter().map(|speeds| of(*speeds)).collect();
            let at = |t: f64| of(self.speeds(t, &self.path.at(t)));
            maximum_of_samples(&samples, at, rounding, &looks.pieces)
        };
        let at = |extreme: Extreme| self.path.at(extreme.input).point;
        let turns_on = |slowest: Extreme| -slowest.value > minimum;
        let carrier = maximum(|[carrier, _]| -carrier);
        if !turns_on(carrier) {
            return Err(AxisFault::CarrierTurnsBack {
                carrier: self.carrier,
                at: at(carrier),
            });
        }
        let elbow = maximum(|[_, elbow]| -elbow);
        if !turns_on(elbow) {
            return Err(AxisFault::ArmStops { at: at(elbow) });
        }
        let low = maximum(|[carrier, elbow]| -elbow / carrier);
        let high = maximum(|[carrier, elbow]| elbow / carrier);
        self.minimum_ratio = Extreme {
            value: -low.value,
            ..low
        };
        self.maximum_ratio = high;
        Ok(())
    }

    /// Speeds by the parameter: of the carrier in its sense, of the arm against the carrier in the opposite direction.
    pub(super) fn speeds(&self, t: f64, jet: &Jet) -> [f64; 2] {
        self.speed_series::<1>(t, jet).map(|speed| speed.0[0])
    }

    /// Speeds with up to two derivatives.
    ///
    /// From `C' = i psi' (C - O) + i beta' s e^(i alpha)` with alpha the direction of the arm.
    #[inline]
    pub(super) fn speed_series<const N: usize>(&self, t: f64, jet: &Jet) -> [Taylor<N>; 2] {
        let elbow = self.distance.turning(&self.path, self.inside(t).0, jet);
        let p: Vector = jet.point - self.distance.axis;
        let [d1, d2, _] = squares(jet, self.distance.axis);
        let u: Taylor<N> = taylor([p.norm_squared(), d1, 0.5 * d2]);
        let along = (u + (self.arm * self.arm - self.carrier * self.carrier)) * 0.5;
        let area = taylor([
            p.perp(&jet.first),
            p.perp(&jet.second),
            0.5 * (p.perp(&jet.third) + jet.first.perp(&jet.second)),
        ]);
        let carrier = (area * self.sense + elbow * along) / u;
        [carrier, elbow]
    }

    /// A parameter moved by whole turns into the turn that begins where the chain is stretched, and the number of these turns.
    fn inside(&self, t: f64) -> (f64, f64) {
        let (from, period) = (self.distance.far, self.path.period());
        if t >= from && t <= from + period {
            return (t, 0.0);
        }
        let turns = ((t - from) / period).floor();
        ((t - turns * period).clamp(from, from + period), turns)
    }

    /// Angles of both bars at any parameter of the path.
    #[must_use]
    pub fn at(&self, t: f64) -> ChainJet {
        let (inside, turns) = self.inside(t);
        let jet = self.path.at(inside);
        let [away, close] = self.distance.legs(&self.path, inside, &jet);
        let elbow = away.atan2(close) * (-2.0 * self.sense);
        // Cosine and sine of the arm's angle against the carrier.
        let area = 1.0 / (4.0 * self.carrier * self.arm);
        let cos = (close * close - away * away) * area;
        let sin = away * close * (-2.0 * self.sense * area);
        let p = jet.point - self.distance.axis;
        let series = |p: f64, d1: f64, d2: f64| -> Series { Taylor([p, d1, 0.5 * d2]) };
        let (x, y) = (
            series(p.x, jet.first.x, jet.second.x),
            series(p.y, jet.first.y, jet.second.y),
        );
        // Direction to the tip, minus the direction to the tip in the carrier's own axes.
        let (a, b) = (cos * self.arm + self.carrier, sin * self.arm);
        let carrier = (y * a - x * b).atan2(x * a + y * b);
        let turned = TAU * turns * self.sense;
        let principal = carrier.0[0];
        let mut since = (self.sense * (principal - self.start)).rem_euclid(TAU);
        // Rounding may move an angle near an end of the turn to the other end.
        let share = (inside - self.distance.far) / self.path.period();
        if since > TAU - ROUNDING && share < 0.25 {
            since -= TAU;
        }
        if since < ROUNDING && share > 0.75 {
            since += TAU;
        }
        ChainJet {
            carrier: [
                self.start + self.sense * since + turned,
                carrier.0[1],
                2.0 * carrier.0[2],
            ],
            elbow: [elbow.0[0] - turned, elbow.0[1], 2.0 * elbow.0[2]],
        }
    }

    /// The path.
    #[must_use]
    pub fn path(&self) -> &RequiredPath {
        &self.path
    }

    /// Axis about which the carrier turns, mm.
    #[must_use]
    pub fn axis(&self) -> Point {
        self.distance.axis
    }

    /// Length of the carrier, from its axis to the arm's, mm.
    #[must_use]
    pub fn carrier(&self) -> f64 {
        self.carrier
    }

    /// Length of the arm, from its axis to the tip, mm.
    #[must_use]
    pub fn arm(&self) -> f64 {
        self.arm
    }

    /// Sense of rotation of the carrier while the tip moves along the path.
    #[must_use]
    pub fn direction(&self) -> Direction {
        if self.sense > 0.0 {
            Direction::CounterClockwise
        } else {
            Direction::Clockwise
        }
    }

    pub(crate) fn sense(&self) -> f64 {
        self.sense
    }

    /// Parameter at which carrier and arm are stretched.
    #[must_use]
    pub fn stretched(&self) -> f64 {
        self.distance.far
    }

    /// Minimum distance of the tip from the carrier's axis, mm.
    #[must_use]
    pub fn shaft_distance(&self) -> f64 {
        self.distance.reach[1]
    }

    /// Minimum and maximum ratio of the total law, and the parameters of the path there.
    #[must_use]
    pub fn ratios(&self) -> [Extreme; 2] {
        [self.minimum_ratio, self.maximum_ratio]
    }

    /// Maximum |ln| of the ratio: zero for even motion.
    #[must_use]
    pub fn unevenness(&self) -> f64 {
        (-self.minimum_ratio.value.ln()).max(self.maximum_ratio.value.ln())
    }

    /// Position of the arm's axis, mm, for a direction of the carrier, rad.
    #[must_use]
    pub fn knee(&self, carrier: f64) -> Point {
        self.axis() + Vector::new(carrier.cos(), carrier.sin()) * self.carrier
    }

    /// Position of the tip, mm, for the angles of the carrier and of the arm relative to it, rad.
    #[must_use]
    pub fn tip(&self, carrier: f64, elbow: f64) -> Point {
        let arm = carrier + elbow;
        self.knee(carrier) + Vector::new(arm.cos(), arm.sin()) * self.arm
    }

    /// Parameter of the path by the direction of the carrier, rad.
    ///
    /// # Errors
    /// [`TransmissionError::StandsStill`] where rounding stops the carrier.
    pub fn by_carrier(&self) -> Result<Inverse, TransmissionError> {
        self.inverse(|jet| jet.carrier, self.sense)
    }

    /// Parameter of the path by the turn of the planet, rad: the turn of the arm relative to the carrier with its sign changed.
    ///
    /// # Errors
    /// [`TransmissionError::StandsStill`] if rounding stops the arm.
    pub fn by_planet(&self) -> Result<Inverse, TransmissionError> {
        self.inverse(|jet| jet.elbow.map(|x| -x), self.sense)
    }

    fn inverse(
        &self,
        angle: fn(ChainJet) -> [f64; 3],
        sense: f64,
    ) -> Result<Inverse, TransmissionError> {
        let chain = self.clone();
        let (period, breaks) = (self.path.period(), self.path.breaks().to_vec());
        let law = move |t: f64| {
            let [position, velocity, acceleration] = angle(chain.at(t));
            MotionJet {
                position,
                velocity,
                acceleration,
                // An inverse does not need the jerk.
                jerk: 0.0,
            }
        };
        Inverse::new(Arc::new(FromFn::new(period, sense * TAU, breaks, law)))
    }

    /// The total law: turn of the planet by the direction of the carrier, in pieces that are exact within rounding.
    ///
    /// Its velocity is the ratio; with a turn of the carrier it grows by one turn. It is zero where the chain is stretched.
    ///
    /// # Errors
    /// [`TransmissionError::StandsStill`] where rounding stops the carrier.
    pub fn law(&self) -> Result<Piecewise, TransmissionError> {
        let inverse = self.by_carrier()?;
        let breaks = self.breaks(|jet| jet.carrier[0]);
        let chain = self.clone();
        let planet = move |carrier: f64| {
            let t = inverse.at(carrier).position;
            MotionJet {
                position: -chain.at(t).elbow[0],
                // The pieces use the position only.
                ..MotionJet::default()
            }
        };
        Ok(FromFn::new(TAU, TAU, breaks, planet).pieces())
    }

    /// Values of `angle` in `[0, 2 pi)` at the breaks of the path, ascending.
    pub(super) fn breaks(&self, angle: impl Fn(ChainJet) -> f64) -> Vec<f64> {
        let breaks = self.path.breaks().iter();
        let angles = breaks.map(|&t| angle(self.at(t)).rem_euclid(TAU));
        sorted(angles, TAU)
    }
}

/// Turns of a path around a position, counter-clockwise positive: number of upward crossings of the half line from there along x,
/// minus number of downward crossings.
fn winding(path: &RequiredPath, axis: Point) -> i32 {
    let samples = path.samples();
    let next = samples.iter().cycle().skip(1);
    let crossings = samples.iter().zip(next).map(|(one, other)| {
        let (p, q) = (one.jet.point - axis, other.jet.point - axis);
        let upwards = i32::from(q.y > 0.0) - i32::from(p.y > 0.0);
        let is_ahead = p.perp(&q) * f64::from(upwards) > 0.0;
        if is_ahead { upwards } else { 0 }
    });
    crossings.sum()
}
