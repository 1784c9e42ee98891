use std::ops::ControlFlow;

use crate::analysis::Unit;
use crate::analysis::optimise::{EasedPath, Easing, EasingError};
use crate::geometry::Point;
use crate::mechanism::reverse::{
    AxisMap, AxisRange, DrawnPath, KeyPose, KeyPoses, TwoBar, WantedPath, WantedPoints,
};

use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;

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
        source: &Source,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let drawn = drawn(source, command.within)?;
        let wanted = match &drawn {
            Some(drawn) => WantedPoints {
                points: drawn.points.clone(),
                tolerances: None,
            },
            None => {
                WantedPoints::from_csv(source.bytes()).map_err(|error| source.refused(&error))?
            }
        };
        let of_drawing = drawn.map(|drawn| {
            let off = Unit::Millimetre.tell(drawn.deviation.value);
            let points = drawn.points.len();
            let words = format!("through {points} points, within {off} of the drawing");
            ("path".to_owned(), words)
        });
        let mut told: Vec<(String, String)> = of_drawing.into_iter().collect();
        let bands = match (&wanted.tolerances, command.band) {
            (Some(_), Some(_)) => {
                let words = "the file has a tolerance for each point: leave out --band";
                return Err(Failure::Usage(words.into()));
            }
            (Some(tolerances), None) => tolerances.clone(),
            (None, Some(band)) => vec![band],
            (None, None) if command.open => vec![0.0],
            (None, None) => {
                if command.module.is_some() {
                    let words = "--module eases a path: say by how much with --band, or by a column headed tolerance in the file";
                    return Err(Failure::Usage(words.into()));
                }
                let path =
                    WantedPath::through(&wanted.points).map_err(|error| source.refused(&error))?;
                check_crossing(command, source, &path)?;
                progress.step("trying axes");
                return Self::as_given(command, &path, told);
            }
        };
        progress.step("easing the path");
        let axis = command.axis.map(Point::from);
        let bend = command.bend.to_radians();
        let easing = match command.open {
            true => Easing::with_free_return(&wanted.points, &bands, axis, bend),
            false => Easing::new(&wanted.points, &bands, axis, bend),
        };
        let module = command.module;
        let eased =
            easing.and_then(|easing| easing.search(module, &mut |_| ControlFlow::Continue(())));
        let eased = eased.map_err(|error| refused(command, source, error))?;
        check_crossing(command, source, eased.chain.path())?;
        let reached = eased.module.1;
        told.extend(words(&eased, command.module));
        Ok(Self {
            why: match axis {
                Some(_) => "as asked".into(),
                None => "with the bluntest gears found".into(),
            },
            chain: eased.chain,
            map: None,
            told,
            is_reached: command.module.is_none_or(|module| reached >= module),
        })
    }

    /// The machine of a path as it is wanted.
    fn as_given(
        command: &Reverse,
        path: &WantedPath,
        told: Vec<(String, String)>,
    ) -> Result<Self, Failure> {
        let map = AxisMap::new(path, AxisRange::about(path));
        let (chain, why) = match command.axis {
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
            told: told(found.clamp, &found.misses),
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
fn check_crossing(command: &Reverse, source: &Source, path: &WantedPath) -> Result<(), Failure> {
    if command.crossing {
        return Ok(());
    }
    path.check_simple().map_err(|error| {
        let name = source.name();
        Failure::Usage(format!(
            "{name}: {error} With --crossing such a path is taken."
        ))
    })
}

fn refused(command: &Reverse, source: &Source, error: EasingError) -> Failure {
    match (error, command.axis) {
        (EasingError::Axis(fault), Some([x, y])) => {
            Failure::Usage(format!("--axis {x},{y}: {fault}"))
        }
        (EasingError::Module { .. }, _) => {
            let module = command.module.unwrap_or_default();
            Failure::Usage(format!(
                "--module is greater than zero, in mm, not {module}"
            ))
        }
        (error, _) => source.refused(&error),
    }
}

/// Lines on how far a path was eased, and what full teeth it bears.
fn words(eased: &EasedPath, module: Option<f64>) -> Vec<(String, String)> {
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
    if free == 0 || far > 0.0 {
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

/// Lines on the clamp and on how far each pose is missed.
pub(super) fn told(clamp: f64, misses: &[[f64; 2]]) -> Vec<(String, String)> {
    let clamp = (
        "clamp".to_owned(),
        format!("{} from the arm", Unit::Angle.tell(clamp)),
    );
    let pose = |(index, [off, turned]): (usize, &[f64; 2])| {
        let (off, turned) = (Unit::Millimetre.tell(*off), Unit::Angle.tell(*turned));
        let name = format!("pose {}", index + 1);
        (name, format!("missed by {off} and {turned}"))
    };
    let poses = misses.iter().enumerate().map(pose);
    std::iter::once(clamp).chain(poses).collect()
}

/// Points along the path of an SVG file; none where the file is another.
fn drawn(source: &Source, within: f64) -> Result<Option<DrawnPath>, Failure> {
    let bytes = source.bytes();
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !text.trim_ascii_start().starts_with(b"<") {
        return Ok(None);
    }
    let drawn = DrawnPath::from_svg(bytes, within);
    drawn.map(Some).map_err(|error| source.refused(&error))
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
