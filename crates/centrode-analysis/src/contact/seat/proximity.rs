//! Points at which the outlines of two gears face each other in one pose.

use centrode_gear::{Member, Role};
use centrode_geometry::{Point, Vector, checkpoint};

use super::{
    facing_points::{self, FacingParts, FacingPoints},
    meshing::Meshing,
};
use crate::contact::contour::{
    Corner, DividedStretch, NormalCone, OutlinePart, Pose, Reference, Stretch, deepest,
};

/// Depth, modules, up to which a penetration is accepted without a second test: below it a point may lie on either side of a
/// contour by rounding.
pub(in crate::contact) const ROUNDED: f64 = 1e-9;

/// Curvature times module above which a part has a sharp bend at an end, such as a flank that ends near a cusp. Such
/// parts are searched from more starting points. A larger limit misses points, a smaller one takes longer.
const SHARP_CURVATURE: f64 = 50.0;

/// Points at which the gears face each other, and the features there.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Proximity {
    pub(in crate::contact) points: FacingPoints,
    pub(in crate::contact) kind: ProximityKind,
    /// Parts of driver and driven gear.
    pub(in crate::contact) parts: (usize, usize),
    /// The gear that faces the other with the corner at the start of its part; `None` if both face with smooth parts.
    pub(in crate::contact) corner: Option<Member>,
}

/// Features that face each other.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(in crate::contact) enum ProximityKind {
    Flanks,
    Fillet,
    TipAndRoot,
}

/// Parts of the two gears that are near each other in one pose.
#[derive(Debug)]
pub(in crate::contact) struct Candidates {
    pub(in crate::contact) driver: Vec<PosedPart>,
    pub(in crate::contact) pairs: Vec<CandidatePair>,
    /// Depth to which the driver penetrates the core of the driven gear, mm.
    pub(in crate::contact) core_penetration: f64,
}

/// Part of the driver in the driven gear's axes.
#[derive(Debug)]
pub(in crate::contact) struct PosedPart {
    pub(in crate::contact) stretch: DividedStretch,
    normals: NormalCone,
}

/// Two parts that are near each other.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct CandidatePair {
    /// Index into the posed parts of the driver.
    pub(in crate::contact) driver: usize,
    /// Part of the driven gear.
    pub(in crate::contact) driven: usize,
}

impl Meshing<'_> {
    /// Finds the parts near each other in a pose.
    pub(in crate::contact) fn candidates(&self, pose: &Pose) -> Candidates {
        let near = self.search_distance;
        let mut out = Candidates {
            driver: Vec::with_capacity(64),
            pairs: Vec::with_capacity(512),
            core_penetration: deepest(&self.driver.tree, &pose.axis, self.driven.core),
        };
        let mut cache = self.pair_cache.borrow_mut();
        if !cache.holds(pose, near, self.pose_tolerance) {
            let reference = Reference {
                pose: *pose,
                pitch_point: self.pitch_point(pose),
                near,
            };
            cache.fill([&self.driver, &self.driven], reference, self.pose_tolerance);
        }
        let mut slots = vec![None; cache.drivers()];
        cache.pairs(pose, near, |slot, i, j| {
            let k = *slots[slot].get_or_insert_with(|| {
                let part = &self.driver.parts[i];
                let stretch = Stretch::from_part(
                    i,
                    part,
                    |p| pose.point_to_driven(p),
                    |v| pose.vector_to_driven(v),
                );
                let normals = part
                    .normals
                    .turned(pose.vector_to_driven(&part.normals.direction));
                out.driver.push(PosedPart {
                    stretch: DividedStretch::new(stretch),
                    normals,
                });
                out.driver.len() - 1
            });
            out.pairs.push(CandidatePair {
                driver: k,
                driven: j,
            });
        });
        out
    }

    /// The pitch point in a pose, in the driver's axes.
    fn pitch_point(&self, pose: &Pose) -> Point {
        let ratio = self.pair.ratio(pose.axis.y.atan2(pose.axis.x));
        pose.axis * (ratio / (1.0 + ratio))
    }

    /// Finds all points at which the outlines face each other within the search distances.
    pub(in crate::contact) fn proximities(
        &mut self,
        candidates: &mut Candidates,
        pose: &Pose,
    ) -> Vec<Proximity> {
        let (near, close, module) = (self.search_distance, self.flank_distance, self.module);
        let mut out = Vec::with_capacity(16);
        let mut previous_facing = Vec::with_capacity(16);
        let limit = |kind: ProximityKind| {
            if kind == ProximityKind::Flanks {
                close
            } else {
                near
            }
        };
        let mut add = |points: Option<FacingPoints>,
                       kind: ProximityKind,
                       parts: (usize, usize),
                       corner: Option<Member>| {
            if let Some(points) = points
                && self.in_reach(&points, limit(kind), pose)
            {
                if corner.is_none() {
                    previous_facing.push(FacingParts {
                        parts,
                        at: points.at,
                    });
                }
                out.push(Proximity {
                    points,
                    kind,
                    parts,
                    corner,
                });
            }
        };
        for &CandidatePair { driver, driven: j } in &candidates.pairs {
            checkpoint();
            let PosedPart { stretch, normals } = &candidates.driver[driver];
            let stretch = &stretch.whole;
            let mate = &self.stretches[j].whole;
            let i = stretch.part;
            let (a, b) = (&self.driver.parts[i], &self.driven.parts[j]);
            let kind = kind(a.role, b.role);
            if normals.opposes(&b.normals)
                && overlaps_along_normal(stretch, mate, &b.normals, limit(kind), module)
                && overlaps_sideways(stretch, mate, &b.normals, limit(kind), module)
                && self.driver.curvature(i).1 + self.driven.curvature(j).1 > 0.0
            {
                let known = self.previous_facing.iter().find(|f| f.parts == (i, j));
                // If the previous sample is far off, the search from its parameters may fail.
                let points = known
                    .and_then(|f| facing_points::facing_parts(a, b, pose, f.at))
                    .or_else(|| facing_points::facing_parts(a, b, pose, stretch.facing(mate)))
                    .or_else(|| self.facing_sharp_bend((i, j), pose));
                add(points, kind, (i, j), None);
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
                let normal = pose.vector_to_driven(&corner.normals.direction);
                if corner.normals.turned(normal).opposes(&b.normals) {
                    let points = facing_points::facing_driver_corner(corner, b, pose);
                    add(
                        points,
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
                let points = facing_points::facing_driven_corner(a, corner, pose);
                add(
                    points,
                    corner_kind(corner.on_flank, a.role),
                    (i, j),
                    Some(Member::Driven),
                );
            }
        }
        // Parts that face each other go first: with their contacts known the search for the seat skips most other pairs.
        let mut first = 0;
        for at in 0..candidates.pairs.len() {
            let pair = candidates.pairs[at];
            let i = candidates.driver[pair.driver].stretch.whole.part;
            if previous_facing.iter().any(|f| f.parts == (i, pair.driven)) {
                candidates.pairs.swap(first, at);
                first += 1;
            }
        }
        self.previous_facing = previous_facing;
        out
    }

    /// Points at which two parts face each other, if one of them has a sharp bend.
    pub(super) fn facing_sharp_bend(
        &self,
        (i, j): (usize, usize),
        pose: &Pose,
    ) -> Option<FacingPoints> {
        let curvatures = [self.driver.curvature(i).1, self.driven.curvature(j).1];
        let is_sharp = curvatures[0].max(curvatures[1]) * self.module > SHARP_CURVATURE;
        let find = || {
            facing_points::facing_sharp_parts(&self.driver.parts[i], &self.driven.parts[j], pose)
        };
        is_sharp.then(find).flatten()
    }

    /// Whether the gap of two points is below a limit and neither lies on the far side of a tooth.
    pub(in crate::contact) fn in_reach(
        &self,
        points: &FacingPoints,
        limit: f64,
        pose: &Pose,
    ) -> bool {
        let deepest = -0.5 * self.module;
        points.gap < limit && points.gap > deepest && self.is_real(points, pose)
    }

    /// Whether a penetration is real. The far sides of two neighbouring teeth face each other too, but without a common area.
    fn is_real(&self, points: &FacingPoints, pose: &Pose) -> bool {
        points.gap > -ROUNDED * self.module || {
            let inside = points.point + points.normal * (0.5 * points.gap);
            self.driver.contains(inside) && self.driven.contains(pose.point_to_driven(&inside))
        }
    }
}

/// Whether two parts can be within `near` mm of each other and penetrate by at most half a module, along the driven part's middle
/// normal.
fn overlaps_along_normal(
    a: &Stretch,
    b: &Stretch,
    normals: &NormalCone,
    near: f64,
    module: f64,
) -> bool {
    let normal = normals.direction;
    let slant = normals.slant();
    let lowest = |s: &Stretch| -s.extent(&-normal);
    lowest(a) - b.extent(&normal) < slant * near
        && a.extent(&normal) - lowest(b) > -slant * 0.5 * module
}

/// Whether the extents of two parts, with a margin beyond their ends, overlap along the driven part's middle tangent. Points that face
/// each other within `near` mm, or penetrate by at most half a module, do.
fn overlaps_sideways(
    a: &Stretch,
    b: &Stretch,
    normals: &NormalCone,
    near: f64,
    module: f64,
) -> bool {
    let normal = normals.direction;
    let along = Vector::new(-normal.y, normal.x);
    let off = normals.sin() * near.max(0.5 * module) + facing_points::JOINT * (a.radius + b.radius);
    a.extent(&along) + b.extent(&-along) > -off && a.extent(&-along) + b.extent(&along) > -off
}

fn kind(a: Role, b: Role) -> ProximityKind {
    match (a, b) {
        (Role::Flank, Role::Flank) => ProximityKind::Flanks,
        (Role::Fillet, _) | (_, Role::Fillet) => ProximityKind::Fillet,
        _ => ProximityKind::TipAndRoot,
    }
}

fn corner_kind(on_flank: bool, part: Role) -> ProximityKind {
    match part {
        Role::Flank if on_flank => ProximityKind::Flanks,
        Role::Fillet => ProximityKind::Fillet,
        _ => ProximityKind::TipAndRoot,
    }
}
