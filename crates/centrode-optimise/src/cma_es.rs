use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::{Deserialize, Serialize};

use super::problem::Candidate;
use super::random::Random;

/// First step, as a share of the bounds.
const FIRST_STEP: f64 = 0.3;
/// First step about a given start, as a share of the bounds.
const NEAR_STEP: f64 = 0.1;
/// Step and spread of the distribution below which the search restarts with twice the points.
const MIN_STEP: f64 = 1e-14;

/// Covariance matrix adaptation (Hansen 2016, arXiv 1604.00772), restarted with twice the points when the distribution has shrunk
/// (IPOP, Auger and Hansen 2005). Points beyond a bound are mirrored at it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct CmaEs {
    count: usize,
    generation: u32,
    mean: Vec<f64>,
    /// Step size, sigma.
    step: f64,
    /// Covariance matrix, row by row.
    covariance: Vec<f64>,
    /// Evolution path of the step size, `p_sigma`.
    step_path: Vec<f64>,
    /// Evolution path of the covariance, `p_c`.
    path: Vec<f64>,
    /// The steps of this generation's points, in units of `step`.
    #[serde(skip)]
    steps: Vec<DVector<f64>>,
}

impl CmaEs {
    pub(super) fn new(
        dimension: usize,
        count: usize,
        start: Option<&[f64]>,
        random: &mut Random,
    ) -> Self {
        let mut identity = vec![0.0; dimension * dimension];
        for k in 0..dimension {
            identity[k * dimension + k] = 1.0;
        }
        Self {
            count,
            generation: 0,
            mean: match start {
                Some(start) => start.to_vec(),
                None => (0..dimension).map(|_| random.between(0.2, 0.8)).collect(),
            },
            step: if start.is_some() {
                NEAR_STEP
            } else {
                FIRST_STEP
            },
            covariance: identity,
            step_path: vec![0.0; dimension],
            path: vec![0.0; dimension],
            steps: Vec::new(),
        }
    }

    fn eigen(&self) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.mean.len();
        let eigen = SymmetricEigen::new(DMatrix::from_row_slice(n, n, &self.covariance));
        (
            eigen.eigenvectors,
            eigen.eigenvalues.map(|v| v.max(0.0).sqrt()),
        )
    }

    pub(super) fn points(&mut self, random: &mut Random) -> Vec<Vec<f64>> {
        let n = self.mean.len();
        let (axes, sizes) = self.eigen();
        let spread = self.step * sizes.max();
        if !(spread > MIN_STEP && spread < 1e6) {
            *self = Self::new(n, 2 * self.count, None, random);
            return self.points(random);
        }
        self.steps.clear();
        for _ in 0..self.count {
            let z = DVector::from_fn(n, |_, _| random.normal());
            self.steps.push(&axes * z.component_mul(&sizes));
        }
        let mirrored = |x: f64| 1.0 - (x.rem_euclid(2.0) - 1.0).abs();
        let point = |y: &DVector<f64>| {
            let at = self.mean.iter().zip(y.iter());
            at.map(|(m, y)| mirrored(m + self.step * y)).collect()
        };
        self.steps.iter().map(point).collect()
    }

    /// Updates the distribution from evaluated points; names of the rates are Hansen's symbols.
    pub(super) fn update(&mut self, points: &[Candidate]) {
        let n = self.mean.len();
        let dimension = n as f64;
        let mut ranked: Vec<usize> = (0..points.len()).collect();
        ranked.sort_by(|&a, &b| points[a].evaluation.order(&points[b].evaluation));
        let parents = points.len() / 2;
        let middle = (points.len() as f64 + 1.0) / 2.0;
        let raw: Vec<f64> = (0..parents)
            .map(|i| middle.ln() - (i as f64 + 1.0).ln())
            .collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|w| w / sum).collect();
        let mu_eff = 1.0 / weights.iter().map(|w| w * w).sum::<f64>();

        let c_sigma = (mu_eff + 2.0) / (dimension + mu_eff + 5.0);
        let c_c = (4.0 + mu_eff / dimension) / (dimension + 4.0 + 2.0 * mu_eff / dimension);
        let c_1 = 2.0 / ((dimension + 1.3).powi(2) + mu_eff);
        let c_mu = (2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((dimension + 2.0).powi(2) + mu_eff))
            .min(1.0 - c_1);
        let d_sigma =
            1.0 + 2.0 * (((mu_eff - 1.0) / (dimension + 1.0)).sqrt() - 1.0).max(0.0) + c_sigma;
        let chi_n =
            dimension.sqrt() * (1.0 - 0.25 / dimension + 1.0 / (21.0 * dimension * dimension));

        let mut mean_step = DVector::zeros(n);
        for (weight, &k) in weights.iter().zip(&ranked) {
            mean_step += &self.steps[k] * *weight;
        }
        let (axes, sizes) = self.eigen();
        let inverse = sizes.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
        let whitened = &axes * (axes.transpose() * &mean_step).component_mul(&inverse);
        for k in 0..n {
            self.mean[k] += self.step * mean_step[k];
            self.step_path[k] = (1.0 - c_sigma) * self.step_path[k]
                + (c_sigma * (2.0 - c_sigma) * mu_eff).sqrt() * whitened[k];
        }
        self.generation += 1;
        let length = self.step_path.iter().map(|p| p * p).sum::<f64>().sqrt();
        let settled = (1.0 - (1.0 - c_sigma).powf(2.0 * f64::from(self.generation))).sqrt();
        let h_sigma = length / settled < (1.4 + 2.0 / (dimension + 1.0)) * chi_n;
        let path_gain = if h_sigma {
            (c_c * (2.0 - c_c) * mu_eff).sqrt()
        } else {
            0.0
        };
        for k in 0..n {
            self.path[k] = (1.0 - c_c) * self.path[k] + path_gain * mean_step[k];
        }
        let delta = if h_sigma { 0.0 } else { c_c * (2.0 - c_c) };
        for i in 0..n {
            for j in 0..n {
                let mut spread = 0.0;
                for (weight, &k) in weights.iter().zip(&ranked) {
                    spread += weight * self.steps[k][i] * self.steps[k][j];
                }
                let old = self.covariance[i * n + j];
                self.covariance[i * n + j] = (1.0 - c_1 - c_mu + c_1 * delta) * old
                    + c_1 * self.path[i] * self.path[j]
                    + c_mu * spread;
            }
        }
        self.step *= ((c_sigma / d_sigma) * (length / chi_n - 1.0)).exp();
    }
}
