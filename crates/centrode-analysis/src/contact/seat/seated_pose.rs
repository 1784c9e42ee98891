use centrode_geometry::{Disc, Point, Run, Vector, checkpoint};

use super::{
    angular_contact::{AngularContact, ContactNormal},
    meshing::Meshing,
    proximity::Candidates,
    turn_search::{TurnLimits, TurnSearch},
};
use crate::contact::contour::Pose;

/// Backlash or penetration, modules, above which the search for a seat ends without one. A smaller one gives no seat
/// for a large backlash, a larger one takes longer for gears out of mesh.
const MAX_TURN: f64 = 2.0;

/// Maximum depth of penetration that is searched, modules: more than the height of a tooth.
const MAX_DEPTH: f64 = 4.0;

/// Depth of a test point below the outline, modules: a point at this depth inside the mate is no contact but a penetration.
const TEST_DEPTH: f64 = 1e-3;

/// Gap, modules, within which two seated flanks are in contact. Ten times less loses contacts by rounding of the
/// outlines, ten times more counts flanks that do not touch.
pub(in crate::contact) const SEATED: f64 = 1e-6;

/// Distance of the driven axis from a contact normal, modules, below which the contact cannot hold the driven gear.
/// With a smaller one the angle of rest is ill-conditioned, with a larger one real contacts are ignored.
const MIN_LEVER: f64 = 1e-3;

/// The driven gear at rest on the driver, pushed to one side.
pub(in crate::contact) struct SeatedPose {
    /// Driven angle, rad.
    pub(in crate::contact) angle: f64,
    /// Distance of the driven axis from the common normal, mm.
    pub(in crate::contact) lever: f64,
    /// Pairs of teeth in contact.
    pub(in crate::contact) contacts: u32,
    /// The contacts on the driver, one per pair of teeth.
    pub(in crate::contact) normals: Vec<ContactNormal>,
    /// Driven angle from which the contacts were searched, rad.
    pub(in crate::contact) search_angle: f64,
    pub(in crate::contact) angular_contacts: Vec<AngularContact>,
}

impl Meshing<'_> {
    /// Seats of the driven gear pushed forward and pushed back. The search distance grows until there is one; `None` if
    /// the gears are out of mesh.
    pub(in crate::contact) fn seats(
        &mut self,
        candidates: &Candidates,
        phi: f64,
        law: f64,
    ) -> [Option<SeatedPose>; 2] {
        let pose = Pose::new(phi, law, self.pair.center_distance());
        let distances = (self.search_distance, self.flank_distance);
        let mut seats = [1.0, -1.0].map(|sign| self.seat(candidates, phi, law, sign));
        // No contact within this distance: search farther.
        while seats.iter().any(Option::is_none) && self.flank_distance < MAX_TURN * self.module {
            self.flank_distance *= 3.0;
            self.search_distance = self.search_distance.max(self.flank_distance);
            let candidates = self.candidates(&pose);
            seats = [1.0, -1.0].map(|sign| self.seat(&candidates, phi, law, sign));
        }
        // Short or undercut teeth may penetrate so deeply that no sides that face each other are near.
        let free = |seats: &[Option<SeatedPose>; 2]| match seats {
            [Some(forward), Some(back)] => forward.angle <= back.angle,
            _ => false,
        };
        while !self.has_complete_teeth
            && free(&seats)
            && seats
                .iter()
                .flatten()
                .any(|s| self.penetrates_deeply(phi, s.angle))
            && self.search_distance < MAX_DEPTH * self.module
        {
            self.search_distance *= 2.0;
            let candidates = self.candidates(&pose);
            seats = [1.0, -1.0].map(|sign| self.seat(&candidates, phi, law, sign));
        }
        (self.search_distance, self.flank_distance) = distances;
        seats
    }

    /// Turns the driven gear back (`sign` 1) or forward (-1) until it rests on the driver.
    fn seat(&self, candidates: &Candidates, phi: f64, law: f64, sign: f64) -> Option<SeatedPose> {
        let a = self.pair.center_distance();
        let seated = SEATED * self.module;
        let (mut angle, mut pose) = (law, Pose::new(phi, law, a));
        let mut angular_contacts = self.first_contacts(candidates, &pose, sign);
        // Out of one penetration the gear may turn into the next one. If there is no room, it passes the other seat by the missing
        // room. Every step is larger than a seated gap, so the search ends.
        let max_turn = MAX_TURN * self.module / a;
        while (angle - law).abs() < max_turn {
            checkpoint();
            let first = angular_contacts.first()?;
            if sign * first.turn * first.lever < seated {
                break;
            }
            let turned = angle + first.turn;
            // A small step of a large angle may be lost in rounding.
            if turned == angle {
                break;
            }
            (angle, pose) = (turned, Pose::new(phi, turned, a));
            angular_contacts = self.first_contacts(&self.candidates(&pose), &pose, sign);
        }
        let first = *angular_contacts.first()?;
        angular_contacts.retain(|c| sign * (first.turn - c.turn) * c.lever <= seated);
        let teeth = |c: &AngularContact| {
            let (i, j) = c.parts;
            (self.driver.parts[i].tooth, self.driven.parts[j].tooth)
        };
        // The first contact of each pair of teeth counts.
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        angular_contacts.retain(|c| {
            let new = !pairs.contains(&teeth(c));
            if new {
                pairs.push(teeth(c));
            }
            new
        });
        Some(SeatedPose {
            angle: angle + first.turn,
            lever: first.lever,
            contacts: pairs.len() as u32,
            normals: angular_contacts
                .iter()
                .map(|c| c.contact_normal(&pose))
                .collect(),
            search_angle: angle,
            angular_contacts,
        })
    }

    /// Whether any test point of one gear lies in the other.
    fn penetrates_deeply(&self, phi: f64, angle: f64) -> bool {
        let pose = Pose::new(phi, angle, self.pair.center_distance());
        let (driver, driven) = (&self.driver, &self.driven);
        let depth = TEST_DEPTH * self.module;
        let on_driver = |group: &Run<Disc>| {
            let center = pose.point_to_driven(&group.bound.center).coords;
            driven.is_near(&center, group.bound.radius + depth)
        };
        let on_driven = |group: &Run<Disc>| {
            let center = pose.point_to_driver(&group.bound.center).coords;
            driver.is_near(&center, group.bound.radius + depth)
        };
        driver.tree.any(&on_driver, &mut |i| {
            driver.inner_point(i, depth).is_some_and(|p| {
                let back = pose.point_to_driven(&p);
                driven.is_near(&back.coords, 0.0) && driven.contains(back)
            })
        }) || driven.tree.any(&on_driven, &mut |j| {
            driven.inner_point(j, depth).is_some_and(|p| {
                let placed = pose.point_to_driver(&p);
                driver.is_near(&placed.coords, 0.0) && driver.contains(placed)
            })
        })
    }

    /// Contacts that stop the driven gear when it turns from a pose, in the order in which it reaches them.
    fn first_contacts(
        &self,
        candidates: &Candidates,
        pose: &Pose,
        sign: f64,
    ) -> Vec<AngularContact> {
        let (driver, driven) = (&self.driver, &self.driven);
        let penetrates = |a: &Vector, b: &Vector| {
            driven.contains(Point::from(*a))
                || driver.contains(pose.point_to_driver(&Point::from(*b)))
        };
        let limits = TurnLimits {
            max_turn: self.flank_distance / self.pair.center_distance(),
            max_depth: self.search_distance,
            tolerance: SEATED * self.module,
            min_lever: MIN_LEVER * self.module,
            facing: &self.previous_facing,
            penetrates: &penetrates,
        };
        let mut search = TurnSearch::new(&self.driver, &self.driven, *pose, sign, limits);
        for pair in &candidates.pairs {
            checkpoint();
            search.search(
                &candidates.driver[pair.driver].stretch,
                &self.stretches[pair.driven],
            );
        }
        search.finish()
    }
}
