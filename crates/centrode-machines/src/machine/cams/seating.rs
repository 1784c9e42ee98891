//! Positions of cams and followers relative to each other.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{COMPUTED, Point, Vector, extremes, piece_ends};

use crate::machine::gears::mesh::Angle;
use crate::machine::resolve::Builder;
use crate::machine::{BodyPoint, MachineCamSpec, MachineError};
use centrode_gear::cam::DiscCam;
use centrode_gear::cam::design::{Follower, Turn};
use centrode_kinematics::transmission::{MotionJet, Transmission, crossings, sorted};

/// Number of parts of a turn of the input; in each the turn of a cam has few extremes.
const PARTS: u32 = 24;
/// Movement of an axis, as a share of the base radius, below which the axis counts as fixed.
const SAME: f64 = 1e-12;

/// Position of a cam relative to the body that carries its follower.
pub(in crate::machine) struct Seat {
    /// The cam's axis, as a point of the cam's body.
    pub(in crate::machine) cam: BodyPoint,
    /// Index of the carrier, and the position of the cam's axis on it, mm.
    pub(in crate::machine) carrier: usize,
    pub(in crate::machine) axis: Point,
    /// Direction of the slide on the carrier, or from the cam's axis to the follower's pin, rad.
    pub(in crate::machine) direction: f64,
    /// Distance of the slide or of the pin from the cam's axis, mm.
    pub(in crate::machine) distance: f64,
    /// Distance from the cam's axis to the point at which the body is held, along its slide, mm.
    along: f64,
}

impl Seat {
    /// Coordinate of a follower on the base circle, rad or mm. Its first axis points to the roller or along the face, or its
    /// origin is the roller's centre or on the face.
    pub(in crate::machine) fn lowest(&self, disc: &DiscCam, sense: f64) -> f64 {
        match disc.follower() {
            Follower::TranslatingRoller(_) => disc.start_distance() - self.along,
            Follower::TranslatingFlat(_) => disc.base_radius() - self.along,
            _ => wrapped(self.direction + PI + sense * disc.start_angle()),
        }
    }
}

/// Turn of a cam against the carrier of its follower, as a function of the input.
#[derive(Clone, Debug)]
pub(in crate::machine) struct Turned {
    cam: Angle,
    carrier: Angle,
    /// Direction of the slide on the carrier, or from the cam's axis to the follower's pin, rad.
    direction: f64,
    pub(in crate::machine) sense: f64,
}

impl Turned {
    pub(in crate::machine) fn at(&self, input: f64) -> MotionJet {
        let mut turn = self.cam.at(input).plus(-1.0, &self.carrier.at(input));
        turn.position -= self.direction;
        MotionJet::default().plus(self.sense, &turn)
    }

    /// Inputs of a period at which a derivative of `motion`, applied to this turn, may jump.
    pub(in crate::machine) fn breaks(&self, motion: &dyn Transmission, period: f64) -> Vec<f64> {
        let (own, cycle) = (motion.breaks(), motion.period());
        let jumps: Vec<f64> = self.jumps(period).collect();
        let met = crossings(|input| self.at(input).position, &own, cycle, period, &jumps);
        sorted(jumps.into_iter().chain(met), period)
    }

    /// Inputs of a period at which a derivative of this turn may jump.
    pub(in crate::machine) fn jumps(&self, period: f64) -> impl Iterator<Item = f64> + use<> {
        let [cam, carrier] = [&self.cam, &self.carrier].map(|angle| angle.breaks(period));
        cam.into_iter().chain(carrier)
    }
}

impl Builder<'_> {
    /// Position of a cam relative to the carrier of a body that is held at `pin` and slides in a direction, rad, or turns.
    pub(in crate::machine) fn seat(
        &self,
        key: &str,
        name: &str,
        slides: Option<f64>,
        cam: &str,
        spec: &MachineCamSpec,
        pin: BodyPoint,
    ) -> Result<Seat, MachineError> {
        let cam_key = format!("cams.{cam}");
        let words = ["slides", "turns"].map(|word| format!("a body that {word}"));
        let swings = spec.follower.swings();
        if swings == slides.is_some() {
            let [own, other] = [&words[usize::from(!swings)], &words[usize::from(swings)]];
            return wrong(
                key,
                format!("the follower of cam {cam} needs {other}, not {own}"),
            );
        }
        let still = SAME * spec.base_radius;
        let mut point = self.place(&format!("{cam_key}.on"), &spec.on)?;
        if let Some(about) = &spec.about {
            let key = format!("{cam_key}.about");
            let there = self.place(&key, about)?;
            let Some(found) = self.axis_on(point.body, there, still) else {
                let why = format!(
                    "{about} moves relative to body {}",
                    self.bodies[point.body].name
                );
                return wrong(
                    &key,
                    format!("{why}: cam {cam} on this body cannot be mounted about it"),
                );
            };
            point.at = found;
        }
        let Some(axis) = self.axis_on(pin.body, point, still) else {
            let why = format!(
                "the axis of cam {cam} must be fixed on body {}, but moves relative to it",
                self.bodies[pin.body].name
            );
            return wrong(key, why);
        };
        let way = pin.at - axis;
        let (direction, distance, along) = match slides {
            Some(direction) => {
                let unit = Vector::new(direction.cos(), direction.sin());
                (direction, unit.perp(&way), unit.dot(&way))
            }
            None => (way.y.atan2(way.x), way.norm(), 0.0),
        };
        let (what, written) = spec.follower.written();
        if let Some(written) = written
            && (written - distance).abs() > COMPUTED * distance.abs().max(written.abs())
        {
            let why = format!("is {written} mm, but body {name} is at {distance} mm");
            return wrong(&format!("{cam_key}.follower.{what}"), why);
        }
        Ok(Seat {
            cam: point,
            carrier: pin.body,
            axis,
            direction,
            distance,
            along,
        })
    }

    /// Turn of a cam against the carrier of a follower, its sense of rotation, and the whole turns per period in that sense.
    pub(in crate::machine) fn turned(
        &self,
        key: &str,
        name: &str,
        cam: &str,
        spec: &MachineCamSpec,
        seat: &Seat,
    ) -> Result<(Turned, Turn, f64), MachineError> {
        let carrier = &self.bodies[seat.carrier].name;
        let mut turn = Turned {
            cam: self.angle(seat.cam.body).plus(spec.mount),
            carrier: self.angle(seat.carrier),
            direction: seat.direction,
            sense: 1.0,
        };
        let period = self.linkage.period();
        let turns = (turn.at(period).position - turn.at(0.0).position) / TAU;
        if (turns - turns.round()).abs() > COMPUTED {
            let why = format!(
                "cam {cam} makes {turns:.9} turns relative to body {carrier} in the period of {} turns of the input. This must be a whole number: set input.turns",
                self.design.input.turns
            );
            return wrong(key, why);
        }
        let jumps: Vec<f64> = turn.jumps(period).collect();
        let parts = piece_ends(0.0, period, PARTS * self.design.input.turns, &jumps);
        let rate = |input: f64| turn.at(input).velocity;
        let stands = || {
            let [slow, fast] = extremes(rate, &parts);
            slow.value.abs().max(fast.value) <= COMPUTED
        };
        // The extremes are only computed if the cam is at rest at all ends of the parts, which is rare.
        if parts.iter().all(|input| rate(*input).abs() <= COMPUTED) && stands() {
            let why = format!(
                "cam {cam} does not turn relative to body {carrier}, which carries its follower {name}"
            );
            return wrong(key, why);
        }
        let rotation = match (spec.rotation, turns.round()) {
            (None, turns) if turns < 0.0 => Turn::Clockwise,
            (None, _) => Turn::CounterClockwise,
            (Some(rotation), turns) if turns * rotation.sign() < 0.0 => {
                let why = format!(
                    "cam {cam} makes {turns} turns (counter-clockwise positive) relative to body {carrier}, which carries its follower {name}: this is opposite to rotation"
                );
                return wrong(&format!("cams.{cam}.rotation"), why);
            }
            (Some(rotation), _) => rotation,
        };
        turn.sense = rotation.sign();
        let turns = turn.sense * turns.round();
        Ok((turn, rotation, turns))
    }
}

/// The error of a cam that cannot be followed.
pub(in crate::machine) fn wrong<T>(key: &str, why: String) -> Result<T, MachineError> {
    Err(MachineError::refused(key, why))
}

/// An angle without its whole turns, from -pi to pi.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
