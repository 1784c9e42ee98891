//! Driver angles at which a contact reaches the end of a flank.

use centrode_gear::{Member, PitchContact, Role};
use centrode_geometry::{Disc, Point, Run, Vector};

use super::{
    backlash_position::BacklashPosition, cycle_samples::period, pose_sampling::PoseSampling,
};
use crate::contact::contour::{GearOutline, OutlinePart, Pose};
use crate::contact::seat::{Foot, Meshing, ProximityKind, foot};

/// Distance of a point from the circle around a group of parts within which these are candidates for contact, modules.
/// A larger distance takes longer; a smaller one could miss contacts by rounding or backlash.
const MATE_DISTANCE: f64 = 1e-3;

/// Distance of an edge from the end of a flank's part within which it touches that end, modules. Ten times less misses
/// contacts by rounding; ten times more accepts edges that pass the end.
const END_ROUNDING: f64 = 1e-6;

/// Cosine of the angle between the normals of an edge and of the flank that it touches. They are opposite, apart from the backlash, which
/// turns them by less than 0.1 rad. The normals of flanks that an edge passes without contact differ by more.
const FACING_COSINE: f64 = -0.99;

/// Pose in which the normal at the end of a flank passes through the pitch point: by the law of gearing the contact is at that end.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeContact {
    member: Member,
    edge: FlankEnd,
    /// Position of the driven gear within its backlash.
    position: BacklashPosition,
    /// Contact of the pitch curves in that pose.
    pub(super) at: PitchContact,
    /// Whether the contact begins there; otherwise it ends.
    pub(super) begins: bool,
    /// Sliding speed per driver speed, mm/rad.
    pub(super) sliding: f64,
}

/// End of a flank: its point and the flank's outward normal, in the axes of its gear.
#[derive(Clone, Copy, Debug)]
struct FlankEnd {
    point: Point,
    normal: Vector,
    /// Tooth of the flank.
    tooth: u32,
    /// Side of the normal on which the flank lies: the sign of distances from it.
    side: f64,
}

impl FlankEnd {
    /// Signed distance of a point from the normal, mm.
    fn distance_from_normal(&self, point: Vector) -> f64 {
        self.normal.perp(&(point - self.point.coords))
    }
}

/// Ends of the flanks that push the driven gear forward (`sign` 1) or back (-1): at the tip and at the start of the
/// fillet.
fn flank_ends(body: &GearOutline<'_>, sign: f64) -> Vec<FlankEnd> {
    let count = body.parts.len();
    // The driver turns clockwise and pushes along its outward normals. The driven gear turns counter-clockwise and is pushed against
    // its outward normals: the same condition holds for both.
    let drives = |edge: &FlankEnd| {
        let direction = Vector::new(edge.point.y, -edge.point.x);
        sign * edge.normal.dot(&direction) > 0.0
    };
    let flank_end = |part: &OutlinePart<'_>, point: Point, tangent: Vector, side: f64| {
        let normal = Vector::new(tangent.y, -tangent.x).normalize();
        (part.role == Role::Flank).then_some(FlankEnd {
            point,
            normal,
            tooth: part.tooth,
            side,
        })
    };
    let mut found = Vec::new();
    for (k, after) in body.parts.iter().enumerate() {
        let before = &body.parts[(k + count - 1) % count];
        let is_end = after.corner.is_some() || before.role != after.role;
        let point = after.span.ends[0];
        if is_end {
            found.extend(flank_end(
                before,
                point,
                before.span.bounds.tangents[1],
                -1.0,
            ));
            found.extend(flank_end(after, point, after.span.bounds.tangents[0], 1.0));
        }
    }
    found.retain(drives);
    found
}

/// The pitch point in the axes of one gear, at a given ratio.
fn pitch_point(member: Member, ratio: f64, pose: &Pose) -> Vector {
    let from_driver = pose.axis.coords * (ratio / (1.0 + ratio));
    match member {
        Member::Driver => from_driver,
        Member::Driven => pose.point_to_driven(&Point::from(from_driver)).coords,
    }
}

impl Meshing<'_> {
    /// Edge contacts of both gears over one period with the driver pushing forward (`sign` 1) or back (-1), in
    /// descending order of sliding speed.
    pub(super) fn edge_contacts(&self, sampling: &PoseSampling, sign: f64) -> Vec<EdgeContact> {
        let mut found = Vec::new();
        let pair = self.pair;
        let cycle = 0.0..period(pair);
        for (member, body) in [Member::Driver, Member::Driven]
            .into_iter()
            .zip([&self.driver, &self.driven])
        {
            let point = |at: &PitchContact, pose: &Pose| pitch_point(member, at.ratio(), pose);
            let steps = sampling.points.iter().zip(&sampling.poses);
            let points: Vec<Vector> = steps.map(|(at, pose)| point(at, pose)).collect();
            for edge in flank_ends(body, sign) {
                let contact_point = self.contact_point(&edge, member, sampling.position);
                for steps in sampling.passages(member, edge.point) {
                    found.extend(steps.filter_map(|step| {
                        let [f, g] = [step, step + 1].map(|k| edge.distance_from_normal(points[k]));
                        if (f > 0.0) == (g > 0.0) {
                            return None;
                        }
                        let at = sampling.root(pair, step, |at, pose| {
                            edge.distance_from_normal(point(at, pose))
                        })?;
                        let away = point(&at, &sampling.position.pose(pair, &at)) - contact_point;
                        cycle.contains(&at.input).then_some(EdgeContact {
                            member,
                            edge,
                            position: sampling.position,
                            at,
                            begins: edge.side * g > 0.0,
                            sliding: away.norm() * (1.0 + at.ratio()),
                        })
                    }));
                }
            }
        }
        found.sort_by(|a, b| b.sliding.total_cmp(&a.sliding));
        found
    }

    /// Whether the mate has a flank near the point of an edge contact.
    pub(super) fn reaches_mate(&self, contact: &EdgeContact) -> bool {
        self.mate_tooth(contact, |_, _| true).is_some()
    }

    /// The teeth of driver and driven gear in an edge contact, if the mate has a flank there.
    pub(super) fn touching_teeth(&self, contact: &EdgeContact) -> Option<(u32, u32)> {
        // At a joint of the mate's flank an edge may lie beyond the normals of both parts.
        let off = self.position_tolerance();
        let pose = contact.position.pose(self.pair, &contact.at);
        let normal = match contact.member {
            Member::Driver => pose.vector_to_driven(&contact.edge.normal),
            Member::Driven => pose.vector_to_driver(&contact.edge.normal),
        };
        // Beyond the base circle an edge passes a flank that it does not face.
        let faces = |foot: Foot| {
            let tangent = foot.jet.first;
            let outward = Vector::new(tangent.y, -tangent.x).normalize();
            outward.dot(&normal) < FACING_COSINE
        };
        let mate = self.mate_tooth(contact, |part, point| {
            let at_end = |end: &Point| (end - point).norm() < off;
            foot(part, point).is_some_and(faces) || part.span.ends.iter().any(at_end)
        })?;
        Some(match contact.member {
            Member::Driver => (contact.edge.tooth, mate),
            Member::Driven => (mate, contact.edge.tooth),
        })
    }

    /// Number of pairs of teeth whose flanks face each other as designed at a contact of the pitch curves, with the
    /// driver pushing forward (`sign` 1) or back (-1).
    pub(super) fn facing_teeth(
        &mut self,
        point: &PitchContact,
        position: BacklashPosition,
        sign: f64,
    ) -> u32 {
        self.forget_previous();
        let pose = position.pose(self.pair, point);
        let mut candidates = self.candidates(&pose);
        let proximities = self.proximities(&mut candidates, &pose);
        let near = self.position_tolerance();
        let off = self.flank_gap(position);
        let mut teeth: Vec<(u32, u32)> = proximities
            .iter()
            .filter(|p| {
                p.kind == ProximityKind::Flanks
                    && p.corner.is_none()
                    && sign * p.points.lever > 0.0
                    && (p.points.gap - off).abs() < near
                    && p.points.is_on_both()
            })
            .map(|p| {
                (
                    self.driver.parts[p.parts.0].tooth,
                    self.driven.parts[p.parts.1].tooth,
                )
            })
            .collect();
        teeth.sort_unstable();
        teeth.dedup();
        teeth.len() as u32
    }

    /// Tolerance of the position of flanks that touch as designed, mm: a seat is exact to the first order of the backlash.
    pub(super) fn position_tolerance(&self) -> f64 {
        let (backlash, a) = (self.pair.backlash(), self.pair.center_distance());
        END_ROUNDING * self.module + 2.0 * backlash * backlash / a
    }

    /// The tooth of the mate with a flank at an edge contact.
    fn mate_tooth(
        &self,
        contact: &EdgeContact,
        touches: impl Fn(&OutlinePart<'_>, &Point) -> bool,
    ) -> Option<u32> {
        let pose = contact.position.pose(self.pair, &contact.at);
        let edge = &contact.edge;
        let contact_point =
            Point::from(edge.point.coords + edge.normal * self.flank_gap(contact.position));
        let (mate, point) = match contact.member {
            Member::Driver => (&self.driven, pose.point_to_driven(&contact_point)),
            Member::Driven => (&self.driver, pose.point_to_driver(&contact_point)),
        };
        let near = MATE_DISTANCE * self.module;
        let is_near = |group: &Run<Disc>| {
            (group.bound.center - point).norm_squared() < (group.bound.radius + near).powi(2)
        };
        let mut found = None;
        mate.tree.any(&is_near, &mut |part| {
            let part = &mate.parts[part];
            let is_mate = part.role == Role::Flank
                && part.span.min_distance(&point) < near
                && touches(part, &point);
            if is_mate {
                found = Some(part.tooth);
            }
            is_mate
        });
        found
    }

    /// Point of the driver at an edge contact, in the axes of the gear with the edge.
    fn contact_point(&self, edge: &FlankEnd, member: Member, position: BacklashPosition) -> Vector {
        match member {
            Member::Driver => edge.point.coords,
            Member::Driven => edge.point.coords + edge.normal * self.flank_gap(position),
        }
    }

    /// Gap between flanks in contact as designed, mm: at the law's angle it is half the backlash.
    fn flank_gap(&self, position: BacklashPosition) -> f64 {
        match position {
            BacklashPosition::AtLaw => 0.5 * self.pair.backlash(),
            BacklashPosition::Pushed(_) => 0.0,
        }
    }
}
