//! Contact analysis of a finished pair: what turns what, by how much, and what else comes near.
//!
//! Works on the outlines and the centre distance alone; how the teeth were made plays no part. At each
//! input the driven gear is seated against the driver from either side, and every place where the two
//! outlines face each other is measured.

mod body;
mod touch;

use body::{Body, Cone, Part};
use centrode_geometry::{Point, Vector};
use centrode_mechanism::gear::design::Addendum;
use centrode_mechanism::gear::{GearPair, Member, Role, Tooth, ToothSide};
use touch::{Pose, Touch};

use std::f64::consts::{PI, TAU};

/// Samples a pitch of sound teeth.
const SAMPLES_PER_PITCH: u32 = 6;

/// Samples a pitch where contact may be lost.
const FINE_SAMPLES_PER_PITCH: u32 = 48;

/// Places farther apart than this many modules are not looked at.
const NEAR: f64 = 0.3;

/// Flanks within this many modules of the designed play face each other as designed.
const DESIGNED: f64 = 1e-6;

/// Turn of the driven gear, rad, below which a seat is exact.
const SETTLED: f64 = 1e-12;

/// Play, in modules, beyond which the gears are taken not to hold each other.
const FARTHEST: f64 = 2.0;

/// Overlaps no deeper than this many modules are taken as they are.
const SHALLOW: f64 = 1e-3;

/// Two flanks seated to within this many modules are in contact.
const SEATED: f64 = 1e-6;

/// The contact of a pair along one whole cycle, one value an input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contact {
    /// Driver angle, rad.
    pub input: Vec<f64>,
    /// Driven angle the pitch curves ask for, rad.
    pub law: Vec<f64>,
    /// Driven angle when the driver pushes it on, less the law and the designed half backlash, rad.
    pub transmission_error: Vec<f64>,
    /// The same with the driver pushing it back.
    pub reverse_transmission_error: Vec<f64>,
    /// Play of the driven gear with the driver held, rad.
    pub backlash: Vec<f64>,
    /// Play along the common normal of the driving contact, mm.
    pub normal_backlash: Vec<f64>,
    /// Pairs of teeth in contact when the driver pushes the driven gear on.
    pub contacts: Vec<u32>,
    /// Deepest overlap of the two outlines with the driven gear seated, mm.
    pub overlap: Vec<f64>,
    /// Least distance of a tip from a root, mm; infinite where none is near.
    pub clearance: Vec<f64>,
    /// Least distance of anything from a fillet, mm; infinite where nothing is near.
    pub fillet_clearance: Vec<f64>,
    /// Greatest sliding speed in the contact per driver speed, mm/rad.
    pub sliding: Vec<f64>,
}

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

impl Contact {
    /// Analyses one whole cycle at six inputs a pitch, or at 48 where a tooth is not what the tool would
    /// make of it or a pitch curve is concave: contact can then be lost over a small part of a pitch.
    #[must_use]
    pub fn of(pair: &GearPair) -> Self {
        let whole = |tooth: &Tooth| {
            let sound = |side: &ToothSide| side.undercut == 0.0 && side.shortened == 0.0;
            !tooth.severed && sound(&tooth.leading) && sound(&tooth.trailing)
        };
        let teeth = || pair.driver().teeth().iter().chain(pair.driven().teeth());
        if pair.teeth().addendum == Addendum::Full && teeth().all(whole) {
            let found = Self::sampled(pair, SAMPLES_PER_PITCH);
            let sure = |e: &f64| e.abs() < 1e-9;
            if found.transmission_error.iter().all(sure)
                && found.reverse_transmission_error.iter().all(sure)
            {
                return found;
            }
        }
        Self::sampled(pair, FINE_SAMPLES_PER_PITCH)
    }

    /// Analyses one whole cycle at about `per_pitch` inputs a pitch, spaced evenly along the pitch curve
    /// and never in step with the teeth.
    #[must_use]
    pub fn sampled(pair: &GearPair, per_pitch: u32) -> Self {
        let (n1, _) = pair.mean_ratio();
        let rolling = pair.rolling();
        let teeth = pair.driver().tooth_count() * n1;
        // One more than a multiple of the teeth: every sample stands elsewhere on its tooth.
        let count = teeth * per_pitch.max(1) + 1;
        let length = rolling.pitch_length(Member::Driver) * f64::from(n1);
        let mut meshing = Meshing::new(pair);
        let mut out = Self::default();
        for i in 0..count {
            let t = rolling.parameter(length * f64::from(i) / f64::from(count));
            meshing.sample(rolling.angle(t), rolling.driven_angle_at(t), &mut out);
        }
        out
    }

    /// Analyses given driver angles, rad.
    #[must_use]
    pub fn at(pair: &GearPair, inputs: &[f64]) -> Self {
        let mut meshing = Meshing::new(pair);
        let mut out = Self::default();
        for &phi in inputs {
            meshing.sample(phi, pair.driven_angle(phi), &mut out);
        }
        out
    }
}

struct Meshing<'a> {
    pair: &'a GearPair,
    driver: Body<'a>,
    driven: Body<'a>,
    module: f64,
    near: f64,
    /// Where parts faced each other at the sample before.
    memory: Vec<(usize, usize, (f64, f64))>,
    active: (Vec<usize>, Vec<(usize, Point)>),
}

impl<'a> Meshing<'a> {
    fn new(pair: &'a GearPair) -> Self {
        Self {
            pair,
            driver: Body::of(pair.driver()),
            driven: Body::of(pair.driven()),
            module: pair.module(),
            near: NEAR * pair.module() + 2.0 * pair.backlash(),
            memory: Vec::new(),
            active: (Vec::new(), Vec::new()),
        }
    }

    fn sample(&mut self, phi: f64, law: f64, out: &mut Contact) {
        let a = self.pair.center_distance();
        let pose = Pose::new(phi, law, a);
        let near = self.near;
        let mut places = self.places(&pose, phi + law);
        let mut seats = [1.0, -1.0].map(|sign| self.seat(&places, phi, law, sign));
        while seats.iter().any(Option::is_none) && self.near < FARTHEST * self.module {
            self.near *= 2.0;
            places = self.places(&pose, phi + law);
            seats = [1.0, -1.0].map(|sign| self.seat(&places, phi, law, sign));
        }
        self.near = near;
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
        let r = self.pair.rolling().radius(phi);
        let ratio = r / (a - r);
        let sliding = forward
            .places
            .iter()
            .map(|p| sliding(&p.touch, phi, a, ratio));
        out.sliding.push(sliding.fold(0.0, f64::max));
    }

    /// Every place where the outlines face each other nearer than the limit.
    fn places(&mut self, pose: &Pose, turned: f64) -> Vec<Place> {
        let (near, module) = (self.near, self.module);
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
                    self.active.1.push((j, center));
                }
            }
        }
        let mut out = Vec::with_capacity(16);
        let mut memory = Vec::with_capacity(16);
        // An overlap deeper than half a module is the far side of a tooth.
        let within = |touch: &Touch| touch.gap < near && touch.gap > -0.5 * module;
        for &i in &self.active.0 {
            let a = &self.driver.parts[i];
            for &(j, center) in &self.active.1 {
                let b = &self.driven.parts[j];
                let reach = a.radius + b.radius + near;
                if (a.center - center).norm_squared() > reach * reach
                    || !facing(a.normals, b.normals, turned)
                    || !in_range(a, b, pose, near, module)
                {
                    continue;
                }
                let start = self
                    .memory
                    .iter()
                    .find(|m| (m.0, m.1) == (i, j))
                    .map_or((0.0, 0.0), |m| m.2);
                if let Some(touch) = touch::parts(a, b, pose, start)
                    && within(&touch)
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
            let reach = self.driven.reach + near;
            if (corner.point - pose.axis).norm_squared() > reach * reach {
                continue;
            }
            for &(j, center) in &self.active.1 {
                let b = &self.driven.parts[j];
                let reach = b.radius + near;
                if (corner.point - center).norm_squared() > reach * reach
                    || !facing(corner.normals, b.normals, turned)
                {
                    continue;
                }
                if let Some(touch) = touch::driver_corner(corner, b, pose)
                    && within(&touch)
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
            let reach = self.driver.reach + near;
            if point.coords.norm_squared() > reach * reach {
                continue;
            }
            for &i in &self.active.0 {
                let a = &self.driver.parts[i];
                let reach = a.radius + near;
                if (point - a.center).norm_squared() > reach * reach
                    || !facing(a.normals, corner.normals, turned)
                {
                    continue;
                }
                if let Some(touch) = touch::driven_corner(a, corner, pose)
                    && within(&touch)
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
            place = self.again(&place, &Pose::new(phi, angle, self.pair.center_distance()))?;
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
                let mut all = self.places(&pose, phi + angle);
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

/// Whether two facing parts can be nearer than `near`, and no deeper in each other than half a module,
/// along the first one's middle normal.
fn in_range(a: &Part<'_>, b: &Part<'_>, pose: &Pose, near: f64, module: f64) -> bool {
    let (sin, cos) = a.normals.middle.sin_cos();
    let normal = Vector::new(cos, sin);
    let along = |p: &Point| normal.dot(&p.coords);
    let (a0, a1) = (along(&a.start), along(&a.end));
    let (b0, b1) = (along(&pose.place(&b.start)), along(&pose.place(&b.end)));
    let bulge = a.sagitta + b.sagitta;
    // A gap along a normal within the cone is at most this much longer.
    let slant = 1.0 / a.normals.half.min(1.2).cos();
    b0.min(b1) - a0.max(a1) < slant * near + bulge
        && b0.max(b1) - a0.min(a1) > -slant * 0.5 * module - bulge
}

/// Whether some outward normal of one opposes some outward normal of the other.
fn facing(a: Cone, b: Cone, turned: f64) -> bool {
    let difference = a.middle - b.middle - turned - PI;
    let wrapped = difference - TAU * (difference / TAU).round();
    wrapped.abs() <= a.half + b.half
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
