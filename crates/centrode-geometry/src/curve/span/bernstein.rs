//! Bernstein form of a polynomial segment between two parameters: it lies in the hull of its control points, and its derivative
//! in that of their differences (Farin, Curves and surfaces for CAGD, 5th edition, chapter 6).

use std::sync::LazyLock;

use crate::{
    Vector,
    curve::{NODES, PolySegment},
};

/// Number of differences of consecutive control points.
pub(super) const STEPS: usize = NODES - 1;

/// Tables of binomial coefficients.
struct Tables {
    /// Differences of the control values of the powers of u, by difference and power. In the second half the even powers
    /// have the opposite sign.
    steps: [[f64; NODES]; NODES / 2],
    /// Weights of the cross products of first and second differences.
    products: [[f64; STEPS - 1]; STEPS],
    /// Weights of the products of points and first differences.
    levers: [[f64; STEPS]; NODES],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let choose = |n: usize, k: usize| -> f64 {
        if k > n {
            return 0.0;
        }
        (0..k)
            .map(|i| (n - i) as f64 / (i + 1) as f64)
            .product::<f64>()
            .round()
    };
    let degree = NODES - 1;
    // Polar form of u^k with i arguments at the end and all others at the start: the mean of its elementary symmetric terms.
    let power = |i: usize, k: usize| -> f64 {
        let term = |m: usize| {
            let sign = if (k - m).is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * choose(i, m) * choose(degree - i, k - m)
        };
        (0..=k).map(term).sum::<f64>() / choose(degree, k)
    };
    let product = |i: usize, j: usize| {
        choose(degree - 1, i) * choose(degree - 2, j) / choose(2 * degree - 3, i + j)
    };
    let lever = |i: usize, j: usize| {
        choose(degree, i) * choose(degree - 1, j) / choose(2 * degree - 1, i + j)
    };
    Tables {
        steps: std::array::from_fn(|i| std::array::from_fn(|k| power(i + 1, k) - power(i, k))),
        levers: std::array::from_fn(|i| std::array::from_fn(|j| lever(i, j))),
        products: std::array::from_fn(|i| std::array::from_fn(|j| product(i, j))),
    }
});

/// Differences of the consecutive control points of a polynomial segment between two parameters.
///
/// They are computed without the position, so that those of a very short part have all their digits.
pub(super) fn steps(poly: &PolySegment, [u0, u1]: [f64; 2]) -> [Vector; STEPS] {
    let mut c = [Vector::zeros(); NODES];
    c.copy_from_slice(poly.coefficients());
    if [u0, u1] != [-1.0, 1.0] {
        reparametrise(&mut c, 0.5 * (u0 + u1), 0.5 * (u1 - u0));
    }
    let mut out = [Vector::zeros(); STEPS];
    for (i, weights) in TABLES.steps.iter().enumerate() {
        let (mut even, mut odd) = (Vector::zeros(), c[1] * weights[1]);
        for k in (2..NODES).step_by(2) {
            even += c[k] * weights[k];
            odd += c[k + 1] * weights[k + 1];
        }
        out[STEPS - 1 - i] = odd - even;
        out[i] = odd + even;
    }
    out
}

/// Moves the origin of the parameter to `middle` and scales its unit to `half`.
fn reparametrise(c: &mut [Vector; NODES], middle: f64, half: f64) {
    for low in 0..NODES - 1 {
        // The position is not needed.
        for k in (low.max(1)..NODES - 1).rev() {
            let above = c[k + 1];
            c[k] += above * middle;
        }
    }
    let mut unit = 1.0;
    for c in c.iter_mut().skip(1) {
        unit *= half;
        *c *= unit;
    }
}

/// Minimum and maximum curvature, 1/mm.
pub(super) fn curvature(first: &[Vector; STEPS]) -> (f64, f64) {
    let degree = STEPS as f64;
    let second: [Vector; STEPS - 1] = std::array::from_fn(|i| first[i + 1] - first[i]);
    let mut cross = [0.0; 2 * STEPS - 2];
    for (i, d) in first.iter().enumerate() {
        for (j, e) in second.iter().enumerate() {
            cross[i + j] += TABLES.products[i][j] * d.perp(e);
        }
    }
    let (low, high) = range(&cross);
    let speeds = speeds(first);
    let curvature = |cross: f64, outward: bool| {
        divided_by_speed(cross, outward, speeds, 3) * (degree - 1.0) / degree
    };
    (curvature(low, low < 0.0), curvature(high, high > 0.0))
}

/// Minimum and maximum distance of the axis from the normals, mm; `start` is the start relative to the axis.
pub(super) fn levers(first: &[Vector; STEPS], start: Vector) -> (f64, f64) {
    let mut away = [0.0; 2 * STEPS];
    let mut from = start;
    for (i, weights) in TABLES.levers.iter().enumerate() {
        for (j, d) in first.iter().enumerate() {
            away[i + j] += weights[j] * from.dot(d);
        }
        from += first.get(i).copied().unwrap_or_default();
    }
    let (low, high) = range(&away);
    let speeds = speeds(first);
    (
        divided_by_speed(low, low < 0.0, speeds, 1),
        divided_by_speed(high, high > 0.0, speeds, 1),
    )
}

fn range(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high)
}

/// Bounds of the speed divided by the degree: the minimum from the progress along the chord, the maximum from the differences.
fn speeds(first: &[Vector; STEPS]) -> (f64, f64) {
    let chord: Vector = first.iter().sum();
    let along = first.iter().map(|d| chord.dot(d));
    let slowest = along.fold(f64::INFINITY, f64::min) / chord.norm();
    (slowest, first.iter().map(Vector::norm).fold(0.0, f64::max))
}

/// Bound of a value divided by a power of the speed: an outward bound (away from zero) uses the minimum speed, an inward one the
/// maximum speed.
fn divided_by_speed(value: f64, outward: bool, (slowest, fastest): (f64, f64), power: i32) -> f64 {
    let speed = if outward { slowest } else { fastest };
    if speed > 0.0 {
        value / speed.powi(power)
    } else {
        f64::INFINITY.copysign(value)
    }
}
