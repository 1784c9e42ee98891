use std::f64::consts::TAU;

use centrode_geometry::checkpoint;

use super::powers::Bow;
use super::{Split, SplitError, SplitKind, powers};
use crate::reverse::curvature::curvatures;
use crate::reverse::sharpness::AVERAGED;
use crate::reverse::{ReversedMachine, TwoBar};
use centrode_kinematics::transmission::Transmission as _;

/// Samples per turn of the curvatures.
const PLACES: usize = 1024;
/// Number of harmonics of the bow s.
const HARMONICS: usize = 8;
/// Sharpness b of the soft maximum, divided by the maximum curvature: with the last value the soft maximum is within 1 % of the
/// maximum.
const SHARPNESS: [f64; 8] = [8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0];
/// Maximum number of steps of the search at each sharpness.
const STEPS: u32 = 60;

/// Splits by `f' = c (G')^(1/2) e^s`, g = f o G^-1, with s a sum of eight harmonics of the carrier's direction such that the
/// maximum curvature of the four pitch curves is smallest, averaged over a step of a table. If the gears written by powers are
/// gentler, s is zero.
///
/// With w the logarithm of a stage's ratio by its driver's angle, `p = 1/(1 + e^-w)` and `q = 1 - p`, the pitch curves of a stage
/// of centre distance 1 have the curvatures `(1 + q (w'^2 - w''))/(p D)` and `(1 + w'' q^2/p)/(q D)`, `D = (1 + q^2 w'^2)^(3/2)`.
/// The maximum is approached by a soft one, `ln(mean e^(b kappa))/b` with larger and larger b. BFGS steps, starting from the
/// split by powers, minimise this soft maximum.
pub(super) fn split(chain: &TwoBar, bend: f64) -> Result<Split, SplitError> {
    let law = chain.law()?;
    let slope = |psi: f64| {
        let jet = law.at(psi);
        jet.acceleration / jet.velocity
    };
    let step = TAU / AVERAGED;
    let places = (0..PLACES).map(|i| {
        let psi = TAU * i as f64 / PLACES as f64;
        let jet = law.at(psi);
        let slope_here = jet.acceleration / jet.velocity;
        // Averaged over a step of a table: the gears do not have a narrower peak of the law.
        let bend = (slope(psi + 0.5 * step) - slope(psi - 0.5 * step)) / step;
        Place {
            total: [jet.velocity.ln(), slope_here, bend],
            waves: waves(psi),
        }
    });
    let curves = Curves {
        places: places.collect(),
    };
    let mut bow = [0.0; 2 * HARMONICS];
    let mut best = (curves.maximum(&bow), bow);
    for sharpness in SHARPNESS {
        let soft = |bow: &Amplitudes| curves.soft(bow, sharpness / best.0);
        bow = minimum(soft, bow);
        let maximum = curves.maximum(&bow);
        if maximum < best.0 {
            best = (maximum, bow);
        }
    }
    let with = |amplitudes: Amplitudes| {
        let bow: Bow = Box::new(move |psi| {
            let waves = waves(psi).map(|[wave, ..]| wave);
            waves
                .iter()
                .zip(&amplitudes)
                .map(|(wave, a)| wave * a)
                .sum()
        });
        powers::split_with(chain, SplitKind::Mildest, bend, bow)
    };
    let [found, powers] = [with(best.1)?, with([0.0; 2 * HARMONICS])?];
    // The gears as they are written decide: if the split by powers is gentler, it is used.
    let radius = |split: &Split| {
        let made = ReversedMachine::new(chain, split, 1, None);
        made.map_or(0.0, |made| made.minimum_radius())
    };
    let is_milder = radius(&found) >= radius(&powers);
    Ok(if is_milder { found } else { powers })
}

type Amplitudes = [f64; 2 * HARMONICS];

/// Sines and cosines of the harmonics with two derivatives.
fn waves(psi: f64) -> [[f64; 3]; 2 * HARMONICS] {
    std::array::from_fn(|i| {
        let k = (i / 2 + 1) as f64;
        let (sin, cos) = (k * psi).sin_cos();
        match i % 2 {
            0 => [cos, -k * sin, -k * k * cos],
            _ => [sin, k * cos, -k * k * sin],
        }
    })
}

/// A direction of the carrier.
struct Place {
    /// Logarithm of the total ratio with two derivatives.
    total: [f64; 3],
    waves: [[f64; 3]; 2 * HARMONICS],
}

/// Curvatures of the four pitch curves.
struct Curves {
    places: Vec<Place>,
}

impl Curves {
    /// Logarithm of the first stage's ratio with two derivatives at each position.
    fn shares(&self, bow: &Amplitudes) -> Vec<[f64; 3]> {
        let mut shares: Vec<[f64; 3]> = self
            .places
            .iter()
            .map(|place| {
                let mut u = place.total.map(|v| 0.5 * v);
                for (wave, a) in place.waves.iter().zip(bow) {
                    for (u, wave) in u.iter_mut().zip(wave) {
                        *u += a * wave;
                    }
                }
                u
            })
            .collect();
        // The mean of the factor is one.
        let mean = shares.iter().map(|u| u[0].exp()).sum::<f64>() / PLACES as f64;
        for u in &mut shares {
            u[0] -= mean.ln();
        }
        shares
    }

    /// The four curvatures at a position, each with its derivatives by the share and its two derivatives.
    fn at(place: &Place, u: [f64; 3]) -> [(f64, [f64; 3]); 4] {
        let [v, v1, v2] = place.total;
        // The second stage by its own driver's angle, G.
        let (e, rest) = ((-v).exp(), u[1] - v1);
        let second = [u[0] - v, e * rest, e * e * (u[2] - v2 - v1 * rest)];
        let back = |(kappa, [d0, d1, d2]): (f64, [f64; 3])| {
            (kappa, [d0, e * d1 - e * e * v1 * d2, e * e * d2])
        };
        let [a, b] = curvatures(u);
        let [c, d] = curvatures(second).map(back);
        [a, b, c, d]
    }

    fn maximum(&self, bow: &Amplitudes) -> f64 {
        let shares = self.shares(bow);
        let all = self.places.iter().zip(shares);
        let each = all.flat_map(|(place, u)| Self::at(place, u).map(|(kappa, _)| kappa));
        each.fold(0.0, f64::max)
    }

    /// Soft maximum curvature, and its slope by the amplitudes.
    fn soft(&self, bow: &Amplitudes, sharpness: f64) -> (f64, Amplitudes) {
        checkpoint();
        let shares = self.shares(bow);
        let found: Vec<[(f64, [f64; 3]); 4]> = self
            .places
            .iter()
            .zip(&shares)
            .map(|(place, u)| Self::at(place, *u))
            .collect();
        let top = found.iter().flatten().fold(0.0, |top: f64, f| top.max(f.0));
        let mut total = 0.0;
        let mut slope = [0.0; 2 * HARMONICS];
        let mut level = 0.0;
        for (place, found) in self.places.iter().zip(&found) {
            let mut by = [0.0; 3];
            for (kappa, d) in found {
                let weight = (sharpness * (kappa - top)).exp();
                total += weight;
                for (by, d) in by.iter_mut().zip(d) {
                    *by += weight * d;
                }
            }
            level += by[0];
            for (slope, wave) in slope.iter_mut().zip(&place.waves) {
                *slope += by[0] * wave[0] + by[1] * wave[1] + by[2] * wave[2];
            }
        }
        // The correction of the mean ratio changes all shares equally.
        for (i, slope) in slope.iter_mut().enumerate() {
            let mean = self.places.iter().zip(&shares);
            let mean: f64 = mean.map(|(place, u)| place.waves[i][0] * u[0].exp()).sum();
            *slope = (*slope - level * mean / PLACES as f64) / total;
        }
        let count = (4 * PLACES) as f64;
        (top + (total / count).ln() / sharpness, slope)
    }
}

/// Amplitudes near the given ones at which a smooth function has a minimum: BFGS with halved steps.
fn minimum(f: impl Fn(&Amplitudes) -> (f64, Amplitudes), start: Amplitudes) -> Amplitudes {
    const N: usize = 2 * HARMONICS;
    let dot = |a: &Amplitudes, b: &Amplitudes| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let along = |x: &Amplitudes, step: f64, way: &Amplitudes| -> Amplitudes {
        std::array::from_fn(|i| x[i] + step * way[i])
    };
    let mut inverse = [[0.0; N]; N];
    let (mut x, mut is_new) = (start, true);
    let (mut value, mut slope) = f(&x);
    for _ in 0..STEPS {
        if is_new {
            // The first step has the length 0.01.
            let size = dot(&slope, &slope).sqrt().max(f64::MIN_POSITIVE);
            inverse = [[0.0; N]; N];
            for (i, row) in inverse.iter_mut().enumerate() {
                row[i] = 0.01 / size;
            }
        }
        let way: Amplitudes = std::array::from_fn(|i| -dot(&inverse[i], &slope));
        let fall = dot(&way, &slope);
        let tries = (0..30).map(|k| 0.5_f64.powi(k));
        let better = tries
            .map(|step| (step, f(&along(&x, step, &way))))
            .find(|(step, (there, _))| *there <= value + 1e-4 * step * fall);
        let Some((step, (there, ahead))) = better else {
            if is_new {
                return x;
            }
            is_new = true;
            continue;
        };
        let (moved, turned): (Amplitudes, Amplitudes) = (
            way.map(|way| step * way),
            std::array::from_fn(|i| ahead[i] - slope[i]),
        );
        let curve = dot(&moved, &turned);
        x = along(&x, step, &way);
        let gain = value - there;
        (value, slope) = (there, ahead);
        if gain <= 1e-12 * value.abs() {
            return x;
        }
        is_new = curve <= 0.0;
        if !is_new {
            let bent: Amplitudes = std::array::from_fn(|i| dot(&inverse[i], &turned));
            let scale = (1.0 + dot(&turned, &bent) / curve) / curve;
            for i in 0..N {
                for j in 0..N {
                    inverse[i][j] += scale * moved[i] * moved[j]
                        - (bent[i] * moved[j] + moved[i] * bent[j]) / curve;
                }
            }
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::{Curves, PLACES, Place, waves};

    #[test]
    fn the_slope_of_the_soft_greatest_curvature_is_its_derivative() {
        let places = (0..PLACES).map(|i| {
            let psi = std::f64::consts::TAU * i as f64 / PLACES as f64;
            Place {
                total: [0.5 * psi.sin(), 0.5 * psi.cos(), -0.5 * psi.sin()],
                waves: waves(psi),
            }
        });
        let curves = Curves {
            places: places.collect(),
        };
        let bow = std::array::from_fn(|i| 0.02 * ((i * i) as f64 * 1.7).sin());
        let (_, slope) = curves.soft(&bow, 5.0);
        for i in 0..bow.len() {
            let at = |h: f64| {
                let mut bow = bow;
                bow[i] += h;
                curves.soft(&bow, 5.0).0
            };
            let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
            assert!(
                (difference - slope[i]).abs() < 1e-6 * (1.0 + slope[i].abs()),
                "{i}"
            );
        }
    }
}
