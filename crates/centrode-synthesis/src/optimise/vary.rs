//! Search for a design of any family that meets the goals in its file.

use std::fmt;
use std::sync::Arc;

use centrode_spec::{Design, Named, NumberedDesign};

use super::reach::Reach;
use crate::optimise::{DesignProblem, NotSearched, Variable};
use centrode_analysis::Goal;
use centrode_optimise::{Evaluation, Problem};

/// Decimals of the numbers found, mm or degrees.
const DECIMALS: u32 = 6;
/// Violation of a point that gives no machine, and miss of a goal whose figure cannot be determined, as a share of its scale. It must
/// be far above the misses of goals that have a figure.
pub const NO_MACHINE: f64 = 1e3;

/// Goals of a design with their figures, or the violation of a design that gives no machine.
pub type GoalsOf = Box<dyn Fn(&dyn Design) -> Result<Vec<Goal>, f64> + Send + Sync>;

/// A design as a problem: the numbers that its table `vary` lets move, within their bounds, and its goals as constraints. A point
/// that meets all of them ends the search.
pub struct VaryProblem {
    design: Arc<dyn Design>,
    numbered: NumberedDesign,
    goals_of: GoalsOf,
    variables: Vec<Variable>,
    start: Vec<f64>,
    reach: Reach,
}

impl fmt::Debug for VaryProblem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = out.debug_struct("VaryProblem");
        fields.field("design", &self.design).finish_non_exhaustive()
    }
}

impl VaryProblem {
    /// Makes the problem around a design with `goals` goals.
    ///
    /// # Errors
    /// [`NotSearched`] if the design has no goal, lets nothing vary, or names a key that holds no number.
    pub fn new(
        design: Arc<dyn Design>,
        goals: usize,
        vary: &Named<[f64; 2]>,
        goals_of: GoalsOf,
    ) -> Result<Self, NotSearched> {
        let no = |why: String| NotSearched::Design(why);
        if goals == 0 {
            return Err(no(
                "the design has no goals: add a table [goals.name]".into()
            ));
        }
        if vary.is_empty() {
            return Err(no(
                "no number may change: add a table [vary] with keys and bounds".into(),
            ));
        }
        let (mut variables, mut start) = (Vec::new(), Vec::new());
        let keys: Vec<&str> = vary.keys().map(String::as_str).collect();
        let numbered = design.numbered(&keys);
        let numbered = numbered.map_err(|error| no(format!("vary: {}", error.message())))?;
        for (at, (key, [low, high])) in vary.iter().enumerate() {
            let is_angle = key
                .split('[')
                .next()
                .is_some_and(|key| key.ends_with("_deg"));
            let kept = |value: f64| if is_angle { value.to_radians() } else { value };
            variables.push(Variable {
                name: key.clone(),
                key: key.clone(),
                bounds: [kept(*low), kept(*high)],
                is_angle,
                decimals: DECIMALS,
            });
            let now = numbered.value(at).unwrap_or(0.5 * (low + high));
            start.push(kept(now.clamp(*low, *high)));
        }
        Ok(Self {
            design,
            numbered,
            goals_of,
            variables,
            start,
            reach: Reach::default(),
        })
    }

    fn at(&self, point: &[f64]) -> Option<Arc<dyn Design>> {
        let values = self.variables.iter().zip(point);
        let values: Vec<f64> = values
            .map(|(variable, &value)| variable.written(value))
            .collect();
        self.numbered.with(&values).ok()
    }

    /// Goals at a point. A figure that cannot be determined is missed by far.
    fn goals_at(&self, point: &[f64]) -> Result<Vec<Goal>, f64> {
        let design = self.at(point).ok_or(f64::MAX)?;
        let mut goals = (self.goals_of)(design.as_ref())?;
        for goal in &mut goals {
            goal.margin.get_or_insert(-NO_MACHINE * goal.scale);
        }
        self.reach.record(&goals);
        Ok(goals)
    }
}

impl Problem for VaryProblem {
    fn bounds(&self) -> Vec<(f64, f64)> {
        let bounds = self.variables.iter().map(|v| v.bounds);
        bounds.map(|[low, high]| (low, high)).collect()
    }

    fn start(&self) -> Option<Vec<f64>> {
        Some(self.start.clone())
    }

    /// Evaluates a point: no objective, and each goal's miss by its scale; for a machine that does not close, the violation grows
    /// with the missing distance.
    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let miss = |goal: &Goal| -goal.margin.unwrap_or(-NO_MACHINE * goal.scale) / goal.scale;
        Evaluation {
            objective: 0.0,
            constraints: match self.goals_at(point) {
                Ok(goals) => goals.iter().map(miss).collect(),
                Err(violation) => vec![violation],
            },
        }
    }
}

impl DesignProblem for VaryProblem {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn design(&self, point: &[f64]) -> Arc<dyn Design> {
        self.at(point).unwrap_or_else(|| Arc::clone(&self.design))
    }

    fn followers(&self, _point: &[f64]) -> Vec<(String, f64)> {
        Vec::new()
    }

    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>> {
        self.goals_at(point).ok()
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        self.goals(point)
    }

    fn target(&self) -> Option<f64> {
        Some(0.0)
    }

    fn remark(&self, point: &[f64]) -> Option<String> {
        let goals = self.goals(point).unwrap_or_default();
        let is_met = !goals.is_empty() && goals.iter().all(|goal| goal.met() == Some(true));
        if is_met {
            None
        } else {
            self.reach.contradictions()
        }
    }
}
