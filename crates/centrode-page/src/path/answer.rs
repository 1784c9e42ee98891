use super::cache::Cached;
use super::drawing::{self, Drawing, mark};
use super::wish::{Wish, points};
use crate::reverse::words;
use crate::reverse::words::Labelled;
use centrode_analysis::{Goal, Unit};
use centrode_export::picture::{Curve, Mark, Picture};
use centrode_gear::Limits;
use centrode_geometry::Point;
use centrode_synthesis::optimise::reached;
use centrode_synthesis::reverse::{
    AxisFault, PathDesign, PathError, RequiredPath, ReversedMachine, Split, SplitKind, TwoBar,
};
use serde::Serialize;
use std::ops::ControlFlow;

/// Machine of a path and an axis, for the page.
#[derive(Debug, Default, Serialize)]
pub struct Answer {
    /// The machine, or the path alone.
    picture: Picture,
    curves: Vec<Curve>,
    figures: Vec<Figure>,
    /// Further wishes, and how far they are reached.
    goals: Vec<GoalAnswer>,
    /// Findings: names of rules and words.
    findings: Vec<Labelled>,
    fault: Option<Fault>,
}

/// A further wish, in the words of `centrode reverse`.
#[derive(Debug, Serialize)]
pub struct GoalAnswer {
    name: String,
    words: String,
    met: bool,
}

/// Wishes in words.
pub(super) fn goals(goals: &[Goal]) -> Vec<GoalAnswer> {
    let answer = |goal: &Goal| GoalAnswer {
        name: goal.name.to_string(),
        words: words::goal(goal).1,
        met: goal.met() != Some(false),
    };
    goals.iter().map(answer).collect()
}

/// A figure in the words of `centrode reverse`.
#[derive(Debug, Serialize)]
struct Figure {
    name: String,
    words: String,
}

/// Reason why there is no machine.
#[derive(Debug, Serialize)]
struct Fault {
    /// Input at fault: `path`, `axis`, `split`, or `wish` for a key of the design.
    of: &'static str,
    message: String,
}

impl Answer {
    /// Machine of the path and the axis of a wish, or the reason why there is none.
    #[must_use]
    pub fn new(ask: &Wish) -> Self {
        let design = match ask.design() {
            Ok(design) => design,
            Err(reason) => return Self::without(Picture::default(), "wish", reason),
        };
        let passed = points(&design);
        let required = match RequiredPath::through(&passed) {
            Ok(required) => required,
            Err(error) => return Self::no_path(&passed, &error),
        };
        if let (false, Err(error)) = (design.path.crossing, required.check_simple()) {
            return Self::crossing(&required, &error);
        }
        let Some(axis) = design.axis else {
            let words = "the axis is missing".to_owned();
            return Self::without(drawing::path(&required, Vec::new()), "axis", words);
        };
        let chain = match TwoBar::new(&required, axis.into(), None) {
            Ok(chain) => chain,
            Err(fault) => {
                let picture = drawing::path(&required, places(&fault));
                return Self::without(picture, "axis", fault.to_string());
            }
        };
        let answer = Self::of_chain(&design, &chain, ask.rest);
        let mut answer = answer.unwrap_or_else(|reason| {
            let mut answer = Self::without(drawing::path(&required, Vec::new()), "split", reason);
            answer.figures = figures(&chain, None);
            answer
        });
        // The machine as it is drawn; a search may reach more.
        let count = passed.len() - usize::from(passed.first() == passed.last());
        answer.goals = goals(&reached(&design.wishes, &chain, design.bend, count));
        if ask.others {
            let others = words::other_splits(&chain, design.split, design.bend).into_iter();
            let others = others.map(|(name, words)| figure(&name, words));
            answer.figures.extend(others);
        }
        answer
    }

    /// The machine that a search finds.
    ///
    /// # Errors
    /// The reason in words if there is no machine.
    pub fn found(
        ask: &Wish,
        kept: &Cached,
        observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, String> {
        let design = ask.design()?;
        let found = kept.found(ask, observe)?;
        let mut answer = Self::of_chain(&design, &found.chain, true)?;
        let stated = found.stated.iter();
        answer
            .figures
            .extend(stated.map(|(name, words)| figure(name, words.clone())));
        answer.goals = goals(&found.goals);
        answer.findings = found.findings.iter().map(words::finding).collect();
        Ok(answer)
    }

    fn of_chain(design: &PathDesign, chain: &TwoBar, rest: bool) -> Result<Self, String> {
        let (bend, arms) = (design.bend, design.arms);
        let split = Split::new(chain, design.split, bend).map_err(|error| error.to_string())?;
        let drawn = Drawing::new(chain, &split, arms).map_err(|error| error.to_string())?;
        let mut figures = figures(chain, Some(bend));
        if rest {
            figures.extend(rested(chain, &split, design)?);
        }
        Ok(Self {
            picture: drawn.picture(),
            curves: drawn.curves(),
            figures,
            ..Self::default()
        })
    }

    fn without(picture: Picture, of: &'static str, message: String) -> Self {
        Self {
            picture,
            fault: Some(Fault { of, message }),
            ..Self::default()
        }
    }

    fn no_path(points: &[Point], error: &PathError) -> Self {
        let mut marks = Vec::new();
        if let PathError::Twice { x, y, .. } = error {
            marks.push(mark("twice", Point::new(*x, *y)));
        }
        let picture = drawing::polygon(points, marks);
        Self::without(picture, "path", error.to_string())
    }

    fn crossing(required: &RequiredPath, error: &PathError) -> Self {
        let mut marks = Vec::new();
        if let PathError::Crossing { x, y } = error {
            marks.push(mark("crosses itself", Point::new(*x, *y)));
        }
        let picture = drawing::path(required, marks);
        Self::without(picture, "path", error.to_string())
    }
}

/// Positions on the path where an axis is not possible.
fn places(fault: &AxisFault) -> Vec<Mark> {
    match fault {
        AxisFault::Extremes { maxima } => {
            let far = maxima.iter().map(|at| mark("farthest", *at));
            far.collect()
        }
        AxisFault::CarrierTurnsBack { at, .. } => vec![mark("carrier turns back", *at)],
        AxisFault::ArmStops { at } => vec![mark("arm stops", *at)],
        _ => Vec::new(),
    }
}

fn figures(chain: &TwoBar, bend: Option<f64>) -> Vec<Figure> {
    let mm = |x: f64| Unit::Millimetre.with_unit(x);
    let axis = chain.axis();
    let at = format!("{:.4}, {:.4} mm", axis.x, axis.y);
    let mut found = vec![figure("axis of the carrier", at)];
    found.extend(words::bars(chain).map(|(name, words)| figure(name, words)));
    found.push(figure("tip to shaft, minimum", mm(chain.shaft_distance())));
    if let Some(bend) = bend {
        let module = Limits::largest_full_module(chain.curvatures(bend));
        let full = format!("guaranteed up to module {} by powers", mm(module));
        found.push(figure("full teeth", full));
    }
    found
}

/// Figures that take longer: those of the pitch curves as they are written.
fn rested(chain: &TwoBar, split: &Split, design: &PathDesign) -> Result<Vec<Figure>, String> {
    let made = ReversedMachine::new(chain, split, design.arms, design.steps);
    let made = made.map_err(|error| error.to_string())?;
    let (name, words) = words::minimum_radius(&made);
    let mut found = vec![figure(name, words)];
    let pairs = made.design.pairs.keys().zip(&made.minimum_radii);
    let pairs = pairs.map(|(name, radii)| words::minimum_radii(name, *radii));
    found.extend(pairs.map(|(name, words)| figure(&name, words)));
    let (name, words) = words::tip_error(&made);
    found.push(figure(name, words));
    if split.kind() == SplitKind::OnePair {
        found.push(figure(
            "one pair twice: residual",
            format!("{:.1e} rad", split.miss()),
        ));
    }
    Ok(found)
}

fn figure(name: &str, words: String) -> Figure {
    Figure {
        name: name.into(),
        words,
    }
}
