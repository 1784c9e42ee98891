//! Driver angles at which a contact reaches the end of a flank.

use centrode_geometry::{Point, Vector};
use centrode_mechanism::gear::{GearPair, Member, Role};

use super::{
    body::{Body, Part},
    meshing::Meshing,
    touch::Pose,
    walk::Walk,
};

/// Steps a pitch at which a contact's edge is bracketed.
const STEPS: u32 = 8;

/// Driver angle at which the normal of a flank at its edge passes through the pitch point: there the contact, by the law of
/// gearing, comes to the edge or leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EdgeContact {
    pub(super) input: f64,
    /// Sliding speed there per speed of the driver, mm/rad.
    pub(super) sliding: f64,
}

/// End of a flank: its point and the flank's outward normal there, in the axes of its gear.
#[derive(Clone, Copy, Debug)]
struct Edge {
    point: Point,
    normal: Vector,
}

/// Ends of flanks that push the driven gear on: at the tip, and where the fillet begins.
fn edges(body: &Body<'_>) -> Vec<Edge> {
    let count = body.parts.len();
    // The driver turns clockwise and pushes along its outward normals; the driven gear turns the other way and is pushed against
    // its own.
    let drives = |edge: &Edge| {
        let way = Vector::new(edge.point.y, -edge.point.x);
        edge.normal.dot(&way) > 0.0
    };
    let edge = |part: &Part<'_>, point: Point, tangent: Vector| {
        let normal = Vector::new(tangent.y, -tangent.x).normalize();
        (part.role == Role::Flank).then_some(Edge { point, normal })
    };
    let mut found = Vec::new();
    for (k, after) in body.parts.iter().enumerate() {
        let before = &body.parts[(k + count - 1) % count];
        let is_end = after.corner.is_some() || before.role != after.role;
        let point = after.ends[0];
        if is_end {
            found.extend(edge(before, point, before.span.tangents[1]));
            found.extend(edge(after, point, after.span.tangents[0]));
        }
    }
    found.retain(drives);
    found
}

/// The pitch point in the axes of one gear, in the pose of an input.
fn pitch_point(pair: &GearPair, member: Member, input: f64, pose: &Pose) -> Vector {
    let ratio = pair.ratio(input);
    let from_driver = pose.axis.coords * (ratio / (1.0 + ratio));
    match member {
        Member::Driver => from_driver,
        Member::Driven => pose.back(&Point::from(from_driver)).coords,
    }
}

impl Meshing<'_> {
    /// Contacts at edges of flanks of both gears that drive, over one cycle, those that slide fastest first.
    pub(super) fn edge_contacts(&self) -> Vec<EdgeContact> {
        let pair = self.pair;
        let walk = Walk::new(pair, STEPS);
        let mut found = Vec::new();
        for (member, body) in [Member::Driver, Member::Driven]
            .into_iter()
            .zip([&self.driver, &self.driven])
        {
            let at = |phi: f64, pose: &Pose| pitch_point(pair, member, phi, pose);
            let steps = walk.inputs.iter().zip(&walk.poses);
            let points: Vec<Vector> = steps.map(|(&phi, pose)| at(phi, pose)).collect();
            for edge in edges(body) {
                let aside = |p: Vector| edge.normal.perp(&(p - edge.point.coords));
                for steps in walk.passages(member, edge.point) {
                    let roots = walk.roots(
                        steps,
                        |k| aside(points[k]),
                        |phi| aside(at(phi, &Pose::at_law(pair, phi))),
                    );
                    let within = roots.filter(|phi| (0.0..pair.cycle()).contains(phi));
                    found.extend(within.map(|phi| self.edge_contact(&edge, member, phi)));
                }
            }
        }
        found.sort_by(|a, b| b.sliding.total_cmp(&a.sliding));
        found
    }

    fn edge_contact(&self, edge: &Edge, member: Member, phi: f64) -> EdgeContact {
        // On the driver: flanks at the law's angle are half the backlash apart.
        let touched = match member {
            Member::Driver => edge.point,
            Member::Driven => edge.point + edge.normal * (0.5 * self.pair.backlash()),
        };
        let pose = Pose::at_law(self.pair, phi);
        let away = pitch_point(self.pair, member, phi, &pose) - touched.coords;
        EdgeContact {
            input: phi,
            sliding: away.norm() * (1.0 + self.pair.ratio(phi)),
        }
    }
}
