use std::f64::consts::{PI, TAU};

use centrode_geometry::bracketed_root;
use nalgebra::{DMatrix, DVector};

/// Harmonics of the law.
const ORDERS: usize = 8;
const TERMS: usize = 2 * ORDERS;
/// Parts in which the turns required grow from those of even motion.
const GROWTH: usize = 8;
/// Newton steps of a part, the maximum change of an amplitude in one, and the change at which they end.
const STEPS: usize = 40;
const MAXIMUM: f64 = 0.1;
const SETTLED: f64 = 1e-13;
/// Minimum ratio of a law, at so many samples of a turn.
const MIN_RATIO: f64 = 0.05;
const PLACES: u32 = 180;

/// Driven angle of a pair as a sum of harmonics, `f(x) = x + sum of a_k (cos k x - 1) + b_k sin k x`.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonics {
    amplitudes: [f64; TERMS],
}

/// Cost of a squared amplitude of f: of the ratio and of its second derivative.
fn cost(term: usize) -> f64 {
    let k = (1 + term / 2) as f64;
    k.powi(2) * (1.0 + k.powi(4))
}

impl Harmonics {
    /// Number of amplitudes: `a_1`, `b_1`, `a_2` and so on.
    pub const TERMS: usize = TERMS;

    /// Law of one pair twice that turns the planet by the second of each two angles while the carrier turns by the first, rad,
    /// signed and from the same start; its amplitudes are as near to those of `bias` as they can be. None where it does not
    /// come out.
    ///
    /// The planet meets its gear at chi(psi) with f(chi) = f(psi) - bend - pi, so each pose is one equation in the amplitudes.
    /// Newton steps solve them; of all solutions of each the nearest is taken.
    pub(super) fn through(turns: &[[f64; 2]], bend: f64, bias: &[f64]) -> Option<Self> {
        let required = turns.get(1..)?;
        let bias = DVector::from_fn(TERMS, |term, _| bias.get(term).copied().unwrap_or(0.0));
        let mut law = Self {
            amplitudes: [0.0; TERMS],
        };
        law.amplitudes.copy_from_slice(bias.as_slice());
        for part in 1..=GROWTH {
            let share = part as f64 / GROWTH as f64;
            let mut is_settled = false;
            for _ in 0..STEPS {
                if !law.advances() {
                    return None;
                }
                let (start, slope) = law.planet(0.0, bend);
                let mut off = DVector::zeros(required.len());
                let mut slopes = DMatrix::zeros(required.len(), TERMS);
                for (i, [carrier, planet]) in required.iter().enumerate() {
                    let (place, at) = law.planet(*carrier, bend);
                    off[i] = carrier + share * (planet - carrier) - (place - start);
                    for term in 0..TERMS {
                        slopes[(i, term)] = at[term] - slope[term];
                    }
                }
                let now = DVector::from_column_slice(&law.amplitudes);
                let right = off + &slopes * (&now - &bias);
                let scaled =
                    DMatrix::from_fn(TERMS, required.len(), |j, i| slopes[(i, j)] / cost(j));
                let factors = (&slopes * &scaled).lu().solve(&right)?;
                let step = &bias + scaled * factors - now;
                let length = step.amax();
                let share = (MAXIMUM / length).min(1.0);
                for (a, step) in law.amplitudes.iter_mut().zip(step.iter()) {
                    *a += share * step;
                }
                if length < SETTLED {
                    is_settled = true;
                    break;
                }
            }
            if !is_settled {
                return None;
            }
        }
        law.advances().then_some(law)
    }

    /// Driven angle, rad.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let waves = waves(x);
        x + waves
            .iter()
            .zip(self.amplitudes)
            .map(|(w, a)| w * a)
            .sum::<f64>()
    }

    fn ratio(&self, x: f64) -> f64 {
        let slope = |term: usize| {
            let k = (1 + term / 2) as f64;
            let (sin, cos) = (k * x).sin_cos();
            self.amplitudes[term]
                * if term.is_multiple_of(2) {
                    -k * sin
                } else {
                    k * cos
                }
        };
        1.0 + (0..TERMS).map(slope).sum::<f64>()
    }

    /// Whether the driven gear always advances, as far as some samples show.
    fn advances(&self) -> bool {
        let at = |i: u32| TAU * f64::from(i) / f64::from(PLACES);
        (0..PLACES).all(|i| self.ratio(at(i)) > MIN_RATIO)
    }

    /// Polar angle at which the planet meets its gear, and its derivatives by the amplitudes.
    fn planet(&self, psi: f64, bend: f64) -> (f64, [f64; TERMS]) {
        let met = self.at(psi) - bend - PI;
        // It swings about its argument by less than all amplitudes together.
        let swing = 1e-9 + 2.0 * self.amplitudes.iter().map(|a| a.abs()).sum::<f64>();
        let off = |x: f64| self.at(x) - met;
        let (low, high) = (met - swing, met + swing);
        let chi = bracketed_root(off, low, high, off(low), off(high));
        let (here, there) = (waves(psi), waves(chi));
        let ratio = self.ratio(chi);
        let slopes = std::array::from_fn(|term| (here[term] - there[term]) / ratio);
        (chi, slopes)
    }

    /// The law as a formula in `phi`, with nine decimals.
    #[must_use]
    pub fn formula(&self) -> String {
        let mut formula = String::from("phi");
        for (term, a) in self.amplitudes.iter().enumerate() {
            let word = if term.is_multiple_of(2) { "cos" } else { "sin" };
            let order = match 1 + term / 2 {
                1 => String::from("phi"),
                order => format!("{order}*phi"),
            };
            let sign = if *a < 0.0 { '-' } else { '+' };
            formula += &format!(" {sign} {:.9}*{word}({order})", a.abs());
        }
        formula
    }
}

fn waves(x: f64) -> [f64; TERMS] {
    std::array::from_fn(|term| {
        let k = (1 + term / 2) as f64;
        let (sin, cos) = (k * x).sin_cos();
        if term.is_multiple_of(2) {
            cos - 1.0
        } else {
            sin
        }
    })
}
