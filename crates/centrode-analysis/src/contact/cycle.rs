//! Samples of a cycle, of which one period or half of one is analysed.

use std::f64::consts::TAU;

use centrode_gear::{GearPair, Member};

use super::{Contact, sample::Sample};

/// Least number of samples of a period, but for one more.
const LEAST: u32 = 24;

/// Driver angle, rad, within which samples are each other's images.
const SAME: f64 = 1e-9;

/// Samples of one cycle.
pub(super) struct Cycle {
    /// Samples a period.
    count: u32,
    /// Periods a cycle.
    periods: u32,
    is_mirrored: bool,
    /// Length of a period along the pitch curve, mm.
    length: f64,
    /// Turns of driver and driven gear in a period, rad.
    turns: [f64; 2],
}

/// Driver angle of a period, rad.
pub(super) fn period(pair: &GearPair) -> f64 {
    TAU * f64::from(pair.period()) / f64::from(pair.driver().tooth_count())
}

impl Cycle {
    pub(super) fn new(pair: &GearPair, per_pitch: u32) -> Self {
        let pitches = pair.period();
        let [driver, driven] = [pair.driver(), pair.driven()].map(|gear| gear.tooth_count());
        // One more than a multiple of the pitches: every sample is elsewhere on its tooth.
        let mut count = pitches * per_pitch.max(LEAST.div_ceil(pitches)).max(1) + 1;
        if pair.is_mirrored() {
            count += count % 2;
        }
        let pitch = pair.rolling().pitch_length(Member::Driver) / f64::from(driver);
        Self {
            count,
            periods: driver * pair.mean_ratio().0 / pitches,
            is_mirrored: pair.is_mirrored(),
            length: pitch * f64::from(pitches),
            turns: [driver, driven].map(|teeth| TAU * f64::from(pitches) / f64::from(teeth)),
        }
    }

    /// How many samples are analysed, the first ones.
    pub(super) fn analysed(&self) -> u32 {
        match self.is_mirrored {
            true => self.count / 2,
            false => self.count,
        }
    }

    /// Arc length of roll at a sample, mm: mirrored ones stand about the angle zero.
    pub(super) fn arc(&self, sample: u32) -> f64 {
        let place = f64::from(sample) + if self.is_mirrored { 0.5 } else { 0.0 };
        self.length * place / f64::from(self.count)
    }

    /// The whole cycle, of the samples analysed.
    pub(super) fn whole(&self, mut samples: Vec<Sample>) -> Contact {
        let [driver, driven] = self.turns;
        if self.is_mirrored {
            let other = samples.iter().rev();
            let other: Vec<Sample> = other.map(|s| s.mirrored().after(driver, driven)).collect();
            samples.extend(other);
        }
        let samples = &samples;
        let periods = (0..self.periods).map(f64::from);
        periods
            .flat_map(|k| samples.iter().map(move |s| s.after(k * driver, k * driven)))
            .collect()
    }
}

/// Samples of a contact of which all others are images.
#[derive(Clone, Copy)]
pub(super) struct Base {
    /// Those of the first period.
    pub(super) period: usize,
    /// Those of its first half, where the pair is its own mirror image; else those of the first period.
    pub(super) half: usize,
}

impl Base {
    pub(super) fn new(contact: &Contact, pair: &GearPair) -> Self {
        let input = &contact.input;
        let angle = period(pair);
        let count = input.iter().take_while(|&&phi| phi < angle - SAME).count();
        let is_near = |a: f64, b: f64| (a - b).abs() < SAME;
        let periods = (pair.cycle() / angle).round() as usize;
        let repeats = count * periods == input.len()
            && (count..input.len()).all(|k| is_near(input[k], input[k - count] + angle));
        let period = if repeats { count } else { input.len() };
        let is_mirrored = repeats
            && pair.is_mirrored()
            && (0..period).all(|k| is_near(input[k], angle - input[period - 1 - k]));
        Self {
            period,
            half: if is_mirrored {
                period.div_ceil(2)
            } else {
                period
            },
        }
    }

    /// Whether the pair was looked at as its own mirror image.
    pub(super) fn is_mirrored(&self) -> bool {
        self.half < self.period
    }
}
