use crate::{
    Point,
    curve::{Bounds, Piece},
    numeric::bracketed_root,
    region::Outline,
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

/// Share of the outline's size below which two parts count as touching.
const TOUCH: f64 = 1e-12;

/// Tangent jump, rad, from which an outline turns back at a joint.
const FOLD: f64 = 3.0;

/// Share of the outline's size that is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

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
            outline.point(crate::region::Place {
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
    /// come closer than 1e-12 of the outline's size count as touching. Two that leave a joint in one direction touch
    /// unless they part from it to one side, which is told by their distances ever nearer to the joint.
    #[must_use]
    pub fn crossing(&self) -> Option<Crossing> {
        self.crossing_beyond(0.0, 0.0)
    }

    /// [`crossing`](Self::crossing), where loops smaller than a distance, mm, are let pass in a segment and at its ends,
    /// and those at the blunt end of a cusp that are thinner than another, mm.
    #[must_use]
    pub fn crossing_beyond(&self, speck: f64, thin: f64) -> Option<Crossing> {
        let strands = self.strands();
        let bounds: Bounds = strands.iter().map(|s| s.start).collect();
        let size = bounds.diagonal();
        let search = Search {
            outline: self,
            touch: TOUCH * size,
            rounding: ROUNDING * size,
            speck,
            thin,
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
    /// Distance below which rounding does not tell one side from the other, mm.
    rounding: f64,
    /// Size, mm, of a loop in a segment or at its ends that is let pass.
    speck: f64,
    /// Distance, mm, that two strands at a cusp may lie over each other.
    thin: f64,
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

    /// Whether what a crossing cuts off is small: a loop in one segment, or from the end of one to the start of another.
    fn is_speck(&self, a: &Strand, b: &Strand, found: &Crossing) -> bool {
        let (segments, [one, other]) = (self.outline.segments(), found.segments);
        let near = |point: Point| (found.point - point).norm() < self.speck;
        let within = |segment: usize, from: f64, to: f64| {
            segments[segment].keeps_near(found.point, self.speck, from, to)
        };
        if one == other {
            // Rounding makes a loop or a blunt end of a cusp.
            let (from, to) = (a.piece.u0.min(b.piece.u0), a.piece.u1.max(b.piece.u1));
            return within(one, from, to);
        }
        // What lies between the two may be a cusp's segments of no length to speak of.
        let between = |from: usize, to: usize| {
            let next = |i: &usize| Some((i + 1) % segments.len());
            let mut way = std::iter::successors(next(&from), next).take_while(|&i| i != to);
            way.all(|i| within(i, -1.0, 1.0)) && near(segments[to].start())
        };
        between(one, other) || between(other, one)
    }

    /// Whether two strands, of which the second goes back from the end of the first, part to one side all the way.
    fn part(&self, a: &Strand, b: &Strand) -> bool {
        let joint = a.end;
        let along = -self.outline.segments()[a.piece.segment].tangent(a.piece.u1);
        let least = [a.start, b.end].map(|end| along.dot(&(end - joint)));
        let least = least[0].min(least[1]) * (1.0 - 1e-9);
        // How far a strand is aside of the direction at a distance along it.
        let aside = |strand: &Strand, s: f64| {
            let segment = &self.outline.segments()[strand.piece.segment];
            let way = |u: f64| segment.at(u).point - joint;
            let ahead = |u: f64| along.dot(&way(u)) - s;
            let (u0, u1) = (strand.piece.u0, strand.piece.u1);
            let u = bracketed_root(ahead, u0, u1, ahead(u0), ahead(u1));
            along.perp(&way(u))
        };
        let places = std::iter::successors(Some(least), |s| Some(0.8 * s));
        let mut gaps = places
            .map(|s| (s, aside(b, s) - aside(a, s)))
            .take_while(|(s, _)| *s > self.rounding);
        let (mut side, close) = (0.0, self.rounding.max(self.thin));
        for (s, gap) in gaps.by_ref() {
            if gap.abs() <= close {
                // They lie on each other where they part by no more than rounding for long.
                let mut rest = || self.thin > 0.0 && gaps.all(|(_, gap)| gap.abs() <= close);
                return side != 0.0 && (s < 1e-2 * least || rest());
            }
            if side * gap < 0.0 {
                return false;
            }
            side = gap;
        }
        side != 0.0 && self.rounding < 1e-2 * least
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
                let found = self.found(&a, &b);
                if self.is_speck(&a, &b, &found) {
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

    /// Whether two strands of which the second starts at the end of the first meet anywhere else.
    fn neighbours(&self, a: &Strand, b: &Strand, jump: f64) -> Option<Crossing> {
        if jump > FOLD && self.part(a, b) {
            return None;
        }
        let (mut a, mut b) = (*a, *b);
        // A curve that turns by less than a half turn in all cannot meet itself.
        while a.piece.turning() + b.piece.turning() + jump >= PI {
            crate::checkpoint();
            if a.piece.length + b.piece.length <= self.touch.max(f64::MIN_POSITIVE) {
                // A cusp within the rounding of its own end is a doubled point, not an overlap, unless
                // it folds back onto itself.
                let found = self.found(&a, &b);
                return (jump >= PI - 1e-9 && !self.is_speck(&a, &b, &found)).then_some(found);
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
