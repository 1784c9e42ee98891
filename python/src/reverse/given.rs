use std::sync::OnceLock;

use centrode_analysis::Finding;
use centrode_geometry::{Bounds, Point};
use centrode_synthesis::optimise::{EasingError, axis_at_border};
use centrode_synthesis::reverse::{
    AxisMap, KeyPose, KeyPoses, PathDesign, RequiredPath, SplitKind, TwoBar,
};
use pyo3::prelude::{Bound, Python, pyfunction};
use pyo3::types::PyDict;

use super::eased::{self, Eased};
use super::{Reversed, wished};
use crate::array::{Rows, Values};
use crate::count::Count;
use crate::error::{Answer, Raised};
use crate::wait::wait;
use crate::word::Word;

/// Path or key poses from which a machine is made.
#[derive(Debug)]
pub(super) enum Given {
    Path {
        points: Vec<Point>,
        axis: Option<(f64, f64)>,
        axis_box: Option<[[f64; 2]; 2]>,
        /// Whether the axis found is at the border of its box.
        findings: Vec<Finding>,
        eased: Option<Box<Eased>>,
    },
    Poses {
        rows: Rows<3>,
        found: Box<KeyPoses>,
    },
}

/// Designs a machine whose tip follows a given path.
///
/// Args:
///     path: Points in the order in which the tip passes them, mm, an array (N, 2). The path is the closed periodic cubic
///         spline through them.
///     axis: Axis of the carrier, mm; default: the axis for which the ratio of the gears is nearest to 1.
///     split: "powers", two different pairs; "mildest", two different pairs with the minimum curvature of their pitch
///         curves; or "one-pair", the same pair twice.
///     axis_box: Two opposite corners of the box in which the axis is searched, mm; default: a box around the path with a
///         margin of a quarter of its size. `findings` reports an axis at the border of the box.
///     bend_deg: Angle from the carrier's first leg, to the intermediate gear, to its second, degrees.
///     arms: Number of arms.
///     control: Whether the points are the control points of a closed cubic B-spline; the path need not pass through
///         them.
///     band: Maximum distance of the path from its points, mm, one value or an array (N,). The path is changed within it
///         (eased) until the largest possible full teeth are sound. If no axis is given, the search begins with the axis
///         that gives the gears of minimum curvature.
///     open: Whether the points are only the working part of the path; the return from the last point to the first is
///         searched.
///     module: Module of full teeth at which easing stops, mm.
///     aim: Objective of the search for what is free: "module", the largest teeth; "mild", the ratio nearest to 1; or
///         "small", the minimum reach of the tip. Default: "module" if the path is eased or `wishes` are given, otherwise
///         "mild".
///     wishes: Other requirements, with the keys of the table wishes of a design file of family path: carrier, arm,
///         center_distance, ratio, directions, clamp_deg, turn, keep_out. `goals` has their progress.
///
/// Raises:
///     DesignError: The points do not define a path, or a value is out of its range.
///     MechanismError: No machine with this axis, or with this split and bend, follows the path.
///
/// >>> import centrode as ct
/// >>> path = [(0, 0), (60, 70), (150, 150), (230, 215), (262, 262), (235, 300), (170, 330),
/// ...         (100, 330), (40, 300), (-5, 250), (-30, 190), (-38, 130), (-30, 60)]
/// >>> arms = ct.reverse(path, (260, 160), bend_deg=40)
/// >>> round(arms.carrier, 3), round(arms.arm, 3), arms.tip_error < 1e-4
/// (125.612, 186.594, True)
#[pyfunction]
#[pyo3(
    signature = (path, axis=None, *, split="powers", bend_deg=60.0, arms=Count::Fits(1), control=false, band=None, open=false, module=None, aim=None, wishes=None, axis_box=None),
    text_signature = "(path, axis=None, *, split='powers', bend_deg=60.0, arms=1, control=False, band=None, open=False, module=None, aim=None, wishes=None, axis_box=None)"
)]
#[expect(clippy::too_many_arguments, reason = "keywords")]
pub(crate) fn reverse(
    py: Python<'_>,
    path: Values,
    axis: Option<(f64, f64)>,
    split: &str,
    bend_deg: f64,
    arms: Count,
    control: bool,
    band: Option<Values>,
    open: bool,
    module: Option<f64>,
    aim: Option<&str>,
    wishes: Option<Bound<'_, PyDict>>,
    axis_box: Option<[[f64; 2]; 2]>,
) -> Answer<Reversed> {
    let aim = aim.map(|aim| Word::of("aim", aim)).transpose()?;
    let wishes = wishes.map(|wishes| wished::read(&wishes)).transpose()?;
    let kind: SplitKind = Word::of("split", split)?;
    let arms = arms.within("arms", 1, 12)?;
    let points = path.points("path")?;
    let points = match (control, open) {
        (true, true) => {
            return Err(Raised::sentence(
                "control",
                "it is possible only for a whole path, not with open".into(),
            ));
        }
        (true, false) => RequiredPath::knots(&points),
        (false, _) => points,
    };
    let design = PathDesign {
        axis: axis.map(|(x, y)| [x, y]),
        axis_box,
        ..PathDesign::default()
    };
    design.check_axes(&points)?;
    let easing = eased::requested(
        band,
        module,
        open,
        aim,
        wishes.unwrap_or_default(),
        axis_box,
    )?;
    wait(py, move || {
        if let Some(requested) = easing {
            let (chain, mut eased) = Eased::search(&points, requested, axis, bend_deg)?;
            let given = Given::Path {
                points,
                axis,
                axis_box,
                findings: std::mem::take(&mut eased.findings),
                eased: Some(Box::new(eased)),
            };
            return Reversed::new(given, chain, OnceLock::new(), (kind, bend_deg, arms));
        }
        let path = RequiredPath::through(&points)?;
        let mut axes = OnceLock::new();
        let mut findings = Vec::new();
        let chain = match axis {
            Some((x, y)) => TwoBar::new(&path, Point::new(x, y), None)?,
            None => {
                let range = design.axes(&path);
                let map = AxisMap::new(&path, range);
                let tried = map.found().len();
                let chain = map.mildest(&path).ok_or(EasingError::NoAxis { tried })?;
                axes = OnceLock::from(map);
                let [low, high] = [0, 1].map(|end| Point::new(range.x[end], range.y[end]));
                let room: Bounds = [low, high].into_iter().collect();
                findings.extend(axis_at_border(chain.axis(), &room));
                chain
            }
        };
        let given = Given::Path {
            points,
            axis,
            axis_box,
            findings,
            eased: None,
        };
        Reversed::new(given, chain, axes, (kind, bend_deg, arms))
    })?
}

/// Designs a machine whose arm passes through key poses in order; the path between them is free.
///
/// Args:
///     poses: Three to seven points of the tip, mm, and directions of the clamp there, degrees, an array (N, 3).
///     split: "powers", two different pairs; "mildest", two different pairs with the minimum curvature of their pitch
///         curves; or "one-pair", the same pair twice.
///     bend_deg: Angle from the carrier's first leg, to the intermediate gear, to its second, degrees.
///     arms: Number of arms.
///
/// Raises:
///     DesignError: There are not three to seven different poses, or a value is out of its range.
///     MechanismError: No carrier and arm pass through the poses in order; the message states the distance of the nearest
///         machine.
///
/// >>> import centrode as ct
/// >>> poses = [(249.08, 50.03, 31.93), (167.32, 64.88, 20.89), (104.40, 34.05, 42.55), (175.51, 14.69, 53.59)]
/// >>> arms = ct.reverse_poses(poses, bend_deg=40)
/// >>> arms.misses.shape, bool((arms.misses < 0.1).all())
/// ((4, 2), True)
#[pyfunction]
#[pyo3(
    signature = (poses, *, split="powers", bend_deg=60.0, arms=Count::Fits(1)),
    text_signature = "(poses, *, split='powers', bend_deg=60.0, arms=1)"
)]
pub(crate) fn reverse_poses(
    py: Python<'_>,
    poses: Values,
    split: &str,
    bend_deg: f64,
    arms: Count,
) -> Answer<Reversed> {
    let kind: SplitKind = Word::of("split", split)?;
    let arms = arms.within("arms", 1, 12)?;
    let rows: Rows<3> = Rows(poses.rows("poses")?);
    wait(py, move || {
        let pose = |&[x, y, direction]: &[f64; 3]| KeyPose {
            point: Point::new(x, y),
            direction: direction.to_radians(),
        };
        let poses: Vec<KeyPose> = rows.0.iter().map(pose).collect();
        let found = KeyPoses::new(&poses)?;
        let chain = found.chain.clone();
        let found = Box::new(found);
        let given = Given::Poses { rows, found };
        Reversed::new(given, chain, OnceLock::new(), (kind, bend_deg, arms))
    })?
}
