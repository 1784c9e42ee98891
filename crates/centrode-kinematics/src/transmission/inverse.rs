use std::sync::Arc;

use super::{MotionJet, Transmission, TransmissionError, sorted};

/// Newton step, relative to the distance of two samples, below which its cube is within rounding.
const SMALL: f64 = 1e-5;
/// Permitted rounding error of an input, relative to the period.
const ROUNDING: f64 = 0.25 * f64::EPSILON;

/// Inverse of a transmission that always advances: the input as a function of the position.
#[derive(Clone, Debug)]
pub struct Inverse {
    of: Arc<dyn Transmission>,
    /// Samples: inputs from 0 to the period, breaks among them, each with the position and velocity there.
    looks: Vec<(f64, f64, f64)>,
}

impl Inverse {
    /// Inverts a transmission that runs in one direction.
    ///
    /// # Errors
    /// [`TransmissionError::StandsStill`] if its velocity is zero or against its advance at one of a thousand sampled inputs or
    /// at a break.
    pub fn new(of: Arc<dyn Transmission>) -> Result<Self, TransmissionError> {
        const SAMPLES: u32 = 1000;
        let (period, way) = (of.period(), of.advance().signum());
        let even = (0..=SAMPLES).map(|i| period * f64::from(i) / f64::from(SAMPLES));
        let mut inputs: Vec<f64> = even.chain(of.breaks()).collect();
        inputs.retain(|input| (0.0..=period).contains(input));
        inputs.sort_by(f64::total_cmp);
        let mut looks = Vec::with_capacity(inputs.len());
        for input in inputs {
            let MotionJet {
                position, velocity, ..
            } = of.at(input);
            if of.advance() == 0.0 || velocity * way <= 0.0 || velocity.is_nan() {
                return Err(TransmissionError::StandsStill { input, velocity });
            }
            looks.push((input, position, velocity));
        }
        Ok(Self { of, looks })
    }

    /// The input within a period at which the position is reached, by Newton steps between the two samples around it.
    fn input(&self, position: f64) -> f64 {
        let way = self.of.advance().signum();
        let before = |look: &(f64, f64, f64)| (look.1 - position) * way <= 0.0;
        let index = self.looks.partition_point(before);
        let index = index.clamp(1, self.looks.len() - 1);
        let (mut low, at_low, slope) = self.looks[index - 1];
        let (mut high, at_high, slope_high) = self.looks[index];
        // Start at the cubic through both samples, with the input as a function of the position.
        let (span, share) = (at_high - at_low, (position - at_low) / (at_high - at_low));
        let width = high - low;
        let [enter, leave] = [span / slope, span / slope_high].map(|rate| rate - width);
        let bow = (1.0 - share) * (enter * (1.0 - share) - leave * share);
        let mut input = (low + share * (width + bow)).clamp(low, high);
        while low < high {
            let jet = self.of.at(input);
            let off = jet.position - position;
            let step = off / jet.velocity;
            if step >= 0.0 {
                high = input;
            }
            if step <= 0.0 {
                low = input;
            }
            // The next step would be half the square of this one times acceleration over velocity.
            let next = 0.5 * step * step * (jet.acceleration / jet.velocity).abs();
            let small = step.abs() <= SMALL * width && next <= ROUNDING * self.of.period();
            if small || step.is_nan() {
                return input - step;
            }
            input -= step;
            if input <= low || input >= high {
                input = 0.5 * (low + high);
                if input <= low || input >= high {
                    break;
                }
            }
        }
        input
    }
}

impl Transmission for Inverse {
    fn at(&self, position: f64) -> MotionJet {
        let (period, advance) = (self.of.period(), self.of.advance());
        let turns = ((position - self.looks[0].1) / advance).floor();
        let input = self.input(position - turns * advance);
        self.of.at(input).inverse(input + turns * period)
    }

    fn period(&self) -> f64 {
        self.of.advance().abs()
    }

    fn advance(&self) -> f64 {
        self.of.period().copysign(self.of.advance())
    }

    fn breaks(&self) -> Vec<f64> {
        let period = self.period();
        let breaks = self.of.breaks().into_iter();
        sorted(
            breaks.map(|b| self.of.at(b).position.rem_euclid(period)),
            period,
        )
    }
}
