//! Crossings of a closed chain of curves with itself, and the edge they leave.

use std::{cmp::Ordering, collections::BTreeMap};

use super::{Kept, LoopError};
use crate::{
    Point, Vector,
    curve::{Bounds, Segment, Unresolved, crossings, self_crossings, winding},
    numeric::Tolerance,
};

/// Share of a segment's parameter within which crossings are one, and a crossing is at the segment's end.
const SAME: f64 = 1e-11;

/// Stretches between crossings, the longest ones, whose winding number is counted as well as summed up.
const COUNTED: usize = 16;

/// Size, in tolerances, below which loops are specks: they may stay where crossings in them do not fit.
const SPECK: f64 = 1e3;

/// Place of a chain: segment, and parameter from -1 to below 1.
type Place = (usize, f64);

/// The chain passing through one of its crossings, one of two times.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage {
    pub(crate) place: Place,
    /// Number of the crossing.
    crossing: usize,
    /// Change of the winding number on the left of the chain.
    rise: i32,
}

fn order(a: &Place, b: &Place) -> Ordering {
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
}

fn are_same(u: f64, v: f64) -> bool {
    (u - v).abs() <= SAME
}

/// The other passage of each one's crossing.
fn partners(passages: &[Passage]) -> Vec<usize> {
    let crossings = passages.iter().map(|p| p.crossing + 1).max();
    let mut of_crossing = vec![usize::MAX; crossings.unwrap_or(0)];
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

/// The crossings of a chain, as it passes through them.
pub(crate) struct Passages {
    pub(crate) all: Vec<Passage>,
    /// The other passage of each one's crossing.
    pub(crate) others: Vec<usize>,
    /// Winding number on the left of the chain after each.
    pub(crate) left: Vec<i32>,
}

pub(crate) struct Chain<'a> {
    segments: &'a [Segment],
    boxes: Vec<Bounds>,
    tolerance: Tolerance,
}

impl<'a> Chain<'a> {
    pub(crate) fn new(segments: &'a [Segment], tolerance: Tolerance) -> Self {
        Self {
            segments,
            boxes: segments.iter().map(|s| s.enclosure(-1.0, 1.0)).collect(),
            tolerance,
        }
    }

    /// Edge of the largest region, of all stretches that have such a region on their inner side.
    pub(crate) fn edge(
        &self,
        Passages {
            all: passages,
            others,
            left,
        }: &Passages,
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

    /// Every passage through a crossing. Where a curve turns back within rounding crossings in a speck may not fit each other:
    /// then none of these is one.
    pub(crate) fn passages(&self) -> Result<Passages, LoopError> {
        let mut all = self.found()?;
        let mut others = partners(&all);
        let mut left = self.left(&all, &others);
        if let Err(LoopError::Inconsistent { .. }) = left {
            all = self.without_specks(&all, &others);
            others = partners(&all);
            left = self.left(&all, &others);
        }
        let left = left?;
        Ok(Passages { all, others, left })
    }

    /// The passages but those from which the chain comes back to their crossing within a speck.
    fn without_specks(&self, passages: &[Passage], others: &[usize]) -> Vec<Passage> {
        let speck = SPECK * self.tolerance.mm();
        let is_speck = |from: Place, to: Place| {
            let point = self.segments[from.0].at(from.1).point;
            self.way(from, to)
                .all(|part| self.segments[part.index].keeps_near(point, speck, part.from, part.to))
        };
        let is_loop = |passage: &Passage, other: &Passage| {
            !is_speck(passage.place, other.place) && !is_speck(other.place, passage.place)
        };
        let pairs = passages.iter().zip(others);
        pairs
            .filter(|&(passage, &other)| is_loop(passage, &passages[other]))
            .map(|(passage, _)| *passage)
            .collect()
    }

    /// Every passage through a crossing that is found, in order along the chain.
    fn found(&self) -> Result<Vec<Passage>, LoopError> {
        let count = self.segments.len();
        // By their two segments: parameters on these, and the rise where the chain passes first.
        let mut found: BTreeMap<[usize; 2], Vec<([f64; 2], i32)>> = BTreeMap::new();
        let mut add = |i: usize, j: usize, list: Result<Vec<(f64, f64)>, Unresolved>| {
            let segments = [i.min(j), i.max(j)];
            for (u, v) in list.map_err(|cause| LoopError::Unresolved { segments, cause })? {
                let (p, q) = (self.place(i, u), self.place(j, v));
                let (one, other) = (self.segments[i].at(u), self.segments[j].at(v));
                // Ends meet only within rounding after a cut.
                let apart = (one.point - self.segments[i].end()).norm();
                let joined = (i + 1) % count == j && apart <= 0.1 * self.tolerance.mm();
                if joined || p.0 == q.0 && are_same(p.1, q.1) {
                    continue;
                }
                let rise = if one.first.perp(&other.first) < 0.0 {
                    1
                } else {
                    -1
                };
                let (first, second, rise) = if order(&p, &q) == Ordering::Less {
                    (p, q, rise)
                } else {
                    (q, p, -rise)
                };
                let known = found.entry([first.0, second.0]).or_default();
                // At a joint both segments tell of the crossing, or of a touch from one side.
                let same =
                    |&([a, b], _): &([f64; 2], i32)| are_same(a, first.1) && are_same(b, second.1);
                match known.iter().position(same) {
                    Some(k) if known[k].1 == rise => {}
                    Some(k) => drop(known.swap_remove(k)),
                    None => known.push(([first.1, second.1], rise)),
                }
            }
            Ok(())
        };
        for (i, j) in self.meeting() {
            if i == j {
                add(i, i, self_crossings(&self.segments[i], self.tolerance))?;
                continue;
            }
            let (i, j) = if (j + 1) % count == i { (j, i) } else { (i, j) };
            let joined = (i + 1) % count == j;
            let list = crossings(&self.segments[i], &self.segments[j], joined, self.tolerance);
            add(i, j, list)?;
        }
        let found = found.into_iter().flat_map(|([i, j], known)| {
            let places = known.into_iter();
            places.map(move |([u, v], rise)| [((i, u), rise), ((j, v), -rise)])
        });
        let mut passages: Vec<Passage> = found
            .enumerate()
            .flat_map(|(crossing, both)| {
                both.map(|(place, rise)| Passage {
                    place,
                    crossing,
                    rise,
                })
            })
            .collect();
        passages.sort_by(|a, b| order(&a.place, &b.place));
        Ok(passages)
    }

    /// Pairs of segments that follow each other or whose boxes meet, and each with itself.
    fn meeting(&self) -> Vec<(usize, usize)> {
        let (boxes, count) = (&self.boxes, self.segments.len());
        let follow = |i: usize, j: usize| (i + 1) % count == j || (j + 1) % count == i;
        let mut pairs: Vec<(usize, usize)> = (0..count)
            .map(|i| (i, (i + 1) % count))
            .filter(|&(i, j)| i != j && (count > 2 || i < j))
            .chain((0..count).map(|i| (i, i)))
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
            let at = 0.5 * (part.from + part.to);
            let own = self.winding_beside(part.index, at, 1.0) - left[k];
            if base == Some(own) {
                continue;
            }
            // Beside strands that lie on each other, as at the tip of a pointed tooth, the place tells nothing.
            if self.winding_beside(part.index, at, -1.0) != own + left[k] - 1 {
                continue;
            }
            if base.is_some() {
                return Err(doubt(k));
            }
            base = Some(own);
        }
        let base = match (base, longest.first()) {
            (None, Some(&(_, k))) => return Err(doubt(k)),
            (base, _) => base.unwrap_or(0),
        };
        left.iter_mut().for_each(|w| *w += base);
        Ok(left)
    }

    /// Winding number of the chain about a point a little to the left of one of its own, or to the right (side -1).
    fn winding_beside(&self, index: usize, u: f64, side: f64) -> i32 {
        let segment = &self.segments[index];
        let tangent = segment.tangent(u);
        let aside = Vector::new(-tangent.y, tangent.x) * (side * self.aside());
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
        let next = &passages[(k + 1) % passages.len()];
        self.way(passages[k].place, next.place)
    }

    /// Parts of segments from a place on to another.
    fn way(&self, (first, start): Place, (last, end): Place) -> impl Iterator<Item = Kept> + use<> {
        let count = self.segments.len();
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
