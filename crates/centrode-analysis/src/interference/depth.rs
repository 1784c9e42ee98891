//! Depth of penetration of two moving bodies, by branch and bound over input and boundary.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use centrode_geometry::{Disc, Point, Run, checkpoint};

use super::body::Body;
use super::{InterferenceError, Moving, Patience};

/// Deepest point found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deepest {
    /// Depth inside the other body, mm; negative if no point is inside; the depth to beat if nothing is deeper.
    pub(super) depth: f64,
    /// Upper bound of the depth.
    pub(super) bound: f64,
    /// Input and point in the common frame; `None` if nothing is deeper than the depth to beat.
    pub(super) place: Option<(f64, Point)>,
}

/// Stretch of one body's boundary during an interval.
#[derive(Clone, Copy, Debug)]
struct BoundaryPiece {
    /// Index of the body with the boundary; the depth of the boundary in the other body is searched.
    of: usize,
    stretch: Stretch,
    from: f64,
    to: f64,
    bound: f64,
}

#[derive(Clone, Copy, Debug)]
enum Stretch {
    Run(Run<Disc>),
    /// A part of an edge.
    Chord([Point; 2]),
}

impl Stretch {
    /// The stretch, if it is straight.
    fn chord(&self, body: &Body) -> Option<[Point; 2]> {
        match self {
            Self::Chord(ends) => Some(*ends),
            Self::Run(run) => body.single(run).map(|e| *body.edge(e)),
        }
    }

    /// A circle around the stretch; its centre is on the stretch if that is straight.
    fn circle(&self) -> (Point, f64) {
        match self {
            Self::Run(run) => (run.bound.center, run.bound.radius),
            Self::Chord([a, b]) => (nalgebra::center(a, b), 0.5 * (b - a).norm()),
        }
    }

    fn halves(&self, body: &Body) -> [Self; 2] {
        let halved = |[a, b]: [Point; 2]| {
            let middle = nalgebra::center(&a, &b);
            [Self::Chord([a, middle]), Self::Chord([middle, b])]
        };
        match (self, self.chord(body)) {
            (_, Some(ends)) => halved(ends),
            (Self::Run(run), None) => body.tree().halves(run).map(Self::Run),
            (Self::Chord(ends), None) => halved(*ends),
        }
    }
}

impl Ord for BoundaryPiece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl PartialOrd for BoundaryPiece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for BoundaryPiece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for BoundaryPiece {}

/// Number of parts of boundaries that are examined before the tolerance is doubled. Fewer make the result less exact,
/// more take longer.
const MAX_STEPS: u32 = 200_000;

/// Deepest point of either boundary in the other body while the input runs, to within `tolerance`. Only points deeper than
/// `beat` are searched.
///
/// If two bodies penetrate each other equally deep all along, the search would take too long: then the tolerance grows, and
/// the bound is farther from the depth.
pub(super) fn deepest(
    pair: [&Moving<'_>; 2],
    [from, to]: [f64; 2],
    beat: f64,
    tolerance: f64,
) -> Result<Deepest, InterferenceError> {
    let whole = |of: usize| {
        let root = pair[of].body.tree().root();
        root.map(|run| BoundaryPiece {
            of,
            stretch: Stretch::Run(run),
            from,
            to,
            bound: f64::INFINITY,
        })
    };
    let mut open: BinaryHeap<BoundaryPiece> = [0, 1].into_iter().filter_map(whole).collect();
    let mut best = Deepest {
        depth: beat,
        bound: f64::NEG_INFINITY,
        place: None,
    };
    let mut patience = Patience::new(tolerance, MAX_STEPS);
    while let Some(piece) = open.pop() {
        checkpoint();
        let tolerance = patience.after_one_more();
        if piece.bound <= best.depth + tolerance {
            best.bound = best.bound.max(piece.bound);
            break;
        }
        let own = pair[piece.of].body;
        let (center, radius) = piece.stretch.circle();
        let chord = piece.stretch.chord(own);
        let middle = 0.5 * (piece.from + piece.to);
        let seen = Seen::new([pair[piece.of], pair[1 - piece.of]], &piece, center, chord)?;
        if chord.is_some() && seen.depth > best.depth {
            best = Deepest {
                depth: seen.depth,
                place: Some((middle, seen.point)),
                ..best
            };
        }
        let bound = (seen.depth + radius + seen.travel).min(seen.beside + seen.drift);
        let bound = bound.min(piece.bound);
        if bound <= best.depth + tolerance {
            best.bound = best.bound.max(bound);
            continue;
        }
        if seen.travel > radius && piece.from < middle && middle < piece.to {
            for (from, to) in [(piece.from, middle), (middle, piece.to)] {
                open.push(BoundaryPiece {
                    from,
                    to,
                    bound,
                    ..piece
                });
            }
        } else if radius > 0.0 {
            for stretch in piece.stretch.halves(own) {
                open.push(BoundaryPiece {
                    stretch,
                    bound,
                    ..piece
                });
            }
        } else {
            best.bound = best.bound.max(bound);
        }
    }
    best.bound = best.bound.max(best.depth);
    Ok(best)
}

/// Motion of a point of one body relative to the other body, within an interval.
struct Seen {
    /// Position in the common frame, in the middle of the interval.
    point: Point,
    /// Depth inside the other body, mm; negative outside.
    depth: f64,
    /// Distance by which the point can move relative to the other body, from the middle to either end of the interval.
    travel: f64,
    /// Maximum distance of the whole stretch from the other body's edge nearest to the point, if all points moved straight on:
    /// an upper bound of the depth. The distance from an edge is convex, so the ends of stretch and interval suffice.
    beside: f64,
    /// Distance by which a point can leave that straight path.
    drift: f64,
}

impl Seen {
    fn new(
        [own, other]: [&Moving<'_>; 2],
        piece: &BoundaryPiece,
        center: Point,
        chord: Option<[Point; 2]>,
    ) -> Result<Self, InterferenceError> {
        let (input, half) = (0.5 * (piece.from + piece.to), 0.5 * (piece.to - piece.from));
        let frames = [own.frame(input)?, other.frame(input)?];
        let bends = [own, other].map(|m| m.motion.bend(piece.from, piece.to));
        let (point, velocity) = frames[0].moved(&center);
        let arm = point - frames[1].jet.position;
        let against = (velocity - frames[1].velocity_at(arm)).norm();
        // Seen from the turning body: the change of v - v0 - w x (p - o).
        let straight = bends[0].of_point(center.coords.norm()) + bends[1].acceleration;
        let away = (velocity - frames[1].jet.velocity).norm() + straight * half;
        let far = arm.norm() + away * half;
        let change = straight + bends[1].turning_change * far + bends[1].turning * away;
        let there = frames[1].inside(&point);
        let (distance, nearest) = other.body.boundary().nearest(there);
        let away_from = |point: Point| {
            let (place, velocity) = frames[0].moved(&point);
            let arm = place - frames[1].jet.position;
            let against = frames[1].rotation.inverse() * (velocity - frames[1].velocity_at(arm));
            let seen = frames[1].inside(&place);
            [-half, half]
                .map(|shift| distance_to_edge(seen + against * shift, other.body.edge(nearest)))
                .into_iter()
                .fold(0.0, f64::max)
        };
        let beside = match chord {
            Some(ends) => away_from(ends[0]).max(away_from(ends[1])),
            None => f64::INFINITY,
        };
        let curved = change + bends[1].turning * (against + change * half);
        Ok(Self {
            point,
            depth: if other.body.contains(there) {
                distance
            } else {
                -distance
            },
            travel: (against + change * half) * half,
            beside,
            drift: 0.5 * curved * half * half,
        })
    }
}

fn distance_to_edge(p: Point, [a, b]: &[Point; 2]) -> f64 {
    let way = b - a;
    let length = way.norm_squared();
    let share = if length > 0.0 {
        (way.dot(&(p - a)) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (a + way * share)).norm()
}
