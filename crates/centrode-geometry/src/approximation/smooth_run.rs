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

/// Smooth part of an outline, as long as can be, as closely spaced nodes.
///
/// A line or an arc is a run of its own, which is kept exactly.
#[derive(Debug)]
pub(crate) enum Run {
    /// Index of the segment.
    Kept(usize),
    Smooth {
        nodes: Vec<Node>,
        /// Whether the tangent at the start and at the end is free, the joint there being a corner.
        free: [bool; 2],
    },
}

impl Outline {
    /// The outline as lines, arcs and smooth runs, in order.
    ///
    /// Between neighbouring nodes the curve leaves its chord by at most `spacing`.
    pub(crate) fn runs(&self, spacing: Tolerance) -> Vec<Run> {
        let jumps = self.jumps();
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
                // A segment without length may lie between.
                point: run[run.len() - 1].end(),
                tangent: last.tangent(1.0),
            });
            runs.push(Run::Smooth {
                nodes: std::mem::take(nodes),
                free: [corner(first), corner(next)],
            });
        };
        // A step over a joint could hide a jump of the curvature from the checks between nodes.
        for place in self.places_by_segment(spacing) {
            let segment = &self.segments()[place.segment];
            let is_poly = matches!(segment, Segment::Poly(_));
            if place.u == -1.0 && (corner(place.segment) || !is_poly) {
                finish(&mut runs, &mut nodes, first, place.segment);
            }
            if is_poly {
                if nodes.is_empty() {
                    first = place.segment;
                }
                nodes.push(Node {
                    point: self.point(place),
                    tangent: segment.tangent(place.u),
                });
            } else if place.u == -1.0 {
                runs.push(Run::Kept(place.segment));
            }
        }
        finish(&mut runs, &mut nodes, first, self.segments().len());
        runs
    }
}

/// Upper bound, to fourth order, of `|d|` over a step of length `h`: the extremes of the cubic Hermite interpolant of
/// its values and slopes at the ends.
pub(crate) fn hermite_peak(d0: f64, s0: f64, d1: f64, s1: f64, h: f64) -> f64 {
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
