//! Crossings of curves, by subdivision with tangent cones (Sederberg and Meyers, Loop detection in surface patch
//! intersections, CAGD 5, 1988).

use crate::{Point, Segment, SegmentJet, Tolerance, Vector};

/// Pairs of parts to compare for one pair of segments. A crossing, however flat, takes some hundreds; two strands that leave a cusp
/// in one direction take about 200 sqrt(K/D), where K is their curvature and D the difference of their curvatures. What takes more has no
/// end: the segments lie on each other.
const MOST_PAIRS: u32 = 200_000;

/// Part of one segment with the bounds that prove it apart from another.
#[derive(Clone, Copy)]
struct SegmentPart<'a> {
    segment: &'a Segment,
    /// Bound of the third derivative over the whole segment.
    third: f64,
    from: f64,
    to: f64,
    start: Point,
    end: Point,
    middle: SegmentJet,
    joined: bool,
}

impl<'a> SegmentPart<'a> {
    fn whole(segment: &'a Segment) -> Result<Self, Unresolved> {
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
        let whole = Self {
            segment,
            third,
            from: -1.0,
            to: 1.0,
            start: segment.start(),
            end: segment.end(),
            middle: segment.at(0.0),
            joined: false,
        };
        if whole.size().is_finite() {
            Ok(whole)
        } else {
            Err(Unresolved::NotFinite)
        }
    }

    fn halves(&self) -> [Self; 2] {
        let u = 0.5 * (self.from + self.to);
        [
            Self {
                to: u,
                end: self.middle.point,
                middle: self.segment.at(0.5 * (self.from + u)),
                ..*self
            },
            Self {
                from: u,
                start: self.middle.point,
                middle: self.segment.at(0.5 * (u + self.to)),
                ..*self
            },
        ]
    }

    /// Bound of the distance between any two points of the part.
    fn size(&self) -> f64 {
        (self.end - self.start).norm() + 2.0 * self.sagitta()
    }

    fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Whether the part is shorter than a length, or so short that it has no midpoint.
    fn is_shorter(&self, length: f64) -> bool {
        self.size() < length || self.length() <= 4.0 * f64::EPSILON
    }

    /// Bound of the second derivative.
    fn bend(&self) -> f64 {
        self.middle.second.norm() + 0.5 * self.third * self.length()
    }

    /// Greatest distance of the part from its chord.
    fn sagitta(&self) -> f64 {
        0.125 * self.bend() * self.length() * self.length()
    }

    /// Middle tangent and the half-angle of the cone that holds every tangent of the part.
    fn cone(&self) -> Option<(Vector, f64)> {
        let size = self.middle.first.norm();
        let tangent = self.middle.first / size;
        // Along and across the tangent apart: near a cusp the speed changes fast and the direction does not.
        let half = 0.5 * self.length();
        let rest = 0.5 * self.third * half * half;
        let along = size - half * tangent.dot(&self.middle.second).abs() - rest;
        let across = half * tangent.perp(&self.middle.second).abs() + rest;
        (along > 0.0).then(|| (tangent, (across / along).atan()))
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
        let clear = |axis: &Vector| {
            let (a, b) = (self.along(axis), other.along(axis));
            a.1 < b.0 || b.1 < a.0
        };
        let normal = |part: &Self| {
            let chord = part.end - part.start;
            Vector::new(-chord.y, chord.x)
        };
        clear(&Vector::x()) || clear(&Vector::y()) || clear(&normal(self)) || clear(&normal(other))
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

fn angle_between(a: &Vector, b: &Vector) -> f64 {
    a.perp(b).atan2(a.dot(b)).abs()
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
    let first = SegmentPart {
        joined,
        ..SegmentPart::whole(a)?
    };
    let mut out = Vec::new();
    search(first, SegmentPart::whole(b)?, tolerance.mm(), &mut out)?;
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
    // A smooth curve is cut a few times, one with a cusp once a level.
    let mut pending = vec![SegmentPart::whole(segment)?];
    while let Some(part) = pending.pop() {
        crate::checkpoint();
        // A curve whose tangents fit in half a turn cannot come back to itself.
        let straight = part.cone().is_some_and(|(_, half)| half < 1.5);
        if straight || part.is_shorter(shortest) {
            continue;
        }
        let [mut left, right] = part.halves();
        pending.push(left);
        pending.push(right);
        left.joined = true;
        search(left, right, shortest, &mut out)?;
    }
    Ok(out)
}

fn search(
    a: SegmentPart<'_>,
    b: SegmentPart<'_>,
    shortest: f64,
    out: &mut Vec<(f64, f64)>,
) -> Result<(), Unresolved> {
    let mut near = a.end;
    let mut pending = vec![(a, b)];
    for _ in 0..MOST_PAIRS {
        crate::checkpoint();
        let Some((a, b)) = pending.pop() else {
            return Ok(());
        };
        near = a.middle.point;
        if !a.joined && a.apart(&b) {
            continue;
        }
        if let (Some((ta, ha)), Some((tb, hb))) = (a.cone(), b.cone()) {
            let between = angle_between(&ta, &tb);
            if a.joined {
                if between + ha + hb < std::f64::consts::PI {
                    continue;
                }
            } else if between > ha + hb && between + ha + hb < std::f64::consts::PI {
                // Neither parallel nor opposed anywhere: at most one crossing. Newton's method that leads
                // elsewhere does not prove that there is none.
                if let Some(found) = polish(&a, &b) {
                    if !out
                        .iter()
                        .any(|&known| is_same(&a, &b, known, found, shortest))
                    {
                        out.push(found);
                    }
                    continue;
                }
            }
        }
        if a.is_shorter(shortest) && b.is_shorter(shortest) {
            continue;
        }
        if a.joined {
            let [a0, a1] = a.halves();
            let [b0, b1] = b.halves();
            // The joint last: parts nearest to it are least likely to cross.
            pending.push((a1, b0));
            pending.push((unjoined(a0), b0));
            pending.push((unjoined(a1), b1));
            pending.push((unjoined(a0), b1));
        } else if a.size() >= b.size() {
            for half in a.halves() {
                pending.push((half, b));
            }
        } else {
            for half in b.halves() {
                pending.push((a, half));
            }
        }
    }
    Err(Unresolved::Overlap { near })
}

/// Whether two crossings are one, found from parts beside each other.
///
/// Strands that cross twice cross opposite ways, so two crossings of one sense with no length between them are one. Near a
/// cusp the parameters of one place differ by the root of the rounding, and more; a place is told within [`miss`] on either strand.
fn is_same(
    a: &SegmentPart<'_>,
    b: &SegmentPart<'_>,
    known: (f64, f64),
    found: (f64, f64),
    shortest: f64,
) -> bool {
    let near = |part: &SegmentPart<'_>, x: f64, y: f64| {
        let at = |u: f64| part.segment.at(u).point;
        let (from, to, middle) = (at(x), at(y), at(0.5 * (x + y)));
        let apart = (middle - from).norm() + (to - middle).norm();
        let speed = part.segment.at(x).first.norm();
        (x - y).abs() < 1e-7 || apart < shortest + 2.0 * miss(part, speed)
    };
    let rises = |(u, v): (f64, f64)| a.segment.at(u).first.perp(&b.segment.at(v).first) > 0.0;
    near(a, known.0, found.0) && near(b, known.1, found.1) && rises(known) == rises(found)
}

fn unjoined(part: SegmentPart<'_>) -> SegmentPart<'_> {
    SegmentPart {
        joined: false,
        ..part
    }
}

/// Distance, mm, by which the places of a crossing on two strands may miss each other for their rounding.
fn miss(part: &SegmentPart<'_>, speed: f64) -> f64 {
    1e-11 * (speed + part.start.coords.amax())
}

/// Newton's method on the two parameters, kept to the parts and a rounding beyond.
fn polish(a: &SegmentPart<'_>, b: &SegmentPart<'_>) -> Option<(f64, f64)> {
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
    let inside = |x: f64, part: &SegmentPart<'_>| x >= part.from - 1e-12 && x <= part.to + 1e-12;
    let hit = gap <= miss(a, size) && inside(u, a) && inside(v, b);
    hit.then(|| (u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)))
}

#[cfg(test)]
mod tests;
