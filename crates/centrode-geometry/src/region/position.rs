use crate::{Point, Vector, region::Outline};

/// Tangent jump, rad, above which a joint is a corner rather than rounding.
pub(crate) const CORNER: f64 = 1e-6;

/// Point of an outline, by a segment and the parameter on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) segment: usize,
    pub(crate) u: f64,
}

impl Outline {
    /// Point at a place, exact at the ends of a segment.
    pub(crate) fn point(&self, place: Place) -> Point {
        let segment = &self.segments()[place.segment];
        if place.u <= -1.0 {
            segment.start()
        } else if place.u >= 1.0 {
            segment.end()
        } else {
            segment.at(place.u).point
        }
    }

    /// Unsigned tangent jump at the start of each segment, rad. A segment without length is skipped and has none.
    pub(crate) fn jumps(&self) -> Vec<f64> {
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
