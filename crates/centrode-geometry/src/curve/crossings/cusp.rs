use super::{Part, Resolution};
use crate::numeric::{COMPUTED, bracketed_root};

/// Half-angle, rad, below which the two sides of a cusp are compared. Larger sides may fold over the direction in which they
/// are compared; ten times smaller only halves them more often.
const NARROW: f64 = 0.25;

/// Ratio of consecutive distances from a cusp at which its sides are compared. Nearer to 1, a thinner lens between them is found.
const CUSP_STEP: f64 = 0.8;

/// Distance from a cusp, relative to the length of its sides, below which the sides may be within rounding of each other.
const CUSP_END: f64 = 1e-2;

impl Part<'_> {
    /// Whether another part turns back at the end of this one, and both parts separate to one side over their length.
    pub(super) fn parts_from(&self, next: &Self, resolution: Resolution) -> bool {
        let Some(band) = resolution.cusp else {
            return false;
        };
        let along = -self.span.segment.tangent(self.span.u[1]);
        let is_narrow = |part: &Self| {
            part.cone
                .is_some_and(|cone| cone.half[1] < NARROW * cone.half[0])
        };
        let is_cusp = along.dot(&next.span.segment.tangent(next.span.u[0])) > NARROW.cos();
        if !(is_cusp && is_narrow(self) && is_narrow(next)) {
            return false;
        }
        let joint = self.span.ends[1];
        let lengths = [self.span.ends[0], next.span.ends[1]].map(|end| along.dot(&(end - joint)));
        let shorter = lengths[0].min(lengths[1]) * (1.0 - COMPUTED);
        // Offset of a side from the direction `along`, at a distance from the joint.
        let offset = |part: &Self, s: f64| {
            let from_joint = |u: f64| part.span.segment.at(u).point - joint;
            let ahead = |u: f64| along.dot(&from_joint(u)) - s;
            let [from, to] = part.span.u;
            let u = bracketed_root(ahead, from, to, ahead(from), ahead(to));
            along.perp(&from_joint(u))
        };
        let rounding = resolution.gap;
        let distances = std::iter::successors(Some(shorter), |s| Some(CUSP_STEP * s));
        let mut gaps = distances
            .map(|s| (s, offset(next, s) - offset(self, s)))
            .take_while(|(s, _)| *s > rounding);
        let (mut side, close) = (0.0, rounding.max(band));
        for (s, gap) in gaps.by_ref() {
            if gap.abs() <= close {
                // Sides that stay within rounding over a long distance lie on each other.
                let mut rest = || band > 0.0 && gaps.all(|(_, gap)| gap.abs() <= close);
                return side != 0.0 && (s < CUSP_END * shorter || rest());
            }
            if side * gap < 0.0 {
                return false;
            }
            side = gap;
        }
        side != 0.0 && rounding < CUSP_END * shorter
    }
}
