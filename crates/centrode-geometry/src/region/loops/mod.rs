//! Removal of loops from closed chains of segments, by winding numbers.

mod chain;

use crate::{
    curve::{CrossingError, Segment, SegmentRange},
    numeric::Tolerance,
};
pub(crate) use chain::Chain;

/// Maximum number of passes. Each may find loops that the previous pass uncovered: with fewer, contours with nested loops are
/// refused; more only delay the error.
const MAX_PASSES: u32 = 16;

/// Error of a closed chain that has no contour.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// Every point of the chain lies in a loop.
    #[error("nothing of its contour remains after its loops are cut off")]
    Everywhere,
    /// The crossings of two segments, or of one with itself, cannot be determined.
    #[error("the crossings of segments {} and {} of its contour cannot be determined: {cause}", .segments[0], .segments[1])]
    Unresolved {
        /// The segments, counted from 0.
        segments: [usize; 2],
        /// The cause.
        cause: CrossingError,
    },
    /// Loops remain after the maximum number of passes.
    #[error("its contour still crosses itself at segments {} and {} after its loops were cut off {MAX_PASSES} times", .segments[0], .segments[1])]
    Endless {
        /// Two segments that cross, counted from 0.
        segments: [usize; 2],
    },
    /// The crossings contradict each other: one of them was not found.
    #[error("the crossing of segments {} and {} of its contour contradicts its other crossings", .segments[0], .segments[1])]
    Inconsistent {
        /// Two segments that cross, counted from 0.
        segments: [usize; 2],
    },
}

impl SegmentRange {
    fn whole(index: usize) -> Self {
        Self {
            index,
            from: -1.0,
            to: 1.0,
        }
    }

    /// The part of `self` that remains after a second cut, in parameters of the segment.
    fn cut(&self, second: &Self) -> Self {
        let at = |u: f64| self.from + 0.5 * (1.0 + u) * (self.to - self.from);
        Self {
            index: self.index,
            from: if second.from == -1.0 {
                self.from
            } else {
                at(second.from)
            },
            to: if second.to == 1.0 {
                self.to
            } else {
                at(second.to)
            },
        }
    }
}

/// Contour of a closed chain of segments that crosses itself.
///
/// It is the outer edge of the largest region that the chain surrounds once in the given sense. Loops at undercuts and
/// cusps, and of offsets larger than the radius of curvature, run in the opposite sense or twice; they are cut off, and so
/// are separate pieces. The winding number on the left changes by one at each crossing, so the crossings alone determine the
/// edge.
///
/// # Errors
/// [`LoopError`] if there is no such region, or if the crossings of the chain cannot be determined.
pub fn without_loops(
    segments: &[Segment],
    counter_clockwise: bool,
    tolerance: Tolerance,
) -> Result<Vec<SegmentRange>, LoopError> {
    let mut left: Vec<SegmentRange> = (0..segments.len()).map(SegmentRange::whole).collect();
    let mut last = [0, 0];
    // Some crossings are found only after the loop around them is cut off.
    for _ in 0..MAX_PASSES {
        let parts: Vec<Segment> = left
            .iter()
            .map(|k| segments[k.index].part(k.from, k.to))
            .collect();
        let chain = Chain::new(&parts, tolerance);
        let named = |cause| named(cause, &left);
        let passages = chain.passages().map_err(named)?;
        if passages.all.is_empty() {
            return Ok(left);
        }
        last = [0, passages.others[0]].map(|k| left[passages.all[k].position.segment].index);
        let remaining = chain.edge(&passages, counter_clockwise);
        if remaining.is_empty() {
            return Err(LoopError::Everywhere);
        }
        left = remaining.iter().map(|k| left[k.index].cut(k)).collect();
    }
    Err(LoopError::Endless { segments: last })
}

/// An error of a chain of parts, with the indices of the whole segments.
fn named(error: LoopError, parts: &[SegmentRange]) -> LoopError {
    let own = |segments: [usize; 2]| segments.map(|i| parts[i].index);
    match error {
        LoopError::Unresolved { segments, cause } => LoopError::Unresolved {
            segments: own(segments),
            cause,
        },
        LoopError::Inconsistent { segments } => LoopError::Inconsistent {
            segments: own(segments),
        },
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    fn fine() -> Tolerance {
        Tolerance::new(1e-13).expect("positive")
    }

    #[test]
    fn a_chain_without_crossings_stays_whole() {
        let square =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(square[i], square[(i + 1) % 4]))
            .collect();
        let remaining = without_loops(&chain, true, fine()).expect("sound");
        assert_eq!(remaining.len(), 4);
    }

    #[test]
    fn a_bow_in_a_chain_is_cut_off() {
        let corners = [
            (0.0, 0.0),
            (4.0, 0.0),
            (3.0, -1.0),
            (3.0, 1.0),
            (5.0, 1.0),
            (5.0, 4.0),
            (0.0, 4.0),
        ];
        let points = corners.map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..7)
            .map(|i| Segment::Line(points[i], points[(i + 1) % 7]))
            .collect();
        let remaining = without_loops(&chain, true, fine()).expect("sound");
        let at = |k: &SegmentRange| {
            (
                chain[k.index].at(k.from).point,
                chain[k.index].at(k.to).point,
            )
        };
        assert_eq!(remaining.len(), 6);
        for pair in remaining.windows(2) {
            assert!((at(&pair[0]).1 - at(&pair[1]).0).norm() < 1e-12);
        }
        assert!((at(&remaining[0]).1 - Point::new(3.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn a_chain_that_is_not_a_number_is_an_error_that_names_the_segment() {
        let p = Point::new;
        let corners = [p(0.0, 0.0), p(4.0, 0.0), p(f64::NAN, 4.0), p(0.0, 4.0)];
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(corners[i], corners[(i + 1) % 4]))
            .collect();
        let refused = without_loops(&chain, true, fine());
        let named = LoopError::Unresolved {
            segments: [0, 1],
            cause: CrossingError::NotFinite,
        };
        assert_eq!(refused, Err(named));
    }

    #[test]
    fn a_chain_that_runs_back_on_itself_is_an_error_that_names_the_segments() {
        let p = Point::new;
        // There and back on the same arc, with a detour at either end.
        let there = crate::PolySegment::fit(|t| p(t.cos(), t.sin()), 0.0, 0.5, fine())[0];
        let (a, b) = (there.start(), there.end());
        let detour = |at: Point, y: f64| {
            let corners = [at, p(0.0, y), p(3.0, y), at];
            [0, 1, 2].map(|i| Segment::Line(corners[i], corners[i + 1]))
        };
        let mut chain = vec![Segment::Poly(there)];
        chain.extend(detour(b, 3.0));
        chain.push(Segment::Poly(there.reversed()));
        chain.extend(detour(a, -3.0));
        let refused = without_loops(&chain, true, fine());
        assert!(
            matches!(
                refused,
                Err(LoopError::Unresolved {
                    segments: [0, 4],
                    cause: CrossingError::Overlap { .. }
                })
            ),
            "{refused:?}"
        );
    }

    fn polygon(corners: &[(f64, f64)]) -> Vec<Segment> {
        let points: Vec<Point> = corners.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let next = points.iter().cycle().skip(1);
        let lines = points.iter().zip(next);
        lines.map(|(p, q)| Segment::Line(*p, *q)).collect()
    }

    fn indices(chain: &[Segment], counter_clockwise: bool) -> Result<Vec<usize>, LoopError> {
        let remaining = without_loops(chain, counter_clockwise, fine())?;
        Ok(remaining.iter().map(|k| k.index).collect())
    }

    #[test]
    fn an_eight_is_cut_to_the_lobe_of_the_given_sense() {
        let eight = polygon(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]);
        assert_eq!(indices(&eight, true), Ok(vec![0, 2, 3]));
        assert_eq!(indices(&eight, false), Ok(vec![0, 1, 2]));
    }

    #[test]
    fn a_star_is_cut_to_its_outer_edge_or_is_an_error_if_it_turns_clockwise() {
        let corner = |k: u32| {
            let angle = std::f64::consts::TAU * 2.0 * f64::from(k) / 5.0;
            (angle.cos(), angle.sin())
        };
        let star = polygon(&[0, 1, 2, 3, 4].map(corner));
        let remaining = without_loops(&star, true, fine()).expect("an edge");
        assert_eq!(remaining.len(), 10);
        let short = (remaining[0].to - remaining[0].from) / 2.0;
        assert!((short - 0.5 * (3.0 - 5_f64.sqrt())).abs() < 1e-12);
        assert_eq!(indices(&star, false), Err(LoopError::Everywhere));
    }

    #[test]
    fn a_loop_thinner_than_the_distance_at_which_windings_are_counted_is_cut_off() {
        let folded = polygon(&[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 5.0),
            (2.0, 5.0),
            (8.0, 5.0 - 3e-9),
            (0.0, 5.0 + 3e-9),
        ]);
        let remaining = without_loops(&folded, true, fine()).expect("sound");
        let indices: Vec<usize> = remaining.iter().map(|k| k.index).collect();
        assert_eq!(indices, [0, 1, 2, 4, 5]);
        let x = folded[2].at(remaining[2].to).point.x;
        assert!((x - 4.0).abs() < 1e-5, "{x}");
    }

    #[test]
    fn a_piece_behind_a_neck_whose_walls_cross_is_dropped_however_long() {
        let pinched = polygon(&[
            (0.0, -5.0),
            (10.0, -5.0),
            (10.0, -0.5),
            (14.0, 1.0),
            (18.0, -0.5),
            (18.0, -2.0),
            (22.0, -2.0),
            (22.0, 2.0),
            (18.0, 2.0),
            (18.0, 0.5),
            (14.0, -1.0),
            (10.0, 0.5),
            (10.0, 5.0),
            (0.0, 5.0),
        ]);
        assert_eq!(indices(&pinched, true), Ok(vec![0, 1, 2, 10, 11, 12, 13]));
    }
}
