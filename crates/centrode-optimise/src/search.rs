use std::ops::ControlFlow;

use centrode_geometry::Cancel;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde::{Deserialize, Serialize};

use super::cma_es::CmaEs;
use super::differential_evolution::DifferentialEvolution;
use super::genetic;
use super::problem::{Candidate, Problem};
use super::random::Random;

/// Method of search.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Method {
    /// A real-coded genetic algorithm.
    #[serde(rename = "ga")]
    Genetic,
    /// Differential evolution that learns its parameters.
    #[default]
    #[serde(rename = "de")]
    DifferentialEvolution,
    /// Covariance matrix adaptation, with restarts.
    CmaEs,
}

impl Method {
    /// Every method by its name.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("ga", Self::Genetic),
        ("de", Self::DifferentialEvolution),
        ("cma-es", Self::CmaEs),
    ];
}

/// Settings of a search: its method, its length and its start.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Settings {
    /// Method.
    pub method: Method,
    /// Seed: the same one gives the same answer.
    pub seed: u64,
    /// Points per generation; default: by the method and the number of variables.
    pub population: Option<usize>,
    /// Maximum number of evaluations; the generation under way is finished.
    pub evaluations: u64,
    /// Objective at which a feasible point is good enough.
    pub target: Option<f64>,
}

impl Settings {
    /// Target that no objective reaches: the search goes on to improve a design that meets everything.
    pub const POLISH: f64 = f64::MIN;
}

impl Settings {
    /// Refuses a population too small for any method.
    ///
    /// # Errors
    /// [`SearchError::Population`].
    pub fn validate(&self) -> Result<(), SearchError> {
        let minimum = MIN_POPULATION;
        match self.population {
            Some(count) if count < minimum => Err(SearchError::Population { count, minimum }),
            _ => Ok(()),
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::default(),
            seed: 1,
            population: None,
            evaluations: 20_000,
            target: None,
        }
    }
}

/// Best point found up to the end of a generation.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Progress {
    /// Generations done.
    pub generation: u64,
    /// Evaluations done.
    pub evaluations: u64,
    /// Objective of the best point.
    pub objective: f64,
    /// Violation of the best point.
    pub violation: f64,
}

/// Reason why a search stopped.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub enum Ended {
    /// The target was reached.
    Target,
    /// The evaluations are used up.
    Evaluations,
    /// The observer requested it.
    Stopped,
    /// No step improves the result any more.
    Stuck,
}

/// Reason why a search cannot start.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// No variable.
    #[error("the problem has no variable")]
    NoVariable,
    /// No evaluation allowed.
    #[error("a search needs at least 1 evaluation; evaluations is 0")]
    NoEvaluation,
    /// A variable whose bounds are not finite or not ascending.
    #[error("variable {index} runs from {low} to {high}: the bounds must be finite and ascending")]
    Bounds {
        /// Index of the variable.
        index: usize,
        /// Minimum value.
        low: f64,
        /// Maximum value.
        high: f64,
    },
    /// Too few points for a generation.
    #[error("population is {count}, but it must be at least {minimum}")]
    Population {
        /// Number given.
        count: usize,
        /// Number that the methods need.
        minimum: usize,
    },
}

/// Minimum number of points per generation.
const MIN_POPULATION: usize = 5;

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
enum State {
    Genetic,
    DifferentialEvolution(DifferentialEvolution),
    CmaEs(CmaEs),
}

/// Search in progress: it can be stored and continued.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Search {
    settings: Settings,
    bounds: Vec<(f64, f64)>,
    state: State,
    /// Points with every variable from 0 to 1.
    population: Vec<Candidate>,
    best: Candidate,
    generation: u64,
    evaluations: u64,
    history: Vec<Progress>,
}

impl Search {
    /// Makes the first generation: a Latin hypercube, or the points of the first distribution.
    ///
    /// # Errors
    /// [`SearchError`].
    pub fn new(problem: &dyn Problem, settings: Settings) -> Result<Self, SearchError> {
        let bounds = problem.bounds();
        if bounds.is_empty() {
            return Err(SearchError::NoVariable);
        }
        if settings.evaluations == 0 {
            return Err(SearchError::NoEvaluation);
        }
        for (index, &(low, high)) in bounds.iter().enumerate() {
            if !(low.is_finite() && high.is_finite() && low <= high) {
                return Err(SearchError::Bounds { index, low, high });
            }
        }
        let n = bounds.len();
        let start = problem.start().map(|point| shares(&bounds, &point));
        let usual = match settings.method {
            Method::CmaEs => 4 + (3.0 * (n as f64).ln()) as usize,
            Method::Genetic => (20 * n).clamp(60, 400),
            Method::DifferentialEvolution => (10 * n).clamp(20, 200),
        };
        settings.validate()?;
        let count = settings.population.unwrap_or(usual);
        let mut random = Random::new(settings.seed, 0);
        let (state, points) = match settings.method {
            Method::CmaEs => {
                let mut cma_es = CmaEs::new(n, count, start.as_deref(), &mut random);
                let points = cma_es.points(&mut random);
                (State::CmaEs(cma_es), points)
            }
            method => {
                let state = if method == Method::Genetic {
                    State::Genetic
                } else {
                    State::DifferentialEvolution(DifferentialEvolution::new())
                };
                let mut points = latin_hypercube(n, count, &mut random);
                if let Some(start) = start {
                    points[0] = start;
                }
                (state, points)
            }
        };
        let population = evaluated(problem, &bounds, points);
        let mut search = Self {
            settings,
            bounds,
            state,
            best: population[0].clone(),
            population: Vec::new(),
            generation: 0,
            evaluations: 0,
            history: Vec::new(),
        };
        search.take_in(&population);
        match &mut search.state {
            State::CmaEs(cma_es) => cma_es.update(&population),
            _ => search.population = population,
        }
        Ok(search)
    }

    /// Makes one more generation.
    pub fn step(&mut self, problem: &dyn Problem) {
        let mut random = Random::new(self.settings.seed, self.generation);
        let points = match &mut self.state {
            State::Genetic => genetic::children(&self.population, &mut random),
            State::DifferentialEvolution(de) => de.trials(&self.population, &mut random),
            State::CmaEs(cma_es) => cma_es.points(&mut random),
        };
        let points = evaluated(problem, &self.bounds, points);
        self.take_in(&points);
        match &mut self.state {
            State::Genetic => genetic::select(&mut self.population, points),
            State::DifferentialEvolution(de) => de.select(&mut self.population, points),
            State::CmaEs(cma_es) => cma_es.update(&points),
        }
    }

    /// Searches until the target is reached, maximum number of evaluations reached or `observe` stops the search; the best point found is
    /// stored in every case.
    pub fn run(
        &mut self,
        problem: &dyn Problem,
        observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Ended {
        loop {
            let evaluation = &self.best.evaluation;
            let reached = |target| evaluation.feasible() && evaluation.objective <= target;
            if self.settings.target.is_some_and(reached) {
                return Ended::Target;
            }
            if self.evaluations >= self.settings.evaluations {
                return Ended::Evaluations;
            }
            if let Some(progress) = self.history.last()
                && observe(progress).is_break()
            {
                return Ended::Stopped;
            }
            self.step(problem);
        }
    }

    /// Sets the maximum total number of evaluations, including those already done.
    pub fn allow(&mut self, evaluations: u64) {
        self.settings.evaluations = evaluations;
    }

    fn take_in(&mut self, points: &[Candidate]) {
        self.generation += 1;
        self.evaluations += points.len() as u64;
        for candidate in points {
            if candidate.evaluation.order(&self.best.evaluation).is_lt() {
                self.best = candidate.clone();
            }
        }
        self.history.push(Progress {
            generation: self.generation,
            evaluations: self.evaluations,
            objective: self.best.evaluation.objective,
            violation: self.best.evaluation.violation(),
        });
    }

    /// The best point found.
    #[must_use]
    pub fn best(&self) -> Candidate {
        Candidate {
            point: inside(&self.bounds, &self.best.point),
            evaluation: self.best.evaluation.clone(),
        }
    }

    /// The best after each generation.
    #[must_use]
    pub fn history(&self) -> &[Progress] {
        &self.history
    }

    /// Settings of the search.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Evaluations done.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

/// Searches from the start.
///
/// # Errors
/// [`SearchError`].
pub fn minimise(
    problem: &dyn Problem,
    settings: Settings,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<(Search, Ended), SearchError> {
    let mut search = Search::new(problem, settings)?;
    let ended = search.run(problem, observe);
    Ok((search, ended))
}

fn inside(bounds: &[(f64, f64)], shares: &[f64]) -> Vec<f64> {
    let bounds = bounds.iter().zip(shares);
    bounds
        .map(|(&(low, high), share)| (low + (high - low) * share).clamp(low, high))
        .collect()
}

fn shares(bounds: &[(f64, f64)], point: &[f64]) -> Vec<f64> {
    let share = |(&(low, high), value): (&(f64, f64), &f64)| {
        let share = (value - low) / (high - low);
        // A variable with an empty range has no share.
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    bounds.iter().zip(point).map(share).collect()
}

fn evaluated(
    problem: &dyn Problem,
    bounds: &[(f64, f64)],
    points: Vec<Vec<f64>>,
) -> Vec<Candidate> {
    let cancel = Cancel::current();
    let candidate = |point: Vec<f64>| {
        let _scope = cancel.enter();
        Candidate {
            evaluation: problem.evaluate(&inside(bounds, &point)),
            point,
        }
    };
    if problem.is_costly() {
        points.into_par_iter().panic_fuse().map(candidate).collect()
    } else {
        points.into_iter().map(candidate).collect()
    }
}

/// Points such that each variable is once in each of `count` equal parts of its range.
fn latin_hypercube(dimension: usize, count: usize, random: &mut Random) -> Vec<Vec<f64>> {
    let mut points = vec![vec![0.0; dimension]; count];
    for k in 0..dimension {
        let mut parts: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            parts.swap(i, random.index(i + 1));
        }
        for (point, part) in points.iter_mut().zip(parts) {
            point[k] = (part as f64 + random.share()) / count as f64;
        }
    }
    points
}
