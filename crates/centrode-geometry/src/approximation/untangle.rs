//! Chords of an outline that cross where the outline does not: two of its parts are nearer each other than chords leave them.

use std::collections::HashSet;

use crate::{
    Point,
    curve::Bounds,
    numeric::{Tolerance, bracketed_root},
    region::{Outline, Place},
};

/// Greatest number of passes; each halves the longest chord that crosses another.
const MOST_PASSES: u32 = 48;

/// Share of a chord's parameter, from either end, within which no place is added.
const END: f64 = 1e-6;

/// Share of the outline's size below which a loop of chords is a speck, and is left out.
const SPECK: f64 = 1e-10;

/// Share of the outline's size below which a chord is rounding and tells no direction.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Outline {
    /// Adds places until no chords cross, except where the outline does or its parts are apart by rounding only.
    ///
    /// Where one chord ends, the other gets a vertex opposite: between such pairs of vertices chords lie beside
    /// each other as the curves do, however little they part, as beside a cusp.
    pub(crate) fn untangled(&self, mut places: Vec<Place>, tolerance: Tolerance) -> Vec<Place> {
        for _ in 0..MOST_PASSES {
            let points: Vec<Point> = places.iter().map(|&place| self.point(place)).collect();
            let size = points.iter().copied().collect::<Bounds>().diagonal();
            let crossed = Chords::new(&points).crossed(tolerance.mm(), ROUNDING * size);
            if crossed.is_empty() {
                break;
            }
            let specks = specks(&points, &crossed, SPECK * size);
            if !specks.is_empty() {
                let mut number = 0..;
                places.retain(|_| number.next().is_some_and(|k| !specks.contains(&k)));
                continue;
            }
            let mut added: Vec<(usize, Place)> = Vec::new();
            for (i, j) in crossed {
                let chord = |k: usize| [places[k], places[(k + 1) % places.len()]];
                let (one, other) = (
                    self.opposite(chord(i), chord(j)),
                    self.opposite(chord(j), chord(i)),
                );
                if one.is_empty() && other.is_empty() {
                    added.extend(
                        [i, j]
                            .into_iter()
                            .filter_map(|k| Some((k, self.middle(chord(k))?))),
                    );
                }
                added.extend(one.into_iter().map(|place| (i, place)));
                added.extend(other.into_iter().map(|place| (j, place)));
            }
            let before = places.len();
            places = self.with(&places, added);
            if places.len() == before {
                break;
            }
        }
        places
    }

    /// Segments from a place to the next, with the part of each that lies between.
    fn between(&self, [start, end]: [Place; 2]) -> Vec<(usize, f64, f64)> {
        let count = self.segments().len();
        let ahead = (end.segment + count - start.segment) % count;
        let steps = if ahead == 0 && end.u <= start.u {
            count
        } else {
            ahead
        };
        (0..=steps)
            .map(|step| {
                let from = if step == 0 { start.u } else { -1.0 };
                let to = if step == steps { end.u } else { 1.0 };
                ((start.segment + step) % count, from, to)
            })
            .filter(|(_, from, to)| to > from)
            .collect()
    }

    /// Places of a chord's curve beside the ends of another chord.
    fn opposite(&self, own: [Place; 2], other: [Place; 2]) -> Vec<Place> {
        let [start, end] = own.map(|place| self.point(place));
        let along = (end - start).normalize();
        let parts = self.between(own);
        let mut found = Vec::new();
        for target in other.map(|place| self.point(place)) {
            let ahead =
                |segment: usize, u: f64| along.dot(&(self.point(Place { segment, u }) - target));
            for &(segment, from, to) in &parts {
                let (low, high) = (ahead(segment, from), ahead(segment, to));
                if low < 0.0 && high > 0.0 {
                    let u = bracketed_root(|u| ahead(segment, u), from, to, low, high);
                    let margin = END * (to - from);
                    if u > from + margin && u < to - margin {
                        found.push(Place { segment, u });
                    }
                }
            }
        }
        found
    }

    /// A place between two, a joint where there is one.
    fn middle(&self, own: [Place; 2]) -> Option<Place> {
        let parts = self.between(own);
        let (segment, from, to) = *parts.get(parts.len() / 2)?;
        let u = if parts.len() > 1 {
            from
        } else {
            0.5 * (from + to)
        };
        (u > from && u < to || parts.len() > 1).then_some(Place { segment, u })
    }

    /// Places with others, each after the one of a number, in order.
    fn with(&self, places: &[Place], mut added: Vec<(usize, Place)>) -> Vec<Place> {
        let count = self.segments().len();
        let ahead = |(k, place): &(usize, Place)| {
            let steps = (place.segment + count - places[*k].segment) % count;
            let round = if steps == 0 && place.u < places[*k].u {
                count
            } else {
                steps
            };
            (*k, round, place.u)
        };
        added.sort_by(|a, b| {
            let (a, b) = (ahead(a), ahead(b));
            (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
        });
        let mut out: Vec<Place> = Vec::with_capacity(places.len() + added.len());
        let mut rest = added.into_iter().peekable();
        for (k, place) in places.iter().enumerate() {
            out.push(*place);
            while let Some((_, next)) = rest.next_if(|(after, _)| *after == k) {
                if out.last() != Some(&next) {
                    out.push(next);
                }
            }
        }
        out
    }
}

/// Vertices of a closed polygon, but for the first, that lie between two crossing chords and within a distance of each other.
fn specks(points: &[Point], crossed: &[(usize, usize)], speck: f64) -> HashSet<usize> {
    let count = points.len();
    let between = |from: usize, to: usize| -> Vec<usize> {
        let first = (from + 1) % count;
        let steps = (to + count - first) % count;
        let round = (1..=steps).map(|step| (first + step) % count);
        let near = |k: usize| (points[k] - points[first]).norm() <= speck;
        let all: Option<Vec<usize>> = round.map(|k| near(k).then_some(k)).collect();
        all.unwrap_or_default()
    };
    let both = crossed.iter().flat_map(|&(i, j)| [(i, j), (j, i)]);
    both.flat_map(|(from, to)| between(from, to)).collect()
}

/// Chords of a closed polygon with a tree of boxes around them.
struct Chords<'a> {
    points: &'a [Point],
    /// Box of node `k`, whose halves are the nodes `2 k` and `2 k + 1`.
    boxes: Vec<Bounds>,
}

/// A run of chords: node of the tree, first chord, one after the last.
type Run = (usize, usize, usize);

impl<'a> Chords<'a> {
    fn new(points: &'a [Point]) -> Self {
        let mut tree = Self {
            points,
            boxes: vec![Bounds::EMPTY; 2 * points.len().next_power_of_two()],
        };
        tree.fill((1, 0, points.len()));
        tree
    }

    fn chord(&self, k: usize) -> [Point; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    fn halves((node, first, end): Run) -> [Run; 2] {
        let middle = first.midpoint(end);
        [(2 * node, first, middle), (2 * node + 1, middle, end)]
    }

    fn fill(&mut self, run: Run) -> Bounds {
        let (node, first, end) = run;
        let bounds = if end - first == 1 {
            self.chord(first).into_iter().collect()
        } else {
            let [low, high] = Self::halves(run);
            self.fill(low).union(self.fill(high))
        };
        self.boxes[node] = bounds;
        bounds
    }

    /// Pairs of chords that meet though their curves, within the tolerance of them, need not; chords that are rounding do not count.
    fn crossed(&self, tolerance: f64, rounding: f64) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        let whole = (1, 0, self.points.len());
        let mut pending = vec![(whole, whole)];
        while let Some((a, b)) = pending.pop() {
            crate::checkpoint();
            let length = |run: Run| run.2 - run.1;
            if a == b {
                if length(a) > 1 {
                    let [low, high] = Self::halves(a);
                    pending.extend([(low, low), (high, high), (low, high)]);
                }
            } else if self.boxes[a.0].meets(&self.boxes[b.0]) {
                if length(a) == 1 && length(b) == 1 {
                    if self.cross(a.1, b.1, tolerance, rounding) {
                        found.push((a.1, b.1));
                    }
                } else if length(a) >= length(b) {
                    pending.extend(Self::halves(a).map(|half| (half, b)));
                } else {
                    pending.extend(Self::halves(b).map(|half| (a, half)));
                }
            }
        }
        found
    }

    fn cross(&self, i: usize, j: usize, tolerance: f64, rounding: f64) -> bool {
        let count = self.points.len();
        let ([a, b], [p, q]) = (self.chord(i), self.chord(j));
        let (own, other) = (b - a, q - p);
        if own.norm() <= rounding && other.norm() <= rounding {
            return false;
        }
        if (i + 1) % count == j || (j + 1) % count == i {
            // Chords that follow each other meet where the second lies on the first.
            return own.perp(&other) == 0.0 && own.dot(&other) < 0.0;
        }
        let beside_own = [p, q].map(|point| own.perp(&(point - a)));
        let beside_other = [a, b].map(|point| other.perp(&(point - p)));
        let parts = |sides: [f64; 2]| sides[0] * sides[1] > 0.0;
        if parts(beside_own) || parts(beside_other) {
            return false;
        }
        // Ends this far beyond each other's chord: the curves cross as well.
        let far =
            |sides: [f64; 2], length: f64| sides.iter().all(|s| s.abs() > 2.0 * tolerance * length);
        !(far(beside_own, own.norm()) && far(beside_other, other.norm()))
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
                    .places(tolerance(mm))
                    .into_iter()
                    .map(|place| outline.point(place))
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
            let plain = outline.places(tolerance(mm)).len();
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
        // Two walls of one bend beside each other, the right one travelled downwards.
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
