//! Search for a three-arm mechanism that reaches its goals.

mod mesh;

use std::sync::{Arc, Mutex};

use centrode_mechanism::design::Design;
use centrode_mechanism::gear::Limits;
use centrode_mechanism::three_arm::design::{Objective, ThreeArmDesign};
use centrode_mechanism::three_arm::{Parameter, Sweep, SweepError, ThreeArm};

use super::{DesignProblem, Evaluation, Problem, Variable};
use crate::three_arm::{goals, reached};
use crate::{ArmClearance, Goal, Unit};

/// Decimals of the parameters found, degrees or mm, as a machinist reads them.
const DECIMALS: u32 = 3;
/// Inputs at which the tip's path is sampled before its extremes are refined.
const INPUTS: usize = 120;
/// Violation charged for each undercut or short flank.
const FLANK: f64 = 1e-3;
/// Violation charged for each goal skipped because a cheaper one already failed.
const UNSEEN: f64 = 1.0;

/// Three-arm mechanism as a problem: its free parameters, its goals as constraints, and the design's objective.
///
/// A point is evaluated in steps. The figures of a [`Sweep`], in some microseconds: angles, heights, and the curvatures
/// of the pitch curves, which give the module they bear. Only where those are met the exact mechanism is resolved, and
/// clearances and flanks are computed as in a check; and only where those are met, too, full teeth are cut and their contact
/// is followed over a cycle. Goals met so are met in the check.
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
    /// Share by which the module exceeds what the pitch curves bear everywhere; zero or less where they do.
    overload: f64,
}

impl ThreeArmProblem {
    /// Makes the problem around a design, which must be of the kind a [`Sweep`] accepts.
    ///
    /// # Errors
    /// [`SweepError`] where its pitch curve is of another kind.
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

    /// Lends one of the sweeps: each thread needs its own, and each is worth keeping.
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
            follow(&mut design, length);
            figures.module = design
                .gear_tooth_count()
                .map(|z| length / (std::f64::consts::PI * f64::from(z)));
            let module = figures.module.unwrap_or(design.goals.module);
            let largest = Limits::largest_module_of(&design.pair(), sweep.curvatures());
            let overload = module / largest - 1.0;
            let mut goals = goals(&figures, &design.goals);
            goals.push(self.picking_depth(sweep.picking_depth(&design)));
            Some(Quick {
                goals,
                design,
                overload,
            })
        })
    }

    fn picking_depth(&self, depth: f64) -> Goal {
        let wanted = self.start.optimise.picking_depth;
        let about = (0, "picking-depth", "depth of the picking loop");
        Goal::new(
            about,
            Some(depth),
            [Some(wanted), None],
            Unit::Millimetre,
            20.0,
        )
    }

    /// Constraints besides the goals, as goals of number zero.
    fn kept(&self, mechanism: &ThreeArm, arms: Option<&ArmClearance>) -> Vec<Goal> {
        let spec = &self.start.optimise;
        let least = |least: f64| [Some(least), None];
        let clearance = |found: Option<crate::interference::Clearance>| found.map(|f| f.least);
        vec![
            self.picking_depth(mechanism.picking_depth()),
            Goal::new(
                (0, "tray-clearance", "arm's housing clear of the tray"),
                arms.and_then(|a| clearance(a.tray)),
                least(spec.tray_clearance),
                Unit::Millimetre,
                20.0,
            ),
            Goal::new(
                (0, "stem-clearance", "arm clear of stems planted before"),
                arms.and_then(|a| clearance(a.seedlings)),
                least(0.0),
                Unit::Millimetre,
                20.0,
            ),
        ]
    }

    fn exact(&self, mechanism: &ThreeArm) -> Option<Vec<Goal>> {
        let (mut goals, arms) = reached(mechanism);
        // Arms of which no body can be made reach nothing.
        arms.as_ref()?;
        goals.extend(self.kept(mechanism, arms.as_ref()));
        Some(goals)
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

/// Gives the gears as many teeth as leave the module wanted, unless their count is held.
fn follow(design: &mut ThreeArmDesign, length: f64) {
    if design.optimise.hold_tooth_count || design.goals.module <= 0.0 {
        return;
    }
    let most = length / (std::f64::consts::PI * design.goals.module);
    if design.pitch.tooth_count().is_none() && (3.0..10_000.0).contains(&most) {
        design.tooth_count = Some(most as u32);
    }
}

/// Miss of a goal as a share of its scale; zero where it is reached.
fn miss(goal: &Goal) -> Option<f64> {
    goal.margin.map(|margin| (-margin / goal.scale).max(0.0))
}

/// Miss bounded below one, however great it is.
fn bounded(miss: f64) -> f64 {
    miss / (1.0 + miss)
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
        // Quick figures first; goals evaluated only later count as missed until then.
        let nothing = || Evaluation {
            objective: self.moved(point),
            constraints: vec![1e3],
        };
        let unseen = |mut constraints: Vec<f64>, goals: f64| {
            constraints.push(UNSEEN * goals);
            Evaluation {
                objective: self.moved(point),
                constraints,
            }
        };
        let Some(quick) = self.quick(point) else {
            return nothing();
        };
        let mut constraints: Vec<f64> = quick.goals.iter().filter_map(miss).collect();
        let seen = constraints.len();
        constraints.push(quick.overload.max(0.0));
        if constraints.iter().sum::<f64>() > 0.0 {
            // Goals evaluated only later.
            return unseen(constraints, 7.0);
        }
        let Ok(mechanism) = ThreeArm::resolve(&quick.design) else {
            return nothing();
        };
        let Ok(teeth) = mechanism.flank_counts() else {
            return nothing();
        };
        let unsound: u32 = teeth.iter().map(|gear| gear.unsound).sum();
        if unsound > 0 {
            constraints[seen] = bounded(FLANK * f64::from(unsound));
            return unseen(constraints, 6.0);
        }
        let Some(goals) = self.exact(&mechanism) else {
            return nothing();
        };
        constraints = goals.iter().filter_map(miss).map(bounded).collect();
        if constraints.iter().any(|&c| c > 0.0) {
            return unseen(constraints, 2.0);
        }
        let Some(meshing) = mesh::mesh(&quick.design) else {
            return nothing();
        };
        constraints.extend(meshing.iter().filter_map(miss).map(bounded));
        Evaluation {
            objective: self.objective(point, &mechanism, &goals),
            constraints,
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
        let mut goals = self.exact(&ThreeArm::resolve(&quick.design).ok()?)?;
        goals.extend(mesh::mesh(&quick.design).into_iter().flatten());
        Some(goals)
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let quick = self.quick(point)?;
        let mut goals = self.exact(&ThreeArm::resolve(&quick.design).ok()?)?;
        for goal in &mut goals {
            // A count of flanks has no slope; the module that every place of the curves bears has.
            if goal.name == "sound-teeth" && goal.met() == Some(false) {
                let about = (
                    goal.number,
                    goal.name.clone(),
                    "module over what the curves bear",
                );
                *goal = Goal::new(
                    about,
                    Some(1.0 + quick.overload.max(1e-3)),
                    [None, Some(1.0)],
                    Unit::Count,
                    1.0,
                );
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
