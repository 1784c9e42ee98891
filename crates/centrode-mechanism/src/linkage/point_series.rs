use centrode_geometry::{Jet, Point, Vector};

use crate::formula::Taylor;

/// A moving point or vector: its coordinates as series of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointSeries<const N: usize> {
    pub(crate) x: Taylor<N>,
    pub(crate) y: Taylor<N>,
}

impl<const N: usize> PointSeries<N> {
    pub(crate) fn fixed(point: Point) -> Self {
        Self {
            x: Taylor::constant(point.x),
            y: Taylor::constant(point.y),
        }
    }

    /// The unit vector at an angle.
    pub(crate) fn unit(angle: Taylor<N>) -> Self {
        let (y, x) = angle.sin_cos();
        Self { x, y }
    }

    pub(crate) fn plus(self, b: Self) -> Self {
        Self {
            x: self.x + b.x,
            y: self.y + b.y,
        }
    }

    pub(crate) fn minus(self, b: Self) -> Self {
        Self {
            x: self.x - b.x,
            y: self.y - b.y,
        }
    }

    pub(crate) fn times<K: Copy>(self, k: K) -> Self
    where
        Taylor<N>: std::ops::Mul<K, Output = Taylor<N>>,
    {
        Self {
            x: self.x * k,
            y: self.y * k,
        }
    }

    pub(crate) fn dot(self, b: Self) -> Taylor<N> {
        self.x * b.x + self.y * b.y
    }

    /// Positive where `b` lies to the left of this vector.
    pub(crate) fn cross(self, b: Self) -> Taylor<N> {
        self.x * b.y - self.y * b.x
    }

    /// Turned a quarter turn counter-clockwise.
    pub(crate) fn left(self) -> Self {
        Self {
            x: -self.y,
            y: self.x,
        }
    }

    /// `v` in the frame whose first axis is this unit vector, brought into the frame of this vector.
    pub(crate) fn turned(self, v: Vector) -> Self {
        self.times(v.x).plus(self.left().times(v.y))
    }

    /// The direction of this vector, principal value.
    pub(crate) fn angle(self) -> Taylor<N> {
        self.y.atan2(self.x)
    }

    pub(crate) fn value(self) -> Point {
        Point::new(self.x.0[0], self.y.0[0])
    }

    pub(crate) fn jet(self) -> Jet {
        let (x, y) = (self.x.derivatives(), self.y.derivatives());
        Jet {
            point: Point::new(x[0], y[0]),
            first: Vector::new(x[1], y[1]),
            second: Vector::new(x[2], y[2]),
            third: Vector::new(x[3], y[3]),
        }
    }
}
