use centrode_gear::{GearPair, PitchContact};
use centrode_geometry::{Point, SegmentJet, Vector};

use super::body::{Corner, OutlinePart};

/// The pose of the driven gear in the driver's own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// The driven axis.
    pub(super) axis: Point,
    sin: f64,
    cos: f64,
}

impl Pose {
    /// Driver angle `phi`, driven angle `psi`, centre distance `a`.
    pub(super) fn new(phi: f64, psi: f64, a: f64) -> Self {
        let (sin, cos) = (phi + psi).sin_cos();
        Self {
            axis: Point::new(a * phi.cos(), a * phi.sin()),
            sin,
            cos,
        }
    }

    /// Pose with the pitch curves touching at a point and the driven gear at some stand.
    pub(super) fn at(pair: &GearPair, point: &PitchContact, stand: Stand) -> Self {
        let (sin, cos) = (point.input + stand.angle(pair, point)).sin_cos();
        Self {
            axis: Point::from(point.direction * pair.center_distance()),
            sin,
            cos,
        }
    }

    /// Turn of the gears to each other between two poses, rad, or twice the sine of half of it.
    pub(super) fn turn_between(&self, other: &Self) -> f64 {
        (self.sin - other.sin).hypot(self.cos - other.cos)
    }

    pub(super) fn turn(&self, v: &Vector) -> Vector {
        Vector::new(
            self.cos * v.x - self.sin * v.y,
            self.sin * v.x + self.cos * v.y,
        )
    }

    pub(super) fn turn_back(&self, v: &Vector) -> Vector {
        Vector::new(
            self.cos * v.x + self.sin * v.y,
            self.cos * v.y - self.sin * v.x,
        )
    }

    pub(super) fn place(&self, p: &Point) -> Point {
        self.axis + self.turn(&p.coords)
    }

    /// A point of the driver's frame in the driven gear's own.
    pub(super) fn back(&self, p: &Point) -> Point {
        let v = p - self.axis;
        Point::new(
            self.cos * v.x + self.sin * v.y,
            self.cos * v.y - self.sin * v.x,
        )
    }

    pub(super) fn jet(&self, jet: &SegmentJet) -> SegmentJet {
        SegmentJet {
            point: self.place(&jet.point),
            first: self.turn(&jet.first),
            second: self.turn(&jet.second),
        }
    }
}

/// Greatest way, modules at the centre distance, that backlash lets the driven gear turn.
const FARTHEST: f64 = 4.0;

/// Where the driven gear stands within its backlash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stand {
    /// At the law's angle, with half the backlash on either side.
    Law,
    /// Pushed on (1) or back (-1), to the first order of the backlash.
    Seat(f64),
}

impl Stand {
    /// Where flanks touch as designed, with the driver pushing on (`sign` 1) or back (-1).
    pub(super) fn of(pair: &GearPair, sign: f64) -> Self {
        if pair.backlash() > 0.0 {
            Self::Seat(sign)
        } else {
            Self::Law
        }
    }

    /// Driven angle, rad.
    pub(super) fn angle(self, pair: &GearPair, point: &PitchContact) -> f64 {
        let law = point.driven_angle;
        match self {
            Self::Law => law,
            Self::Seat(sign) => {
                let turn = 0.5 * pair.backlash() / lever(pair, point, sign);
                // Where the law's normal passes by the axis, no turn takes up the backlash.
                let is_turn =
                    turn >= 0.0 && turn * pair.center_distance() < FARTHEST * pair.module();
                if is_turn { law - sign * turn } else { law }
            }
        }
    }
}

/// Distance of the driven axis from the line of action by the law, with the driver pushing on (1) or back (-1), mm:
/// r2 cos(alpha -+ mu).
pub(super) fn lever(pair: &GearPair, point: &PitchContact, sign: f64) -> f64 {
    let (sin, cos) = pair.pressure_angle().sin_cos();
    let (along, across) = point.inclination;
    point.radii[1] * (cos * along + sign * sin * across)
}

/// Pair of points, one on each gear, that face each other along a common normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Distance between them along the normal, mm; negative where the gears penetrate.
    pub(super) gap: f64,
    /// Point on the driver, in the driver's frame.
    pub(super) point: Point,
    /// Outward normal of the driver there.
    pub(super) normal: Vector,
    /// Opening of the gap per radian the driven gear turns on, mm.
    pub(super) lever: f64,
    /// Parameters on the two parts.
    pub(super) at: (f64, f64),
}

impl Touch {
    /// Whether both points are on their parts, to rounding, and not a little beyond an end.
    pub(super) fn is_on_both(&self) -> bool {
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

/// Parameter change below which a gap, second-order in it, is exact.
const SETTLED: f64 = 3e-7;

/// Distance beyond an end, as a parameter, within which a point belongs to the neighbour as well.
pub(super) const JOINT: f64 = 1e-3;

/// Rounding of a parameter at an end, where neighbouring parts must not both miss a point.
const ON_PART: f64 = 1e-10;

/// Parameter beyond an end up to which a part is the same curve.
const CONTINUED: f64 = 0.25;

/// Points at which two smooth parts face each other, by Newton's method from the parameters `at`.
///
/// Solves A' x B' = 0 and (A - B).A' = 0; regular while the two parts do not hug each other.
pub(super) fn parts(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
) -> Option<Touch> {
    // Mating flanks are walked against each other: where one starts the other ends, and from the middle
    // a step may overshoot a place just inside an end.
    [at, (-0.9, 0.9), (0.9, -0.9)]
        .iter()
        .find_map(|&start| newton(a, b, pose, start, JOINT))
}

/// Points at which two smooth parts face each other of which one bends sharply at an end, where a search from there loses its way.
pub(super) fn sharp_parts(a: &OutlinePart<'_>, b: &OutlinePart<'_>, pose: &Pose) -> Option<Touch> {
    [(0.0, 0.0), (-0.5, 0.5), (0.5, -0.5)]
        .iter()
        .find_map(|&start| newton(a, b, pose, start, JOINT))
}

/// Points at which two smooth parts, continued a little beyond their ends, face each other.
pub(super) fn continued(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
) -> Option<Touch> {
    newton(a, b, pose, at, CONTINUED)
}

/// Newton's method for facing points from the parameters `at`; at most so far beyond an end.
fn newton(
    a: &OutlinePart<'_>,
    b: &OutlinePart<'_>,
    pose: &Pose,
    at: (f64, f64),
    beyond: f64,
) -> Option<Touch> {
    let (mut u, mut v) = at;
    for _ in 0..8 {
        let p = a.segment.at(u);
        let q = pose.jet(&b.segment.at(v));
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
            // Nearest, not farthest: the two must curve away from each other.
            let bend_a = p.first.perp(&p.second) / size.powi(3);
            let bend_b = q.first.perp(&q.second) / q.first.norm().powi(3);
            // With the last step, which is too small to look again.
            let ends = [p.point + p.first * du, q.point + q.first * dv];
            let touch = Touch::new(ends[0], ends[1], normal, (u + du, v + dv), pose);
            let opening = bend_a + bend_b + bend_a * bend_b * touch.gap;
            return (opening > 0.0).then_some(touch);
        }
        // Twice well outside and still going: the facing point is on a neighbour, which will find it.
        let outside = |x: f64, dx: f64| x.abs() > 1.25 && x * dx > 0.0;
        if outside(u, du) || outside(v, dv) {
            return None;
        }
        // Steps beyond the parts' own length leave the region the parts describe.
        u = (u + du.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
        v = (v + dv.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
    }
    None
}

/// Point at which a corner of the driven gear faces a part of the driver.
pub(super) fn driven_corner(a: &OutlinePart<'_>, corner: &Corner, pose: &Pose) -> Option<Touch> {
    let mate = pose.place(&corner.point);
    let (u, jet) = foot(a, &mate)?;
    let normal = Vector::new(jet.first.y, -jet.first.x) / jet.first.norm();
    Some(Touch::new(jet.point, mate, normal, (u, 0.0), pose))
}

/// Point at which a corner of the driver faces a part of the driven gear.
pub(super) fn driver_corner(corner: &Corner, b: &OutlinePart<'_>, pose: &Pose) -> Option<Touch> {
    // Seen from the driven gear, whose parts do not move.
    let back = corner.point - pose.axis;
    let own = Point::new(
        pose.cos * back.x + pose.sin * back.y,
        pose.cos * back.y - pose.sin * back.x,
    );
    let (v, jet) = foot(b, &own)?;
    let outward = Vector::new(jet.first.y, -jet.first.x) / jet.first.norm();
    let normal = -pose.turn(&outward);
    Some(Touch::new(
        corner.point,
        pose.place(&jet.point),
        normal,
        (0.0, v),
        pose,
    ))
}

/// Foot of the normal from a point to a part.
pub(super) fn foot(part: &OutlinePart<'_>, point: &Point) -> Option<(f64, SegmentJet)> {
    let chord = part.segment.end() - part.segment.start();
    let mut u = 2.0 * (point - part.segment.start()).dot(&chord) / chord.norm_squared() - 1.0;
    u = u.clamp(-1.0, 1.0);
    for _ in 0..12 {
        let jet = part.segment.at(u);
        let apart = jet.point - point;
        let square = jet.first.norm_squared();
        let slope = square + apart.dot(&jet.second);
        if slope.is_nan() {
            return None;
        }
        // Beyond the centre of a sharp bend the distance is greatest, and Newton's step would go there: downhill instead.
        let is_beyond = slope <= 0.0;
        let step = -apart.dot(&jet.first) / if is_beyond { square } else { slope };
        if is_beyond && (u + step).abs() > 1.0 {
            return None;
        }
        if step.abs() < SETTLED && !is_beyond {
            let end = u + step;
            return (end.abs() <= 1.0 + ON_PART).then_some((end, jet));
        }
        // Well outside and still going.
        if u.abs() > 1.25 && u * step > 0.0 {
            return None;
        }
        u = (u + step.clamp(-1.0, 1.0)).clamp(-1.6, 1.6);
    }
    None
}
