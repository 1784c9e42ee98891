use serde::{Deserialize, Serialize};

use super::point_series::PointSeries;
use crate::formula::{Number, Taylor};

/// Assembly branch of a dyad.
#[derive(
    Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Branch {
    /// Upper branch. Two bars: their common joint lies to the left of the line from the first outer joint to the
    /// second. A bar and a slider: the slider lies forward along its line.
    #[default]
    Upper,
    /// Lower branch: the other assembly.
    Lower,
}

impl Branch {
    /// Sign: +1 for the upper branch, -1 for the lower.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Upper => 1.0,
            Self::Lower => -1.0,
        }
    }

    /// Opposite branch.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Upper => Self::Lower,
            Self::Lower => Self::Upper,
        }
    }
}

/// Solution of a dyad in closed form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed<const N: usize, T = f64> {
    pub(crate) at: PointSeries<N, T>,
    /// Discriminant: above zero where the dyad closes, zero where it is stretched, folded or has parallel guides, below zero
    /// where it cannot close. Unit: mm⁴ (two bars), mm² (one slider) or none (two sliders).
    pub(crate) room: T,
}

/// Length that is a plain number, or a series if the derivative by the length itself is required.
pub(crate) trait Length<const N: usize, T>: Copy {
    fn value(self) -> T;

    fn series(self) -> Taylor<N, T>;

    fn times(self, series: Taylor<N, T>) -> Taylor<N, T>;

    /// `rest` plus the coefficient `order` (above 0) of half the square of the length.
    fn half_square_and(self, rest: T, order: usize) -> T;
}

impl<const N: usize, T: Number> Length<N, T> for f64 {
    #[inline(always)]
    fn value(self) -> T {
        T::from(self)
    }

    #[inline(always)]
    fn series(self) -> Taylor<N, T> {
        Taylor::constant(T::from(self))
    }

    #[inline(always)]
    fn times(self, series: Taylor<N, T>) -> Taylor<N, T> {
        series * self
    }

    #[inline(always)]
    fn half_square_and(self, rest: T, _: usize) -> T {
        rest
    }
}

impl<const N: usize> Length<N, f64> for Taylor<N> {
    fn value(self) -> f64 {
        self.0[0]
    }

    fn series(self) -> Self {
        self
    }

    fn times(self, series: Self) -> Self {
        series * self
    }

    fn half_square_and(self, rest: f64, order: usize) -> f64 {
        rest + 0.5 * (self * self).0[order]
    }
}

/// The common joint of two bars from `p` and `q`, `first` and `second` long.
///
/// With d the vector from p to q and s = d², the joint is p + a d + h d⊥, where
/// a = 1/2 + (first² - second²) / (2 s) and, after Heron,
/// h = sqrt(((first + second)² - s) (s - (first - second)²)) / (2 s).
/// Its constant distances from p and from q give its derivatives one after the other: each is the solution of the two linear
/// equations u·x = e, v·x = f along the bars u and v, whose determinant is s h.
#[inline(always)]
pub(crate) fn rrr<const N: usize, T: Number, L: Length<N, T>>(
    p: PointSeries<N, T>,
    q: PointSeries<N, T>,
    (first, second): (L, L),
    branch: Branch,
) -> Closed<N, T> {
    let (dx, dy) = (q.x.0[0] - p.x.0[0], q.y.0[0] - p.y.0[0]);
    let s = dx * dx + dy * dy;
    let sum = first.value() + second.value();
    let difference = first.value() - second.value();
    let room = (sum * sum - s) * (s - difference * difference);
    let twice_area = room.sqrt() * T::from(0.5 * branch.sign());
    let inverse = T::from(1.0) / s;
    let a = sum * difference * inverse * T::from(0.5) + T::from(0.5);
    let h = twice_area * inverse;
    let mut at = PointSeries {
        x: Taylor::constant(p.x.0[0] + (a * dx - h * dy)),
        y: Taylor::constant(p.y.0[0] + (a * dy + h * dx)),
    };
    let inverse = T::from(1.0) / twice_area;
    let (mut u, mut v) = (at.minus(p), at.minus(q));
    let (ux, uy) = (u.x.0[0] * inverse, u.y.0[0] * inverse);
    let (vx, vy) = (v.x.0[0] * inverse, v.y.0[0] * inverse);
    for k in 1..N {
        let e = along(u, p, k, first);
        let f = along(v, q, k, second);
        at.x.0[k] = e * vy - f * uy;
        at.y.0[k] = f * ux - e * vx;
        (u, v) = (at.minus(p), at.minus(q));
    }
    Closed { at, room }
}

/// Right-hand side of the rigidity condition at Taylor order `order`: required projection of the far end's
/// coefficient on the bar, times its length. `bar` is the bar's vector from `start`, known below that order.
#[inline(always)]
fn along<const N: usize, T: Number, L: Length<N, T>>(
    bar: PointSeries<N, T>,
    start: PointSeries<N, T>,
    order: usize,
    length: L,
) -> T {
    let with =
        |v: PointSeries<N, T>, i: usize, k: usize| bar.x.0[i] * v.x.0[k] + bar.y.0[i] * v.y.0[k];
    let mut sum = with(start, 0, order);
    // Half the square of the vector's known part, each product of two orders once.
    for i in 1..order.div_ceil(2) {
        sum = sum - with(bar, i, order - i);
    }
    if order.is_multiple_of(2) {
        sum = sum - with(bar, order / 2, order / 2) * T::from(0.5);
    }
    length.half_square_and(sum, order)
}

/// The slider on the line through `u` along the unit vector `e`, at the end of a bar from `p`.
#[inline(always)]
pub(crate) fn rrp<const N: usize, T: Number>(
    p: PointSeries<N, T>,
    length: f64,
    u: PointSeries<N, T>,
    e: PointSeries<N, T>,
    branch: Branch,
) -> Closed<N, T> {
    let w = p.minus(u);
    let away = e.cross(w);
    let room = -(away * away - length * length);
    let along = w.dot(e) + room.sqrt() * branch.sign();
    let at = u.plus(e.times(along));
    Closed {
        at,
        room: room.0[0],
    }
}

/// The direction of a link that turns about `q` and slides through the block at `p`, its line passing
/// the pivot at the distance `offset` to the left.
#[inline(always)]
pub(crate) fn rpr<const N: usize, T: Number>(
    p: PointSeries<N, T>,
    q: PointSeries<N, T>,
    offset: f64,
    branch: Branch,
) -> Closed<N, T> {
    let w = p.minus(q);
    let s = w.dot(w);
    let room = s - offset * offset;
    let along = room.sqrt() * branch.sign();
    // As complex numbers w = (along + i offset) e.
    let turned = w.times(along).minus(w.left().times(offset));
    let at = turned.times(s.reciprocal());
    Closed {
        at,
        room: room.0[0],
    }
}

/// The joint of two sliders, on the lines through `u` along `e` and through `v` along `f`.
#[inline(always)]
pub(crate) fn prp<const N: usize, T: Number>(
    u: PointSeries<N, T>,
    e: PointSeries<N, T>,
    v: PointSeries<N, T>,
    f: PointSeries<N, T>,
) -> Closed<N, T> {
    let slant = e.cross(f);
    let along = v.minus(u).cross(f) * slant.reciprocal();
    let at = u.plus(e.times(along));
    Closed {
        at,
        room: slant.0[0] * slant.0[0],
    }
}
