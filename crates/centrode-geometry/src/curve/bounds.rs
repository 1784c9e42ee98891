use crate::Point;

/// The smallest axis-aligned rectangle around a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Bounds {
    /// The empty rectangle: the neutral element of [`with`](Self::with).
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest rectangle that contains `self` and `point`.
    #[must_use]
    pub fn with(self, point: Point) -> Self {
        Self {
            min: self.min.inf(&point),
            max: self.max.sup(&point),
        }
    }

    /// The smallest rectangle that contains both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.inf(&other.min),
            max: self.max.sup(&other.max),
        }
    }

    /// Its center.
    #[must_use]
    pub fn center(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Length of the diagonal, mm.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        (self.max - self.min).norm()
    }

    /// Whether the two rectangles have a common point; false if a coordinate is not a number.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Whether a point of `other` may lie outside `self`.
    pub(crate) fn may_grow_by(&self, other: &Self) -> bool {
        other.min.x < self.min.x
            || other.min.y < self.min.y
            || other.max.x > self.max.x
            || other.max.y > self.max.y
    }
}

/// The smallest rectangle that contains all points.
impl FromIterator<Point> for Bounds {
    fn from_iter<I: IntoIterator<Item = Point>>(points: I) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }
}
