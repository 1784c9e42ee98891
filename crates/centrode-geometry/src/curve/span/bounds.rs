use std::f64::consts::{FRAC_PI_2, PI};

use super::bernstein::{self, STEPS};
use crate::{Point, Vector, curve::Segment};

/// Proven bounds of a segment between two parameters, relative to its chord.
#[derive(Clone, Copy, Debug)]
pub struct SpanBounds {
    /// Unit vector along the chord; zero if the chord is null.
    pub direction: Vector,
    /// Minimum and maximum slope of a tangent relative to the chord; infinite if a tangent may be perpendicular to it.
    pub slopes: (f64, f64),
    /// Cosine of the maximum angle between a tangent and the chord; zero if a tangent may be perpendicular to it.
    pub cos: f64,
    /// Sine of the maximum angle between a tangent and the chord.
    pub sin: f64,
    /// Maximum distance from the chord, mm.
    pub sagitta: f64,
    /// Minimum and maximum signed distance from the chord, mm, positive to the right of it. If a tangent may be perpendicular
    /// to the chord: distance from its middle, in any direction.
    pub sagitta_range: (f64, f64),
    /// Directions of the tangents at the ends.
    pub tangents: [Vector; 2],
}

impl SpanBounds {
    /// Bounds between two parameters.
    #[must_use]
    pub fn new(segment: &Segment, u: [f64; 2]) -> Self {
        let tangents = || u.map(|u| segment.tangent(u));
        match segment {
            Segment::Line(start, end) => Self::of(end - start, (0.0, 0.0), (0.0, 0.0), tangents()),
            Segment::Arc(arc) => {
                let angle = 0.25 * (u[1] - u[0]) * arc.sweep().abs();
                let slope = if angle < FRAC_PI_2 {
                    angle.tan()
                } else {
                    f64::INFINITY
                };
                // A nearly straight arc has no finite radius.
                let sagitta = if angle > 0.0 {
                    arc.radius() * angle * angle.min(2.0)
                } else {
                    0.0
                };
                let [start, end] = tangents();
                let range = (-sagitta, sagitta);
                Self::of(start + end, (-slope, slope), range, [start, end])
            }
            Segment::Poly(poly) => Self::of_steps(&bernstein::steps(poly, u)),
        }
    }

    fn of(
        chord: Vector,
        slopes: (f64, f64),
        sagitta_range: (f64, f64),
        tangents: [Vector; 2],
    ) -> Self {
        let slope = slopes.1.max(-slopes.0);
        let (cos, sin) = if slope < f64::INFINITY {
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            (cos, slope * cos)
        } else {
            (0.0, 1.0)
        };
        Self {
            direction: chord.try_normalize(0.0).unwrap_or_default(),
            slopes,
            cos,
            sin,
            sagitta: sagitta_range.1.max(-sagitta_range.0),
            sagitta_range,
            tangents,
        }
    }

    /// Bounds of a polynomial segment from the differences of its control points.
    fn of_steps(steps: &[Vector; STEPS]) -> Self {
        let chord: Vector = steps.iter().sum();
        let mut slopes = (f64::INFINITY, f64::NEG_INFINITY);
        for d in steps {
            let (along, across) = (chord.dot(d), chord.perp(d));
            if along > 0.0 {
                let slope = across / along;
                slopes = (slopes.0.min(slope), slopes.1.max(slope));
            } else if along < 0.0 || across != 0.0 {
                slopes = (f64::NEG_INFINITY, f64::INFINITY);
            }
        }
        if slopes.0 > slopes.1 {
            // A null chord has no direction.
            slopes = (f64::NEG_INFINITY, f64::INFINITY);
        }
        // If all differences point forward, no point lies beyond the ends of the chord.
        let forward = slopes.1.is_finite();
        let size = chord.norm();
        let mut sagitta_range = if forward {
            (0.0, 0.0)
        } else {
            (-0.5 * size, 0.5 * size)
        };
        let mut from = Vector::zeros();
        for d in steps {
            from += d;
            let (low, high) = if forward {
                let right = from.perp(&chord) / size;
                (right, right)
            } else {
                let away = (from - chord * 0.5).norm();
                (-away, away)
            };
            sagitta_range = (sagitta_range.0.min(low), sagitta_range.1.max(high));
        }
        let moving = |d: &&Vector| **d != Vector::zeros();
        let [start, end] = [steps.iter().find(moving), steps.iter().rev().find(moving)];
        let tangents = [start, end].map(|d| d.copied().unwrap_or(chord));
        Self::of(chord, slopes, sagitta_range, tangents)
    }

    /// Whether every tangent is less than a quarter turn off the chord.
    #[must_use]
    pub fn is_forward(&self) -> bool {
        self.slopes.1.is_finite()
    }

    /// Minimum and maximum distance by which the curve overshoots both ends of its chord along a unit vector.
    pub(super) fn reach(&self, axis: &Vector) -> (f64, f64) {
        if self.is_forward() {
            let right = -self.direction.perp(axis);
            let (a, b) = (right * self.sagitta_range.0, right * self.sagitta_range.1);
            (a.min(b), a.max(b))
        } else {
            (-self.sagitta, self.sagitta)
        }
    }

    /// Distance by which the curve over a chord overshoots both its ends in a direction, times the direction's length.
    #[must_use]
    pub fn overshoot(&self, chord: &Vector, direction: &Vector) -> f64 {
        let right = chord.perp(direction) / -chord.norm();
        if self.is_forward() && right.is_finite() {
            (right * self.sagitta_range.0).max(right * self.sagitta_range.1)
        } else {
            self.sagitta * direction.norm()
        }
    }
}

impl Segment {
    /// Minimum and maximum curvature between two parameters, 1/mm, positive where the segment turns to the left.
    #[must_use]
    pub fn curvature_range(&self, u: [f64; 2]) -> (f64, f64) {
        match self {
            Self::Line(..) => (0.0, 0.0),
            Self::Arc(arc) => {
                let curvature = arc.bulge.signum() / arc.radius();
                (curvature, curvature)
            }
            Self::Poly(poly) => bernstein::curvature(&bernstein::steps(poly, u)),
        }
    }

    /// Minimum and maximum distance of a point from the normals between two parameters, mm, positive where the segment leads
    /// away from the point.
    #[must_use]
    pub fn lever_range(&self, u: [f64; 2], axis: Point) -> (f64, f64) {
        let along = |direction: Vector, point: Point| direction.normalize().dot(&(point - axis));
        let ends = || u.map(|u| self.tangent(u));
        match self {
            Self::Line(..) => {
                let direction = ends()[0];
                let [start, end] = u.map(|u| along(direction, self.at(u).point));
                (start.min(end), start.max(end))
            }
            Self::Arc(arc) => {
                // Every normal passes through the centre.
                let (from, ends) = (arc.center() - axis, ends());
                let [start, end] = ends.map(|t| along(t, arc.center()));
                let is_between = |d: Vector| {
                    let turn = ends[0].perp(&ends[1]);
                    turn * ends[0].perp(&d) >= 0.0 && turn * d.perp(&ends[1]) >= 0.0
                };
                let long = 0.5 * (u[1] - u[0]) * arc.sweep().abs() >= 0.9 * PI;
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
            Self::Poly(poly) => {
                let start = self.at(u[0]).point - axis;
                bernstein::levers(&bernstein::steps(poly, u), start)
            }
        }
    }
}
