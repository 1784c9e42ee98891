use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::ops::ControlFlow;

use centrode_machines::feeder::FeederDesign;

use crate::six_bar::{BestTransmissionAngle, Lengths, MinimumWidening};
use centrode_optimise::{Candidate, Method, Problem, Settings, minimise};

/// Evaluations of the search for the best attainable transmission angle. Fewer can miss the best, more take longer.
const ATTAINABLE: u64 = 20_000;
/// Evaluations of the search for the minimum widening of the bounds. Fewer can miss the minimum, more take longer.
const WIDENING: u64 = 40_000;

/// Largest minimum transmission angle that the bounds of a feeder's lengths allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attainable {
    /// Largest minimum transmission angle of any crank-rocker within the bounds, rad.
    pub transmission_angle: f64,
    /// Lengths of crank, coupler, rocker and frame at that angle, mm.
    pub lengths: [f64; 4],
    /// Share by which all bounds must be widened to reach the required angle; `None` if the bounds allow that angle.
    pub widening: Option<f64>,
    /// Lengths of crank, coupler, rocker and frame within the widened bounds, mm.
    pub widened_lengths: [f64; 4],
}

impl Attainable {
    /// Searches the bounds of a design's lengths; equal designs give equal results.
    ///
    /// `None` if no crank-rocker is found within the bounds, or none that reaches the required angle within wider bounds.
    #[must_use]
    pub fn search(design: &FeederDesign) -> Option<Self> {
        let bounds: Lengths = design.bounds.named().map(|(_, [a, b])| (a, b));
        let required = design.goals.transmission_angle;
        let best = search(&BestTransmissionAngle { bounds }, ATTAINABLE)?;
        let lengths = best.point.clone().try_into().ok()?;
        let transmission_angle = FRAC_PI_2 - best.evaluation.objective;
        if transmission_angle >= required {
            return Some(Self {
                transmission_angle,
                lengths,
                widening: None,
                widened_lengths: lengths,
            });
        }
        let problem = MinimumWidening {
            bounds,
            minimum_transmission_angle: required,
        };
        let minimum = search(&problem, WIDENING)?;
        Some(Self {
            transmission_angle,
            lengths,
            widening: Some(minimum.evaluation.objective),
            widened_lengths: problem.lengths(&minimum.point).try_into().ok()?,
        })
    }
}

fn search(problem: &dyn Problem, evaluations: u64) -> Option<Candidate> {
    let settings = Settings {
        method: Method::DifferentialEvolution,
        evaluations,
        ..Settings::default()
    };
    let found = minimise(problem, settings, &mut |_| ControlFlow::Continue(())).ok()?;
    let best = found.0.best();
    best.evaluation.feasible().then_some(best)
}

impl fmt::Display for Attainable {
    /// Writes the limit that the bounds set to the transmission angle.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let best = self.transmission_angle.to_degrees();
        let words = |lengths: [f64; 4]| lengths.map(|l| format!("{l:.3}")).join(", ");
        let at = words(self.lengths);
        let Some(widening) = self.widening else {
            return write!(
                out,
                "the maximum found within the bounds is {best:.4} deg, at {at} mm"
            );
        };
        write!(
            out,
            "the maximum found within the bounds is {best:.3} deg (at {at} mm), so the bounds contradict the goal: widen them by {:.3} % to meet both (then {} mm)",
            100.0 * widening,
            words(self.widened_lengths)
        )
    }
}
