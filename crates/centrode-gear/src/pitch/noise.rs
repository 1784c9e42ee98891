//! Noise of samples, and the harmonics that are above it.
//!
//! Noise is spread over all samples and over all harmonics. A corner or an unresolved bump is at few samples, and waves are in few
//! harmonics. So the noise is the smaller one of two estimates: from the median of the sixth differences of the samples, and from
//! the median power of the upper half of their harmonics. A feature that is in less than half of either changes neither median.

use std::f64::consts::LN_2;

use super::periodic::Fourier;

/// Weights of the sixth difference. Lower differences count the law itself as noise, higher ones spread a corner over more samples.
const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];

/// Median of the magnitude of a normal distribution, in standard deviations.
const NORMAL_MEDIAN: f64 = 0.6745;

/// Minimum number of samples in which noise is looked up: with fewer, few features are in half of the samples.
const FEWEST: usize = 32;

/// Root mean square of the relative curvature of a pitch curve due to noise above which samples are noisy. Peaks of noise are three
/// times as high, so they change the curvature by more than half. At 2 noise undercuts all teeth without the finding, at 0.02 tables
/// with four digits are noisy.
const MOST_CURVATURE: f64 = 0.2;

/// Probability that noise alone makes a harmonic count as part of the law: below it the remedy keeps too few harmonics.
const CHANCE: f64 = 0.01;

/// Noise of the samples of a pitch curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleNoise {
    /// Root mean square of the noise, in the unit of the samples in the design file.
    pub deviation: f64,
    /// Root mean square of the curvature that it gives the pitch curve, relative to the curvature of the pitch circle.
    pub curvature: f64,
    /// Maximum of this relative curvature.
    pub limit: f64,
    /// Highest harmonic that a smoothing should keep.
    pub harmonics: u32,
}

/// Effect of samples on a pitch curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effect {
    /// Order of the derivative of the samples that is proportional to the curvature.
    pub(super) order: i32,
    /// Relative curvature per derivative.
    pub(super) curvature: f64,
    /// Unit of the samples in the design file per unit here.
    pub(super) unit: f64,
}

/// Noise of samples at equal steps, if it dominates the curvature of their pitch curve. `highest` is the highest harmonic of the
/// curve; `None` if it goes through the samples.
pub(super) fn of_samples(
    samples: &[f64],
    highest: Option<usize>,
    effect: Effect,
) -> Option<SampleNoise> {
    let count = samples.len();
    if count < FEWEST {
        return None;
    }
    let series = Fourier::of_samples(samples, (count - 1) / 2, 1);
    let power: Vec<f64> = series
        .harmonics()
        .iter()
        .map(|[a, b]| a * a + b * b)
        .collect();
    let deviation = by_differences(samples).min(by_harmonics(&power[count / 4..], count));
    // Every harmonic of white noise has this power.
    let floor = 4.0 * deviation * deviation / count as f64;
    let curvature = |highest: usize| {
        let powers = (1..=highest).map(|n| (n as f64).powi(2 * effect.order));
        effect.curvature * (0.5 * floor * powers.sum::<f64>()).sqrt()
    };
    let found = curvature(highest.unwrap_or(count / 2));
    if found <= MOST_CURVATURE {
        return None;
    }
    let certain = floor * (power.len() as f64 / CHANCE).ln();
    let law = power
        .iter()
        .rposition(|&p| p > certain)
        .map_or(1, |k| k + 1);
    let sound = (1..=law).take_while(|&n| curvature(n) <= MOST_CURVATURE);
    Some(SampleNoise {
        deviation: deviation * effect.unit,
        curvature: found,
        limit: MOST_CURVATURE,
        harmonics: sound.last().unwrap_or(1) as u32,
    })
}

/// Standard deviation of noise with the sixth differences of samples.
fn by_differences(samples: &[f64]) -> f64 {
    let count = samples.len();
    let size = SIXTH.iter().map(|w| w * w).sum::<f64>().sqrt();
    let difference = |start: usize| {
        let terms = SIXTH.iter().enumerate();
        let sum: f64 = terms.map(|(k, w)| w * samples[(start + k) % count]).sum();
        sum.abs()
    };
    median((0..count).map(difference).collect()) / (size * NORMAL_MEDIAN)
}

/// Standard deviation of white noise in `count` samples whose harmonics have these powers.
fn by_harmonics(power: &[f64], count: usize) -> f64 {
    (median(power.to_vec()) * count as f64 / (4.0 * LN_2)).sqrt()
}

/// Median of a list; zero for an empty one.
fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list.get(list.len() / 2).copied().unwrap_or(0.0)
}
