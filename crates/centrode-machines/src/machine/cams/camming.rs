//! Cams on their bodies, and the motions of their followers.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{COMPUTED, Outline, Point, Solid, SolidError, Tolerance};
use nalgebra::Isometry2;

use crate::machine::body::points::{ROLLER, Reference};
use crate::machine::cams::seating::{Seat, Turned, wrong};
use crate::machine::resolve::Builder;
use crate::machine::{Machine, MachineBodySpec, MachineCamSpec, MachineError};
use centrode_gear::cam::design::{Follower, Turn};
use centrode_gear::cam::{Cam, DiscCam, Motion};
use centrode_kinematics::machine::{Line, LineRole, Surface};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission, crossings};

/// Accuracy of the pitch curve in the picture, as a share of the base radius.
const DRAWN: f64 = 1e-6;

/// A cam of a composed machine.
#[derive(Clone, Debug)]
pub struct MachineCam {
    /// Name.
    pub name: String,
    /// Name of its body.
    pub(in crate::machine) body_name: String,
    /// The finished cam.
    pub part: Arc<Cam>,
    /// Position of its axis in the body's axes, mm.
    pub at: Point,
    /// Angle of its own axes against the body's, rad.
    pub mount: f64,
    /// Names of the bodies that follow it.
    pub followers: Vec<String>,
    /// Turn of the cam against the body that carries its follower, without jumps, positive in the cam's sense of rotation, rad:
    /// zero where the cam's motion begins.
    turn: Turned,
}

impl MachineCam {
    /// The exact cam.
    #[must_use]
    pub fn disc(&self) -> &DiscCam {
        self.part.disc()
    }

    /// Turn of the cam against the body that carries its follower, positive in the cam's sense of rotation, rad, as a function of
    /// the input: zero where the cam's motion begins. For several followers, that of the first.
    #[must_use]
    pub fn turn(&self, input: f64) -> MotionJet {
        self.turn.at(input)
    }

    /// Inputs of a period at which the cam has turned by an angle, rad, plus any whole turns.
    #[must_use]
    pub fn inputs(&self, angle: f64, period: f64) -> Vec<f64> {
        let turned = |input: f64| self.turn.at(input).position;
        crossings(turned, &[angle], TAU, period, &[])
    }

    /// Name of the cam's surface in the machine.
    #[must_use]
    pub fn surface_name(&self) -> String {
        format!("{}-profile", self.name)
    }

    /// Pose of the cam's axes in those of its body.
    fn place(&self) -> Isometry2<f64> {
        Isometry2::new(self.at.coords, self.mount)
    }

    /// The cam in its body's axes; `bottom` is the height of its lower face, mm.
    pub(in crate::machine) fn solid(&self, bottom: f64) -> Result<Solid, SolidError> {
        let place = self.place();
        let bore = self.part.bore().map(|bore| bore.transformed(&place));
        Solid::new(
            self.part.profile().outline().transformed(&place),
            bore.into_iter().collect(),
            bottom,
            bottom + self.part.body().width,
        )
    }

    /// The cam's contour as a surface for contact.
    pub(in crate::machine) fn surface(&self, solid: &Solid) -> Surface {
        Surface::of_solid(self.surface_name(), solid)
    }

    /// Contour, bore and path of the roller's centre in its body's axes.
    pub(in crate::machine) fn lines(&self) -> Vec<Line> {
        let place = self.place();
        let line = |role, outline: &Outline| Line::contour(role, &outline.transformed(&place));
        let mut lines = vec![line(LineRole::Body, self.part.profile().outline())];
        lines.extend(self.part.bore().map(|bore| line(LineRole::Hole, &bore)));
        let disc = self.disc();
        let path = Tolerance::new(DRAWN * disc.base_radius())
            .ok()
            .and_then(|tolerance| disc.pitch_curve(tolerance).ok().flatten());
        lines.extend(path.map(|path| line(LineRole::Pitch, &path)));
        lines
    }
}

impl Machine {
    /// Height of a cam's lower face along the shafts, mm: that of its layer. Cams without a layer lie one below the other, behind
    /// the gears.
    pub(in crate::machine) fn cam_bottom(&self, cam: &MachineCam) -> f64 {
        let cams = &self.written.cams;
        let (own, plates) = (self.original(&cam.name), &self.design.plates);
        if let Some(layer) = cams.get(own).and_then(|spec| spec.layer) {
            return plates.height_of(layer.into());
        }
        let upto = cams.iter().take_while(|(name, _)| name.as_str() <= own);
        let behind = upto.filter(|(_, spec)| spec.layer.is_none());
        let depth = behind.map(|(_, spec)| spec.body.width + plates.gap);
        self.gears_bottom() - depth.sum::<f64>()
    }

    /// Roller of a body that follows a cam, in the body's axes; `None` if the follower has a flat face or a point.
    pub(in crate::machine) fn roller(&self, body: &str) -> Option<Outline> {
        let follows = |cam: &&MachineCam| cam.followers.iter().any(|name| name == body);
        let disc = self.cams.iter().find(follows)?.disc();
        let radius = disc.follower().roller_radius()?;
        let at = self.points.get(body)?.get(ROLLER)?.at;
        (radius > 0.0).then(|| Outline::circle(at, radius))
    }
}

impl Builder<'_> {
    /// Motion of a body that follows a cam.
    ///
    /// With gamma the angle of the cam, delta the direction of the slide or of the line from the cam's axis to the body's pin,
    /// both against the carrier, and s the cam's sense of rotation, the cam has turned by s (gamma - delta).
    pub(in crate::machine) fn following(
        &mut self,
        name: &str,
        body: &MachineBodySpec,
        cam: &str,
    ) -> Result<Arc<dyn Transmission>, MachineError> {
        let key = format!("bodies.{name}.law.follows");
        let spec = &self.design.cams[cam];
        // The motions of dyads built before are needed.
        self.follow()?;
        let on = body.on.as_deref().unwrap_or_default();
        let held = self.place(&format!("bodies.{name}.on"), on)?;
        let seat = self.seat(&key, name, body.slides, cam, spec, held)?;
        let (turn, rotation, _) = self.turned(&key, name, cam, spec, &seat)?;
        let period = self.linkage.period();
        let follower = spec.follower.at(seat.distance);
        let part = self.cut(name, cam, spec, follower, rotation)?;
        let disc = part.disc().clone();
        let start = body
            .law
            .as_ref()
            .map_or(0.0, crate::machine::MachineLawSpec::offset);
        let sense = spec.follower.sense();
        let zero = start + seat.lowest(&disc, sense);
        let breaks = turn.breaks(disc.motion(), period);
        self.add_cam(name, cam, spec, &seat, part, turn.clone());
        let at = move |input: f64| {
            let turned = turn.at(input);
            let lift = disc.motion().at(turned.position).after(&turned);
            let mut own = MotionJet::default().plus(sense, &lift);
            own.position += zero;
            own
        };
        Ok(Arc::new(FromFn::new(period, 0.0, breaks, at)))
    }

    /// Adds a follower of a cam; the first follower also adds the cam.
    pub(super) fn add_cam(
        &mut self,
        follower: &str,
        cam: &str,
        spec: &MachineCamSpec,
        seat: &Seat,
        part: Arc<Cam>,
        turn: Turned,
    ) {
        let made = self.cams.entry(cam.into()).or_insert_with(|| MachineCam {
            name: cam.into(),
            body_name: Reference::to_body(&spec.on).body,
            part,
            at: seat.cam.at,
            mount: spec.mount,
            followers: Vec::new(),
            turn,
        });
        made.followers.push(follower.into());
    }

    /// The cam for a follower. A cam that has a follower already is returned if the new follower is held in the same manner.
    fn cut(
        &self,
        name: &str,
        cam: &str,
        spec: &MachineCamSpec,
        follower: Follower,
        rotation: Turn,
    ) -> Result<Arc<Cam>, MachineError> {
        if let Some(made) = self.cams.get(cam) {
            let disc = made.disc();
            let (own, other) = (follower.axis_distance(), disc.follower().axis_distance());
            let off = (own - other).abs() > COMPUTED * own.abs().max(other.abs());
            if off || disc.rotation() != rotation {
                let why = match off {
                    true => format!("body {name} is {own} mm from the axis of cam {cam}"),
                    false => format!("relative to body {name} cam {cam} turns"),
                };
                let first = &made.followers[0];
                let but = if off {
                    format!(", but body {first} is at {other} mm")
                } else {
                    format!(" opposite to its direction relative to {first}")
                };
                let why = format!("{why}{but}: one profile cannot move both");
                return wrong(&format!("bodies.{name}.law.follows"), why);
            }
            return Ok(Arc::clone(&made.part));
        }
        let blame = |error| {
            let cam = cam.into();
            MachineError::Cam { cam, error }
        };
        let Some(motion) = &spec.motion else {
            let other = spec.cut_to.as_deref().unwrap_or_default();
            let why = format!(
                "cam {cam} is cut to the motion of body {other}, and can move no other body"
            );
            return wrong(&format!("bodies.{name}.law.follows"), why);
        };
        let motion = Motion::resolve(motion).map_err(|error| blame(error.into()))?;
        let disc = DiscCam::new(Arc::new(motion), follower, spec.base_radius, rotation);
        let part = Cam::new(disc.map_err(blame)?, cam, spec.body.clone());
        part.map(Arc::new).map_err(blame)
    }

    /// Checks that every cam has a follower, and a name that no gear or body has.
    pub(in crate::machine) fn check_cams(&self) -> Result<(), MachineError> {
        for name in self.design.cams.keys() {
            let gear = self.gears.iter().any(|gear| gear.name == *name);
            let why = if gear || self.points.contains_key(name) {
                let what = if gear { "gear" } else { "body" };
                format!("there is also a {what} named {name}: their files would have the same name")
            } else if self.cams.contains_key(name) {
                continue;
            } else {
                format!("no body follows cam {name}: give a body law = {{ follows = {name:?} }}")
            };
            return wrong(&format!("cams.{name}"), why);
        }
        Ok(())
    }
}
