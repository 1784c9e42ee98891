mod border;
mod error;
mod free_return;
mod objective;
mod path_goals;
mod spec;

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::reverse::{Aim, AxisMap, AxisRange, PathError, RequiredPath, TwoBar, Wishes};
use centrode_gear::Limits;
use centrode_geometry::{Bounds, Point, Vector};

use centrode_optimise::{Ended, Evaluation, Method, Problem, Settings, minimise};

pub use border::axis_at_border;
pub use error::EasingError;
use objective::{aimed, best_axis};
pub use path_goals::reached;
pub use spec::{EasedPath, EasingSpec};

/// Maximum number of points that are moved independently; for more points the moves are a sum of harmonics.
const SINGLE: usize = 24;
/// Number of these harmonics.
const HARMONICS: usize = 12;
/// Maximum of the mean move, as a share of the band; the maximum amplitude of harmonic k is this over 1 + k. The sum is then
/// compressed to less than the band.
const MAXIMUM: f64 = 2.0;
/// Maximum displacement of the axis in x and in y from its start, as a share of the path's diagonal.
const ROOM: f64 = 0.2;
/// Maximum number of evaluations per search.
const EVALUATIONS: u64 = 6000;
/// Maximum number of searches, each within half of the bands of the one before.
const HALVINGS: u32 = 6;
/// Minimum module of full teeth, as a share of the centre distance, in a search with wishes or with another aim than the module:
/// with less, the teeth have hardly any height.
const MIN_MODULE: f64 = 1.0 / 600.0;
/// Violation of a point that gives no machine.
const NONE: f64 = 1e3;

/// Search for the path near a required one whose pitch curves have the minimum curvature: every point may move within its band along
/// the path's normal, and a free axis may move around the one from which the search starts.
///
/// With [`Aim::Module`] it searches for the largest module with which full teeth are surely sound on the four pitch curves of the
/// split by powers; this module follows from the maximum curvatures, [`TwoBar::curvatures`]. The eased path is of degree five:
/// its pitch curves' curvatures do not jump.
#[derive(Clone, Debug)]
pub struct Easing {
    points: Vec<Point>,
    normals: Vec<Vector>,
    bands: Vec<f64>,
    /// Axis, and the box within which it may move, if it may.
    axis: (Point, Option<Bounds>),
    bend: f64,
    aim: Aim,
    wishes: Wishes,
    /// Required module, mm: the search is then for the moves that reach it and are the smallest shares of their bands.
    required: Option<f64>,
    start: Vec<f64>,
    /// Share of the bands within which points are moved.
    reach: f64,
    /// Number of points that were given; the points after them are a free return.
    given: usize,
}

impl Easing {
    /// The search for a path through points each within its band, mm. If no axis is given, the search starts from an axis of a
    /// grid around the path: the one that comes nearest to the wishes, or, of several that reach them, the best by the aim.
    ///
    /// # Errors
    /// [`EasingError`]: the points make no path, a band is invalid, a wish breaks a rule, or no axis makes a machine for the
    /// required path.
    pub fn new(points: &[Point], spec: &EasingSpec) -> Result<Self, EasingError> {
        Self::through(points, points.len(), spec)
    }

    /// The search for a path through points, of which the first `given` were given.
    fn through(points: &[Point], given: usize, spec: &EasingSpec) -> Result<Self, EasingError> {
        let mut bands = each(&spec.bands, points.len())?;
        let path = RequiredPath::through(points)?;
        let is_closed = points.len() > 1 && points.first() == points.last();
        let points = &points[..points.len() - usize::from(is_closed)];
        bands.truncate(points.len());
        let is_band = |band: &f64| *band >= 0.0 && band.is_finite();
        if let Some(i) = bands.iter().position(|band| !is_band(band)) {
            let (number, band) = (i + 1, bands[i]);
            return Err(EasingError::Band { number, band });
        }
        spec.wishes.validate(given.min(points.len()))?;
        let axis = match spec.axis {
            Some(axis) => (TwoBar::new(&path, axis, None)?.axis(), None),
            None => {
                let (axis, room) = starting_axis(&path, points.len(), spec)?;
                // The eased path is another curve, for which that axis may be impossible.
                let smooth = RequiredPath::smoothly_through(points)?;
                let is_possible = TwoBar::new(&smooth, axis, None).is_ok();
                let again = (!is_possible).then(|| starting_axis(&smooth, points.len(), spec));
                let (axis, room) = again.and_then(Result::ok).unwrap_or((axis, room));
                (axis, Some(room))
            }
        };
        let step = path.period() / points.len() as f64;
        let normal = |i: usize| {
            let along = path.at(step * i as f64).first.normalize();
            Vector::new(along.y, -along.x)
        };
        let mut easing = Self {
            normals: (0..points.len()).map(normal).collect(),
            points: points.to_vec(),
            bands,
            axis,
            bend: spec.bend,
            aim: spec.aim,
            wishes: spec.wishes.clone(),
            required: None,
            start: Vec::new(),
            reach: 1.0,
            given: given.min(points.len()),
        };
        easing.start = vec![0.0; easing.moves()];
        if easing.axis.1.is_some() {
            easing.start.extend([easing.axis.0.x, easing.axis.0.y]);
        }
        Ok(easing)
    }

    /// Searches for the best path by the aim. If a module, mm, is required, searches for the path that reaches it with the
    /// smallest moves as shares of the bands; if no path reaches it, the one with the largest module is returned. `observe`
    /// receives the number of evaluations.
    ///
    /// # Errors
    /// [`EasingError::Module`], and [`EasingError::Axis`] if no path of degree five within the bands has a machine.
    pub fn search(
        &self,
        required: Option<f64>,
        observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<EasedPath, EasingError> {
        if let Some(module) = required.filter(|module| !(*module > 0.0 && module.is_finite())) {
            return Err(EasingError::Module { module });
        }
        let mut found = self.clone();
        let mut evaluations = 0;
        let settings = |target: Option<f64>| Settings {
            method: Method::CmaEs,
            evaluations: EVALUATIONS,
            target,
            ..Settings::default()
        };
        let mut best = |problem: &Self, target: Option<f64>| {
            if problem.start.is_empty() {
                return None;
            }
            let start = evaluations;
            let searched = minimise(problem, settings(target), &mut |progress| {
                observe(start + progress.evaluations)
            });
            let (search, ended) = searched.ok()?;
            evaluations += search.evaluations();
            let best = search.best();
            Some((best.point, ended))
        };
        if required.is_some() {
            found.aim = Aim::Module;
        }
        let start = found.evaluate(&found.start);
        let (mut nearest, mut reach) = (start, found.reach);
        let mut chosen = None;
        for _ in 0..HALVINGS {
            let Some((point, ended)) = best(&found, required.map(|module| -module)) else {
                break;
            };
            // Wishes that cannot be reached are approached as closely as possible.
            let here = found.evaluate(&point);
            let (is_better, is_feasible) = (here.order(&nearest).is_lt(), here.feasible());
            let had_one = chosen.is_some();
            if is_better {
                (nearest, reach, chosen) = (here, found.reach, Some(point));
            }
            // With bands as wide as the path hardly any point gives a machine: narrower bands are tried until the result gets no
            // better.
            let is_done = if is_better { is_feasible } else { had_one };
            if is_done || ended == Ended::Stopped || found.moves() == 0 {
                break;
            }
            found.reach *= 0.5;
        }
        found.reach = reach;
        if let Some(point) = chosen {
            found.start = point;
        }
        found.aim = self.aim;
        let is_reached = |easing: &Self| {
            let chain = easing.chain(&easing.start);
            let reaches = |required| chain.is_some_and(|chain| easing.borne(&chain) >= required);
            required.is_some_and(reaches) && easing.evaluate(&easing.start).feasible()
        };
        if is_reached(&found) {
            found.required = required;
            if let Some((point, ended)) = best(&found, None)
                && ended != Ended::Stopped
                && found.evaluate(&point).violation() < NONE
            {
                found.start = point;
            }
        }
        let points = found.eased(&found.start);
        let moved = points.iter().zip(&self.points[..self.given]);
        let axis = found.axis_at(&found.start);
        let eased = TwoBar::new(&self.curve(&points)?, axis, None)?;
        // With a free return the first path was not a required one: no module of it is reported.
        let is_whole = self.given == self.points.len();
        let before = RequiredPath::through(&self.points)?;
        let before = TwoBar::new(&before, axis, None).ok().filter(|_| is_whole);
        let (goals, clamp) = path_goals::goals(&self.wishes, &eased, self.bend, points.len());
        Ok(EasedPath {
            goals,
            clamp,
            moved: moved.map(|(p, q)| (p - q).norm()).collect(),
            module: (before.map(|chain| self.borne(&chain)), self.borne(&eased)),
            chain: eased,
            points,
            evaluations,
            findings: self
                .axis
                .1
                .iter()
                .filter_map(|room| axis_at_border(axis, room))
                .collect(),
        })
    }

    /// Number of variables that move points.
    fn moves(&self) -> usize {
        if self.bands.iter().all(|band| *band == 0.0) {
            return 0;
        }
        match self.points.len() {
            few @ ..=SINGLE => few,
            _ => 1 + 2 * HARMONICS,
        }
    }

    /// Share of its band by which each point moves outwards.
    fn shares(&self, variables: &[f64]) -> Vec<f64> {
        let count = self.points.len();
        if self.moves() == 0 {
            return vec![0.0; count];
        }
        if count <= SINGLE {
            return variables[..count].iter().map(|x| x * self.reach).collect();
        }
        let (mean, waves) = variables[..self.moves()].split_at(1);
        let share = |i: usize| {
            let angle = TAU * i as f64 / count as f64;
            let waves = waves.chunks(2).enumerate().map(|(k, wave)| {
                let (sin, cos) = (angle * (k + 1) as f64).sin_cos();
                wave[0] * cos + wave[1] * sin
            });
            let sum = mean[0] + waves.sum::<f64>();
            self.reach * sum / (1.0 + sum * sum).sqrt()
        };
        (0..count).map(share).collect()
    }

    fn eased(&self, variables: &[f64]) -> Vec<Point> {
        let shares = self.shares(variables);
        let bands = shares.iter().zip(&self.bands);
        let moves = bands.zip(&self.normals);
        let moved = |(p, ((share, band), normal)): (&Point, ((&f64, &f64), &Vector))| {
            p + normal * (share * band)
        };
        self.points.iter().zip(moves).map(moved).collect()
    }

    fn axis_at(&self, variables: &[f64]) -> Point {
        match &variables[self.moves()..] {
            [x, y] => Point::new(*x, *y),
            _ => self.axis.0,
        }
    }

    /// The curve through points: if nothing may move, the one of an exactly followed path; else one of degree five, with which
    /// the curvature of the gears does not jump.
    fn curve(&self, points: &[Point]) -> Result<RequiredPath, PathError> {
        match self.moves() == 0 && self.axis.1.is_none() {
            true => RequiredPath::through(points),
            false => RequiredPath::smoothly_through(points),
        }
    }

    fn chain(&self, variables: &[f64]) -> Option<TwoBar> {
        let path = self.curve(&self.eased(variables)).ok()?;
        let chain = TwoBar::new(&path, self.axis_at(variables), None).ok()?;
        // A free return must not cross the working part.
        let is_whole = self.given == self.points.len();
        (is_whole || path.check_simple().is_ok()).then_some(chain)
    }

    /// Module up to which full teeth are surely sound, cut by the usual rack.
    fn borne(&self, chain: &TwoBar) -> f64 {
        Limits::largest_full_module(chain.curvatures(self.bend))
    }
}

impl Problem for Easing {
    fn bounds(&self) -> Vec<(f64, f64)> {
        let (count, moves) = (self.points.len(), self.moves());
        let mut bounds = match count {
            _ if moves == 0 => Vec::new(),
            ..=SINGLE => vec![(-1.0, 1.0); moves],
            _ => {
                let wave = |k: usize| MAXIMUM / (1.0 + k.div_ceil(2) as f64);
                (0..moves).map(|k| (-wave(k), wave(k))).collect()
            }
        };
        if let Some(room) = self.axis.1 {
            bounds.extend([(room.min.x, room.max.x), (room.min.y, room.max.y)]);
        }
        bounds
    }

    fn start(&self) -> Option<Vec<f64>> {
        Some(self.start.clone())
    }

    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let Some(chain) = self.chain(point) else {
            return Evaluation {
                objective: 0.0,
                constraints: vec![NONE],
            };
        };
        let (goals, _) = path_goals::goals(&self.wishes, &chain, self.bend, self.points.len());
        let mut constraints = path_goals::violations(&goals);
        if !self.wishes.is_free() || self.aim != Aim::Module {
            let minimum = MIN_MODULE * chain.center_distance(self.bend);
            constraints.push(minimum / self.borne(&chain) - 1.0);
        }
        let moved = self.moves() > 0;
        if let Some(required) = self.required {
            constraints.push(required / self.borne(&chain) - 1.0);
        }
        let objective = match self.required {
            Some(_) if moved => {
                let shares = self.shares(point);
                let shares = shares.iter().zip(&self.bands);
                let moved = shares.filter(|(_, band)| **band > 0.0);
                moved.fold(0.0, |most, (share, _)| share.abs().max(most))
            }
            _ => aimed(&chain, self.bend, self.aim),
        };
        Evaluation {
            objective,
            constraints,
        }
    }
}

/// Axis from which a search starts, and the box that it searches.
fn starting_axis(
    path: &RequiredPath,
    points: usize,
    spec: &EasingSpec,
) -> Result<(Point, Bounds), EasingError> {
    let axes = spec.axes.unwrap_or_else(|| AxisRange::about(path));
    let map = AxisMap::new(path, axes);
    let tried = map.found().len();
    let axis = best_axis(path, &map, points, spec);
    let axis = axis.ok_or(EasingError::NoAxis { tried })?;
    // The farther the axis, the gentler and the larger the machine: the box ends at the border of the map.
    let room = match spec.axes {
        Some(_) => f64::INFINITY,
        None => ROOM * path.bounds().diagonal(),
    };
    let AxisRange { x, y, .. } = *map.range();
    let low = Point::new(x[0].max(axis.x - room), y[0].max(axis.y - room));
    let high = Point::new(x[1].min(axis.x + room), y[1].min(axis.y + room));
    Ok((axis, [low, high].into_iter().collect()))
}

/// A band for each point, from a list with one per point or a single one for all.
fn each(bands: &[f64], points: usize) -> Result<Vec<f64>, EasingError> {
    match bands {
        [one] => Ok(vec![*one; points]),
        more if more.len() == points => Ok(more.to_vec()),
        more => Err(EasingError::Bands {
            bands: more.len(),
            points,
        }),
    }
}

#[cfg(test)]
mod tests;
