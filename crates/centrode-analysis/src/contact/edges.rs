//! Driver angles at which a contact reaches the edge of a tooth.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Vector, bracketed_root, checkpoint};
use centrode_mechanism::gear::{GearPair, Member, Role};

use super::body::{Body, Part};

/// Steps a pitch at which a contact's edge is bracketed.
const STEPS: u32 = 8;

/// Pitches from a tooth's edge within which the pitch point is when the edge touches: for a pressure angle of 14.5 degrees a full
/// tooth takes 1.3 of them.
const WITHIN: u32 = 2;

/// Driver angle at which the normal of a flank at its edge passes through the pitch point: there the contact, by the law of
/// gearing, comes to the edge or leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EdgeContact {
    pub(super) input: f64,
    /// Sliding speed there per speed of the driver, mm/rad.
    pub(super) sliding: f64,
}

/// Edge of a flank: its point and the flank's outward normal there, in the axes of its gear.
#[derive(Clone, Copy, Debug)]
struct Edge {
    point: Point,
    normal: Vector,
}

/// Edges at the ends of flanks that push the driven gear on.
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
        let Some(corner) = &after.corner else {
            continue;
        };
        let before = &body.parts[(k + count - 1) % count];
        found.extend(edge(before, corner.point, before.span.tangents[1]));
        found.extend(edge(after, corner.point, after.span.tangents[0]));
    }
    found.retain(drives);
    found
}

/// The pitch point in the axes of one gear: its direction, unwrapped, and where it is.
fn pitch_point(pair: &GearPair, member: Member, input: f64) -> (f64, Vector) {
    let ratio = pair.ratio(input);
    let a = pair.center_distance();
    let (direction, radius) = match member {
        Member::Driver => (input, a * ratio / (1.0 + ratio)),
        Member::Driven => (PI - pair.driven_angle(input), a / (1.0 + ratio)),
    };
    let (sin, cos) = direction.sin_cos();
    (direction, Vector::new(cos, sin) * radius)
}

/// Contacts at edges of flanks of both gears that drive, over one cycle, those that slide fastest first.
pub(super) fn edge_contacts(pair: &GearPair, bodies: [&Body<'_>; 2]) -> Vec<EdgeContact> {
    let cycle = pair.cycle();
    let teeth = pair.driver().tooth_count() * pair.mean_ratio().0;
    let (steps, beyond) = (teeth * STEPS, WITHIN * STEPS);
    let input = |k: u32| (f64::from(k) - f64::from(beyond)) * cycle / f64::from(steps);
    let mut found = Vec::new();
    for (member, body) in [Member::Driver, Member::Driven].into_iter().zip(bodies) {
        let at = |phi: f64| pitch_point(pair, member, phi);
        let points: Vec<(f64, Vector)> = (0..=steps + 2 * beyond).map(|k| at(input(k))).collect();
        let sense = if member == Member::Driver { 1.0 } else { -1.0 };
        let [first, last] = [points[0].0, points[points.len() - 1].0].map(|d| sense * d);
        for edge in edges(body) {
            checkpoint();
            let aside = |p: &Vector| edge.normal.perp(&(p - edge.point.coords));
            let own = sense * edge.point.y.atan2(edge.point.x);
            let mut direction = own + TAU * ((first - own) / TAU).ceil();
            while direction < last {
                let middle = points.partition_point(|(d, _)| sense * d < direction);
                let low = middle.saturating_sub(beyond as usize);
                let high = (middle + beyond as usize).min(points.len() - 1);
                for k in low..high {
                    let [f, g] = [&points[k].1, &points[k + 1].1].map(aside);
                    if (f > 0.0) == (g > 0.0) {
                        continue;
                    }
                    let [from, to] = [k, k + 1].map(|k| input(k as u32));
                    let phi = bracketed_root(|phi| aside(&at(phi).1), from, to, f, g);
                    if !(0.0..cycle).contains(&phi) {
                        continue;
                    }
                    // On the driver: flanks at the law's angle are half the backlash apart.
                    let touched = match member {
                        Member::Driver => edge.point,
                        Member::Driven => edge.point + edge.normal * (0.5 * pair.backlash()),
                    };
                    let away = at(phi).1 - touched.coords;
                    found.push(EdgeContact {
                        input: phi,
                        sliding: away.norm() * (1.0 + pair.ratio(phi)),
                    });
                }
                direction += TAU;
            }
        }
    }
    found.sort_by(|a, b| b.sliding.total_cmp(&a.sliding));
    found
}
