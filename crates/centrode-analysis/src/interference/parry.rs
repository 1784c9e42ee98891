//! Distances in one pose, with the library parry. No other file uses parry.

use centrode_geometry::Point;
use nalgebra::Isometry2;
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::details::closest_points_segment_segment;
use parry2d_f64::query::{ClosestPoints, PointQuery, distance};
use parry2d_f64::shape::Polyline;

/// The closed polygons around a body.
#[derive(Clone)]
pub(super) struct Boundary(Polyline);

impl std::fmt::Debug for Boundary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Boundary").finish_non_exhaustive()
    }
}

fn to_parry(p: Point) -> Vector {
    Vector::new(p.x, p.y)
}

fn from_parry(v: Vector) -> Point {
    Point::new(v.x, v.y)
}

fn pose(motion: &Isometry2<f64>) -> Pose {
    let shift = motion.translation.vector;
    Pose::new(Vector::new(shift.x, shift.y), motion.rotation.angle())
}

impl Boundary {
    pub(super) fn new(edges: &[[Point; 2]]) -> Self {
        let points = edges.iter().flatten().map(|p| to_parry(*p)).collect();
        let pairs = (0..).step_by(2).take(edges.len()).map(|i| [i, i + 1]);
        Self(Polyline::new(points, Some(pairs.collect())))
    }

    /// Distance of a point of the body's frame from the polygons, mm, positive inside and outside, and the index of the
    /// nearest edge.
    pub(super) fn nearest(&self, point: Point) -> (f64, u32) {
        let point = to_parry(point);
        let found = self.0.project_local_point(point, false);
        ((found.point - point).length(), found.subshape)
    }

    /// Minimum distance between two boundaries at their poses, and a closest point of each.
    ///
    /// It does not show overlap: a boundary inside the other has a distance too.
    pub(super) fn gap(
        [a, b]: [&Self; 2],
        [at_a, at_b]: [&Isometry2<f64>; 2],
    ) -> Option<(f64, [Point; 2])> {
        let (at_a, at_b) = (pose(at_a), pose(at_b));
        let found = distance(&at_a, &a.0, &at_b, &b.0).ok()?;
        let parts = [a.0.segment(found.subshape1), b.0.segment(found.subshape2)];
        let between = at_a.inv_mul(&at_b);
        let nearest = closest_points_segment_segment(&between, &parts[0], &parts[1], f64::MAX);
        let points = match nearest {
            ClosestPoints::WithinMargin(p, q) => [
                from_parry(at_a.transform_point(p)),
                from_parry(at_b.transform_point(q)),
            ],
            _ => [from_parry(at_a.transform_point(parts[0].a)); 2],
        };
        Some((found.distance, points))
    }
}
