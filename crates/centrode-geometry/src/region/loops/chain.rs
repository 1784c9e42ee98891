//! Crossings of a closed chain with itself, and the edge of its largest region.

use std::{cmp::Ordering, collections::BTreeMap};

use super::LoopError;
use crate::{
    Point, Vector,
    curve::{
        Bounds, CrossingError, Meetings, Resolution, Segment, SegmentRange, Span, meetings,
        self_meetings, winding,
    },
    numeric::{COMPUTED, ITERATED, Tolerance},
    region::Position,
};

/// Number of stretches between crossings, the longest ones, whose winding number is also counted directly. More only cost
/// time; with too few, a missed crossing may go unnoticed.
const COUNTED: usize = 16;

/// Sizes of a loop, in tolerances, below which it may remain if its crossings contradict others, tried in this order: small
/// loops of rounding are dropped before real ones. A last size ten times larger leaves visible loops; ten times smaller
/// refuses contours because of rounding.
const SMALL_LOOPS: [f64; 3] = [10.0, 1e2, 1e3];

/// One of the two passages of the chain through a crossing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage {
    pub(crate) position: Position,
    /// Index of the crossing.
    crossing: usize,
    /// Change of the winding number on the left of the chain.
    rise: i32,
}

fn are_same(u: f64, v: f64) -> bool {
    (u - v).abs() <= ITERATED
}

/// For each passage the other passage of its crossing.
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

/// All passages of a chain through its crossings, in order along it.
pub(crate) struct Passages {
    pub(crate) all: Vec<Passage>,
    /// For each passage the other passage of its crossing.
    pub(crate) others: Vec<usize>,
    /// Winding number on the left of the chain after each passage.
    pub(crate) left: Vec<i32>,
}

/// A closed chain of segments.
pub(crate) struct Chain<'a> {
    segments: &'a [Segment],
    spans: Vec<Span<'a>>,
    boxes: Vec<Bounds>,
    tolerance: Tolerance,
}

impl<'a> Chain<'a> {
    pub(crate) fn new(segments: &'a [Segment], tolerance: Tolerance) -> Self {
        let spans: Vec<Span<'a>> = segments.iter().map(Span::whole).collect();
        Self {
            segments,
            boxes: spans.iter().map(Span::bounding_box).collect(),
            spans,
            tolerance,
        }
    }

    /// Edge of the largest region that the chain surrounds once.
    pub(crate) fn edge(
        &self,
        Passages {
            all: passages,
            others,
            left,
        }: &Passages,
        counter_clockwise: bool,
    ) -> Vec<SegmentRange> {
        // The region is on the left of a counter-clockwise chain, on the right of a clockwise one.
        let inside = i32::from(counter_clockwise);
        let sense = if counter_clockwise { 1.0 } else { -1.0 };
        let mut seen: Vec<bool> = left.iter().map(|w| *w != inside).collect();
        let mut best: (f64, Vec<SegmentRange>) = (0.0, Vec::new());
        for first in 0..passages.len() {
            let (mut parts, mut at) = (Vec::new(), first);
            while !seen[at] {
                seen[at] = true;
                parts.extend(self.between(passages, at));
                // At a crossing the edge continues on the other strand.
                at = others[(at + 1) % passages.len()];
            }
            let area = sense * self.area(&parts);
            if area > best.0 {
                best = (area, parts);
            }
        }
        let mut parts = best.1;
        let start = |k: usize| Position {
            segment: parts[k].index,
            u: parts[k].from,
        };
        let first = (0..parts.len()).min_by(|&a, &b| start(a).order(&start(b)));
        parts.rotate_left(first.unwrap_or(0));
        parts
    }

    /// All passages through crossings.
    ///
    /// If a curve turns back within rounding, crossings in a very small loop may contradict each other. Then they are
    /// dropped, those of the smallest loops first.
    pub(crate) fn passages(&self) -> Result<Passages, LoopError> {
        let mut all = self.found()?;
        let mut others = partners(&all);
        let mut left = self.left(&all, &others);
        for size in SMALL_LOOPS {
            if !matches!(left, Err(LoopError::Inconsistent { .. })) {
                break;
            }
            all = self.without_loops_below(size * self.tolerance.mm(), &all, &others);
            others = partners(&all);
            left = self.left(&all, &others);
        }
        let left = left?;
        Ok(Passages { all, others, left })
    }

    /// The passages, except those from which the chain returns to their crossing within `size`, mm.
    fn without_loops_below(
        &self,
        size: f64,
        passages: &[Passage],
        others: &[usize],
    ) -> Vec<Passage> {
        let pairs = passages.iter().zip(others);
        pairs
            .filter(|&(passage, &other)| {
                !self.is_small_loop([passage.position, passages[other].position], size)
            })
            .map(|(passage, _)| *passage)
            .collect()
    }

    /// Whether the chain, from one of two positions to the other, stays nearer to the first than `size`, mm.
    fn is_small_loop(&self, [one, other]: [Position; 2], size: f64) -> bool {
        let is_small = |from: Position, to: Position| {
            let point = self.segments[from.segment].at(from.u).point;
            from.ranges_to(to, self.segments.len())
                .all(|part| self.segments[part.index].stays_near(point, size, part.from, part.to))
        };
        is_small(one, other) || is_small(other, one)
    }

    /// A point at which the chain crosses or touches itself, and the two segments, except in loops smaller than `size`, mm.
    pub(crate) fn meeting(&self, resolution: Resolution, size: f64) -> Option<(Point, [usize; 2])> {
        self.candidates().into_iter().find_map(|pair| {
            let ([i, j], met) = self.meetings(pair, resolution);
            let met = match met {
                Ok(met) => met,
                Err(CrossingError::Overlap { near }) => return Some((near, [i, j])),
                Err(CrossingError::NotFinite) => return None,
            };
            let mut places = met.crossings.into_iter().chain(met.touches);
            let (u, _) = places.find(|&place| {
                self.positions([i, j], place)
                    .is_some_and(|both| !self.is_small_loop(both, size))
            })?;
            Some((self.segments[i].at(u).point, [i, j]))
        })
    }

    /// The meetings of two segments, the second of which follows the first if they are neighbours, or of one with itself.
    fn meetings(
        &self,
        (i, j): (usize, usize),
        resolution: Resolution,
    ) -> ([usize; 2], Result<Meetings, CrossingError>) {
        let count = self.segments.len();
        let follows = |i: usize, j: usize| (i + 1) % count == j;
        let (i, j) = if follows(j, i) { (j, i) } else { (i, j) };
        let met = if i == j {
            self_meetings(&self.spans[i], resolution)
        } else {
            let [a, b] = [i, j].map(|k| &self.spans[k]);
            meetings(a, b, follows(i, j), resolution)
        };
        ([i, j], met)
    }

    /// The two positions of a meeting of segments `i` and `j`; `None` if it is the joint at which `j` follows `i`.
    fn positions(&self, [i, j]: [usize; 2], (u, v): (f64, f64)) -> Option<[Position; 2]> {
        let (p, q) = (self.position(i, u), self.position(j, v));
        // After a cut, ends meet only within rounding.
        let apart = (self.segments[i].at(u).point - self.segments[i].end()).norm();
        let joined = (i + 1) % self.segments.len() == j && apart <= 0.1 * self.tolerance.mm();
        let is_joint = joined || p.segment == q.segment && are_same(p.u, q.u);
        (!is_joint).then_some([p, q])
    }

    /// All passages through the crossings found, in order along the chain.
    fn found(&self) -> Result<Vec<Passage>, LoopError> {
        // Key: the two segments. Value: the parameters on them, and the rise at the first passage.
        let mut found: BTreeMap<[usize; 2], Vec<([f64; 2], i32)>> = BTreeMap::new();
        let resolution = Resolution::of_crossings(self.tolerance);
        for pair in self.candidates() {
            let ([i, j], met) = self.meetings(pair, resolution);
            let segments = [i.min(j), i.max(j)];
            let met = met.map_err(|cause| LoopError::Unresolved { segments, cause })?;
            for (u, v) in met.crossings {
                let Some([p, q]) = self.positions([i, j], (u, v)) else {
                    continue;
                };
                let [one, other] = [self.segments[i].at(u), self.segments[j].at(v)];
                let rise = if one.first.perp(&other.first) < 0.0 {
                    1
                } else {
                    -1
                };
                let (first, second, rise) = if p.order(&q) == Ordering::Less {
                    (p, q, rise)
                } else {
                    (q, p, -rise)
                };
                let known = found.entry([first.segment, second.segment]).or_default();
                // A crossing at a joint is found on both its segments; so is a touch from one side.
                let same =
                    |&([a, b], _): &([f64; 2], i32)| are_same(a, first.u) && are_same(b, second.u);
                match known.iter().position(same) {
                    Some(k) if known[k].1 == rise => {}
                    Some(k) => drop(known.swap_remove(k)),
                    None => known.push(([first.u, second.u], rise)),
                }
            }
        }
        let found = found.into_iter().flat_map(|([i, j], known)| {
            known.into_iter().map(move |([u, v], rise)| {
                let at = |segment: usize, u: f64| Position { segment, u };
                [(at(i, u), rise), (at(j, v), -rise)]
            })
        });
        let mut passages: Vec<Passage> = found
            .enumerate()
            .flat_map(|(crossing, both)| {
                both.map(|(position, rise)| Passage {
                    position,
                    crossing,
                    rise,
                })
            })
            .collect();
        passages.sort_by(|a, b| a.position.order(&b.position));
        Ok(passages)
    }

    /// Pairs of segments that may meet: neighbours, those whose boxes meet, and each segment with itself.
    fn candidates(&self) -> Vec<(usize, usize)> {
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

    /// A position with a parameter below 1: the end of a segment is the start of the next.
    fn position(&self, segment: usize, u: f64) -> Position {
        if u >= 1.0 - ITERATED {
            Position {
                segment: (segment + 1) % self.segments.len(),
                u: -1.0,
            }
        } else {
            let u = if u <= -1.0 + ITERATED { -1.0 } else { u };
            Position { segment, u }
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
        let inconsistent = |k: usize| LoopError::Inconsistent {
            segments: [
                passages[k].position.segment,
                passages[others[k]].position.segment,
            ],
        };
        // The four stretches at a crossing must agree on the winding numbers between them.
        for k in 0..count {
            if left[(k + count - 1) % count] != left[others[k]] {
                return Err(inconsistent(k));
            }
        }
        let mut longest: Vec<(f64, usize)> = (0..count)
            .map(|k| (self.between(passages, k).map(|k| self.chord(&k)).sum(), k))
            .collect();
        longest.sort_by(|a, b| b.0.total_cmp(&a.0));
        longest.truncate(COUNTED);
        let min_length = longest
            .first()
            .map_or(0.0, |l| l.0.min(1e4 * self.side_step()));
        let mut base = None;
        for &(_, k) in longest.iter().filter(|l| l.0 >= min_length) {
            let longer =
                |a: &SegmentRange, b: &SegmentRange| self.chord(a).total_cmp(&self.chord(b));
            let Some(part) = self.between(passages, k).max_by(longer) else {
                continue;
            };
            let at = 0.5 * (part.from + part.to);
            let own = self.winding_next_to(part.index, at, 1.0) - left[k];
            if base == Some(own) {
                continue;
            }
            // Next to strands that lie on each other, as at a pointed tip, the count is meaningless.
            if self.winding_next_to(part.index, at, -1.0) != own + left[k] - 1 {
                continue;
            }
            if base.is_some() {
                return Err(inconsistent(k));
            }
            base = Some(own);
        }
        let base = match (base, longest.first()) {
            (None, Some(&(_, k))) => return Err(inconsistent(k)),
            (base, _) => base.unwrap_or(0),
        };
        left.iter_mut().for_each(|w| *w += base);
        Ok(left)
    }

    /// Winding number of the chain about a point a little to the left (`side` = 1) or right (-1) of one of its points.
    fn winding_next_to(&self, index: usize, u: f64, side: f64) -> i32 {
        let segment = &self.segments[index];
        let tangent = segment.tangent(u);
        let step = Vector::new(-tangent.y, tangent.x) * (side * self.side_step());
        let point = segment.at(u).point + step;
        let level = |b: &Bounds| b.min.y <= point.y && b.max.y >= point.y && b.max.x >= point.x;
        let boxed = self.spans.iter().zip(&self.boxes);
        boxed
            .filter(|(_, b)| level(b))
            .map(|(s, _)| winding(s, point))
            .sum()
    }

    /// Parts of segments from passage `k` to the next.
    fn between(
        &self,
        passages: &[Passage],
        k: usize,
    ) -> impl Iterator<Item = SegmentRange> + use<> {
        let next = &passages[(k + 1) % passages.len()];
        passages[k]
            .position
            .ranges_to(next.position, self.segments.len())
    }

    /// Length of the chord of a part, mm.
    fn chord(&self, parts: &SegmentRange) -> f64 {
        let segment = &self.segments[parts.index];
        (segment.at(parts.to).point - segment.at(parts.from).point).norm()
    }

    /// Distance from the chain, mm, at which its winding number is counted: far above rounding and the tolerance.
    fn side_step(&self) -> f64 {
        let whole = self.boxes.iter().fold(Bounds::EMPTY, |b, o| b.union(*o));
        (10.0 * self.tolerance.mm()).max(COMPUTED * whole.diagonal())
    }

    /// Approximate area, mm², inside parts that form a closed chain.
    fn area(&self, parts: &[SegmentRange]) -> f64 {
        const CHORDS: u32 = 4;
        let samples = parts.iter().flat_map(|k| {
            (0..CHORDS).map(|i| {
                let u = k.from + (k.to - k.from) * f64::from(i) / f64::from(CHORDS);
                self.segments[k.index].at(u).point
            })
        });
        let points: Vec<Point> = samples.collect();
        let next = points.iter().cycle().skip(1);
        0.5 * points
            .iter()
            .zip(next)
            .map(|(p, q)| p.coords.perp(&q.coords))
            .sum::<f64>()
    }
}
