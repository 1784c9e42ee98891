//! Minimum distance of two moving boundaries, by branch and bound over input and space at once.
//!
//! Each interval of the input has a list of pairs of circles (finally of edges) that may come closer in it than the minimum
//! distance found. A lower bound of a pair's distance in the whole interval follows from the distance in the middle, the exact
//! velocity there along the line between the two, and the maximum second derivative.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::rc::Rc;

use centrode_geometry::{Disc, Point, Run, Vector, checkpoint};

use super::body::Body;
use super::motion::{Bend, Frame};
use super::{InterferenceError, Moving, Patience};

/// Number of pairs of circles or edges that are examined before the tolerance is doubled. Fewer make the result less
/// exact, more take longer.
const MAX_STEPS: u32 = 50_000_000;

/// Result of the search of one pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach {
    /// Minimum distance found, with its input; the distance to beat if no pair came closer.
    pub(super) minimum: f64,
    pub(super) input: Option<f64>,
    /// Lower bound of the distance.
    pub(super) bound: f64,
}

/// Interval not yet decided.
struct Span {
    from: f64,
    to: f64,
    bound: f64,
    pairs: Rc<[[u32; 2]]>,
}

impl Ord for Span {
    /// Reversed order of the bounds: a heap gives the smallest first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl PartialOrd for Span {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Span {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Span {}

/// Minimum distance of two boundaries while the input runs, to within `tolerance`. Only distances below `beat` are searched.
///
/// If two bodies are equally near all along, the search would take too long: then the tolerance grows, and the bound is
/// farther from the distance.
pub(super) fn approach(
    [a, b]: [&Moving<'_>; 2],
    [from, to]: [f64; 2],
    beat: f64,
    tolerance: f64,
) -> Result<Approach, InterferenceError> {
    let mut open = BinaryHeap::from([Span {
        from,
        to,
        bound: f64::NEG_INFINITY,
        pairs: Rc::new([[0, 0]]),
    }]);
    let mut found = Approach {
        minimum: beat,
        input: None,
        bound: f64::INFINITY,
    };
    let mut patience = Patience::new(tolerance, MAX_STEPS);
    while let Some(span) = open.pop() {
        checkpoint();
        if span.bound >= found.minimum - patience.tolerance {
            found.bound = found.bound.min(span.bound);
            break;
        }
        let middle = 0.5 * (span.from + span.to);
        let state = PairState::new(a, b, middle, 0.5 * (span.to - span.from))?;
        let rest = state.at_pairs(&span.pairs, &mut found, &mut patience);
        if rest.pairs.is_empty() {
            continue;
        }
        // Neighbouring floats, or contact: no further halving helps.
        if middle <= span.from || middle >= span.to || found.minimum <= 0.0 {
            found.bound = found.bound.min(rest.bound);
            if found.minimum <= 0.0 {
                break;
            }
            continue;
        }
        let pairs: Rc<[[u32; 2]]> = rest.pairs.into();
        for (from, to) in [(span.from, middle), (middle, span.to)] {
            open.push(Span {
                from,
                to,
                bound: rest.bound.max(span.bound),
                pairs: pairs.clone(),
            });
        }
    }
    found.bound = found.bound.min(found.minimum);
    Ok(found)
}

/// Pairs that may still come closer than the minimum found, and the minimum bound among them.
struct Rest {
    pairs: Vec<[u32; 2]>,
    bound: f64,
}

/// State of two bodies in the middle of an interval.
struct PairState<'a> {
    bodies: [&'a Body; 2],
    frames: [Frame; 2],
    bends: [Bend; 2],
    input: f64,
    half: f64,
}

impl<'a> PairState<'a> {
    fn new(
        a: &Moving<'a>,
        b: &Moving<'a>,
        input: f64,
        half: f64,
    ) -> Result<Self, InterferenceError> {
        Ok(Self {
            bodies: [a.body, b.body],
            frames: [a.frame(input)?, b.frame(input)?],
            bends: [a, b].map(|m| m.motion.bend(input - half, input + half)),
            input,
            half,
        })
    }

    fn at_pairs(&self, pairs: &[[u32; 2]], found: &mut Approach, patience: &mut Patience) -> Rest {
        let mut rest = Rest {
            pairs: Vec::new(),
            bound: f64::INFINITY,
        };
        let mut open: Vec<[u32; 2]> = pairs.to_vec();
        while let Some(pair) = open.pop() {
            checkpoint();
            let tolerance = patience.after_one_more();
            let [p, q] = self.runs(pair);
            let (bound, blur) = self.circles(pair);
            if bound >= found.minimum - tolerance {
                found.bound = found.bound.min(bound);
                continue;
            }
            let mut split = |k: usize| {
                let halves = self.bodies[k].tree().halves([p, q][k]);
                open.extend(halves.map(|half| {
                    let mut of = pair;
                    of[k] = half.index();
                    of
                }));
            };
            match [0, 1].map(|k| self.bodies[k].single([p, q][k])) {
                [Some(e), Some(f)] => {
                    let (distance, bound) = self.edges([e, f]);
                    if distance < found.minimum {
                        (found.minimum, found.input) = (distance, Some(self.input));
                    }
                    if bound >= found.minimum - tolerance {
                        found.bound = found.bound.min(bound);
                    } else {
                        rest.keep(pair, bound);
                    }
                }
                // If a pair moves by more than the sum of its radii, the interval is halved, not the circles.
                _ if blur > p.bound.radius + q.bound.radius => rest.keep(pair, bound),
                [None, Some(_)] => split(0),
                [Some(_), None] => split(1),
                [None, None] => split(usize::from(p.bound.radius < q.bound.radius)),
            }
        }
        rest
    }

    /// The runs of both bodies with these indices.
    fn runs(&self, pair: [u32; 2]) -> [&'a Run<Disc>; 2] {
        [0, 1].map(|k| self.bodies[k].tree().run(pair[k]))
    }

    /// Lower bound of the distance of two circles in the interval, and the part that is subtracted in it for their movement.
    fn circles(&self, pair: [u32; 2]) -> (f64, f64) {
        let [p, q] = self.runs(pair).map(|run| run.bound);
        let (at_p, move_p) = self.frames[0].moved(&p.center);
        let (at_q, move_q) = self.frames[1].moved(&q.center);
        let apart = at_p - at_q;
        let distance = apart.norm();
        let bend = self.bends[0].of_point(p.center.coords.norm())
            + self.bends[1].of_point(q.center.coords.norm());
        let closing = if distance > 0.0 {
            apart.dot(&(move_p - move_q)).abs() / distance
        } else {
            0.0
        };
        let blur = (closing + 0.5 * bend * self.half) * self.half;
        (distance - blur - p.radius - q.radius, blur)
    }

    /// Distance of two edges in the middle, and a bound for the whole interval.
    fn edges(&self, [e, f]: [u32; 2]) -> (f64, f64) {
        let (edge, other) = (self.bodies[0].edge(e), self.bodies[1].edge(f));
        let p = [0, 1].map(|i| self.frames[0].moved(&edge[i]));
        let q = [0, 1].map(|i| self.frames[1].moved(&other[i]));
        let (distance, apart) = between([p[0].0, p[1].0], [q[0].0, q[1].0]);
        if distance <= 0.0 {
            return (0.0, 0.0);
        }
        let reach = |edge: &[Point; 2]| edge[0].coords.norm().max(edge[1].coords.norm());
        let bend = self.bends[0].of_point(reach(edge)) + self.bends[1].of_point(reach(other));
        // Along the line between the closest points the gap between the ends is a lower bound for convex shapes.
        let along = apart / distance;
        let mut gap = f64::INFINITY;
        for shift in [-self.half, self.half] {
            let place =
                |(point, velocity): &(Point, Vector)| along.dot(&(point.coords + velocity * shift));
            let near = place(&p[0]).min(place(&p[1]));
            let far = place(&q[0]).max(place(&q[1]));
            gap = gap.min(near - far);
        }
        (distance, gap - 0.5 * bend * self.half * self.half)
    }
}

impl Rest {
    fn keep(&mut self, pair: [u32; 2], bound: f64) {
        self.pairs.push(pair);
        self.bound = self.bound.min(bound);
    }
}

/// Distance of two edges and the vector from a closest point of the second to one of the first.
fn between(p: [Point; 2], q: [Point; 2]) -> (f64, Vector) {
    let side = |a: Point, b: Point, c: Point| (b - a).perp(&(c - a));
    let opposite = |a: f64, b: f64| a * b < 0.0;
    if opposite(side(p[0], p[1], q[0]), side(p[0], p[1], q[1]))
        && opposite(side(q[0], q[1], p[0]), side(q[0], q[1], p[1]))
    {
        return (0.0, Vector::zeros());
    }
    let to = |c: Point, [a, b]: [Point; 2]| {
        let way = b - a;
        let length = way.norm_squared();
        let share = if length > 0.0 {
            (way.dot(&(c - a)) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        c - (a + way * share)
    };
    let ways = [to(p[0], q), to(p[1], q), -to(q[0], p), -to(q[1], p)];
    let mut minimum = (f64::INFINITY, Vector::zeros());
    for way in ways {
        let squared = way.norm_squared();
        if squared < minimum.0 {
            minimum = (squared, way);
        }
    }
    (minimum.0.sqrt(), minimum.1)
}
