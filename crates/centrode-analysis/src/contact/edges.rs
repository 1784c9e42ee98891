//! Driver angles at which a contact reaches the end of a flank.

use centrode_geometry::{Point, Vector};
use centrode_mechanism::gear::{Member, PitchContact, Role};

use super::{
    body::{GearOutline, OutlinePart},
    cycle::period,
    meshing::Meshing,
    touch::{Pose, Stand, foot},
    tree::Run,
    walk::Walk,
};

/// Depth, modules, to which flanks are taken to touch that are told by their chords.
const TOUCHING: f64 = 1e-3;

/// Passage of the pitch point through the normal of a flank at its edge: there the contact, by the law of gearing, comes to the
/// edge or leaves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeContact {
    member: Member,
    edge: Edge,
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
                let touched = self.touched(&edge, member);
                for steps in walk.passages(member, edge.point) {
                    found.extend(steps.filter_map(|step| {
                        let [f, g] = [step, step + 1].map(|k| edge.aside(points[k]));
                        if (f > 0.0) == (g > 0.0) {
                            return None;
                        }
                        let at = walk.root(pair, step, |at, pose| edge.aside(point(at, pose)))?;
                        let away = point(&at, &Pose::at(pair, &at, Stand::Law)) - touched;
                        cycle.contains(&at.input).then_some(EdgeContact {
                            member,
                            edge,
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
        self.any_mate(contact, |_, _| true)
    }

    /// Whether the mate has a flank where an edge would touch it.
    pub(super) fn meets(&self, contact: &EdgeContact) -> bool {
        self.any_mate(contact, |part, point| foot(part, point).is_some())
    }

    fn any_mate(
        &self,
        contact: &EdgeContact,
        touches: impl Fn(&OutlinePart<'_>, &Point) -> bool,
    ) -> bool {
        let pose = Pose::at(self.pair, &contact.at, Stand::Law);
        let edge = &contact.edge;
        let half = Point::from(edge.point.coords + edge.normal * (0.5 * self.pair.backlash()));
        let (mate, point) = match contact.member {
            Member::Driver => (&self.driven, pose.back(&half)),
            Member::Driven => (&self.driver, pose.place(&half)),
        };
        let near = TOUCHING * self.module;
        let may = |run: &Run| (run.center - point).norm_squared() < (run.radius + near).powi(2);
        mate.tree.any(&may, &mut |part| {
            let part = &mate.parts[part];
            part.role == Role::Flank && part.clear_of(&point) < near && touches(part, &point)
        })
    }

    /// Point at which an edge touches, on the driver: flanks at the law's angle are half the backlash apart.
    fn touched(&self, edge: &Edge, member: Member) -> Vector {
        match member {
            Member::Driver => edge.point.coords,
            Member::Driven => edge.point.coords + edge.normal * (0.5 * self.pair.backlash()),
        }
    }
}
