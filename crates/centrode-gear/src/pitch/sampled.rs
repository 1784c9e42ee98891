//! Facts about the samples that a pitch curve follows: scaling, and corners between samples.
//!
//! A spline through samples rounds every corner of the sampled law. At a corner the polynomials through the samples before it and
//! after it meet at different slopes, although the slope of each polynomial is certain.

use std::f64::consts::TAU;

use super::PitchError;
use super::noise::SampleNoise;

/// Number of samples of a polynomial on one side of a corner. With fewer samples the slope of a curved law is less certain and
/// weak corners are missed; with more samples, corners near each other are missed.
const STENCIL: usize = 5;

/// Number of polynomials on each side, each one sample farther away, that show the uncertainty of a slope.
const STENCILS: usize = 3;

/// Multiple of the uncertainty of both slopes above which their difference is a corner. At 4, narrow bumps of smooth laws are
/// taken for corners; at 40, corners between coarse samples are missed.
const SURE: f64 = 16.0;

/// Change of direction, rad, below which a corner is not reported: rounding to 1 um gives the same change.
const SLIGHT: f64 = 4e-3;

/// Share of a step within which a corner is at a sample, and by which it may lie outside of the step, by rounding.
const OUTSIDE: f64 = 0.02;

/// Corner of the law that the samples of a pitch curve follow; the curve itself rounds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledCorner {
    /// Polar angle of the corner, rad.
    pub angle: f64,
    /// Change of direction of the pitch curve there, rad, above zero where the corner is convex.
    pub turn: f64,
}

/// Mean ratio of samples and the factor that makes it the mean ratio of the pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanScaling {
    /// Mean of d driven / d driver by the samples.
    pub mean: f64,
    /// Factor by which the law is multiplied.
    pub factor: f64,
    /// Turns of driver and driven gear in one whole cycle.
    pub ratio: (u32, u32),
}

/// Facts about the samples that a pitch curve follows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampledLaw {
    /// Corners of the law that the samples follow; the curve through the samples rounds them.
    pub corners: Vec<SampledCorner>,
    /// Scaling of the samples to the mean ratio; `None` if they have that mean.
    pub scaling: Option<MeanScaling>,
    /// Noise of the samples, if it dominates the curvature of the curve.
    pub noise: Option<SampleNoise>,
}

impl SampledLaw {
    /// The error of a curve: if its samples are noisy, they are the cause.
    pub(crate) fn blamed<E: From<PitchError>>(&self, error: E) -> E {
        match self.noise {
            Some(noise) => PitchError::Noisy(noise).into(),
            None => error,
        }
    }
}

/// Corner of a function: input, value, and slopes before and after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kink {
    pub(super) at: f64,
    pub(super) value: f64,
    pub(super) slopes: [f64; 2],
}

/// Corners of a pitch curve whose radius, or radius times a constant, has these samples at ascending polar angles, rad.
pub(super) fn of_radii(samples: &[[f64; 2]]) -> Vec<SampledCorner> {
    corners(samples, |kink| kink.value)
}

/// Corners of the pitch curve of a ratio with these samples: `r = a q / (1 + q)`, so `r'/r = q'/(q (1 + q))`.
pub(super) fn of_ratios(samples: &[[f64; 2]]) -> Vec<SampledCorner> {
    corners(samples, |kink| kink.value * (1.0 + kink.value))
}

/// Corners of a pitch curve from those of a function. The function's slope over `size` is the radius's slope over the radius.
fn corners(samples: &[[f64; 2]], size: impl Fn(&Kink) -> f64) -> Vec<SampledCorner> {
    let corner = |kink: &Kink| {
        let [before, after] = kink.slopes.map(|slope| (slope / size(kink)).atan());
        SampledCorner {
            angle: kink.at.rem_euclid(TAU),
            turn: before - after,
        }
    };
    let mut found: Vec<SampledCorner> = kinks(samples)
        .iter()
        .map(corner)
        .filter(|corner| corner.turn.abs() > SLIGHT)
        .collect();
    found.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    found
}

/// Corners of a function of period one turn with samples at ascending inputs.
fn kinks(samples: &[[f64; 2]]) -> Vec<Kink> {
    let count = samples.len();
    if count < 2 * (STENCIL + STENCILS) {
        return Vec::new();
    }
    let sample = |k: isize| {
        let turn = k.div_euclid(count as isize) as f64;
        let [at, value] = samples[k.rem_euclid(count as isize) as usize];
        [at + TAU * turn, value]
    };
    let mut found: Vec<(f64, Kink)> = Vec::new();
    for k in 0..count as isize {
        let side = |sign: isize| -> Vec<[f64; 2]> {
            let first = if sign > 0 { k + 1 } else { k };
            let far = (STENCIL + STENCILS) as isize - 1;
            (0..far).map(|i| sample(first + sign * i)).collect()
        };
        found.extend(kink([&side(-1), &side(1)]));
    }
    // A corner at a sample shows in the steps before and after it: the more certain one counts.
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let step = TAU / count as f64;
    let mut kept: Vec<Kink> = Vec::new();
    for (_, kink) in found {
        let apart = |other: &Kink| {
            let off = (kink.at - other.at).rem_euclid(TAU);
            off.min(TAU - off) > step
        };
        if kept.iter().all(apart) {
            kept.push(kink);
        }
    }
    kept
}

/// The corner in the step between two rows of samples, nearest first, and its certainty; `None` if there is none.
fn kink([before, after]: [&[[f64; 2]]; 2]) -> Option<(f64, Kink)> {
    let (from, to) = (before[0][0], after[0][0]);
    let mut at = 0.5 * (from + to);
    let mut ends = [
        Jet::of(&before[..STENCIL], at),
        Jet::of(&after[..STENCIL], at),
    ];
    for _ in 0..4 {
        let [low, high] = &ends;
        let step = (high.value - low.value) / (high.slope - low.slope);
        let limit = to - from;
        at = (at - step).clamp(from - limit, to + limit);
        ends = [
            Jet::of(&before[..STENCIL], at),
            Jet::of(&after[..STENCIL], at),
        ];
    }
    let outside = OUTSIDE * (to - from);
    if !(from - outside..=to + outside).contains(&at) {
        return None;
    }
    let is_near = |sample: &f64| (at - sample).abs() < outside;
    let at = [from, to].into_iter().find(is_near).unwrap_or(at);
    let unsure = |row: &[[f64; 2]]| {
        let stencils = (0..STENCILS).map(|k| {
            let shifted = at + row[k][0] - row[0][0];
            Jet::of(&row[k..k + STENCIL], shifted).unsure
        });
        stencils.fold(0.0, f64::max)
    };
    let [low, high] = ends;
    let jump = (high.slope - low.slope).abs();
    let unsure = unsure(before) + unsure(after);
    let kink = Kink {
        at,
        value: low.value,
        slopes: [low.slope, high.slope],
    };
    (jump > SURE * unsure).then_some((jump / unsure, kink))
}

/// Value and slope of the polynomial through some samples.
struct Jet {
    value: f64,
    slope: f64,
    /// Change of the slope if the last sample is ignored.
    unsure: f64,
}

impl Jet {
    /// The polynomial through samples, nearest first, at an input: Newton's divided differences.
    fn of(samples: &[[f64; 2]], at: f64) -> Self {
        let mut differences: Vec<f64> = samples.iter().map(|sample| sample[1]).collect();
        for order in 1..samples.len() {
            for k in (order..samples.len()).rev() {
                let width = samples[k][0] - samples[k - order][0];
                differences[k] = (differences[k] - differences[k - 1]) / width;
            }
        }
        let (mut value, mut slope, mut last) = (0.0, 0.0, 0.0);
        let (mut product, mut rate) = (1.0, 0.0);
        for (difference, sample) in differences.iter().zip(samples) {
            value += difference * product;
            last = difference * rate;
            slope += last;
            let off = at - sample[0];
            (product, rate) = (product * off, rate * off + product);
        }
        Self {
            value,
            slope,
            unsure: f64::abs(last),
        }
    }
}
