//! Crossings of curves, by subdivision with tangent cones (Sederberg and Meyers, Loop detection in surface patch
//! intersections, CAGD 5, 1988).

use crate::{
    Point, Vector,
    curve::{Segment, SegmentJet},
    numeric::Tolerance,
};

/// Pairs of parts to compare for one pair of segments. A crossing, however flat, takes some hundreds; two strands that leave a cusp
/// in one direction take about 200 sqrt(K/D), where K is their curvature and D the difference of their curvatures. What takes more has no
/// end: the segments lie on each other.
const MOST_PAIRS: u32 = 200_000;

/// Part of one segment with the bounds that prove it apart from another.
struct Part<'a> {
    segment: &'a Segment,
    /// Bound of the third derivative over the whole segment.
    third: f64,
    from: f64,
    to: f64,
    start: Point,
    end: Point,
    middle: SegmentJet,
    /// Bound of the distance between any two points.
    size: f64,
    /// Least and greatest coordinates.
    bounds: [Point; 2],
    cone: Option<Cone>,
    /// Number of the first of both halves, once they are there.
    halves: Option<usize>,
}

/// Every tangent of a part: the middle one, and the cosine and sine of the half-angle around it.
#[derive(Clone, Copy)]
struct Cone {
    tangent: Vector,
    half: [f64; 2],
}

/// Parts of segments, each found once, whatever it is compared with.
struct Parts<'a>(Vec<Part<'a>>);

impl<'a> Part<'a> {
    fn new(
        segment: &'a Segment,
        third: f64,
        [from, to]: [f64; 2],
        [start, end]: [Point; 2],
    ) -> Self {
        let middle = segment.at(0.5 * (from + to));
        let length = to - from;
        let (quarter, rest) = (0.125 * length * length, 0.5 * third * length);
        let margin = middle.second.map(|s| quarter * (s.abs() + rest));
        let sagitta = quarter * (middle.second.norm() + rest);
        Self {
            segment,
            third,
            from,
            to,
            start,
            end,
            middle,
            size: (end - start).norm() + 2.0 * sagitta,
            bounds: [start.inf(&end) - margin, start.sup(&end) + margin],
            cone: Cone::new(&middle, 0.5 * length, third),
            halves: None,
        }
    }

    fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Whether the part is shorter than a length, or so short that it has no midpoint.
    fn is_shorter(&self, length: f64) -> bool {
        self.size < length || self.length() <= 4.0 * f64::EPSILON
    }

    /// Range of the part along an axis.
    fn along(&self, axis: &Vector) -> (f64, f64) {
        let [a, b] = [self.start, self.end].map(|p| axis.dot(&p.coords));
        let bend =
            axis.dot(&self.middle.second).abs() + 0.5 * self.third * self.length() * axis.norm();
        let margin = 0.125 * bend * self.length() * self.length();
        (a.min(b) - margin, a.max(b) + margin)
    }

    /// Whether an axis or the normal of a chord keeps the two parts apart.
    fn apart(&self, other: &Self) -> bool {
        let before = |one: &Self, two: &Self| {
            let (high, low) = (one.bounds[1], two.bounds[0]);
            high.x < low.x || high.y < low.y
        };
        let clear = |part: &Self| {
            let chord = part.end - part.start;
            let normal = Vector::new(-chord.y, chord.x);
            let (a, b) = (self.along(&normal), other.along(&normal));
            a.1 < b.0 || b.1 < a.0
        };
        before(self, other) || before(other, self) || clear(self) || clear(other)
    }
}

impl Cone {
    /// Tangents within `half` of the parameter at the middle; none where they may be of any direction.
    fn new(middle: &SegmentJet, half: f64, third: f64) -> Option<Self> {
        let size = middle.first.norm();
        let tangent = middle.first / size;
        // Along and across the tangent apart: near a cusp the speed changes fast and the direction does not.
        let rest = 0.5 * third * half * half;
        let along = size - half * tangent.dot(&middle.second).abs() - rest;
        let across = half * tangent.perp(&middle.second).abs() + rest;
        let sides = Vector::new(along, across);
        (along > 0.0).then(|| Self {
            tangent,
            half: (sides / sides.norm()).into(),
        })
    }

    /// Whether all tangents lie within less than half a turn.
    fn is_narrow(&self) -> bool {
        self.half[1] < WIDEST * self.half[0]
    }

    /// Cosine and sine of the sum of the half-angles, cosine and size of the sine of the angle between the middle tangents.
    fn with(&self, other: &Self) -> [[f64; 2]; 2] {
        let ([la, ca], [lb, cb]) = (self.half, other.half);
        let (one, two) = (&self.tangent, &other.tangent);
        [
            [la * lb - ca * cb, ca * lb + la * cb],
            [one.dot(two), one.perp(two).abs()],
        ]
    }

    /// Whether no tangent of one is parallel or opposed to one of the other.
    fn crosses(&self, other: &Self) -> bool {
        let [[cos, sin], [_, between]] = self.with(other);
        cos > 0.0 && between > sin
    }

    /// Whether no tangent of one is opposed to one of the other.
    fn goes_on(&self, other: &Self) -> bool {
        let [[cos, sin], [ahead, between]] = self.with(other);
        match (ahead >= 0.0, cos >= 0.0) {
            (true, true) => true,
            (true, false) => sin > between,
            (false, true) => between > sin,
            (false, false) => false,
        }
    }
}

/// Tangent of the half-angle, 86 degrees, below which a curve cannot come back to itself.
const WIDEST: f64 = 14.1;

impl<'a> Parts<'a> {
    fn new() -> Self {
        Self(Vec::with_capacity(16))
    }

    /// Adds a whole segment; its number.
    fn whole(&mut self, segment: &'a Segment) -> Result<usize, Unresolved> {
        let third = match segment {
            Segment::Line(..) => 0.0,
            Segment::Arc(arc) => (0.5 * arc.sweep().abs()).powi(3) * arc.radius(),
            Segment::Poly(poly) => poly
                .coefficients()
                .iter()
                .enumerate()
                .skip(3)
                .map(|(k, c)| (k * (k - 1) * (k - 2)) as f64 * c.norm())
                .sum(),
        };
        let ends = [segment.start(), segment.end()];
        let whole = Part::new(segment, third, [-1.0, 1.0], ends);
        if !whole.size.is_finite() {
            return Err(Unresolved::NotFinite);
        }
        self.0.push(whole);
        Ok(self.0.len() - 1)
    }

    /// Both halves of a part.
    fn halves(&mut self, number: usize) -> [usize; 2] {
        let next = self.0.len();
        let part = &mut self.0[number];
        let first = *part.halves.get_or_insert(next);
        if first == next {
            let (segment, third) = (part.segment, part.third);
            let u = 0.5 * (part.from + part.to);
            let (from, to, start, end) = (part.from, part.to, part.start, part.end);
            let middle = part.middle.point;
            self.0
                .push(Part::new(segment, third, [from, u], [start, middle]));
            self.0
                .push(Part::new(segment, third, [u, to], [middle, end]));
        }
        [first, first + 1]
    }
}

/// Error of curves whose crossings cannot be determined.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unresolved {
    /// A coordinate of a curve is not a number.
    #[error("a coordinate is not a number")]
    NotFinite,
    /// Curves that coincide, within the tolerance, over a length.
    #[error("two parts lie on each other about ({:.6}, {:.6}) mm", .near.x, .near.y)]
    Overlap {
        /// A point of the overlap, mm.
        near: Point,
    },
}

/// Parameters at which two segments cross; `joined` says that `b` starts where `a` ends, which is then not a
/// crossing.
///
/// Parts are halved until their bounding boxes part or their tangent cones do; a crossing is then
/// polished by Newton's method. Parts smaller than `tolerance` are taken to touch, not to cross.
///
/// # Errors
/// [`Unresolved`] where the segments lie on each other or a coordinate is not a number.
pub fn crossings(
    a: &Segment,
    b: &Segment,
    joined: bool,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, Unresolved> {
    let mut parts = Parts::new();
    let both = [parts.whole(a)?, parts.whole(b)?];
    let mut out = Vec::new();
    search(&mut parts, both, joined, tolerance.mm(), &mut out)?;
    Ok(out)
}

/// Parameters at which a segment crosses itself.
///
/// # Errors
/// [`Unresolved`] where it lies on itself or a coordinate is not a number.
pub fn self_crossings(
    segment: &Segment,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, Unresolved> {
    let mut out = Vec::new();
    let shortest = tolerance.mm();
    let mut parts = Parts::new();
    // A smooth curve is cut a few times, one with a cusp once a level.
    let mut pending = vec![parts.whole(segment)?];
    while let Some(number) = pending.pop() {
        crate::checkpoint();
        let part = &parts.0[number];
        // A curve whose tangents fit in half a turn cannot come back to itself.
        if part.cone.is_some_and(|cone| cone.is_narrow()) || part.is_shorter(shortest) {
            continue;
        }
        let halves = parts.halves(number);
        pending.extend(halves);
        search(&mut parts, halves, true, shortest, &mut out)?;
    }
    Ok(out)
}

fn search(
    parts: &mut Parts<'_>,
    [a, b]: [usize; 2],
    joined: bool,
    shortest: f64,
    out: &mut Vec<(f64, f64)>,
) -> Result<(), Unresolved> {
    let mut near = parts.0[a].end;
    let mut pending = vec![(a, b, joined)];
    for _ in 0..MOST_PAIRS {
        crate::checkpoint();
        let Some((first, second, joined)) = pending.pop() else {
            return Ok(());
        };
        let (a, b) = (&parts.0[first], &parts.0[second]);
        near = a.middle.point;
        if !joined && a.apart(b) {
            continue;
        }
        if let (Some(one), Some(two)) = (&a.cone, &b.cone) {
            if joined {
                if one.goes_on(two) {
                    continue;
                }
            } else if one.crosses(two) {
                // Neither parallel nor opposed anywhere: at most one crossing. Newton's method that leads
                // elsewhere does not prove that there is none.
                if let Some(found) = polish(a, b) {
                    let mut known = out.iter();
                    if !known.any(|&known| is_same(a, b, known, found, shortest)) {
                        out.push(found);
                    }
                    continue;
                }
            }
        }
        if a.is_shorter(shortest) && b.is_shorter(shortest) {
            continue;
        }
        let is_first = a.size >= b.size;
        if joined {
            let [a0, a1] = parts.halves(first);
            let [b0, b1] = parts.halves(second);
            // The joint last: parts nearest to it are least likely to cross.
            pending.push((a1, b0, true));
            pending.push((a0, b0, false));
            pending.push((a1, b1, false));
            pending.push((a0, b1, false));
        } else if is_first {
            pending.extend(parts.halves(first).map(|half| (half, second, false)));
        } else {
            pending.extend(parts.halves(second).map(|half| (first, half, false)));
        }
    }
    Err(Unresolved::Overlap { near })
}

/// Whether two crossings are one, found from parts beside each other.
///
/// Strands that cross twice cross opposite ways, so two crossings of one sense with no length between them are one. Near a
/// cusp the parameters of one place differ by the root of the rounding, and more; a place is told within [`miss`] on either strand.
fn is_same(
    a: &Part<'_>,
    b: &Part<'_>,
    known: (f64, f64),
    found: (f64, f64),
    shortest: f64,
) -> bool {
    let near = |part: &Part<'_>, x: f64, y: f64| {
        let at = |u: f64| part.segment.at(u).point;
        let (from, to, middle) = (at(x), at(y), at(0.5 * (x + y)));
        let apart = (middle - from).norm() + (to - middle).norm();
        let speed = part.segment.at(x).first.norm();
        (x - y).abs() < 1e-7 || apart < shortest + 2.0 * miss(part, speed)
    };
    let rises = |(u, v): (f64, f64)| a.segment.at(u).first.perp(&b.segment.at(v).first) > 0.0;
    near(a, known.0, found.0) && near(b, known.1, found.1) && rises(known) == rises(found)
}

/// Distance, mm, by which the places of a crossing on two strands may miss each other for their rounding.
fn miss(part: &Part<'_>, speed: f64) -> f64 {
    1e-11 * (speed + part.start.coords.amax())
}

/// Newton's method on the two parameters, kept to the parts and a rounding beyond.
fn polish(a: &Part<'_>, b: &Part<'_>) -> Option<(f64, f64)> {
    let (mut u, mut v) = (0.5 * (a.from + a.to), 0.5 * (b.from + b.to));
    for _ in 0..50 {
        let (p, q) = (a.segment.at(u), b.segment.at(v));
        let gap = q.point - p.point;
        let area = p.first.perp(&q.first);
        let (du, dv) = (gap.perp(&q.first) / area, gap.perp(&p.first) / area);
        if !(du.is_finite() && dv.is_finite()) {
            return None;
        }
        // Half a part outside is as far as a straight-line guess may stray.
        let before = (u, v);
        u = (u + du).clamp(a.from - 0.5 * a.length(), a.to + 0.5 * a.length());
        v = (v + dv).clamp(b.from - 0.5 * b.length(), b.to + 0.5 * b.length());
        if (u, v) == before || (du.abs() < 1e-15 && dv.abs() < 1e-15) {
            break;
        }
    }
    let gap = (b.segment.at(v).point - a.segment.at(u).point).norm();
    let speed = a.segment.at(u).first.norm();
    let size = speed.max(b.segment.at(v).first.norm());
    let inside = |x: f64, part: &Part<'_>| x >= part.from - 1e-12 && x <= part.to + 1e-12;
    let hit = gap <= miss(a, size) && inside(u, a) && inside(v, b);
    hit.then(|| (u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)))
}

#[cfg(test)]
mod tests;
