use std::sync::Arc;

use centrode_analysis::{Goal, Severity, Unit};
use centrode_optimise::{Evaluation, Problem};
use centrode_spec::Design;
use centrode_synthesis::optimise::{DesignProblem, Variable};

use super::registry::Resolve;

/// Search problem of a family in which a design that meets all goals must also pass the check.
///
/// The check is made only of points that meet everything else, since it takes far longer than an evaluation.
pub(crate) struct PassingProblem {
    pub(crate) inner: Box<dyn DesignProblem + Send>,
    pub(crate) resolve: Resolve,
}

impl PassingProblem {
    /// Number of errors that the check finds at a point, and the sum of the misses of its goals as shares of their scales, each
    /// one at most: near the goals it falls.
    fn errors(&self, point: &[f64]) -> [f64; 2] {
        let Ok(mechanism) = (self.resolve)(self.inner.design(point).as_ref()) else {
            return [1.0, 0.0];
        };
        let report = mechanism.check();
        let errors = report.findings.iter();
        let errors = errors.filter(|f| f.severity == Severity::Error).count();
        let goals = report.goals.iter();
        let missed = goals.filter_map(|goal| Some((-goal.margin? / goal.scale).clamp(0.0, 1.0)));
        [errors as f64, missed.sum()]
    }

    /// The check as a goal; `errors` is its number of errors.
    fn goal(errors: f64) -> Goal {
        let goal = Goal::new(0, "check", "errors of the check", Unit::Count);
        goal.maximum(0.0, 1.0).with(errors)
    }
}

impl Problem for PassingProblem {
    fn bounds(&self) -> Vec<(f64, f64)> {
        self.inner.bounds()
    }

    fn start(&self) -> Option<Vec<f64>> {
        self.inner.start()
    }

    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let mut evaluation = self.inner.evaluate(point);
        let good_enough = self.inner.target().unwrap_or(f64::INFINITY);
        if evaluation.feasible() && evaluation.objective <= good_enough {
            evaluation.constraints.push(self.errors(point).iter().sum());
        }
        evaluation
    }
}

impl DesignProblem for PassingProblem {
    fn variables(&self) -> &[Variable] {
        self.inner.variables()
    }

    fn design(&self, point: &[f64]) -> Arc<dyn Design> {
        self.inner.design(point)
    }

    fn followers(&self, point: &[f64]) -> Vec<(String, f64)> {
        self.inner.followers(point)
    }

    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let mut goals = self.inner.goals(point)?;
        let is_met = goals.iter().all(|goal| goal.met() == Some(true));
        let [errors, _] = if is_met { self.errors(point) } else { [0.0; 2] };
        if errors > 0.0 {
            goals.push(Self::goal(errors));
        }
        Some(goals)
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let mut goals = self.inner.guides(point)?;
        let is_met = goals
            .iter()
            .all(|goal| goal.margin.is_none_or(|margin| margin >= 0.0));
        let errors = if is_met { self.errors(point) } else { [0.0; 2] };
        goals.push(Self::goal(errors.iter().sum()));
        Some(goals)
    }

    fn target(&self) -> Option<f64> {
        // Without a target of its own, the first design that meets everything ends a search.
        self.inner.target().or(Some(f64::MAX))
    }

    fn remark(&self, point: &[f64]) -> Option<String> {
        self.inner.remark(point)
    }
}
