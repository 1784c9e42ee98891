use std::f64::consts::PI;
use std::sync::LazyLock;

use centrode_geometry::{Point, PolySegment, Segment, Vector};

/// Proven bounds of a segment between two parameters.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct CurveBounds {
    /// Minimum and maximum slope of a tangent relative to the chord; infinite if a tangent may be perpendicular to it.
    pub(in crate::contact) slopes: (f64, f64),
    /// Bound of the angle between a tangent and the chord.
    pub(super) tangent_angle: TangentAngle,
    /// Maximum distance from the chord, mm.
    pub(in crate::contact) sagitta: f64,
    /// Minimum and maximum signed distance from the chord, mm, positive to the right of it. If a tangent may be perpendicular to
    /// the chord: distance from its middle, in any direction.
    pub(super) sagitta_range: (f64, f64),
    /// Directions of the tangents at the ends.
    pub(in crate::contact) tangents: [Vector; 2],
}

/// Maximum angle between a tangent and the chord.
#[derive(Clone, Copy, Debug)]
pub(super) struct TangentAngle {
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl TangentAngle {
    /// The angle of the steeper of two slopes.
    fn of_slopes((low, high): (f64, f64)) -> Self {
        let slope = high.max(-low);
        if slope < f64::INFINITY {
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            Self {
                cos,
                sin: slope * cos,
            }
        } else {
            Self { cos: 0.0, sin: 1.0 }
        }
    }
}

impl CurveBounds {
    /// Bounds between two parameters.
    pub(in crate::contact) fn new(segment: &Segment, u0: f64, u1: f64) -> Self {
        let tangents = || [u0, u1].map(|u| segment.tangent(u));
        match segment {
            Segment::Line(..) => Self {
                slopes: (0.0, 0.0),
                tangent_angle: TangentAngle { cos: 1.0, sin: 0.0 },
                sagitta: 0.0,
                sagitta_range: (0.0, 0.0),
                tangents: tangents(),
            },
            Segment::Arc(arc) => {
                let angle = 0.25 * (u1 - u0) * arc.sweep().abs();
                let slope = if angle < 0.5 * PI {
                    angle.tan()
                } else {
                    f64::INFINITY
                };
                let sagitta = arc.radius() * angle * angle.min(2.0);
                Self {
                    slopes: (-slope, slope),
                    tangent_angle: TangentAngle::of_slopes((-slope, slope)),
                    sagitta,
                    sagitta_range: (-sagitta, sagitta),
                    tangents: tangents(),
                }
            }
            Segment::Poly(poly) => polynomial_bounds(&control_points(poly, u0, u1)),
        }
    }

    /// Distance by which the curve over a chord overshoots both its ends in a direction, times the direction's length.
    pub(in crate::contact) fn overshoot(&self, chord: &Vector, direction: &Vector) -> f64 {
        let right = chord.perp(direction) / -chord.norm();
        if self.slopes.1.is_finite() && right.is_finite() {
            (right * self.sagitta_range.0).max(right * self.sagitta_range.1)
        } else {
            self.sagitta * direction.norm()
        }
    }
}

/// Minimum and maximum curvature between two parameters, 1/mm, positive where the gear is convex.
pub(in crate::contact) fn curvature(segment: &Segment, u0: f64, u1: f64) -> (f64, f64) {
    match segment {
        Segment::Line(..) => (0.0, 0.0),
        Segment::Arc(arc) => {
            let curvature = arc.bulge.signum() / arc.radius();
            (curvature, curvature)
        }
        Segment::Poly(poly) => polynomial_curvature(&control_points(poly, u0, u1)),
    }
}

/// Minimum and maximum distance of a point from the normals between two parameters, mm, positive where the segment leads away from
/// the point.
pub(in crate::contact) fn levers(segment: &Segment, u0: f64, u1: f64, axis: Point) -> (f64, f64) {
    let along = |direction: Vector, point: Point| direction.normalize().dot(&(point - axis));
    let ends = [u0, u1].map(|u| segment.tangent(u));
    match segment {
        Segment::Line(..) => {
            let [start, end] = [u0, u1].map(|u| along(ends[0], segment.at(u).point));
            (start.min(end), start.max(end))
        }
        Segment::Arc(arc) => {
            // Every normal passes through the centre.
            let from = arc.center() - axis;
            let [start, end] = ends.map(|t| along(t, arc.center()));
            let is_between = |d: Vector| {
                let turn = ends[0].perp(&ends[1]);
                turn * ends[0].perp(&d) >= 0.0 && turn * d.perp(&ends[1]) >= 0.0
            };
            let long = 0.5 * (u1 - u0) * arc.sweep().abs() >= 0.9 * PI;
            let low = if long || is_between(-from) {
                -from.norm()
            } else {
                start.min(end)
            };
            let high = if long || is_between(from) {
                from.norm()
            } else {
                start.max(end)
            };
            (low, high)
        }
        Segment::Poly(poly) => {
            let points = control_points(poly, u0, u1);
            let first: [Vector; COUNT - 1] = std::array::from_fn(|i| points[i + 1] - points[i]);
            let mut away = [0.0; 2 * COUNT - 2];
            for (i, p) in points.iter().enumerate() {
                let from = p - axis.coords;
                for (j, d) in first.iter().enumerate() {
                    away[i + j] += TABLES.levers[i][j] * from.dot(d);
                }
            }
            let low = away.iter().copied().fold(f64::INFINITY, f64::min);
            let high = away.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let speeds = speeds(&points, &first);
            (
                divided_by_speed(low, low < 0.0, speeds, 1),
                divided_by_speed(high, high > 0.0, speeds, 1),
            )
        }
    }
}

/// Bounds of the speed along a polynomial segment divided by its degree: the minimum from its progress along the chord, the maximum
/// from the differences of its control points.
fn speeds(points: &[Vector; COUNT], first: &[Vector; COUNT - 1]) -> (f64, f64) {
    let chord = points[COUNT - 1] - points[0];
    let along = first.iter().map(|d| chord.dot(d));
    let slowest = along.fold(f64::INFINITY, f64::min) / chord.norm();
    (slowest, first.iter().map(Vector::norm).fold(0.0, f64::max))
}

/// Bound of a value divided by a power of the speed: an outward bound (away from zero) uses the minimum speed, an inward one the
/// maximum speed.
fn divided_by_speed(value: f64, outward: bool, (slowest, fastest): (f64, f64), power: i32) -> f64 {
    let speed = if outward { slowest } else { fastest };
    if speed > 0.0 {
        value / speed.powi(power)
    } else {
        f64::INFINITY.copysign(value)
    }
}

/// Coefficients of a polynomial segment.
const COUNT: usize = 14;

/// Tables of binomial coefficients.
struct Tables {
    /// Control values of the powers of u, by control point and power.
    powers: [[f64; COUNT]; COUNT],
    /// Weights of the cross products of first and second differences.
    products: [[f64; COUNT - 2]; COUNT - 1],
    /// Weights of the products of points and first differences.
    levers: [[f64; COUNT - 1]; COUNT],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let choose = |n: usize, k: usize| -> f64 {
        if k > n {
            return 0.0;
        }
        (0..k)
            .map(|i| (n - i) as f64 / (i + 1) as f64)
            .product::<f64>()
            .round()
    };
    let degree = COUNT - 1;
    // The polar form of u^k at i ends and the rest starts is its elementary symmetric mean.
    let power = |i: usize, k: usize| -> f64 {
        let term = |m: usize| {
            let sign = if (k - m).is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * choose(i, m) * choose(degree - i, k - m)
        };
        (0..=k).map(term).sum::<f64>() / choose(degree, k)
    };
    let product = |i: usize, j: usize| {
        choose(degree - 1, i) * choose(degree - 2, j) / choose(2 * degree - 3, i + j)
    };
    let lever = |i: usize, j: usize| {
        choose(degree, i) * choose(degree - 1, j) / choose(2 * degree - 1, i + j)
    };
    Tables {
        powers: std::array::from_fn(|i| std::array::from_fn(|k| power(i, k))),
        levers: std::array::from_fn(|i| std::array::from_fn(|j| lever(i, j))),
        products: std::array::from_fn(|i| std::array::from_fn(|j| product(i, j))),
    }
});

/// Moves the origin of the parameter to `middle` and scales its unit to `half`.
fn reparametrise(c: &mut [Vector; COUNT], middle: f64, half: f64) {
    for low in 0..COUNT - 1 {
        for k in (low..COUNT - 1).rev() {
            let above = c[k + 1];
            c[k] += above * middle;
        }
    }
    let mut unit = 1.0;
    for c in c.iter_mut().skip(1) {
        unit *= half;
        *c *= unit;
    }
}

/// Bernstein control points of a polynomial segment between two parameters.
fn control_points(poly: &PolySegment, u0: f64, u1: f64) -> [Vector; COUNT] {
    let mut c = [Vector::zeros(); COUNT];
    c.copy_from_slice(poly.coefficients());
    if (u0, u1) != (-1.0, 1.0) {
        reparametrise(&mut c, 0.5 * (u0 + u1), 0.5 * (u1 - u0));
    }
    let powers = &TABLES.powers;
    let mut out = [Vector::zeros(); COUNT];
    // In the second half the odd powers have the opposite sign.
    for i in 0..COUNT / 2 {
        let (mut even, mut odd) = (Vector::zeros(), Vector::zeros());
        for k in (0..COUNT).step_by(2) {
            even += c[k] * powers[i][k];
            odd += c[k + 1] * powers[i][k + 1];
        }
        out[i] = even + odd;
        out[COUNT - 1 - i] = even - odd;
    }
    out
}

/// Bounds of a polynomial segment from its control points: it lies in their hull, its derivative in that of their differences.
fn polynomial_bounds(points: &[Vector; COUNT]) -> CurveBounds {
    let chord = points[COUNT - 1] - points[0];
    let first: [Vector; COUNT - 1] = std::array::from_fn(|i| points[i + 1] - points[i]);
    let mut slopes = (f64::INFINITY, f64::NEG_INFINITY);
    for d in &first {
        let (along, across) = (chord.dot(d), chord.perp(d));
        // A null chord has no direction.
        if along > 0.0 {
            let slope = across / along;
            slopes = (slopes.0.min(slope), slopes.1.max(slope));
        } else if along < 0.0 || across != 0.0 {
            slopes = (f64::NEG_INFINITY, f64::INFINITY);
        }
    }
    // If all differences point forward, no point lies beyond the ends of the chord.
    let forward = slopes.1.is_finite();
    let size = if forward { chord.norm() } else { 1.0 };
    let mut sagitta_range = (0.0_f64, 0.0_f64);
    for p in points {
        let from = p - points[0];
        if forward {
            let right = from.perp(&chord) / size;
            sagitta_range = (sagitta_range.0.min(right), sagitta_range.1.max(right));
        } else {
            let away = (from - chord * 0.5).norm();
            sagitta_range = (sagitta_range.0.min(-away), sagitta_range.1.max(away));
        }
    }
    let moving = |d: &&Vector| **d != Vector::zeros();
    let [start, end] = [first.iter().find(moving), first.iter().rev().find(moving)];
    CurveBounds {
        slopes,
        tangent_angle: TangentAngle::of_slopes(slopes),
        sagitta: sagitta_range.1.max(-sagitta_range.0),
        sagitta_range,
        tangents: [start, end].map(|d| d.copied().unwrap_or(chord)),
    }
}

/// Bounds of a polynomial segment's curvature, from the control values of the cross product of its derivatives.
fn polynomial_curvature(points: &[Vector; COUNT]) -> (f64, f64) {
    let degree = (COUNT - 1) as f64;
    let first: [Vector; COUNT - 1] = std::array::from_fn(|i| points[i + 1] - points[i]);
    let second: [Vector; COUNT - 2] = std::array::from_fn(|i| first[i + 1] - first[i]);
    let products = &TABLES.products;
    let mut cross = [0.0; 2 * COUNT - 4];
    for (i, d) in first.iter().enumerate() {
        for (j, e) in second.iter().enumerate() {
            cross[i + j] += products[i][j] * d.perp(e);
        }
    }
    let low = cross.iter().copied().fold(f64::INFINITY, f64::min);
    let high = cross.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let speeds = speeds(points, &first);
    let curvature = |cross: f64, outward: bool| {
        divided_by_speed(cross, outward, speeds, 3) * (degree - 1.0) / degree
    };
    (curvature(low, low < 0.0), curvature(high, high > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::{Arc, Tolerance};

    #[test]
    fn the_bounds_hold_every_stretch_and_tighten_with_it() {
        let spiral = |t: f64| Point::new((1.0 + t * t) * t.cos(), (1.0 + t * t) * t.sin());
        let fine = Tolerance::new(1e-9).expect("positive");
        let mut segments: Vec<Segment> = PolySegment::fit(spiral, -0.9, 0.8, fine)
            .into_iter()
            .map(Segment::from)
            .collect();
        segments.push(Segment::Arc(Arc {
            start: Point::new(3.0, 1.0),
            end: Point::new(2.0, 2.0),
            bulge: -0.4,
        }));
        for segment in &segments {
            for (u0, u1) in [(-1.0, 1.0), (-1.0, -0.5), (0.2, 0.7), (0.5, 0.501)] {
                let span = CurveBounds::new(segment, u0, u1);
                let start = segment.at(u0);
                let chord = segment.at(u1).point - start.point;
                let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                let axis = Point::new(1.3, 0.4);
                let (lower, upper) = levers(segment, u0, u1, axis);
                let (mut min_lever, mut max_lever) = (f64::INFINITY, f64::NEG_INFINITY);
                for i in 0..=200 {
                    let jet = segment.at(u0 + (u1 - u0) * f64::from(i) / 200.0);
                    let k = jet.first.perp(&jet.second) / jet.first.norm().powi(3);
                    (low, high) = (low.min(k), high.max(k));
                    let lever = (jet.point - axis).dot(&jet.first) / jet.first.norm();
                    assert!(
                        lower - 1e-12 <= lever && lever <= upper + 1e-12,
                        "{lower} {lever} {upper}"
                    );
                    (min_lever, max_lever) = (min_lever.min(lever), max_lever.max(lever));
                    let slope = chord.perp(&jet.first) / chord.dot(&jet.first);
                    assert!(span.slopes.0 - 1e-9 <= slope && slope <= span.slopes.1 + 1e-9);
                    let off = chord.perp(&(jet.point - start.point)).abs() / chord.norm();
                    assert!(off <= span.sagitta * (1.0 + 1e-9) + 1e-14);
                }
                let (minimum, maximum) = curvature(segment, u0, u1);
                assert!(
                    minimum <= low + 1e-6 && high - 1e-6 <= maximum,
                    "{minimum} {low} {high} {maximum}"
                );
                if u1 - u0 < 0.01 {
                    let width = max_lever - min_lever;
                    assert!(
                        upper - lower < 1.1 * width + 1e-6,
                        "{lower} {upper} {width}"
                    );
                    assert!(
                        maximum - minimum < 2.0 * (high - low) + 1e-2,
                        "{minimum} {low} {high} {maximum}"
                    );
                }
            }
        }
    }
}
