use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

/// Value of a point: objective and constraints.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Evaluation {
    /// Objective, to be minimised.
    pub objective: f64,
    /// Violation of each constraint, in units the problem makes comparable; zero or less where it is met.
    pub constraints: Vec<f64>,
}

impl Evaluation {
    /// Sum of the violations; zero for a feasible point.
    #[must_use]
    pub fn violation(&self) -> f64 {
        let sum = |v: f64, &c: &f64| if c > 0.0 || c.is_nan() { v + c } else { v };
        self.constraints.iter().fold(0.0, sum)
    }

    /// Whether every constraint is met and the objective is a number.
    #[must_use]
    pub fn feasible(&self) -> bool {
        self.violation() <= 0.0 && !self.objective.is_nan()
    }

    /// Order in which the better one is less: feasible points before infeasible ones, feasible points by objective, infeasible
    /// ones by violation (Deb 2000, DOI 10.1016/S0045-7825(99)00389-8). Values that are not numbers come last.
    #[must_use]
    pub fn order(&self, other: &Self) -> Ordering {
        let key = |e: &Self| {
            let (violation, objective) = (e.violation(), e.objective);
            let last = |v: f64| if v.is_nan() { f64::INFINITY } else { v };
            (last(violation), last(objective))
        };
        let (a, b) = (key(self), key(other));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    }
}

/// Point that was evaluated.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Candidate {
    /// The variables.
    pub point: Vec<f64>,
    /// Evaluation of the point.
    pub evaluation: Evaluation,
}

/// Problem of minimisation under constraints.
pub trait Problem: Sync {
    /// Minimum and maximum value of each variable.
    fn bounds(&self) -> Vec<(f64, f64)>;

    /// Point to start from, if one is known.
    fn start(&self) -> Option<Vec<f64>> {
        None
    }

    /// The objective and the constraints at a point within the bounds.
    fn evaluate(&self, point: &[f64]) -> Evaluation;

    /// Whether one evaluation takes longer than handing it to another core: some 10 microseconds.
    fn is_costly(&self) -> bool {
        true
    }
}
