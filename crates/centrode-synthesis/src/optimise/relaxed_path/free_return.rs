//! Paths of which the working part alone is given.

use centrode_geometry::{Bounds, Point};

use super::{Easing, EasingError, EasingSpec, NONE, each};
use centrode_optimise::{Evaluation, Problem as _};

/// Returns tried from the end of an open path to its start: lengths of their tangents at both ends, as multiples of the distance
/// between the ends.
const RETURNS: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Fewest and most points of a free return.
const RETURN_POINTS: [usize; 2] = [4, 12];
/// Band of a free return's points, as a share of the path's size.
const FREE: f64 = 0.35;
/// Fewest points of an open path.
const MIN_OPEN: usize = 3;

impl Easing {
    /// The search for a path whose working part alone is given, mm, each point within its band: the return from its last point to
    /// its first is free. The search starts from the best of several returns that leave and join the working part in its own
    /// direction.
    ///
    /// # Errors
    /// [`EasingError`], as of [`new`](Self::new), and if no return makes a machine.
    pub fn with_free_return(points: &[Point], spec: &EasingSpec) -> Result<Self, EasingError> {
        let (count, minimum) = (points.len(), MIN_OPEN);
        if count < minimum {
            return Err(EasingError::TooFew { count, minimum });
        }
        let bands = each(&spec.bands, count)?;
        let mut best: Option<(Evaluation, Self)> = None;
        let mut fault = None;
        for share in RETURNS {
            let closed: Vec<Point> = points.iter().copied().chain(back(points, share)).collect();
            let size = closed.iter().copied().collect::<Bounds>().diagonal();
            let mut bands = bands.clone();
            bands.resize(closed.len(), FREE * size);
            let spec = EasingSpec {
                bands,
                ..spec.clone()
            };
            match Self::through(&closed, count, &spec) {
                Ok(easing) => {
                    let start = easing.evaluate(&easing.start);
                    let is_better = |best: &Evaluation| start.order(best).is_lt();
                    if start.violation() < NONE
                        && best.as_ref().is_none_or(|(best, _)| is_better(best))
                    {
                        best = Some((start, easing));
                    }
                }
                Err(EasingError::Axis(_) | EasingError::NoAxis { .. }) => {}
                Err(error) => fault = Some(error),
            }
        }
        best.map(|(_, easing)| easing).ok_or_else(|| {
            fault.unwrap_or(EasingError::NoReturn {
                returns: RETURNS.len(),
                axis: match spec.axis {
                    Some(_) => "the given axis",
                    None => "axes on and around each path",
                },
            })
        })
    }
}

/// Points of a return from the last given point to the first, on a cubic that leaves and joins the path in the path's own
/// direction. Its tangents are `share` times as long as the distance between the two points.
fn back(points: &[Point], share: f64) -> Vec<Point> {
    let count = points.len();
    let (from, to) = (points[count - 1], points[0]);
    let (out, home) = (from - points[count - 2], points[1] - to);
    let far = (to - from).norm();
    let [out, home] = [out, home].map(|v| v.normalize() * (share * far));
    let at = |x: f64| {
        let (y, xx) = (1.0 - x, x * x);
        let place = from.coords * (y * y * (1.0 + 2.0 * x)) + to.coords * (xx * (3.0 - 2.0 * x));
        Point::from(place + out * (x * y * y) - home * (xx * y))
    };
    let steps = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
    let step = steps.sum::<f64>() / (count - 1) as f64;
    let chords = (0..64).map(|k| (at(f64::from(k + 1) / 64.0) - at(f64::from(k) / 64.0)).norm());
    let [minimum, most] = RETURN_POINTS;
    let inner = ((chords.sum::<f64>() / step) as usize).clamp(minimum, most);
    (1..=inner)
        .map(|k| at(k as f64 / (inner + 1) as f64))
        .collect()
}
