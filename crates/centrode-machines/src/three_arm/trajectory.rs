use std::f64::consts::TAU;

use centrode_geometry::{Vector, bracketed_root};

use super::{PointMotion, ThreeArm, ThreeArmError};

/// Extreme of the tip's path in a direction, and its input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// Carrier turn of the first arm, rad.
    pub input: f64,
    /// Reach, mm.
    pub reach: f64,
}

/// Rule by which the picking input was found.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum PickingRule {
    /// Input at which the tip reaches farthest in the direction in which arms enter the tray.
    #[default]
    Farthest,
    /// Input at which the tip passes the tray's surface on its way to the farthest reach.
    EntersTray,
    /// The design gives the input.
    Given,
}

/// Rule by which the planting input was found.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum PlantingRule {
    /// Input at which the tip is lowest.
    #[default]
    Lowest,
    /// The design gives the input.
    Given,
}

/// The tip's path in the machine's frame (the static trajectory): extremes and working points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Lowest point of the tip; its reach is the y coordinate.
    pub lowest: Extreme,
    /// Highest point of the tip.
    pub highest: Extreme,
    /// Farthest reach in the direction in which arms enter the tray.
    pub farthest: Extreme,
    /// Input at which the first arm picks, in `[0, 2 pi)`.
    pub picking: f64,
    /// Rule by which the picking input was found.
    pub picking_rule: PickingRule,
    /// Input at which the first arm plants, in `[0, 2 pi)`.
    pub planting: f64,
    /// Rule by which the planting input was found.
    pub planting_rule: PlantingRule,
}

/// Number of inputs at which extremes are sampled before they are refined to rounding.
const SAMPLES: u32 = 720;

/// Evenly spaced samples of the tip's path: input, reach in a direction (mm), derivative of the reach by the input (mm/rad).
struct ReachSamples<'a> {
    mechanism: &'a ThreeArm,
    direction: Vector,
    list: Vec<[f64; 3]>,
}

/// Motion of the tip at each sampled input.
fn tips(mechanism: &ThreeArm) -> Vec<(f64, PointMotion)> {
    let input = |i: u32| TAU * f64::from(i) / f64::from(SAMPLES);
    let look = |i| (input(i), mechanism.tip(input(i), 0));
    (0..=SAMPLES).map(look).collect()
}

impl<'a> ReachSamples<'a> {
    fn along(mechanism: &'a ThreeArm, tips: &[(f64, PointMotion)], direction: Vector) -> Self {
        let look = |(input, tip): &(f64, PointMotion)| {
            let [reach, slope] = reach(tip, &direction);
            [*input, reach, slope]
        };
        Self {
            mechanism,
            direction,
            list: tips.iter().map(look).collect(),
        }
    }

    fn at(&self, input: f64) -> [f64; 2] {
        reach(&self.mechanism.tip(input, 0), &self.direction)
    }

    /// Maximum reach if `sign` is 1, minimum if it is -1.
    fn extreme(&self, sign: f64) -> Extreme {
        let mut best = Extreme {
            input: 0.0,
            reach: -f64::INFINITY * sign,
        };
        let mut take = |input: f64, reach: f64| {
            if sign * reach > sign * best.reach {
                best = Extreme { input, reach };
            }
        };
        for pair in self.list.windows(2) {
            let [[low, reach, before], [high, _, after]] = [pair[0], pair[1]];
            take(low, reach);
            if sign * before > 0.0 && sign * after <= 0.0 {
                let slope = |input: f64| self.at(input)[1];
                let input = bracketed_root(slope, low, high, before, after);
                take(input, self.at(input)[0]);
            }
        }
        best
    }

    /// Input, before the given one, at which the reach last increases past a value.
    fn entering(&self, value: f64, before: f64) -> Option<f64> {
        let count = self.list.len() - 1;
        let start = (before / TAU * count as f64).ceil() as usize;
        let place = |i: usize| {
            let [input, reach, _] = self.list[i % count];
            (input + TAU * (i / count) as f64, reach)
        };
        (start..start + count).rev().find_map(|i| {
            let ((low, out), (high, inside)) = (place(i), place(i + 1));
            let high = high.min(before + TAU);
            if out > value || inside < value || low >= high {
                return None;
            }
            let off = |input: f64| self.at(input)[0] - value;
            let (at_low, at_high) = (off(low), off(high));
            (at_low <= 0.0 && at_high >= 0.0)
                .then(|| bracketed_root(off, low, high, at_low, at_high))
        })
    }
}

/// Reach of a point in a direction, and its speed in that direction.
fn reach(tip: &PointMotion, direction: &Vector) -> [f64; 2] {
    [
        tip.position.coords.dot(direction),
        tip.velocity.dot(direction),
    ]
}

impl Trajectory {
    pub(super) fn new(mechanism: &ThreeArm) -> Result<Self, ThreeArmError> {
        let design = mechanism.design();
        let tips = tips(mechanism);
        let upright = ReachSamples::along(mechanism, &tips, Vector::y());
        let (lowest, highest) = (upright.extreme(-1.0), upright.extreme(1.0));
        let towards = ReachSamples::along(mechanism, &tips, mechanism.tray_direction());
        let farthest = towards.extreme(1.0);
        let (picking, picking_rule) = match (design.work.picking, design.tray.distance) {
            (Some(given), _) => (given, PickingRule::Given),
            (None, None) => (farthest.input, PickingRule::Farthest),
            (None, Some(distance)) => {
                let found = towards.entering(distance, farthest.input);
                let input = found.ok_or_else(|| ThreeArmError::TrayOutOfReach {
                    distance,
                    minimum: towards.extreme(-1.0).reach,
                    maximum: farthest.reach,
                })?;
                (input, PickingRule::EntersTray)
            }
        };
        let (planting, planting_rule) = match design.work.planting {
            Some(given) => (given, PlantingRule::Given),
            None => (lowest.input, PlantingRule::Lowest),
        };
        Ok(Self {
            lowest,
            highest,
            farthest,
            picking: picking.rem_euclid(TAU),
            picking_rule,
            planting: planting.rem_euclid(TAU),
            planting_rule,
        })
    }

    /// Height of the tip's path, mm.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.highest.reach - self.lowest.reach
    }
}
