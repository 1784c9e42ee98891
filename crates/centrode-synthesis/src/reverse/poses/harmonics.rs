use std::f64::consts::{PI, TAU};

use centrode_geometry::bracketed_root;
use nalgebra::{DMatrix, DVector};

/// Harmonics of the law.
const ORDERS: usize = 8;
const TERMS: usize = 2 * ORDERS;
/// Number of parts in which the turns grow from those of even motion to the required ones.
const GROWTH: usize = 8;
/// Newton steps per part, the maximum change of an amplitude per step, and the change at which the steps end.
const STEPS: usize = 40;
const MAXIMUM: f64 = 0.1;
const SETTLED: f64 = 1e-13;
/// Minimum ratio of a law, and number of samples per turn at which it is checked.
const MIN_RATIO: f64 = 0.05;
const PLACES: u32 = 180;

/// Driven angle of a pair as a sum of harmonics, `f(x) = x + sum of a_k (cos k x - 1) + b_k sin k x`.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonics {
    amplitudes: [f64; TERMS],
}

/// Cost of a squared amplitude of f: its part in the squares of the ratio and of the ratio's second derivative.
fn cost(term: usize) -> f64 {
    let k = (1 + term / 2) as f64;
    k.powi(2) * (1.0 + k.powi(4))
}

impl Harmonics {
    /// Number of amplitudes: `a_1`, `b_1`, `a_2` and so on.
    pub const TERMS: usize = TERMS;

    /// Law of one pair twice: while the carrier turns by the first of each two angles, the planet turns by the second, rad,
    /// signed and from the same start. Its amplitudes are as near as possible to those of `bias`. `None` if the steps do not
    /// converge.
    ///
    /// The planet meets its gear at chi(psi) with f(chi) = f(psi) - bend - pi, so each pose is one equation in the amplitudes.
    /// Newton steps solve these equations; of all solutions of the linear equations a step takes the one nearest to `bias`.
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

    /// Whether the driven gear always advances, checked at samples.
    fn advances(&self) -> bool {
        let at = |i: u32| TAU * f64::from(i) / f64::from(PLACES);
        (0..PLACES).all(|i| self.ratio(at(i)) > MIN_RATIO)
    }

    /// Polar angle at which the planet meets its gear, and its derivatives by the amplitudes.
    fn planet(&self, psi: f64, bend: f64) -> (f64, [f64; TERMS]) {
        let met = self.at(psi) - bend - PI;
        // f(x) differs from x by at most twice the sum of all amplitudes.
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
