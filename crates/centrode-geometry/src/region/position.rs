use std::cmp::Ordering;

use crate::{Point, Vector, curve::SegmentRange, region::Outline};

/// Tangent jump, rad, above which a joint is a corner. Ten times smaller, rounding makes corners of smooth joints; ten times
/// larger, arcs may pass over a visible kink.
pub(crate) const CORNER: f64 = 1e-6;

/// Position on a closed chain of segments: a segment and the parameter on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Position {
    pub(crate) segment: usize,
    pub(crate) u: f64,
}

impl Position {
    /// Order along the chain.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        let by_segment = self.segment.cmp(&other.segment);
        by_segment.then(self.u.total_cmp(&other.u))
    }

    /// Parts of the segments from this position to `end` along a closed chain of `count` segments.
    pub(crate) fn ranges_to(self, end: Self, count: usize) -> impl Iterator<Item = SegmentRange> {
        let ahead = (end.segment + count - self.segment) % count;
        let steps = if ahead == 0 && end.u <= self.u {
            count
        } else {
            ahead
        };
        (0..=steps)
            .map(move |step| SegmentRange {
                index: (self.segment + step) % count,
                from: if step == 0 { self.u } else { -1.0 },
                to: if step == steps { end.u } else { 1.0 },
            })
            .filter(|part| part.to > part.from)
    }
}

impl Outline {
    /// Point at a position, exact at the ends of a segment.
    pub(crate) fn point(&self, position: Position) -> Point {
        let segment = &self.segments()[position.segment];
        if position.u <= -1.0 {
            segment.start()
        } else if position.u >= 1.0 {
            segment.end()
        } else {
            segment.at(position.u).point
        }
    }

    /// Unsigned tangent jump at the start of each segment, rad. A segment without length is skipped and has none.
    pub(crate) fn tangent_jumps(&self) -> Vec<f64> {
        let last = self.segments().iter().rev().find(|s| !s.is_null());
        let mut before = last.map_or(Vector::x(), |s| s.tangent(1.0));
        self.segments()
            .iter()
            .map(|segment| {
                if segment.is_null() {
                    return 0.0;
                }
                let after = segment.tangent(-1.0);
                let jump = before.perp(&after).atan2(before.dot(&after)).abs();
                before = segment.tangent(1.0);
                jump
            })
            .collect()
    }
}
