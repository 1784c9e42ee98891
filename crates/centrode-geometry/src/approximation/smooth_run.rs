use crate::{
    Point, Vector,
    curve::Segment,
    numeric::Tolerance,
    region::{CORNER, Outline},
};

/// A point of a smooth part of an outline with its unit tangent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) point: Point,
    pub(crate) tangent: Vector,
}

/// Part of an outline between corners: one line or arc, or a smooth run of polynomials as long as possible.
#[derive(Debug)]
pub(crate) enum Run {
    /// Index of a line or an arc, which stays exact.
    Exact(usize),
    /// A smooth run.
    Smooth {
        /// Closely spaced points.
        nodes: Vec<Node>,
        /// Whether the start and the end are corners, where the tangent of an approximation is free.
        free: [bool; 2],
    },
}

impl Outline {
    /// The outline as lines, arcs and smooth runs, in order.
    ///
    /// Between neighbouring nodes the curve deviates from its chord by at most `spacing`.
    pub(crate) fn runs(&self, spacing: Tolerance) -> Vec<Run> {
        let jumps = self.tangent_jumps();
        let corner = |segment: usize| jumps[segment % jumps.len()] > CORNER;
        let mut runs: Vec<Run> = Vec::new();
        let mut nodes: Vec<Node> = Vec::new();
        let mut first = 0;
        let finish = |runs: &mut Vec<Run>, nodes: &mut Vec<Node>, first: usize, next: usize| {
            if nodes.is_empty() {
                return;
            }
            let run = &self.segments()[first..next];
            let Some(last) = run.iter().rev().find(|s| !s.is_null()) else {
                return;
            };
            nodes.push(Node {
                // A segment without length may follow the last one.
                point: run[run.len() - 1].end(),
                tangent: last.tangent(1.0),
            });
            runs.push(Run::Smooth {
                nodes: std::mem::take(nodes),
                free: [corner(first), corner(next)],
            });
        };
        // Every joint is a node: the checks between nodes assume a continuous curvature.
        for position in self.positions_by_segment(spacing) {
            let segment = &self.segments()[position.segment];
            let is_poly = matches!(segment, Segment::Poly(_));
            if position.u == -1.0 && (corner(position.segment) || !is_poly) {
                finish(&mut runs, &mut nodes, first, position.segment);
            }
            if is_poly {
                if nodes.is_empty() {
                    first = position.segment;
                }
                nodes.push(Node {
                    point: self.point(position),
                    tangent: segment.tangent(position.u),
                });
            } else if position.u == -1.0 {
                runs.push(Run::Exact(position.segment));
            }
        }
        finish(&mut runs, &mut nodes, first, self.segments().len());
        runs
    }
}

/// Deviation of a curve from its approximation at a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deviation {
    /// Signed distance to the left, mm.
    pub(crate) distance: f64,
    /// Change of the distance per length of the curve.
    pub(crate) slope: f64,
}

/// Upper bound, to fourth order, of the distance between two nodes that are `h` apart, mm.
///
/// It is the maximum of the cubic Hermite interpolant of the deviations at both nodes.
pub(crate) fn hermite_peak(start: Deviation, end: Deviation, h: f64) -> f64 {
    let (d0, s0, d1, s1) = (start.distance, start.slope, end.distance, end.slope);
    let mut peak = d0.abs().max(d1.abs());
    if s0 * s1 > 0.0 && (d1 - d0) * s0 > 0.0 {
        return peak;
    }
    // d(t) = d0 + a t + b t² + c t³ on [0, 1].
    let (a, end) = (s0 * h, s1 * h);
    let b = 3.0 * (d1 - d0) - 2.0 * a - end;
    let c = a + end - 2.0 * (d1 - d0);
    let root = (b * b - 3.0 * a * c).max(0.0).sqrt();
    let q = -(b + root.copysign(b));
    for t in [q / (3.0 * c), a / q] {
        if t > 0.0 && t < 1.0 {
            peak = peak.max((d0 + t * (a + t * (b + t * c))).abs());
        }
    }
    peak
}

#[cfg(test)]
mod tests {
    use crate::{Point, curve::Segment, numeric::Tolerance, region::Outline, test_shapes::rosette};

    #[test]
    fn a_segment_without_length_changes_nothing() {
        let tolerance = Tolerance::new(1e-3).expect("positive");
        let outline = rosette(40.0, 2.0, 5, Tolerance::new(1e-9).expect("positive"));
        let mut segments = outline.segments().to_vec();
        // Backwards by less than rounding, as constructions leave it.
        let p = segments[3].start();
        let q = Point::new(p.x.next_down(), p.y.next_up());
        let Segment::Poly(before) = segments[2] else {
            panic!("a polynomial")
        };
        segments[2] = before.pinned(before.start(), q).into();
        segments.insert(3, Segment::Line(q, p));
        let with_null = Outline::new(segments).expect("closed");
        assert_eq!(with_null.crossing(), None);
        assert_eq!(
            with_null.flatten(tolerance).len(),
            outline.flatten(tolerance).len()
        );
        let arcs = with_null.arcs(tolerance);
        Outline::new(arcs.segments().to_vec()).expect("closed");
        assert_eq!(
            arcs.segments().len(),
            outline.arcs(tolerance).segments().len()
        );
        assert_eq!(
            with_null.cubics(tolerance).len(),
            outline.cubics(tolerance).len()
        );
    }
}
