//! Search for the angle at which the driven gear, turned about its axis, comes to rest against the driver.
//!
//! In polar coordinates about the driven axis a point of either contour has a distance and an angle. Two points at the same distance
//! meet when the driven gear turns by the difference of their angles. The gear rests at the extreme of this difference over all
//! distances.
//!
//! Take two stretches along which the distance is monotone and whose minimum curvatures have a positive sum. The difference has one
//! extreme between them: inside, where the tangents agree, or at an end. Other stretches are halved.

use centrode_geometry::{Vector, bracketed_root};

use super::{
    angular_contact::AngularContact, facing_points::FacingParts, meeting_points::MeetingPoints,
};
use crate::contact::contour::{
    ContourPoint, DividedStretch, GearOutline, Pose, PosedContour, SETTLED, Stretch,
};

/// Size below which a stretch counts as a point, as a share of the tolerance of a contact. A larger share makes the
/// seat less exact, a smaller one halves stretches down to rounding.
const POINT: f64 = 1e-5;

/// Search for the first contacts when the driven gear turns back (`sign` 1) or forward (-1).
pub(super) struct TurnSearch<'a> {
    driver: PosedContour<'a>,
    driven: PosedContour<'a>,
    sign: f64,
    limits: TurnLimits<'a>,
    /// Maximum `sign * turn` found, rad.
    best: f64,
    /// Minimum turn of a contact that counts next to the best one.
    floor: Floor,
    contacts: Vec<AngularContact>,
}

/// Rotation of the driver relative to the driven gear: `sign` times an angle, with its sine and cosine.
struct Floor {
    /// Angle, rad.
    turn: f64,
    sin: f64,
    cos: f64,
}

impl Floor {
    fn new(sign: f64, turn: f64) -> Self {
        let (sin, cos) = (sign * turn).sin_cos();
        Self { turn, sin, cos }
    }
}

/// Limits of a search.
pub(super) struct TurnLimits<'a> {
    /// Maximum rotation searched, rad.
    pub(super) max_turn: f64,
    /// Maximum penetration in the first pose that is searched, mm.
    pub(super) max_depth: f64,
    /// Gap or penetration within which there is contact, mm. A deeper penetration is tested by `penetrates`.
    pub(super) tolerance: f64,
    /// Distance of the driven axis from a contact normal below which the contact cannot hold the driven gear, mm.
    pub(super) min_lever: f64,
    /// Parts that face each other in the first pose.
    pub(super) facing: &'a [FacingParts],
    /// Whether a point of the driver lies in the driven gear, or one of the driven gear in the driver.
    pub(super) penetrates: &'a dyn Fn(&Vector, &Vector) -> bool,
}

impl<'a> TurnSearch<'a> {
    pub(super) fn new(
        driver: &'a GearOutline<'a>,
        driven: &'a GearOutline<'a>,
        pose: Pose,
        sign: f64,
        limits: TurnLimits<'a>,
    ) -> Self {
        Self {
            driver: PosedContour {
                body: driver,
                pose: Some(pose),
            },
            driven: PosedContour {
                body: driven,
                pose: None,
            },
            sign,
            best: -limits.max_turn,
            floor: Floor::new(sign, -limits.max_turn),
            limits,
            contacts: Vec::new(),
        }
    }

    /// Contacts within the tolerance of the first one, that one first; empty if there is none within the maximum rotation.
    pub(super) fn finish(mut self) -> Vec<AngularContact> {
        let floor = self.floor.turn;
        self.contacts.retain(|c| self.sign * c.turn >= floor);
        let order = |c: &AngularContact| -self.sign * c.turn;
        self.contacts.sort_by(|p, q| order(p).total_cmp(&order(q)));
        self.contacts
    }

    /// Searches two stretches for a contact that may be the first.
    pub(super) fn search(&mut self, one: &DividedStretch, other: &DividedStretch) {
        let (a, b) = (&one.whole, &other.whole);
        // A driven gear that turns back (or forward) is stopped only by sides of the driver that push it forward (or
        // back).
        if a.sense * self.sign > 0.0 || b.sense * self.sign < 0.0 || self.cannot_meet(a, b) {
            return;
        }
        if a.sense == 0.0 || b.sense == 0.0 {
            let first = b.sense != 0.0 || (a.sense == 0.0 && a.radius > b.radius);
            let larger = if first { a } else { b };
            // At an extreme of the distance a contact cannot hold the gear, and the neighbouring stretches end there too.
            if self.is_idle(larger) || larger.radius < POINT * self.limits.tolerance {
                return;
            }
            if first {
                for part in one.parts(&self.driver, self.limits.min_lever) {
                    self.search(part, other);
                }
            } else {
                for part in other.parts(&self.driven, self.limits.min_lever) {
                    self.search(one, part);
                }
            }
            return;
        }
        let low = a.squared[0].max(b.squared[0]);
        let high = a.squared[1].min(b.squared[1]);
        if low > high {
            return;
        }
        // Parts that face each other in the first pose meet after a small rotation, and at one point only.
        if let Some(at) = self.known_facing(a, b)
            && self.curvature_sum(a, b).0 > 0.0
            && let Some(meeting) = self.tangent_meeting(a, b, at)
        {
            self.add(a, b, &meeting);
            return;
        }
        if a.is_whole() && b.is_whole() {
            // The halves of whole parts are cached, and most of these halves cannot meet.
            for part in one.parts(&self.driver, self.limits.min_lever) {
                for mate in other.parts(&self.driven, self.limits.min_lever) {
                    self.search(part, mate);
                }
            }
            return;
        }
        let ends = [low, high].map(|squared| self.meeting(a, b, squared));
        for meeting in &ends {
            self.add(a, b, meeting);
        }
        self.search_between(a, b, &ends);
    }

    /// Searches the stretches between two meetings.
    fn search_between(&mut self, a: &Stretch, b: &Stretch, ends: &[MeetingPoints; 2]) {
        let a = self.driver.between(a, ends.map(|m| m.driver));
        let b = self.driven.between(b, ends.map(|m| m.driven));
        if self.cannot_meet(&a, &b) {
            return;
        }
        let (min_curvature, max_curvature) = self.curvature_sum(&a, &b);
        let rising = ends.each_ref().map(|m| self.sign * m.slope_difference());
        if min_curvature > 0.0 {
            if rising[0] > 0.0 && rising[1] < 0.0 {
                let meeting = self.extreme(&a, &b, ends);
                self.add(&a, &b, &meeting);
            }
            return;
        }
        // Straight stretches stop the gear only at their ends. Idle stretches cannot stop it.
        let straight = a.bounds.sagitta + b.bounds.sagitta <= POINT * self.limits.tolerance;
        if max_curvature <= 0.0 || straight || self.is_idle(&a) || self.is_idle(&b) {
            return;
        }
        let squared = ends.each_ref().map(|m| m.driven.point.norm_squared());
        let between = 0.5 * (squared[0] + squared[1]);
        let middle = self.meeting(&a, &b, between);
        // The halving ends when the middle is not strictly between the ends, or not a number.
        let found = middle.driven.point.norm_squared();
        let [low, high] = [squared[0].min(squared[1]), squared[0].max(squared[1])];
        let has_middle = low < found
            && found < high
            && ends
                .iter()
                .all(|m| middle.driver.u != m.driver.u || middle.driven.u != m.driven.u);
        if !has_middle {
            return;
        }
        self.add(&a, &b, &middle);
        self.search_between(&a, &b, &[ends[0], middle]);
        self.search_between(&a, &b, &[middle, ends[1]]);
    }

    /// Whether no contact along the stretch's normals can stop the driven gear.
    fn is_idle(&self, stretch: &Stretch) -> bool {
        stretch.max_lever() < self.limits.min_lever
    }

    /// Bounds of the sum of two stretches' curvatures.
    fn curvature_sum(&self, a: &Stretch, b: &Stretch) -> (f64, f64) {
        let [a, b] = [self.driver.curvature(a), self.driven.curvature(b)];
        (a.0 + b.0, a.1 + b.1)
    }

    /// Parameters at which two whole parts face each other in the first pose.
    fn known_facing(&self, a: &Stretch, b: &Stretch) -> Option<(f64, f64)> {
        let are_whole = a.is_whole() && b.is_whole();
        let facing = |f: &&FacingParts| are_whole && f.parts == (a.part, b.part);
        self.limits.facing.iter().find(facing).map(|f| f.at)
    }

    /// Whether two stretches can neither meet at a turn above the floor nor penetrate in the first pose.
    fn cannot_meet(&self, a: &Stretch, b: &Stretch) -> bool {
        if a.squared[0] > b.squared[1] || b.squared[0] > a.squared[1] {
            return true;
        }
        let Floor {
            turn: floor,
            sin,
            cos,
        } = self.floor;
        let distance = a.squared[1].min(b.squared[1]).sqrt();
        let near = a.radius + b.radius + (-floor * distance).max(self.limits.max_depth);
        if (a.center - b.center).norm_squared() > near * near {
            return true;
        }
        // With the driver turned to the floor: compare the extents along the normals of the two chords.
        let turned = a
            .point
            .map(|p| Vector::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x));
        let across = turned[1] - turned[0];
        let sweep = self.limits.max_depth / distance - floor;
        [b.point[1] - b.point[0], -across].into_iter().any(|chord| {
            let normal = Vector::new(chord.y, -chord.x);
            let size = normal.norm();
            let [p, q] = turned.map(|p| normal.dot(&p));
            let [r, s] = b.point.map(|p| normal.dot(&p));
            let overshoot = a.bounds.overshoot(&across, &-normal)
                + b.bounds.overshoot(&(b.point[1] - b.point[0]), &normal);
            let gap = p.min(q) - r.max(s) - overshoot;
            // From the floor on the gap opens at this rate, minus the part that the circular path takes back.
            let opening = turned.map(|p| -self.sign * p.perp(&normal));
            let rate = opening[0].min(opening[1]) - a.bounds.sagitta * size;
            gap > 0.0 && gap > sweep * (0.5 * distance * size * sweep - rate)
        })
    }

    /// The points of two stretches at a squared distance from the driven axis.
    fn meeting(&self, a: &Stretch, b: &Stretch, squared: f64) -> MeetingPoints {
        MeetingPoints {
            driver: self.driver.at_distance(a, squared),
            driven: self.driven.at_distance(b, squared),
        }
    }

    /// Meeting at the only extreme of the driven gear's rotation between two meetings. There the contours have a common tangent.
    fn extreme(&self, a: &Stretch, b: &Stretch, ends: &[MeetingPoints; 2]) -> MeetingPoints {
        let slopes = ends.each_ref().map(MeetingPoints::slope_difference);
        let share = slopes[0] / (slopes[0] - slopes[1]);
        let part =
            |of: fn(&MeetingPoints) -> f64| of(&ends[0]) + (of(&ends[1]) - of(&ends[0])) * share;
        self.tangent_meeting(a, b, (part(|m| m.driver.u), part(|m| m.driven.u)))
            .unwrap_or_else(|| {
                let squared = ends.each_ref().map(|m| m.driver.point.norm_squared());
                let off = |squared: f64| self.meeting(a, b, squared).slope_difference();
                let at = bracketed_root(off, squared[0], squared[1], slopes[0], slopes[1]);
                self.meeting(a, b, at)
            })
    }

    /// Meeting with common tangent, by Newton's method from an estimate; `None` if it leaves a stretch.
    fn tangent_meeting(
        &self,
        a: &Stretch,
        b: &Stretch,
        (mut u, mut v): (f64, f64),
    ) -> Option<MeetingPoints> {
        for _ in 0..8 {
            if !(a.u[0] <= u && u <= a.u[1] && b.u[0] <= v && v <= b.u[1]) {
                return None;
            }
            let p = self.driver.at(a.part, u);
            let q = self.driven.at(b.part, v);
            let (x, y) = (p.point.coords, q.point.coords);
            let (rate, mate) = (x.dot(&p.first), y.dot(&q.first));
            let (across, over) = (x.perp(&p.first), y.perp(&q.first));
            let d = over * rate - across * mate;
            let d_u = over * (p.first.norm_squared() + x.dot(&p.second)) - x.perp(&p.second) * mate;
            let d_v =
                y.perp(&q.second) * rate - across * (q.first.norm_squared() + y.dot(&q.second));
            let rest = 0.5 * (x.norm_squared() - y.norm_squared()) / mate;
            let du = -(d + d_v * rest) / (d_u + d_v * rate / mate);
            let dv = rest + du * rate / mate;
            if du.abs() < SETTLED && dv.abs() < SETTLED {
                return Some(MeetingPoints {
                    driver: ContourPoint {
                        u,
                        point: x,
                        tangent: p.first,
                    },
                    driven: ContourPoint {
                        u: v,
                        point: y,
                        tangent: q.first,
                    },
                });
            }
            (u, v) = (u + du, v + dv);
        }
        None
    }

    /// Adds a meeting as a contact if its turn is above the floor.
    fn add(&mut self, a: &Stretch, b: &Stretch, meeting: &MeetingPoints) {
        let turn = meeting.angle();
        let value = self.sign * turn;
        if value < self.floor.turn || value.is_nan() {
            return;
        }
        // If the gears penetrate in the first pose, one of the two points must lie in the other gear.
        if value * meeting.driver.point.norm() > self.limits.tolerance
            && !(self.limits.penetrates)(&meeting.driver.point, &meeting.driven.point)
        {
            return;
        }
        // At a corner of the driver the tangent is that of the mate.
        let at_corner = meeting.driver.u.abs() == 1.0;
        let ContourPoint { point, tangent, .. } = if at_corner {
            meeting.driven
        } else {
            meeting.driver
        };
        let lever = point.dot(&tangent).abs() / tangent.norm();
        self.contacts.push(AngularContact {
            turn,
            lever,
            parts: (a.part, b.part),
            at_corner,
            meeting: *meeting,
        });
        if value > self.best {
            self.best = value;
            let slack = self.limits.tolerance / lever.max(self.limits.tolerance);
            self.floor = Floor::new(self.sign, value - slack);
        }
    }
}
