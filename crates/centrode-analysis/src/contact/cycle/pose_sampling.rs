//! Poses along a period with the driven gear as the law gives it, and the steps at which a point of a gear passes the line of centres.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use centrode_gear::{GearPair, Member, PitchContact};
use centrode_geometry::{Point, bracketed_root, checkpoint};

use super::{
    backlash_position::BacklashPosition,
    cycle_samples::{at_angle, period},
};
use crate::contact::contour::Pose;

/// Pitches before and after its passage within which a point of a tooth is near the mate. The edge of a full tooth touches within 1.3
/// pitches at a pressure angle of 14.5 degrees. More takes longer, less misses contacts.
const PITCHES_NEAR_MATE: u32 = 2;

/// Steps per pitch. More takes longer; with fewer two sign changes can fall into one step.
const POSES_PER_PITCH: u32 = 16;

/// Poses of a pair, evenly spaced over one period and a margin on either side.
pub(super) struct PoseSampling {
    pub(super) position: BacklashPosition,
    /// Contact of the pitch curves per step, at ascending driver angles.
    pub(super) points: Vec<PitchContact>,
    pub(super) poses: Vec<Pose>,
    /// Direction of the other axis in each gear's own axes, rad, ascending in the sense of `SENSES`.
    directions: [Vec<f64>; 2],
    /// Steps of the margin: within them a point is near the mate.
    margin: usize,
}

/// Sense in which the direction of the other axis turns in the axes of driver and driven gear.
const SENSES: [f64; 2] = [1.0, -1.0];

impl PoseSampling {
    pub(super) fn new(pair: &GearPair, position: BacklashPosition) -> Self {
        let (steps, margin) = (
            pair.period() * POSES_PER_PITCH,
            PITCHES_NEAR_MATE * POSES_PER_PITCH,
        );
        let step = period(pair) / f64::from(steps);
        let inputs = (0..=steps + 2 * margin).map(|k| (f64::from(k) - f64::from(margin)) * step);
        let points: Vec<PitchContact> = inputs.map(|phi| at_angle(pair, phi)).collect();
        Self {
            position,
            poses: points.iter().map(|p| position.pose(pair, p)).collect(),
            directions: [
                points.iter().map(|p| p.input).collect(),
                points
                    .iter()
                    .map(|p| PI - position.angle(pair, p))
                    .collect(),
            ],
            margin: margin as usize,
            points,
        }
    }

    /// The poses of the first half of the period.
    pub(super) fn half(mut self) -> Self {
        let both = 2 * self.margin;
        let count = (self.points.len() - 1 - both).div_ceil(2) + both + 1;
        self.points.truncate(count);
        self.poses.truncate(count);
        self.directions.iter_mut().for_each(|d| d.truncate(count));
        self
    }

    /// Steps near the mate per passage of a gear's point across the line of centres.
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
                middle.saturating_sub(self.margin)..(middle + self.margin).min(last)
            })
    }

    /// Contact of the pitch curves between `step` and the next one at which `f`, a function of contact and pose, changes its
    /// sign.
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
            f(&point, &self.position.pose(pair, &point))
        };
        let differ = (ends[0] > 0.0) != (ends[1] > 0.0);
        differ.then(|| {
            let t = bracketed_root(at, low, high, ends[0], ends[1]);
            pair.rolling().pitch_contact(t)
        })
    }
}
