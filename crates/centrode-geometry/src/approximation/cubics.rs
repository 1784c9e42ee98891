use super::smooth_run::{Deviation, Node, Run, hermite_peak};
use crate::{
    Point, Vector,
    curve::{Arc, Segment},
    numeric::Tolerance,
    region::Outline,
};

impl Outline {
    /// Bézier cubics, joined end to start, nowhere farther from the outline than the tolerance.
    ///
    /// Each is its four control points. Corners stay exact, and the cubics join without a kink where the outline does.
    #[must_use]
    pub fn cubics(&self, tolerance: Tolerance) -> Vec<[Point; 4]> {
        let limit = 0.995 * tolerance.mm();
        let mut out = Vec::new();
        for run in self.runs(tolerance.scaled(0.25)) {
            match run {
                Run::Exact(index) => match &self.segments()[index] {
                    Segment::Arc(arc) => arc_cubics(arc, limit, &mut out),
                    segment => {
                        let (start, end) = (segment.start(), segment.end());
                        let third = (end - start) / 3.0;
                        out.push([start, start + third, end - third, end]);
                    }
                },
                Run::Smooth { nodes, .. } => {
                    let last = nodes.len() - 1;
                    let (mut start, mut guess) = (0, 4);
                    while start < last {
                        let (steps, cubic) = longest(&nodes[start..], guess, limit);
                        out.push(cubic);
                        start += steps;
                        guess = steps;
                    }
                }
            }
        }
        out
    }
}

/// Number of steps and control points of the longest cubic within the limit; one step if none is. The search starts at `guess`
/// steps.
fn longest(nodes: &[Node], guess: usize, limit: f64) -> (usize, [Point; 4]) {
    let last = nodes.len() - 1;
    let (mut good, mut bad) = (0, last + 1);
    let mut best = hermite(&nodes[..2]);
    let mut step = guess.min(last);
    while bad - good > 1 {
        let cubic = hermite(&nodes[..=step]);
        if error(&cubic, &nodes[..=step], limit) <= limit {
            (good, best) = (step, cubic);
        } else {
            bad = step;
        }
        step = if bad > last {
            (2 * good).min(last)
        } else {
            (good + bad) / 2
        };
    }
    (good.max(1), best)
}

/// The cubic with the end points and tangents of the nodes and handles of a third of the length of the curve.
fn hermite(nodes: &[Node]) -> [Point; 4] {
    let (start, end) = (&nodes[0], &nodes[nodes.len() - 1]);
    // Sum over arcs: nearer to the length of the curve than the sum over chords.
    let length: f64 = nodes
        .windows(2)
        .map(|w| {
            let chord = (w[1].point - w[0].point).norm();
            let half = 0.5
                * w[0]
                    .tangent
                    .perp(&w[1].tangent)
                    .atan2(w[0].tangent.dot(&w[1].tangent));
            if half == 0.0 {
                chord
            } else {
                chord * half / half.sin()
            }
        })
        .sum();
    [
        start.point,
        start.point + start.tangent * (length / 3.0),
        end.point - end.tangent * (length / 3.0),
        end.point,
    ]
}

/// Maximum distance, mm, of the curve through the nodes from a cubic; infinite above `limit`.
fn error(cubic: &[Point; 4], nodes: &[Node], limit: f64) -> f64 {
    let total: f64 = nodes
        .windows(2)
        .map(|w| (w[1].point - w[0].point).norm())
        .sum();
    let (mut worst, mut travelled) = (0.0_f64, 0.0);
    let mut before = Deviation {
        distance: 0.0,
        slope: 0.0,
    };
    for pair in nodes.windows(2) {
        let step = (pair[1].point - pair[0].point).norm();
        travelled += step;
        let mut t = travelled / total;
        let (mut point, mut velocity) = at(cubic, t);
        for _ in 0..3 {
            t += (pair[1].point - point).dot(&velocity) / velocity.norm_squared();
            (point, velocity) = at(cubic, t.clamp(0.0, 1.0));
        }
        let normal = Vector::new(-velocity.y, velocity.x).normalize();
        let here = Deviation {
            distance: normal.dot(&(pair[1].point - point)),
            slope: normal.dot(&pair[1].tangent),
        };
        worst = worst.max(hermite_peak(before, here, step));
        if !(worst <= limit && t.is_finite()) {
            return f64::INFINITY;
        }
        before = here;
    }
    worst
}

/// Point and velocity of a cubic.
fn at(c: &[Point; 4], t: f64) -> (Point, Vector) {
    let s = 1.0 - t;
    let point = c[0].coords * (s * s * s)
        + (c[1].coords * s + c[2].coords * t) * (3.0 * s * t)
        + c[3].coords * (t * t * t);
    let velocity =
        ((c[1] - c[0]) * (s * s) + (c[2] - c[1]) * (2.0 * s * t) + (c[3] - c[2]) * (t * t)) * 3.0;
    (Point::from(point), velocity)
}

/// Appends cubics for equal parts of an arc that deviate from it by less than the limit, mm.
fn arc_cubics(arc: &Arc, limit: f64, out: &mut Vec<[Point; 4]>) {
    let segment = Segment::Arc(*arc);
    let (sweep, radius) = (arc.sweep().abs(), arc.radius());
    let mut parts = (sweep / std::f64::consts::FRAC_PI_2).ceil().max(1.0);
    // With the standard handle the error is 4/27 sin⁶(θ/4) / cos²(θ/4) of the radius.
    while radius * 4.0 / 27.0 * (0.25 * sweep / parts).sin().powi(6)
        / (0.25 * sweep / parts).cos().powi(2)
        > limit
    {
        parts += 1.0;
    }
    let handle = 4.0 / 3.0 * (0.25 * sweep / parts).tan() * radius;
    let count = parts as usize;
    let ends: Vec<(Point, Vector)> = (0..=count)
        .map(|k| {
            let u = -1.0 + 2.0 * k as f64 / parts;
            let point = if k == 0 {
                arc.start
            } else if k == count {
                arc.end
            } else {
                segment.at(u).point
            };
            (point, segment.tangent(u) * handle)
        })
        .collect();
    for pair in ends.windows(2) {
        let ((start, leave), (end, arrive)) = (pair[0], pair[1]);
        out.push([start, start + leave, end - arrive, end]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::tooth_ring;

    #[test]
    fn cubics_keep_the_tolerance_and_join() {
        let fine = Tolerance::new(1e-10).expect("positive");
        let circle = Outline::circle(Point::new(3.0, 1.0), 25.0);
        for outline in [tooth_ring(19, 2.0, fine), circle] {
            let mut counts = Vec::new();
            for tol in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
                let cubics = outline.cubics(Tolerance::new(tol).expect("positive"));
                let next = cubics.iter().cycle().skip(1);
                assert!(cubics.iter().zip(next).all(|(a, b)| a[3] == b[0]));
                // Both curves as dense polygons, compared point by point in order.
                let dense: Vec<Point> = cubics
                    .iter()
                    .flat_map(|c| (0..200).map(move |i| at(c, f64::from(i) / 200.0).0))
                    .collect();
                let mut k = 0;
                for segment in outline.segments() {
                    for i in 0..20 {
                        let p = segment.at(-1.0 + 0.1 * f64::from(i)).point;
                        let distance = |k: usize| {
                            let (a, b) = (dense[k % dense.len()], dense[(k + 1) % dense.len()]);
                            let t =
                                ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
                            (a + (b - a) * t - p).norm()
                        };
                        while k + 1 < dense.len() && distance(k + 1) < distance(k) {
                            k += 1;
                        }
                        assert!(distance(k) <= tol * 1.02 + 1e-7, "{tol}: {}", distance(k));
                    }
                }
                counts.push(cubics.len());
            }
            assert!(
                counts.windows(2).all(|w| w[0] <= w[1]) && counts[4] < 40 * 19,
                "{counts:?}"
            );
        }
    }
}
