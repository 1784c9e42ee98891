//! Rate of change of a formula, so that no narrow feature is missed.

use super::{Formula, Taylor};
use centrode_geometry::WRITTEN;

/// Samples per turn of any formula.
const FEWEST: usize = 512;

/// Maximum number of samples: a bump is found if one of them lies within seven of its widths.
const MOST: usize = 1 << 18;

/// Features slower than this rate, 1/rad, are resolved by the default partition.
const GENTLE: f64 = 12.0;

/// Length of a part, as a multiple of the width of the narrowest feature.
const PART: f64 = 24.0;

/// The number of intervals is a multiple of this, so that the partition repeats with the formula.
const PARTS: usize = 60;

/// Maximum number of parts of a turn.
const MAX_PARTS: usize = 1200;

/// A formula with features too narrow to be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steep {
    /// Approximate width of the narrowest feature, rad.
    pub width: f64,
    /// Minimum width of a feature that can be followed, rad.
    pub minimum: f64,
}

/// Range and slopes of a value inside a formula along a turn.
#[derive(Clone, Copy)]
struct Course {
    low: f64,
    high: f64,
    /// Maximum slope: the derivative, or the chord between neighbouring samples.
    steepest: f64,
    last: f64,
}

impl Course {
    const NONE: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        steepest: 0.0,
        last: f64::NAN,
    };

    fn pass(&mut self, value: f64, slope: f64, step: f64) {
        let chord = (value - self.last) / step;
        // Values that are NaN are ignored by `max` and `min`.
        self.steepest = self.steepest.max(slope.abs()).max(chord.abs());
        (self.low, self.high) = (self.low.min(value), self.high.max(value));
        self.last = value;
    }

    /// Maximum slope, relative to the range, 1/rad; zero if it is not finite or if the range is within rounding.
    fn rate(&self) -> f64 {
        let range = self.high - self.low;
        let rate = self.steepest / range;
        let changes = range > WRITTEN * self.high.abs().max(self.low.abs());
        if changes && rate.is_finite() {
            rate
        } else {
            0.0
        }
    }
}

impl Formula {
    /// Ends, inside a turn, of equal parts in each of which the formula has no feature that is narrow compared with the part;
    /// empty if the formula has no such features at all.
    ///
    /// A bump, as of `exp(-700*(1-cos(5*phi)))`, is nearly zero with all its derivatives a few widths away. Its width follows
    /// from the slopes of every function, product and quotient in the formula, relative to their ranges. The number of samples
    /// follows from the rates of the functions' arguments.
    ///
    /// # Errors
    /// [`Steep`] for a feature too narrow to be followed.
    pub fn parts(&self, turn: f64) -> Result<Vec<f64>, Steep> {
        let mut count = FEWEST;
        let rate = loop {
            let [argument, value] = self.rates(turn, count);
            let required = ((2.0 * argument * turn) as usize).min(MOST);
            if count >= required {
                break value;
            }
            count = required.max(2 * count);
        };
        let parts = turn * rate / PART;
        if parts > MAX_PARTS as f64 {
            return Err(Steep {
                width: 1.0 / rate,
                minimum: turn / (PART * MAX_PARTS as f64),
            });
        }
        if rate <= GENTLE {
            return Ok(Vec::new());
        }
        let count = (parts / PARTS as f64).ceil() as usize * PARTS;
        Ok((1..count).map(|k| turn * k as f64 / count as f64).collect())
    }

    /// Maximum rates, 1/rad, at equal steps of a turn: of the argument of a quick function, and of a value relative to its range.
    fn rates(&self, turn: f64, count: usize) -> [f64; 2] {
        let step = turn / count as f64;
        let mut courses = vec![Course::NONE; self.program.len()];
        let mut argument = 0.0_f64;
        for k in 0..=count {
            let seen = |place: usize, of: Option<&Taylor>, value: &Taylor| {
                let rate = of.map_or(0.0, |of| of.0[1].abs());
                // If the function has no value, its argument does not count.
                if rate.is_finite() && value.0[0].is_finite() {
                    argument = argument.max(rate);
                }
                courses[place].pass(value.0[0], value.0[1], step);
            };
            self.run(step * k as f64, seen);
        }
        let value = courses.iter().map(Course::rate).fold(0.0, f64::max);
        [argument, value]
    }
}
