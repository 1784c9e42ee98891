use crate::{
    Point, Vector,
    curve::{Arc, Segment},
    numeric::COMPUTED,
    region::Outline,
};
use nalgebra::Isometry2;
use std::f64::consts::TAU;

impl Segment {
    /// Applies one map to every point; `vector` is its linear part. The map must preserve circles and their sense.
    fn mapped(&self, point: impl Fn(&Point) -> Point, vector: impl Fn(&Vector) -> Vector) -> Self {
        match self {
            Self::Line(start, end) => Self::Line(point(start), point(end)),
            Self::Arc(arc) => Self::Arc(Arc {
                start: point(&arc.start),
                end: point(&arc.end),
                bulge: arc.bulge,
            }),
            Self::Poly(poly) => Self::Poly(poly.mapped(point, vector)),
        }
    }
}

impl Outline {
    fn mapped(&self, point: impl Fn(&Point) -> Point, vector: impl Fn(&Vector) -> Vector) -> Self {
        // Equal points have equal images, so the contour stays closed.
        Self::from_closed(
            self.segments()
                .iter()
                .map(|segment| segment.mapped(&point, &vector))
                .collect(),
        )
    }

    /// The outline moved by a rigid motion.
    #[must_use]
    pub fn transformed(&self, motion: &Isometry2<f64>) -> Self {
        self.mapped(|p| motion * p, |v| motion * v)
    }

    /// The outline scaled by `k` about the origin.
    #[must_use]
    pub fn scaled(&self, k: f64) -> Self {
        self.mapped(|p| p * k, |v| v * k)
    }

    /// The contour in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::from_closed(
            self.segments()
                .iter()
                .rev()
                .map(Segment::reversed)
                .collect(),
        )
    }

    /// Full circle, counter-clockwise, as two half circles.
    #[must_use]
    pub fn circle(center: Point, radius: f64) -> Self {
        let right = center + Vector::new(radius, 0.0);
        let left = center - Vector::new(radius, 0.0);
        let half = |start, end| {
            Segment::Arc(Arc {
                start,
                end,
                bulge: 1.0,
            })
        };
        Self::from_closed(vec![half(right, left), half(left, right)])
    }

    /// Centre and radius, mm, of an outline that is a full circle.
    #[must_use]
    pub fn as_circle(&self) -> Option<(Point, f64)> {
        let mut found: Option<(Point, f64)> = None;
        let mut turned = 0.0;
        for segment in self.segments() {
            let Segment::Arc(arc) = segment else {
                return None;
            };
            let (center, radius) = (arc.center(), arc.radius());
            let same = found.is_none_or(|(c, r)| {
                (center - c).norm() < COMPUTED * radius && (r - radius).abs() < COMPUTED * radius
            });
            if !same {
                return None;
            }
            found = Some((center, radius));
            turned += arc.sweep().abs();
        }
        found.filter(|_| (turned - TAU).abs() < COMPUTED)
    }

    /// Polygon with the given corners.
    #[must_use]
    pub fn polygon(points: &[Point]) -> Self {
        let next = points.iter().cycle().skip(1);
        Self::from_closed(
            points
                .iter()
                .zip(next)
                .map(|(start, end)| Segment::Line(*start, *end))
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{curve::PolySegment, numeric::Tolerance};

    #[test]
    fn a_motion_keeps_area_and_closure_and_scaling_multiplies_it() {
        let wave = |t: f64| Point::from(Vector::new(t.cos(), t.sin()) * (5.0 + (3.0 * t).cos()));
        let tolerance = Tolerance::new(1e-10).expect("positive");
        let mut polys = PolySegment::fit(wave, 0.0, std::f64::consts::TAU, tolerance);
        let first = polys[0].start();
        if let Some(last) = polys.last_mut() {
            *last = last.pinned(last.start(), first);
        }
        let outline = Outline::new(polys.into_iter().map(Segment::from).collect()).expect("closed");
        let moved = outline.transformed(&Isometry2::new(Vector::new(3.0, -8.0), 0.7));
        let again = Outline::new(moved.segments().to_vec()).expect("still closed");
        assert!((again.area() - outline.area()).abs() < 1e-11);
        assert!((again.length() - outline.length()).abs() < 1e-11);
        let motion = Isometry2::new(Vector::new(3.0, -8.0), 0.7);
        assert!((again.centroid() - motion * outline.centroid()).norm() < 1e-12);
        let large = Outline::new(outline.scaled(3.0).segments().to_vec()).expect("still closed");
        assert!((large.area() - 9.0 * outline.area()).abs() < 1e-9);
        let back = Outline::new(outline.reversed().segments().to_vec()).expect("still closed");
        assert!((back.area() + outline.area()).abs() < 1e-11);
    }
}
