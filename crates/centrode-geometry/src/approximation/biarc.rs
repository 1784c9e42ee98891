use super::smooth_run::{Deviation, Node, hermite_peak};
use crate::{
    Point, Vector,
    curve::{Arc, Segment},
    numeric::rounding,
};

/// Bulge of an arc, the tangent of a quarter of its turn, from two directions: of its start and its chord, or of its chord and
/// its end.
pub(crate) fn bulge(from: Vector, to: Vector) -> f64 {
    from.perp(&to) / (from.norm() * to.norm() + from.dot(&to))
}

/// An arc, or a line if the sagitta of the arc is below the rounding of its ends.
pub(crate) fn arc(start: Point, end: Point, bulge: f64) -> Segment {
    let rounding = rounding(start.coords.amax().max(end.coords.amax()));
    // NaN for equal ends: a line as well.
    if bulge.abs() * (end - start).norm() > rounding {
        Segment::Arc(Arc { start, end, bulge })
    } else {
        Segment::Line(start, end)
    }
}

/// Two arcs from one node to another, along the tangents at both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Biarc {
    joint: Point,
    tangent: Vector,
    arcs: [Circle; 2],
    pub(crate) segments: [Segment; 2],
}

/// A circle, or a line if the curvature is zero, through a point in a direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    point: Point,
    normal: Vector,
    curvature: f64,
}

impl Circle {
    /// The circle from a point in a direction through another point.
    pub(crate) fn through(start: Point, tangent: Vector, end: Point) -> Self {
        let chord = end - start;
        Self {
            point: start,
            normal: Vector::new(-tangent.y, tangent.x),
            curvature: 2.0 * tangent.perp(&chord) / chord.norm_squared(),
        }
    }

    /// Whether the curve through the nodes stays within a distance of the circle.
    pub(crate) fn follows(&self, nodes: &[Node], limit: f64) -> bool {
        let k = self.curvature;
        // A circle with a radius near the limit cannot follow a curve.
        if k.is_nan() || (k * limit).abs() >= 0.1 || !self.is_near(&nodes[nodes.len() / 2], limit) {
            return false;
        }
        let deviation = |node: &Node| {
            let v = node.point - self.point;
            let twice = 2.0 * v.dot(&self.normal) - k * v.norm_squared();
            // `twice = d (2 - k d)`, solved for the small d.
            let d = 0.5 * twice * (1.0 + 0.25 * k * twice);
            Deviation {
                distance: d,
                slope: (self.normal - v * k).dot(&node.tangent) * (1.0 + k * d),
            }
        };
        let mut before = deviation(&nodes[0]);
        for pair in nodes.windows(2) {
            let here = deviation(&pair[1]);
            let d = here.distance;
            if d.is_nan() || d.abs() > limit {
                return false;
            }
            // Cheap bound first: the slopes limit how far a cubic rises above its ends.
            let square = (pair[1].point - pair[0].point).norm_squared();
            let rise = 4.0 / 27.0 * (before.slope.abs() + here.slope.abs());
            let room = limit - before.distance.abs().max(d.abs());
            if rise * rise * square > room * room
                && hermite_peak(before, here, square.sqrt()) > limit
            {
                return false;
            }
            before = here;
        }
        true
    }

    /// Whether a node may lie within `limit` of the circle; the limit is less than a tenth of its radius.
    fn is_near(&self, node: &Node, limit: f64) -> bool {
        let v = node.point - self.point;
        (2.0 * v.dot(&self.normal) - self.curvature * v.norm_squared()).abs() <= 2.2 * limit
    }

    /// Deviation of a node from the circle.
    fn deviation(&self, node: &Node) -> Deviation {
        // 1/K - sqrt((1/K - y)² + x²), in a form that is exact for K near zero.
        let v = node.point - self.point;
        let along = v.dot(&self.normal);
        let k = self.curvature;
        let square = v.norm_squared();
        let root = (1.0 + k * (k * square - 2.0 * along)).max(0.0).sqrt();
        let distance = (2.0 * along - k * square) / (1.0 + root);
        let gradient = (self.normal - v * k) / root.max(f64::MIN_POSITIVE);
        Deviation {
            distance,
            slope: gradient.dot(&node.tangent),
        }
    }
}

impl Biarc {
    /// The biarc whose first control leg has the length `first`, mm; `None` if a leg would be negative or an arc would turn by
    /// half a turn or more.
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
        let (chord0, chord1) = (joint - start.point, end.point - joint);
        let bulges = [bulge(t0, chord0), bulge(chord1, t1)];
        if !bulges.iter().all(|b| b.abs() < 0.99) {
            return None;
        }
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

    /// Maximum distances, mm, of the curve through the nodes from each of the two arcs; infinite above `limit`.
    fn errors(&self, nodes: &[Node], limit: f64) -> [f64; 2] {
        let mut errors = [0.0_f64; 2];
        let slope = nodes
            .first()
            .map_or(0.0, |node| self.arcs[0].deviation(node).slope);
        let mut before = Deviation {
            distance: 0.0,
            slope,
        };
        for pair in nodes.windows(2) {
            let node = &pair[1];
            let side = usize::from((node.point - self.joint).dot(&self.tangent) > 0.0);
            let here = self.arcs[side].deviation(node);
            let h = (node.point - pair[0].point).norm();
            let peak = hermite_peak(before, here, h);
            errors[side] = errors[side].max(peak);
            if peak > limit {
                errors[side] = f64::INFINITY;
                break;
            }
            before = here;
        }
        errors
    }

    /// A biarc from the first node to the last, with the given end tangents, within the tolerance, mm, of the curve through all
    /// nodes.
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
        // Start with equal legs, then move the joint until both errors are equal: the error of an arc is proportional to the cube
        // of its length.
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
}
