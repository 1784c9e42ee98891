use std::ops::ControlFlow;

use crate::analysis::optimise::{EasedPath, Easing, EasingError, EasingSpec};
use crate::analysis::{Goal, Unit};
use crate::geometry::Point;
use crate::mechanism::reverse::{Aim, AxisMap, AxisRange, KeyPose, KeyPoses, TwoBar, WantedPath};

use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;

use super::asked::Asked;
use super::words;

/// Carrier and arm that were found.
pub(super) struct Found {
    pub(super) chain: TwoBar,
    /// Why this axis.
    pub(super) why: String,
    /// Axes tried for a path.
    pub(super) map: Option<AxisMap>,
    /// Further lines to tell: names and words.
    pub(super) told: Vec<(String, String)>,
    /// Whether what was wanted is reached.
    pub(super) is_reached: bool,
}

impl Found {
    pub(super) fn by_path(
        command: &Reverse,
        asked: &Asked,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let drawing = asked.drawing.iter();
        let mut told: Vec<(String, String)> = drawing
            .map(|words| ("path".to_owned(), words.clone()))
            .collect();
        let Some(bands) = asked.bands() else {
            let path = WantedPath::through(&asked.points);
            let path = path.map_err(|error| asked.source.refused(&error))?;
            check_crossing(asked, &path)?;
            progress.step("trying axes");
            return Self::as_given(asked, &path, told);
        };
        progress.step("easing the path");
        let design = &asked.design;
        let axis = design.axis.map(Point::from);
        let spec = EasingSpec {
            axis,
            aim: design.aim.unwrap_or_default(),
            wishes: design.wishes.clone(),
            ..EasingSpec::new(&bands, design.bend)
        };
        let easing = match design.path.open {
            true => Easing::with_free_return(&asked.points, &spec),
            false => Easing::new(&asked.points, &spec),
        };
        let module = design.path.module;
        let eased =
            easing.and_then(|easing| easing.search(module, &mut |_| ControlFlow::Continue(())));
        let eased = eased.map_err(|error| refused(command, asked, error))?;
        check_crossing(asked, eased.chain.path())?;
        let reached = eased.module.1;
        let is_module = module.is_none_or(|module| reached >= module);
        let is_all = eased.goals.iter().all(|goal| goal.met() != Some(false));
        told.extend(eased_words(
            &eased,
            module,
            bands.iter().any(|band| *band > 0.0),
        ));
        if let Some(clamp) = eased.clamp {
            told.push(words::clamp(clamp));
        }
        told.extend(eased.goals.iter().map(goal_words));
        Ok(Self {
            why: match (axis, design.aim.unwrap_or_default()) {
                (Some(_), _) => "as asked",
                (None, Aim::Module) => "with the bluntest gears found",
                (None, Aim::Mild) => "the mildest found",
                (None, Aim::Small) => "with the least reach found",
            }
            .into(),
            chain: eased.chain,
            map: None,
            told,
            is_reached: is_module && is_all,
        })
    }

    /// The machine of a path as it is wanted.
    fn as_given(
        asked: &Asked,
        path: &WantedPath,
        told: Vec<(String, String)>,
    ) -> Result<Self, Failure> {
        let map = AxisMap::new(path, AxisRange::about(path));
        let (chain, why) = match asked.design.axis {
            Some([x, y]) => {
                let chain = TwoBar::new(path, Point::new(x, y), None);
                let chain =
                    chain.map_err(|fault| Failure::Usage(format!("--axis {x},{y}: {fault}")))?;
                (chain, "as asked")
            }
            None => {
                let chain = map.mildest(path).ok_or_else(|| none_possible(&map))?;
                (chain, "the mildest found")
            }
        };
        Ok(Self {
            chain,
            why: why.into(),
            map: Some(map),
            told,
            is_reached: true,
        })
    }

    pub(super) fn by_poses(source: &Source, progress: &Progress) -> Result<Self, Failure> {
        progress.step("trying places of the arm's axis");
        let poses = KeyPose::from_csv(source.bytes()).map_err(|error| source.refused(&error))?;
        let found = KeyPoses::new(&poses).map_err(|error| source.refused(&error))?;
        Ok(Self {
            told: words::poses(found.clamp, &found.misses),
            chain: found.chain,
            why: format!(
                "the mildest found from {} starts that meet the poses in order",
                found.possible
            ),
            map: None,
            is_reached: true,
        })
    }
}

/// Checks that a path does not cross itself, unless that is allowed.
fn check_crossing(asked: &Asked, path: &WantedPath) -> Result<(), Failure> {
    if asked.design.path.crossing {
        return Ok(());
    }
    path.check_simple().map_err(|error| {
        let name = asked.source.name();
        Failure::Usage(format!(
            "{name}: {error} With --crossing such a path is taken."
        ))
    })
}

fn refused(command: &Reverse, asked: &Asked, error: EasingError) -> Failure {
    match (error, asked.design.axis) {
        (EasingError::Axis(fault), Some([x, y])) => {
            Failure::Usage(format!("--axis {x},{y}: {fault}"))
        }
        (EasingError::Module { .. }, _) => {
            let module = command.module.unwrap_or_default();
            Failure::Usage(format!(
                "--module is greater than zero, in mm, not {module}"
            ))
        }
        (error, _) => asked.source.refused(&error),
    }
}

/// Line on a goal: its figure, what was wanted, and by how much it is missed.
fn goal_words(goal: &Goal) -> (String, String) {
    let tell = |x: f64| goal.unit.tell(x);
    let value = goal.value.map_or_else(String::new, tell);
    let wanted = match goal.wanted {
        [Some(least), Some(most)] => format!("{} to {}", tell(least), tell(most)),
        [Some(least), None] => format!("at least {}", tell(least)),
        [None, Some(most)] => format!("at most {}", tell(most)),
        [None, None] => String::new(),
    };
    let missed = match goal.margin {
        Some(margin) if margin < 0.0 => format!(", missed by {}", tell(-margin)),
        _ => String::new(),
    };
    let words = format!("{} {value}, wanted {wanted}{missed}", goal.title);
    (format!("goal {}", goal.number), words)
}

/// Lines on how far a path was eased, and what full teeth it bears.
fn eased_words(eased: &EasedPath, module: Option<f64>, is_moved: bool) -> Vec<(String, String)> {
    let mm = |x: f64| Unit::Millimetre.tell(x);
    let moved = eased.moved.iter().enumerate();
    let (most, far) = moved.fold((0, 0.0), |most, (i, &moved)| match moved > most.1 {
        true => (i, moved),
        false => most,
    });
    let (before, borne) = eased.module;
    let before = before.map_or_else(String::new, |before| format!(", {} before", mm(before)));
    let wanted = match module {
        Some(module) if borne < module => {
            format!(
                ", not {}: give more room, or take another axis or bend",
                mm(module)
            )
        }
        _ => String::new(),
    };
    let free = eased.points.len() - eased.moved.len();
    let searched = format!("in {} evaluations", eased.evaluations);
    let mut told = Vec::new();
    if free > 0 {
        let words = format!("through {free} points, {searched}");
        told.push(("free return".to_owned(), words));
    }
    if is_moved && (free == 0 || far > 0.0) {
        let words = format!("by {} at most, at point {}", mm(far), most + 1);
        let words = match free {
            0 => format!("{words}, {searched}"),
            _ => words,
        };
        told.push(("path eased".to_owned(), words));
    }
    let words = format!("surely sound up to module {}{before}{wanted}", mm(borne));
    told.push(("full teeth".to_owned(), words));
    told
}

fn none_possible(map: &AxisMap) -> Failure {
    let faults = map.found().iter().filter_map(|found| found.as_ref().err());
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for fault in faults {
        match counts.iter_mut().find(|(name, _)| *name == fault.name()) {
            Some((_, count)) => *count += 1,
            None => counts.push((fault.name(), 1)),
        }
    }
    let words: Vec<String> = counts
        .iter()
        .map(|(name, count)| format!("{name} {count}"))
        .collect();
    let tried = map.found().len();
    let none = EasingError::NoAxis { tried };
    Failure::Usage(format!("{none} ({})", words.join(", ")))
}
