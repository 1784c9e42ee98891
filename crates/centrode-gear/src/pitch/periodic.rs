//! Functions of period one turn from samples or coefficients.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::bspline::{basis, controls_through};
use super::points::{angles_in_order, count};
use super::{PitchError, Symmetry, gcd};
use centrode_kinematics::formula::Taylor;

/// Interpolation of a function between its samples.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// Periodic cubic spline: two continuous derivatives.
    Cubic,
    /// Periodic quintic spline: four continuous derivatives. Equal steps only.
    Quintic,
    /// Trigonometric polynomial: analytic. Equal steps only, at most 1000 samples.
    Trigonometric,
}

/// Maximum number of harmonics of a trigonometric polynomial: the time of every evaluation is proportional to their number.
pub(super) const MAX_HARMONICS: usize = 500;

/// A function of period one turn.
#[derive(Debug)]
pub struct Periodic(Form);

#[derive(Debug)]
enum Form {
    Fourier(Fourier),
    Spline(Spline),
}

impl From<Fourier> for Periodic {
    fn from(series: Fourier) -> Self {
        Self(Form::Fourier(series))
    }
}

impl Periodic {
    /// Interpolates samples at equal steps from the angle zero.
    ///
    /// # Errors
    /// [`PitchError`] with the key, for too few or too many samples.
    pub fn even(
        key: &'static str,
        samples: &[f64],
        interpolation: Interpolation,
    ) -> Result<Self, PitchError> {
        match interpolation {
            Interpolation::Cubic => {
                count(key, samples.len(), 4)?;
                Ok(Self(Form::Spline(Spline::even(samples, 3))))
            }
            Interpolation::Quintic => {
                count(key, samples.len(), 6)?;
                Ok(Self(Form::Spline(Spline::even(samples, 5))))
            }
            Interpolation::Trigonometric => {
                count(key, samples.len(), 3)?;
                if samples.len() > 2 * MAX_HARMONICS {
                    let (count, limit) = (samples.len(), 2 * MAX_HARMONICS);
                    return Err(PitchError::TooManyPoints { key, count, limit });
                }
                Ok(Self(Form::Fourier(Fourier::through(samples))))
            }
        }
    }

    /// Interpolates samples at the given angles (rad, increasing within one turn) by a cubic spline.
    pub(crate) fn uneven(
        key: &'static str,
        angle: &[f64],
        samples: &[f64],
    ) -> Result<Self, PitchError> {
        count(key, samples.len(), 4)?;
        if angle.len() != samples.len() {
            return Err(PitchError::LengthMismatch {
                first: key,
                first_length: samples.len(),
                second: "angle_deg",
                second_length: angle.len(),
            });
        }
        angles_in_order(angle)?;
        Ok(Self(Form::Spline(Spline::uneven(angle, samples))))
    }

    /// Taylor series of the function at an angle, rad.
    #[must_use]
    pub fn at(&self, phi: f64) -> Taylor {
        match &self.0 {
            Form::Fourier(series) => series.at(phi),
            Form::Spline(spline) => spline.at(phi),
        }
    }

    /// Mean over one turn.
    pub(crate) fn mean(&self) -> f64 {
        match &self.0 {
            Form::Fourier(series) => series.mean,
            Form::Spline(spline) => spline.mean(),
        }
    }

    /// The function times a factor.
    pub(crate) fn scaled(mut self, factor: f64) -> Self {
        match &mut self.0 {
            Form::Fourier(series) => {
                series.mean *= factor;
                let terms = series.harmonics.as_flattened_mut();
                terms.iter_mut().for_each(|c| *c *= factor);
            }
            Form::Spline(spline) => {
                let terms = spline.pieces.as_flattened_mut();
                terms.iter_mut().for_each(|c| *c *= factor);
            }
        }
        self
    }

    /// Symmetry of the function, as far as its coefficients show.
    pub(crate) fn symmetry(&self) -> Symmetry {
        match &self.0 {
            Form::Fourier(series) => series.symmetry(),
            Form::Spline(_) => Symmetry::NONE,
        }
    }

    /// Arguments at which a derivative may jump, in `[0, TAU)`, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match &self.0 {
            Form::Fourier(_) => Vec::new(),
            Form::Spline(spline) => spline.knots[..spline.pieces.len()].to_vec(),
        }
    }
}

/// Fourier series `mean + sum over n of cos[n-1] cos(n phi) + sin[n-1] sin(n phi)`.
#[derive(Debug)]
pub(crate) struct Fourier {
    mean: f64,
    /// Cosine and sine coefficient of every harmonic from the first.
    harmonics: Vec<[f64; 2]>,
}

impl Fourier {
    pub(crate) fn new(mean: f64, cos: &[f64], sin: &[f64]) -> Result<Self, PitchError> {
        for (key, list) in [("cos", cos), ("sin", sin)] {
            if list.len() > MAX_HARMONICS {
                let (count, limit) = (list.len(), MAX_HARMONICS);
                return Err(PitchError::TooManyPoints { key, count, limit });
            }
        }
        let term = |list: &[f64], n: usize| list.get(n).copied().unwrap_or(0.0);
        let harmonics = (0..cos.len().max(sin.len())).map(|n| [term(cos, n), term(sin, n)]);
        Ok(Self {
            mean,
            harmonics: harmonics.collect(),
        })
    }

    /// The trigonometric polynomial of lowest degree through equally spaced samples.
    fn through(samples: &[f64]) -> Self {
        Self::of_samples(samples, samples.len() / 2, 1)
    }

    /// The first harmonics of equally spaced samples: those up to the highest that are multiples of `folds`. The others are zero.
    pub(super) fn of_samples(samples: &[f64], highest: usize, folds: usize) -> Self {
        let count = samples.len();
        let unit: Vec<(f64, f64)> = (0..count)
            .map(|i| (TAU * i as f64 / count as f64).sin_cos())
            .collect();
        let harmonic = |n: usize| {
            if !n.is_multiple_of(folds) {
                return [0.0; 2];
            }
            // The highest harmonic of an even number of samples is a cosine of half weight.
            let weight = if 2 * n == count { 1.0 } else { 2.0 } / count as f64;
            let (mut c, mut s) = (0.0, 0.0);
            for (i, value) in samples.iter().enumerate() {
                let (sin, cos) = unit[i * n % count];
                c += value * cos;
                s += value * sin;
            }
            let sine = if 2 * n == count { 0.0 } else { weight * s };
            [weight * c, sine]
        };
        Self {
            mean: samples.iter().sum::<f64>() / count as f64,
            harmonics: (1..=highest).map(harmonic).collect(),
        }
    }

    /// Mean.
    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    /// Cosine and sine coefficient of every harmonic from the first.
    pub(super) fn harmonics(&self) -> &[[f64; 2]] {
        &self.harmonics
    }

    /// The series up to a harmonic.
    pub(super) fn cut(mut self, highest: usize) -> Self {
        self.harmonics.truncate(highest);
        self
    }

    /// The greatest common divisor of the harmonics in use is the number of folds; without sines the function is even.
    fn symmetry(&self) -> Symmetry {
        let used = (1u32..).zip(&self.harmonics);
        let used = used.filter(|(_, [a, b])| *a != 0.0 || *b != 0.0);
        Symmetry {
            folds: used.map(|(n, _)| n).fold(0, gcd),
            mirrored: self.harmonics.iter().all(|[_, sine]| *sine == 0.0),
            mates_itself: false,
        }
    }

    fn at(&self, phi: f64) -> Taylor {
        let (sin, cos) = phi.sin_cos();
        let (mut s, mut c) = (sin, cos);
        let mut d = [self.mean, 0.0, 0.0, 0.0, 0.0];
        for (n, [a, b]) in self.harmonics.iter().enumerate() {
            let n = (n + 1) as f64;
            let (even, odd) = (a * c + b * s, n * (b * c - a * s));
            d[0] += even;
            d[1] += odd;
            d[2] -= n * n * even / 2.0;
            d[3] -= n * n * odd / 6.0;
            d[4] += n * n * n * n * even / 24.0;
            (s, c) = (s * cos + c * sin, c * cos - s * sin);
        }
        Taylor(d)
    }
}

/// A periodic piecewise polynomial of degree at most five.
#[derive(Debug)]
pub(crate) struct Spline {
    /// Piece ends over one turn, ascending, the first in `[0, TAU)`; one more than there are pieces.
    knots: Vec<f64>,
    /// Coefficients in the distance from the start of the piece, constant first.
    pieces: Vec<[f64; 6]>,
}

impl Spline {
    fn even(samples: &[f64], degree: usize) -> Self {
        let n = samples.len();
        let step = TAU / n as f64;
        let controls = controls_through(samples, degree);
        let basis = basis(degree);
        let pieces = (0..n).map(|i| {
            let mut piece = [0.0; 6];
            for (j, weight) in basis.iter().enumerate() {
                let control = controls[(i + n + j - degree / 2) % n];
                for (c, w) in piece.iter_mut().zip(weight) {
                    *c += w * control;
                }
            }
            let mut power = 1.0;
            for c in &mut piece {
                *c /= power;
                power *= step;
            }
            piece
        });
        Self {
            pieces: pieces.collect(),
            knots: (0..=n).map(|i| TAU * i as f64 / n as f64).collect(),
        }
    }

    fn uneven(angle: &[f64], samples: &[f64]) -> Self {
        let n = samples.len();
        // The list can start at any angle; the knots start at the first angle above zero.
        let mut nodes: Vec<(f64, f64)> = angle
            .iter()
            .map(|a| a.rem_euclid(TAU))
            .map(|a| if a < TAU { a } else { 0.0 })
            .zip(samples.iter().copied())
            .collect();
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut knots, samples): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        knots.push(knots[0] + TAU);
        let step: Vec<f64> = knots.windows(2).map(|w| w[1] - w[0]).collect();
        let rise: Vec<f64> = (0..n)
            .map(|i| (samples[(i + 1) % n] - samples[i]) / step[i])
            .collect();
        let right: Vec<f64> = (0..n)
            .map(|i| 6.0 * (rise[i] - rise[(i + n - 1) % n]))
            .collect();
        let bend = cyclic_bends(&step, &right);
        let pieces = (0..n).map(|i| {
            let (m, next, h) = (bend[i], bend[(i + 1) % n], step[i]);
            let slope = rise[i] - h * (2.0 * m + next) / 6.0;
            [samples[i], slope, m / 2.0, (next - m) / (6.0 * h), 0.0, 0.0]
        });
        Self {
            pieces: pieces.collect(),
            knots,
        }
    }

    /// Mean over one turn.
    fn mean(&self) -> f64 {
        let pieces = self.pieces.iter().zip(self.knots.windows(2));
        let integral = |(piece, ends): (&[f64; 6], &[f64])| {
            let step = ends[1] - ends[0];
            let terms = piece.iter().enumerate().rev();
            terms.fold(0.0, |sum, (k, c)| (sum + c / (k + 1) as f64) * step)
        };
        pieces.map(integral).sum::<f64>() / TAU
    }

    fn at(&self, phi: f64) -> Taylor {
        let mut t = phi.rem_euclid(TAU);
        if t < self.knots[0] {
            t += TAU;
        }
        let last = self.pieces.len() - 1;
        let index = self.knots.partition_point(|&k| k <= t).clamp(1, last + 1) - 1;
        let c = &self.pieces[index];
        let u = t - self.knots[index];
        let mut d = [0.0; 5];
        for &k in c.iter().rev() {
            for order in (1..5).rev() {
                d[order] = d[order] * u + d[order - 1];
            }
            d[0] = d[0] * u + k;
        }
        Taylor(d)
    }
}

/// Second derivatives at the knots of a periodic cubic spline.
///
/// `h_(i-1) m_(i-1) + 2 (h_(i-1) + h_i) m_i + h_i m_(i+1) = right_i`, indices round the turn:
/// a tridiagonal system with two corners, removed by the Sherman-Morrison formula.
fn cyclic_bends(step: &[f64], right: &[f64]) -> Vec<f64> {
    let n = step.len();
    let corner = step[n - 1];
    let mut diagonal: Vec<f64> = (0..n)
        .map(|i| 2.0 * (step[(i + n - 1) % n] + step[i]))
        .collect();
    let pivot = -diagonal[0];
    diagonal[0] -= pivot;
    diagonal[n - 1] -= corner * corner / pivot;
    let mut edge = vec![0.0; n];
    edge[0] = pivot;
    edge[n - 1] = corner;
    let solve = |mut v: Vec<f64>| {
        let mut d = diagonal.clone();
        for i in 1..n {
            let factor = step[i - 1] / d[i - 1];
            d[i] -= factor * step[i - 1];
            v[i] -= factor * v[i - 1];
        }
        v[n - 1] /= d[n - 1];
        for i in (0..n - 1).rev() {
            v[i] = (v[i] - step[i] * v[i + 1]) / d[i];
        }
        v
    };
    let (x, z) = (solve(right.to_vec()), solve(edge));
    let ratio = corner / pivot;
    let factor = (x[0] + ratio * x[n - 1]) / (1.0 + z[0] + ratio * z[n - 1]);
    x.iter().zip(&z).map(|(x, z)| x - factor * z).collect()
}
