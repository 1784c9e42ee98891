use super::offset::{Shifted, Source, angle, joined};
use crate::{
    Point,
    curve::{Arc, CrossingError, Segment, SegmentRange},
    numeric::{Tolerance, bracketed_minimum},
    region::{LoopError, Outline, Position, without_loops},
};

/// Path of the centre of a round cutter along an outline, such as a laser beam, and the contour that remains.
#[derive(Clone, Debug)]
pub struct CutterPath {
    /// Path of the centre.
    pub path: Outline,
    /// Contour that remains after the cut: the outline, with a round corner of the cutter in each uncut corner.
    pub remaining: Outline,
    /// For each segment of `remaining` the index of its segment of the outline, and whether it is the round corner after it.
    pub sources: Vec<(usize, bool)>,
    /// Corners that the cutter cannot reach within the tolerance, in order along the outline.
    pub uncut: Vec<UncutCorner>,
}

/// A corner that a round cutter cannot reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncutCorner {
    /// Point of the outline over which most material remains, mm.
    pub point: Point,
    /// Thickness of this material, mm.
    pub thickness: f64,
}

/// Distance, in tolerances, within which the two ends of a loop of a cutter's path are one joint of the outline. Ten times
/// smaller, rounding makes uncut corners of smooth joints; ten times larger hides corners of a thousandth of the cutter.
const NEAR: f64 = 1e3;

impl Outline {
    /// Path of the centre of a round cutter that cuts along the outline, and the contour that remains.
    ///
    /// The cutter has the radius `|offset|`, mm. It runs outside the outline if `offset` is positive, inside if it is negative.
    /// Lines and arcs of the outline give lines and arcs at exactly this distance, polynomial parts within the tolerance. The
    /// cutter turns about outer corners on an arc. It does not enter corners or gaps that are narrower than itself.
    ///
    /// # Errors
    /// [`LoopError`] if the cutter fits nowhere, or if the loops of its path cannot be determined.
    pub fn cutter_path(&self, offset: f64, tolerance: Tolerance) -> Result<CutterPath, LoopError> {
        match self.path_at(offset, tolerance) {
            // A gap exactly as wide as the cutter: a hair wider, the cutter does not enter it.
            Err(LoopError::Unresolved {
                cause: CrossingError::Overlap { .. },
                ..
            }) => self.path_at(offset + (10.0 * tolerance.mm()).copysign(offset), tolerance),
            found => found,
        }
    }

    fn path_at(&self, offset: f64, tolerance: Tolerance) -> Result<CutterPath, LoopError> {
        let is_counter_clockwise = self.area() > 0.0;
        let distance = if is_counter_clockwise {
            offset
        } else {
            -offset
        };
        let chain = self.shifted(distance, tolerance);
        if chain.is_empty() {
            return Err(LoopError::Everywhere);
        }
        let segments: Vec<Segment> = chain.iter().map(|shifted| shifted.segment).collect();
        let kept = without_loops(&segments, is_counter_clockwise, tolerance)?;
        // Where the cutter is larger than the whole outline, the path runs backwards all round.
        if kept
            .iter()
            .any(|part| self.is_backward(&chain[part.index], part, distance))
        {
            return Err(LoopError::Everywhere);
        }
        let path = kept.iter().map(|k| segments[k.index].part(k.from, k.to));
        let path = joined(path.collect());

        let mut remaining: Vec<(Segment, (usize, bool))> = Vec::new();
        let mut uncut = Vec::new();
        for (i, part) in kept.iter().enumerate() {
            let next = &kept[(i + 1) % kept.len()];
            let source = chain[part.index].source;
            let [from, to] = [part.from, part.to].map(|u| source.position(u));
            self.add(from, to, &mut remaining);
            let after = chain[next.index].source.position(next.from);
            if (part.to, next.from) == (1.0, -1.0) && next.index == (part.index + 1) % chain.len() {
                // The cutter is as round as an arc of the outline that it skips.
                self.add(to, after, &mut remaining);
                continue;
            }
            let [start, end] = [to, after].map(|position| self.point(position));
            if (end - start).norm() <= NEAR * tolerance.mm() {
                // Rounding makes a loop at a joint.
                continue;
            }
            let center = segments[part.index].at(part.to).point;
            let thickest = self.thickest(to, after, center, distance.abs());
            if let Some(corner) = thickest.filter(|corner| corner.thickness > tolerance.mm()) {
                uncut.push(corner);
            }
            let turn = angle(start - center, end - center);
            let turn = match distance > 0.0 {
                true if turn > 0.0 => turn - std::f64::consts::TAU,
                false if turn < 0.0 => turn + std::f64::consts::TAU,
                _ => turn,
            };
            let bulge = (0.25 * turn).tan();
            let arc = Segment::Arc(Arc { start, end, bulge });
            remaining.push((arc, (to.segment, true)));
        }
        let (segments, sources) = remaining.into_iter().unzip();
        Ok(CutterPath {
            path,
            remaining: joined(segments),
            sources,
            uncut,
        })
    }

    /// Whether a part of an offset curve runs against its source.
    fn is_backward(&self, shifted: &Shifted, part: &SegmentRange, distance: f64) -> bool {
        let u = 0.5 * (part.from + part.to);
        match (shifted.source, shifted.segment) {
            (Source::Corner(_), Segment::Arc(arc)) => arc.bulge * distance < 0.0,
            (source, segment) => {
                let Position {
                    segment: index,
                    u: at,
                } = source.position(u);
                self.segments()[index].tangent(at).dot(&segment.tangent(u)) < 0.0
            }
        }
    }

    /// Adds the segments from one position to another, the end of the last one joined to the first where it is the same.
    fn add(&self, from: Position, to: Position, out: &mut Vec<(Segment, (usize, bool))>) {
        if from == to {
            return;
        }
        for part in from.ranges_to(to, self.segments().len()) {
            let segment = self.segments()[part.index].part(part.from, part.to);
            out.push((segment, (part.index, false)));
        }
    }

    /// Point between two positions that is farthest from the cutter at `center`.
    fn thickest(
        &self,
        from: Position,
        to: Position,
        center: Point,
        radius: f64,
    ) -> Option<UncutCorner> {
        const SAMPLES: u32 = 8;
        let ranges = from.ranges_to(to, self.segments().len());
        let corners = ranges.map(|part| {
            let point = |u: f64| self.segments()[part.index].at(u).point;
            let thickness = |u: f64| (point(u) - center).norm() - radius;
            let sample =
                |i: u32| part.from + (part.to - part.from) * f64::from(i) / f64::from(SAMPLES);
            let best = (0..=SAMPLES)
                .max_by(|&i, &j| thickness(sample(i)).total_cmp(&thickness(sample(j))))
                .unwrap_or(0);
            let near = [best.saturating_sub(1), (best + 1).min(SAMPLES)].map(sample);
            let (inside, _) = bracketed_minimum(|u| -thickness(u), near[0], near[1]);
            let u = if thickness(inside) > thickness(sample(best)) {
                inside
            } else {
                sample(best)
            };
            UncutCorner {
                point: point(u),
                thickness: thickness(u),
            }
        });
        corners.max_by(|a, b| a.thickness.total_cmp(&b.thickness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::tooth_ring;

    fn fine() -> Tolerance {
        Tolerance::new(1e-9).expect("positive")
    }

    fn polygon(corners: &[(f64, f64)]) -> Outline {
        let points: Vec<Point> = corners.iter().map(|&(x, y)| Point::new(x, y)).collect();
        Outline::polygon(&points)
    }

    fn area(outline: &Outline) -> f64 {
        Outline::new(outline.segments().to_vec()).expect("closed");
        outline.area()
    }

    #[test]
    fn a_cutter_goes_round_outer_corners_and_leaves_its_own_radius_in_inner_ones() {
        let pi = std::f64::consts::PI;
        let square = polygon(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)]);
        for outline in [square.clone(), square.reversed()] {
            let sense = outline.area().signum();
            let outside = outline.cutter_path(0.5, fine()).expect("a path");
            let steiner = 12.0 + 14.0 * 0.5 + pi * 0.25;
            assert!((area(&outside.path) - sense * steiner).abs() < 1e-12);
            assert!((area(&outside.remaining) - sense * 12.0).abs() < 1e-12);
            assert_eq!(outside.uncut, []);

            let inside = outline.cutter_path(-0.5, fine()).expect("a path");
            assert!((area(&inside.path) - sense * 6.0).abs() < 1e-12);
            let left = 12.0 - (4.0 - pi) * 0.25;
            assert!((area(&inside.remaining) - sense * left).abs() < 1e-12);
            assert_eq!(inside.uncut.len(), 4);
            for corner in inside.uncut {
                assert!((corner.thickness - 0.5 * (2_f64.sqrt() - 1.0)).abs() < 1e-12);
                assert!(square.segments().iter().any(|s| s.start() == corner.point));
            }
        }
    }

    #[test]
    fn a_pocket_behind_a_mouth_narrower_than_the_cutter_stays() {
        let mouth = |width: f64| {
            polygon(&[
                (0.0, 0.0),
                (10.0, 0.0),
                (10.0, 4.0 - 0.5 * width),
                (8.0, 4.0 - 0.5 * width),
                (8.0, 2.0),
                (2.0, 2.0),
                (2.0, 6.0),
                (8.0, 6.0),
                (8.0, 4.0 + 0.5 * width),
                (10.0, 4.0 + 0.5 * width),
                (10.0, 8.0),
                (0.0, 8.0),
            ])
        };
        let open = mouth(1.1).cutter_path(0.5, fine()).expect("a path");
        assert_eq!(open.uncut.len(), 4);
        // A mouth exactly as wide as the cutter stays shut, too.
        let exact = mouth(1.0).cutter_path(0.5, fine()).expect("a path");
        assert_eq!(exact.uncut.len(), 1);
        let shut = mouth(0.9).cutter_path(0.5, fine()).expect("a path");
        let [pocket] = shut.uncut[..] else {
            panic!("{:?}", shut.uncut);
        };
        assert!(pocket.thickness > 6.0 && pocket.point.x < 2.5, "{pocket:?}");
        // The mouth is closed by an arc of the cutter that touches both its corners.
        let sweep = 2.0 * 0.9_f64.asin();
        let bite = 0.5 * 0.25 * (sweep - sweep.sin());
        assert!((area(&shut.remaining) - (80.0 - bite)).abs() < 1e-12);
    }

    #[test]
    fn teeth_with_fillets_as_round_as_the_cutter_are_cut_whole() {
        let ring = tooth_ring(23, 2.0, fine());
        let path = ring.cutter_path(0.1, fine()).expect("a path");
        assert_eq!(path.uncut, []);
        assert!((area(&path.remaining) - ring.area()).abs() < 1e-9);
        let turn = std::f64::consts::TAU;
        let steiner = ring.area() + 0.1 * ring.length() + 0.5 * turn * 0.01;
        assert!((area(&path.path) - steiner).abs() < 1e-6);
        let coarse = ring.cutter_path(1.2, fine()).expect("a path");
        assert_eq!(coarse.uncut.len(), 23);
        let thickness = coarse.uncut[0].thickness;
        let are_equal = |corner: &UncutCorner| (corner.thickness - thickness).abs() < 1e-6;
        assert!(
            thickness > 0.01 && coarse.uncut.iter().all(are_equal),
            "{:?}",
            coarse.uncut
        );
        assert!(area(&coarse.remaining) > ring.area());
        // A slot with round ends.
        let p = Point::new;
        let cap = |start: Point, end: Point| {
            Segment::Arc(Arc {
                start,
                end,
                bulge: 1.0,
            })
        };
        let slot = |radius: f64| {
            let [a, b] = [p(0.0, -radius), p(9.0, -radius)];
            let [c, d] = [p(9.0, radius), p(0.0, radius)];
            let sides = [
                Segment::Line(a, b),
                cap(b, c),
                Segment::Line(c, d),
                cap(d, a),
            ];
            Outline::new(sides.to_vec()).expect("closed")
        };
        let wide = slot(0.5).cutter_path(-0.4, fine()).expect("a path");
        assert!((wide.path.area() - slot(0.1).area()).abs() < 1e-12);
        assert!((wide.remaining.area() - slot(0.5).area()).abs() < 1e-12);
        assert!(slot(0.5).cutter_path(-0.6, fine()).is_err());
        let hole = Outline::circle(p(1.0, 2.0), 3.0);
        for radius in [3.0, 3.5] {
            let refused = hole.cutter_path(-radius, fine()).expect_err("too wide");
            assert_eq!(refused, LoopError::Everywhere);
        }
    }
}
