use serde::Serialize;

use super::drawing::{self, Drawing, mark};
use super::sought::Sought;
use super::wish::{Choices, Wish};
use crate::analysis::Unit;
use crate::cli::reverse::{sharpest, words};
use crate::export::page::{Curve, Mark, Picture};
use crate::geometry::Point;
use crate::mechanism::gear::Limits;
use crate::mechanism::reverse::{
    AxisFault, PathError, ReversedMachine, Split, SplitKind, TwoBar, WantedPath,
};

/// Machine of a path and an axis, for the page.
#[derive(Debug, Default, Serialize)]
pub(super) struct Answer {
    /// The machine, or the path alone.
    picture: Picture,
    curves: Vec<Curve>,
    figures: Vec<Figure>,
    fault: Option<Fault>,
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
    /// Input to blame: `path`, `axis` or `split`.
    of: &'static str,
    message: String,
}

impl Answer {
    pub(super) fn new(ask: &Wish) -> Self {
        let wanted = match ask.path() {
            Ok(wanted) => wanted,
            Err(error) => return Self::no_path(ask, &error),
        };
        if let Err(error) = wanted.check_simple() {
            return Self::crossing(&wanted, &error);
        }
        let chain = match TwoBar::new(&wanted, ask.axis(), None) {
            Ok(chain) => chain,
            Err(fault) => {
                let picture = drawing::path(&wanted, places(&fault));
                return Self::without(picture, "axis", fault.to_string());
            }
        };
        let answer = Self::of_chain(&ask.choices, &chain, ask.rest);
        let mut answer = answer.unwrap_or_else(|reason| {
            let mut answer = Self::without(drawing::path(&wanted, Vec::new()), "split", reason);
            answer.figures = figures(&chain, None);
            answer
        });
        if ask.others {
            answer.figures.extend(others(&ask.choices, &chain));
        }
        answer
    }

    /// The machine that is sought.
    pub(super) fn found(ask: &Sought) -> Result<Self, String> {
        let found = ask.found()?;
        let mut answer = Self::of_chain(ask.choices(), &found.chain, true)?;
        let told = found.told.into_iter();
        answer
            .figures
            .extend(told.map(|(name, words)| figure(&name, words)));
        Ok(answer)
    }

    fn of_chain(choices: &Choices, chain: &TwoBar, rest: bool) -> Result<Self, String> {
        choices.check_arms()?;
        let (bend, arms) = (choices.bend(), choices.arms);
        let split = Split::new(chain, choices.kind()?, bend).map_err(|error| error.to_string())?;
        let drawn = Drawing::new(chain, &split, arms).map_err(|error| error.to_string())?;
        let mut figures = figures(chain, Some(bend));
        if rest {
            figures.extend(rested(chain, &split, arms)?);
        }
        Ok(Self {
            picture: drawn.picture(),
            curves: drawn.curves(),
            figures,
            fault: None,
        })
    }

    fn without(picture: Picture, of: &'static str, message: String) -> Self {
        Self {
            picture,
            fault: Some(Fault { of, message }),
            ..Self::default()
        }
    }

    fn no_path(ask: &Wish, error: &PathError) -> Self {
        let mut marks = Vec::new();
        if let PathError::Twice { x, y, .. } = error {
            marks.push(mark("twice", Point::new(*x, *y)));
        }
        let picture = drawing::polygon(&ask.points, marks);
        Self::without(picture, "path", error.to_string())
    }

    fn crossing(wanted: &WantedPath, error: &PathError) -> Self {
        let mut marks = Vec::new();
        if let PathError::Crossing { x, y } = error {
            marks.push(mark("crosses itself", Point::new(*x, *y)));
        }
        let picture = drawing::path(wanted, marks);
        Self::without(picture, "path", error.to_string())
    }
}

/// Places on the path where an axis is not possible.
fn places(fault: &AxisFault) -> Vec<Mark> {
    match fault {
        AxisFault::Extremes { maxima } => {
            let far = maxima.iter().map(|at| mark("farthest", *at));
            far.collect()
        }
        AxisFault::CarrierTurnsBack { at, .. } => vec![mark("carrier turns back", *at)],
        AxisFault::ArmStops { at } => vec![mark("arm stands still", *at)],
        _ => Vec::new(),
    }
}

fn figures(chain: &TwoBar, bend: Option<f64>) -> Vec<Figure> {
    let mm = |x: f64| Unit::Millimetre.tell(x);
    let axis = chain.axis();
    let at = format!("{:.4}, {:.4} mm", axis.x, axis.y);
    let mut found = vec![figure("axis of the carrier", at)];
    found.extend(words::bars(chain).map(|(name, words)| figure(name, words)));
    found.push(figure(
        "tip passes the shaft at",
        mm(chain.shaft_distance()),
    ));
    if let Some(bend) = bend {
        let (name, words) = words::least_radius(chain, bend);
        let module = Limits::largest_full_module(chain.curvatures(bend));
        let full = format!("surely sound up to module {} by powers", mm(module));
        found.extend([figure(name, words), figure("full teeth", full)]);
    }
    found
}

/// Figures that take longer: of the pitch curves as they are written.
fn rested(chain: &TwoBar, split: &Split, arms: u32) -> Result<Vec<Figure>, String> {
    let made = ReversedMachine::new(chain, split, arms, None).map_err(|error| error.to_string())?;
    let pairs = made.design.pairs.keys().zip(&made.least_radii);
    let pairs = pairs.map(|(name, radii)| words::least_radii(name, *radii));
    let mut found: Vec<Figure> = pairs.map(|(name, words)| figure(&name, words)).collect();
    let (name, words) = words::tip_error(&made);
    found.push(figure(name, words));
    if split.kind() == SplitKind::OnePair {
        found.push(figure(
            "one pair twice misses by",
            format!("{:.1e} rad", split.miss()),
        ));
    }
    Ok(found)
}

/// Figures of the splits that were not chosen.
fn others(choices: &Choices, chain: &TwoBar) -> Vec<Figure> {
    let kinds = SplitKind::NAMES.into_iter();
    let kinds = kinds.filter(|(_, kind)| choices.kind() != Ok(*kind));
    kinds
        .map(|(name, kind)| {
            let words = match Split::new(chain, kind, choices.bend()) {
                Ok(split) => sharpest(chain, &split),
                Err(error) => error.to_string(),
            };
            figure(&format!("split {name}"), words)
        })
        .collect()
}

fn figure(name: &str, words: String) -> Figure {
    Figure {
        name: name.into(),
        words,
    }
}
