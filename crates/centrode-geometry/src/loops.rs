use crate::{Point, Segment, SegmentJet, Tolerance, Vector};

/// Share of a segment below which a loop inside that one segment is not looked for.
const CUSP: f64 = 1e-5;

/// A part of one segment, with what is needed to tell it from another without solving anything.
#[derive(Clone, Copy)]
struct Part<'a> {
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

impl<'a> Part<'a> {
    fn whole(segment: &'a Segment) -> Self {
        let third = match segment {
            Segment::Line(..) => 0.0,
            Segment::Arc(arc) => (0.5 * arc.sweep().abs()).powi(3) * arc.radius(),
            Segment::Spline(spline) => spline
                .coefficients()
                .iter()
                .enumerate()
                .skip(3)
                .map(|(k, c)| (k * (k - 1) * (k - 2)) as f64 * c.norm())
                .sum(),
        };
        Self {
            segment,
            third,
            from: -1.0,
            to: 1.0,
            start: segment.start(),
            end: segment.end(),
            middle: segment.at(0.0),
            joined: false,
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
        let first = self.middle.first;
        let size = first.norm();
        let spread = 0.5 * self.bend() * self.length();
        (size > spread).then(|| (first / size, (spread / size).asin()))
    }

    /// Whether an axis or the normal of a chord keeps the two parts apart.
    fn apart(&self, other: &Self) -> bool {
        let margin = self.sagitta() + other.sagitta();
        let clear = |axis: &Vector| {
            let along = |p: &Point| axis.dot(&p.coords);
            let (a0, a1) = (along(&self.start), along(&self.end));
            let (b0, b1) = (along(&other.start), along(&other.end));
            let margin = margin * axis.norm();
            a0.max(a1) + margin < b0.min(b1) || b0.max(b1) + margin < a0.min(a1)
        };
        let normal = |part: &Self| {
            let chord = part.end - part.start;
            Vector::new(-chord.y, chord.x)
        };
        clear(&Vector::x()) || clear(&Vector::y()) || clear(&normal(self)) || clear(&normal(other))
    }
}

fn angle_between(a: &Vector, b: &Vector) -> f64 {
    a.perp(b).atan2(a.dot(b)).abs()
}

/// Parameters at which two segments cross; `joined` says that `b` starts where `a` ends, which is then
/// not a crossing.
///
/// Parts are halved until their bounding boxes part or their tangent cones do; a crossing is then
/// polished by Newton's method. Parts smaller than `tolerance` are taken to touch, not to cross.
#[must_use]
pub fn crossings(a: &Segment, b: &Segment, joined: bool, tolerance: Tolerance) -> Vec<(f64, f64)> {
    let mut first = Part::whole(a);
    let second = Part::whole(b);
    first.joined = joined;
    let mut out = Vec::new();
    search(first, second, tolerance.mm(), &mut out);
    out
}

/// Parameters at which a segment crosses itself.
#[must_use]
pub fn self_crossings(segment: &Segment, tolerance: Tolerance) -> Vec<(f64, f64)> {
    let mut out = Vec::new();
    let mut pending = vec![Part::whole(segment)];
    // A smooth curve is cut a few times, one with a cusp once a level. The branches of a cusp part so
    // slowly that to follow them to the tolerance would cost more than all the rest.
    let shortest = tolerance.mm().max(CUSP * Part::whole(segment).size());
    while let Some(part) = pending.pop() {
        // A curve whose tangents fit in half a turn cannot come back to itself.
        let straight = part.cone().is_some_and(|(_, half)| half < 1.5);
        if straight || part.size() < shortest {
            continue;
        }
        let [mut left, right] = part.halves();
        pending.push(left);
        pending.push(right);
        left.joined = true;
        search(left, right, shortest, &mut out);
    }
    out
}

fn search(a: Part<'_>, b: Part<'_>, shortest: f64, out: &mut Vec<(f64, f64)>) {
    let mut pending = vec![(a, b)];
    // A pair that keeps branching is an overlap, not a crossing; the count bounds the work on it.
    let mut budget = 20_000_u32;
    while let Some((a, b)) = pending.pop() {
        if budget == 0 {
            return;
        }
        budget -= 1;
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
                // Neither parallel nor opposed anywhere: at most one crossing.
                if let Some(found) = polish(&a, &b) {
                    let near = |x: f64, y: f64| (x - y).abs() < 1e-7;
                    if !out
                        .iter()
                        .any(|&(u, v)| near(u, found.0) && near(v, found.1))
                    {
                        out.push(found);
                    }
                }
                continue;
            }
        }
        let (size_a, size_b) = (a.size(), b.size());
        if size_a.max(size_b) < shortest {
            continue;
        }
        if a.joined {
            let [a0, a1] = a.halves();
            let [b0, b1] = b.halves();
            // The joint last: what lies nearest to it is least likely to cross.
            pending.push((a1, b0));
            pending.push((unjoined(a0), b0));
            pending.push((unjoined(a1), b1));
            pending.push((unjoined(a0), b1));
        } else if size_a >= size_b {
            for half in a.halves() {
                pending.push((half, b));
            }
        } else {
            for half in b.halves() {
                pending.push((a, half));
            }
        }
    }
}

fn unjoined(part: Part<'_>) -> Part<'_> {
    Part {
        joined: false,
        ..part
    }
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
        u = (u + du).clamp(a.from - 0.5 * a.length(), a.to + 0.5 * a.length());
        v = (v + dv).clamp(b.from - 0.5 * b.length(), b.to + 0.5 * b.length());
        if du.abs() < 1e-15 && dv.abs() < 1e-15 {
            break;
        }
    }
    let gap = (b.segment.at(v).point - a.segment.at(u).point).norm();
    let size = a
        .segment
        .at(u)
        .first
        .norm()
        .max(b.segment.at(v).first.norm());
    let inside = |x: f64, part: &Part<'_>| x >= part.from - 1e-12 && x <= part.to + 1e-12;
    let hit = gap <= 1e-11 * (size + a.start.coords.amax()) && inside(u, a) && inside(v, b);
    hit.then(|| (u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)))
}

/// A part of a segment that is left after the loops of its chain are cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Which segment.
    pub index: usize,
    /// Parameter it now starts at.
    pub from: f64,
    /// Parameter it now ends at.
    pub to: f64,
}

/// Cuts the loops off a closed chain of segments: where the chain crosses itself, what lies between
/// the two passes is dropped.
///
/// `ahead(i)` is how many segments after the `i`-th may take part in a loop with it; longer detours
/// are left alone. The chain is cut open at a place no loop covers.
///
/// Returns `None` when every place of the chain lies in a loop.
#[must_use]
pub fn without_loops(
    segments: &[Segment],
    ahead: impl Fn(usize) -> usize,
    tolerance: Tolerance,
) -> Option<Vec<Kept>> {
    let count = segments.len();
    let parts: Vec<Part<'_>> = segments.iter().map(Part::whole).collect();
    let boxes: Vec<[f64; 4]> = parts.iter().map(bounds).collect();
    let mut found: Vec<(usize, f64, usize, f64)> = Vec::new();
    for i in 0..count {
        for (u, v) in self_crossings(&segments[i], tolerance) {
            found.push((i, u.min(v), i, u.max(v)));
        }
        for step in 1..=ahead(i).min(count / 2) {
            let j = (i + step) % count;
            let (a, b) = (&boxes[i], &boxes[j]);
            if step > 1 && (a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1]) {
                continue;
            }
            for (u, v) in crossings(&segments[i], &segments[j], step == 1, tolerance) {
                found.push((i, u, i + step, v));
            }
        }
    }
    if found.is_empty() {
        return Some(
            (0..count)
                .map(|index| Kept {
                    index,
                    from: -1.0,
                    to: 1.0,
                })
                .collect(),
        );
    }
    // Start at a segment no loop reaches into.
    let mut covered = vec![false; count];
    for &(i, _, j, _) in &found {
        for k in i..=j {
            covered[k % count] = true;
        }
    }
    let origin = covered.iter().position(|c| !c)?;
    for loop_ in &mut found {
        let shift = (loop_.0 + count - origin) % count;
        loop_.2 = shift + (loop_.2 - loop_.0);
        loop_.0 = shift;
    }
    found.sort_by(|x, y| {
        (x.0, x.1)
            .partial_cmp(&(y.0, y.1))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut kept = Vec::with_capacity(count);
    let (mut index, mut from) = (0, -1.0);
    let mut next = found.iter().peekable();
    while index < count {
        // The next loop that opens at or after where we stand.
        while next.peek().is_some_and(|l| (l.0, l.1) < (index, from)) {
            next.next();
        }
        let segment = (index + origin) % count;
        match next.peek() {
            Some(l) if l.0 == index => {
                if l.1 > from {
                    kept.push(Kept {
                        index: segment,
                        from,
                        to: l.1,
                    });
                }
                // Of the loops opening here the longest is dropped whole.
                (index, from) = (l.2, l.3);
            }
            _ => {
                if from < 1.0 {
                    kept.push(Kept {
                        index: segment,
                        from,
                        to: 1.0,
                    });
                }
                (index, from) = (index + 1, -1.0);
            }
        }
    }
    // Back to the order of the input.
    let turn = kept.iter().position(|k| k.index < origin).unwrap_or(0);
    kept.rotate_left(turn);
    Some(kept)
}

fn bounds(part: &Part<'_>) -> [f64; 4] {
    let margin = part.sagitta();
    [
        part.start.x.min(part.end.x) - margin,
        part.start.y.min(part.end.y) - margin,
        part.start.x.max(part.end.x) + margin,
        part.start.y.max(part.end.y) + margin,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Spline, Tolerance};

    fn fine() -> Tolerance {
        Tolerance::new(1e-13).expect("positive")
    }

    fn splines(f: impl Fn(f64) -> Point, a: f64, b: f64) -> Vec<Segment> {
        let tolerance = Tolerance::new(1e-10).expect("positive");
        Spline::fit(f, a, b, tolerance)
            .into_iter()
            .map(Segment::from)
            .collect()
    }

    #[test]
    fn the_loop_of_a_folium_is_found_at_every_size() {
        // x = t^2, y = t^3 - e t crosses itself at t = +-sqrt e.
        for exponent in 0..3 {
            let e = 10_f64.powi(-exponent);
            let whole = splines(|t| Point::new(t * t, t * (t * t - e)), -1.2, 1.2);
            let found: Vec<_> = if whole.len() == 1 {
                self_crossings(&whole[0], fine())
            } else {
                crossings(&whole[0], &whole[1], true, fine())
            };
            assert_eq!(found.len(), 1, "{e}");
            let point = whole[0].at(found[0].0).point;
            assert!((point - Point::new(e, 0.0)).norm() < 1e-9, "{point} {e}");
        }
    }

    #[test]
    fn a_chain_without_crossings_is_kept_whole() {
        let circle = splines(|t| Point::new(t.cos(), t.sin()), 0.0, 1.5);
        assert!(
            crossings(&circle[0], &circle[0].reversed(), false, fine()).is_empty()
                || circle.len() == 1
        );
        let square =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(square[i], square[(i + 1) % 4]))
            .collect();
        let kept = without_loops(&chain, |_| 3, fine()).expect("sound");
        assert_eq!(kept.len(), 4);
    }

    #[test]
    fn a_bow_in_a_chain_is_cut_off() {
        let corners = [
            (0.0, 0.0),
            (4.0, 0.0),
            (3.0, -1.0),
            (3.0, 1.0),
            (5.0, 1.0),
            (5.0, 4.0),
            (0.0, 4.0),
        ];
        let points = corners.map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..7)
            .map(|i| Segment::Line(points[i], points[(i + 1) % 7]))
            .collect();
        let kept = without_loops(&chain, |_| 3, fine()).expect("sound");
        let at = |k: &Kept| {
            (
                chain[k.index].at(k.from).point,
                chain[k.index].at(k.to).point,
            )
        };
        assert_eq!(kept.len(), 6);
        for pair in kept.windows(2) {
            assert!((at(&pair[0]).1 - at(&pair[1]).0).norm() < 1e-12);
        }
        assert!((at(&kept[0]).1 - Point::new(3.0, 0.0)).norm() < 1e-12);
    }
}
