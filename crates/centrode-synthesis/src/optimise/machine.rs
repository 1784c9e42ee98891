//! Search for a composed machine that meets its goals.

use std::sync::Arc;

use centrode_machines::machine::{Machine, MachineDesign, MachineError};
use centrode_spec::Design;

use crate::optimise::{DesignProblem, NotSearched, Variable};
use centrode_analysis::{Goal, machine_goals};
use centrode_optimise::{Evaluation, Problem};

/// Decimals of the numbers found, mm or degrees.
const DECIMALS: u32 = 6;
/// Violation of a point that gives no machine, before the missing distance of a dyad is added.
const NO_MACHINE: f64 = 1e3;

/// A composed machine as a problem: the numbers that its table `vary` lets move, within their bounds, and its goals as
/// constraints. A point that meets all of them ends the search.
#[derive(Clone, Debug)]
pub struct MachineProblem {
    design: MachineDesign,
    variables: Vec<Variable>,
    start: Vec<f64>,
}

impl MachineProblem {
    /// Makes the problem around a design.
    ///
    /// # Errors
    /// [`NotSearched`] if the design has no goal, lets nothing vary, or names a key that holds no number.
    pub fn new(design: &MachineDesign) -> Result<Self, NotSearched> {
        let no = |why: String| NotSearched::Design(why);
        if design.goals.is_empty() {
            return Err(no(
                "the design has no goals: add a table [goals.name]".into()
            ));
        }
        if design.vary.is_empty() {
            return Err(no(
                "no number may change: add a table [vary] with keys and bounds".into(),
            ));
        }
        let (mut variables, mut start) = (Vec::new(), Vec::new());
        for (key, [low, high]) in &design.vary {
            let numbered = design.numbered(key);
            let numbered = numbered.map_err(|error| no(format!("vary: {}", error.message())))?;
            let is_angle = key.ends_with("_deg");
            let kept = |value: f64| if is_angle { value.to_radians() } else { value };
            variables.push(Variable {
                name: key.clone(),
                key: key.clone(),
                bounds: [kept(*low), kept(*high)],
                is_angle,
                decimals: DECIMALS,
            });
            let now = numbered.value().unwrap_or(0.5 * (low + high));
            start.push(kept(now.clamp(*low, *high)));
        }
        Ok(Self {
            design: design.clone(),
            variables,
            start,
        })
    }

    fn at(&self, point: &[f64]) -> Option<Arc<dyn Design>> {
        let mut design: Arc<dyn Design> = Arc::new(self.design.clone());
        for (variable, &value) in self.variables.iter().zip(point) {
            let numbered = design.numbered(&variable.key).ok()?;
            design = numbered.with(variable.written(value)).ok()?;
        }
        Some(design)
    }

    fn made(&self, point: &[f64]) -> Option<Result<Machine, MachineError>> {
        let design = self.at(point)?;
        Some(Machine::resolve(design.downcast_ref()?))
    }
}

impl Problem for MachineProblem {
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
        let constraints = match self.made(point) {
            Some(Ok(machine)) => {
                let miss = |goal: &Goal| goal.margin.map_or(NO_MACHINE, |m| -m / goal.scale);
                machine_goals(&machine).iter().map(miss).collect()
            }
            Some(Err(MachineError::DoesNotClose { dyads })) => {
                // Only the first dyad counts: the others may close as soon as it does.
                let missing = dyads
                    .first()
                    .map_or(f64::INFINITY, |(_, found)| found.missing);
                vec![(NO_MACHINE + missing).min(f64::MAX)]
            }
            _ => vec![f64::MAX],
        };
        Evaluation {
            objective: 0.0,
            constraints,
        }
    }
}

impl DesignProblem for MachineProblem {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn design(&self, point: &[f64]) -> Arc<dyn Design> {
        let design = self.at(point);
        design.unwrap_or_else(|| Arc::new(self.design.clone()))
    }

    fn followers(&self, _point: &[f64]) -> Vec<(String, f64)> {
        Vec::new()
    }

    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>> {
        Some(machine_goals(&self.made(point)?.ok()?))
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        self.goals(point)
    }

    fn target(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[cfg(test)]
mod tests {
    use centrode_machines::machine::MachineDesign;
    use centrode_optimise::{Ended, Settings};
    use centrode_spec::DesignSpec as _;

    use super::MachineProblem;
    use crate::optimise::{DesignProblem, DesignSearch, Strategy};

    const MACHINE: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
D = [105, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { B = [77, 0] }
[dyads.four-bar]
type = "RRR"
from = "crank.B"
to = "frame.D"
lengths = [147, 127]
side = "left"
bodies = ["coupler", "rocker"]
joint = "C"
[dyads.slider]
type = "RRP"
from = "crank.B"
lengths = [200]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "W"
"#;

    #[test]
    fn a_search_finds_lengths_that_meet_the_goals() {
        let text = format!(
            "{MACHINE}[goals.swing]\nfigure = \"rocker.swing\"\nover = \"span\"\nbetween = [59.95, 60.05]\n[goals.holds]\nfigure = \"transmission(four-bar)\"\nover = \"minimum\"\nminimum = 24\n[vary]\n\"bodies.crank.points.B[0]\" = [20, 80]\n\"dyads.four-bar.lengths[0]\" = [100, 180]\n"
        );
        let design = MachineDesign::from_toml(&text).expect("a design");
        let problem = MachineProblem::new(&design).expect("a problem");
        let (_, strategy) = Strategy::NAMES[1];
        let settings = Settings {
            evaluations: 3000,
            seed: 2,
            ..Settings::default()
        };
        let mut search = DesignSearch::new(&problem, strategy, settings).expect("a search");
        let ended = search.run(&problem, &mut |_| std::ops::ControlFlow::Continue(()));
        assert_eq!(ended, Ended::Target);
        let best = problem.goals(&search.best()).expect("a machine");
        assert!(best.iter().all(|goal| goal.met() == Some(true)), "{best:?}");
        assert!(
            MachineProblem::new(&MachineDesign::from_toml(MACHINE).expect("a design")).is_err()
        );
    }
}
