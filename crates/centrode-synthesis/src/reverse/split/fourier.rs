//! Fast Fourier transform of a power of two of values.

use std::f64::consts::TAU;

use nalgebra::Complex;

/// Transform of values at equal steps of a turn (Cooley and Tukey, radix 2).
pub(super) struct Fourier {
    count: usize,
    /// `e^(-2 pi i k/count)` for k below half of the count.
    roots: Vec<Complex<f64>>,
}

impl Fourier {
    /// Transform of `count` values, a power of two.
    pub(super) fn new(count: usize) -> Self {
        let root = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
            Complex::new(cos, -sin)
        };
        let roots = (0..count / 2).map(root).collect();
        Self { count, roots }
    }

    /// Harmonic of a coefficient by its position: negative in the second half.
    pub(super) fn harmonic(&self, place: usize) -> f64 {
        if place < self.count / 2 {
            place as f64
        } else {
            place as f64 - self.count as f64
        }
    }

    /// Coefficients of real values, the mean at position zero; the coefficient of the highest harmonic, whose phase is unknown,
    /// is zero.
    pub(super) fn coefficients(&self, values: &[f64]) -> Vec<Complex<f64>> {
        let mut data: Vec<Complex<f64>> = values.iter().map(|v| Complex::new(*v, 0.0)).collect();
        self.transform(&mut data);
        let scale = 1.0 / self.count as f64;
        data.iter_mut().for_each(|c| *c *= scale);
        data[self.count / 2] = Complex::default();
        data
    }

    /// Values of two real functions from their coefficients, both by one transform.
    pub(super) fn values(
        &self,
        coefficients: impl Fn(usize) -> [Complex<f64>; 2],
    ) -> [Vec<f64>; 2] {
        // With its input and output conjugated, the transform is its inverse.
        let both = |k: usize| {
            let [one, other] = coefficients(k);
            (one + Complex::<f64>::i() * other).conj()
        };
        let mut data: Vec<Complex<f64>> = (0..self.count).map(both).collect();
        self.transform(&mut data);
        [
            data.iter().map(|c| c.re).collect(),
            data.iter().map(|c| -c.im).collect(),
        ]
    }

    fn transform(&self, data: &mut [Complex<f64>]) {
        let bits = self.count.trailing_zeros();
        for i in 0..self.count {
            let j = i.reverse_bits() >> (usize::BITS - bits);
            if i < j {
                data.swap(i, j);
            }
        }
        let mut half = 1;
        while half < self.count {
            let stride = self.count / (2 * half);
            for block in data.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                let roots = self.roots.iter().step_by(stride);
                for ((a, b), root) in low.iter_mut().zip(high).zip(roots) {
                    let turned = *b * root;
                    (*a, *b) = (*a + turned, *a - turned);
                }
            }
            half *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::Fourier;

    #[test]
    fn coefficients_are_those_of_the_waves_and_give_them_back() {
        let wave = |t: f64| 0.3 + (3.0 * t).cos() - 0.5 * (7.0 * t).sin();
        let values: Vec<f64> = (0..64).map(|i| wave(TAU * f64::from(i) / 64.0)).collect();
        let fourier = Fourier::new(64);
        let found = fourier.coefficients(&values);
        for (k, c) in found.iter().enumerate() {
            let required = match fourier.harmonic(k) as i32 {
                0 => [0.3, 0.0],
                3 | -3 => [0.5, 0.0],
                7 => [0.0, 0.25],
                -7 => [0.0, -0.25],
                _ => [0.0, 0.0],
            };
            let off = (c.re - required[0]).abs().max((c.im - required[1]).abs());
            assert!(off < 1e-15, "{k}: {c}");
        }
        let slope = |k: usize| found[k] * nalgebra::Complex::i() * fourier.harmonic(k);
        let [back, slopes] = fourier.values(|k| [found[k], slope(k)]);
        for i in 0..64 {
            let t = TAU * i as f64 / 64.0;
            assert!((back[i] - values[i]).abs() < 1e-13);
            let required = -3.0 * (3.0 * t).sin() - 3.5 * (7.0 * t).cos();
            assert!((slopes[i] - required).abs() < 1e-13);
        }
    }
}
