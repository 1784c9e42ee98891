use crate::{Bounds, Outline, Point, piece::Piece};
use std::f64::consts::PI;

/// Point at which a contour meets itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Position, mm.
    pub point: Point,
    /// The two segments that meet, the lower index first.
    pub segments: [usize; 2],
}

/// Share of the outline's size below which two parts count as touching.
const TOUCH: f64 = 1e-12;

/// Piece with its end points and an axis-aligned box around it.
#[derive(Clone, Copy, Debug)]
struct Strand {
    piece: Piece,
    start: Point,
    end: Point,
    sagitta: f64,
}

impl Strand {
    fn new(outline: &Outline, piece: Piece) -> Self {
        let at = |u| {
            outline.point(crate::piece::Place {
                segment: piece.segment,
                u,
            })
        };
        Self {
            start: at(piece.u0),
            end: at(piece.u1),
            sagitta: piece.sagitta(),
            piece,
        }
    }

    fn bounds(&self) -> Bounds {
        let ends = Bounds::EMPTY.with(self.start).with(self.end);
        let margin = crate::Vector::repeat(self.sagitta);
        Bounds {
            min: ends.min - margin,
            max: ends.max + margin,
        }
    }

    fn halves(&self, outline: &Outline) -> [Self; 2] {
        let segment = &outline.segments()[self.piece.segment];
        let [first, second] = self.piece.halves(segment);
        let middle = segment.at(first.u1).point;
        [
            Self {
                piece: first,
                end: middle,
                sagitta: first.sagitta(),
                ..*self
            },
            Self {
                piece: second,
                start: middle,
                sagitta: second.sagitta(),
                ..*self
            },
        ]
    }
}

impl Outline {
    /// Point where the contour crosses or touches itself, or `None` if it is simple.
    ///
    /// Decided on the exact segments with proven bounds, not on a polygon in their place: parts that
    /// come closer than 1e-12 of the outline's size count as touching.
    #[must_use]
    pub fn crossing(&self) -> Option<Crossing> {
        let strands = self.strands();
        let bounds: Bounds = strands.iter().map(|s| s.start).collect();
        let size = bounds.diagonal();
        let search = Search {
            outline: self,
            touch: TOUCH * size,
        };
        let strands: Vec<Strand> = strands
            .into_iter()
            .filter(|s| s.piece.length > search.touch)
            .collect();
        let n = strands.len();
        let jumps = self.jumps();
        for (i, strand) in strands.iter().enumerate() {
            let next = &strands[(i + 1) % n];
            let jump = if next.piece.u0 == -1.0 {
                jumps[next.piece.segment]
            } else {
                0.0
            };
            if let Some(found) = search.neighbours(strand, next, jump) {
                return Some(found);
            }
        }
        // Sweep from left to right over the boxes.
        let boxes: Vec<Bounds> = strands.iter().map(Strand::bounds).collect();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x).then(a.cmp(&b)));
        let mut active: Vec<usize> = Vec::new();
        for &i in &order {
            crate::checkpoint();
            active.retain(|&j| boxes[j].max.x >= boxes[i].min.x);
            for &j in &active {
                let apart = boxes[j].min.y > boxes[i].max.y || boxes[i].min.y > boxes[j].max.y;
                let adjacent = (i + 1) % n == j || (j + 1) % n == i;
                if apart || adjacent {
                    continue;
                }
                if let Some(found) = search.pair(&strands[i.min(j)], &strands[i.max(j)]) {
                    return Some(found);
                }
            }
            active.push(i);
        }
        None
    }

    /// Splits the segments into pieces that turn by less than half a radian, at least four.
    fn strands(&self) -> Vec<Strand> {
        let least_depth = if self.segments().len() < 4 { 2 } else { 0 };
        let mut out = Vec::with_capacity(self.segments().len());
        let mut stack = Vec::new();
        for (index, segment) in self.segments().iter().enumerate() {
            stack.push((Piece::new(segment, index, -1.0, 1.0), 0));
            while let Some((piece, depth)) = stack.pop() {
                // A cusp turns at once, however short: it stays one strand, with bounds as true as any other's.
                if depth < least_depth || (piece.turning() > 0.5 && depth < 24) {
                    let [first, second] = piece.halves(segment);
                    stack.push((second, depth + 1));
                    stack.push((first, depth + 1));
                } else {
                    out.push(Strand::new(self, piece));
                }
            }
        }
        out
    }
}

struct Search<'a> {
    outline: &'a Outline,
    /// Distance below which parts touch, mm.
    touch: f64,
}

impl Search<'_> {
    fn found(&self, a: &Strand, b: &Strand) -> Crossing {
        let (i, j) = (a.piece.segment, b.piece.segment);
        // Where the chords cross; they are as good as the curves by now.
        let (u, v) = (a.end - a.start, b.end - b.start);
        let share = (b.start - a.start).perp(&v) / u.perp(&v);
        let share = if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.5
        };
        Crossing {
            point: a.start + u * share,
            segments: [i.min(j), i.max(j)],
        }
    }

    /// Whether two strands that share no end meet.
    fn pair(&self, a: &Strand, b: &Strand) -> Option<Crossing> {
        let mut stack = vec![(*a, *b)];
        while let Some((a, b)) = stack.pop() {
            crate::checkpoint();
            let slack = a.sagitta + b.sagitta;
            // Either proof, apart or touching, is found by halving: a bound shrinks with its part.
            if gap(&a, &b) > slack + self.touch {
                continue;
            }
            if slack <= self.touch {
                return Some(self.found(&a, &b));
            }
            if a.sagitta >= b.sagitta {
                let [first, second] = a.halves(self.outline);
                stack.push((second, b));
                stack.push((first, b));
            } else {
                let [first, second] = b.halves(self.outline);
                stack.push((a, second));
                stack.push((a, first));
            }
        }
        None
    }

    /// Whether two strands of which the second starts at the end of the first meet anywhere else.
    fn neighbours(&self, a: &Strand, b: &Strand, jump: f64) -> Option<Crossing> {
        let (mut a, mut b) = (*a, *b);
        // A curve that turns by less than a half turn in all cannot meet itself.
        while a.piece.turning() + b.piece.turning() + jump >= PI {
            crate::checkpoint();
            if a.piece.length + b.piece.length <= self.touch.max(f64::MIN_POSITIVE) {
                // A cusp within the rounding of its own end is a doubled point, not an overlap, unless
                // it folds back onto itself.
                return (jump >= PI - 1e-9).then(|| self.found(&a, &b));
            }
            let [a0, a1] = a.halves(self.outline);
            let [b0, b1] = b.halves(self.outline);
            for (p, q) in [(&a0, &b0), (&a0, &b1), (&a1, &b1)] {
                if let Some(found) = self.pair(p, q) {
                    return Some(found);
                }
            }
            (a, b) = (a1, b0);
        }
        None
    }
}

/// Distance between two chords.
fn gap(a: &Strand, b: &Strand) -> f64 {
    let side = |s: &Strand, p: Point| (s.end - s.start).perp(&(p - s.start));
    if side(a, b.start) * side(a, b.end) < 0.0 && side(b, a.start) * side(b, a.end) < 0.0 {
        return 0.0;
    }
    let to_chord = |p: Point, s: &Strand| {
        let chord = s.end - s.start;
        let t = (chord.dot(&(p - s.start)) / chord.norm_squared()).clamp(0.0, 1.0);
        let t = if t.is_nan() { 0.0 } else { t };
        (s.start + chord * t - p).norm()
    };
    to_chord(b.start, a)
        .min(to_chord(b.end, a))
        .min(to_chord(a.start, b))
        .min(to_chord(a.end, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Arc, PolySegment, Segment, Tolerance, Vector,
        shapes::{rosette, tooth_ring},
    };

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    fn pinned(curve: impl FnMut(f64) -> Point, t1: f64) -> Outline {
        let mut polys = PolySegment::fit(curve, 0.0, t1, tolerance(1e-9));
        let first = polys[0].start();
        if let Some(last) = polys.last_mut() {
            *last = last.pinned(last.start(), first);
        }
        Outline::new(polys.into_iter().map(Segment::from).collect()).expect("closed")
    }

    #[test]
    fn simple_outlines_are_simple_at_every_scale() {
        let ring = tooth_ring(23, 2.25, tolerance(1e-10));
        for outline in [
            rosette(20.0, 3.0, 7, tolerance(1e-9)),
            ring.arcs(tolerance(1e-3)),
            ring.scaled(1e-4),
            ring.scaled(1e4),
            ring,
            Outline::circle(Point::origin(), 3.0),
        ] {
            assert_eq!(outline.crossing(), None);
        }
    }

    #[test]
    fn a_limacon_crosses_at_its_node_only_with_an_inner_loop() {
        let limacon = |b: f64| {
            pinned(
                move |t| Point::from(Vector::new(t.cos(), t.sin()) * (10.0 * (b + t.cos()))),
                std::f64::consts::TAU,
            )
        };
        let crossing = limacon(0.8).crossing().expect("inner loop");
        assert!(crossing.point.coords.norm() < 1e-7, "{crossing:?}");
        assert_eq!(limacon(1.001).crossing(), None);
    }

    #[test]
    fn a_gap_a_billionth_wide_is_no_crossing_and_an_overlap_is() {
        // A slot whose bulging sides nearly meet in the middle.
        let slot = |gap: f64| {
            let p = Point::new;
            let line = Segment::Line;
            let (depth, half) = (1.0, 5.0);
            let bulge = 2.0 * depth / (2.0 * half);
            let low = p(0.0, -depth - 0.5 * gap);
            let high = p(0.0, depth + 0.5 * gap);
            let arc = |start: Point, end: Point| Segment::Arc(Arc { start, end, bulge });
            let (a, b) = (p(10.0, low.y), p(10.0, high.y));
            let (e, f) = (p(0.0, 8.0), p(0.0, -8.0));
            Outline::new(vec![
                line(f, p(30.0, -8.0)),
                line(p(30.0, -8.0), p(30.0, 8.0)),
                line(p(30.0, 8.0), e),
                line(e, high),
                arc(high, b),
                line(b, a),
                arc(a, low),
                line(low, f),
            ])
            .expect("closed")
        };
        // The sides bulge towards one another by exactly the sagitta.
        assert_eq!(slot(4.0).crossing(), None);
        let closing = |gap: f64| {
            let outline = slot(gap);
            outline.crossing().is_some()
        };
        assert!(!closing(1e-7));
        assert!(closing(-1e-7) && closing(0.0));
    }

    #[test]
    fn polygons_that_touch_cross_or_fold_are_found() {
        let p = Point::new;
        let eight = Outline::polygon(&[p(0.0, 0.0), p(4.0, 4.0), p(4.0, 0.0), p(0.0, 4.0)]);
        let found = eight.crossing().expect("crosses");
        assert!((found.point - p(2.0, 2.0)).norm() < 1e-12 && found.segments == [0, 2]);
        let touching = [
            p(0.0, 0.0),
            p(4.0, 0.0),
            p(4.0, 4.0),
            p(2.0, 0.0),
            p(0.0, 4.0),
        ];
        assert!(Outline::polygon(&touching).crossing().is_some());
        let folded = [p(0.0, 0.0), p(4.0, 0.0), p(2.0, 0.0), p(2.0, 4.0)];
        assert!(Outline::polygon(&folded).crossing().is_some());
        let sharp = [p(0.0, 0.0), p(4.0, 0.0), p(0.0, 1e-6)];
        assert_eq!(Outline::polygon(&sharp).crossing(), None);
    }
}
