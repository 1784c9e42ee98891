//! Removal of loops from closed chains of curves.

use std::cmp::Ordering;

use crate::{
    Bounds, Point, Segment, Tolerance, Vector,
    containment::winding,
    crossings::{Unresolved, crossings, self_crossings},
};

/// Share of a segment's parameter within which crossings are one, and a crossing is at the segment's end.
const SAME: f64 = 1e-11;

/// Greatest number of passes; each may find loops which the one before laid bare.
const MOST_PASSES: u32 = 16;

/// Stretches between crossings, the longest ones, whose winding number is counted as well as summed up.
const COUNTED: usize = 16;

/// Error of a closed chain that has no contour.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// Every place of the chain lies in a loop.
    #[error("every part of its contour lies in a loop")]
    Everywhere,
    /// Two segments, or one and itself, whose crossings cannot be determined.
    #[error("where segments {} and {} of its contour cross cannot be told: {cause}", .segments[0], .segments[1])]
    Unresolved {
        /// The segments, counted from 0.
        segments: [usize; 2],
        /// Cause.
        cause: Unresolved,
    },
    /// Loops that remain after the greatest number of passes.
    #[error("its contour still crosses itself at segments {} and {} after its loops were cut off {MOST_PASSES} times", .segments[0], .segments[1])]
    Endless {
        /// Two segments that cross, counted from 0.
        segments: [usize; 2],
    },
    /// Crossings of which one was overlooked: the contour would have to be on both sides of itself.
    #[error("its contour crosses itself at segments {} and {} in a way that does not fit the other crossings", .segments[0], .segments[1])]
    Inconsistent {
        /// Two segments that cross, counted from 0.
        segments: [usize; 2],
    },
}

/// A part of a segment that is left after the loops of its chain are cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Index of the segment.
    pub index: usize,
    /// Parameter of its new start.
    pub from: f64,
    /// Parameter of its new end.
    pub to: f64,
}

impl Kept {
    fn whole(index: usize) -> Self {
        Self {
            index,
            from: -1.0,
            to: 1.0,
        }
    }

    /// The part of `self` that a second cut keeps.
    fn cut(&self, again: &Self) -> Self {
        let at = |u: f64| self.from + 0.5 * (1.0 + u) * (self.to - self.from);
        Self {
            index: self.index,
            from: if again.from == -1.0 {
                self.from
            } else {
                at(again.from)
            },
            to: if again.to == 1.0 {
                self.to
            } else {
                at(again.to)
            },
        }
    }
}

/// Place of a chain: segment, and parameter from -1 to below 1.
type Place = (usize, f64);

/// The chain passing through one of its crossings, one of two times.
#[derive(Clone, Copy, Debug)]
struct Passage {
    place: Place,
    /// Number of the crossing.
    crossing: usize,
    /// Change of the winding number on the left of the chain.
    rise: i32,
}

/// Contour of a closed chain of segments that crosses itself: the outer edge of the largest region round which the chain
/// winds in its own sense, counter-clockwise or not, at least once.
///
/// Loops of undercut, of pointed tips, and of offsets beyond the radius of curvature wind the other way, or twice, and are
/// dropped; so are whole pieces that are cut off. The winding number on the left changes by one at each crossing; so the
/// crossings alone tell which stretches are the edge.
///
/// # Errors
/// [`LoopError`] where there is no such region, or where the chain's crossings with itself cannot be determined.
pub fn without_loops(
    segments: &[Segment],
    counter_clockwise: bool,
    tolerance: Tolerance,
) -> Result<Vec<Kept>, LoopError> {
    let mut left: Vec<Kept> = (0..segments.len()).map(Kept::whole).collect();
    let mut last = [0, 0];
    // A crossing may be found only after the loop it lies in is gone.
    for _ in 0..MOST_PASSES {
        let parts: Vec<Segment> = left
            .iter()
            .map(|k| segments[k.index].part(k.from, k.to))
            .collect();
        let chain = Chain::new(&parts, tolerance);
        let named = |cause| named(cause, &left);
        let passages = chain.passages().map_err(named)?;
        if passages.is_empty() {
            return Ok(left);
        }
        let others = others(&passages);
        last = [0, others[0]].map(|k| left[passages[k].place.0].index);
        let winding = chain.left(&passages, &others).map_err(named)?;
        let kept = chain.edge(&passages, &others, &winding, counter_clockwise);
        if kept.is_empty() {
            return Err(LoopError::Everywhere);
        }
        left = kept.iter().map(|k| left[k.index].cut(k)).collect();
    }
    Err(LoopError::Endless { segments: last })
}

/// An error of a chain of parts, with the segments they are parts of.
fn named(error: LoopError, parts: &[Kept]) -> LoopError {
    let own = |segments: [usize; 2]| segments.map(|i| parts[i].index);
    match error {
        LoopError::Unresolved { segments, cause } => LoopError::Unresolved {
            segments: own(segments),
            cause,
        },
        LoopError::Inconsistent { segments } => LoopError::Inconsistent {
            segments: own(segments),
        },
        other => other,
    }
}

fn order(a: &Place, b: &Place) -> Ordering {
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
}

/// The other passage of each one's crossing.
fn others(passages: &[Passage]) -> Vec<usize> {
    let mut of_crossing = vec![usize::MAX; passages.len() / 2];
    let mut others = vec![0; passages.len()];
    for (k, passage) in passages.iter().enumerate() {
        let first = &mut of_crossing[passage.crossing];
        if *first == usize::MAX {
            *first = k;
        } else {
            (others[k], others[*first]) = (*first, k);
        }
    }
    others
}

struct Chain<'a> {
    segments: &'a [Segment],
    boxes: Vec<Bounds>,
    tolerance: Tolerance,
}

impl<'a> Chain<'a> {
    fn new(segments: &'a [Segment], tolerance: Tolerance) -> Self {
        Self {
            segments,
            boxes: segments.iter().map(|s| s.enclosure(-1.0, 1.0)).collect(),
            tolerance,
        }
    }

    /// Edge of the largest region, of all stretches that have such a region on their inner side.
    fn edge(
        &self,
        passages: &[Passage],
        others: &[usize],
        left: &[i32],
        counter_clockwise: bool,
    ) -> Vec<Kept> {
        // The region is on the left, or on the right where the chain is clockwise.
        let inside = i32::from(counter_clockwise);
        let sense = if counter_clockwise { 1.0 } else { -1.0 };
        let mut seen: Vec<bool> = left.iter().map(|w| *w != inside).collect();
        let mut best: (f64, Vec<Kept>) = (0.0, Vec::new());
        for first in 0..passages.len() {
            let (mut kept, mut at) = (Vec::new(), first);
            while !seen[at] {
                seen[at] = true;
                kept.extend(self.between(passages, at));
                // At a crossing the edge goes over to the other strand.
                at = others[(at + 1) % passages.len()];
            }
            let area = sense * self.area(&kept);
            if area > best.0 {
                best = (area, kept);
            }
        }
        let mut kept = best.1;
        let along = |k: &Kept| (k.index, k.from);
        let first = (0..kept.len()).min_by(|&a, &b| order(&along(&kept[a]), &along(&kept[b])));
        kept.rotate_left(first.unwrap_or(0));
        kept
    }

    /// Every passage through a crossing, in order along the chain.
    fn passages(&self) -> Result<Vec<Passage>, LoopError> {
        let count = self.segments.len();
        let mut found: Vec<(Place, Place, i32)> = Vec::new();
        let mut add = |i: usize, j: usize, list: Result<Vec<(f64, f64)>, Unresolved>| {
            let segments = [i.min(j), i.max(j)];
            for (u, v) in list.map_err(|cause| LoopError::Unresolved { segments, cause })? {
                let (p, q) = (self.place(i, u), self.place(j, v));
                let (one, other) = (self.segments[i].at(u), self.segments[j].at(v));
                // Ends meet only within rounding after a cut.
                let apart = (one.point - self.segments[i].end()).norm();
                let joined = (i + 1) % count == j && apart <= 0.1 * self.tolerance.mm();
                if joined || self.are_one(p, q) {
                    continue;
                }
                let rise = if one.first.perp(&other.first) < 0.0 {
                    1
                } else {
                    -1
                };
                let this = if order(&p, &q) == Ordering::Less {
                    (p, q, rise)
                } else {
                    (q, p, -rise)
                };
                // At a joint both segments tell of the crossing, or of a touch from one side.
                let same = |f: &(Place, Place, i32)| {
                    self.are_one(f.0, this.0) && self.are_one(f.1, this.1)
                };
                match found.iter().position(same) {
                    Some(k) if found[k].2 == this.2 => {}
                    Some(k) => drop(found.swap_remove(k)),
                    None => found.push(this),
                }
            }
            Ok(())
        };
        for (i, segment) in self.segments.iter().enumerate() {
            add(i, i, self_crossings(segment, self.tolerance))?;
        }
        for (i, j) in self.meeting() {
            let (i, j) = if (j + 1) % count == i { (j, i) } else { (i, j) };
            let joined = (i + 1) % count == j;
            let list = crossings(&self.segments[i], &self.segments[j], joined, self.tolerance);
            add(i, j, list)?;
        }
        let mut passages: Vec<Passage> = Vec::with_capacity(2 * found.len());
        for (crossing, (p, q, rise)) in found.into_iter().enumerate() {
            for (place, rise) in [(p, rise), (q, -rise)] {
                passages.push(Passage {
                    place,
                    crossing,
                    rise,
                });
            }
        }
        passages.sort_by(|a, b| order(&a.place, &b.place));
        Ok(passages)
    }

    /// Pairs of segments that follow each other or whose boxes meet.
    fn meeting(&self) -> Vec<(usize, usize)> {
        let (boxes, count) = (&self.boxes, self.segments.len());
        let follow = |i: usize, j: usize| (i + 1) % count == j || (j + 1) % count == i;
        let mut pairs: Vec<(usize, usize)> = (0..count)
            .map(|i| (i, (i + 1) % count))
            .filter(|&(i, j)| i != j && (count > 2 || i < j))
            .collect();
        // Sweep from left to right.
        let mut sorted: Vec<usize> = (0..count).collect();
        sorted.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
        let mut active: Vec<usize> = Vec::new();
        for i in sorted {
            crate::checkpoint();
            active.retain(|&j| boxes[j].max.x >= boxes[i].min.x);
            let meets = |&&j: &&usize| !follow(i, j) && boxes[i].meets(&boxes[j]);
            pairs.extend(active.iter().filter(meets).map(|&j| (i.min(j), i.max(j))));
            active.push(i);
        }
        pairs.sort_unstable();
        pairs
    }

    /// A place; the end of a segment is the start of the next.
    fn place(&self, index: usize, u: f64) -> Place {
        if u >= 1.0 - SAME {
            ((index + 1) % self.segments.len(), -1.0)
        } else {
            (index, if u <= -1.0 + SAME { -1.0 } else { u })
        }
    }

    fn are_one(&self, p: Place, q: Place) -> bool {
        p.0 == q.0 && (p.1 - q.1).abs() <= SAME
    }

    /// Winding number on the left of the chain after each passage.
    fn left(&self, passages: &[Passage], others: &[usize]) -> Result<Vec<i32>, LoopError> {
        let count = passages.len();
        let mut left: Vec<i32> = passages
            .iter()
            .scan(0, |w, passage| {
                *w += passage.rise;
                Some(*w)
            })
            .collect();
        let doubt = |k: usize| LoopError::Inconsistent {
            segments: [passages[k].place.0, passages[others[k]].place.0],
        };
        // Round a crossing the four stretches share four winding numbers.
        for k in 0..count {
            if left[(k + count - 1) % count] != left[others[k]] {
                return Err(doubt(k));
            }
        }
        let mut longest: Vec<(f64, usize)> = (0..count)
            .map(|k| (self.between(passages, k).map(|k| self.length(&k)).sum(), k))
            .collect();
        longest.sort_by(|a, b| b.0.total_cmp(&a.0));
        longest.truncate(COUNTED);
        let least = longest.first().map_or(0.0, |l| l.0.min(1e4 * self.aside()));
        let mut base = None;
        for &(_, k) in longest.iter().filter(|l| l.0 >= least) {
            let longer = |a: &Kept, b: &Kept| self.length(a).total_cmp(&self.length(b));
            let Some(part) = self.between(passages, k).max_by(longer) else {
                continue;
            };
            let own = self.winding_beside(part.index, 0.5 * (part.from + part.to)) - left[k];
            if *base.get_or_insert(own) != own {
                return Err(doubt(k));
            }
        }
        let base = base.unwrap_or(0);
        left.iter_mut().for_each(|w| *w += base);
        Ok(left)
    }

    /// Winding number of the chain about a point a little to the left of one of its own.
    fn winding_beside(&self, index: usize, u: f64) -> i32 {
        let segment = &self.segments[index];
        let tangent = segment.tangent(u);
        let aside = Vector::new(-tangent.y, tangent.x) * self.aside();
        let point = segment.at(u).point + aside;
        let level = |b: &Bounds| b.min.y <= point.y && b.max.y >= point.y && b.max.x >= point.x;
        let places = self.segments.iter().zip(&self.boxes);
        places
            .filter(|(_, b)| level(b))
            .map(|(s, _)| winding(s, point))
            .sum()
    }

    /// Parts of segments from a passage to the next.
    fn between(&self, passages: &[Passage], k: usize) -> impl Iterator<Item = Kept> + use<> {
        let count = self.segments.len();
        let (first, start) = passages[k].place;
        let (last, end) = passages[(k + 1) % passages.len()].place;
        let ahead = (last + count - first) % count;
        let steps = if ahead == 0 && end <= start {
            count
        } else {
            ahead
        };
        (0..=steps)
            .map(move |step| Kept {
                index: (first + step) % count,
                from: if step == 0 { start } else { -1.0 },
                to: if step == steps { end } else { 1.0 },
            })
            .filter(|part| part.to > part.from)
    }

    /// Length of a part's chord.
    fn length(&self, kept: &Kept) -> f64 {
        let segment = &self.segments[kept.index];
        (segment.at(kept.to).point - segment.at(kept.from).point).norm()
    }

    /// Distance from the chain at which its winding number is counted, far beyond rounding and the tolerance.
    fn aside(&self) -> f64 {
        let whole = self.boxes.iter().fold(Bounds::EMPTY, |b, o| b.union(*o));
        (10.0 * self.tolerance.mm()).max(1e-9 * whole.diagonal())
    }

    /// Area, about, within parts that follow one another.
    fn area(&self, kept: &[Kept]) -> f64 {
        const CHORDS: u32 = 4;
        let places = kept.iter().flat_map(|k| {
            (0..CHORDS).map(|i| {
                let u = k.from + (k.to - k.from) * f64::from(i) / f64::from(CHORDS);
                self.segments[k.index].at(u).point
            })
        });
        let points: Vec<Point> = places.collect();
        let next = points.iter().cycle().skip(1);
        0.5 * points
            .iter()
            .zip(next)
            .map(|(p, q)| p.coords.perp(&q.coords))
            .sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    fn fine() -> Tolerance {
        Tolerance::new(1e-13).expect("positive")
    }

    #[test]
    fn a_chain_without_crossings_is_kept_whole() {
        let square =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(square[i], square[(i + 1) % 4]))
            .collect();
        let kept = without_loops(&chain, true, fine()).expect("sound");
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
        let kept = without_loops(&chain, true, fine()).expect("sound");
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

    #[test]
    fn a_chain_that_is_not_a_number_is_an_error_that_names_the_segment() {
        let p = Point::new;
        let corners = [p(0.0, 0.0), p(4.0, 0.0), p(f64::NAN, 4.0), p(0.0, 4.0)];
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(corners[i], corners[(i + 1) % 4]))
            .collect();
        let refused = without_loops(&chain, true, fine());
        let named = LoopError::Unresolved {
            segments: [0, 1],
            cause: Unresolved::NotFinite,
        };
        assert_eq!(refused, Err(named));
    }

    #[test]
    fn a_chain_that_runs_back_on_itself_is_an_error_that_names_the_segments() {
        let p = Point::new;
        // There and back on the same arc, with a detour at either end.
        let there = crate::PolySegment::fit(|t| p(t.cos(), t.sin()), 0.0, 0.5, fine())[0];
        let (a, b) = (there.start(), there.end());
        let detour = |at: Point, y: f64| {
            let corners = [at, p(0.0, y), p(3.0, y), at];
            [0, 1, 2].map(|i| Segment::Line(corners[i], corners[i + 1]))
        };
        let mut chain = vec![Segment::Poly(there)];
        chain.extend(detour(b, 3.0));
        chain.push(Segment::Poly(there.reversed()));
        chain.extend(detour(a, -3.0));
        let refused = without_loops(&chain, true, fine());
        assert!(
            matches!(
                refused,
                Err(LoopError::Unresolved {
                    segments: [0, 4],
                    cause: Unresolved::Overlap { .. }
                })
            ),
            "{refused:?}"
        );
    }

    fn polygon(corners: &[(f64, f64)]) -> Vec<Segment> {
        let points: Vec<Point> = corners.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let next = points.iter().cycle().skip(1);
        let lines = points.iter().zip(next);
        lines.map(|(p, q)| Segment::Line(*p, *q)).collect()
    }

    fn indices(chain: &[Segment], counter_clockwise: bool) -> Result<Vec<usize>, LoopError> {
        let kept = without_loops(chain, counter_clockwise, fine())?;
        Ok(kept.iter().map(|k| k.index).collect())
    }

    #[test]
    fn of_an_eight_the_lobe_of_the_sense_asked_for_is_left() {
        let eight = polygon(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]);
        assert_eq!(indices(&eight, true), Ok(vec![0, 2, 3]));
        assert_eq!(indices(&eight, false), Ok(vec![0, 1, 2]));
    }

    #[test]
    fn a_star_is_left_with_its_outer_edge_or_is_an_error_where_it_turns_the_other_way() {
        let corner = |k: u32| {
            let angle = std::f64::consts::TAU * 2.0 * f64::from(k) / 5.0;
            (angle.cos(), angle.sin())
        };
        let star = polygon(&[0, 1, 2, 3, 4].map(corner));
        let kept = without_loops(&star, true, fine()).expect("an edge");
        assert_eq!(kept.len(), 10);
        let short = (kept[0].to - kept[0].from) / 2.0;
        assert!((short - 0.5 * (3.0 - 5_f64.sqrt())).abs() < 1e-12);
        assert_eq!(indices(&star, false), Err(LoopError::Everywhere));
    }

    #[test]
    fn a_piece_behind_a_neck_whose_walls_cross_is_dropped_however_long() {
        let pinched = polygon(&[
            (0.0, -5.0),
            (10.0, -5.0),
            (10.0, -0.5),
            (14.0, 1.0),
            (18.0, -0.5),
            (18.0, -2.0),
            (22.0, -2.0),
            (22.0, 2.0),
            (18.0, 2.0),
            (18.0, 0.5),
            (14.0, -1.0),
            (10.0, 0.5),
            (10.0, 5.0),
            (0.0, 5.0),
        ]);
        assert_eq!(indices(&pinched, true), Ok(vec![0, 1, 2, 10, 11, 12, 13]));
    }
}
