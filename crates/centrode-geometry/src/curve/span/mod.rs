//! A part of a segment with proven bounds, from the convex hull of its Bernstein control points.

mod bernstein;
mod bounds;

use crate::{
    Point, Vector,
    curve::{Bounds, Segment},
};

pub use bounds::SpanBounds;

/// Part of a segment between two parameters, with proven bounds.
#[derive(Clone, Copy, Debug)]
pub struct Span<'a> {
    /// The segment.
    pub segment: &'a Segment,
    /// Parameters of the ends.
    pub u: [f64; 2],
    /// The ends.
    pub ends: [Point; 2],
    /// Bounds relative to the chord.
    pub bounds: SpanBounds,
}

impl<'a> Span<'a> {
    /// The whole segment.
    #[must_use]
    pub fn whole(segment: &'a Segment) -> Self {
        Self::new(segment, [-1.0, 1.0], [segment.start(), segment.end()])
    }

    /// The part between two parameters with known ends.
    fn new(segment: &'a Segment, u: [f64; 2], ends: [Point; 2]) -> Self {
        Self {
            segment,
            u,
            ends,
            bounds: SpanBounds::new(segment, u),
        }
    }

    /// The part between two parameters.
    #[must_use]
    pub fn between(segment: &'a Segment, u: [f64; 2]) -> Self {
        Self::new(segment, u, u.map(|u| segment.at(u).point))
    }

    /// The two halves.
    #[must_use]
    pub fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.u[0] + self.u[1]);
        let point = self.segment.at(middle).point;
        [
            Self::new(self.segment, [self.u[0], middle], [self.ends[0], point]),
            Self::new(self.segment, [middle, self.u[1]], [point, self.ends[1]]),
        ]
    }

    /// Upper bound of the distance between any two of its points, mm.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm() + 2.0 * self.bounds.sagitta
    }

    /// Minimum and maximum of the part along a unit vector.
    #[must_use]
    pub fn extent(&self, axis: &Vector) -> (f64, f64) {
        let [a, b] = self.ends.map(|p| axis.dot(&p.coords));
        let (low, high) = self.bounds.reach(axis);
        (a.min(b) + low, a.max(b) + high)
    }

    /// A rectangle that contains the part.
    #[must_use]
    pub fn bounding_box(&self) -> Bounds {
        let (x, y) = (self.extent(&Vector::x()), self.extent(&Vector::y()));
        Bounds {
            min: Point::new(x.0, y.0),
            max: Point::new(x.1, y.1),
        }
    }

    /// Lower bound of its distance from a point, mm.
    #[must_use]
    pub fn min_distance(&self, point: &Point) -> f64 {
        let (chord, from) = (self.ends[1] - self.ends[0], point - self.ends[0]);
        let along = (from.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
        (from - chord * along).norm() - self.bounds.sagitta
    }
}

#[cfg(test)]
mod tests;
