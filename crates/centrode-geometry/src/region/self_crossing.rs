use crate::{
    Point,
    curve::{Bounds, Piece},
    numeric::bracketed_root,
    region::{Outline, Position},
};
use std::f64::consts::PI;

/// Point at which a contour meets itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Position, mm.
    pub point: Point,
    /// The two segments that meet, the lower index first.
    pub segments: [usize; 2],
}

/// Fraction of the size of the outline below which two parts count as touching. Ten times smaller approaches rounding; ten
/// times larger refuses outlines with narrow gaps.
const TOUCH: f64 = 1e-12;

/// Tangent jump, rad, from which an outline counts as turning back at a joint: a little less than pi.
const FOLD: f64 = 3.0;

/// Fraction of the size of the outline that is rounding. Ten times smaller, rounding reports crossings at cusps; ten times
/// larger misses crossings near them.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Piece with its end points and its sagitta, which give a box around it.
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
            outline.point(Position {
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
    /// The test uses the exact segments with proven bounds, not a polygon. Parts closer than 1e-12 of the size of the outline
    /// count as touching. Two parts that leave a joint in one direction touch unless they separate to one side, judged by
    /// their distances ever nearer to the joint.
    #[must_use]
    pub fn crossing(&self) -> Option<Crossing> {
        self.crossing_ignoring(0.0, 0.0)
    }

    /// Like [`crossing`](Self::crossing), but ignores small loops and narrow overlaps.
    ///
    /// It ignores loops smaller than `loop_size`, mm, in a segment or at its ends, and overlaps at the end of a cusp that are
    /// narrower than `band`, mm.
    #[must_use]
    pub fn crossing_ignoring(&self, loop_size: f64, band: f64) -> Option<Crossing> {
        let strands = self.strands();
        let bounds: Bounds = strands.iter().map(|s| s.start).collect();
        let size = bounds.diagonal();
        let search = Search {
            outline: self,
            touch: TOUCH * size,
            rounding: ROUNDING * size,
            loop_size,
            band,
        };
        let strands: Vec<Strand> = strands
            .into_iter()
            .filter(|s| s.piece.length > search.touch)
            .collect();
        let n = strands.len();
        let jumps = self.tangent_jumps();
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

    /// Splits the segments into pieces that turn by less than half a radian, four or more.
    fn strands(&self) -> Vec<Strand> {
        let min_depth = if self.segments().len() < 4 { 2 } else { 0 };
        let mut out = Vec::with_capacity(self.segments().len());
        let mut stack = Vec::new();
        for (index, segment) in self.segments().iter().enumerate() {
            stack.push((Piece::new(segment, index, -1.0, 1.0), 0));
            while let Some((piece, depth)) = stack.pop() {
                // A cusp turns at one point, however short the piece: it remains one strand, and its bounds are valid.
                if depth < min_depth || (piece.turning() > 0.5 && depth < 24) {
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

/// Search for a crossing of an outline.
struct Search<'a> {
    outline: &'a Outline,
    /// Distance below which parts touch, mm.
    touch: f64,
    /// Distance, mm, below which rounding hides on which side a point is.
    rounding: f64,
    /// Size, mm, below which a loop in a segment or at its ends is ignored.
    loop_size: f64,
    /// Width, mm, by which two strands at a cusp may overlap.
    band: f64,
}

impl Search<'_> {
    /// The crossing of two short strands.
    fn crossing_of(&self, a: &Strand, b: &Strand) -> Crossing {
        let (i, j) = (a.piece.segment, b.piece.segment);
        // The crossing of the chords: at this size they are as exact as the curves.
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

    /// Whether the loop at a crossing is smaller than `loop_size`: in one segment, or between the ends of two.
    fn is_below_size(&self, a: &Strand, b: &Strand, found: &Crossing) -> bool {
        let (segments, [one, other]) = (self.outline.segments(), found.segments);
        let near = |point: Point| (found.point - point).norm() < self.loop_size;
        let within = |segment: usize, from: f64, to: f64| {
            segments[segment].stays_near(found.point, self.loop_size, from, to)
        };
        if one == other {
            // A loop, or the blunt end of a cusp, made by rounding.
            let (from, to) = (a.piece.u0.min(b.piece.u0), a.piece.u1.max(b.piece.u1));
            return within(one, from, to);
        }
        // Between the two there may be very short segments of a cusp.
        let between = |from: usize, to: usize| {
            let next = |i: &usize| Some((i + 1) % segments.len());
            let mut path = std::iter::successors(next(&from), next).take_while(|&i| i != to);
            path.all(|i| within(i, -1.0, 1.0)) && near(segments[to].start())
        };
        between(one, other) || between(other, one)
    }

    /// Whether two strands, the second of which turns back at the end of the first, separate to one side over their length.
    fn separate(&self, a: &Strand, b: &Strand) -> bool {
        let joint = a.end;
        let along = -self.outline.segments()[a.piece.segment].tangent(a.piece.u1);
        let lengths = [a.start, b.end].map(|end| along.dot(&(end - joint)));
        let shorter = lengths[0].min(lengths[1]) * (1.0 - 1e-9);
        // Offset of a strand from the direction `along`, at a distance from the joint.
        let offset = |strand: &Strand, s: f64| {
            let segment = &self.outline.segments()[strand.piece.segment];
            let from_joint = |u: f64| segment.at(u).point - joint;
            let ahead = |u: f64| along.dot(&from_joint(u)) - s;
            let (u0, u1) = (strand.piece.u0, strand.piece.u1);
            let u = bracketed_root(ahead, u0, u1, ahead(u0), ahead(u1));
            along.perp(&from_joint(u))
        };
        let distances = std::iter::successors(Some(shorter), |s| Some(0.8 * s));
        let mut gaps = distances
            .map(|s| (s, offset(b, s) - offset(a, s)))
            .take_while(|(s, _)| *s > self.rounding);
        let (mut side, close) = (0.0, self.rounding.max(self.band));
        for (s, gap) in gaps.by_ref() {
            if gap.abs() <= close {
                // Strands that stay within rounding over a long distance lie on each other.
                let mut rest = || self.band > 0.0 && gaps.all(|(_, gap)| gap.abs() <= close);
                return side != 0.0 && (s < 1e-2 * shorter || rest());
            }
            if side * gap < 0.0 {
                return false;
            }
            side = gap;
        }
        side != 0.0 && self.rounding < 1e-2 * shorter
    }

    /// Crossing of two strands that share no end.
    fn pair(&self, a: &Strand, b: &Strand) -> Option<Crossing> {
        let mut stack = vec![(*a, *b)];
        while let Some((a, b)) = stack.pop() {
            crate::checkpoint();
            let slack = a.sagitta + b.sagitta;
            // Halving ends in a proof of either case: the bounds shrink with the parts.
            if gap(&a, &b) > slack + self.touch {
                continue;
            }
            if slack <= self.touch {
                let found = self.crossing_of(&a, &b);
                if self.is_below_size(&a, &b, &found) {
                    continue;
                }
                return Some(found);
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

    /// Crossing of two consecutive strands, other than their shared end point.
    fn neighbours(&self, a: &Strand, b: &Strand, jump: f64) -> Option<Crossing> {
        if jump > FOLD && self.separate(a, b) {
            return None;
        }
        let (mut a, mut b) = (*a, *b);
        // A curve that turns by less than half a turn in total cannot meet itself.
        while a.piece.turning() + b.piece.turning() + jump >= PI {
            crate::checkpoint();
            if a.piece.length + b.piece.length <= self.touch.max(f64::MIN_POSITIVE) {
                // A cusp within the rounding of its end is a double point, not an overlap, unless it folds back onto
                // itself.
                let found = self.crossing_of(&a, &b);
                return (jump >= PI - 1e-9 && !self.is_below_size(&a, &b, &found)).then_some(found);
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
mod tests;
