use crate::{
    Arc, Point, Segment, Vector,
    smooth_run::{Node, hermite_peak},
};
use nalgebra::Rotation2;

/// Two arcs, or one, that leave one node and reach another along their tangents.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Biarc {
    joint: Point,
    tangent: Vector,
    arcs: [Circle; 2],
    pub(crate) segments: [Segment; 2],
}

/// A circle, or a line where the curvature vanishes, through a point in a direction.
#[derive(Clone, Copy, Debug)]
struct Circle {
    point: Point,
    normal: Vector,
    curvature: f64,
}

impl Circle {
    /// Signed distance to the left and its slope along a unit tangent.
    fn distance(&self, node: &Node) -> (f64, f64) {
        // 1/K - sqrt((1/K - y)² + x²) in the form that stays exact as K goes to zero.
        let v = node.point - self.point;
        let along = v.dot(&self.normal);
        let k = self.curvature;
        let square = v.norm_squared();
        let root = (1.0 + k * (k * square - 2.0 * along)).max(0.0).sqrt();
        let distance = (2.0 * along - k * square) / (1.0 + root);
        let gradient = (self.normal - v * k) / root.max(f64::MIN_POSITIVE);
        (distance, gradient.dot(&node.tangent))
    }
}

impl Biarc {
    /// The biarc whose joint is set by `first`, the length of the first control leg; `None` where a leg
    /// would be negative or an arc turn by a half turn or more.
    fn new(start: &Node, end: &Node, first: f64) -> Option<Self> {
        let v = end.point - start.point;
        let (t0, t1) = (start.tangent, end.tangent);
        // |v - d1 t0 - d2 t1| = d1 + d2
        let second = (v.norm_squared() - 2.0 * first * v.dot(&t0))
            / (2.0 * (v.dot(&t1) + first * (1.0 - t0.dot(&t1))));
        if !(first > 0.0 && second > 0.0 && second.is_finite()) {
            return None;
        }
        let a = start.point + t0 * first;
        let b = end.point - t1 * second;
        let joint = a + (b - a) * (first / (first + second));
        let tangent = (b - a).try_normalize(0.0)?;
        let bulge =
            |from: Vector, to: Vector| from.perp(&to) / (from.norm() * to.norm() + from.dot(&to));
        let (chord0, chord1) = (joint - start.point, end.point - joint);
        let bulges = [bulge(t0, chord0), bulge(chord1, t1)];
        if !bulges.iter().all(|b| b.abs() < 0.99) {
            return None;
        }
        let arc = |start: Point, end: Point, bulge: f64| {
            let chord = (end - start).norm();
            // Below this the sagitta is less than the rounding of the points.
            if bulge.abs() * chord
                <= 4.0 * f64::EPSILON * start.coords.amax().max(end.coords.amax())
            {
                Segment::Line(start, end)
            } else {
                Segment::Arc(Arc { start, end, bulge })
            }
        };
        let circle = |point: Point, tangent: Vector, bulge: f64, chord: f64| Circle {
            point,
            normal: Vector::new(-tangent.y, tangent.x),
            curvature: 4.0 * bulge / ((1.0 + bulge * bulge) * chord),
        };
        Some(Self {
            joint,
            tangent,
            arcs: [
                circle(start.point, t0, bulges[0], chord0.norm()),
                circle(end.point, t1, bulges[1], chord1.norm()),
            ],
            segments: [
                arc(start.point, joint, bulges[0]),
                arc(joint, end.point, bulges[1]),
            ],
        })
    }

    /// Greatest distances of the nodes' curve from each of the two arcs; stops above `limit`.
    fn errors(&self, nodes: &[Node], limit: f64) -> [f64; 2] {
        let mut errors = [0.0_f64; 2];
        let (_, mut slope) = nodes
            .first()
            .map_or((0.0, 0.0), |node| self.arcs[0].distance(node));
        let mut before = 0.0;
        for pair in nodes.windows(2) {
            let node = &pair[1];
            let side = usize::from((node.point - self.joint).dot(&self.tangent) > 0.0);
            let (d, s) = self.arcs[side].distance(node);
            let h = (node.point - pair[0].point).norm();
            let peak = hermite_peak(before, slope, d, s, h);
            errors[side] = errors[side].max(peak);
            if peak > limit {
                errors[side] = f64::INFINITY;
                break;
            }
            (before, slope) = (d, s);
        }
        errors
    }

    /// A biarc from the first node to the last within the tolerance of the curve through them all,
    /// with the end tangents given instead of the curve's own.
    pub(crate) fn fit(nodes: &[Node], tangents: [Vector; 2], tolerance: f64) -> Option<Self> {
        let mut ends = [*nodes.first()?, *nodes.last()?];
        ends[0].tangent = tangents[0];
        ends[1].tangent = tangents[1];
        let [start, end] = &ends;
        let v = end.point - start.point;
        let along = v.dot(&(start.tangent + end.tangent));
        let turn = 2.0 * (1.0 - start.tangent.dot(&end.tangent));
        if along <= 0.0 {
            return None;
        }
        // Equal legs, then the joint moved to where both arcs are equally wrong: the error of an arc
        // grows with the cube of its length.
        let root = (along * along + turn * v.norm_squared()).sqrt();
        let mut first = v.norm_squared() / (along + root);
        for _ in 0..3 {
            let biarc = Self::new(start, end, first)?;
            let errors = biarc.errors(nodes, 8.0 * tolerance);
            let worst = errors[0].max(errors[1]);
            if worst <= tolerance {
                return Some(biarc);
            }
            if !worst.is_finite() || worst < 1.2 * errors[0].min(errors[1]) {
                return None;
            }
            first *= (errors[1] / errors[0]).cbrt().clamp(0.5, 2.0);
        }
        None
    }

    /// Direction in which the biarc arrives.
    pub(crate) fn arrival(&self) -> Vector {
        let normal = self.arcs[1].normal;
        Vector::new(normal.y, -normal.x)
    }

    /// The one arc that is both, if the curve is one circle to rounding.
    pub(crate) fn single(&self) -> Option<Segment> {
        let [first, second] = self.segments;
        let (start, end) = (first.start(), second.end());
        let (leave, arrive) = (first.tangent(-1.0), second.tangent(1.0));
        let chord = end - start;
        let half = |from: Vector, to: Vector| from.perp(&to).atan2(from.dot(&to));
        let (a, b) = (half(leave, chord), half(chord, arrive));
        if (a - b).abs() > 1e-8 || (a + b).abs() > 3.0 {
            return None;
        }
        let bulge = (0.25 * (a + b)).tan();
        Some(match (first, second) {
            (Segment::Line(..), Segment::Line(..)) => Segment::Line(start, end),
            _ => Segment::Arc(Arc { start, end, bulge }),
        })
    }
}

/// How arcs within a tolerance best follow a smooth curve: per node, the tangent they have there and
/// the number of arcs up to there.
///
/// Where the curvature changes at the rate `κ'`, arcs of length `l` whose ends are on the curve stay
/// closest to it, within `e = κ' l³ / 72√3`, if their tangents at the ends are turned from the curve's
/// own by `-κ' l² / 12`: a third of the error of arcs with the curve's own tangents.
pub(crate) struct ArcPlan {
    pub(crate) tangents: Vec<Vector>,
    pub(crate) count: Vec<f64>,
}

impl ArcPlan {
    /// The ends of the run keep the curve's own tangent unless it is free.
    pub(crate) fn new(nodes: &[Node], free: [bool; 2], tolerance: f64) -> Self {
        let scale = 72.0 * 3.0_f64.sqrt() * tolerance;
        let last = nodes.len() - 1;
        let mut travelled = vec![0.0; nodes.len()];
        let mut turned = vec![0.0; nodes.len()];
        for i in 1..nodes.len() {
            let (a, b) = (&nodes[i - 1], &nodes[i]);
            travelled[i] = travelled[i - 1] + (b.point - a.point).norm();
            turned[i] = turned[i - 1] + a.tangent.perp(&b.tangent).atan2(a.tangent.dot(&b.tangent));
        }
        let total = travelled[last];
        let angle_at = |s: f64| {
            let k = travelled.partition_point(|&t| t < s).clamp(1, last);
            let share = (s - travelled[k - 1]) / (travelled[k] - travelled[k - 1]);
            turned[k - 1] + (turned[k] - turned[k - 1]) * share
        };
        let mut plan = Self {
            tangents: Vec::with_capacity(nodes.len()),
            count: Vec::with_capacity(nodes.len()),
        };
        let (mut count, mut density) = (0.0, 0.0);
        let mut length = total / 16.0;
        for (i, node) in nodes.iter().enumerate() {
            // The change of curvature as an arc of the length it allows would meet it; no lean where it
            // is not of one sign.
            let rate_over = |window: f64| {
                let middle = travelled[i].clamp(window, total - window);
                let angles = [middle - window, middle, middle + window].map(angle_at);
                (angles[2] - 2.0 * angles[1] + angles[0]) / (window * window)
            };
            for _ in 0..if i == 0 { 6 } else { 2 } {
                let allowed = (scale / f64::abs(rate_over(0.5 * length))).cbrt();
                length = (length * allowed).sqrt().min(total / 4.0);
            }
            let rates = [1.0, 0.5].map(|share| rate_over(share * length));
            let least = rates[0].abs().min(rates[1].abs());
            let held = (i == 0 && !free[0]) || (i == last && !free[1]);
            let lean = if held || rates[0] * rates[1] <= 0.0 {
                0.0
            } else {
                -least.copysign(rates[0]) * 0.4 * length * length / 12.0
            };
            let before = density;
            density = 1.0 / length;
            if i > 0 {
                count += 0.5 * (before + density) * (travelled[i] - travelled[i - 1]);
            }
            plan.count.push(count);
            plan.tangents.push(Rotation2::new(lean) * node.tangent);
        }
        plan
    }
}
