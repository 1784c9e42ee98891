use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Form;
use centrode_kinematics::formula::Taylor;
use centrode_spec::SpecError;
use centrode_spec::rule::{finite, in_range};

/// Maximum number of derivatives given at one end: velocity, acceleration, jerk and the derivative of the jerk.
const MOST: usize = 4;

/// The polynomial of lowest degree with the required derivatives at both ends; it goes from 0 to 1.
///
/// A derivative not given is free, so the degree is one more than there are given ones. Two zeros at
/// each end make the 3-4-5 polynomial, three the 4-5-6-7 one.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Polynomial {
    /// Velocity, acceleration and so on at the start, per unit of the law's own input and lift.
    pub start: Vec<f64>,
    /// Velocity, acceleration and so on at the end.
    pub end: Vec<f64>,
}

impl Polynomial {
    /// Checks that the coefficients are finite and at most four at each end.
    pub(super) fn validate(&self) -> Result<(), SpecError> {
        for (key, list) in [("start", &self.start), ("end", &self.end)] {
            in_range(key, list.len() as f64, [0.0, MOST as f64], " values")?;
            list.iter().try_for_each(|&d| finite(key, d))?;
        }
        Ok(())
    }

    pub(super) fn coefficients(&self) -> Coefficients {
        let with = |value: f64, rest: &[f64]| -> Vec<f64> {
            std::iter::once(value).chain(rest.iter().copied()).collect()
        };
        Coefficients::meeting(&with(0.0, &self.start), &with(1.0, &self.end))
    }
}

/// A polynomial by its coefficients, constant first.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cam) struct Coefficients(Vec<f64>);

impl Coefficients {
    /// The polynomial of lowest degree with the given value and derivatives at 0 and at 1.
    ///
    /// Hermite's two-point interpolation: `p = T(x) + x^m q(x)` with T the Taylor polynomial of the m
    /// values at 0, and q that of `(p - T) / x^m` at 1.
    pub(in crate::cam) fn meeting(start: &[f64], end: &[f64]) -> Self {
        let m = start.len();
        let mut p = vec![0.0; m + end.len()];
        let mut factorial = 1.0;
        for (k, &derivative) in start.iter().enumerate() {
            factorial *= (k as f64).max(1.0);
            p[k] = derivative / factorial;
        }
        // Series in y = x - 1 of the difference p - T at the end.
        let mut factorial = 1.0;
        let rest: Vec<f64> = end
            .iter()
            .enumerate()
            .map(|(k, &derivative)| {
                factorial *= (k as f64).max(1.0);
                let of_start: f64 = (k..m).map(|i| p[i] * binomial(i, k)).sum();
                derivative / factorial - of_start
            })
            .collect();
        // Times x^-m = (1 + y)^-m.
        let q: Vec<f64> = (0..rest.len())
            .map(|k| (0..=k).map(|i| rest[k - i] * negative_binomial(m, i)).sum())
            .collect();
        // y^k back in powers of x.
        for (k, &coefficient) in q.iter().enumerate() {
            for i in 0..=k {
                let sign = if (k - i) % 2 == 0 { 1.0 } else { -1.0 };
                p[m + i] += coefficient * sign * binomial(k, i);
            }
        }
        Self(p)
    }

    /// Taylor series of the polynomial.
    pub(in crate::cam) fn of(&self, x: Taylor) -> Taylor {
        let mut sum = Taylor::constant(0.0);
        for &c in self.0.iter().rev() {
            sum = sum * x + Taylor::constant(c);
        }
        sum
    }
}

impl Form for Coefficients {
    fn of(&self, x: Taylor) -> Taylor {
        self.of(x)
    }
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

/// Coefficient of `y^k` in `(1 + y)^-m`.
fn negative_binomial(m: usize, k: usize) -> f64 {
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    sign * binomial(m + k - 1, k)
}
