//! Driver angles at which a contact reaches the end of a flank.

use centrode_gear::{Member, PitchContact, Role};
use centrode_geometry::{Point, SegmentJet, Vector};

use super::{
    body::{GearOutline, OutlinePart},
    cycle::period,
    meshing::Meshing,
    places::Kind,
    touch::{Pose, Stand, foot},
    tree::Run,
    walk::Walk,
};

/// Depth, modules, to which flanks are taken to touch that are told by their chords.
const TOUCHING: f64 = 1e-3;

/// Distance, modules, of an edge from the end of a flank's part within which it touches it.
const ROUNDING: f64 = 1e-6;

/// Cosine of the angle between the normals of an edge and of the flank that it touches: they are opposite but for the backlash, which
/// turns them by less than 0.1 rad. Flanks that an edge passes without touching them are turned by more.
const FACING: f64 = -0.99;

/// Passage of the pitch point through the normal of a flank at its edge: there the contact, by the law of gearing, comes to the
/// edge or leaves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeContact {
    member: Member,
    edge: Edge,
    /// How the driven gear stands then.
    stand: Stand,
    /// Where the pitch curves touch then.
    pub(super) at: PitchContact,
    /// Whether the contact comes to the flank there, and does not leave it.
    pub(super) begins: bool,
    /// Sliding speed there per speed of the driver, mm/rad.
    pub(super) sliding: f64,
}

/// End of a flank: its point and the flank's outward normal there, in the axes of its gear.
#[derive(Clone, Copy, Debug)]
struct Edge {
    point: Point,
    normal: Vector,
    /// Tooth of the flank.
    owner: u32,
    /// Side of the normal on which the flank is, by the sign of distances from it.
    side: f64,
}

impl Edge {
    /// Distance of a point from the normal.
    fn aside(&self, point: Vector) -> f64 {
        self.normal.perp(&(point - self.point.coords))
    }
}

/// Ends of flanks that push the driven gear on (`sign` 1) or back (-1): at the tip, and where the fillet begins.
fn edges(body: &GearOutline<'_>, sign: f64) -> Vec<Edge> {
    let count = body.parts.len();
    // The driver turns clockwise and pushes along its outward normals; the driven gear turns the other way and is pushed against
    // its own.
    let drives = |edge: &Edge| {
        let way = Vector::new(edge.point.y, -edge.point.x);
        sign * edge.normal.dot(&way) > 0.0
    };
    let edge = |part: &OutlinePart<'_>, point: Point, tangent: Vector, side: f64| {
        let normal = Vector::new(tangent.y, -tangent.x).normalize();
        (part.role == Role::Flank).then_some(Edge {
            point,
            normal,
            owner: part.owner,
            side,
        })
    };
    let mut found = Vec::new();
    for (k, after) in body.parts.iter().enumerate() {
        let before = &body.parts[(k + count - 1) % count];
        let is_end = after.corner.is_some() || before.role != after.role;
        let point = after.ends[0];
        if is_end {
            found.extend(edge(before, point, before.span.tangents[1], -1.0));
            found.extend(edge(after, point, after.span.tangents[0], 1.0));
        }
    }
    found.retain(drives);
    found
}

/// The pitch point in the axes of one gear, where the ratio has this value.
fn pitch_point(member: Member, ratio: f64, pose: &Pose) -> Vector {
    let from_driver = pose.axis.coords * (ratio / (1.0 + ratio));
    match member {
        Member::Driver => from_driver,
        Member::Driven => pose.back(&Point::from(from_driver)).coords,
    }
}

impl Meshing<'_> {
    /// Contacts at edges of flanks of both gears that drive on (`sign` 1) or back (-1), over one period, those that slide fastest
    /// first.
    pub(super) fn edge_contacts(&self, walk: &Walk, sign: f64) -> Vec<EdgeContact> {
        let mut found = Vec::new();
        let pair = self.pair;
        let cycle = 0.0..period(pair);
        for (member, body) in [Member::Driver, Member::Driven]
            .into_iter()
            .zip([&self.driver, &self.driven])
        {
            let point = |at: &PitchContact, pose: &Pose| pitch_point(member, at.ratio(), pose);
            let steps = walk.points.iter().zip(&walk.poses);
            let points: Vec<Vector> = steps.map(|(at, pose)| point(at, pose)).collect();
            for edge in edges(body, sign) {
                let touched = self.touched(&edge, member, walk.stand);
                for steps in walk.passages(member, edge.point) {
                    found.extend(steps.filter_map(|step| {
                        let [f, g] = [step, step + 1].map(|k| edge.aside(points[k]));
                        if (f > 0.0) == (g > 0.0) {
                            return None;
                        }
                        let at = walk.root(pair, step, |at, pose| edge.aside(point(at, pose)))?;
                        let away = point(&at, &Pose::at(pair, &at, walk.stand)) - touched;
                        cycle.contains(&at.input).then_some(EdgeContact {
                            member,
                            edge,
                            stand: walk.stand,
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

    /// Whether the mate has a flank near where an edge would touch it.
    pub(super) fn has_mate(&self, contact: &EdgeContact) -> bool {
        self.mate(contact, |_, _| true).is_some()
    }

    /// The teeth of driver and driven gear that touch where the mate has a flank for an edge.
    pub(super) fn touching_teeth(&self, contact: &EdgeContact) -> Option<(u32, u32)> {
        // An edge may be off its mate's flank, beyond the normals of both parts of it at a joint.
        let off = self.unsure();
        let pose = Pose::at(self.pair, &contact.at, contact.stand);
        let normal = match contact.member {
            Member::Driver => pose.turn_back(&contact.edge.normal),
            Member::Driven => pose.turn(&contact.edge.normal),
        };
        // Beyond the base circle an edge passes a flank that it does not face.
        let faces = |(_, jet): (f64, SegmentJet)| {
            let outward = Vector::new(jet.first.y, -jet.first.x).normalize();
            outward.dot(&normal) < FACING
        };
        let mate = self.mate(contact, |part, point| {
            let at_end = |end: &Point| (end - point).norm() < off;
            foot(part, point).is_some_and(faces) || part.ends.iter().any(at_end)
        })?;
        Some(match contact.member {
            Member::Driver => (contact.edge.owner, mate),
            Member::Driven => (mate, contact.edge.owner),
        })
    }

    /// Number of pairs of teeth whose flanks face each other as designed where the pitch curves touch, with the driver pushing on
    /// (`sign` 1) or back (-1).
    pub(super) fn facing_teeth(&mut self, point: &PitchContact, stand: Stand, sign: f64) -> u32 {
        self.begin();
        let pose = Pose::at(self.pair, point, stand);
        let mut candidates = self.candidates(&pose);
        let places = self.places(&mut candidates, &pose);
        let near = self.unsure();
        let off = self.off(stand);
        let mut teeth: Vec<(u32, u32)> = places
            .iter()
            .filter(|p| {
                p.kind == Kind::Flanks
                    && p.corner.is_none()
                    && sign * p.touch.lever > 0.0
                    && (p.touch.gap - off).abs() < near
                    && p.touch.is_on_both()
            })
            .map(|p| {
                (
                    self.driver.parts[p.parts.0].owner,
                    self.driven.parts[p.parts.1].owner,
                )
            })
            .collect();
        teeth.sort_unstable();
        teeth.dedup();
        teeth.len() as u32
    }

    /// Distance, mm, within which flanks that touch as designed are known: seats are so to the first order of the backlash.
    pub(super) fn unsure(&self) -> f64 {
        let (play, a) = (self.pair.backlash(), self.pair.center_distance());
        ROUNDING * self.module + 2.0 * play * play / a
    }

    /// The tooth of the mate with a flank where an edge would touch it.
    fn mate(
        &self,
        contact: &EdgeContact,
        touches: impl Fn(&OutlinePart<'_>, &Point) -> bool,
    ) -> Option<u32> {
        let pose = Pose::at(self.pair, &contact.at, contact.stand);
        let edge = &contact.edge;
        let half = Point::from(edge.point.coords + edge.normal * self.off(contact.stand));
        let (mate, point) = match contact.member {
            Member::Driver => (&self.driven, pose.back(&half)),
            Member::Driven => (&self.driver, pose.place(&half)),
        };
        let near = TOUCHING * self.module;
        let may = |run: &Run| (run.center - point).norm_squared() < (run.radius + near).powi(2);
        let mut found = None;
        mate.tree.any(&may, &mut |part| {
            let part = &mate.parts[part];
            let is_mate =
                part.role == Role::Flank && part.clear_of(&point) < near && touches(part, &point);
            if is_mate {
                found = Some(part.owner);
            }
            is_mate
        });
        found
    }

    /// Point at which an edge touches, on the driver.
    fn touched(&self, edge: &Edge, member: Member, stand: Stand) -> Vector {
        match member {
            Member::Driver => edge.point.coords,
            Member::Driven => edge.point.coords + edge.normal * self.off(stand),
        }
    }

    /// Distance of flanks that would touch: at the law's angle they are half the backlash apart.
    fn off(&self, stand: Stand) -> f64 {
        match stand {
            Stand::Law => 0.5 * self.pair.backlash(),
            Stand::Seat(_) => 0.0,
        }
    }
}
