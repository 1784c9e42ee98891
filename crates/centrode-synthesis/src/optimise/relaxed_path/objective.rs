use crate::reverse::{Aim, AxisMap, RequiredPath, TwoBar};
use centrode_gear::Limits;
use centrode_geometry::{Point, checkpoint};

use super::{EasingSpec, path_goals};
use centrode_optimise::Evaluation;

/// Value of an aim: the smaller, the better.
pub(super) fn aimed(chain: &TwoBar, bend: f64, aim: Aim) -> f64 {
    match aim {
        Aim::Module => -Limits::largest_full_module(chain.curvatures(bend)),
        Aim::Mild => chain.unevenness(),
        Aim::Small => chain.carrier() + chain.arm(),
    }
}

/// The possible axis of a map that comes nearest to the wishes, and of several that reach them the best by the aim.
pub(super) fn best_axis(
    path: &RequiredPath,
    map: &AxisMap,
    points: usize,
    spec: &EasingSpec,
) -> Option<Point> {
    let is_free = spec.wishes.is_free();
    if is_free && spec.aim == Aim::Module {
        return map.bluntest(spec.bend);
    }
    let columns = map.range().count[0] as usize;
    let possible = map
        .found()
        .iter()
        .enumerate()
        .filter(|(_, found)| found.is_ok());
    let evaluated = possible.filter_map(|(n, _)| {
        checkpoint();
        let axis = map.range().axis((n % columns) as u32, (n / columns) as u32);
        let chain = TwoBar::new(path, axis, None).ok()?;
        let (goals, _) = path_goals::goals(&spec.wishes, &chain, spec.bend, points);
        let evaluation = Evaluation {
            objective: aimed(&chain, spec.bend, spec.aim),
            constraints: path_goals::violations(&goals),
        };
        Some((axis, evaluation))
    });
    let best = evaluated.min_by(|a, b| a.1.order(&b.1))?;
    Some(best.0)
}
