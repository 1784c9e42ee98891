use centrode_geometry::{Jet, Point, Vector};

use crate::formula::{Number, Taylor};

/// A moving point or vector: its coordinates as series of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointSeries<const N: usize, T = f64> {
    pub(crate) x: Taylor<N, T>,
    pub(crate) y: Taylor<N, T>,
}

impl<const N: usize, T: Number> PointSeries<N, T> {
    #[inline(always)]
    pub(crate) fn fixed(point: Point) -> Self {
        Self {
            x: Taylor::constant(T::from(point.x)),
            y: Taylor::constant(T::from(point.y)),
        }
    }

    /// The unit vector at an angle.
    #[inline(always)]
    pub(crate) fn unit(angle: Taylor<N, T>) -> Self {
        let (y, x) = angle.sin_cos();
        Self { x, y }
    }

    /// The unit vector at an angle that is itself the variable: each derivative is a quarter turn ahead of the one before it.
    #[inline(always)]
    pub(crate) fn turning(angle: T) -> Self {
        let (y, x) = angle.sin_cos();
        let (mut x, mut y) = (Taylor::constant(x), Taylor::constant(y));
        for k in 1..N {
            x.0[k] = y.0[k - 1] * T::from(-1.0 / k as f64);
            y.0[k] = x.0[k - 1] * T::from(1.0 / k as f64);
        }
        Self { x, y }
    }

    /// Unit vector in the direction of this one, as a value without derivatives.
    #[inline(always)]
    pub(super) fn unit_now(self) -> PointSeries<1, T> {
        let (x, y) = (self.x.0[0], self.y.0[0]);
        let inverse = T::from(1.0) / (x * x + y * y).sqrt();
        PointSeries {
            x: Taylor([x * inverse]),
            y: Taylor([y * inverse]),
        }
    }

    /// The unit vector in the direction of this one, `angle`.
    #[inline(always)]
    pub(super) fn unit_along(self, angle: Taylor<N, T>) -> Self {
        let now = self.unit_now();
        let (y, x) = angle.sin_cos_from((now.y.0[0], now.x.0[0]));
        Self { x, y }
    }

    /// Motion of one lane.
    #[inline(always)]
    pub(super) fn jet_of(self, lane: usize) -> Jet {
        let (x, y) = (self.x.derivatives(), self.y.derivatives());
        let of = |k: usize| (x[k].lane(lane), y[k].lane(lane));
        let (point, first, second, third) = (of(0), of(1), of(2), of(3));
        Jet {
            point: Point::new(point.0, point.1),
            first: Vector::new(first.0, first.1),
            second: Vector::new(second.0, second.1),
            third: Vector::new(third.0, third.1),
        }
    }

    /// Position of one lane.
    #[inline(always)]
    pub(super) fn value_of(self, lane: usize) -> Point {
        Point::new(self.x.0[0].lane(lane), self.y.0[0].lane(lane))
    }

    #[inline(always)]
    pub(crate) fn plus(self, b: Self) -> Self {
        Self {
            x: self.x + b.x,
            y: self.y + b.y,
        }
    }

    #[inline(always)]
    pub(crate) fn minus(self, b: Self) -> Self {
        Self {
            x: self.x - b.x,
            y: self.y - b.y,
        }
    }

    #[inline(always)]
    pub(crate) fn times<K: Copy>(self, k: K) -> Self
    where
        Taylor<N, T>: std::ops::Mul<K, Output = Taylor<N, T>>,
    {
        Self {
            x: self.x * k,
            y: self.y * k,
        }
    }

    #[inline(always)]
    pub(crate) fn dot(self, b: Self) -> Taylor<N, T> {
        self.x * b.x + self.y * b.y
    }

    /// Cross product, positive where `b` lies to the left of this vector.
    #[inline(always)]
    pub(crate) fn cross(self, b: Self) -> Taylor<N, T> {
        self.x * b.y - self.y * b.x
    }

    /// Vector turned a quarter turn counter-clockwise.
    #[inline(always)]
    pub(crate) fn left(self) -> Self {
        Self {
            x: -self.y,
            y: self.x,
        }
    }

    /// Vector `v`, whose components are along this unit vector and to its left, in the axes in which this unit vector is given.
    #[inline(always)]
    pub(crate) fn turned(self, v: Vector) -> Self {
        self.times(v.x).plus(self.left().times(v.y))
    }

    /// Vector turned by the angle of a unit vector: the product of complex numbers.
    #[inline(always)]
    pub(crate) fn times_unit(self, unit: Self) -> Self {
        self.times(unit.x).plus(self.left().times(unit.y))
    }

    /// The direction of this vector, principal value.
    #[inline(always)]
    pub(crate) fn angle(self) -> Taylor<N, T> {
        self.y.atan2(self.x)
    }
}

impl<const N: usize> PointSeries<N> {
    #[inline(always)]
    pub(crate) fn value(self) -> Point {
        self.value_of(0)
    }

    #[inline(always)]
    pub(crate) fn jet(self) -> Jet {
        self.jet_of(0)
    }
}
