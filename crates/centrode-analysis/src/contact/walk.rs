//! Steps along a period, and those at which a point of a gear passes the line of centres.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use centrode_gear::{GearPair, Member, PitchContact};
use centrode_geometry::{Point, bracketed_root, checkpoint};

use super::{
    at_angle,
    cycle::period,
    touch::{Pose, Stand},
};

/// Pitches on either side of its passage within which a point of a tooth is near the mate: for a pressure angle of 14.5 degrees
/// the edge of a full tooth touches within 1.3 of them.
const WITHIN: u32 = 2;

/// Steps a pitch.
const STEPS: u32 = 16;

/// Poses of a pair, evenly over one period and a little more on either side.
pub(super) struct Walk {
    pub(super) stand: Stand,
    /// Where the pitch curves touch, at ascending driver angles.
    pub(super) points: Vec<PitchContact>,
    pub(super) poses: Vec<Pose>,
    /// Direction of the other axis in each gear's own axes, ascending in the sense of `SENSES`.
    directions: [Vec<f64>; 2],
    /// Steps within which a point is near the mate.
    beside: usize,
}

/// Whether the direction of the other axis turns on or back in a gear's axes.
const SENSES: [f64; 2] = [1.0, -1.0];

impl Walk {
    pub(super) fn new(pair: &GearPair, stand: Stand) -> Self {
        let (steps, beside) = (pair.period() * STEPS, WITHIN * STEPS);
        let step = period(pair) / f64::from(steps);
        let inputs = (0..=steps + 2 * beside).map(|k| (f64::from(k) - f64::from(beside)) * step);
        let points: Vec<PitchContact> = inputs.map(|phi| at_angle(pair, phi)).collect();
        Self {
            stand,
            poses: points.iter().map(|p| Pose::at(pair, p, stand)).collect(),
            directions: [
                points.iter().map(|p| p.input).collect(),
                points.iter().map(|p| PI - stand.angle(pair, p)).collect(),
            ],
            beside: beside as usize,
            points,
        }
    }

    /// The walk over the first half of the period.
    pub(super) fn half(mut self) -> Self {
        let margin = 2 * self.beside;
        let count = (self.points.len() - 1 - margin).div_ceil(2) + margin + 1;
        self.points.truncate(count);
        self.poses.truncate(count);
        self.directions.iter_mut().for_each(|d| d.truncate(count));
        self
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

    /// Place between a step and the next at which a function of where the pitch curves touch, and of the pose there, changes its sign.
    pub(super) fn root(
        &self,
        pair: &GearPair,
        step: usize,
        f: impl Fn(&PitchContact, &Pose) -> f64,
    ) -> Option<PitchContact> {
        let ends = [step, step + 1].map(|k| f(&self.points[k], &self.poses[k]));
        let [low, high] = [step, step + 1].map(|k| self.points[k].parameter);
        let at = |t: f64| {
            let point = pair.rolling().pitch_contact(t);
            f(&point, &Pose::at(pair, &point, self.stand))
        };
        let differ = (ends[0] > 0.0) != (ends[1] > 0.0);
        differ.then(|| {
            let t = bracketed_root(at, low, high, ends[0], ends[1]);
            pair.rolling().pitch_contact(t)
        })
    }
}
