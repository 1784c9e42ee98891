use std::f64::consts::{FRAC_PI_2, TAU};

use crate::Groove;

/// Half width and radius of a line along the groove's floor.
#[derive(Clone, Copy, Debug)]
pub(in crate::solid) struct Level {
    pub(in crate::solid) half: f64,
    pub(in crate::solid) radius: f64,
}

impl Level {
    /// A line along the fillet: at the angle 0 the foot of the wall, `half` off the middle; at a quarter turn the
    /// floor.
    pub(in crate::solid) fn new(half: f64, floor: f64, fillet: f64, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            half: half - fillet * (1.0 - cos),
            radius: floor + fillet * (1.0 - sin),
        }
    }
}

/// Levels from the foot of the wall along the fillet to the floor; chords between them are within `limit` (mm) of the fillet.
pub(super) fn levels(groove: &Groove, fillet: f64, limit: f64) -> Vec<Level> {
    let (half, floor) = (0.5 * groove.width(), groove.radius() - groove.depth());
    if fillet == 0.0 {
        return vec![Level {
            half,
            radius: floor,
        }];
    }
    let step = 2.0 * (1.0 - (limit / fillet).min(0.5)).acos();
    let count = (FRAC_PI_2 / step).ceil().clamp(1.0, 64.0);
    (0..=count as u32)
        .map(|i| Level::new(half, floor, fillet, FRAC_PI_2 * f64::from(i) / count))
        .collect()
}

/// Number of columns round the shaft with which a chord is within `limit` (mm) of its arc.
pub(in crate::solid) fn columns(radius: f64, limit: f64) -> u32 {
    let half = (1.0 - (limit / radius).min(0.5)).acos();
    ((FRAC_PI_2 * 2.0 / half).ceil().min(1e5) as u32).max(16)
}

/// For each turn of the groove the rise over the turn before, if it repeats that turn: on a stroke every turn has the same law.
pub(super) fn rises(groove: &Groove) -> Vec<Option<f64>> {
    let traverse = groove.traverse();
    let (stroke, reversal) = (traverse.stroke(), traverse.reversal());
    // A point of a wall belongs to a point of the centre line that is at most this angle farther round.
    let aside = 0.5 * groove.width() / groove.radius();
    let back = stroke + reversal;
    let rise = |turn: u32| {
        let first = traverse.since_start(TAU * (f64::from(turn) - 1.0) - aside);
        let last = first + 2.0 * (TAU + aside);
        let lead = traverse.law().lead();
        if last <= stroke {
            Some(lead)
        } else if first >= back && last <= back + stroke {
            Some(-lead)
        } else {
            None
        }
    };
    (0..traverse.turns()).map(rise).collect()
}
