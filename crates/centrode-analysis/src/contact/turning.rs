//! Search for the angle at which the driven gear, turned about its axis, comes to rest against the driver.
//!
//! Seen from the driven axis a point of either contour has a distance and an angle. Two points at the same distance
//! meet when the driven gear turns by the difference of their angles; the gear rests at the extreme of this
//! difference over all distances. Between two stretches of contour along which the distance is monotone, and
//! whose least curvatures sum to more than nothing, it has one extreme: inside, where the tangents meet, or at an
//! end. Stretches that bend otherwise are halved.

use centrode_geometry::{Vector, bracketed_root};

use super::{
    body::GearOutline,
    hit::Hit,
    meeting::Meeting,
    stretch::{Contour, Divided, SETTLED, Stretch},
    touch::Pose,
};

/// Size, as a share of a contact's allowance, below which a stretch is a point.
const POINT: f64 = 1e-5;

/// Search for the first contacts when the driven gear turns back (`sign` 1) or on (-1).
pub(super) struct Turning<'a> {
    driver: Contour<'a>,
    driven: Contour<'a>,
    sign: f64,
    /// Depth, mm, beyond which a path into the mate is searched from where the gears first meet.
    deep: f64,
    /// Depth, mm, beyond which a penetration is tested twice.
    shallow: f64,
    /// Lever, mm, below which a contact stops nothing.
    idle: f64,
    facing: &'a [(usize, usize, (f64, f64))],
    penetrates: &'a dyn Fn(&Vector, &Vector) -> bool,
    /// Greatest `sign * turn` found.
    best: f64,
    /// Difference from the best, rad, within which a contact is kept too.
    slack: f64,
    /// Sine, cosine and size of the turn of `best - slack`.
    floor: (f64, f64, f64),
    hits: Vec<Hit>,
}

/// Bounds of a search.
pub(super) struct Limits<'a> {
    /// Greatest turn searched, rad.
    pub(super) window: f64,
    /// Depth, mm, beyond which a path into the mate is searched from where the gears first meet.
    pub(super) deep: f64,
    /// Gap or penetration, mm, below which there is contact.
    pub(super) seated: f64,
    /// Lever, mm, below which a contact stops nothing.
    pub(super) idle: f64,
    /// Parts that face each other in the first pose, and their parameters there.
    pub(super) facing: &'a [(usize, usize, (f64, f64))],
    /// Whether a point of the driver lies in the driven gear or one of the driven gear in the driver.
    pub(super) penetrates: &'a dyn Fn(&Vector, &Vector) -> bool,
}

impl<'a> Turning<'a> {
    pub(super) fn new(
        driver: &'a GearOutline<'a>,
        driven: &'a GearOutline<'a>,
        pose: Pose,
        sign: f64,
        limits: &Limits<'a>,
    ) -> Self {
        let (sin, cos) = (-sign * limits.window).sin_cos();
        Self {
            driver: Contour {
                body: driver,
                pose: Some(pose),
            },
            driven: Contour {
                body: driven,
                pose: None,
            },
            sign,
            deep: limits.deep,
            shallow: limits.seated,
            idle: limits.idle,
            facing: limits.facing,
            penetrates: limits.penetrates,
            best: -limits.window,
            slack: 0.0,
            floor: (sin, cos, -limits.window),
            hits: Vec::new(),
        }
    }

    /// Contacts within reach of the first, that one first; nothing where none is in the window.
    pub(super) fn finish(mut self) -> Vec<Hit> {
        let floor = self.floor.2;
        self.hits.retain(|h| self.sign * h.turn >= floor);
        let order = |h: &Hit| -self.sign * h.turn;
        self.hits.sort_by(|p, q| order(p).total_cmp(&order(q)));
        self.hits
    }

    /// Searches wherever two stretches may meet first.
    pub(super) fn look(&mut self, one: &Divided, other: &Divided) {
        let (a, b) = (&one.whole, &other.whole);
        // Only a side of the driver that faces on stops the driven gear that turns back.
        if a.sense * self.sign > 0.0 || b.sense * self.sign < 0.0 || self.clear(a, b) {
            return;
        }
        if a.sense == 0.0 || b.sense == 0.0 {
            let first = b.sense != 0.0 || (a.sense == 0.0 && a.radius > b.radius);
            let larger = if first { a } else { b };
            // Where the distance has an extreme a contact stops nothing; the neighbours end there too.
            if self.is_idle(larger) || larger.radius < POINT * self.shallow {
                return;
            }
            if first {
                for part in one.parts(&self.driver, self.idle) {
                    self.look(part, other);
                }
            } else {
                for part in other.parts(&self.driven, self.idle) {
                    self.look(one, part);
                }
            }
            return;
        }
        let low = a.squared[0].max(b.squared[0]);
        let high = a.squared[1].min(b.squared[1]);
        if low > high {
            return;
        }
        // Parts that face each other now meet soon, and once only.
        if let Some(at) = self.known(a, b)
            && self.bend(a, b).0 > 0.0
            && let Some(meeting) = self.newton(a, b, at)
        {
            self.offer(a, b, &meeting);
            return;
        }
        if a.is_whole() && b.is_whole() {
            // Their halves are known too, and most are clear of each other.
            for part in one.parts(&self.driver, self.idle) {
                for mate in other.parts(&self.driven, self.idle) {
                    self.look(part, mate);
                }
            }
            return;
        }
        let ends = [low, high].map(|squared| self.meeting(a, b, squared));
        for meeting in &ends {
            self.offer(a, b, meeting);
        }
        self.inside(a, b, &ends);
    }

    /// Searches between two meetings.
    fn inside(&mut self, a: &Stretch, b: &Stretch, ends: &[Meeting; 2]) {
        let a = self.driver.cut(a, ends.map(|m| (m.u, m.driver)));
        let b = self.driven.cut(b, ends.map(|m| (m.v, m.driven)));
        if self.clear(&a, &b) {
            return;
        }
        let (least, greatest) = self.bend(&a, &b);
        let rising = ends.each_ref().map(|m| self.sign * m.difference());
        if least > 0.0 {
            if rising[0] > 0.0 && rising[1] < 0.0 {
                let meeting = self.extreme(&a, &b, ends);
                self.offer(&a, &b, &meeting);
            }
            return;
        }
        // Straight stretches stop the gear at their ends, idle ones nowhere.
        let straight = a.span.sagitta + b.span.sagitta <= POINT * self.shallow;
        if greatest <= 0.0 || straight || self.is_idle(&a) || self.is_idle(&b) {
            return;
        }
        let squared = ends.each_ref().map(|m| m.driven.0.norm_squared());
        let between = 0.5 * (squared[0] + squared[1]);
        let middle = self.meeting(&a, &b, between);
        // A meeting that is not strictly between the ends, or no number, is no middle: so the halving ends.
        let found = middle.driven.0.norm_squared();
        let [low, high] = [squared[0].min(squared[1]), squared[0].max(squared[1])];
        let has_middle =
            low < found && found < high && ends.iter().all(|m| middle.u != m.u || middle.v != m.v);
        if !has_middle {
            return;
        }
        self.offer(&a, &b, &middle);
        self.inside(&a, &b, &[ends[0], middle]);
        self.inside(&a, &b, &[middle, ends[1]]);
    }

    /// Whether no contact along the stretch's normals can stop the driven gear.
    fn is_idle(&self, stretch: &Stretch) -> bool {
        stretch.greatest_lever() < self.idle
    }

    /// Bounds of the sum of two stretches' curvatures.
    fn bend(&self, a: &Stretch, b: &Stretch) -> (f64, f64) {
        let [a, b] = [self.driver.curvature(a), self.driven.curvature(b)];
        (a.0 + b.0, a.1 + b.1)
    }

    /// Parameters at which two whole parts face each other in the first pose.
    fn known(&self, a: &Stretch, b: &Stretch) -> Option<(f64, f64)> {
        let whole = a.is_whole() && b.is_whole();
        let facing = |f: &&(usize, usize, (f64, f64))| whole && (f.0, f.1) == (a.part, b.part);
        self.facing.iter().find(facing).map(|f| f.2)
    }

    /// Whether two stretches can neither meet in a turn greater than the floor nor penetrate now.
    fn clear(&self, a: &Stretch, b: &Stretch) -> bool {
        if a.squared[0] > b.squared[1] || b.squared[0] > a.squared[1] {
            return true;
        }
        let (sin, cos, floor) = self.floor;
        let distance = a.squared[1].min(b.squared[1]).sqrt();
        let near = a.radius + b.radius + (-floor * distance).max(self.deep);
        if (a.center - b.center).norm_squared() > near * near {
            return true;
        }
        // With the driver turned to where the floor is reached, along the normal of either chord.
        let turned = a
            .point
            .map(|p| Vector::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x));
        let across = turned[1] - turned[0];
        let sweep = self.deep / distance - floor;
        [b.point[1] - b.point[0], -across].into_iter().any(|chord| {
            let normal = Vector::new(chord.y, -chord.x);
            let size = normal.norm();
            let [p, q] = turned.map(|p| normal.dot(&p));
            let [r, s] = b.point.map(|p| normal.dot(&p));
            let bulges = a.span.beyond(&across, &-normal)
                + b.span.beyond(&(b.point[1] - b.point[0]), &normal);
            let gap = p.min(q) - r.max(s) - bulges;
            // Turning away from there it opens at this rate, less what the way round bends back.
            let opening = turned.map(|p| -self.sign * p.perp(&normal));
            let rate = opening[0].min(opening[1]) - a.span.sagitta * size;
            gap > 0.0 && gap > sweep * (0.5 * distance * size * sweep - rate)
        })
    }

    fn meeting(&self, a: &Stretch, b: &Stretch, squared: f64) -> Meeting {
        let (u, driver) = self.driver.reach(a, squared);
        let (v, driven) = self.driven.reach(b, squared);
        Meeting {
            u,
            v,
            driver,
            driven,
        }
    }

    /// The one extreme between two meetings.
    fn extreme(&self, a: &Stretch, b: &Stretch, ends: &[Meeting; 2]) -> Meeting {
        let slopes = ends.each_ref().map(Meeting::difference);
        let share = slopes[0] / (slopes[0] - slopes[1]);
        let part = |of: fn(&Meeting) -> f64| of(&ends[0]) + (of(&ends[1]) - of(&ends[0])) * share;
        self.newton(a, b, (part(|m| m.u), part(|m| m.v)))
            .unwrap_or_else(|| {
                let squared = ends.each_ref().map(|m| m.driver.0.norm_squared());
                let off = |squared: f64| self.meeting(a, b, squared).difference();
                let at = bracketed_root(off, squared[0], squared[1], slopes[0], slopes[1]);
                self.meeting(a, b, at)
            })
    }

    /// Point at which the tangents of two stretches meet, by Newton's method from a guess, if it stays on both.
    fn newton(&self, a: &Stretch, b: &Stretch, (mut u, mut v): (f64, f64)) -> Option<Meeting> {
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
                return Some(Meeting {
                    u,
                    v,
                    driver: (x, p.first),
                    driven: (y, q.first),
                });
            }
            (u, v) = (u + du, v + dv);
        }
        None
    }

    /// Adds a meeting if it is within reach of the first.
    fn offer(&mut self, a: &Stretch, b: &Stretch, meeting: &Meeting) {
        let turn = meeting.angle();
        let value = self.sign * turn;
        if value < self.floor.2 || value.is_nan() {
            return;
        }
        // Where the gears seem to penetrate now, one of the two points lies in the other gear.
        if value * meeting.driver.0.norm() > self.shallow
            && !(self.penetrates)(&meeting.driver.0, &meeting.driven.0)
        {
            return;
        }
        // A corner takes the direction of its mate.
        let at_corner = meeting.u.abs() == 1.0;
        let (point, tangent) = if at_corner {
            meeting.driven
        } else {
            meeting.driver
        };
        let lever = point.dot(&tangent).abs() / tangent.norm();
        self.hits.push(Hit {
            turn,
            lever,
            parts: (a.part, b.part),
            at_corner,
            meeting: *meeting,
        });
        if value > self.best {
            self.best = value;
            self.slack = self.shallow / lever.max(self.shallow);
            let floor = self.best - self.slack;
            let (sin, cos) = (self.sign * floor).sin_cos();
            self.floor = (sin, cos, floor);
        }
    }
}
