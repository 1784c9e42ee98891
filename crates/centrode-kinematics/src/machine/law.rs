use centrode_geometry::{chebyshev_roots, chebyshev_series};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::transmission::{MotionJet, Transmission};

/// A joint that stays at one position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant(pub f64);

impl Transmission for Constant {
    fn at(&self, _input: f64) -> MotionJet {
        MotionJet::at_rest(self.0)
    }
}

/// A position proportional to the input: belts, chains, ordinary gears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Position at input zero.
    pub start: f64,
    /// Change of position per radian of the input.
    pub slope: f64,
}

impl Linear {
    /// A position at input zero, and its change by a radian of the input.
    #[must_use]
    pub fn new(start: f64, slope: f64) -> Self {
        Self { start, slope }
    }
}

impl Transmission for Linear {
    fn at(&self, input: f64) -> MotionJet {
        MotionJet::uniform(self.start + self.slope * input, self.slope)
    }

    fn advance(&self) -> f64 {
        self.slope * self.period()
    }
}

/// Coefficients of a piece.
const COUNT: usize = centrode_geometry::CHEBYSHEV_TERMS;
/// Permitted error of a piece, relative to the size of the law: the law's own rounding.
const ROUNDING: f64 = 4e-15;
/// Tail of a series, relative to the size of the law, below which it counts as noise if halving does not reduce it.
const NOISE: f64 = 1e-9;
/// Shortest piece, as a share of the period: a shorter one would contain a jump.
const SHORTEST: f64 = 1e-9;

/// A transmission as a straight line plus Chebyshev pieces of the rest, equal to the original within rounding.
///
/// Source: Trefethen, Approximation Theory and Approximation Practice, 2013, chapters 3 and 4.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Piecewise {
    /// Input after which it repeats, rad.
    period: f64,
    /// Growth over a period.
    advance: f64,
    /// Inputs at which a derivative may jump.
    breaks: Vec<f64>,
    /// Ends of the pieces, from 0 to the period.
    ends: Vec<f64>,
    /// Chebyshev coefficients of each piece of the law less its mean growth.
    pub(super) pieces: Vec<Vec<f64>>,
}

impl Piecewise {
    /// The pieces of a transmission: cut at its breaks, then halved until the series have decayed to rounding.
    #[must_use]
    pub fn fit<T: Transmission + ?Sized>(law: &T) -> Self {
        let period = law.period();
        let breaks = law.breaks();
        // A break within rounding of another one, or of an end, leaves no piece whose derivatives mean anything.
        let apart = |b: &&f64| **b > SHORTEST * period && **b < (1.0 - SHORTEST) * period;
        let inside: Vec<f64> = breaks.iter().filter(apart).copied().collect();
        let mut cuts = centrode_geometry::piece_ends(0.0, period, 1, &inside);
        cuts.dedup_by(|b, a| *b - *a <= SHORTEST * period);
        let slope = law.advance() / period;
        let rest = |input: f64| law.at(input).position - slope * input;
        let size = cuts.iter().map(|&cut| rest(cut).abs());
        let size = size.fold(0.0, f64::max);
        let places = cuts.iter().map(|&cut| law.at(cut).position.abs());
        let rounding = 4.0 * f64::EPSILON * places.fold(0.0, f64::max);
        // Ends of the intervals still to be fitted, each with the tail of the series over the interval that was halved.
        let whole = |w: &[f64]| (w[0], w[1], f64::INFINITY);
        let mut open: Vec<(f64, f64, f64)> = cuts.windows(2).rev().map(whole).collect();
        let (mut ends, mut pieces) = (vec![0.0], Vec::new());
        while let Some((from, to, before)) = open.pop() {
            centrode_geometry::checkpoint();
            let piece = chebyshev_series(&chebyshev_roots(from, to).map(rest));
            let scale = piece.iter().fold(size, |m, c| m.max(c.abs()));
            let tail: f64 = piece[COUNT - 3..].iter().map(|c| c.abs()).sum();
            let decays = tail < 0.5 * before || tail > NOISE * scale;
            let within = tail <= (ROUNDING * scale).max(rounding);
            if !within && decays && to - from > SHORTEST * period {
                let middle = 0.5 * (from + to);
                open.extend([(middle, to, tail), (from, middle, tail)]);
                continue;
            }
            let kept = piece.iter().rposition(|&c| c != 0.0).map_or(1, |i| i + 1);
            pieces.push(piece[..kept].to_vec());
            ends.push(to);
        }
        Self {
            period,
            advance: law.advance(),
            breaks,
            ends,
            pieces,
        }
    }

    /// Inputs at which one piece ends and the next starts, from 0 to the period, rad.
    #[must_use]
    pub fn ends(&self) -> &[f64] {
        &self.ends
    }

    /// Whether it can be evaluated: a period, ends that ascend from 0 to the period, and a piece between any two ends.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let ascends = self.ends.windows(2).all(|w| w[0] < w[1]);
        let ends = [self.ends.first(), self.ends.last()] == [Some(&0.0), Some(&self.period)];
        let finite = |list: &Vec<f64>| !list.is_empty() && list.iter().all(|c| c.is_finite());
        ascends
            && ends
            && self.period > 0.0
            && self.advance.is_finite()
            && self.pieces.len() + 1 == self.ends.len()
            && finite(&self.ends)
            && self.breaks.iter().all(|b| b.is_finite())
            && self.pieces.iter().all(finite)
    }
}

/// Value and first three derivatives of a Chebyshev series by Clenshaw's recurrence, differentiated.
fn clenshaw(series: &[f64], u: f64) -> [f64; 4] {
    let (mut now, mut after) = ([0.0; 4], [0.0; 4]);
    for &c in series[1..].iter().rev() {
        let next = std::array::from_fn(|k| {
            let lower = if k == 0 {
                c
            } else {
                2.0 * k as f64 * now[k - 1]
            };
            2.0 * u * now[k] - after[k] + lower
        });
        (now, after) = (next, now);
    }
    std::array::from_fn(|k| {
        let lower = if k == 0 {
            series[0]
        } else {
            k as f64 * now[k - 1]
        };
        u * now[k] - after[k] + lower
    })
}

impl Transmission for Piecewise {
    fn at(&self, input: f64) -> MotionJet {
        let turns = (input / self.period).floor();
        let within = (input - turns * self.period).clamp(0.0, self.period);
        let after = self.ends.partition_point(|&end| end <= within);
        let index = after.clamp(1, self.pieces.len()) - 1;
        let (from, to) = (self.ends[index], self.ends[index + 1]);
        let u = ((within - from) - (to - within)) / (to - from);
        let [p, v, a, j] = clenshaw(&self.pieces[index], u);
        let rate = 2.0 / (to - from);
        let slope = self.advance / self.period;
        MotionJet {
            position: p + slope * input,
            velocity: v * rate + slope,
            acceleration: a * rate * rate,
            jerk: j * rate * rate * rate,
        }
    }

    fn period(&self) -> f64 {
        self.period
    }

    fn advance(&self) -> f64 {
        self.advance
    }

    fn breaks(&self) -> Vec<f64> {
        self.breaks.clone()
    }

    fn pieces(&self) -> Self {
        self.clone()
    }
}
