use std::sync::OnceLock;

/// Nodes of the rule, which is exact up to degree 51. Fewer would make the moments of polynomial segments inexact.
pub(crate) const GAUSS_NODES: usize = 26;

/// Nodes and weights of the Gauss-Legendre rule on `[-1, 1]`: Newton steps on the Legendre polynomial.
fn rule() -> &'static [(f64, f64); GAUSS_NODES] {
    static RULE: OnceLock<[(f64, f64); GAUSS_NODES]> = OnceLock::new();
    RULE.get_or_init(|| {
        let n = GAUSS_NODES as f64;
        let mut rule = [(0.0, 0.0); GAUSS_NODES];
        for (i, entry) in rule.iter_mut().enumerate() {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..10 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=GAUSS_NODES {
                    let k = k as f64;
                    (before, value) = (
                        value,
                        ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
                    );
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            *entry = (x, 2.0 / ((1.0 - x * x) * slope * slope));
        }
        rule
    })
}

/// Visits the 26 nodes of the Gauss-Legendre rule on `[low, high]` with their weights.
///
/// The rule is exact for polynomials up to degree 51, which includes every moment integral of a polynomial segment.
pub fn gauss_legendre(low: f64, high: f64, mut visit: impl FnMut(f64, f64)) {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    for &(node, weight) in rule() {
        visit(middle + half * node, half * weight);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_power_up_to_twice_the_nodes_is_integrated_exactly() {
        for power in 0..2 * GAUSS_NODES as i32 {
            let mut sum = 0.0;
            gauss_legendre(-1.0, 1.0, |x, w| sum += w * x.powi(power));
            let exact = if power % 2 == 0 {
                2.0 / f64::from(power + 1)
            } else {
                0.0
            };
            assert!((sum - exact).abs() < 4e-15, "power {power}: {sum} {exact}");
        }
    }
}
