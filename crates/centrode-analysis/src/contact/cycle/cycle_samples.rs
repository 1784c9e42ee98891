//! Driver angles of the samples of a cycle. One period or half of one is analysed, the rest is copied.

use std::f64::consts::TAU;

use centrode_gear::{GearPair, Member, PitchContact};

use super::{Contact, sample::Sample};

/// Minimum number of samples per period, before one sample is added. Fewer miss extremes of pairs with few teeth per
/// period, more take longer.
const MIN_SAMPLES: u32 = 24;

/// Difference of driver angles up to which samples count as copies, rad: above rounding, far below the distance of
/// samples.
const SAME_ANGLE: f64 = 1e-9;

/// Samples of one cycle.
pub(super) struct CycleSamples {
    /// Samples per period.
    count: u32,
    /// Periods per cycle.
    periods: u32,
    is_mirrored: bool,
    /// Length of a period along the pitch curve, mm.
    length: f64,
    /// Rotation of driver and driven gear in a period, rad.
    turns: [f64; 2],
}

/// Interval of the driver angle, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AngleInterval {
    pub(super) middle: f64,
    pub(super) half_length: f64,
}

/// Driver angle of a period, rad.
pub(super) fn period(pair: &GearPair) -> f64 {
    TAU * f64::from(pair.period()) / f64::from(pair.driver().tooth_count())
}

/// Contact of the pitch curves at a driver angle, rad.
pub(in crate::contact) fn at_angle(pair: &GearPair, phi: f64) -> PitchContact {
    let rolling = pair.rolling();
    PitchContact {
        input: phi,
        ..rolling.pitch_contact(rolling.parameter_at_angle(phi))
    }
}

impl CycleSamples {
    pub(super) fn new(pair: &GearPair, per_pitch: u32) -> Self {
        let pitches = pair.period();
        let [driver, driven] = [pair.driver(), pair.driven()].map(|gear| gear.tooth_count());
        // One more than a multiple of the pitches: each sample is at another position on its tooth.
        let mut count = pitches * per_pitch.max(MIN_SAMPLES.div_ceil(pitches)).max(1) + 1;
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

    /// Number of samples that are analysed, from the first one on.
    pub(super) fn analysed(&self) -> u32 {
        match self.is_mirrored {
            true => self.count / 2,
            false => self.count,
        }
    }

    /// Arc length of roll at a sample, mm. Mirrored samples are symmetrical about the angle zero.
    pub(super) fn arc(&self, sample: u32) -> f64 {
        let position = f64::from(sample) + if self.is_mirrored { 0.5 } else { 0.0 };
        self.length * position / f64::from(self.count)
    }

    /// The whole cycle from the analysed samples.
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

/// Numbers of distinct samples of a contact; all other samples are copies of these.
#[derive(Clone, Copy)]
pub(super) struct DistinctSamples {
    /// Samples of the first period.
    pub(super) period: usize,
    /// Samples of its first half if the pair is its own mirror image, otherwise of the first period.
    pub(super) half: usize,
}

impl DistinctSamples {
    pub(super) fn new(contact: &Contact, pair: &GearPair) -> Self {
        let input = &contact.input;
        let angle = period(pair);
        let count = input
            .iter()
            .take_while(|&&phi| phi < angle - SAME_ANGLE)
            .count();
        let is_near = |a: f64, b: f64| (a - b).abs() < SAME_ANGLE;
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

    /// Whether the samples are those of a pair that is its own mirror image.
    pub(super) fn is_mirrored(&self) -> bool {
        self.half < self.period
    }
}
