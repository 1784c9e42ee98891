use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

/// What a point is worth.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Evaluation {
    /// To be made small.
    pub objective: f64,
    /// By how much each constraint is broken, in units the problem makes comparable; zero or less where
    /// it is met.
    pub constraints: Vec<f64>,
}

impl Evaluation {
    /// How much the constraints are broken together; zero for a feasible point.
    #[must_use]
    pub fn violation(&self) -> f64 {
        let sum = |v: f64, &c: &f64| if c > 0.0 || c.is_nan() { v + c } else { v };
        self.constraints.iter().fold(0.0, sum)
    }

    /// True where every constraint is met and the objective is a number.
    #[must_use]
    pub fn feasible(&self) -> bool {
        self.violation() <= 0.0 && !self.objective.is_nan()
    }

    /// The better one is less: any feasible point before any other, then by objective; among the others
    /// the one that breaks its constraints less (Deb 2000, DOI 10.1016/S0045-7825(99)00389-8). What is
    /// not a number comes last.
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

/// A point that was evaluated.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Candidate {
    /// The variables.
    pub point: Vec<f64>,
    /// What they are worth.
    pub evaluation: Evaluation,
}

/// Something to be minimised.
pub trait Problem: Sync {
    /// Least and greatest value of each variable.
    fn bounds(&self) -> Vec<(f64, f64)>;

    /// A point to start from, if one is known.
    fn start(&self) -> Option<Vec<f64>> {
        None
    }

    /// The objective and the constraints at a point within the bounds.
    fn evaluate(&self, point: &[f64]) -> Evaluation;

    /// True where one evaluation costs more than handing it to another core: some 10 microseconds.
    fn is_costly(&self) -> bool {
        true
    }
}
