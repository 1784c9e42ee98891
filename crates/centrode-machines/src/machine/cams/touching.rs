//! Contacts of cams with their followers.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Point, Recent, Vector};
use nalgebra::Rotation2;

use crate::machine::body::points::ROLLER;
use crate::machine::{Machine, MachineCam};
use centrode_kinematics::machine::{Contact, ContactLine};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};

impl Machine {
    /// Contacts of the cams with followers whose motion is not also held by a dyad or a mesh.
    pub(in crate::machine) fn contacts(&self) -> Vec<Contact> {
        if self.cams.is_empty() {
            return Vec::new();
        }
        let own = Arc::new(self.clone());
        let cams = self.cams.iter().enumerate();
        let both =
            cams.flat_map(|(index, cam)| cam.followers.iter().map(move |name| (index, name)));
        let contact = |(index, name): (usize, &String)| self.contact(&own, index, name);
        both.filter_map(contact).collect()
    }

    fn contact(&self, own: &Arc<Self>, index: usize, name: &str) -> Option<Contact> {
        let cam = &self.cams[index];
        let follower = self.body_named(name)?;
        let curve = self.body_named(&cam.body_name)?;
        let mount = self.bodies[follower].mount.as_ref()?;
        let tied = self
            .dyads
            .iter()
            .any(|dyad| dyad.bodies.contains(&follower));
        if tied || self.meshes.iter().any(|mesh| mesh.moved == follower) {
            return None;
        }
        let roller = self.points.get(name).and_then(|points| points.get(ROLLER));
        let roller = roller.map(|roller| roller.at);
        let at = roller.unwrap_or_else(Point::origin);
        let first = self.pushed(cam, [curve, follower], roller, 0.0).0;
        let near =
            move |angle: f64| first + (angle - first) - TAU * ((angle - first) / TAU).round();
        // Both laws of a contact line are evaluated at the same inputs.
        let last: Arc<Recent<u64, (f64, f64)>> = Arc::new(Recent::new());
        let law = |of: fn((f64, f64)) -> f64| -> Arc<dyn Transmission> {
            let (own, last) = (Arc::clone(own), Arc::clone(&last));
            let at = move |input: f64| {
                let line = last.get(&input.to_bits(), || {
                    let pushed = own.pushed(&own.cams[index], [curve, follower], roller, input);
                    (near(pushed.0), pushed.1)
                });
                MotionJet::at_rest(of(line))
            };
            Arc::new(FromFn::new(self.period(), 0.0, mount.law.breaks(), at))
        };
        let line = ContactLine {
            angle: law(|(angle, _)| angle),
            arm: law(|(_, arm)| arm),
        };
        Some(Contact {
            links: [curve, follower],
            joint: follower - 1,
            at: [at.x, at.y, 0.0],
            normal: None,
            line: Some(line),
        })
    }

    /// Direction (rad) in which a cam pushes, in the follower's axes, and the moment of a unit force about the follower's
    /// origin, mm. The force on a roller goes through its centre, in the follower's axes.
    fn pushed(
        &self,
        cam: &MachineCam,
        [curve, follower]: [usize; 2],
        roller: Option<Point>,
        input: f64,
    ) -> (f64, f64) {
        let disc = cam.disc();
        let axis = self.place(curve, cam.at, input);
        let gamma = self.angle(curve, input).position + cam.mount;
        let origin = self.place(follower, Point::origin(), input);
        let own = self.angle(follower, input).position;
        let delta = if disc.follower().swings() {
            let way = origin - axis;
            way.y.atan2(way.x)
        } else {
            own
        };
        let touched = disc.contact(disc.rotation().sign() * (gamma - delta));
        let turn = |angle: f64, v: Vector| Rotation2::new(angle) * v;
        let along = turn(gamma - own, touched.normal);
        let at = roller.map_or_else(
            || turn(-own, axis + turn(gamma, touched.point.coords) - origin),
            |roller| roller.coords,
        );
        (along.y.atan2(along.x), at.perp(&along))
    }
}
