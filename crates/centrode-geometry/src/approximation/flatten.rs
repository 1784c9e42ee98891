use crate::{
    Point, Vector,
    numeric::Tolerance,
    region::{Outline, Position},
};

/// A point of an [`Outline`] with the outward direction and curvature there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Position, mm.
    pub point: Point,
    /// Unit normal pointing away from the enclosed area.
    pub normal: Vector,
    /// Signed curvature, 1/mm: positive where the enclosed side is convex.
    pub curvature: f64,
    /// Index of the segment; at a corner, of the one that begins there.
    pub segment: usize,
}

impl Outline {
    /// Corners of a closed polygon on the outline that is nowhere farther from it than the tolerance.
    ///
    /// The bound is proven, not sampled. Ends of lines and arcs and every corner are among the points; the first point is
    /// not repeated at the end. Where two parts of the outline are nearer than the tolerance, for instance near a cusp, the
    /// polygon has more corners: it crosses itself only where the outline does, or within rounding. Cost: linear in segments
    /// and points.
    #[must_use]
    pub fn flatten(&self, tolerance: Tolerance) -> Vec<Point> {
        self.polygon_positions(tolerance)
            .into_iter()
            .map(|position| self.point(position))
            .collect()
    }

    /// The points of [`flatten`](Self::flatten) with outward normal and curvature.
    ///
    /// At a corner, both belong to the segment that begins there.
    #[must_use]
    pub fn samples(&self, tolerance: Tolerance) -> Vec<Sample> {
        let side = if self.is_counter_clockwise() {
            1.0
        } else {
            -1.0
        };
        self.polygon_positions(tolerance)
            .into_iter()
            .map(|position| {
                let segment = &self.segments()[position.segment];
                let jet = segment.at(position.u);
                let tangent = segment.tangent(position.u);
                Sample {
                    point: self.point(position),
                    normal: Vector::new(tangent.y, -tangent.x) * side,
                    curvature: side * jet.first.perp(&jet.second) / jet.first.norm().powi(3),
                    segment: position.segment,
                }
            })
            .collect()
    }

    /// Positions of a polygon within the tolerance; three or more for any tolerance.
    fn polygon_positions(&self, tolerance: Tolerance) -> Vec<Position> {
        let mut finer = tolerance;
        for _ in 0..60 {
            let positions = self.positions(finer);
            if positions.len() >= 3 {
                return self.untangled(positions, tolerance);
            }
            finer = finer.scaled(0.25);
        }
        self.positions(finer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        curve::{Arc, Segment},
        test_shapes::{rosette, tooth_ring},
    };

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    /// Maximum distance from dense points of the outline to the polygon, walking both together.
    fn deviation(outline: &Outline, polygon: &[Point]) -> f64 {
        let mut worst: f64 = 0.0;
        let mut edge = 0;
        let n = polygon.len();
        let distance = |p: Point, k: usize| {
            let (a, b) = (polygon[k % n], polygon[(k + 1) % n]);
            let t = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (p - (a + (b - a) * t)).norm()
        };
        for segment in outline.segments() {
            for i in 0..=200 {
                let p = segment.at(-1.0 + f64::from(i) / 100.0).point;
                while edge + 1 < n && distance(p, edge + 1) < distance(p, edge) {
                    edge += 1;
                }
                worst = worst.max(distance(p, edge));
            }
        }
        worst
    }

    #[test]
    fn polygons_keep_every_tolerance_with_few_points() {
        for fit in [1e-4, 1e-9] {
            let outline = rosette(20.0, 2.0, 5, tolerance(fit));
            let mut counts = Vec::new();
            for exponent in 0..7 {
                let tol = 0.5 * 10_f64.powi(-exponent);
                let polygon = outline.flatten(tolerance(tol));
                let worst = deviation(&outline, &polygon);
                assert!(worst <= tol, "tolerance {tol}: {worst}");
                counts.push(polygon.len() as f64);
                // The minimum count of a smooth closed curve: ∫ sqrt(|κ| / 8 tol) ds.
                let mut ideal = 0.0;
                for segment in outline.segments() {
                    for i in 0..100 {
                        let jet = segment.at(-0.99 + 0.02 * f64::from(i));
                        let speed = jet.first.norm();
                        let curvature = jet.first.perp(&jet.second).abs() / speed.powi(3);
                        ideal += (curvature / (8.0 * tol)).sqrt() * speed * 0.02;
                    }
                }
                assert!(
                    (polygon.len() as f64) < 1.45 * ideal + 12.0,
                    "tolerance {tol}: {} points, ideal {ideal}",
                    polygon.len()
                );
            }
            assert!(counts.windows(2).all(|w| w[1] > w[0]));
        }
    }

    #[test]
    fn corners_stay_and_scale_does_not_matter() {
        let outline = tooth_ring(23, 2.25, tolerance(1e-9));
        let polygon = outline.flatten(tolerance(1e-3));
        assert!(deviation(&outline, &polygon) <= 1e-3);
        let jumps = outline.tangent_jumps();
        let mut corners = 0;
        for (segment, jump) in outline.segments().iter().zip(jumps) {
            if jump > 1e-6 {
                corners += 1;
                assert!(polygon.contains(&segment.start()));
            }
        }
        assert_eq!(corners, 46);
        let large = outline.scaled(8.0).flatten(tolerance(8e-3));
        assert_eq!(large.len(), polygon.len());
        assert!(
            large
                .iter()
                .zip(&polygon)
                .all(|(a, b)| (a - b * 8.0).norm() < 1e-10)
        );
    }

    #[test]
    fn a_circle_is_divided_evenly_with_outward_normals() {
        let circle = Outline::circle(Point::new(4.0, 0.0), 10.0);
        for outline in [circle.clone(), circle.reversed()] {
            let samples = outline.samples(tolerance(1e-3));
            let min_count = std::f64::consts::PI / (1.0 - 1e-4_f64).acos();
            assert!((samples.len() as f64) < min_count + 3.0 && samples.len() as f64 >= min_count);
            for sample in &samples {
                let radial = (sample.point - Point::new(4.0, 0.0)) / 10.0;
                assert!((sample.normal - radial).norm() < 1e-12);
                assert!((sample.curvature - 0.1).abs() < 1e-12);
            }
        }
        assert!(circle.flatten(tolerance(1e6)).len() >= 3);
        let lens = Outline::new(vec![
            Segment::Arc(Arc {
                start: Point::origin(),
                end: Point::new(1.0, 0.0),
                bulge: 0.1,
            }),
            Segment::Arc(Arc {
                start: Point::new(1.0, 0.0),
                end: Point::origin(),
                bulge: 0.1,
            }),
        ])
        .expect("closed");
        assert!(lens.flatten(tolerance(1.0)).len() >= 3);
    }
}
