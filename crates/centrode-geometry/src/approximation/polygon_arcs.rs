use super::{
    arc_chains::{ArcChains, Beam},
    smooth_run::Node,
};
use crate::{Point, Vector, curve::Segment, numeric::Tolerance, region::Outline};

/// Turn, rad, above which a vertex is a corner, however short its chords. Much larger rounds off real corners; much smaller makes
/// corners of coarse curves.
const SHARP: f64 = 0.5;
/// Maximum number of parts of a chord next to a shorter one. With fewer, the tangents next to long chords are worse; more cost
/// time.
const MAX_PARTS: f64 = 64.0;

impl Outline {
    /// Lines and arcs within the tolerance of the curves that a polygon approximates within `accuracy`.
    ///
    /// A chord of length `l` of a smooth curve turns by at most `8 accuracy / l` from the previous chord. A vertex that turns
    /// twice as much is a corner and stays exact. Between corners the fit is that of [`arcs`](Self::arcs). An outline that is
    /// not a polygon, or a tolerance that is not coarser than the accuracy, goes to that method directly.
    #[must_use]
    pub fn polygon_arcs(&self, accuracy: Tolerance, tolerance: Tolerance) -> Self {
        let limit = 0.985 * (tolerance.mm() - accuracy.mm());
        let is_line = |segment: &Segment| matches!(segment, Segment::Line(..));
        let mut points: Vec<Point> = self.segments().iter().map(Segment::start).collect();
        points.dedup();
        let n = points.len();
        if limit <= 0.0 || n < 4 || !self.segments().iter().all(is_line) {
            return self.arcs(tolerance);
        }
        let is_corner = |i: usize| {
            let (before, after) = (
                points[i] - points[(i + n - 1) % n],
                points[(i + 1) % n] - points[i],
            );
            let turn = before.perp(&after).atan2(before.dot(&after)).abs();
            let shorter = before.norm().min(after.norm());
            turn > SHARP || turn * shorter > 16.0 * accuracy.mm()
        };
        let corners: Vec<usize> = (0..n).filter(|&i| is_corner(i)).collect();
        let mut segments = Vec::new();
        let chain =
            |from: usize, to: usize| -> Vec<Point> { (from..=to).map(|i| points[i % n]).collect() };
        let fit = Fit {
            limit,
            accuracy: accuracy.mm(),
        };
        match corners[..] {
            [] => fit.closed(&chain(0, n), &mut segments),
            [first, ..] => {
                let ends = corners.iter().copied().skip(1).chain([first + n]);
                for (&from, to) in corners.iter().zip(ends) {
                    fit.open(&chain(from, to), &mut segments);
                }
            }
        }
        Self::from_closed(segments)
    }
}

/// Fit of arcs to a chain of vertices.
struct Fit {
    /// Maximum distance of the arcs from the vertices, mm.
    limit: f64,
    /// Maximum distance of the curve from its chords, mm.
    accuracy: f64,
}

impl Fit {
    /// Appends arcs along a chain between two corners. A vertex that they cannot follow becomes a corner, too.
    fn open(&self, chain: &[Point], out: &mut Vec<Segment>) {
        if let [start, end] = *chain {
            out.push(Segment::Line(start, end));
            return;
        }
        let arcs = self.arcs(chain, true);
        match self.worst_vertex(chain, &arcs) {
            None => out.extend(arcs),
            Some(vertex) => {
                self.open(&chain[..=vertex], out);
                self.open(&chain[vertex..], out);
            }
        }
    }

    /// Appends arcs along a closed chain without corners; its last vertex equals its first.
    fn closed(&self, chain: &[Point], out: &mut Vec<Segment>) {
        let arcs = self.arcs(chain, false);
        match self.worst_vertex(chain, &arcs) {
            None => out.extend(arcs),
            Some(_) => self.open(chain, out),
        }
    }

    /// Arcs along a chain; `free` states whether its ends are corners.
    fn arcs(&self, chain: &[Point], free: bool) -> Vec<Segment> {
        let nodes = nodes(&subdivided(chain), !free);
        let mut arcs = Vec::new();
        ArcChains::new(&nodes, [free; 2], self.limit, Beam::THOROUGH).shortest(&mut arcs);
        arcs
    }

    /// The inner vertex next to the maximum distance between arcs and chain; `None` if the arcs stay within the limit.
    fn worst_vertex(&self, chain: &[Point], arcs: &[Segment]) -> Option<usize> {
        // One percent for rounding and for the error at the ends of a beam search.
        let max_distance = 1.01 * self.limit;
        let mut worst = (0.0, 0);
        for (i, p) in chain.iter().enumerate() {
            let nearest = arcs.iter().map(|arc| distance(*p, arc));
            let off = nearest.fold(f64::INFINITY, f64::min) - max_distance;
            if off > worst.0 {
                worst = (off, i);
            }
        }
        // Between vertices the curve, and the arc on it, deviate from the chord by the accuracy.
        let max_from_chord = max_distance + 2.0 * self.accuracy;
        for arc in arcs {
            for step in 1..8 {
                let p = arc.at(-1.0 + 0.25 * f64::from(step)).point;
                let chords = chain.windows(2).enumerate();
                let nearest = chords
                    .map(|(i, w)| (distance(p, &Segment::Line(w[0], w[1])), i))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((off, i)) = nearest
                    && off - max_from_chord > worst.0
                {
                    worst = (off - max_from_chord, i);
                }
            }
        }
        (worst.0 > 0.0).then(|| worst.1.clamp(1, chain.len() - 2))
    }
}

/// Distance of a point from a line or an arc, mm.
fn distance(p: Point, segment: &Segment) -> f64 {
    let (start, end) = (segment.start(), segment.end());
    match segment {
        Segment::Arc(arc) => {
            let center = arc.center();
            let middle = segment.at(0.0).point - center;
            let radial = p - center;
            if radial.perp(&middle).atan2(radial.dot(&middle)).abs() <= 0.5 * arc.sweep().abs() {
                (radial.norm() - arc.radius()).abs()
            } else {
                (p - start).norm().min((p - end).norm())
            }
        }
        _ => {
            let chord = end - start;
            let share = ((p - start).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (p - (start + chord * share)).norm()
        }
    }
}

/// The chain with long chords divided, so that no chord is much longer than its neighbours.
fn subdivided(chain: &[Point]) -> Vec<Point> {
    let lengths: Vec<f64> = chain.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
    let mut points = vec![chain[0]];
    for (i, pair) in chain.windows(2).enumerate() {
        let before = i.checked_sub(1).map(|k| lengths[k]);
        let after = lengths.get(i + 1).copied();
        let shorter = before.into_iter().chain(after).fold(lengths[i], f64::min);
        let pieces = (0.5 * lengths[i] / shorter).ceil().clamp(1.0, MAX_PARTS) as u32;
        points.extend(
            (1..pieces).map(|k| pair[0] + (pair[1] - pair[0]) * (f64::from(k) / f64::from(pieces))),
        );
        points.push(pair[1]);
    }
    points
}

/// The points, each with the tangent of the circle through it and its neighbours. The last point of a closed chain equals the
/// first.
fn nodes(chain: &[Point], closed: bool) -> Vec<Node> {
    let last = chain.len() - 1;
    let tangent = |[a, b, c]: [Point; 3]| {
        let (before, after) = (b - a, c - b);
        let (back, on) = (before.norm(), after.norm());
        (before * (on / back) + after * (back / on)).normalize()
    };
    // The tangent at one end of an arc is that at the other, mirrored in its chord.
    let mirrored = |t: Vector, a: Point, b: Point| {
        let chord = (b - a).normalize();
        chord * (2.0 * chord.dot(&t)) - t
    };
    let within = |i: usize| tangent([chain[i - 1], chain[i], chain[i + 1]]);
    let end = |i: usize| {
        if closed {
            return tangent([chain[last - 1], chain[0], chain[1]]);
        }
        let next = if i == 0 { 1 } else { last - 1 };
        mirrored(within(next), chain[i], chain[next])
    };
    let node = |(i, &point): (usize, &Point)| Node {
        point,
        tangent: if i == 0 || i == last {
            end(i)
        } else {
            within(i)
        },
    };
    chain.iter().enumerate().map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::tooth_ring;

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    /// Maximum distance of the corners of a polygon from arcs, both finely flattened.
    fn deviation(points: &[Point], arcs: &Outline) -> f64 {
        let fine = arcs.flatten(tolerance(1e-6));
        let edges: Vec<[Point; 2]> = (0..fine.len())
            .map(|i| [fine[i], fine[(i + 1) % fine.len()]])
            .collect();
        let from = |p: &Point, [a, b]: &[Point; 2]| {
            let t = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (p - (a + (b - a) * t)).norm()
        };
        let nearest = |p: &Point| {
            edges
                .iter()
                .map(|e| from(p, e))
                .fold(f64::INFINITY, f64::min)
        };
        points.iter().map(nearest).fold(0.0, f64::max)
    }

    #[test]
    fn a_flattened_toothed_ring_becomes_about_as_few_arcs_as_the_ring_itself() {
        let ring = tooth_ring(23, 2.25, tolerance(1e-10));
        let accuracy = tolerance(1e-4);
        let corners = ring.flatten(accuracy);
        let polygon = Outline::polygon(&corners);
        let found = polygon.polygon_arcs(accuracy, tolerance(1e-3));
        Outline::new(found.segments().to_vec()).expect("closed");
        let (own, few) = (
            ring.arcs(tolerance(1e-3)).segments().len(),
            found.segments().len(),
        );
        assert!(corners.len() > 3 * own, "{} {own}", corners.len());
        assert!(few * 3 < own * 5, "{few} {own}");
        let worst = deviation(&corners, &found);
        assert!(worst < 1e-3 - 1e-4, "{worst}");
        // Nor do the arcs leave the polygon anywhere.
        let back = deviation(&found.flatten(tolerance(1e-4)), &polygon);
        assert!(back < 1e-3, "{back}");
        // Too fine a tolerance leaves the polygon as it is.
        assert_eq!(polygon.polygon_arcs(accuracy, tolerance(1e-4)), polygon);
    }

    #[test]
    fn corners_and_straight_sides_stay_and_a_chain_without_a_corner_closes() {
        let slot: Vec<Point> = {
            let end = |x: f64, from: f64| {
                (0..=80).map(move |i| {
                    let angle = from + std::f64::consts::PI * f64::from(i) / 80.0;
                    Point::new(x + 5.0 * angle.cos(), 5.0 * angle.sin())
                })
            };
            let half = std::f64::consts::FRAC_PI_2;
            end(20.0, -half).chain(end(0.0, half)).collect()
        };
        let accuracy = tolerance(1e-3);
        let arcs = Outline::polygon(&slot).polygon_arcs(accuracy, tolerance(5e-3));
        assert!(arcs.segments().len() <= 12, "{}", arcs.segments().len());
        assert!(deviation(&slot, &arcs) < 4e-3);
        let square =
            Outline::polygon(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]].map(Point::from));
        assert_eq!(square.polygon_arcs(accuracy, tolerance(0.1)), square);
        let circle = Outline::circle(Point::origin(), 30.0).flatten(accuracy);
        let arcs = Outline::polygon(&circle).polygon_arcs(accuracy, tolerance(5e-3));
        Outline::new(arcs.segments().to_vec()).expect("closed");
        assert!(arcs.segments().len() <= 6, "{}", arcs.segments().len());
    }
}
