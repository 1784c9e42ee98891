//! Points at which the outlines of two gears face each other in one pose.

use centrode_gear::{Member, Role};
use centrode_geometry::{Point, Vector, checkpoint};

use super::{
    body::{Cone, Corner, OutlinePart},
    meshing::Meshing,
    stretch::{Divided, Stretch},
    touch::{self, Pose, Touch},
};

/// Depth, in modules, up to which a penetration is accepted without a second test: too little to tell on which side of a
/// contour a point lies.
pub(super) const ROUNDED: f64 = 1e-9;

/// Greatest curvature, by the module, beyond which a part is a sharp bend at an end: that of a flank that ends near a cusp.
const SHARP: f64 = 50.0;

/// Point at which the gears face each other, and the features there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) touch: Touch,
    pub(super) kind: Kind,
    /// Both parts.
    pub(super) parts: (usize, usize),
    /// The gear that faces the other with the corner at the start of its part, if one does.
    pub(super) corner: Option<Member>,
}

#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Kind {
    Flanks,
    Fillet,
    TipAndRoot,
}

/// Parts of the two gears that are near each other in one pose.
#[derive(Debug)]
pub(super) struct Candidates {
    /// Parts of the driver, in the driven gear's axes, and their normals.
    pub(super) posed: Vec<(Divided, Cone)>,
    /// Index into these, and part of the driven gear.
    pub(super) pairs: Vec<(usize, usize)>,
    /// Depth to which one gear reaches into the core of the other, mm.
    pub(super) clash: f64,
}

impl Meshing<'_> {
    /// Finds the parts near each other in a pose.
    pub(super) fn candidates(&self, pose: &Pose) -> Candidates {
        let near = self.near;
        let mut out = Candidates {
            posed: Vec::with_capacity(64),
            pairs: Vec::with_capacity(512),
            clash: self.driver.tree.deepest(&pose.axis, self.driven.core),
        };
        let mut window = self.window.borrow_mut();
        if !window.holds(pose, near, self.allowance) {
            let gears = [&self.driver, &self.driven];
            window.fill(gears, pose, (self.about(pose), near), self.allowance);
        }
        let mut slots = vec![None; window.drivers()];
        window.pairs(pose, near, |slot, i, j| {
            let k = *slots[slot].get_or_insert_with(|| {
                let part = &self.driver.parts[i];
                let stretch = Stretch::from_part(i, part, |p| pose.back(p), |v| pose.turn_back(v));
                let normals = part.normals.turned(pose.turn_back(&part.normals.direction));
                out.posed.push((Divided::new(stretch), normals));
                out.posed.len() - 1
            });
            out.pairs.push((k, j));
        });
        out
    }

    /// The pitch point in a pose, in the driver's axes.
    fn about(&self, pose: &Pose) -> Point {
        let ratio = self.pair.ratio(pose.axis.y.atan2(pose.axis.x));
        pose.axis * (ratio / (1.0 + ratio))
    }

    /// Finds every point at which the outlines face each other nearer than the limit.
    pub(super) fn places(&mut self, candidates: &mut Candidates, pose: &Pose) -> Vec<Place> {
        let (near, close, module) = (self.near, self.close, self.module);
        let mut out = Vec::with_capacity(16);
        let mut memory = Vec::with_capacity(16);
        let limit = |kind: Kind| if kind == Kind::Flanks { close } else { near };
        let mut keep =
            |touch: Option<Touch>, kind: Kind, parts: (usize, usize), corner: Option<Member>| {
                if let Some(touch) = touch
                    && self.in_reach(&touch, limit(kind), pose)
                {
                    if corner.is_none() {
                        memory.push((parts.0, parts.1, touch.at));
                    }
                    out.push(Place {
                        touch,
                        kind,
                        parts,
                        corner,
                    });
                }
            };
        for &(k, j) in &candidates.pairs {
            checkpoint();
            let (Divided { whole: stretch, .. }, normals) = &candidates.posed[k];
            let mate = &self.stretches[j].whole;
            let i = stretch.part;
            let (a, b) = (&self.driver.parts[i], &self.driven.parts[j]);
            let kind = kind(a.role, b.role);
            if normals.opposes(&b.normals)
                && in_range(stretch, mate, &b.normals, limit(kind), module)
                && beside(stretch, mate, &b.normals, limit(kind), module)
                && self.driver.curvature(i).1 + self.driven.curvature(j).1 > 0.0
            {
                let known = self.memory.iter().find(|m| (m.0, m.1) == (i, j));
                // Where the sample before is far off, what is known from it may lead nowhere.
                let touch = known
                    .and_then(|m| touch::parts(a, b, pose, m.2))
                    .or_else(|| touch::parts(a, b, pose, stretch.facing(mate)))
                    .or_else(|| self.facing_sharply((i, j), pose));
                keep(touch, kind, (i, j), None);
            }
            let near_corner =
                |corner: &Corner, other: &OutlinePart<'_>, mate: &Stretch, point: Vector| {
                    let limit = limit(corner_kind(corner.on_flank, other.role));
                    let reach = other.radius + limit;
                    (point - mate.center).norm_squared() <= reach * reach
                        && mate.may_be_within(&point, limit, 0.5 * module)
                        && mate.may_face(&point, limit.max(0.5 * module))
                };
            if let Some(corner) = &a.corner
                && near_corner(corner, b, mate, stretch.point[0])
            {
                let normal = pose.turn_back(&corner.normals.direction);
                if corner.normals.turned(normal).opposes(&b.normals) {
                    let touch = touch::driver_corner(corner, b, pose);
                    keep(
                        touch,
                        corner_kind(corner.on_flank, b.role),
                        (i, j),
                        Some(Member::Driver),
                    );
                }
            }
            if let Some(corner) = &b.corner
                && near_corner(corner, a, stretch, corner.point.coords)
                && corner.normals.opposes(normals)
            {
                let touch = touch::driven_corner(a, corner, pose);
                keep(
                    touch,
                    corner_kind(corner.on_flank, a.role),
                    (i, j),
                    Some(Member::Driven),
                );
            }
        }
        // Facing parts first: they leave little to search when the gears are seated.
        let mut first = 0;
        for at in 0..candidates.pairs.len() {
            let (k, j) = candidates.pairs[at];
            let i = candidates.posed[k].0.whole.part;
            if memory.iter().any(|m| (m.0, m.1) == (i, j)) {
                candidates.pairs.swap(first, at);
                first += 1;
            }
        }
        self.memory = memory;
        out
    }

    /// Points at which two parts face each other of which one is a sharp bend; `None` if none is.
    pub(super) fn facing_sharply(&self, (i, j): (usize, usize), pose: &Pose) -> Option<Touch> {
        let bends = [self.driver.curvature(i).1, self.driven.curvature(j).1];
        let is_sharp = bends[0].max(bends[1]) * self.module > SHARP;
        let find = || touch::sharp_parts(&self.driver.parts[i], &self.driven.parts[j], pose);
        is_sharp.then(find).flatten()
    }

    /// Whether two points that face each other are nearer than a limit and neither lies on the far side of a tooth.
    pub(super) fn in_reach(&self, touch: &Touch, limit: f64, pose: &Pose) -> bool {
        let deepest = -0.5 * self.module;
        touch.gap < limit && touch.gap > deepest && self.real(touch, pose)
    }

    /// Whether a penetration is real: the far sides of two neighbouring teeth face each other too, but neither
    /// lies in the other.
    fn real(&self, touch: &Touch, pose: &Pose) -> bool {
        touch.gap > -ROUNDED * self.module || {
            let inside = touch.point + touch.normal * (0.5 * touch.gap);
            self.driver.contains(inside) && self.driven.contains(pose.back(&inside))
        }
    }
}

/// Whether two parts can be nearer than `near`, and penetrate no deeper than half a module, along the driven
/// part's middle normal.
fn in_range(a: &Stretch, b: &Stretch, normals: &Cone, near: f64, module: f64) -> bool {
    let normal = normals.direction;
    let slant = normals.slant();
    let lowest = |s: &Stretch| -s.farthest(&-normal);
    lowest(a) - b.farthest(&normal) < slant * near
        && a.farthest(&normal) - lowest(b) > -slant * 0.5 * module
}

/// Whether points of two parts, or a little beyond their ends, can be beside each other along the driven part's middle tangent,
/// as those are that face each other nearer than `near` or penetrate no deeper than half a module.
fn beside(a: &Stretch, b: &Stretch, normals: &Cone, near: f64, module: f64) -> bool {
    let normal = normals.direction;
    let along = Vector::new(-normal.y, normal.x);
    let off = normals.sin() * near.max(0.5 * module) + touch::JOINT * (a.radius + b.radius);
    a.farthest(&along) + b.farthest(&-along) > -off
        && a.farthest(&-along) + b.farthest(&along) > -off
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

/// Least clearance of tips from roots, and from fillets, among places, mm; infinite where none is near.
pub(super) fn gaps(places: &[Place], clash: f64) -> [f64; 2] {
    let least = |kind: Kind| {
        let of_kind = places.iter().filter(|p| p.kind == kind);
        of_kind.map(|p| p.touch.gap).fold(f64::INFINITY, f64::min)
    };
    let tip = least(Kind::TipAndRoot);
    let tip = if clash > 0.0 { tip.min(-clash) } else { tip };
    [tip, least(Kind::Fillet)]
}
