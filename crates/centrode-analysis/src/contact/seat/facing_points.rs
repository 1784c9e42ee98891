use centrode_geometry::{Point, SegmentJet, Vector};

use crate::contact::contour::{Corner, OutlinePart, Pose};

/// Two points, one on each gear, that face each other along a common normal.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct FacingPoints {
    /// Distance between them along the normal, mm; negative if the gears penetrate.
    pub(in crate::contact) gap: f64,
    /// Point on the driver, in the driver's axes.
    pub(in crate::contact) point: Point,
    /// Outward normal of the driver there.
    pub(in crate::contact) normal: Vector,
    /// Change of the gap per rotation of the driven gear, mm/rad: the signed distance of the driven axis from the normal.
    pub(in crate::contact) lever: f64,
    /// Parameters on the two parts.
    pub(in crate::contact) at: (f64, f64),
}

/// Two parts that face each other, and the parameters there.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacingParts {
    /// Parts of driver and driven gear.
    pub(in crate::contact) parts: (usize, usize),
    /// Parameters on the two parts.
    pub(in crate::contact) at: (f64, f64),
}

impl FacingPoints {
    /// Whether both points are on their parts, to rounding, and not beyond an end.
    pub(in crate::contact) fn is_on_both(&self) -> bool {
        self.at.0.abs().max(self.at.1.abs()) <= 1.0 + ON_PART
    }

    fn new(point: Point, mate: Point, normal: Vector, at: (f64, f64), pose: &Pose) -> Self {
        let arm = mate - pose.axis;
        Self {
            gap: (mate - point).dot(&normal),
            point,
            normal,
            lever: normal.y * arm.x - normal.x * arm.y,
            at,
        }
    }
}

/// Newton step of a parameter below which a gap is exact: the gap depends on the parameter to second order. Ten times
/// more makes gaps inexact, ten times less costs a step.
const SETTLED: f64 = 3e-7;

/// Parameter beyond an end up to which a point belongs to both neighbours. A smaller one can lose a point at a joint, a
/// larger one finds points twice.
pub(in crate::contact) const JOINT: f64 = 1e-3;

/// Rounding of a parameter at an end. Without it a point at a joint could be missed by both neighbours.
const ON_PART: f64 = 1e-10;

/// Parameter beyond an end up to which a part is extrapolated during the iteration. A smaller value rejects good
/// starts, a larger one follows a polynomial far outside its part.
const CONTINUED: f64 = 0.25;

/// Points at which two smooth parts face each other, by Newton's method from the parameters `at`.
///
/// Solves A' x B' = 0 and (A - B).A' = 0, which is regular unless the two parts have the same curvature.
pub(super) fn facing_parts(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
) -> Option<FacingPoints> {
    // Mating flanks run in opposite senses: the start of one faces the end of the other. From the middle a step may overshoot a
    // point just inside an end.
    [at, (-0.9, 0.9), (0.9, -0.9)]
        .iter()
        .find_map(|&start| newton(a, b, pose, start, JOINT))
}

/// Points at which two smooth parts face each other, if one has a sharp bend at an end: a search from that end can fail.
pub(super) fn facing_sharp_parts(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
) -> Option<FacingPoints> {
    [(0.0, 0.0), (-0.5, 0.5), (0.5, -0.5)]
        .iter()
        .find_map(|&start| newton(a, b, pose, start, JOINT))
}

/// Points at which two smooth parts face each other, extrapolated a little beyond their ends.
pub(super) fn facing_beyond_ends(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
) -> Option<FacingPoints> {
    newton(a, b, pose, at, CONTINUED)
}

/// Newton's method for facing points from the parameters `at`, up to a parameter `beyond` an end.
fn newton(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
    beyond: f64,
) -> Option<FacingPoints> {
    let (mut u, mut v) = at;
    for _ in 0..8 {
        let p = a.span.segment.at(u);
        let q = pose.jet_to_driver(&b.span.segment.at(v));
        let apart = p.point - q.point;
        let f = p.first.perp(&q.first);
        let g = apart.dot(&p.first);
        let (f_u, f_v) = (p.second.perp(&q.first), p.first.perp(&q.second));
        let (g_u, g_v) = (
            p.first.norm_squared() + apart.dot(&p.second),
            -q.first.dot(&p.first),
        );
        let area = f_u * g_v - f_v * g_u;
        let du = (f_v * g - f * g_v) / area;
        let dv = (f * g_u - f_u * g) / area;
        if !(du.is_finite() && dv.is_finite()) {
            return None;
        }
        let settled = du.abs() < SETTLED && dv.abs() < SETTLED;
        if settled {
            if u.abs() > 1.0 + beyond || v.abs() > 1.0 + beyond {
                return None;
            }
            let size = p.first.norm();
            let normal = Vector::new(p.first.y, -p.first.x) / size;
            // The distance must be a minimum: the two parts must curve away from each other.
            let bend_a = p.first.perp(&p.second) / size.powi(3);
            let bend_b = q.first.perp(&q.second) / q.first.norm().powi(3);
            // The last step is applied without another evaluation: it is below the rounding.
            let ends = [p.point + p.first * du, q.point + q.first * dv];
            let points = FacingPoints::new(ends[0], ends[1], normal, (u + du, v + dv), pose);
            let opening = bend_a + bend_b + bend_a * bend_b * points.gap;
            return (opening > 0.0).then_some(points);
        }
        // Far outside and moving away: the facing point is on a neighbour.
        let outside = |x: f64, dx: f64| x.abs() > 1.25 && x * dx > 0.0;
        if outside(u, du) || outside(v, dv) {
            return None;
        }
        // A step longer than the part would leave the range of its polynomial.
        u = (u + du.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
        v = (v + dv.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
    }
    None
}

/// Point at which a corner of the driven gear faces a part of the driver.
pub(in crate::contact) fn facing_driven_corner(
    a: &OutlinePart<'_>,
    corner: &Corner,
    pose: &Pose,
) -> Option<FacingPoints> {
    let mate = pose.point_to_driver(&corner.point);
    let Foot { u, jet } = foot(a, &mate)?;
    let normal = Vector::new(jet.first.y, -jet.first.x) / jet.first.norm();
    Some(FacingPoints::new(jet.point, mate, normal, (u, 0.0), pose))
}

/// Point at which a corner of the driver faces a part of the driven gear.
pub(in crate::contact) fn facing_driver_corner(
    corner: &Corner,
    b: &OutlinePart<'_>,
    pose: &Pose,
) -> Option<FacingPoints> {
    let Foot { u: v, jet } = foot(b, &pose.point_to_driven(&corner.point))?;
    let outward = Vector::new(jet.first.y, -jet.first.x) / jet.first.norm();
    let normal = -pose.vector_to_driver(&outward);
    Some(FacingPoints::new(
        corner.point,
        pose.point_to_driver(&jet.point),
        normal,
        (0.0, v),
        pose,
    ))
}

/// Foot of the normal from a point to a part.
pub(in crate::contact) struct Foot {
    /// Parameter on the part.
    pub(in crate::contact) u: f64,
    pub(in crate::contact) jet: SegmentJet,
}

/// Foot of the normal from a point to a part, by Newton's method.
pub(in crate::contact) fn foot(part: &OutlinePart<'_>, point: &Point) -> Option<Foot> {
    let chord = part.span.segment.end() - part.span.segment.start();
    let mut u = 2.0 * (point - part.span.segment.start()).dot(&chord) / chord.norm_squared() - 1.0;
    u = u.clamp(-1.0, 1.0);
    for _ in 0..12 {
        let jet = part.span.segment.at(u);
        let apart = jet.point - point;
        let square = jet.first.norm_squared();
        let slope = square + apart.dot(&jet.second);
        if slope.is_nan() {
            return None;
        }
        // Beyond the centre of curvature Newton's step would go to a maximum of the distance: descend instead.
        let is_beyond = slope <= 0.0;
        let step = -apart.dot(&jet.first) / if is_beyond { square } else { slope };
        if is_beyond && (u + step).abs() > 1.0 {
            return None;
        }
        if step.abs() < SETTLED && !is_beyond {
            let end = u + step;
            return (end.abs() <= 1.0 + ON_PART).then_some(Foot { u: end, jet });
        }
        // Far outside and moving away.
        if u.abs() > 1.25 && u * step > 0.0 {
            return None;
        }
        u = (u + step.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
    }
    None
}
