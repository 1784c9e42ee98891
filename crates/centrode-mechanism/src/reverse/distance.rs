use centrode_geometry::{Antiderivative, Jet, Point, Vector, bracketed_minimum, bracketed_root};

use super::path::{FARTHEST, Sample};
use super::{AxisFault, WantedPath};
use crate::formula::Taylor;

/// Value and first two derivatives, as Taylor coefficients.
pub(super) type Series = Taylor<3>;

/// Share of the greatest distance's square within which of an extreme differences of squares lose digits.
const NEAR: f64 = 4e-4;
/// Most breaks between an extreme and a place that is near it: beyond, digits lost are fewer than the path's own.
const MOST_BREAKS: usize = 8;
/// Difference of the greatest and least distance, as a share, that is rounding.
const SAME: f64 = 1e-9;
/// Least distance of the path from the axis, as a share of the greatest.
const CLEAR: f64 = 1e-9;

/// Distance of a path from an axis, with one greatest and one least value in a turn.
///
/// With u the square of the distance and R, rho its extremes, `sqrt(R^2 - u)` and `sqrt(u - rho^2)` are smooth once they
/// change sign where they are zero. There they are `h sqrt(v)` with h the step from the extreme and
/// `v = -+ integral of (1 - tau) u''(extreme + tau h) from 0 to 1`, a limit in which no digit is lost.
#[derive(Clone, Debug)]
pub(super) struct Distance {
    pub(super) axis: Point,
    /// Parameter of the greatest distance, in `[0, period)`.
    pub(super) far: f64,
    /// Parameter of the least distance, in `(far, far + period)`.
    pub(super) near: f64,
    /// Greatest and least distance, mm.
    pub(super) reach: [f64; 2],
}

/// An extreme of the distance.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: f64,
    is_greatest: bool,
}

impl Distance {
    pub(super) fn new(path: &WantedPath, axis: Point) -> Result<Self, AxisFault> {
        let (x, y) = (axis.x, axis.y);
        if !(x.abs() <= FARTHEST && y.abs() <= FARTHEST) {
            let limit = FARTHEST;
            return Err(AxisFault::NotFinite { x, y, limit });
        }
        let squares = path.samples().iter();
        let squares = squares.map(|s| (s.jet.point - axis).norm_squared());
        let (least, greatest) = squares.fold((f64::INFINITY, 0.0_f64), |(low, high), u| {
            (low.min(u), high.max(u))
        });
        let distance = greatest.sqrt();
        if (greatest - least) <= SAME * greatest {
            return Err(AxisFault::Circle { distance });
        }
        let places = extremes(path, axis);
        let place = |is_greatest: bool| {
            let of_kind = places.iter().filter(move |p| p.is_greatest == is_greatest);
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

    /// The extreme beside which a difference of squares would lose digits, and the step from it.
    fn beside(&self, path: &WantedPath, t: f64, square: f64) -> Option<(Place, f64)> {
        let [far, near] = self.reach.map(|r| r * r);
        let room = NEAR * far;
        let place = |at: f64, is_greatest: bool| (Place { at, is_greatest }, t - at);
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
        (path.breaks_between(from, to).len() <= MOST_BREAKS).then_some(found)
    }

    /// `sqrt(R^2 - u)` and `sqrt(u - rho^2)` with their derivatives at a parameter in `[far, far + period]`, the second below
    /// zero beyond the least distance.
    pub(super) fn legs(&self, path: &WantedPath, t: f64, jet: &Jet) -> [Series; 2] {
        let (p, d1, d2) = (jet.point - self.axis, jet.first, jet.second);
        let u = [
            p.norm_squared(),
            2.0 * p.dot(&d1),
            d1.norm_squared() + p.dot(&d2),
        ];
        let [far, near] = self.reach.map(|r| r * r);
        let sign = if t <= self.near { 1.0 } else { -1.0 };
        let beside = self.beside(path, t, u[0]);
        let at = |is_greatest: bool| {
            let found = beside.filter(|(place, _)| place.is_greatest == is_greatest);
            found.map(|(place, h)| self.root(path, place, h))
        };
        let away = at(true).unwrap_or_else(|| {
            // Rounding may leave a square a little above the greatest.
            Taylor([(far - u[0]).max(0.0), -u[1], -u[2]]).sqrt()
        });
        let close = at(false).unwrap_or_else(|| {
            let root = Taylor([(u[0] - near).max(0.0), u[1], u[2]]).sqrt();
            root * sign
        });
        [away, close]
    }

    /// One of the roots beside its extreme, by the limit: `h w` with w = sqrt(v).
    fn root(&self, path: &WantedPath, place: Place, h: f64) -> Series {
        let sense = if place.is_greatest { -1.0 } else { 1.0 };
        let (second, third) = (self.second(path), self.third(path));
        let [of_second, of_third] = self.sizes(path, place.at);
        let ends = self.ends(path, place.at, h);
        let [v, slope, bend] = [
            mean(&ends, of_second, |tau| {
                (1.0 - tau) * second(place.at + tau * h)
            }),
            mean(&ends, of_third, |tau| {
                (1.0 - tau) * tau * third(place.at + tau * h)
            }),
            mean(&ends, of_third, |tau| {
                (3.0 * tau - 2.0) * tau * third(place.at + tau * h)
            }),
        ]
        .map(|integral| sense * integral);
        let w = v.sqrt();
        // v' = slope and h v'' = bend.
        let w1 = slope / (2.0 * w);
        let hw2 = bend / (2.0 * w) - h * slope * slope / (4.0 * w * w * w);
        let series = Taylor([h * w, w + h * w1, w1 + 0.5 * hw2]);
        // Positive after the greatest distance and before the next, and before the least.
        let ahead = if place.is_greatest {
            place.at == self.far
        } else {
            false
        };
        if ahead { series } else { -series }
    }

    /// Speed of `2 arg(sqrt(u - rho^2), sqrt(R^2 - u))`: `|u'|` over the product of both roots.
    pub(super) fn turning(&self, path: &WantedPath, t: f64, jet: &Jet) -> f64 {
        let p = jet.point - self.axis;
        let (u, slope) = (p.norm_squared(), 2.0 * p.dot(&jet.first));
        let [far, near] = self.reach.map(|r| r * r);
        let Some((place, h)) = self.beside(path, t, u) else {
            return slope.abs() / ((far - u) * (u - near)).sqrt();
        };
        let other = if place.is_greatest { u - near } else { far - u };
        let second = self.second(path);
        let ends = self.ends(path, place.at, h);
        let [size, _] = self.sizes(path, place.at);
        // u' and the square of the root, both over their power of the step.
        let rate = mean(&ends, size, |tau| second(place.at + tau * h));
        let square = mean(&ends, size, |tau| (1.0 - tau) * second(place.at + tau * h));
        rate.abs() / (square.abs() * other).sqrt()
    }

    /// Second derivative of the square of the distance.
    fn second<'a>(&'a self, path: &'a WantedPath) -> impl Fn(f64) -> f64 + 'a {
        move |t| {
            let jet = path.at(t);
            let p: Vector = jet.point - self.axis;
            2.0 * (jet.first.norm_squared() + p.dot(&jet.second))
        }
    }

    /// Third derivative of the square of the distance.
    fn third<'a>(&'a self, path: &'a WantedPath) -> impl Fn(f64) -> f64 + 'a {
        move |t| {
            let jet = path.at(t);
            let p: Vector = jet.point - self.axis;
            6.0 * jet.first.dot(&jet.second) + 2.0 * p.dot(&jet.third)
        }
    }

    /// Shares of a step from an extreme, between which the path is smooth.
    fn ends(&self, path: &WantedPath, at: f64, h: f64) -> Vec<f64> {
        let breaks = path.breaks_between(at.min(at + h), at.max(at + h));
        let shares = breaks.iter().map(|b| (b - at) / h);
        let mut ends: Vec<f64> = shares.filter(|tau| *tau > 0.0 && *tau < 1.0).collect();
        ends.sort_by(f64::total_cmp);
        ends.insert(0, 0.0);
        ends.push(1.0);
        ends
    }

    /// Sizes of the terms of the second and the third derivative, whose rounding theirs is.
    fn sizes(&self, path: &WantedPath, t: f64) -> [f64; 2] {
        let jet = path.at(t);
        let [p, d1, d2, d3] =
            [jet.point - self.axis, jet.first, jet.second, jet.third].map(|v| v.norm());
        [2.0 * (d1 * d1 + p * d2), 6.0 * d1 * d2 + 2.0 * p * d3]
    }
}

/// Integral over the unit interval.
fn mean(ends: &[f64], size: f64, f: impl Fn(f64) -> f64) -> f64 {
    Antiderivative::of_size(f, ends, size).total()
}

/// Places along a path at which its distance from an axis is greater, or less, than beside them.
fn extremes(path: &WantedPath, axis: Point) -> Vec<Place> {
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
                is_greatest: here > 0.0,
            });
        }
        // Two zeros between samples, where the slope comes near zero and turns.
        let side = here.signum();
        let [low, middle, high] = [before, here, after].map(|s| s * side);
        let is_least = middle <= low && middle <= high && low + high > 2.0 * middle;
        if i > 0 && is_least && middle <= low + high - 2.0 * middle {
            let (at, value) = bracketed_minimum(|t| slope(t) * side, end(i - 1), end(i + 1));
            if value < 0.0 {
                found.extend([true, false].map(|is_greatest| Place { at, is_greatest }));
            }
        }
    }
    found
}
