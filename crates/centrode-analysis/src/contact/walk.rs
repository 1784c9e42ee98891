//! Steps along a period, and those at which a point of a gear passes the line of centres.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use centrode_geometry::{Point, bracketed_root, checkpoint};
use centrode_mechanism::gear::{GearPair, Member};

use super::{
    cycle::period,
    touch::{Pose, Stand},
};

/// Pitches on either side of its passage within which a point of a tooth is near the mate: for a pressure angle of 14.5 degrees
/// the edge of a full tooth touches within 1.3 of them.
const WITHIN: u32 = 2;

/// Poses of a pair, evenly over one period and a little more on either side.
pub(super) struct Walk {
    pub(super) stand: Stand,
    /// Driver angles, rad, ascending.
    pub(super) inputs: Vec<f64>,
    pub(super) poses: Vec<Pose>,
    /// Direction of the other axis in each gear's own axes, ascending in the sense of `SENSES`.
    directions: [Vec<f64>; 2],
    /// Steps within which a point is near the mate.
    beside: usize,
}

/// Whether the direction of the other axis turns on or back in a gear's axes.
const SENSES: [f64; 2] = [1.0, -1.0];

impl Walk {
    pub(super) fn new(pair: &GearPair, stand: Stand, steps_per_pitch: u32) -> Self {
        let (steps, beside) = (pair.period() * steps_per_pitch, WITHIN * steps_per_pitch);
        let step = period(pair) / f64::from(steps);
        let inputs = (0..=steps + 2 * beside).map(|k| (f64::from(k) - f64::from(beside)) * step);
        let inputs: Vec<f64> = inputs.collect();
        let turned: Vec<f64> = inputs.iter().map(|&phi| stand.at(pair, phi)).collect();
        let a = pair.center_distance();
        let both = || inputs.iter().zip(&turned);
        Self {
            stand,
            poses: both().map(|(&phi, &psi)| Pose::new(phi, psi, a)).collect(),
            directions: [inputs.clone(), turned.iter().map(|psi| PI - psi).collect()],
            beside: beside as usize,
            inputs,
        }
    }

    /// Steps from the first to before the last of every passage of a gear's point by the line of centres.
    pub(super) fn passages(
        &self,
        member: Member,
        point: Point,
    ) -> impl Iterator<Item = Range<usize>> {
        let sense = SENSES[member as usize];
        let directions = &self.directions[member as usize];
        let last = directions.len() - 1;
        let [first, end] = [directions[0], directions[last]].map(|d| sense * d);
        let own = sense * point.y.atan2(point.x);
        let start = own + TAU * ((first - own) / TAU).ceil();
        (0_u32..)
            .map(move |turn| start + TAU * f64::from(turn))
            .take_while(move |&direction| direction < end)
            .map(move |direction| {
                checkpoint();
                let middle = directions.partition_point(|d| sense * d < direction);
                middle.saturating_sub(self.beside)..(middle + self.beside).min(last)
            })
    }

    /// Inputs between steps at which a function that is known at every step changes its sign.
    pub(super) fn roots(
        &self,
        steps: Range<usize>,
        at_step: impl Fn(usize) -> f64,
        at: impl Fn(f64) -> f64,
    ) -> impl Iterator<Item = f64> {
        steps.filter_map(move |k| {
            let [f, g] = [k, k + 1].map(&at_step);
            let (low, high) = (self.inputs[k], self.inputs[k + 1]);
            ((f > 0.0) != (g > 0.0)).then(|| bracketed_root(&at, low, high, f, g))
        })
    }
}
