use crate::{Outline, Point, Segment, bracketed_root, greatest};

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

    /// The smallest rectangle that also holds `point`.
    #[must_use]
    pub fn with(self, point: Point) -> Self {
        Self {
            min: self.min.inf(&point),
            max: self.max.sup(&point),
        }
    }

    /// The smallest rectangle that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.inf(&other.min),
            max: self.max.sup(&other.max),
        }
    }

    /// The middle.
    #[must_use]
    pub fn center(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Length of the diagonal, mm.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        (self.max - self.min).norm()
    }

    /// Whether the two have a point in common; never where a coordinate is not a number.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Whether some point of the rectangle has a coordinate beyond those of `self`.
    fn may_grow_by(&self, other: &Self) -> bool {
        other.min.x < self.min.x
            || other.min.y < self.min.y
            || other.max.x > self.max.x
            || other.max.y > self.max.y
    }
}

/// The smallest rectangle that holds some points.
impl FromIterator<Point> for Bounds {
    fn from_iter<I: IntoIterator<Item = Point>>(points: I) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }
}

impl Segment {
    /// A rectangle around the part between two parameters, not always the smallest.
    pub(crate) fn enclosure(&self, u0: f64, u1: f64) -> Bounds {
        match self {
            Self::Line(..) => Bounds::EMPTY
                .with(self.at(u0).point)
                .with(self.at(u1).point),
            Self::Arc(_) => {
                let (start, end) = (self.at(u0), self.at(u1));
                let length = start.first.norm() * (u1 - u0);
                let turned = start.second.norm() / start.first.norm() * (u1 - u0);
                let sagitta = (length * turned / 8.0).min(0.5 * length);
                let ends = Bounds::EMPTY.with(start.point).with(end.point);
                grown(ends, sagitta, sagitta)
            }
            Self::Poly(poly) => {
                let part = poly.part(u0, u1);
                let c = part.coefficients();
                let ends = Bounds::EMPTY
                    .with(part.at(-1.0).point)
                    .with(part.at(1.0).point);
                // Each even power is at most one below its value at the ends, each odd one may double
                // back between them.
                let reach = |axis: usize| {
                    let curved: f64 = c.iter().skip(2).map(|c| c[axis].abs()).sum();
                    2.0 * curved
                };
                grown(ends, reach(0), reach(1))
            }
        }
    }
}

fn grown(bounds: Bounds, x: f64, y: f64) -> Bounds {
    let margin = crate::Vector::new(x, y);
    Bounds {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}

impl Outline {
    /// The smallest axis-aligned rectangle around the outline, exact to rounding.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let mut bounds: Bounds = self.segments().iter().map(Segment::start).collect();
        for segment in self.segments() {
            if !bounds.may_grow_by(&segment.enclosure(-1.0, 1.0)) {
                continue;
            }
            // Extremes lie where a coordinate of the velocity changes sign.
            let cells = 24;
            let mut before = (-1.0, segment.at(-1.0).first);
            for i in 1..=cells {
                let u = -1.0 + 2.0 * f64::from(i) / f64::from(cells);
                let velocity = segment.at(u).first;
                for axis in 0..2 {
                    let (low, high) = (before.1[axis], velocity[axis]);
                    if (low > 0.0) != (high > 0.0) {
                        let root =
                            bracketed_root(|u| segment.at(u).first[axis], before.0, u, low, high);
                        bounds = bounds.with(segment.at(root).point);
                    }
                }
                before = (u, velocity);
            }
        }
        bounds
    }

    /// Distance of the farthest point of the outline from a place, exact to rounding.
    #[must_use]
    pub fn farthest(&self, from: Point) -> f64 {
        let corner = |bounds: Bounds| {
            let [low, high] = [bounds.min - from, bounds.max - from].map(|v| v.abs());
            low.x.max(high.x).hypot(low.y.max(high.y))
        };
        let ends = self.segments().iter().map(|s| (s.start() - from).norm());
        let mut farthest = ends.fold(0.0, f64::max);
        let reach = |segment: &Segment| {
            let parts = [-1.0, -0.5, 0.0, 0.5, 1.0];
            let parts = parts.windows(2).map(|u| segment.enclosure(u[0], u[1]));
            parts.map(corner).fold(0.0, f64::max)
        };
        for segment in self.segments() {
            // First by one rectangle, then by closer ones.
            if corner(segment.enclosure(-1.0, 1.0)) > farthest && reach(segment) > farthest {
                let far = |u: f64| (segment.at(u).point - from).norm();
                farthest = farthest.max(greatest(far, &[-1.0, 1.0]).value);
            }
        }
        farthest
    }
}

#[cfg(test)]
mod tests {
    use crate::{Outline, Point, Tolerance, shapes::rosette};

    #[test]
    fn no_point_is_farther_than_the_farthest() {
        let circle = Outline::circle(Point::new(3.0, 4.0), 5.0);
        assert!((circle.farthest(Point::origin()) - 10.0).abs() < 1e-12);
        let outline = rosette(20.0, 3.0, 7, Tolerance::new(1e-9).expect("positive"));
        let points = outline.flatten(Tolerance::new(1e-6).expect("positive"));
        for from in [[0.0, 0.0], [3.0, -1.0], [40.0, 25.0]].map(Point::from) {
            let near = points.iter().map(|p| (p - from).norm());
            let off = outline.farthest(from) - near.fold(0.0, f64::max);
            assert!((0.0..2e-6).contains(&off), "{from}: {off}");
        }
    }

    #[test]
    fn bounds_touch_the_extremes() {
        let circle = Outline::circle(Point::new(3.0, 4.0), 5.0);
        let bounds = circle.bounds();
        assert!((bounds.min - Point::new(-2.0, -1.0)).norm() < 1e-12);
        assert!((bounds.max - Point::new(8.0, 9.0)).norm() < 1e-12);
        let outline = rosette(20.0, 3.0, 7, Tolerance::new(1e-9).expect("positive"));
        let bounds = outline.bounds();
        let points = outline.flatten(Tolerance::new(1e-6).expect("positive"));
        let low = points
            .iter()
            .fold([f64::INFINITY; 2], |m, p| [m[0].min(p.x), m[1].min(p.y)]);
        let high = points
            .iter()
            .fold([-f64::INFINITY; 2], |m, p| [m[0].max(p.x), m[1].max(p.y)]);
        for axis in 0..2 {
            assert!((0.0..2e-6).contains(&(low[axis] - bounds.min[axis])));
            assert!((0.0..2e-6).contains(&(bounds.max[axis] - high[axis])));
        }
    }
}
