use serde::{Deserialize, Serialize};

use super::problem::Candidate;
use super::random::Random;

/// Number of remembered parameter pairs.
const MEMORY: usize = 6;
/// Share of the population that counts as the best to move towards.
const BEST: f64 = 0.11;

/// Differential evolution, current-to-pbest/1/bin, with parameters learnt from successful trials: SHADE (Tanabe and Fukunaga
/// 2013, DOI 10.1109/CEC.2013.6557555), without its archive.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct DifferentialEvolution {
    /// Pairs of scale and crossover rate that succeeded.
    memory: Vec<[f64; 2]>,
    next: usize,
    /// Pair with which each trial of this generation was made.
    #[serde(skip)]
    used: Vec<[f64; 2]>,
}

impl DifferentialEvolution {
    pub(super) fn new() -> Self {
        Self {
            memory: vec![[0.5; 2]; MEMORY],
            next: 0,
            used: Vec::new(),
        }
    }

    pub(super) fn trials(
        &mut self,
        population: &[Candidate],
        random: &mut Random,
    ) -> Vec<Vec<f64>> {
        let mut ranked: Vec<usize> = (0..population.len()).collect();
        ranked.sort_by(|&a, &b| population[a].evaluation.order(&population[b].evaluation));
        let best = ((BEST * population.len() as f64).round() as usize).max(2);
        self.used.clear();
        let trial = |(i, own): (usize, &Candidate)| {
            let [scale, crossover] = self.memory[random.index(MEMORY)];
            let scale = loop {
                let s = random.cauchy(scale, 0.1);
                if s > 0.0 {
                    break s.min(1.0);
                }
            };
            let crossover = (crossover + 0.1 * random.normal()).clamp(0.0, 1.0);
            self.used.push([scale, crossover]);
            let better = &population[ranked[random.index(best.min(ranked.len()))]].point;
            let mut other = |taken: &[usize]| loop {
                let k = random.index(population.len());
                if !taken.contains(&k) {
                    break k;
                }
            };
            let a = other(&[i]);
            let b = other(&[i, a]);
            let (a, b) = (&population[a].point, &population[b].point);
            let kept = random.index(own.point.len());
            let gene = |(k, &x): (usize, &f64)| {
                if k != kept && random.share() >= crossover {
                    return x;
                }
                let moved = x + scale * (better[k] - x) + scale * (a[k] - b[k]);
                // Beyond a bound: half-way between the parent and the bound.
                if moved < 0.0 {
                    0.5 * x
                } else if moved > 1.0 {
                    0.5 * (x + 1.0)
                } else {
                    moved
                }
            };
            own.point.iter().enumerate().map(gene).collect()
        };
        population.iter().enumerate().map(trial).collect()
    }

    pub(super) fn select(&mut self, population: &mut [Candidate], trials: Vec<Candidate>) {
        let mut gained: Vec<([f64; 2], f64)> = Vec::new();
        for (k, (own, trial)) in population.iter_mut().zip(trials).enumerate() {
            let order = trial.evaluation.order(&own.evaluation);
            if order.is_lt() {
                let violation = own.evaluation.violation() - trial.evaluation.violation();
                let objective = own.evaluation.objective - trial.evaluation.objective;
                let gain = if violation > 0.0 {
                    violation
                } else {
                    objective
                };
                gained.push((self.used[k], gain));
            }
            if order.is_le() {
                *own = trial;
            }
        }
        let total: f64 = gained.iter().map(|g| g.1).sum();
        if total > 0.0 && total.is_finite() {
            // Lehmer means, weighted by what each pair gained.
            let mean = |k: usize| {
                let sum = |power: i32| -> f64 {
                    let terms = gained.iter().map(|(pair, gain)| gain * pair[k].powi(power));
                    terms.sum()
                };
                let (square, plain) = (sum(2), sum(1));
                if plain > 0.0 { square / plain } else { 0.0 }
            };
            self.memory[self.next] = [mean(0), mean(1)];
            self.next = (self.next + 1) % MEMORY;
        }
    }
}
