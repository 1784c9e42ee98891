use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

/// Degree of the polynomials.
const DEGREE: usize = 9;

/// Fit of a Bézier curve of degree nine to a curve in space, at the extreme points of a Chebyshev polynomial.
#[derive(Clone, Debug)]
pub struct BezierFit {
    nodes: Vec<f64>,
    /// Matrix from points on the curve to Bézier points.
    inverse: DMatrix<f64>,
}

impl Default for BezierFit {
    fn default() -> Self {
        let nodes: Vec<f64> = (0..=DEGREE)
            .map(|i| 0.5 - 0.5 * (PI * i as f64 / DEGREE as f64).cos())
            .collect();
        let matrix = DMatrix::from_fn(DEGREE + 1, DEGREE + 1, |i, j| bernstein(nodes[i])[j]);
        // The nodes differ, so the matrix has an inverse.
        let inverse = matrix.try_inverse().unwrap_or_default();
        Self { nodes, inverse }
    }
}

impl BezierFit {
    /// Parameters of the fitted points, from 0 to 1.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Bézier points of the polynomial that meets a curve at the nodes.
    #[must_use]
    pub fn through(&self, curve: &dyn Fn(f64) -> [f64; 3]) -> Vec<[f64; 3]> {
        let positions: Vec<[f64; 3]> = self.nodes.iter().map(|&x| curve(x)).collect();
        let columns = [0, 1, 2].map(|axis| {
            let values = DVector::from_iterator(DEGREE + 1, positions.iter().map(|p| p[axis]));
            &self.inverse * values
        });
        let mut points: Vec<[f64; 3]> = (0..=DEGREE)
            .map(|i| [columns[0][i], columns[1][i], columns[2][i]])
            .collect();
        points[0] = positions[0];
        points[DEGREE] = positions[DEGREE];
        points
    }

    /// Position at a parameter, 0 to 1, on the curve with these Bézier points.
    #[must_use]
    pub fn at(points: &[[f64; 3]], x: f64) -> [f64; 3] {
        let weights = bernstein(x);
        [0, 1, 2].map(|axis| points.iter().zip(&weights).map(|(p, w)| p[axis] * w).sum())
    }
}

/// Weights of the Bézier points at a parameter.
fn bernstein(x: f64) -> [f64; DEGREE + 1] {
    let mut weights = [0.0; DEGREE + 1];
    weights[0] = 1.0;
    for degree in 1..=DEGREE {
        for i in (0..=degree).rev() {
            let from = if i > 0 { weights[i - 1] * x } else { 0.0 };
            weights[i] = weights[i] * (1.0 - x) + from;
        }
    }
    weights
}
