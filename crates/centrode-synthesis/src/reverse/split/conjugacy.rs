//! The change of variable that makes a map of the circle a rotation.

use std::f64::consts::TAU;

use centrode_geometry::checkpoint;
use nalgebra::Complex;

use super::fourier::Fourier;

/// Smallest divisors that are used, stage by stage: the first stages settle only the rough shape of the map.
const DIVISORS: [f64; 3] = [1e-2, 1e-4, MIN_DIVISOR];
/// Divisor below which a harmonic is not determined.
pub(super) const MIN_DIVISOR: f64 = 1e-8;
/// Maximum number of steps on one grid.
const STEPS: u32 = 40;
/// Width of the filter that smooths a first guess, as a share of the number of harmonics.
const SMOOTH: f64 = 0.125;

/// A function h with `h(theta + step) = G(h(theta)) + offset`, by `h - theta` at equal steps of a turn.
///
/// Newton's method for circle maps (de la Llave, A tutorial on KAM theory, 2001, section 2). With e the error of the equation, a
/// better h is `h + h' w`, where `w(theta + step) - w(theta) = (e + change of offset)/h'(theta + step)`: the harmonics of w are
/// those of the right side over `e^(i k step) - 1`, and the change of the offset makes the mean of the right side zero.
/// Convergence is quadratic; a step costs four Fourier transforms.
#[derive(Clone, Debug)]
pub(super) struct Conjugacy {
    /// Rotation number, rad.
    step: f64,
    pub(super) offset: f64,
    pub(super) rests: Vec<f64>,
    stage: usize,
}

impl Conjugacy {
    /// A first guess, smoothed.
    pub(super) fn new(step: f64, offset: f64, rests: &[f64]) -> Self {
        let fourier = Fourier::new(rests.len());
        let found = fourier.coefficients(rests);
        let width = SMOOTH * rests.len() as f64;
        let smooth = |k: usize| {
            let share = fourier.harmonic(k) / width;
            found[k] * (-share * share).exp()
        };
        let [rests, _] = fourier.values(|k| [smooth(k), Complex::default()]);
        Self {
            step,
            offset,
            rests,
            stage: 0,
        }
    }

    /// This function on a grid of `count` steps, a larger power of two.
    pub(super) fn finer(self, count: usize) -> Self {
        let coarse = Fourier::new(self.rests.len());
        let found = coarse.coefficients(&self.rests);
        let half = found.len() / 2;
        let at = |k: usize| {
            if k < half {
                found[k]
            } else if k > count - half {
                found[k + found.len() - count]
            } else {
                Complex::default()
            }
        };
        let [rests, _] = Fourier::new(count).values(|k| [at(k), Complex::default()]);
        Self { rests, ..self }
    }

    /// Makes Newton steps until rounding stops them; returns the maximum error of the equation at the grid's points, rad.
    pub(super) fn refine(&mut self, map: impl Fn(f64) -> f64) -> f64 {
        let count = self.rests.len();
        let fourier = Fourier::new(count);
        let theta = |i: usize| TAU * i as f64 / count as f64;
        let turns: Vec<Complex<f64>> = (0..count)
            .map(|k| Complex::from_polar(1.0, fourier.harmonic(k) * self.step))
            .collect();
        let slope = |k: usize| Complex::i() * fourier.harmonic(k);
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            checkpoint();
            let found = fourier.coefficients(&self.rests);
            let ahead = |k: usize| found[k] * turns[k];
            let [turned, slopes] = fourier.values(|k| [ahead(k), ahead(k) * slope(k)]);
            let misses: Vec<f64> = (0..count)
                .map(|i| {
                    let mapped = map(theta(i) + self.rests[i]) + self.offset;
                    mapped - (theta(i) + self.step + turned[i])
                })
                .collect();
            let miss = misses.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
            if !miss.is_finite() {
                return f64::INFINITY;
            }
            // The error was not halved, or is not a number.
            let halved = miss <= 0.5 * before;
            if !halved {
                if self.stage + 1 >= DIVISORS.len() {
                    return miss;
                }
                self.stage += 1;
            }
            before = miss;
            let shares: Vec<f64> = slopes.iter().map(|slope| 1.0 / (1.0 + slope)).collect();
            let weighted = misses.iter().zip(&shares).map(|(e, share)| e * share);
            let change = -weighted.sum::<f64>() / shares.iter().sum::<f64>();
            let right = misses.iter().zip(&shares);
            let right: Vec<f64> = right.map(|(e, share)| (e + change) * share).collect();
            let right = fourier.coefficients(&right);
            let minimum = DIVISORS[self.stage];
            let solved = |k: usize| {
                let divisor = turns[k] - 1.0;
                if divisor.norm() > minimum {
                    right[k] / divisor
                } else {
                    Complex::default()
                }
            };
            let [w, slopes] = fourier.values(|k| [solved(k), found[k] * slope(k)]);
            for ((rest, w), slope) in self.rests.iter_mut().zip(&w).zip(&slopes) {
                *rest += (1.0 + slope) * w;
            }
            self.offset += change;
        }
        before
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::Conjugacy;

    /// G = h after a turn after the inverse of h, with a known h.
    #[test]
    fn a_known_change_of_angle_comes_back_near_a_fraction() {
        let h = |t: f64| t + 0.3 * t.sin() + 0.1 * (2.0 * t + 1.0).cos();
        let slope = |t: f64| 1.0 + 0.3 * t.cos() - 0.2 * (2.0 * t + 1.0).sin();
        let back = |x: f64| {
            let mut t = x;
            for _ in 0..50 {
                t -= ((h(t) - x) / slope(t)).clamp(-0.5, 0.5);
            }
            t
        };
        for turns in [0.381_966, 27.0 / 55.0 + 1e-6, 0.36 + 3e-6] {
            let step = TAU * turns;
            let map = |x: f64| h(back(x) + step) - 0.25;
            let count = 256;
            let theta = |i: usize| TAU * i as f64 / count as f64;
            // A guess that is off by a little.
            let guess = |t: f64| h(t) - t + 1e-4 * (3.0 * t).cos();
            let guess: Vec<f64> = (0..count).map(|i| guess(theta(i))).collect();
            let mut found = Conjugacy::new(step, 0.251, &guess).finer(2048);
            let miss = found.refine(map);
            assert!(miss < 1e-13, "{turns}: {miss:e}");
            assert!((found.offset - 0.25).abs() < 1e-13, "{turns}");
            // The angle may begin anywhere.
            let theta = |i: usize| TAU * i as f64 / 2048.0;
            let off = |i: usize| back(theta(i) + found.rests[i]) - theta(i);
            let start = off(0);
            let worst = (0..2048)
                .map(|i| (off(i) - start).abs())
                .fold(0.0, f64::max);
            assert!(worst < 1e-11, "{turns}: {worst:e}");
        }
    }
}
