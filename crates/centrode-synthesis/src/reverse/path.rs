use std::ops::Range;
use std::sync::Arc;

use centrode_geometry::{
    Bounds, Curve, Jet, Outline, Point, SampledPiece, Segment, Vector, piece_ends,
};

use super::{PathError, RequiredPoints};
use centrode_gear::pitch::closed_spline;

/// Fewest points of a closed curve.
const FEWEST: usize = 4;
/// Most points of a path.
const MOST: usize = 50_000;
/// Maximum coordinate, mm.
pub(super) const FARTHEST: f64 = 1e9;
/// Maximum distance of the axis from the path as a multiple of the path's size. The laws bring the tip within 1e-7 of its
/// distance from the axis, here 1e-4 of the path's size; ten times farther, tables of the laws lose all digits.
pub(super) const FARTHEST_AXIS: f64 = 1e3;
/// Minimum size of a path as a share of its distance from the origin: a smaller one has lost the digits that its law needs.
const SMALLEST: f64 = 1e-6;
/// Maximum distance of the last point from the first, as a multiple of the maximum distance of two other neighbours.
const GAP: f64 = 4.0;
/// Samples per turn, and minimum number between two breaks.
const SAMPLES: f64 = 384.0;
const MIN_SAMPLES: f64 = 2.0;
/// Maximum number of parts into which a turn is cut for searches of extremes: if a curve has more pieces, a part spans several.
const MAX_PARTS: usize = 64;
/// Number of equal parts of a turn, in each of which an analytic path has few extremes.
const EVEN_PARTS: u32 = 16;
/// Sides of the polygon on which crossings are searched.
const SIDES: usize = 2000;

/// A closed path, required of the tip of a machine.
///
/// The order of its points is the order in time; the speed along it is free.
#[derive(Clone, Debug)]
pub struct RequiredPath {
    curve: Arc<dyn Curve>,
    breaks: Vec<f64>,
    samples: Vec<Sample>,
    pieces: Vec<PathPiece>,
}

/// A smooth piece of the path, the indices of its samples, and the limit at its end.
pub(super) type PathPiece = (SampledPiece, Range<usize>, Sample);

/// A point of the path and its derivatives at a parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) at: f64,
    pub(super) jet: Jet,
}

impl RequiredPath {
    /// Maximum size of a path's file, bytes.
    pub const LARGEST: usize = 1 << 22;

    /// Closed curve through points in order: a periodic cubic spline over their index.
    ///
    /// The last point may repeat the first.
    ///
    /// # Errors
    /// [`PathError`] for too few or too many points, a point that is not finite or given twice, and a path smaller than a
    /// millionth of its distance from the origin. Also for an open path: its last point is more than four times as far from the
    /// first as any two other neighbours are from each other.
    pub fn through(points: &[Point]) -> Result<Self, PathError> {
        Self::of_degree(points, 3)
    }

    /// Closed curve as of [`through`](Self::through), of degree five: the curvatures of the pitch curves made from it have no
    /// jumps.
    ///
    /// # Errors
    /// As [`through`](Self::through).
    pub fn smoothly_through(points: &[Point]) -> Result<Self, PathError> {
        Self::of_degree(points, 5)
    }

    /// Points, at its knots, of the closed uniform cubic B-spline with the given control points, `(c(i-1) + 4 c(i) + c(i+1))/6`:
    /// the path [`through`](Self::through) these points is that spline.
    ///
    /// The last control point may repeat the first.
    #[must_use]
    pub fn knots(controls: &[Point]) -> Vec<Point> {
        let closed = controls.len() > 1 && controls.first() == controls.last();
        let controls = &controls[..controls.len() - usize::from(closed)];
        let count = controls.len();
        let at = |i: usize| controls[i % count].coords;
        let knot = |i: usize| Point::from((at(i + count - 1) + at(i) * 4.0 + at(i + 1)) / 6.0);
        (0..count).map(knot).collect()
    }

    fn of_degree(points: &[Point], degree: usize) -> Result<Self, PathError> {
        for (i, p) in points.iter().enumerate() {
            let (number, x, y) = (i + 1, p.x, p.y);
            if !(x.is_finite() && y.is_finite()) {
                return Err(PathError::NotFinite { number, x, y });
            }
            if x.abs().max(y.abs()) > FARTHEST {
                let limit = FARTHEST;
                return Err(PathError::TooFar {
                    number,
                    x,
                    y,
                    limit,
                });
            }
        }
        let closed = points.len() > 1 && points.first() == points.last();
        let points = &points[..points.len() - usize::from(closed)];
        let count = points.len();
        let minimum = FEWEST.max(degree + 1);
        if count < minimum {
            return Err(PathError::TooFew { count, minimum });
        }
        if count > MOST {
            let limit = MOST;
            return Err(PathError::TooMany { count, limit });
        }
        let bounds: Bounds = points.iter().copied().collect();
        let size = bounds.diagonal();
        let far = points.iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        if size < SMALLEST * far {
            return Err(PathError::TooSmall { size, far });
        }
        let step = |i: usize| (points[(i + 1) % count] - points[i]).norm();
        if let Some(i) = (0..count).find(|&i| step(i) == 0.0) {
            let (x, y) = (points[i].x, points[i].y);
            let (first, second) = (i + 1, (i + 1) % count + 1);
            return Err(PathError::Twice {
                first,
                second,
                x,
                y,
            });
        }
        let longest = (0..count - 1).map(step).fold(0.0, f64::max);
        let gap = step(count - 1);
        if gap > GAP * longest {
            let step = longest;
            return Err(PathError::Open { gap, step });
        }
        let list = points.iter().map(|p| [p.x, p.y]).collect();
        Ok(Self::new(Arc::new(closed_spline(list, degree))))
    }

    /// Path along a closed curve, which need not surround anything.
    #[must_use]
    pub fn new(curve: Arc<dyn Curve>) -> Self {
        let period = curve.period();
        let breaks: Vec<f64> = curve
            .breaks()
            .into_iter()
            .filter(|b| (0.0..period).contains(b))
            .collect();
        let mut samples = Vec::new();
        let mut smooth = Vec::new();
        for pair in piece_ends(0.0, period, 1, &breaks).windows(2) {
            let share = (pair[1] - pair[0]) / period;
            let steps = (SAMPLES * share).ceil().max(MIN_SAMPLES);
            let piece = SampledPiece {
                from: pair[0],
                to: pair[1],
                steps: steps as usize,
            };
            let sample = |i: usize| {
                let at = piece.at(i);
                let jet = curve.at(at);
                Sample { at, jet }
            };
            let first = samples.len();
            samples.extend((0..piece.steps).map(sample));
            smooth.push((piece, first..samples.len(), sample(piece.steps)));
        }
        Self {
            curve,
            breaks,
            samples,
            pieces: smooth,
        }
    }

    /// Reads points from a CSV file: x and y in mm, one point per line, in order.
    ///
    /// Columns are separated by commas, or by semicolons or tabs; with these a decimal comma is read, too. Empty lines and lines
    /// that begin with `#` are skipped. A line of headings names the columns in any order: `x`, `y`, `tolerance`,
    /// `direction_deg`, `direction_tolerance_deg`. Other columns are refused.
    ///
    /// # Errors
    /// [`PathError`] with the line, and as [`through`](Self::through).
    pub fn from_csv(bytes: &[u8]) -> Result<Self, PathError> {
        Self::through(&RequiredPoints::from_csv(bytes)?.points)
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &Arc<dyn Curve> {
        &self.curve
    }

    /// Parameter after which the path is closed.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.curve.period()
    }

    /// Parameters in `[0, period)` at which a derivative may jump, ascending.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Point and derivatives at a parameter.
    #[must_use]
    pub fn at(&self, t: f64) -> Jet {
        self.curve.at(t)
    }

    /// Smallest axis-aligned box round samples of the path.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.samples.iter().map(|s| s.jet.point).collect()
    }

    /// Checks that the path does not cross itself, on a polygon of 2,000 sides.
    ///
    /// # Errors
    /// [`PathError::Crossing`] with the position.
    pub fn check_simple(&self) -> Result<(), PathError> {
        let at = |i: usize| {
            let share = (i % SIDES) as f64 / SIDES as f64;
            self.at(share * self.period()).point
        };
        let sides = (0..SIDES).map(|i| Segment::Line(at(i), at(i + 1)));
        let crossing = Outline::new(sides.collect())
            .ok()
            .and_then(|o| o.crossing());
        match crossing {
            None => Ok(()),
            Some(found) => Err(PathError::Crossing {
                x: found.point.x,
                y: found.point.y,
            }),
        }
    }

    pub(super) fn samples(&self) -> &[Sample] {
        &self.samples
    }

    pub(super) fn pieces(&self) -> &[PathPiece] {
        &self.pieces
    }

    /// Ends of the parts of one turn that starts at `from`. Within a part the path is smooth; if it has many pieces, only nearly
    /// so.
    pub(crate) fn parts(&self, from: f64) -> Vec<f64> {
        let to = from + self.period();
        if self.breaks.len() > MAX_PARTS {
            return piece_ends(from, to, MAX_PARTS as u32, &[]);
        }
        let even = if self.breaks.len() < EVEN_PARTS as usize / 2 {
            EVEN_PARTS
        } else {
            1
        };
        piece_ends(from, to, even, &self.breaks_between(from, to))
    }

    /// Breaks strictly between two parameters, ascending.
    pub(super) fn breaks_between(&self, from: f64, to: f64) -> Vec<f64> {
        let period = self.period();
        if self.breaks.is_empty() {
            return Vec::new();
        }
        let turn = |t: f64| (t / period).floor() as i64;
        let mut found = Vec::new();
        for turn in turn(from)..=turn(to) {
            let shift = turn as f64 * period;
            let first = self.breaks.partition_point(|b| b + shift <= from);
            let later = self.breaks[first..].iter().map(|b| b + shift);
            found.extend(later.take_while(|&b| b < to));
        }
        found
    }

    /// Distance of a point from the path near a parameter, mm: from the point to the foot of its normal.
    pub(crate) fn distance_near(&self, point: Point, t: f64) -> f64 {
        let mut t = t;
        let mut off = Vector::zeros();
        for _ in 0..4 {
            let jet = self.at(t);
            off = point - jet.point;
            let slope = jet.first.norm_squared() - off.dot(&jet.second);
            let step = off.dot(&jet.first) / slope;
            if !(slope > 0.0 && step.is_finite()) {
                break;
            }
            t += step;
        }
        let foot = (point - self.at(t).point).norm();
        foot.min(off.norm())
    }
}

/// Samples of a path; the samples of a piece include its end.
pub(super) struct PathSamples {
    pub(super) pieces: Vec<SampledPiece>,
    pub(super) samples: Vec<Sample>,
}

impl PathSamples {
    /// Samples of at most `most` pieces, evenly spread.
    pub(super) fn new(path: &RequiredPath, most: usize) -> Self {
        let count = path.pieces().len();
        let step = count.div_ceil(most);
        let pieces = path.pieces().iter().step_by(step);
        let mut found = Self {
            pieces: Vec::with_capacity(count / step + 1),
            samples: Vec::with_capacity(path.samples().len() + count),
        };
        for (piece, samples, end) in pieces {
            found.pieces.push(*piece);
            found
                .samples
                .extend_from_slice(&path.samples()[samples.clone()]);
            found.samples.push(*end);
        }
        found
    }
}

/// Text of a file, without the byte order mark with which some programs begin it.
pub(super) fn text(bytes: &[u8]) -> Result<&str, PathError> {
    if bytes.len() > RequiredPath::LARGEST {
        let (bytes, limit) = (bytes.len(), RequiredPath::LARGEST);
        return Err(PathError::TooLarge { bytes, limit });
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let good = &bytes[..error.valid_up_to()];
        let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
        PathError::NotText { line }
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}
