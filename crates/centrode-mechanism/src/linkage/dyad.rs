use std::ops::{Add, Mul, Sub};

use serde::{Deserialize, Serialize};

use super::point_series::PointSeries;
use crate::formula::Taylor;

/// Which of its two ways a dyad is assembled.
#[derive(
    Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Branch {
    /// Two bars: their common joint lies left of the way from the first outer joint to the second. A
    /// bar and a slider: the slider lies forward along its line.
    #[default]
    Upper,
    /// The other one.
    Lower,
}

impl Branch {
    /// +1 for the upper branch, -1 for the lower.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Upper => 1.0,
            Self::Lower => -1.0,
        }
    }

    /// The other way.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Upper => Self::Lower,
            Self::Lower => Self::Upper,
        }
    }
}

/// A dyad's closed form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed<const N: usize, T> {
    pub(crate) at: T,
    /// Above zero where the dyad closes with room, zero where it is stretched or folded, below where it
    /// cannot close: in mm⁴ (two bars) or mm² (the others).
    pub(crate) room: Taylor<N>,
}

/// A length that is a plain number, or a series where its own influence is asked for.
pub(crate) trait Length<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    fn times(self, series: Taylor<N>) -> Taylor<N>;

    fn taken_from(self, series: Taylor<N>) -> Taylor<N>;
}

impl<const N: usize> Length<N> for f64 {
    fn times(self, series: Taylor<N>) -> Taylor<N> {
        series * self
    }

    fn taken_from(self, series: Taylor<N>) -> Taylor<N> {
        series - self
    }
}

impl<const N: usize> Length<N> for Taylor<N> {
    fn times(self, series: Self) -> Self {
        series * self
    }

    fn taken_from(self, series: Self) -> Self {
        series - self
    }
}

/// The common joint of two bars from `p` and `q`, `first` and `second` long.
///
/// With d the way from p to q and s = d², the joint is p + a d + h d⊥, where
/// a = 1/2 + (first² - second²) / (2 s) and, after Heron,
/// h = sqrt(((first + second)² - s) (s - (first - second)²)) / (2 s).
#[inline(always)]
pub(crate) fn rrr<const N: usize, L: Length<N>>(
    p: PointSeries<N>,
    q: PointSeries<N>,
    (first, second): (L, L),
    branch: Branch,
) -> Closed<N, PointSeries<N>> {
    let d = q.minus(p);
    let s = d.dot(d);
    let sum = first + second;
    let difference = first - second;
    let (short, long) = (
        (difference * difference).taken_from(s),
        (sum * sum).taken_from(s),
    );
    let room = -(long * short);
    let half = (s + s).reciprocal();
    let a = (sum * difference).times(half) + 0.5;
    let h = room.sqrt() * half * branch.sign();
    let at = p.plus(d.times(a)).plus(d.left().times(h));
    Closed { at, room }
}

/// The slider on the line through `u` along the unit vector `e`, at the end of a bar from `p`.
#[inline(always)]
pub(crate) fn rrp<const N: usize>(
    p: PointSeries<N>,
    length: f64,
    u: PointSeries<N>,
    e: PointSeries<N>,
    branch: Branch,
) -> Closed<N, PointSeries<N>> {
    let w = p.minus(u);
    let away = e.cross(w);
    let room = -(away * away - length * length);
    let along = w.dot(e) + room.sqrt() * branch.sign();
    let at = u.plus(e.times(along));
    Closed { at, room }
}

/// The direction of a link that turns about `q` and slides through the block at `p`, its line passing
/// the pivot at the distance `offset` to the left.
#[inline(always)]
pub(crate) fn rpr<const N: usize>(
    p: PointSeries<N>,
    q: PointSeries<N>,
    offset: f64,
    branch: Branch,
) -> Closed<N, PointSeries<N>> {
    let w = p.minus(q);
    let s = w.dot(w);
    let room = s - offset * offset;
    let along = room.sqrt() * branch.sign();
    // As complex numbers w = (along + i offset) e.
    let turned = w.times(along).minus(w.left().times(offset));
    let at = turned.times(s.reciprocal());
    Closed { at, room }
}

/// The joint of two sliders, on the lines through `u` along `e` and through `v` along `f`.
#[inline(always)]
pub(crate) fn prp<const N: usize>(
    u: PointSeries<N>,
    e: PointSeries<N>,
    v: PointSeries<N>,
    f: PointSeries<N>,
) -> Closed<N, PointSeries<N>> {
    let slant = e.cross(f);
    let along = v.minus(u).cross(f) * slant.reciprocal();
    let at = u.plus(e.times(along));
    Closed {
        at,
        room: slant * slant,
    }
}
