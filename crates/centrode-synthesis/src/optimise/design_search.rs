use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::{DesignProblem, GuidedSearch, GuidedStep};
use centrode_optimise::{Ended, Method, Progress, Search, SearchError, Settings};

/// Strategy of a search for a better design.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[non_exhaustive]
pub enum Strategy {
    /// Search goal by goal, by the parameters that influence it most.
    Guided,
    /// Search everywhere within the bounds.
    Global(Method),
}

impl Strategy {
    /// Every strategy by its name.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("guided", Self::Guided),
        ("cma-es", Self::Global(Method::CmaEs)),
        ("de", Self::Global(Method::DifferentialEvolution)),
        ("ga", Self::Global(Method::Genetic)),
    ];

    /// Name of the strategy.
    #[must_use]
    pub fn name(self) -> &'static str {
        let named = Self::NAMES.into_iter().find(|(_, one)| *one == self);
        named.map_or("", |(name, _)| name)
    }
}

/// State of a search for a better design, which can be stored and continued.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct DesignSearch {
    /// Variables with their bounds; a search goes on only with equal ones.
    variables: Vec<(String, [f64; 2])>,
    evaluations: u64,
    state: State,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
enum State {
    Guided(Box<GuidedSearch>),
    Global(Box<Search>),
}

fn variables(problem: &dyn DesignProblem) -> Vec<(String, [f64; 2])> {
    let variables = problem.variables().iter();
    variables.map(|v| (v.name.clone(), v.bounds)).collect()
}

impl DesignSearch {
    /// Starts a search from the problem's start. The method of the settings is ignored; without a target the one of the problem
    /// is used.
    ///
    /// # Errors
    /// [`SearchError`] if there is nothing to search.
    pub fn new(
        problem: &dyn DesignProblem,
        strategy: Strategy,
        settings: Settings,
    ) -> Result<Self, SearchError> {
        settings.validate()?;
        let state = match strategy {
            Strategy::Guided if problem.variables().is_empty() => {
                return Err(SearchError::NoVariable);
            }
            Strategy::Guided if settings.evaluations == 0 => {
                return Err(SearchError::NoEvaluation);
            }
            Strategy::Guided => State::Guided(Box::new(GuidedSearch::new(problem))),
            Strategy::Global(method) => {
                let target = settings.target.or_else(|| problem.target());
                let settings = Settings {
                    method,
                    target,
                    ..settings
                };
                State::Global(Box::new(Search::new(problem, settings)?))
            }
        };
        Ok(Self {
            variables: variables(problem),
            evaluations: settings.evaluations,
            state,
        })
    }

    /// Whether the search is of this problem: the same variables with the same bounds.
    #[must_use]
    pub fn is_of(&self, problem: &dyn DesignProblem) -> bool {
        self.variables == variables(problem)
    }

    /// Strategy of the search.
    #[must_use]
    pub fn strategy(&self) -> Strategy {
        match &self.state {
            State::Guided(_) => Strategy::Guided,
            State::Global(search) => Strategy::Global(search.settings().method),
        }
    }

    /// Seed; `None` for a guided search, which is deterministic.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        match &self.state {
            State::Guided(_) => None,
            State::Global(search) => Some(search.settings().seed),
        }
    }

    /// Maximum number of evaluations in all.
    #[must_use]
    pub fn allowed(&self) -> u64 {
        self.evaluations
    }

    /// Sets the maximum number of evaluations in all, including those already made.
    pub fn allow(&mut self, evaluations: u64) {
        self.evaluations = evaluations;
        if let State::Global(search) = &mut self.state {
            search.allow(evaluations);
        }
    }

    /// Searches until the search is at its end, maximum number of evaluations reached or `observe` breaks off; the best found is kept in
    /// every case.
    pub fn run(
        &mut self,
        problem: &dyn DesignProblem,
        observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Ended {
        match &mut self.state {
            State::Global(search) => search.run(problem, observe),
            State::Guided(search) => search.run(problem, self.evaluations, &mut |search| {
                observe(&search.progress())
            }),
        }
    }

    /// The best point found.
    #[must_use]
    pub fn best(&self) -> Vec<f64> {
        match &self.state {
            State::Global(search) => search.best().point,
            State::Guided(search) => search.point().to_vec(),
        }
    }

    /// Progress; `None` before the first generation of a global search.
    #[must_use]
    pub fn progress(&self) -> Option<Progress> {
        match &self.state {
            State::Global(search) => search.history().last().copied(),
            State::Guided(search) => Some(search.progress()),
        }
    }

    /// The best after each generation, or after each step of a guided search.
    #[must_use]
    pub fn history(&self) -> &[Progress] {
        match &self.state {
            State::Global(search) => search.history(),
            State::Guided(search) => search.history(),
        }
    }

    /// The steps of a guided search; empty for another search.
    #[must_use]
    pub fn log(&self) -> &[GuidedStep] {
        match &self.state {
            State::Global(_) => &[],
            State::Guided(search) => search.log(),
        }
    }
}
