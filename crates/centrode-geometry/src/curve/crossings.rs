//! Crossings of two segments, by subdivision with tangent cones.
//!
//! Source: Sederberg and Meyers, Loop detection in surface patch intersections, CAGD 5, 1988.

use crate::{
    Point, Vector,
    curve::{Segment, SegmentJet},
    numeric::Tolerance,
};

/// Maximum number of pairs of parts compared for one pair of segments.
///
/// A flat crossing takes some hundreds. Two strands that leave a cusp in one direction take about `200 sqrt(K / D)`, with
/// their curvature `K` and the difference `D` of their curvatures. Segments that need more lie on each other: with a tenth,
/// some strands at a cusp count as such; ten times more only delays the error.
const MAX_PAIRS: u32 = 200_000;

/// Part of one segment, with the bounds that prove it separate from another part.
struct Part<'a> {
    segment: &'a Segment,
    /// Upper bound of the third derivative over the whole segment.
    third: f64,
    from: f64,
    to: f64,
    start: Point,
    end: Point,
    middle: SegmentJet,
    /// Upper bound of the distance between any two of its points, mm.
    size: f64,
    /// Minimum and maximum coordinates.
    bounds: [Point; 2],
    cone: Option<Cone>,
    /// Index of the first of its two halves, once they exist.
    halves: Option<usize>,
}

/// Cone that contains every tangent of a part.
#[derive(Clone, Copy)]
struct Cone {
    /// Unit tangent in the middle.
    tangent: Vector,
    /// Cosine and sine of the half-angle.
    half: [f64; 2],
}

/// Cosine and sine of the sum of the half-angles of two cones, and of the angle between their middle tangents.
struct ConeAngles {
    sum_cos: f64,
    sum_sin: f64,
    between_cos: f64,
    /// Without its sign.
    between_sin: f64,
}

/// All parts made so far, so that each is made only once.
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

    /// Minimum and maximum coordinate of the part along an axis.
    fn along(&self, axis: &Vector) -> (f64, f64) {
        let [a, b] = [self.start, self.end].map(|p| axis.dot(&p.coords));
        let bend =
            axis.dot(&self.middle.second).abs() + 0.5 * self.third * self.length() * axis.norm();
        let margin = 0.125 * bend * self.length() * self.length();
        (a.min(b) - margin, a.max(b) + margin)
    }

    /// Whether an axis or the normal of a chord separates the two parts.
    fn is_separate(&self, other: &Self) -> bool {
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
    /// Tangents within `half` of the parameter in the middle; `None` if they may have any direction.
    fn new(middle: &SegmentJet, half: f64, third: f64) -> Option<Self> {
        let size = middle.first.norm();
        let tangent = middle.first / size;
        // Along and across the tangent separately: near a cusp the speed changes fast, the direction does not.
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
        self.half[1] < MAX_HALF_ANGLE_TAN * self.half[0]
    }

    /// Angles of two cones that decide whether their tangents can be parallel or opposite.
    fn with(&self, other: &Self) -> ConeAngles {
        let ([la, ca], [lb, cb]) = (self.half, other.half);
        let (one, two) = (&self.tangent, &other.tangent);
        ConeAngles {
            sum_cos: la * lb - ca * cb,
            sum_sin: ca * lb + la * cb,
            between_cos: one.dot(two),
            between_sin: one.perp(two).abs(),
        }
    }

    /// Whether no tangent of one cone is parallel or opposite to a tangent of the other.
    fn crosses(&self, other: &Self) -> bool {
        let angles = self.with(other);
        angles.sum_cos > 0.0 && angles.between_sin > angles.sum_sin
    }

    /// Whether no tangent of one cone is opposite to a tangent of the other.
    fn continues_into(&self, other: &Self) -> bool {
        let angles = self.with(other);
        let (sin, between) = (angles.sum_sin, angles.between_sin);
        match (angles.between_cos >= 0.0, angles.sum_cos >= 0.0) {
            (true, true) => true,
            (true, false) => sin > between,
            (false, true) => between > sin,
            (false, false) => false,
        }
    }
}

/// Tangent of the half-angle, 86 deg, below which a curve cannot return to itself. It is a little less than 90 deg, for
/// rounding; 10 times larger would leave 0.4 deg for it.
const MAX_HALF_ANGLE_TAN: f64 = 14.1;

impl<'a> Parts<'a> {
    fn new() -> Self {
        Self(Vec::with_capacity(16))
    }

    /// Adds a whole segment and returns its index.
    fn whole(&mut self, segment: &'a Segment) -> Result<usize, CrossingError> {
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
            return Err(CrossingError::NotFinite);
        }
        self.0.push(whole);
        Ok(self.0.len() - 1)
    }

    /// Indices of the two halves of a part.
    fn halves(&mut self, index: usize) -> [usize; 2] {
        let next = self.0.len();
        let part = &mut self.0[index];
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

/// Curves whose crossings cannot be determined.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CrossingError {
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

/// Parameters, on `a` and on `b`, at which two segments cross.
///
/// If `joined` is true, `b` starts at the end of `a`; this point is then not a crossing. Parts are halved until their
/// bounding boxes or their tangent cones separate; Newton's method refines a crossing. Parts smaller than `tolerance`
/// count as touching, not as crossing.
///
/// # Errors
/// [`CrossingError`] if the segments lie on each other or a coordinate is not a number.
pub fn crossings(
    a: &Segment,
    b: &Segment,
    joined: bool,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, CrossingError> {
    let mut parts = Parts::new();
    let both = [parts.whole(a)?, parts.whole(b)?];
    let mut out = Vec::new();
    search(&mut parts, both, joined, tolerance.mm(), &mut out)?;
    Ok(out)
}

/// Pairs of parameters at which a segment crosses itself.
///
/// # Errors
/// [`CrossingError`] if it lies on itself or a coordinate is not a number.
pub fn self_crossings(
    segment: &Segment,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, CrossingError> {
    let mut out = Vec::new();
    let shortest = tolerance.mm();
    let mut parts = Parts::new();
    // A smooth curve is cut a few times, a curve with a cusp once per level.
    let mut pending = vec![parts.whole(segment)?];
    while let Some(index) = pending.pop() {
        crate::checkpoint();
        let part = &parts.0[index];
        // A curve whose tangents fit in half a turn cannot return to itself.
        if part.cone.is_some_and(|cone| cone.is_narrow()) || part.is_shorter(shortest) {
            continue;
        }
        let halves = parts.halves(index);
        pending.extend(halves);
        search(&mut parts, halves, true, shortest, &mut out)?;
    }
    Ok(out)
}

/// Adds the crossings of two parts to `out`.
fn search(
    parts: &mut Parts<'_>,
    [a, b]: [usize; 2],
    joined: bool,
    shortest: f64,
    out: &mut Vec<(f64, f64)>,
) -> Result<(), CrossingError> {
    let mut near = parts.0[a].end;
    let mut pending = vec![(a, b, joined)];
    for _ in 0..MAX_PAIRS {
        crate::checkpoint();
        let Some((first, second, joined)) = pending.pop() else {
            return Ok(());
        };
        let (a, b) = (&parts.0[first], &parts.0[second]);
        near = a.middle.point;
        if !joined && a.is_separate(b) {
            continue;
        }
        if let (Some(one), Some(two)) = (&a.cone, &b.cone) {
            if joined {
                if one.continues_into(two) {
                    continue;
                }
            } else if one.crosses(two) {
                // Tangents are nowhere parallel or opposite: at most one crossing. If Newton's method leads elsewhere,
                // that does not prove that there is none.
                if let Some(found) = refine(a, b) {
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
            // The parts at the joint come last: they rarely cross.
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
    Err(CrossingError::Overlap { near })
}

/// Whether two crossings, found from neighbouring parts, are the same.
///
/// Strands that cross twice cross in opposite directions. So two crossings in one direction with no length between them are
/// the same. Near a cusp the parameters of one point differ by the root of the rounding or more, so the points are compared,
/// within [`point_error`] on each strand.
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
        (x - y).abs() < 1e-7 || apart < shortest + 2.0 * point_error(part, speed)
    };
    let rises = |(u, v): (f64, f64)| a.segment.at(u).first.perp(&b.segment.at(v).first) > 0.0;
    near(a, known.0, found.0) && near(b, known.1, found.1) && rises(known) == rises(found)
}

/// Distance, mm, that rounding may leave between the points of a crossing on its two strands.
fn point_error(part: &Part<'_>, speed: f64) -> f64 {
    1e-11 * (speed + part.start.coords.amax())
}

/// Newton's method on both parameters; `None` if it ends outside the parts by more than rounding.
fn refine(a: &Part<'_>, b: &Part<'_>) -> Option<(f64, f64)> {
    let (mut u, mut v) = (0.5 * (a.from + a.to), 0.5 * (b.from + b.to));
    for _ in 0..50 {
        let (p, q) = (a.segment.at(u), b.segment.at(v));
        let gap = q.point - p.point;
        let area = p.first.perp(&q.first);
        let (du, dv) = (gap.perp(&q.first) / area, gap.perp(&p.first) / area);
        if !(du.is_finite() && dv.is_finite()) {
            return None;
        }
        // A step may leave a part by at most half its length.
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
    let hit = gap <= point_error(a, size) && inside(u, a) && inside(v, b);
    hit.then(|| (u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)))
}

#[cfg(test)]
mod tests;
