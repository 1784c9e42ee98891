use crate::{
    Point,
    curve::{Bounds, Segment, Span},
    numeric::{bracketed_root, maximum},
    region::Outline,
};

impl Outline {
    /// The smallest axis-aligned rectangle around the outline, exact to rounding.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let mut bounds: Bounds = self.segments().iter().map(Segment::start).collect();
        for segment in self.segments() {
            if !bounds.may_grow_by(&Span::whole(segment).bounding_box()) {
                continue;
            }
            // A coordinate has an extreme where the velocity in its direction changes sign.
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

    /// Maximum distance of the outline from a point, mm, exact to rounding.
    #[must_use]
    pub fn maximum_distance(&self, from: Point) -> f64 {
        let corner = |bounds: Bounds| {
            let [low, high] = [bounds.min - from, bounds.max - from].map(|v| v.abs());
            low.x.max(high.x).hypot(low.y.max(high.y))
        };
        let ends = self.segments().iter().map(|s| (s.start() - from).norm());
        let mut farthest = ends.fold(0.0, f64::max);
        let reach = |segment: &Segment| {
            let parts = [-1.0, -0.5, 0.0, 0.5, 1.0];
            let parts = parts
                .windows(2)
                .map(|u| Span::between(segment, [u[0], u[1]]).bounding_box());
            parts.map(corner).fold(0.0, f64::max)
        };
        for segment in self.segments() {
            // First compare one rectangle, then four smaller ones.
            if corner(Span::whole(segment).bounding_box()) > farthest && reach(segment) > farthest {
                let distance = |u: f64| (segment.at(u).point - from).norm();
                farthest = farthest.max(maximum(distance, &[-1.0, 1.0]).value);
            }
        }
        farthest
    }
}

#[cfg(test)]
mod tests {
    use crate::{Point, numeric::Tolerance, region::Outline, test_shapes::rosette};

    #[test]
    fn no_point_is_farther_than_the_maximum_distance() {
        let circle = Outline::circle(Point::new(3.0, 4.0), 5.0);
        assert!((circle.maximum_distance(Point::origin()) - 10.0).abs() < 1e-12);
        let outline = rosette(20.0, 3.0, 7, Tolerance::new(1e-9).expect("positive"));
        let points = outline.flatten(Tolerance::new(1e-6).expect("positive"));
        for from in [[0.0, 0.0], [3.0, -1.0], [40.0, 25.0]].map(Point::from) {
            let near = points.iter().map(|p| (p - from).norm());
            let off = outline.maximum_distance(from) - near.fold(0.0, f64::max);
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
