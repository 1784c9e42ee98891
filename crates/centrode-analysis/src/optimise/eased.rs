use std::f64::consts::TAU;
use std::ops::ControlFlow;

use centrode_geometry::{Bounds, Point, Vector};
use centrode_mechanism::gear::Limits;
use centrode_mechanism::reverse::{AxisFault, AxisMap, AxisRange, PathError, TwoBar, WantedPath};

use super::{Ended, Evaluation, Method, Problem, Settings, minimise};

/// Most points that are moved each on its own; of more, the moves are a sum of harmonics.
const SINGLE: usize = 24;
/// Such harmonics.
const HARMONICS: usize = 12;
/// Greatest amplitude of a harmonic: a share of the band, before it is bent to stay within one.
const GREATEST: f64 = 2.0;
/// Room of the axis about the one that the search starts from, as a share of the path's size.
const ROOM: f64 = 0.2;
/// Returns tried from the end of an open path to its start: lengths of their tangents at both, as multiples of the distance
/// between them.
const RETURNS: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Fewest and most points of a free return.
const RETURN_POINTS: [usize; 2] = [4, 12];
/// Band of a free return's points, as a share of the path's size.
const FREE: f64 = 0.35;
/// Fewest points of an open path.
const FEWEST_OPEN: usize = 3;
/// Evaluations of each of both searches.
const EVALUATIONS: u64 = 6000;
/// Violation of a point of which there is no machine.
const NONE: f64 = 1e3;

/// Search for the path near a wanted one whose gears are the bluntest: every point may move within its band along the path's
/// normal, and the axis, where it is free, about the best known.
///
/// What is sought is the largest module with which full teeth are surely sound on the four pitch curves of the split by powers, by
/// their greatest curvatures, [`TwoBar::curvatures`]. The eased path is of degree five: its pitch curves' curvatures do not jump.
#[derive(Clone, Debug)]
pub struct Easing {
    points: Vec<Point>,
    normals: Vec<Vector>,
    bands: Vec<f64>,
    /// Axis, and how far it may move.
    axis: (Point, f64),
    bend: f64,
    /// Module wanted, mm: then the moves are sought that reach it and are the least shares of their bands.
    wanted: Option<f64>,
    start: Vec<f64>,
    /// Number of points that were given; the others are a free return.
    given: usize,
}

/// A path eased within its bands, and its machine.
#[derive(Clone, Debug)]
pub struct EasedPath {
    /// Points of the path; after those given stand those of a free return.
    pub points: Vec<Point>,
    /// Distance of each point given from where it was wanted, mm.
    pub moved: Vec<f64>,
    /// Carrier and arm.
    pub chain: TwoBar,
    /// Module up to which full teeth are surely sound, mm: on the pitch curves of the wanted path, where the axis found makes a
    /// machine for it, and on those of the eased one.
    pub module: (Option<f64>, f64),
    /// Evaluations of the search.
    pub evaluations: u64,
}

/// Reason why a path is not eased.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EasingError {
    /// The points make no path.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A band that is none.
    #[error("the band of point {number} is zero or more, in mm, not {band}")]
    Band {
        /// Number of the point, from one.
        number: usize,
        /// Band given, mm.
        band: f64,
    },
    /// Another number of bands than of points.
    #[error("there are {bands} bands for {points} points: give one for each, or one for all")]
    Bands {
        /// Bands given.
        bands: usize,
        /// Points.
        points: usize,
    },
    /// Too few points of a working part.
    #[error("the working part of a path has {least} points or more, not {count}")]
    TooFew {
        /// Points given.
        count: usize,
        /// Fewest.
        least: usize,
    },
    /// No return closes the working part.
    #[error(
        "no machine of this kind has a tip that runs along the points: of {returns} returns tried from the last to the first, with {axis}, none is possible"
    )]
    NoReturn {
        /// Returns tried.
        returns: usize,
        /// With which axes.
        axis: &'static str,
    },
    /// A module that is none.
    #[error("the module wanted is greater than zero, in mm, not {module}")]
    Module {
        /// Module given, mm.
        module: f64,
    },
    /// The axis given makes no machine for the wanted path.
    #[error(transparent)]
    Axis(#[from] AxisFault),
    /// No axis tried makes a machine for the wanted path.
    #[error(
        "no machine of this kind has a tip that runs along the path: of {tried} axes tried on and about it none is possible"
    )]
    NoAxis {
        /// Axes tried.
        tried: usize,
    },
}

impl Easing {
    /// The search for a path through points each within its band, mm. `bend` is the angle from the carrier's first leg to its
    /// second, rad. Without an axis the search starts from the one of a grid about the path whose gears are the bluntest.
    ///
    /// # Errors
    /// [`EasingError`]: the points make no path, a band is none, or no axis makes a machine for the wanted path.
    pub fn new(
        points: &[Point],
        bands: &[f64],
        axis: Option<Point>,
        bend: f64,
    ) -> Result<Self, EasingError> {
        let path = WantedPath::through(points)?;
        let mut bands = each(bands, points.len())?;
        let is_closed = points.len() > 1 && points.first() == points.last();
        let points = &points[..points.len() - usize::from(is_closed)];
        bands.truncate(points.len());
        let is_band = |band: &f64| *band >= 0.0 && band.is_finite();
        if let Some(i) = bands.iter().position(|band| !is_band(band)) {
            let (number, band) = (i + 1, bands[i]);
            return Err(EasingError::Band { number, band });
        }
        let axis = match axis {
            Some(axis) => (TwoBar::new(&path, axis, None)?.axis(), 0.0),
            None => {
                let map = AxisMap::new(&path, AxisRange::about(&path));
                let tried = map.found().len();
                let axis = map.bluntest(bend).ok_or(EasingError::NoAxis { tried })?;
                (axis, ROOM * path.bounds().diagonal())
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
            bend,
            wanted: None,
            start: Vec::new(),
            given: points.len(),
        };
        easing.start = vec![0.0; easing.bounds().len()];
        Ok(easing)
    }

    /// The search for a path whose working part alone is given, mm, each point within its band: the return from its last point to
    /// its first is free. Of several returns that leave and meet it along its own direction the search starts from the one whose
    /// gears are the bluntest.
    ///
    /// # Errors
    /// [`EasingError`], as of [`new`](Self::new), and where no return makes a machine.
    pub fn with_free_return(
        points: &[Point],
        bands: &[f64],
        axis: Option<Point>,
        bend: f64,
    ) -> Result<Self, EasingError> {
        let (count, least) = (points.len(), FEWEST_OPEN);
        if count < least {
            return Err(EasingError::TooFew { count, least });
        }
        let bands = each(bands, count)?;
        let mut best: Option<(f64, Self)> = None;
        let mut fault = None;
        for share in RETURNS {
            let closed: Vec<Point> = points.iter().copied().chain(back(points, share)).collect();
            let size = closed.iter().copied().collect::<Bounds>().diagonal();
            let mut bands = bands.clone();
            bands.resize(closed.len(), FREE * size);
            match Self::new(&closed, &bands, axis, bend) {
                Ok(mut easing) => {
                    easing.given = count;
                    if let Some(module) = easing.module(&easing.start)
                        && best.as_ref().is_none_or(|(most, _)| module > *most)
                    {
                        best = Some((module, easing));
                    }
                }
                Err(EasingError::Axis(_) | EasingError::NoAxis { .. }) => {}
                Err(error) => fault = Some(error),
            }
        }
        best.map(|(_, easing)| easing).ok_or_else(|| {
            fault.unwrap_or(EasingError::NoReturn {
                returns: RETURNS.len(),
                axis: match axis {
                    Some(_) => "the axis asked for",
                    None => "axes on and about each path",
                },
            })
        })
    }

    /// Searches for the bluntest gears, or, where a module is wanted, mm, for the least shares of the bands with which it is
    /// reached. Where it is out of reach the bluntest are given. `observe` hears of evaluations.
    ///
    /// # Errors
    /// [`EasingError::Module`], and [`EasingError::Axis`] where no path of degree five within the bands has a machine.
    pub fn search(
        &self,
        wanted: Option<f64>,
        observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<EasedPath, EasingError> {
        if let Some(module) = wanted.filter(|module| !(*module > 0.0 && module.is_finite())) {
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
            let start = evaluations;
            let searched = minimise(problem, settings(target), &mut |progress| {
                observe(start + progress.evaluations)
            });
            let (search, ended) = searched.ok()?;
            evaluations += search.evaluations();
            let best = search.best();
            (best.evaluation.feasible()).then_some((best.point, ended))
        };
        if let Some((point, _)) = best(&found, wanted.map(|module| -module)) {
            found.start = point;
        }
        let is_reached = |easing: &Self| {
            let module = easing.module(&easing.start);
            wanted.is_some_and(|wanted| module.is_some_and(|module| module >= wanted))
        };
        if is_reached(&found) {
            found.wanted = wanted;
            if let Some((point, ended)) = best(&found, None)
                && ended != Ended::Stopped
            {
                found.start = point;
            }
        }
        let points = found.eased(&found.start);
        let moved = points.iter().zip(&self.points[..self.given]);
        let axis = found.axis_at(&found.start);
        let eased = TwoBar::new(&WantedPath::smoothly_through(&points)?, axis, None)?;
        // A free return was not wanted as it was tried first.
        let is_whole = self.given == self.points.len();
        let before = WantedPath::through(&self.points)?;
        let before = TwoBar::new(&before, axis, None).ok().filter(|_| is_whole);
        Ok(EasedPath {
            moved: moved.map(|(p, q)| (p - q).norm()).collect(),
            module: (before.map(|chain| self.borne(&chain)), self.borne(&eased)),
            chain: eased,
            points,
            evaluations,
        })
    }

    /// Variables that move points.
    fn moves(&self) -> usize {
        match self.points.len() {
            few @ ..=SINGLE => few,
            _ => 1 + 2 * HARMONICS,
        }
    }

    /// Share of its band by which each point moves outwards.
    fn shares(&self, variables: &[f64]) -> Vec<f64> {
        let count = self.points.len();
        if count <= SINGLE {
            return variables[..count].to_vec();
        }
        let (mean, waves) = variables[..self.moves()].split_at(1);
        let share = |i: usize| {
            let angle = TAU * i as f64 / count as f64;
            let waves = waves.chunks(2).enumerate().map(|(k, wave)| {
                let (sin, cos) = (angle * (k + 1) as f64).sin_cos();
                wave[0] * cos + wave[1] * sin
            });
            let sum = mean[0] + waves.sum::<f64>();
            sum / (1.0 + sum * sum).sqrt()
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
        let (axis, room) = self.axis;
        match &variables[self.moves()..] {
            [x, y] => axis + Vector::new(*x, *y) * room,
            _ => axis,
        }
    }

    fn module(&self, variables: &[f64]) -> Option<f64> {
        let path = WantedPath::smoothly_through(&self.eased(variables)).ok()?;
        let chain = TwoBar::new(&path, self.axis_at(variables), None).ok()?;
        // A free return must not cross the working part.
        let is_whole = self.given == self.points.len();
        (is_whole || path.check_simple().is_ok()).then(|| self.borne(&chain))
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
            ..=SINGLE => vec![(-1.0, 1.0); moves],
            _ => {
                let wave = |k: usize| GREATEST / (1.0 + k.div_ceil(2) as f64);
                (0..moves).map(|k| (-wave(k), wave(k))).collect()
            }
        };
        if self.axis.1 > 0.0 {
            bounds.extend([(-1.0, 1.0); 2]);
        }
        bounds
    }

    fn start(&self) -> Option<Vec<f64>> {
        Some(self.start.clone())
    }

    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let Some(module) = self.module(point) else {
            return Evaluation {
                objective: 0.0,
                constraints: vec![NONE],
            };
        };
        match self.wanted {
            None => Evaluation {
                objective: -module,
                constraints: Vec::new(),
            },
            Some(wanted) => {
                let shares = self.shares(point);
                let moved = shares
                    .iter()
                    .zip(&self.bands)
                    .filter(|(_, band)| **band > 0.0);
                Evaluation {
                    objective: moved.fold(0.0, |most, (share, _)| share.abs().max(most)),
                    constraints: vec![wanted / module - 1.0],
                }
            }
        }
    }
}

/// Points between the last and the first of some along a cubic that leaves and meets them along their own direction; the tangents
/// are so many times as long as the distance.
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
    let [least, most] = RETURN_POINTS;
    let inner = ((chords.sum::<f64>() / step) as usize).clamp(least, most);
    (1..=inner)
        .map(|k| at(k as f64 / (inner + 1) as f64))
        .collect()
}

/// A band for each point, of one for each or one for all.
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
