use std::ops::ControlFlow;

use centrode_geometry::Point;
use centrode_kinematics::linkage::{FourBar, Grashof, SixBar};
use centrode_machines::feeder::{BoundsSpec, Dimension, FeederDesign};

use centrode_analysis::{Attainable, Goal};
use centrode_optimise::{Method, Settings, minimise};

use super::FeederProblem;
use crate::optimise::DesignProblem as _;

/// Steps per millimetre to which bounds and lengths are rounded.
const STEPS: f64 = 1e3;
/// Names of the goals that lengths and pivot alone can meet.
const OF_SIX_BAR: [&str; 3] = ["swing", "transmission-angle", "quick-return"];
/// Maximum number of steps by which rounded bounds are moved outwards again.
const MOST: u32 = 10;

/// Feeder's design with its bounds widened just until a crank-rocker within them has the required minimum transmission angle. It
/// has the lengths of this crank-rocker, and its pivot in the middle of the positions that give the required swing.
#[derive(Clone, Debug, PartialEq)]
pub struct Widened {
    /// Share by which every minimum length is reduced and every maximum length increased, before rounding.
    pub share: f64,
    /// The design, bounds rounded outwards and lengths and pivot rounded to a thousandth of a millimetre.
    pub design: FeederDesign,
}

/// Reason why the bounds are not widened.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotWidened {
    /// The bounds contain lengths with the required angle.
    #[error(
        "the bounds already allow lengths with a minimum transmission angle of {:.4} deg, and {:.4} deg is required: they need not be widened", .attainable.to_degrees(), .required.to_degrees()
    )]
    Needless {
        /// Largest minimum transmission angle within the bounds, rad.
        attainable: f64,
        /// Required angle, rad.
        required: f64,
    },
    /// The bounds contain lengths with the required angle, but no lengths were found that meet all goals.
    #[error(
        "the bounds already allow lengths with a minimum transmission angle of {:.4} deg: wider ones are not searched. {why}", .attainable.to_degrees()
    )]
    OtherGoals {
        /// Largest minimum transmission angle within the bounds, rad.
        attainable: f64,
        /// The goals that prevent each other, in a sentence.
        why: String,
    },
    /// Not even bounds widened by 90 % give the required angle.
    #[error("even bounds widened by 90 % contain no crank-rocker with a minimum transmission angle of {:.4} deg", .required.to_degrees())]
    NoUse {
        /// Required angle, rad.
        required: f64,
    },
    /// No position of the pivot gives the required swing.
    #[error("for the lengths found, no position of the pivot gives a swing of {:.4} deg", .swing.to_degrees())]
    NoPivot {
        /// Required angle, rad.
        swing: f64,
    },
}

impl Widened {
    /// Widens the bounds of a design; equal designs give equal results.
    ///
    /// # Errors
    /// [`NotWidened`].
    pub fn search(design: &FeederDesign) -> Result<Self, NotWidened> {
        let goals = &design.goals;
        let required = goals.transmission_angle;
        let none = || NotWidened::NoUse { required };
        let found = Attainable::search(design).ok_or_else(none)?;
        let attainable = found.transmission_angle;
        let share = found.widening.ok_or_else(|| match contradictions(design) {
            Some(why) => NotWidened::OtherGoals { attainable, why },
            None => NotWidened::Needless {
                attainable,
                required,
            },
        })?;
        let mut widened = design.clone();
        for more in 0..MOST {
            let bounds = outwards(&design.bounds, share, f64::from(more) / STEPS);
            let best = rounded(found.widened_lengths, &bounds, design);
            let Some((four_bar, _)) = best.filter(|(_, angle)| *angle >= required) else {
                continue;
            };
            let pivot = SixBar::pivots(&four_bar, goals.swing, 1).first().copied();
            let swing = goals.swing;
            let pivot: Point = pivot.ok_or(NotWidened::NoPivot { swing })?;
            let [crank, coupler, rocker, frame] = four_bar.lengths();
            for (dimension, value) in Dimension::ALL.into_iter().zip([
                crank,
                coupler,
                rocker,
                frame,
                nearest(pivot.x),
                nearest(pivot.y),
            ]) {
                dimension.set(&mut widened.linkage, value);
            }
            widened.bounds = bounds;
            return Ok(Self {
                share,
                design: widened,
            });
        }
        Err(none())
    }
}

/// The goals that no lengths within the bounds meet, alone or in pairs, in a sentence; `None` if some lengths meet all.
fn contradictions(design: &FeederDesign) -> Option<String> {
    let mut free = design.clone();
    // A widened design also has a new pivot.
    free.optimise.free_pivot = true;
    free.optimise.pivot_weight = 0.0;
    let problem = FeederProblem::new(&free);
    let settings = Settings {
        method: Method::DifferentialEvolution,
        target: problem.target(),
        ..Settings::default()
    };
    let (search, _) = minimise(&problem, settings, &mut |_| ControlFlow::Continue(())).ok()?;
    let goals = problem.goals(&search.best().point).unwrap_or_default();
    let is_missed = |goal: &Goal| OF_SIX_BAR.contains(&&*goal.name) && goal.met() == Some(false);
    let is_met = !goals.is_empty() && !goals.iter().any(is_missed);
    if is_met {
        None
    } else {
        problem.reach.contradictions()
    }
}

fn nearest(value: f64) -> f64 {
    (value * STEPS).round() / STEPS
}

/// Widens bounds by a share, rounds them outwards, and widens them then by `more`, mm.
fn outwards(bounds: &BoundsSpec, share: f64, more: f64) -> BoundsSpec {
    let out = |[low, high]: [f64; 2]| {
        [
            nearest((low * (1.0 - share) * STEPS).floor() / STEPS - more),
            nearest((high * (1.0 + share) * STEPS).ceil() / STEPS + more),
        ]
    };
    BoundsSpec {
        crank: out(bounds.crank),
        coupler: out(bounds.coupler),
        rocker: out(bounds.rocker),
        frame: out(bounds.frame),
    }
}

/// The crank-rocker with the largest minimum transmission angle among rounded lengths within one step of the given ones, and this
/// angle, rad.
fn rounded(
    lengths: [f64; 4],
    bounds: &BoundsSpec,
    design: &FeederDesign,
) -> Option<(FourBar, f64)> {
    let bounds = bounds.named();
    let near = |k: usize, step: usize| {
        let (_, [low, high]) = bounds[k];
        nearest((nearest(lengths[k]) + (step as f64 - 1.0) / STEPS).clamp(low, high))
    };
    let candidates = (0..81_usize).filter_map(|i| {
        let [a, b, c, d] = [(0, 1), (1, 3), (2, 9), (3, 27)].map(|(k, by)| near(k, i / by % 3));
        let four_bar = FourBar::new(a, b, c, d, design.linkage.branch).ok()?;
        let turns = four_bar.grashof() == Grashof::CrankRocker;
        turns.then(|| (four_bar, four_bar.minimum_transmission_angle()))
    });
    candidates.max_by(|a, b| a.1.total_cmp(&b.1))
}
