//! Chebyshev series of a function from its values at the roots of a Chebyshev polynomial.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Number of terms of a [`chebyshev_series`]. Fewer need shorter pieces of a function, more cost time per piece.
pub const CHEBYSHEV_TERMS: usize = 16;

const COUNT: usize = CHEBYSHEV_TERMS;

/// Value of Chebyshev polynomial `k` at root `j`.
static COSINES: LazyLock<[[f64; COUNT]; COUNT]> = LazyLock::new(|| {
    let angle = |j: usize| PI * (j as f64 + 0.5) / COUNT as f64;
    std::array::from_fn(|k| std::array::from_fn(|j| (k as f64 * angle(j)).cos()))
});

/// Inputs between `from` and `to` at which a [`chebyshev_series`] needs the values, in descending order.
#[must_use]
pub fn chebyshev_roots(from: f64, to: f64) -> [f64; COUNT] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    COSINES[1].map(|cos| middle + half * cos)
}

/// Chebyshev coefficients of the polynomial through the values of a function at the [`chebyshev_roots`].
///
/// Source: Trefethen, Approximation Theory and Approximation Practice, 2013, chapter 3.
#[must_use]
pub fn chebyshev_series(values: &[f64; COUNT]) -> [f64; COUNT] {
    std::array::from_fn(|k| {
        let scale = if k == 0 { 1.0 } else { 2.0 } / COUNT as f64;
        let terms = values.iter().zip(&COSINES[k]).map(|(v, c)| v * c);
        scale * terms.sum::<f64>()
    })
}
