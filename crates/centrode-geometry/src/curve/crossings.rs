//! Crossings of two segments, by subdivision with tangent cones.
//!
//! Source: Sederberg and Meyers, Loop detection in surface patch intersections, CAGD 5, 1988.

mod cusp;

use crate::{
    Point, Vector,
    curve::{Bounds, Span, SpanBounds},
    numeric::{ITERATED, Tolerance, WRITTEN, rounding},
};

/// Maximum number of pairs of parts compared for one pair of segments.
///
/// A flat crossing takes some hundreds. Two strands that leave a cusp in one direction take about `200 sqrt(K / D)`, with
/// their curvature `K` and the difference `D` of their curvatures. Segments that need more lie on each other: with a tenth,
/// some strands at a cusp count as such; ten times more only delays the error.
const MAX_PAIRS: u32 = 200_000;

/// Part of one segment.
struct Part<'a> {
    span: Span<'a>,
    /// Upper bound of the distance between any two of its points, mm.
    size: f64,
    bounds: Bounds,
    cone: Option<Cone>,
    /// Index of the first of its two halves, once they exist.
    halves: Option<usize>,
}

/// Cone that contains every tangent of a part.
#[derive(Clone, Copy)]
struct Cone {
    /// Direction of its middle, that of the chord.
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
    fn new(span: Span<'a>) -> Self {
        let SpanBounds {
            direction,
            cos,
            sin,
            ..
        } = span.bounds;
        let cone = Cone {
            tangent: direction,
            half: [cos, sin],
        };
        Self {
            size: span.size(),
            bounds: span.bounding_box(),
            cone: (cos > 0.0 && direction != Vector::zeros()).then_some(cone),
            halves: None,
            span,
        }
    }

    /// Whether the part is shorter than a length, or so short that it has no midpoint.
    fn is_shorter(&self, length: f64) -> bool {
        self.size < length || self.span.u[1] - self.span.u[0] <= rounding(1.0)
    }

    /// Whether an axis or the normal of a chord separates the two parts by more than `gap`, mm.
    fn is_separate(&self, other: &Self, gap: f64) -> bool {
        let before = |one: &Self, two: &Self| {
            let (high, low) = (one.bounds.max, two.bounds.min);
            high.x + gap < low.x || high.y + gap < low.y
        };
        let clear = |part: &Self| {
            let along = part.span.bounds.direction;
            let normal = Vector::new(-along.y, along.x);
            let (a, b) = (self.span.extent(&normal), other.span.extent(&normal));
            a.1 + gap < b.0 || b.1 + gap < a.0
        };
        before(self, other) || before(other, self) || clear(self) || clear(other)
    }
}

impl Cone {
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
    /// Whole segments first.
    fn new(whole: &[&Span<'a>]) -> Result<Self, CrossingError> {
        let mut parts = Vec::with_capacity(16);
        parts.extend(whole.iter().map(|&&span| Part::new(span)));
        let is_finite = parts.iter().all(|part| part.size.is_finite());
        is_finite
            .then_some(Self(parts))
            .ok_or(CrossingError::NotFinite)
    }

    /// Indices of the two halves of a part.
    fn halves(&mut self, index: usize) -> [usize; 2] {
        let next = self.0.len();
        let part = &mut self.0[index];
        let first = *part.halves.get_or_insert(next);
        if first == next {
            let halves = part.span.halves();
            self.0.extend(halves.map(Part::new));
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
    #[error("two parts overlap near ({:.6}, {:.6}) mm", .near.x, .near.y)]
    Overlap {
        /// A point of the overlap, mm.
        near: Point,
    },
}

/// Where two segments meet, as parameters on the first and on the second.
#[derive(Debug, Default)]
pub(crate) struct Meetings {
    /// Crossings, refined to rounding.
    pub(crate) crossings: Vec<(f64, f64)>,
    /// Parts at the limit of division for which neither a crossing nor a distance between them is proven.
    pub(crate) touches: Vec<(f64, f64)>,
}

/// How far two segments are resolved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Resolution {
    /// Size, mm, below which parts are not divided further.
    pub(crate) size: f64,
    /// Distance, mm, that two parts must exceed to be separate.
    pub(crate) gap: f64,
    /// Distance, mm, within which the two sides of a cusp may overlap if they separate to one side; `None` if every crossing
    /// counts.
    pub(crate) cusp: Option<f64>,
}

impl Resolution {
    /// Crossings only, of parts down to the tolerance.
    pub(crate) fn of_crossings(tolerance: Tolerance) -> Self {
        Self {
            size: tolerance.mm(),
            gap: 0.0,
            cusp: None,
        }
    }
}

/// Where two segments meet.
///
/// If `joined` is true, `b` starts at the end of `a`; this point then does not count. Parts are halved until their bounding
/// boxes or their tangent cones separate; Newton's method refines a crossing.
///
/// # Errors
/// [`CrossingError`] if the segments lie on each other or a coordinate is not a number.
pub(crate) fn meetings(
    a: &Span<'_>,
    b: &Span<'_>,
    joined: bool,
    resolution: Resolution,
) -> Result<Meetings, CrossingError> {
    let mut parts = Parts::new(&[a, b])?;
    let mut out = Meetings::default();
    search(&mut parts, [0, 1], joined, resolution, &mut out)?;
    Ok(out)
}

/// Where a segment meets itself.
///
/// # Errors
/// [`CrossingError`] if it lies on itself or a coordinate is not a number.
pub(crate) fn self_meetings(
    segment: &Span<'_>,
    resolution: Resolution,
) -> Result<Meetings, CrossingError> {
    let mut out = Meetings::default();
    let mut parts = Parts::new(&[segment])?;
    // A smooth curve is cut a few times, a curve with a cusp once per level.
    let mut pending = vec![0];
    while let Some(index) = pending.pop() {
        crate::checkpoint();
        let part = &parts.0[index];
        // A curve whose tangents fit in half a turn cannot return to itself.
        if part.cone.is_some_and(|cone| cone.is_narrow()) || part.is_shorter(resolution.size) {
            continue;
        }
        let halves = parts.halves(index);
        pending.extend(halves);
        search(&mut parts, halves, true, resolution, &mut out)?;
    }
    Ok(out)
}

/// Adds the meetings of two parts to `out`.
fn search(
    parts: &mut Parts<'_>,
    [a, b]: [usize; 2],
    joined: bool,
    resolution: Resolution,
    out: &mut Meetings,
) -> Result<(), CrossingError> {
    let mut near = parts.0[a].span.ends[0];
    let mut pending = vec![(a, b, joined)];
    for _ in 0..MAX_PAIRS {
        crate::checkpoint();
        let Some((first, second, joined)) = pending.pop() else {
            return Ok(());
        };
        let (a, b) = (&parts.0[first], &parts.0[second]);
        near = a.span.ends[0];
        if !joined && a.is_separate(b, resolution.gap) {
            continue;
        }
        if let (Some(one), Some(two)) = (&a.cone, &b.cone) {
            if joined {
                if one.continues_into(two) || a.parts_from(b, resolution) {
                    continue;
                }
            } else if one.crosses(two) {
                // Tangents are nowhere parallel or opposite: at most one crossing. If Newton's method leads elsewhere,
                // that does not prove that there is none.
                if let Some(found) = refine(&a.span, &b.span) {
                    let mut known = out.crossings.iter();
                    if !known.any(|&known| is_same(&a.span, &b.span, known, found, resolution.size))
                    {
                        out.crossings.push(found);
                    }
                    continue;
                }
            }
        }
        if a.is_shorter(resolution.size) && b.is_shorter(resolution.size) {
            if !joined {
                out.touches.push((a.span.u[0], b.span.u[0]));
            }
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

/// Difference of the parameter of a segment within which two crossings in one direction are the same. Ten times smaller, the
/// rounding at a flat crossing makes two of it; ten times larger joins crossings of small loops.
const NEAR: f64 = 1e-7;

/// Whether two crossings, found from neighbouring parts, are the same.
///
/// Strands that cross twice cross in opposite directions. So two crossings in one direction with no length between them are
/// the same. Near a cusp the parameters of one point differ by the root of the rounding or more, so the points are compared,
/// within [`point_error`] on each strand.
fn is_same(
    a: &Span<'_>,
    b: &Span<'_>,
    known: (f64, f64),
    found: (f64, f64),
    shortest: f64,
) -> bool {
    let near = |part: &Span<'_>, x: f64, y: f64| {
        let at = |u: f64| part.segment.at(u).point;
        let (from, to, middle) = (at(x), at(y), at(0.5 * (x + y)));
        let apart = (middle - from).norm() + (to - middle).norm();
        let speed = part.segment.at(x).first.norm();
        (x - y).abs() < NEAR || apart < shortest + 2.0 * point_error(part, speed)
    };
    let rises = |(u, v): (f64, f64)| a.segment.at(u).first.perp(&b.segment.at(v).first) > 0.0;
    near(a, known.0, found.0) && near(b, known.1, found.1) && rises(known) == rises(found)
}

/// Distance, mm, that rounding may leave between the points of a crossing on its two strands.
fn point_error(part: &Span<'_>, speed: f64) -> f64 {
    ITERATED * (speed + part.ends[0].coords.amax())
}

/// Newton's method on both parameters; `None` if it ends outside the parts by more than rounding.
fn refine(a: &Span<'_>, b: &Span<'_>) -> Option<(f64, f64)> {
    let [mut u, mut v] = [a, b].map(|part| 0.5 * (part.u[0] + part.u[1]));
    // A step may leave a part by at most half its length.
    let near = |part: &Span<'_>, x: f64| {
        let [from, to] = part.u;
        let half = 0.5 * (to - from);
        x.clamp(from - half, to + half)
    };
    for _ in 0..50 {
        let (p, q) = (a.segment.at(u), b.segment.at(v));
        let gap = q.point - p.point;
        let area = p.first.perp(&q.first);
        let (du, dv) = (gap.perp(&q.first) / area, gap.perp(&p.first) / area);
        if !(du.is_finite() && dv.is_finite()) {
            return None;
        }
        let before = (u, v);
        u = near(a, u + du);
        v = near(b, v + dv);
        if (u, v) == before || (du.abs().max(dv.abs()) < rounding(1.0)) {
            break;
        }
    }
    let gap = (b.segment.at(v).point - a.segment.at(u).point).norm();
    let speed = a.segment.at(u).first.norm();
    let size = speed.max(b.segment.at(v).first.norm());
    let inside = |x: f64, part: &Span<'_>| x >= part.u[0] - WRITTEN && x <= part.u[1] + WRITTEN;
    let hit = gap <= point_error(a, size) && inside(u, a) && inside(v, b);
    hit.then(|| (u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)))
}

#[cfg(test)]
mod tests;
