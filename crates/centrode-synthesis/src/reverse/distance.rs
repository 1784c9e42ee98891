use centrode_geometry::{Jet, Point, bracketed_minimum, bracketed_root};

use super::limit::{Limit, squares};
use super::path::{FARTHEST, FARTHEST_AXIS, Sample};
use super::{AxisFault, RequiredPath};
use centrode_kinematics::formula::Taylor;

/// Value and first two derivatives, as Taylor coefficients.
pub(super) type Series = Taylor<3>;

/// Difference of a distance's square from its extreme below which digits are lost, as a share of the maximum square.
const NEAR: f64 = 4e-4;
/// Maximum number of breaks between an extreme and a position near it: with more, the path itself loses more digits.
const MAX_BREAKS: usize = 8;
/// Relative difference of the maximum and minimum distance below which both count as equal.
const SAME: f64 = 1e-9;
/// Minimum distance of the path from the axis, as a share of the maximum.
const CLEAR: f64 = 1e-9;

/// Distance of a path from an axis, with one maximum and one minimum value in a turn.
///
/// With u the square of the distance and R, rho its extremes, `sqrt(R^2 - u)` and `sqrt(u - rho^2)` are smooth if their sign
/// changes where they are zero. Near a zero they are `h sqrt(v)` with h the step from the extreme and
/// `v = -+ integral of (1 - tau) u''(extreme + tau h) from 0 to 1`, a limit in which no digit is lost.
#[derive(Clone, Debug)]
pub(super) struct Distance {
    pub(super) axis: Point,
    /// Parameter of the maximum distance, in `[0, period)`.
    pub(super) far: f64,
    /// Parameter of the minimum distance, in `(far, far + period)`.
    pub(super) near: f64,
    /// Maximum and minimum distance, mm.
    pub(super) reach: [f64; 2],
}

/// An extreme of the distance.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: f64,
    is_maximum: bool,
}

impl Distance {
    pub(super) fn new(path: &RequiredPath, axis: Point) -> Result<Self, AxisFault> {
        let (x, y) = (axis.x, axis.y);
        if !(x.abs() <= FARTHEST && y.abs() <= FARTHEST) {
            let limit = FARTHEST;
            return Err(AxisFault::NotFinite { x, y, limit });
        }
        let squares = path.samples().iter();
        let squares = squares.map(|s| (s.jet.point - axis).norm_squared());
        let (minimum, maximum) = squares.fold((f64::INFINITY, 0.0_f64), |(low, high), u| {
            (low.min(u), high.max(u))
        });
        let distance = maximum.sqrt();
        let limit = FARTHEST_AXIS * path.bounds().diagonal();
        if minimum.sqrt() > limit {
            let distance = minimum.sqrt();
            return Err(AxisFault::TooFar { distance, limit });
        }
        if (maximum - minimum) <= SAME * maximum {
            return Err(AxisFault::Circle { distance });
        }
        let places = extremes(path, axis);
        let place = |is_maximum: bool| {
            let of_kind = places.iter().filter(move |p| p.is_maximum == is_maximum);
            of_kind.map(|p| p.at).collect::<Vec<f64>>()
        };
        let (maxima, minima) = (place(true), place(false));
        let ([far], [near]) = (&maxima[..], &minima[..]) else {
            let maxima = maxima.iter().map(|&t| path.at(t).point).collect();
            return Err(AxisFault::Extremes { maxima });
        };
        let far = far.rem_euclid(path.period());
        let mut near = near.rem_euclid(path.period());
        if near <= far {
            near += path.period();
        }
        let reach = [far, near].map(|t| (path.at(t).point - axis).norm());
        if reach[1] <= CLEAR * reach[0] {
            let distance = reach[1];
            return Err(AxisFault::OnAxis { distance });
        }
        Ok(Self {
            axis,
            far,
            near,
            reach,
        })
    }

    /// The extreme near which a difference of squares would lose digits, and the step from it; `None` if none is so near.
    fn beside(&self, path: &RequiredPath, t: f64, square: f64) -> Option<(Place, f64)> {
        let [far, near] = self.reach.map(|r| r * r);
        let room = NEAR * far;
        let place = |at: f64, is_maximum: bool| (Place { at, is_maximum }, t - at);
        let found = if far - square <= room {
            let last = self.far + path.period();
            let at = if t <= self.near { self.far } else { last };
            place(at, true)
        } else if square - near <= room {
            place(self.near, false)
        } else {
            return None;
        };
        let (from, to) = (found.0.at.min(t), found.0.at.max(t));
        (path.breaks_between(from, to).len() <= MAX_BREAKS).then_some(found)
    }

    /// `sqrt(R^2 - u)` and `sqrt(u - rho^2)` with their derivatives at a parameter in `[far, far + period]`, the second negative
    /// beyond the minimum distance.
    pub(super) fn legs(&self, path: &RequiredPath, t: f64, jet: &Jet) -> [Series; 2] {
        let (p, d1, d2) = (jet.point - self.axis, jet.first, jet.second);
        let u = [
            p.norm_squared(),
            2.0 * p.dot(&d1),
            d1.norm_squared() + p.dot(&d2),
        ];
        let [far, near] = self.reach.map(|r| r * r);
        let sign = if t <= self.near { 1.0 } else { -1.0 };
        let beside = self.beside(path, t, u[0]);
        let at = |is_maximum: bool| {
            let found = beside.filter(|(place, _)| place.is_maximum == is_maximum);
            found.map(|(place, h)| self.root(path, place, h, jet))
        };
        let away = at(true).unwrap_or_else(|| {
            // Rounding may leave a square a little above the maximum.
            Taylor([(far - u[0]).max(0.0), -u[1], -u[2]]).sqrt()
        });
        let close = at(false).unwrap_or_else(|| {
            let root = Taylor([(u[0] - near).max(0.0), u[1], u[2]]).sqrt();
            root * sign
        });
        [away, close]
    }

    /// One of the roots near its extreme, by the limit: `h w` with w = sqrt(v).
    fn root(&self, path: &RequiredPath, place: Place, h: f64, jet: &Jet) -> Series {
        let sense = if place.is_maximum { -1.0 } else { 1.0 };
        let limit = Limit::new(path, self.axis, place.at, h, jet);
        let [v, slope] = limit.square.map(|integral| sense * integral);
        let bend = sense * limit.bends[1];
        let w = v.sqrt();
        // v' = slope and h v'' = bend.
        let w1 = slope / (2.0 * w);
        let hw2 = bend / (2.0 * w) - h * slope * slope / (4.0 * w * w * w);
        let series = Taylor([h * w, w + h * w1, w1 + 0.5 * hw2]);
        // The first root is positive between two maxima of the distance; the second is positive before the minimum.
        let ahead = if place.is_maximum {
            place.at == self.far
        } else {
            false
        };
        if ahead { series } else { -series }
    }

    /// Speed of `2 arg(sqrt(u - rho^2), sqrt(R^2 - u))`, which is `|u'|` over the product of both roots, with up to two
    /// derivatives.
    #[inline]
    pub(super) fn turning<const N: usize>(
        &self,
        path: &RequiredPath,
        t: f64,
        jet: &Jet,
    ) -> Taylor<N> {
        let u = (jet.point - self.axis).norm_squared();
        let [d1, d2, d3] = squares(jet, self.axis);
        let [far, near] = self.reach.map(|r| r * r);
        let [to_far, from_near] = [
            taylor([far - u, -d1, -0.5 * d2]),
            taylor([u - near, d1, 0.5 * d2]),
        ];
        let Some((place, h)) = self.beside(path, t, u) else {
            return taylor::<N>([d1, d2, 0.5 * d3]) * d1.signum() / (to_far * from_near).sqrt();
        };
        let other = if place.is_maximum { from_near } else { to_far };
        let limit = Limit::new(path, self.axis, place.at, h, jet);
        let bends = match N {
            3.. => limit.second(path, self.axis, place.at, h),
            _ => [0.0; 2],
        };
        let sense = limit.square[0].signum();
        // u' and the square of the root, each divided by its power of the step.
        let series = |[value, slope]: [f64; 2], bend: f64| {
            taylor::<N>([value * sense, slope * sense, 0.5 * bend * sense])
        };
        let rate = series(limit.slope, bends[0]);
        rate / (series(limit.square, bends[1]) * other).sqrt()
    }
}

/// The first N Taylor coefficients.
pub(super) fn taylor<const N: usize>(all: [f64; 3]) -> Taylor<N> {
    Taylor(std::array::from_fn(|k| all.get(k).copied().unwrap_or(0.0)))
}

/// Positions along a path at which its distance from an axis has a local maximum or minimum.
fn extremes(path: &RequiredPath, axis: Point) -> Vec<Place> {
    let slope_of = |jet: &Jet| (jet.point - axis).dot(&jet.first);
    let slope = |t: f64| slope_of(&path.at(t));
    let samples = path.samples();
    let slopes: Vec<f64> = samples.iter().map(|s| slope_of(&s.jet)).collect();
    let count = samples.len();
    let end = |i: usize| match samples.get(i) {
        Some(Sample { at, .. }) => *at,
        None => path.period(),
    };
    let mut found = Vec::new();
    for i in 0..count {
        let [before, here, after] =
            [(i + count - 1) % count, i, (i + 1) % count].map(|i| slopes[i]);
        if (here > 0.0) != (after > 0.0) {
            found.push(Place {
                at: bracketed_root(slope, end(i), end(i + 1), here, after),
                is_maximum: here > 0.0,
            });
        }
        // The slope may have two zeros between samples if it comes near zero and turns back.
        let side = here.signum();
        let [low, middle, high] = [before, here, after].map(|s| s * side);
        let is_minimum = middle <= low && middle <= high && low + high > 2.0 * middle;
        if i > 0 && is_minimum && middle <= low + high - 2.0 * middle {
            let (at, value) = bracketed_minimum(|t| slope(t) * side, end(i - 1), end(i + 1));
            if value < 0.0 {
                found.extend([true, false].map(|is_maximum| Place { at, is_maximum }));
            }
        }
    }
    found
}
