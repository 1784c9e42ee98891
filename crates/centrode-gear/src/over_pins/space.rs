//! Space between two teeth, and the pin that comes to rest in it.

use centrode_geometry::{Point, Segment, Vector, bracketed_minimum, bracketed_root, checkpoint};

use super::{Pin, PinFault};
use crate::pair::Gear;
use crate::profile::Role;
use crate::rolling::Member;

impl Gear {
    /// Flanks on both sides of every space, in the order of the teeth.
    pub(super) fn spaces(&self) -> Vec<Option<Walls<'_>>> {
        let teeth = self.tooth_count() as usize;
        let mut flanks: Vec<[Vec<&Segment>; 2]> = vec![Default::default(); teeth];
        let segments = self.outline().segments();
        let count = segments.len();
        for (k, sides) in flanks.iter_mut().enumerate() {
            checkpoint();
            // The segments of one tooth are contiguous, from the first that does not follow one of its own.
            let own = |i: usize| self.owners()[i % count] as usize == k;
            let Some(first) = (0..count).find(|&i| own(i) && !own(i + count - 1)) else {
                continue;
            };
            let run: Vec<usize> = (first..first + count)
                .take_while(|&i| own(i))
                .map(|i| i % count)
                .collect();
            let crest = crest(&run, segments, self.roles());
            for (place, &i) in run.iter().enumerate() {
                if self.roles()[i] == Role::Flank {
                    sides[usize::from(place >= crest)].push(&segments[i]);
                }
            }
        }
        (0..teeth)
            .map(|k| {
                let next = (k + 1) % teeth;
                // The contour runs counter-clockwise; the driven gear's teeth are numbered in the opposite direction.
                let (before, after) = match self.member() {
                    Member::Driver => (k, next),
                    Member::Driven => (next, k),
                };
                let down = flanks[before][1].clone();
                let up = flanks[after][0].clone();
                (!down.is_empty() && !up.is_empty()).then_some(Walls { down, up })
            })
            .collect()
    }
}

/// Index in a tooth's run of segments at which its first flank ends: at the tip, or at the sharpest corner of a
/// pointed tooth.
fn crest(run: &[usize], segments: &[Segment], roles: &[Role]) -> usize {
    if let Some(tip) = run.iter().position(|&i| roles[i] == Role::Tip) {
        return tip;
    }
    let turn = |a: usize, b: usize| {
        let (before, after) = (segments[a].at(1.0).first, segments[b].at(-1.0).first);
        before.perp(&after).atan2(before.dot(&after))
    };
    let joints = run.windows(2).enumerate();
    joints
        .map(|(place, w)| (place + 1, turn(w[0], w[1])))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(place, _)| place)
}

/// The two flanks of a space, each traversed counter-clockwise round the gear: one goes down, one up.
#[derive(Clone, Debug)]
pub(super) struct Walls<'a> {
    down: Vec<&'a Segment>,
    up: Vec<&'a Segment>,
}

/// Number of samples per segment at which signs are compared. Fewer can miss two changes of sign within a step, more
/// take longer.
const SAMPLES: u32 = 12;

impl Walls<'_> {
    /// The outermost pin that touches both flanks.
    pub(super) fn rest(&self, radius: f64) -> Result<Pin, PinFault> {
        // Along the descending flank, from its tip down: the pin that touches it there, and the distance of that pin from the
        // other flank.
        let ends = self.down.len() as f64;
        let pin = |t: f64| offset(&self.down, t, radius);
        let gap = |t: f64| distance(&self.up, pin(t).1).1 - radius;
        let count = SAMPLES * self.down.len() as u32;
        let at = |i: u32| ends * f64::from(i) / f64::from(count);
        let mut before = gap(0.0);
        if before < 0.0 {
            return Err(PinFault::TooLarge);
        }
        for i in 1..=count {
            let here = gap(at(i));
            if here <= 0.0 {
                let t = bracketed_root(gap, at(i - 1), at(i), before, here);
                let (touched, center) = pin(t);
                let (u, _) = distance(&self.up, center);
                return self.resting(center, touched, u, radius);
            }
            before = here;
        }
        Err(PinFault::TooSmall)
    }

    fn resting(&self, center: Point, touched: Point, u: f64, radius: f64) -> Result<Pin, PinFault> {
        let (other, jet) = along(&self.up, u);
        // At an end of the flank the pin rests on its corner, not on the flank.
        let slant = (center - other).dot(&jet) / (radius * jet.norm());
        if slant.abs() > 1e-6 {
            return Err(if u > 0.5 * self.up.len() as f64 {
                PinFault::TooLarge
            } else {
                PinFault::TooSmall
            });
        }
        Ok(Pin {
            center,
            contacts: [touched, other],
            radial: center.coords.norm() + radius,
        })
    }
}

/// Point and derivative of a chain of segments at `t`, whose integer part is the index of the segment.
fn along(chain: &[&Segment], t: f64) -> (Point, Vector) {
    let index = (t.max(0.0) as usize).min(chain.len() - 1);
    let jet = chain[index].at(2.0 * (t - index as f64) - 1.0);
    (jet.point, jet.first)
}

/// The point of a chain at `t`, and the point at the distance `radius` from it, outside the material.
fn offset(chain: &[&Segment], t: f64, radius: f64) -> (Point, Point) {
    let (point, first) = along(chain, t);
    let outward = Vector::new(first.y, -first.x).normalize();
    (point, point + outward * radius)
}

/// Parameter and distance of a chain's nearest point.
fn distance(chain: &[&Segment], from: Point) -> (f64, f64) {
    let f = |t: f64| (along(chain, t).0 - from).norm();
    let count = SAMPLES * chain.len() as u32;
    let at = |i: u32| chain.len() as f64 * f64::from(i) / f64::from(count);
    let nearest = (0..=count).min_by(|&a, &b| f(at(a)).total_cmp(&f(at(b))));
    let i = nearest.unwrap_or(0);
    let (low, high) = (at(i.saturating_sub(1)), at((i + 1).min(count)));
    let (t, value) = bracketed_minimum(f, low, high);
    // A minimum at the very end of a chain is not inside any bracket.
    [(low, f(low)), (high, f(high))]
        .into_iter()
        .fold(
            (t, value),
            |best, end| if end.1 < best.1 { end } else { best },
        )
}
