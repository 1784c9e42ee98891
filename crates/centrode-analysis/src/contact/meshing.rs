use centrode_geometry::{Point, Vector, checkpoint};
use centrode_mechanism::gear::{GearPair, Role};

use super::{
    Contact,
    body::{Body, Cone, Part},
    touch::{self, Pose, Touch},
};

/// Places farther apart than this many modules are not looked at.
const NEAR: f64 = 0.3;

/// Flanks within this many modules of the designed play face each other as designed.
const DESIGNED: f64 = 1e-6;

/// Turn of the driven gear, rad, below which a seat is exact.
const SETTLED: f64 = 1e-12;

/// Play, in modules, beyond which the gears are taken not to hold each other.
const FARTHEST: f64 = 2.0;

/// Flanks farther apart than this many modules are not looked at unless nothing nearer is found.
const CLOSE: f64 = 0.05;

/// Overlaps no deeper than this many modules are taken as they are.
const SHALLOW: f64 = 1e-3;

/// Two flanks seated to within this many modules are in contact.
const SEATED: f64 = 1e-6;

/// One place where the gears face each other, and what is there.
#[derive(Clone, Copy, Debug)]
struct Place {
    touch: Touch,
    kind: Kind,
    /// Driver and driven tooth.
    teeth: (u32, u32),
    /// Parts or corners, to look again.
    from: From,
}

#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Kind {
    Flanks,
    Fillet,
    TipAndRoot,
}

#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum From {
    Parts(usize, usize),
    DriverCorner(usize, usize),
    DrivenCorner(usize, usize),
}

/// A part of the driven gear that may touch something, where the pose puts it.
#[derive(Clone, Copy, Debug)]
struct Placed {
    index: usize,
    center: Point,
    ends: [Point; 2],
    normals: Cone,
}

impl Placed {
    /// Whether the two parts can be nearer than `near`, and no deeper in each other than half a module,
    /// along the driver part's middle normal.
    fn in_range(&self, a: &Part<'_>, b: &Part<'_>, near: f64, module: f64) -> bool {
        let normal = a.normals.direction;
        let along = |p: &Point| normal.dot(&p.coords);
        let (a0, a1) = (along(&a.start), along(&a.end));
        let (b0, b1) = (along(&self.ends[0]), along(&self.ends[1]));
        let bulge = a.sagitta + b.sagitta;
        let slant = a.normals.slant();
        b0.min(b1) - a0.max(a1) < slant * near + bulge
            && b0.max(b1) - a0.min(a1) > -slant * 0.5 * module - bulge
    }
}

/// A pair being analysed, pose by pose.
#[derive(Debug)]
pub(super) struct Meshing<'a> {
    pair: &'a GearPair,
    driver: Body<'a>,
    driven: Body<'a>,
    module: f64,
    near: f64,
    /// The same between flanks, which touch or nearly do.
    close: f64,
    /// Where parts faced each other at the sample before.
    memory: Vec<(usize, usize, (f64, f64))>,
    active: (Vec<usize>, Vec<Placed>),
}

impl<'a> Meshing<'a> {
    pub(super) fn new(pair: &'a GearPair) -> Self {
        Self {
            pair,
            driver: Body::of(pair.driver()),
            driven: Body::of(pair.driven()),
            module: pair.module(),
            near: NEAR * pair.module() + 2.0 * pair.backlash(),
            close: CLOSE * pair.module() + 2.0 * pair.backlash(),
            memory: Vec::new(),
            active: (Vec::new(), Vec::new()),
        }
    }

    /// Analyses one pose and adds its figures.
    pub(super) fn sample(&mut self, phi: f64, law: f64, out: &mut Contact) {
        checkpoint();
        let a = self.pair.center_distance();
        let pose = Pose::new(phi, law, a);
        let limits = (self.near, self.close);
        let (places, seats) = loop {
            let places = self.places(&pose);
            let seats = [1.0, -1.0].map(|sign| self.seat(&places, phi, law, sign));
            // What was not looked at is farther than `close`: sure to touch later than what was found
            // only if that touches within so much motion of the outermost lever.
            let sure = |seat: &Option<Seat>| {
                seat.as_ref()
                    .is_some_and(|s| (s.angle - law).abs() * a < self.close)
            };
            if seats.iter().all(sure) || self.close >= FARTHEST * self.module {
                break (places, seats);
            }
            self.close *= 3.0;
            self.near = self.near.max(self.close);
        };
        (self.near, self.close) = limits;
        let [forward, back] = seats;
        out.input.push(phi);
        out.law.push(law);
        let half = 0.5 * self.pair.backlash();
        let (Some(forward), Some(back)) = (forward, back) else {
            // Nothing near enough to drive: the mesh has come apart.
            for list in [
                &mut out.transmission_error,
                &mut out.reverse_transmission_error,
                &mut out.backlash,
                &mut out.normal_backlash,
                &mut out.clearance,
                &mut out.fillet_clearance,
            ] {
                list.push(f64::INFINITY);
            }
            out.contacts.push(0);
            out.overlap.push(0.0);
            out.sliding.push(0.0);
            return;
        };
        let mut error = |seat: &Seat, sign: f64| {
            let ideal = self.ideal(&places, phi, law, sign * half);
            seat.angle - ideal.unwrap_or(law - sign * half / seat.lever)
        };
        out.transmission_error.push(error(&forward, 1.0));
        out.reverse_transmission_error.push(error(&back, -1.0));
        let play = back.angle - forward.angle;
        out.backlash.push(play);
        out.normal_backlash.push(play * forward.lever);
        // Stuck between two sides: half of what is missing, but never more than what overlaps.
        let deepest = places.iter().map(|p| -p.touch.gap).fold(0.0, f64::max);
        let stuck = (-play * 0.5 * forward.lever.min(back.lever)).max(0.0);
        out.overlap.push(stuck.min(deepest));
        let least = |kind: Kind| {
            let gaps = places
                .iter()
                .filter(|p| p.kind == kind)
                .map(|p| p.touch.gap);
            gaps.fold(f64::INFINITY, f64::min)
        };
        out.clearance.push(least(Kind::TipAndRoot));
        out.fillet_clearance.push(least(Kind::Fillet));
        out.contacts.push(forward.contacts);
        let ratio = self.pair.ratio(phi);
        let sliding = forward
            .places
            .iter()
            .map(|p| sliding(&p.touch, phi, a, ratio));
        out.sliding.push(sliding.fold(0.0, f64::max));
    }

    /// Every place where the outlines face each other nearer than the limit.
    fn places(&mut self, pose: &Pose) -> Vec<Place> {
        let (near, close, module) = (self.near, self.close, self.module);
        self.active.0.clear();
        self.active.1.clear();
        // Two bodies can meet only where each lies within what the other reaches in that direction.
        for (i, part) in self.driver.parts.iter().enumerate() {
            let from = part.center - pose.axis;
            let farthest = self.driven.reach + part.radius + near;
            if from.norm_squared() < farthest * farthest {
                let reach = self.driven.reach_towards(&pose.turn_back(&from)) + part.radius + near;
                if from.norm_squared() < reach * reach {
                    self.active.0.push(i);
                }
            }
        }
        for (j, part) in self.driven.parts.iter().enumerate() {
            let farthest = self.driver.reach + part.radius + near;
            let center = pose.place(&part.center);
            if center.coords.norm_squared() < farthest * farthest {
                let reach = self.driver.reach_towards(&center.coords) + part.radius + near;
                if center.coords.norm_squared() < reach * reach {
                    self.active.1.push(Placed {
                        index: j,
                        center,
                        ends: [pose.place(&part.start), pose.place(&part.end)],
                        normals: part.normals.turned(pose.turn(&part.normals.direction)),
                    });
                }
            }
        }
        let mut out = Vec::with_capacity(16);
        let mut memory = Vec::with_capacity(16);
        // An overlap deeper than half a module is the far side of a tooth.
        let within = |touch: &Touch, near: f64| touch.gap < near && touch.gap > -0.5 * module;
        let limit = |kind: Kind| if kind == Kind::Flanks { close } else { near };
        for &i in &self.active.0 {
            checkpoint();
            let a = &self.driver.parts[i];
            for placed in &self.active.1 {
                let j = placed.index;
                let b = &self.driven.parts[j];
                let near = limit(kind(a.role, b.role));
                let reach = a.radius + b.radius + near;
                if (a.center - placed.center).norm_squared() > reach * reach
                    || !a.normals.opposes(&placed.normals)
                    || a.bend + b.bend <= 0.0
                    || !placed.in_range(a, b, near, module)
                {
                    continue;
                }
                let start = self
                    .memory
                    .iter()
                    .find(|m| (m.0, m.1) == (i, j))
                    .map_or((0.0, 0.0), |m| m.2);
                if let Some(touch) = touch::parts(a, b, pose, start)
                    && within(&touch, near)
                    && self.real(&touch, pose)
                {
                    memory.push((i, j, touch.at));
                    out.push(Place {
                        touch,
                        kind: kind(a.role, b.role),
                        teeth: (a.owner, b.owner),
                        from: From::Parts(i, j),
                    });
                }
            }
        }
        self.memory = memory;
        for (k, corner) in self.driver.corners.iter().enumerate() {
            let from = corner.point - pose.axis;
            let farthest = self.driven.reach + near;
            if from.norm_squared() > farthest * farthest
                || from.norm() > self.driven.reach_towards(&pose.turn_back(&from)) + near
            {
                continue;
            }
            for placed in &self.active.1 {
                let j = placed.index;
                let b = &self.driven.parts[j];
                let near = limit(corner_kind(corner.on_flank, b.role));
                let reach = b.radius + near;
                if (corner.point - placed.center).norm_squared() > reach * reach
                    || !corner.normals.opposes(&placed.normals)
                {
                    continue;
                }
                if let Some(touch) = touch::driver_corner(corner, b, pose)
                    && within(&touch, near)
                    && self.real(&touch, pose)
                {
                    out.push(Place {
                        touch,
                        kind: corner_kind(corner.on_flank, b.role),
                        teeth: (corner.owner, b.owner),
                        from: From::DriverCorner(k, j),
                    });
                }
            }
        }
        for (k, corner) in self.driven.corners.iter().enumerate() {
            let point = pose.place(&corner.point);
            let farthest = self.driver.reach + near;
            if point.coords.norm_squared() > farthest * farthest
                || point.coords.norm() > self.driver.reach_towards(&point.coords) + near
            {
                continue;
            }
            let normals = corner.normals.turned(pose.turn(&corner.normals.direction));
            for &i in &self.active.0 {
                let a = &self.driver.parts[i];
                let near = limit(corner_kind(corner.on_flank, a.role));
                let reach = a.radius + near;
                if (point - a.center).norm_squared() > reach * reach || !a.normals.opposes(&normals)
                {
                    continue;
                }
                if let Some(touch) = touch::driven_corner(a, corner, pose)
                    && within(&touch, near)
                    && self.real(&touch, pose)
                {
                    out.push(Place {
                        touch,
                        kind: corner_kind(corner.on_flank, a.role),
                        teeth: (a.owner, corner.owner),
                        from: From::DrivenCorner(i, k),
                    });
                }
            }
        }
        out
    }

    /// The angle at which the driven gear would stand if the flanks held the designed play exactly.
    ///
    /// At the law's own angle flanks thinned for play are parallel and half the play apart; how far the
    /// driven gear turns until they touch takes the same steps as the seating itself. Nothing where no
    /// flanks face each other as designed.
    fn ideal(&mut self, places: &[Place], phi: f64, law: f64, half: f64) -> Option<f64> {
        if half == 0.0 {
            return Some(law);
        }
        let off = |p: &&Place| (half.abs() - p.touch.gap).abs();
        let place = places
            .iter()
            .filter(|p| half * p.touch.lever > 0.0)
            .min_by(|p, q| off(p).total_cmp(&off(q)))
            .filter(|p| off(p) < DESIGNED * self.module)?;
        let wrong = (half.abs() - place.touch.gap) / place.touch.lever;
        let (mut angle, mut place) = (law, *place);
        for _ in 0..8 {
            let step = place.touch.gap / place.touch.lever;
            angle -= step;
            if step.abs() < SETTLED {
                break;
            }
            let pose = Pose::new(phi, angle, self.pair.center_distance());
            place = match self.again(&place, &pose) {
                Some(place) => place,
                None => {
                    let found = self.places(&pose);
                    let facing = found.into_iter().filter(|p| half * p.touch.lever > 0.0);
                    facing.min_by(|p, q| p.touch.gap.abs().total_cmp(&q.touch.gap.abs()))?
                }
            };
        }
        Some(angle - wrong)
    }

    /// Whether a deep overlap is one: the far sides of two neighbouring teeth face each other too, but
    /// neither lies in the other.
    fn real(&self, touch: &Touch, pose: &Pose) -> bool {
        touch.gap > -SHALLOW * self.module || {
            let inside = touch.point + touch.normal * (0.5 * touch.gap);
            self.pair.driver().outline().contains(inside)
                && self.pair.driven().outline().contains(pose.back(&inside))
        }
    }

    /// Turns the driven gear until the first place on the side of `sign` touches.
    fn seat(&mut self, places: &[Place], phi: f64, law: f64, sign: f64) -> Option<Seat> {
        let a = self.pair.center_distance();
        let mut at: Vec<Place> = places
            .iter()
            .filter(|p| sign * p.touch.lever > 0.0)
            .copied()
            .collect();
        // The angle at which a place would close, and which of them closes first.
        let bound = |p: &Place, angle: f64| angle - p.touch.gap / p.touch.lever;
        let mut angle = law;
        let mut lever = None;
        for _ in 0..8 {
            let first = at
                .iter()
                .max_by(|p, q| (sign * bound(p, angle)).total_cmp(&(sign * bound(q, angle))))?;
            let next = bound(first, angle);
            lever = Some(first.touch.lever.abs());
            let moved = (next - angle).abs() * a;
            let settled = moved < 1e-7 * self.module;
            let slack = 4.0 * (next - angle).abs();
            at.retain(|p| sign * (bound(p, angle) - next) > -slack - 1e-3);
            if settled {
                angle = next;
                break;
            }
            angle = next;
            let pose = Pose::new(phi, angle, a);
            let again: Option<Vec<Place>> = at.iter().map(|p| self.again(p, &pose)).collect();
            // A place that left its part is found anew on the neighbour.
            at = again.unwrap_or_else(|| {
                let mut all = self.places(&pose);
                all.retain(|p| sign * p.touch.lever > 0.0);
                all
            });
        }
        let seated = SEATED * self.module;
        at.retain(|p| p.touch.gap.abs() <= seated || p.touch.gap < 0.0);
        let mut pairs: Vec<(u32, u32)> = at.iter().map(|p| p.teeth).collect();
        pairs.sort_unstable();
        pairs.dedup();
        Some(Seat {
            angle,
            lever: lever?,
            contacts: pairs.len() as u32,
            places: at,
        })
    }

    fn again(&self, place: &Place, pose: &Pose) -> Option<Place> {
        let touch = match place.from {
            From::Parts(i, j) => touch::parts(
                &self.driver.parts[i],
                &self.driven.parts[j],
                pose,
                place.touch.at,
            ),
            From::DriverCorner(k, j) => {
                touch::driver_corner(&self.driver.corners[k], &self.driven.parts[j], pose)
            }
            From::DrivenCorner(i, k) => {
                touch::driven_corner(&self.driver.parts[i], &self.driven.corners[k], pose)
            }
        }?;
        Some(Place { touch, ..*place })
    }
}

/// The driven gear pushed to one side.
struct Seat {
    angle: f64,
    /// Distance of the driven axis from the common normal, mm.
    lever: f64,
    contacts: u32,
    places: Vec<Place>,
}

fn kind(a: Role, b: Role) -> Kind {
    match (a, b) {
        (Role::Flank, Role::Flank) => Kind::Flanks,
        (Role::Fillet, _) | (_, Role::Fillet) => Kind::Fillet,
        _ => Kind::TipAndRoot,
    }
}

fn corner_kind(on_flank: bool, part: Role) -> Kind {
    match part {
        Role::Flank if on_flank => Kind::Flanks,
        Role::Fillet => Kind::Fillet,
        _ => Kind::TipAndRoot,
    }
}

/// Speed at which the gears slide on each other per speed of the driver, mm/rad.
fn sliding(touch: &Touch, phi: f64, a: f64, ratio: f64) -> f64 {
    let axis = Vector::new(a * phi.cos(), a * phi.sin());
    let arm = touch.point.coords - axis;
    let across = |v: Vector| Vector::new(-v.y, v.x);
    let speed = across(axis) + across(arm) * (1.0 + ratio);
    speed.perp(&touch.normal).abs()
}
