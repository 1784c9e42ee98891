//! Removal of crossings between chords where the outline itself does not cross.
//!
//! Such chords cross because two parts of the outline are nearer to each other than the chords are to the outline.

use std::collections::HashSet;

use crate::{
    Point,
    curve::{Bounds, SegmentRange},
    numeric::{COMPUTED, POSITION, Tolerance, bracketed_root},
    region::{BoundTree, Outline, Position},
};

/// Maximum number of passes, each of which divides the chords that cross. With too few, crossings remain near cusps; more only
/// cost time.
const MAX_PASSES: u32 = 48;

/// Fraction of a chord's parameter range at each end in which no position is added. Much smaller, chords become as short as
/// rounding; much larger, crossings near the ends remain.
const END: f64 = 1e-6;

impl Outline {
    /// Adds positions until no chords cross, except where the outline crosses itself or two parts differ only by rounding.
    ///
    /// Opposite the end of one chord the other chord gets a vertex. Between such pairs of vertices the chords do not cross,
    /// however close the curves are, for instance near a cusp.
    pub(crate) fn untangled(
        &self,
        mut positions: Vec<Position>,
        tolerance: Tolerance,
    ) -> Vec<Position> {
        for _ in 0..MAX_PASSES {
            let points: Vec<Point> = positions
                .iter()
                .map(|&position| self.point(position))
                .collect();
            let size = points.iter().copied().collect::<Bounds>().diagonal();
            let crossed = Chords::new(&points).crossed(tolerance.mm(), POSITION * size);
            if crossed.is_empty() {
                break;
            }
            let dropped = small_loops(&points, &crossed, COMPUTED * size);
            if !dropped.is_empty() {
                let mut number = 0..;
                positions.retain(|_| number.next().is_some_and(|k| !dropped.contains(&k)));
                continue;
            }
            let mut added: Vec<Insertion> = Vec::new();
            for (i, j) in crossed {
                let chord = |k: usize| [positions[k], positions[(k + 1) % positions.len()]];
                let (one, other) = (
                    self.opposite(chord(i), chord(j)),
                    self.opposite(chord(j), chord(i)),
                );
                if one.is_empty() && other.is_empty() {
                    added.extend([i, j].into_iter().filter_map(|k| {
                        Some(Insertion {
                            after: k,
                            position: self.middle(chord(k))?,
                        })
                    }));
                }
                let after = |k: usize| move |position| Insertion { after: k, position };
                added.extend(one.into_iter().map(after(i)));
                added.extend(other.into_iter().map(after(j)));
            }
            let before = positions.len();
            positions = self.with(&positions, added);
            if positions.len() == before {
                break;
            }
        }
        positions
    }

    /// Positions on the curve of a chord that are opposite the ends of another chord.
    fn opposite(&self, own: [Position; 2], other: [Position; 2]) -> Vec<Position> {
        let [start, end] = own.map(|position| self.point(position));
        let along = (end - start).normalize();
        let parts: Vec<SegmentRange> = own[0].ranges_to(own[1], self.segments().len()).collect();
        let mut found = Vec::new();
        for target in other.map(|position| self.point(position)) {
            let ahead =
                |segment: usize, u: f64| along.dot(&(self.point(Position { segment, u }) - target));
            for &SegmentRange {
                index: segment,
                from,
                to,
            } in &parts
            {
                let (low, high) = (ahead(segment, from), ahead(segment, to));
                if low < 0.0 && high > 0.0 {
                    let u = bracketed_root(|u| ahead(segment, u), from, to, low, high);
                    let margin = END * (to - from);
                    if u > from + margin && u < to - margin {
                        found.push(Position { segment, u });
                    }
                }
            }
        }
        found
    }

    /// A position between two: a joint if there is one, otherwise the middle.
    fn middle(&self, own: [Position; 2]) -> Option<Position> {
        let parts: Vec<SegmentRange> = own[0].ranges_to(own[1], self.segments().len()).collect();
        let SegmentRange {
            index: segment,
            from,
            to,
        } = *parts.get(parts.len() / 2)?;
        let u = if parts.len() > 1 {
            from
        } else {
            0.5 * (from + to)
        };
        (u > from && u < to || parts.len() > 1).then_some(Position { segment, u })
    }

    /// The positions with insertions between them, in order.
    fn with(&self, positions: &[Position], mut added: Vec<Insertion>) -> Vec<Position> {
        let count = self.segments().len();
        let ahead = |Insertion { after, position }: &Insertion| {
            let steps = (position.segment + count - positions[*after].segment) % count;
            let round = if steps == 0 && position.u < positions[*after].u {
                count
            } else {
                steps
            };
            (*after, round, position.u)
        };
        added.sort_by(|a, b| {
            let (a, b) = (ahead(a), ahead(b));
            (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
        });
        let mut out: Vec<Position> = Vec::with_capacity(positions.len() + added.len());
        let mut rest = added.into_iter().peekable();
        for (k, position) in positions.iter().enumerate() {
            out.push(*position);
            while let Some(next) = rest.next_if(|insertion| insertion.after == k) {
                if out.last() != Some(&next.position) {
                    out.push(next.position);
                }
            }
        }
        out
    }
}

/// A position to insert between two others.
struct Insertion {
    /// Index of the position before it.
    after: usize,
    position: Position,
}

/// Vertices of the loops between two crossing chords that are smaller than `size`, mm; the first vertex of each loop stays.
fn small_loops(points: &[Point], crossed: &[(usize, usize)], size: f64) -> HashSet<usize> {
    let count = points.len();
    let between = |from: usize, to: usize| -> Vec<usize> {
        let first = (from + 1) % count;
        let steps = (to + count - first) % count;
        let round = (1..=steps).map(|step| (first + step) % count);
        let near = |k: usize| (points[k] - points[first]).norm() <= size;
        let all: Option<Vec<usize>> = round.map(|k| near(k).then_some(k)).collect();
        all.unwrap_or_default()
    };
    let both = crossed.iter().flat_map(|&(i, j)| [(i, j), (j, i)]);
    both.flat_map(|(from, to)| between(from, to)).collect()
}

/// Chords of a closed polygon in a tree of boxes.
struct Chords<'a> {
    points: &'a [Point],
    tree: BoundTree<Bounds>,
}

impl<'a> Chords<'a> {
    fn new(points: &'a [Point]) -> Self {
        let next = points.iter().cycle().skip(1);
        let chords: Vec<[Point; 2]> = points.iter().zip(next).map(|(p, q)| [*p, *q]).collect();
        let tree = BoundTree::new(&chords, |run| run.iter().flatten().copied().collect());
        Self { points, tree }
    }

    fn chord(&self, k: usize) -> [Point; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    /// Pairs of chords that meet although their curves, within the tolerance, need not. Chords below rounding do not count.
    fn crossed(&self, tolerance: f64, rounding: f64) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        let mut pending: Vec<_> = self
            .tree
            .root()
            .map(|whole| (whole, whole))
            .into_iter()
            .collect();
        while let Some((a, b)) = pending.pop() {
            crate::checkpoint();
            match (a.single(), b.single()) {
                _ if a.index() == b.index() => {
                    if a.count() > 1 {
                        let [low, high] = self.tree.halves(&a);
                        pending.extend([(low, low), (high, high), (low, high)]);
                    }
                }
                _ if !a.bound.meets(&b.bound) => {}
                (Some(i), Some(j)) => {
                    if self.cross(i, j, tolerance, rounding) {
                        found.push((i, j));
                    }
                }
                _ if a.count() >= b.count() => {
                    pending.extend(self.tree.halves(&a).map(|half| (half, b)));
                }
                _ => pending.extend(self.tree.halves(&b).map(|half| (a, half))),
            }
        }
        found
    }

    /// Whether two chords meet although their curves need not.
    fn cross(&self, i: usize, j: usize, tolerance: f64, rounding: f64) -> bool {
        let count = self.points.len();
        let ([a, b], [p, q]) = (self.chord(i), self.chord(j));
        let (own, other) = (b - a, q - p);
        if own.norm() <= rounding && other.norm() <= rounding {
            return false;
        }
        if (i + 1) % count == j || (j + 1) % count == i {
            // Consecutive chords meet if the second lies on the first.
            return own.perp(&other) == 0.0 && own.dot(&other) < 0.0;
        }
        let sides_of_own = [p, q].map(|point| own.perp(&(point - a)));
        let sides_of_other = [a, b].map(|point| other.perp(&(point - p)));
        let separates = |sides: [f64; 2]| sides[0] * sides[1] > 0.0;
        if separates(sides_of_own) || separates(sides_of_other) {
            return false;
        }
        // If all ends are this far from the other chord, the curves cross, too.
        let far =
            |sides: [f64; 2], length: f64| sides.iter().all(|s| s.abs() > 2.0 * tolerance * length);
        !(far(sides_of_own, own.norm()) && far(sides_of_other, other.norm()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{PolySegment, Segment};

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    /// Two parabolas that leave a cusp in one direction, `bend` from each other, between two lines.
    fn cusp(bend: f64) -> Outline {
        let arc = |bend: f64| {
            let curve = move |t: f64| Point::new(t, bend * t * t);
            Segment::from(PolySegment::fit(curve, 0.0, 1.0, tolerance(1e-13))[0])
        };
        let (upper, lower) = (arc(1.0 + bend), arc(1.0));
        let far = Point::new(2.0, 1.0);
        Outline::new(vec![
            lower,
            Segment::Line(lower.end(), far),
            Segment::Line(far, upper.end()),
            upper.reversed(),
        ])
        .expect("closed")
    }

    /// Whether two chords that do not follow each other meet, each held against each.
    fn crosses(points: &[Point]) -> bool {
        let n = points.len();
        let side = |a: usize, b: usize, c: usize| {
            let at = |k: usize| points[k % n];
            (at(b) - at(a)).perp(&(at(c) - at(a)))
        };
        let meet = |i: usize, j: usize| {
            side(i, i + 1, j) * side(i, i + 1, j + 1) <= 0.0
                && side(j, j + 1, i) * side(j, j + 1, i + 1) <= 0.0
        };
        (0..n).any(|i| (i + 2..n).any(|j| (j + 1) % n != i && meet(i, j)))
    }

    #[test]
    fn polygons_of_curves_that_part_slowly_from_a_cusp_are_simple() {
        let mut tangled = 0;
        for bend in [0.3, 0.02, 1e-3, 1e-5] {
            let outline = cusp(bend);
            for mm in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
                let plain: Vec<Point> = outline
                    .positions(tolerance(mm))
                    .into_iter()
                    .map(|position| outline.point(position))
                    .collect();
                tangled += u32::from(crosses(&plain));
                let polygon = outline.flatten(tolerance(mm));
                assert!(!crosses(&polygon), "{bend} {mm}");
                assert!(polygon.len() <= 2 * plain.len() + 8, "{bend} {mm}");
            }
        }
        assert!(tangled >= 8, "{tangled}");
    }

    #[test]
    fn an_outline_that_crosses_itself_has_a_few_more_corners_at_most() {
        let eight = |t: f64| Point::new(10.0 * t.sin(), 10.0 * (2.0 * t).sin());
        let mut polys = PolySegment::fit(eight, 0.5, 0.5 + std::f64::consts::TAU, tolerance(1e-12));
        let start = polys[0].start();
        if let Some(last) = polys.last_mut() {
            *last = last.pinned(last.start(), start);
        }
        let outline = Outline::new(polys.into_iter().map(Segment::from).collect()).expect("closed");
        for mm in [1e-1, 1e-3, 1e-5] {
            let plain = outline.positions(tolerance(mm)).len();
            let points = outline.flatten(tolerance(mm));
            assert!(crosses(&points));
            assert!(points.len() <= plain + 8, "{plain} {}", points.len());
        }
    }

    #[test]
    fn a_gap_narrower_than_the_chords_bulge_stays_open() {
        let gap = 1e-7;
        let arc = |x: f64, bend: f64| {
            let curve = move |t: f64| Point::new(x + bend * t * t, t);
            Segment::from(PolySegment::fit(curve, -1.0, 1.3, tolerance(1e-13))[0])
        };
        // Two parallel walls of one bend; the right one runs downwards.
        let (left, right) = (arc(0.0, 0.4), arc(gap, 0.4).reversed());
        let corners = [left.end(), Point::new(-3.0, 3.0), Point::new(-3.0, -3.0)];
        let back = [Point::new(3.0, -3.0), Point::new(3.0, 3.0), right.start()];
        let mut segments = vec![left];
        segments.extend(corners.windows(2).map(|w| Segment::Line(w[0], w[1])));
        segments.push(Segment::Line(corners[2], back[0]));
        segments.extend(back.windows(2).map(|w| Segment::Line(w[0], w[1])));
        segments.extend([right, Segment::Line(right.end(), left.start())]);
        let outline = Outline::new(segments).expect("closed");
        for mm in [1e-2, 1e-4, 1e-6] {
            assert!(!crosses(&outline.flatten(tolerance(mm))), "{mm}");
        }
    }
}
