use super::words::{self, Labelled};
use centrode_analysis::{Finding, Goal, Unit};
use centrode_geometry::{Bounds, Point};
use centrode_synthesis::optimise::{EasedPath, Easing, EasingError, EasingSpec, axis_at_border};
use centrode_synthesis::reverse::{
    Aim, AxisFault, AxisMap, AxisRange, KeyPose, KeyPoses, PathDesign, PathError, PoseError,
    RequiredPath, TwoBar,
};
use std::ops::ControlFlow;

/// Carrier and arm that were found, for the command and the page.
#[derive(Debug)]
pub struct Found {
    /// Carrier and arm.
    pub chain: TwoBar,
    /// Reason why this axis was chosen.
    pub why: String,
    /// Axes tried for a path that is followed exactly.
    pub map: Option<AxisMap>,
    /// Further lines to print: names and words.
    pub stated: Vec<Labelled>,
    /// Further wishes, and how far they are reached.
    pub goals: Vec<Goal>,
    /// Findings on what was found.
    pub findings: Vec<Finding>,
    /// Whether all requirements are met.
    pub is_reached: bool,
}

/// Reason why nothing is found for a path.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotFound {
    /// The points make no path.
    #[error(transparent)]
    Path(PathError),
    /// The path crosses itself.
    #[error(transparent)]
    Crossing(PathError),
    /// The given axis is not possible.
    #[error("{fault}")]
    Axis {
        /// x and y of the axis, mm.
        at: [f64; 2],
        /// Reason why it is not possible.
        fault: AxisFault,
    },
    /// No axis is possible.
    #[error("{} ({faults})", EasingError::NoAxis { tried: *tried })]
    NoAxis {
        /// Number of axes tried.
        tried: usize,
        /// Reasons, with the number of axes for each.
        faults: String,
    },
    /// No path within the tolerances has a machine.
    #[error(transparent)]
    Easing(EasingError),
}

impl Found {
    /// Searches for the machine of a design with these points. `observe` receives the number of evaluations and may end the
    /// search; the best machine so far is then used.
    ///
    /// # Errors
    /// [`NotFound`] if there is no machine.
    pub fn by_path(
        design: &PathDesign,
        points: &[Point],
        observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, NotFound> {
        match design.bands() {
            Some(bands) => Self::eased(design, points, &bands, observe),
            None => {
                let path = RequiredPath::through(points).map_err(NotFound::Path)?;
                check_crossing(design, &path)?;
                Self::as_given(design, &path)
            }
        }
    }

    fn eased(
        design: &PathDesign,
        points: &[Point],
        bands: &[f64],
        observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, NotFound> {
        let axis = design.axis.map(Point::from);
        let spec = EasingSpec {
            axis,
            axes: design.axis_box.map(AxisRange::between),
            aim: design.aim.unwrap_or_default(),
            wishes: design.wishes.clone(),
            ..EasingSpec::new(bands, design.bend)
        };
        let easing = match design.path.open {
            true => Easing::with_free_return(points, &spec),
            false => Easing::new(points, &spec),
        };
        let module = design.path.module;
        let eased = easing.and_then(|easing| easing.search(module, observe));
        let eased = eased.map_err(|error| match (error, design.axis) {
            (EasingError::Axis(fault), Some(at)) => NotFound::Axis { at, fault },
            (error, _) => NotFound::Easing(error),
        })?;
        check_crossing(design, eased.chain.path())?;
        let reached = eased.module.1;
        let is_module = module.is_none_or(|module| reached >= module);
        let is_all = eased.goals.iter().all(|goal| goal.met() != Some(false));
        let is_moved = bands.iter().any(|band| *band > 0.0);
        let mut stated = eased_words(&eased, module, is_moved);
        stated.extend(eased.clamp.map(words::clamp));
        Ok(Self {
            why: match (axis, design.aim.unwrap_or_default()) {
                (Some(_), _) => "as given",
                (None, Aim::Module) => "with the largest full-height teeth found",
                (None, Aim::Mild) => "gentlest ratio found",
                (None, Aim::Small) => "with the minimum reach found",
            }
            .into(),
            chain: eased.chain,
            map: None,
            stated,
            goals: eased.goals,
            findings: eased.findings,
            is_reached: is_module && is_all,
        })
    }

    /// The machine of a path that is followed exactly.
    fn as_given(design: &PathDesign, path: &RequiredPath) -> Result<Self, NotFound> {
        let Some(at) = design.axis else {
            return Self::mildest(design, path);
        };
        let chain = TwoBar::new(path, at.into(), None);
        Ok(Self {
            chain: chain.map_err(|fault| NotFound::Axis { at, fault })?,
            why: "as given".into(),
            map: None,
            stated: Vec::new(),
            goals: Vec::new(),
            findings: Vec::new(),
            is_reached: true,
        })
    }

    fn mildest(design: &PathDesign, path: &RequiredPath) -> Result<Self, NotFound> {
        let range = design.axes(path);
        let map = AxisMap::new(path, range);
        let chain = map.mildest(path).ok_or_else(|| none_possible(&map))?;
        let [low, high] = [0, 1].map(|end| Point::new(range.x[end], range.y[end]));
        let room: Bounds = [low, high].into_iter().collect();
        Ok(Self {
            findings: axis_at_border(chain.axis(), &room).into_iter().collect(),
            chain,
            why: "gentlest ratio found".into(),
            map: Some(map),
            stated: Vec::new(),
            goals: Vec::new(),
            is_reached: true,
        })
    }

    /// Finds the machine that meets key poses.
    ///
    /// # Errors
    /// [`PoseError`] if no machine meets the poses.
    pub fn by_poses(poses: &[KeyPose]) -> Result<Self, PoseError> {
        let found = KeyPoses::new(poses)?;
        Ok(Self {
            stated: words::poses(found.clamp, &found.misses),
            chain: found.chain,
            why: format!(
                "gentlest ratio found, from {} starts that meet the poses in order",
                found.possible
            ),
            map: None,
            goals: Vec::new(),
            findings: Vec::new(),
            is_reached: true,
        })
    }
}

/// Checks that a path does not cross itself, unless that is allowed.
fn check_crossing(design: &PathDesign, path: &RequiredPath) -> Result<(), NotFound> {
    match design.path.crossing {
        true => Ok(()),
        false => path.check_simple().map_err(NotFound::Crossing),
    }
}

/// Lines on how far a path was eased, and on the module of full teeth that it allows.
fn eased_words(eased: &EasedPath, module: Option<f64>, is_moved: bool) -> Vec<Labelled> {
    let mm = |x: f64| Unit::Millimetre.with_unit(x);
    let moved = eased.moved.iter().enumerate();
    let (most, far) = moved.fold((0, 0.0), |most, (i, &moved)| match moved > most.1 {
        true => (i, moved),
        false => most,
    });
    let (before, borne) = eased.module;
    let before = before.map_or_else(String::new, |before| format!(", {} before", mm(before)));
    let required = match module {
        Some(module) if borne < module => {
            format!(
                ", not {}: use a larger band, another axis or another bend",
                mm(module)
            )
        }
        _ => String::new(),
    };
    let free = eased.points.len() - eased.moved.len();
    let searched = format!("in {} evaluations", eased.evaluations);
    let mut stated = Vec::new();
    if free > 0 {
        let words = format!("through {free} points, {searched}");
        stated.push(("free return".to_owned(), words));
    }
    if is_moved && (free == 0 || far > 0.0) {
        let words = format!("by {} at most, at point {}", mm(far), most + 1);
        let words = match free {
            0 => format!("{words}, {searched}"),
            _ => words,
        };
        stated.push(("path eased".to_owned(), words));
    }
    let words = format!("guaranteed up to module {}{before}{required}", mm(borne));
    stated.push(("full teeth".to_owned(), words));
    stated
}

fn none_possible(map: &AxisMap) -> NotFound {
    let faults = map.found().iter().filter_map(|found| found.as_ref().err());
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for fault in faults {
        match counts.iter_mut().find(|(name, _)| *name == fault.name()) {
            Some((_, count)) => *count += 1,
            None => counts.push((fault.name(), 1)),
        }
    }
    let words = counts.iter().map(|(name, count)| format!("{name} {count}"));
    NotFound::NoAxis {
        tried: map.found().len(),
        faults: words.collect::<Vec<_>>().join(", "),
    }
}
