//! Search for a feeder whose effector swings by the required angle.

mod widened;

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::Point;
use centrode_machines::feeder::{Dimension, Feeder, FeederDesign, LinkageSpec};
use centrode_spec::Design;

pub use widened::{NotWidened, Widened};

use super::reach::Reach;
use super::{DesignProblem, Variable};
use centrode_analysis::six_bar::RequiredSwing;
use centrode_analysis::{Attainable, Goal, feeder_goals, six_bar_goals};
use centrode_optimise::{Evaluation, Problem};

/// Feeder as a problem: its free dimensions, the deviation of its swing as objective, and as constraints a rotating crank, the
/// minimum transmission angle and the quick return.
///
/// The displacement of a free pivot is penalised. Motor, gears and dwell do not affect it.
///
/// Source: Ye et al. 2022, DOI 10.6041/j.issn.1000-1298.2022.05.010, (14) to (18).
#[derive(Debug)]
pub struct FeederProblem {
    start: FeederDesign,
    variables: Vec<Variable>,
    dimensions: Vec<Dimension>,
    required: RequiredSwing,
    /// Minimum crank angle of the feed stroke, rad.
    feed: f64,
    reach: Reach,
}

impl FeederProblem {
    /// Makes the problem around a design.
    #[must_use]
    pub fn new(design: &FeederDesign) -> Self {
        let free = design.free_dimensions();
        let variable = |&(dimension, bounds): &(Dimension, [f64; 2])| Variable {
            name: dimension.to_string(),
            key: dimension.key().into(),
            bounds,
            is_angle: false,
            decimals: design.optimise.decimals,
        };
        let goals = &design.goals;
        Self {
            variables: free.iter().map(variable).collect(),
            dimensions: free.iter().map(|&(dimension, _)| dimension).collect(),
            required: RequiredSwing {
                bounds: design.bounds.named().map(|(_, [low, high])| (low, high)),
                pivot: Point::from(design.linkage.pivot),
                branch: design.linkage.branch,
                swing: goals.swing,
                minimum_transmission_angle: Some(goals.transmission_angle),
            },
            feed: TAU * goals.quick_return / (1.0 + goals.quick_return),
            start: design.clone(),
            reach: Reach::default(),
        }
    }

    fn at(&self, point: &[f64]) -> LinkageSpec {
        let mut linkage = self.start.linkage.clone();
        for ((dimension, variable), &value) in
            self.dimensions.iter().zip(&self.variables).zip(point)
        {
            dimension.set(&mut linkage, variable.rounded(value));
        }
        linkage
    }

    fn design_at(&self, point: &[f64]) -> FeederDesign {
        FeederDesign {
            linkage: self.at(point),
            ..self.start.clone()
        }
    }

    /// Displacement of the pivot, mm.
    fn moved(&self, linkage: &LinkageSpec) -> f64 {
        (Point::from(linkage.pivot) - self.required.pivot).norm()
    }
}

impl Problem for FeederProblem {
    fn bounds(&self) -> Vec<(f64, f64)> {
        let bounds = self.variables.iter().map(|v| v.bounds);
        bounds.map(|[low, high]| (low, high)).collect()
    }

    fn start(&self) -> Option<Vec<f64>> {
        let value = |dimension: &Dimension| dimension.of(&self.start.linkage);
        Some(self.dimensions.iter().map(value).collect())
    }

    /// Evaluates a point: the objective is the swing's deviation plus the pivot's displacement times its weight, rad.
    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let linkage = self.at(point);
        let lengths = [
            linkage.crank,
            linkage.coupler,
            linkage.rocker,
            linkage.frame,
        ];
        let (mut evaluation, six_bar) = self
            .required
            .evaluated(&lengths, Point::from(linkage.pivot));
        if let Some(six_bar) = six_bar {
            let feed = six_bar.extremes().longer_stroke();
            evaluation.constraints.push(self.feed - feed);
            // A linkage whose crank does not turn has neither stroke.
            if six_bar.four_bar().grashof_margin() > 0.0 {
                self.reach
                    .record(&six_bar_goals(&six_bar, &self.start.goals));
            }
        }
        if self.start.optimise.free_pivot {
            evaluation.objective += self.start.optimise.pivot_weight * self.moved(&linkage);
        }
        evaluation
    }

    fn is_costly(&self) -> bool {
        false
    }
}

impl DesignProblem for FeederProblem {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn design(&self, point: &[f64]) -> Arc<dyn Design> {
        Arc::new(self.design_at(point))
    }

    fn followers(&self, _point: &[f64]) -> Vec<(String, f64)> {
        Vec::new()
    }

    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>> {
        let feeder = Feeder::resolve(&self.design_at(point)).ok()?;
        Some(feeder_goals(&feeder))
    }

    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>> {
        self.goals(point)
    }

    fn target(&self) -> Option<f64> {
        Some(self.start.optimise.accuracy)
    }

    fn remark(&self, point: &[f64]) -> Option<String> {
        let goals = self.goals(point)?;
        let missed = |name: &str| {
            let mut missed = goals.iter().filter(|goal| goal.met() == Some(false));
            missed.any(|goal| goal.name == name)
        };
        if missed("transmission-angle") {
            return Some(match Attainable::search(&self.start) {
                Some(found) => format!("infeasible: {found}"),
                None => "infeasible: no crank-rocker within the bounds has the required transmission angle".into(),
            });
        }
        if ["swing", "quick-return"].into_iter().any(missed)
            && let Some(why) = self.reach.contradictions()
        {
            return Some(why);
        }
        let spec = &self.start.optimise;
        spec.free_pivot.then(|| {
            format!(
                "the pivot was moved by {:.4} mm; the search counts each mm as {} deg of swing. Without this weight, lengths of any size would reach the swing, each with its own positions of the pivot",
                self.moved(&self.at(point)),
                spec.pivot_weight.to_degrees()
            )
        })
    }
}

#[cfg(test)]
mod tests;
