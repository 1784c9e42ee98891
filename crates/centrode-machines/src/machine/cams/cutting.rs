//! Cams cut to the given motion of bodies.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{COMPUTED, Extreme, Point, extremes, maximum, piece_ends};
use nalgebra::Rotation2;

use crate::machine::body::points::{FACE, LocalPoint, ROLLER};
use crate::machine::cams::seating::{Seat, Turned, wrong};
use crate::machine::resolve::Builder;
use crate::machine::{BodyPoint, MachineCamSpec, MachineError, Mount};
use centrode_gear::cam::{Cam, CamError, DiscCam};
use centrode_kinematics::machine::JointKind;
use centrode_kinematics::transmission::{
    FromFn, Inverse, MotionJet, Transmission, TransmissionError, repeated, sorted,
};

/// Number of parts of a turn of the input, or of the cam; in each a motion has few extremes.
const PARTS: u32 = 24;
const JUMP: f64 = 1e-4;
/// Distance from a break at which rates are compared, as a share of the period.
const BESIDE: f64 = 1e-8;

/// Motion of a follower, for the cam that is cut to it.
struct Moved<'a> {
    cam: &'a str,
    body: &'a str,
    law: Arc<dyn Transmission>,
    /// Sense in which the cam lifts the body.
    sense: f64,
    /// Input and coordinate at which the body is on the base circle.
    low: Extreme,
    /// Distance (mm) or angle (rad) from the base circle to the highest point.
    stroke: f64,
    /// Inputs of a period at which a derivative may jump.
    breaks: Vec<f64>,
    period: f64,
}

impl Builder<'_> {
    /// Cuts the cams whose followers already have a motion.
    pub(in crate::machine) fn cut_cams(&mut self) -> Result<(), MachineError> {
        let design = self.design;
        for (name, spec) in &design.cams {
            if let Some(body) = &spec.cut_to {
                self.cut_to(name, spec, body)?;
            }
        }
        Ok(())
    }

    fn cut_to(&mut self, cam: &str, spec: &MachineCamSpec, name: &str) -> Result<(), MachineError> {
        let key = format!("cams.{cam}.cut_to");
        let Some(body) = self.body_named(name) else {
            let known = self.bodies.iter().map(|body| body.name.clone());
            return Err(MachineError::unknown(key, "body", name, known));
        };
        let moving = self.bodies[body].mount.clone();
        let Some(mount) = moving.filter(|mount| mount.kind != JointKind::Fixed) else {
            return wrong(&key, format!("body {name} neither turns nor slides"));
        };
        let slides = matches!(mount.kind, JointKind::Sliding(_)).then_some(mount.angle);
        let (body, at) = (mount.carrier, mount.at);
        let seat = self.seat(&key, name, slides, cam, spec, BodyPoint { body, at })?;
        let (turn, rotation, turns) = self.turned(&key, name, cam, spec, &seat)?;
        let point = match spec.follower.arm() {
            Some(_) => ROLLER,
            None => FACE,
        };
        let blame = |error: CamError| match error.key().as_str() {
            "motion" => MachineError::refused(key.clone(), error.to_string()),
            _ => {
                let cam = cam.into();
                MachineError::Cam { cam, error }
            }
        };
        let (part, at) = match self.cut_before(cam, name, point) {
            Some((cut, at)) if *cut.body() == spec.body => (cut.renamed(cam), at),
            _ => {
                let sense = spec.follower.sense();
                let moved = self.moved(&key, cam, name, &mount, &turn, sense)?;
                let carrier = &self.bodies[seat.carrier].name;
                let motion = moved.by_turn(&key, &turn, turns, carrier)?;
                let follower = spec.follower.at(seat.distance);
                let disc = DiscCam::new(motion, follower, spec.base_radius, rotation);
                let disc = disc.map_err(blame)?;
                let turned = turn.at(moved.low.input).position;
                let at = touching(&disc, &seat, &mount, &moved, turned);
                let part = Cam::new(disc, cam, spec.body.clone()).map_err(blame)?;
                (part, at)
            }
        };
        let points = self.points.entry(name.into()).or_default();
        let made = LocalPoint { at, own: true };
        if points.insert(point.into(), made).is_some() {
            let (body, point) = (name.into(), point.into());
            return Err(MachineError::PointTwice { key, body, point });
        }
        self.add_cam(name, cam, spec, &seat, Arc::new(part), turn);
        Ok(())
    }

    /// For a copy of a cam, the original as it was cut, and the point of its follower.
    fn cut_before(&self, cam: &str, body: &str, point: &str) -> Option<(Arc<Cam>, Point)> {
        let (bare, _) = self.original(body)?;
        let [cam, body] = [cam, body].map(|name| self.expansion.original(name));
        let cut = bare.cams().iter().find(|cut| cut.name == cam)?;
        let at = bare.points.get(body)?.get(point)?.at;
        Some((Arc::clone(&cut.part), at))
    }

    /// Motion of a body on its carrier; it must be periodic and without jumps.
    fn moved<'a>(
        &self,
        key: &str,
        cam: &'a str,
        body: &'a str,
        mount: &Mount,
        turn: &Turned,
        sense: f64,
    ) -> Result<Moved<'a>, MachineError> {
        let (law, period) = (Arc::clone(&mount.law), self.linkage.period());
        let turned = (law.at(period).position - law.at(0.0).position) / TAU;
        if turned.abs() > 0.5 && mount.kind == JointKind::Turning {
            let why = format!(
                "body {body} makes {turned:.6} turns on {} in a period: the follower of a cam must return",
                self.bodies[mount.carrier].name
            );
            return wrong(key, why);
        }
        let of_law = repeated(&*law, period).into_iter();
        let breaks = sorted(of_law.chain(turn.jumps(period)), period);
        let parts = PARTS * self.design.input.turns;
        let ends = piece_ends(0.0, period, parts, &breaks);
        let [low, high] = extremes(|input| sense * law.at(input).position, &ends);
        let stroke = high.value - low.value;
        if stroke <= COMPUTED {
            let why = format!("body {body} does not move: there is no cam to cut");
            return wrong(key, why);
        }
        let rate = maximum(|input| law.at(input).velocity.abs(), &ends).value;
        let step = BESIDE * period;
        for &at in &breaks {
            let [before, after] = [-step, step].map(|step| law.at(at + step));
            let jump = after.velocity - before.velocity;
            let curved = step * (before.acceleration.abs() + after.acceleration.abs());
            let gap = after.position - before.position;
            let passed = step * (before.velocity.abs() + after.velocity.abs()) + step * curved;
            let degrees = at.to_degrees();
            if gap.abs() > passed + JUMP * stroke {
                let why = format!(
                    "body {body} jumps by {gap:.9} (mm or rad) at an input of {degrees:.4} deg: no cam can make this motion"
                );
                return wrong(key, why);
            }
            if jump.abs() > curved + JUMP * rate {
                let why = format!(
                    "the speed of body {body} jumps from {:.9} to {:.9} per radian of the input at {degrees:.4} deg: no cam can make this motion",
                    before.velocity, after.velocity
                );
                return wrong(key, why);
            }
        }
        Ok(Moved {
            cam,
            body,
            law,
            sense,
            low,
            stroke,
            breaks,
            period,
        })
    }
}

impl Moved<'_> {
    /// Lift as a function of the cam's turn. The cam must turn in one direction, and the body must be back after every turn.
    fn by_turn(
        &self,
        key: &str,
        turn: &Turned,
        turns: f64,
        carrier: &str,
    ) -> Result<Arc<dyn Transmission>, MachineError> {
        let (cam, body) = (self.cam, self.body);
        if turns == 0.0 {
            let why = format!(
                "cam {cam} makes no whole turn relative to body {carrier}, which carries its follower {body}"
            );
            return wrong(key, why);
        }
        let own = turn.clone();
        let jumps = sorted(turn.jumps(self.period), self.period);
        let law = FromFn::new(self.period, turns * TAU, jumps, move |input| own.at(input));
        let inverse = match Inverse::new(Arc::new(law)) {
            Ok(inverse) => inverse,
            Err(TransmissionError::StandsStill { input, velocity }) => {
                let why = format!(
                    "cam {cam} must turn in one direction relative to body {carrier}, which carries its follower {body}, but at an input of {:.4} deg it turns at {velocity:.6} times the speed of the input",
                    input.to_degrees()
                );
                return wrong(key, why);
            }
            Err(error) => return wrong(key, error.to_string()),
        };
        let breaks = self.breaks.iter();
        let breaks = breaks.map(|input| turn.at(*input).position.rem_euclid(TAU));
        let breaks = sorted(breaks, TAU);
        let input = inverse.clone();
        let (law, sense, low) = (Arc::clone(&self.law), self.sense, self.low.value);
        let lift = move |angle: f64| {
            let input = input.at(angle);
            let moved = law.at(input.position).after(&input);
            let mut lift = MotionJet::default().plus(sense, &moved);
            lift.position -= low;
            lift
        };
        let ends = piece_ends(0.0, TAU, PARTS, &breaks);
        for turn in 1..turns as u32 {
            let later = f64::from(turn) * TAU;
            let off = |angle: f64| (lift(angle + later).position - lift(angle).position).abs();
            let off = maximum(off, &ends);
            if off.value > COMPUTED * self.stroke {
                let at = |angle: f64| inverse.at(angle).position.rem_euclid(self.period);
                let [first, then] = [off.input, off.input + later].map(at);
                let why = format!(
                    "the motion of body {body} does not repeat with every turn of cam {cam} relative to body {carrier} ({turns} turns in a period): at inputs of {:.4} and {:.4} deg the cam is in the same position, but the body is {:.9} (mm or rad) off",
                    first.to_degrees(),
                    then.to_degrees(),
                    off.value
                );
                return wrong(key, why);
            }
        }
        // Interpolated within rounding: cutting and checking the cam need thousands of values, each of which inverts the cam's
        // turn.
        Ok(Arc::new(FromFn::new(TAU, 0.0, breaks, lift).pieces()))
    }
}

/// Position of the centre of a body's roller, in the body's axes. For a flat face, the point of the face that touches the
/// base circle when the cam has turned by `turned` and the body is at its lowest.
fn touching(disc: &DiscCam, seat: &Seat, mount: &Mount, moved: &Moved<'_>, turned: f64) -> Point {
    let place = match disc.roller_center(turned) {
        Some(center) => center.point,
        None => disc.contact(turned).point,
    };
    let cam = Rotation2::new(seat.direction + disc.rotation().sign() * turned);
    let on_carrier = seat.axis + cam * place.coords - mount.at;
    let coordinate = moved.sense * moved.low.value;
    match mount.kind {
        JointKind::Turning => (Rotation2::new(-coordinate) * on_carrier).into(),
        _ => {
            let mut at = Rotation2::new(-mount.angle) * on_carrier;
            at.x -= coordinate;
            at.into()
        }
    }
}
