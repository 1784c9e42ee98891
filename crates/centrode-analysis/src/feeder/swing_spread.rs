use centrode_geometry::{Vector, checkpoint};
use centrode_kinematics::linkage::{FourBar, SixBar};
use serde::{Deserialize, Serialize};

use centrode_optimise::Random;

/// Tolerances of the dimensions of a six-bar: each is uniformly distributed within plus or minus this, mm.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct SixBarTolerances {
    /// Tolerance of the four lengths.
    pub lengths: f64,
    /// Tolerance of both coordinates of the effector's pivot.
    pub pivot: f64,
}

/// Spread of the swing of six-bars made with tolerances.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct SwingSpread {
    /// Number of random six-bars.
    pub count: u32,
    /// Number of these that are not crank-rockers. The figures below omit them.
    pub failed: u32,
    /// Mean of the swing, rad.
    pub mean: f64,
    /// Standard deviation, rad.
    pub deviation: f64,
    /// Minimum swing found, rad.
    pub minimum: f64,
    /// Maximum swing found, rad.
    pub maximum: f64,
    /// Standard deviation from the sensitivities alone, rad: the root of the sum of squares of sensitivity times tolerance
    /// over root three.
    pub first_order_deviation: f64,
    /// Maximum change from the sensitivities alone, rad: all tolerances at their worst.
    pub first_order_maximum: f64,
}

impl SwingSpread {
    /// Tries `count` random six-bars; the same seed gives the same ones.
    #[must_use]
    pub fn sample(six_bar: &SixBar, tolerances: SixBarTolerances, count: u32, seed: u64) -> Self {
        let mut random = Random::new(seed, 0);
        let mut off = |t: f64| random.between(-t, t);
        let (mut swings, mut failed) = (Vec::new(), 0);
        for _ in 0..count {
            checkpoint();
            let [a, b, c, d] = six_bar
                .four_bar()
                .lengths()
                .map(|l| l + off(tolerances.lengths));
            let x = off(tolerances.pivot);
            let pivot = six_bar.pivot() + Vector::new(x, off(tolerances.pivot));
            let made = FourBar::new(a, b, c, d, six_bar.four_bar().branch())
                .ok()
                .and_then(|bar| SixBar::new(bar, pivot, six_bar.effector_length()).ok());
            match made {
                Some(made) => swings.push(made.swing()),
                None => failed += 1,
            }
        }
        let made = swings.len() as f64;
        let mean = swings.iter().sum::<f64>() / made;
        let variance = swings.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (made - 1.0);
        let sensitivity = six_bar.swing_sensitivity();
        let worst = [
            sensitivity
                .lengths
                .map(|s| s * tolerances.lengths)
                .as_slice(),
            (sensitivity.pivot * tolerances.pivot).as_slice(),
        ]
        .concat();
        Self {
            count,
            failed,
            mean,
            deviation: variance.sqrt(),
            minimum: swings.iter().copied().fold(f64::INFINITY, f64::min),
            maximum: swings.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            first_order_deviation: (worst.iter().map(|w| w * w).sum::<f64>() / 3.0).sqrt(),
            first_order_maximum: worst.iter().map(|w| w.abs()).sum(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use centrode_kinematics::linkage::Branch;

    use super::*;

    #[test]
    fn a_small_spread_is_that_of_first_order() {
        let bar = FourBar::new(77.0, 147.0, 127.0, 105.0, Branch::Upper).expect("lengths");
        let dead = bar.dead_centers().expect("a crank-rocker");
        let pivot = nalgebra::center(&dead.stretched_at, &dead.folded_at);
        let six_bar = SixBar::new(bar, pivot, 200.0).expect("a six-bar");
        let tolerances = SixBarTolerances {
            lengths: 0.01,
            pivot: 0.02,
        };
        let spread = SwingSpread::sample(&six_bar, tolerances, 20_000, 7);
        assert_eq!(spread, SwingSpread::sample(&six_bar, tolerances, 20_000, 7));
        assert_ne!(spread, SwingSpread::sample(&six_bar, tolerances, 20_000, 8));
        assert_eq!(spread.failed, 0);
        assert!((spread.mean - PI).abs() < 0.02 * spread.deviation);
        assert!((spread.deviation / spread.first_order_deviation - 1.0).abs() < 0.02);
        assert!(spread.maximum - PI < 1.01 * spread.first_order_maximum);
        assert!(PI - spread.minimum < 1.01 * spread.first_order_maximum);
        assert!(spread.maximum - PI > 0.6 * spread.first_order_maximum);
    }
}
