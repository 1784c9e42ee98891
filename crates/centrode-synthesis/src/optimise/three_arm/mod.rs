//! Search for a three-arm mechanism that reaches its goals.

mod evaluation;
mod mesh;
mod posed;

use std::sync::{Arc, Mutex};

use centrode_gear::Limits;
use centrode_machines::three_arm::design::{Objective, ThreeArmDesign};
use centrode_machines::three_arm::{Parameter, Sweep, SweepError, ThreeArm};
use centrode_spec::Design;

use super::{DesignProblem, Variable};
use centrode_analysis::{Goal, Unit, three_arm_goals};
use centrode_optimise::{Evaluation, Problem};

pub use posed::{Posed, PosedProblem};

/// Decimals of the parameters found, degrees or mm, as a machinist reads them.
const DECIMALS: u32 = 3;
/// Inputs at which the tip's path is sampled before its extremes are refined.
const INPUTS: usize = 120;

/// Three-arm mechanism as a problem: its free parameters, its goals as constraints, and the design's objective.
///
/// A point is evaluated in steps. The figures of a [`Sweep`], in some microseconds: angles, heights, and the curvatures of the
/// pitch curves, which give the module they allow. Only if these goals are met, the exact mechanism is resolved, and clearances
/// and flanks are computed as in a check. Only if these are met, too, full teeth are cut and their contact is followed over a
/// cycle. Goals met in this evaluation are met in the check.
#[derive(Debug)]
pub struct ThreeArmProblem {
    start: ThreeArmDesign,
    variables: Vec<Variable>,
    parameters: Vec<Parameter>,
    sweeps: Mutex<Vec<Sweep>>,
    template: Sweep,
}

/// Quick evaluation of a point.
struct Quick {
    design: ThreeArmDesign,
    goals: Vec<Goal>,
    /// Share by which the module exceeds what the pitch curves allow everywhere; zero or less if they allow it.
    overload: f64,
}

impl ThreeArmProblem {
    /// Makes the problem around a design, which must be of the kind a [`Sweep`] accepts.
    ///
    /// # Errors
    /// [`SweepError`] if its pitch curve is of another kind.
    pub fn new(design: &ThreeArmDesign) -> Result<Self, SweepError> {
        let template = Sweep::like(design, INPUTS)?;
        let free = design.free_parameters();
        let variable = |&(parameter, bounds): &(Parameter, [f64; 2])| Variable {
            name: parameter.to_string(),
            key: parameter.key(),
            bounds,
            is_angle: parameter.is_angle(),
            decimals: DECIMALS,
        };
        Ok(Self {
            start: design.clone(),
            variables: free.iter().map(variable).collect(),
            parameters: free.iter().map(|&(parameter, _)| parameter).collect(),
            sweeps: Mutex::new(Vec::new()),
            template,
        })
    }

    fn at(&self, point: &[f64]) -> ThreeArmDesign {
        let mut design = self.start.clone();
        for ((parameter, variable), &value) in
            self.parameters.iter().zip(&self.variables).zip(point)
        {
            parameter.set(&mut design, variable.rounded(value));
        }
        design
    }

    /// Calls `look` with an idle sweep or a new one, and stores it for the next call: each thread needs its own.
    fn with_sweep<T>(&self, look: impl FnOnce(&mut Sweep) -> T) -> T {
        let idle = self.sweeps.lock().ok().and_then(|mut idle| idle.pop());
        let mut sweep = idle.unwrap_or_else(|| self.template.clone());
        let seen = look(&mut sweep);
        if let Ok(mut idle) = self.sweeps.lock() {
            idle.push(sweep);
        }
        seen
    }

    fn quick(&self, point: &[f64]) -> Option<Quick> {
        let mut design = self.at(point);
        design.validate().ok()?;
        self.with_sweep(|sweep| {
            let mut figures = sweep.figures(&design).ok()?;
            let length = sweep.pitch_length();
            evaluation::follow(&mut design, length);
            figures.module = design
                .gear_tooth_count()
                .map(|z| length / (std::f64::consts::PI * f64::from(z)));
            let module = figures.module.unwrap_or(design.goals.module);
            let largest = Limits::largest_module_of(&design.pair(), sweep.curvatures());
            let overload = module / largest - 1.0;
            let mut goals = three_arm_goals(&figures, &design.goals);
            goals.push(evaluation::picking_depth(
                &design,
                sweep.picking_depth(&design),
            ));
            Some(Quick {
                goals,
                design,
                overload,
            })
        })
    }

    fn objective(&self, point: &[f64], mechanism: &ThreeArm, goals: &[Goal]) -> f64 {
        match self.start.optimise.objective {
            Objective::PickingSpeed => {
                let speed = mechanism.tip(mechanism.picking(0), 0).velocity.norm();
                speed * mechanism.carrier_speed()
            }
            Objective::Margin => {
                // A count of flanks has no margin beyond zero.
                let wide = goals.iter().filter(|goal| goal.name != "sound-teeth");
                let margins = wide.filter_map(|goal| Some(goal.margin? / goal.scale));
                -margins.fold(f64::INFINITY, f64::min)
            }
            _ => self.moved(point),
        }
    }

    /// Root mean square of the variables' moves from the start as shares of their bounds.
    fn moved(&self, point: &[f64]) -> f64 {
        let mut sum = 0.0;
        for ((parameter, variable), &value) in
            self.parameters.iter().zip(&self.variables).zip(point)
        {
            let from = parameter.of(&self.start).unwrap_or(value);
            let [low, high] = variable.bounds;
            sum += ((variable.rounded(value) - from) / (high - low)).powi(2);
        }
        (sum / point.len().max(1) as f64).sqrt()
    }
}

impl Problem for ThreeArmProblem {
    fn bounds(&self) -> Vec<(f64, f64)> {
        self.variables
            .iter()
            .map(|v| (v.bounds[0], v.bounds[1]))
            .collect()
    }

    fn start(&self) -> Option<Vec<f64>> {
        let value = |parameter: &Parameter| parameter.of(&self.start);
        self.parameters.iter().map(value).collect()
    }

    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let nothing = || Evaluation {
            objective: self.moved(point),
            constraints: vec![1e3],
        };
        let Some(quick) = self.quick(point) else {
            return nothing();
        };
        let Some(evaluated) = evaluation::judge(&quick.goals, quick.overload, || {
            ThreeArm::resolve(&quick.design).ok()
        }) else {
            return nothing();
        };
        let objective = match &evaluated.reached {
            Some((mechanism, goals)) => self.objective(point, mechanism, goals),
            None => self.moved(point),
        };
        Evaluation {
            objective,
            constraints: evaluated.constraints,
        }
    }
}

impl DesignProblem for ThreeArmProblem {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn design(&self, point: &[f64]) -> Arc<dyn Design> {
        let quick = self.quick(point);
        Arc::new(quick.map_or_else(|| self.at(point), |q| q.design))
    }

    fn followers(&self, point: &[f64]) -> Vec<(String, f64)> {
        let count = self.quick(point).and_then(|quick| quick.design.tooth_count);
        let count = count.filter(|_| !self.start.optimise.hold_tooth_count);
        count
            .map(|z| ("tooth_count".to_owned(), f64::from(z)))
            .into_iter()
            .collect()
    }

    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let quick = self.quick(point)?;
        let mut goals = evaluation::exact(&ThreeArm::resolve(&quick.design).ok()?)?;
        goals.extend(mesh::mesh(&quick.design).into_iter().flatten());
        Some(goals)
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let quick = self.quick(point)?;
        let mut goals = evaluation::exact(&ThreeArm::resolve(&quick.design).ok()?)?;
        for goal in &mut goals {
            // A count of flanks has no slope; the module relative to the largest one that the curves allow has a slope.
            if goal.name == "sound-teeth" && goal.met() == Some(false) {
                let title = "module exceeds the largest module without undercut";
                *goal = Goal::new(goal.number, goal.name.clone(), title, Unit::Count)
                    .maximum(1.0, 1.0)
                    .with(1.0 + quick.overload.max(1e-3));
            }
        }
        if quick.overload <= 0.0 {
            goals.extend(mesh::mesh(&quick.design).into_iter().flatten());
        }
        Some(goals)
    }
}

#[cfg(test)]
mod tests;
