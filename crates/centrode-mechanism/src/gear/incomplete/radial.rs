use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Tolerance};

/// Directions in which a contour's radius is kept.
const DIRECTIONS: usize = 32_768;

/// Contour around the origin that every ray from there meets once, by its radius in even directions.
///
/// Made smaller by what passes through it: a blank from which a moving mate takes all it touches.
#[derive(Clone, Debug)]
pub(super) struct Radial {
    radius: Vec<f64>,
}

impl Radial {
    /// Unbounded contour, to be cut.
    pub(super) fn unbounded() -> Self {
        Self {
            radius: vec![f64::INFINITY; DIRECTIONS],
        }
    }

    /// Contour of a closed polygon around the origin.
    pub(super) fn of(polygon: &[Point]) -> Self {
        let mut radial = Self::unbounded();
        radial.cut_polygon(polygon);
        radial
    }

    fn direction(index: usize) -> f64 {
        TAU * index as f64 / DIRECTIONS as f64
    }

    pub(super) fn greatest(&self) -> f64 {
        self.radius.iter().copied().fold(0.0, f64::max)
    }

    /// The radius in a direction, of the nearest kept one.
    pub(super) fn at(&self, direction: f64) -> f64 {
        let index = (direction.rem_euclid(TAU) / TAU * DIRECTIONS as f64).round();
        self.radius[index as usize % DIRECTIONS]
    }

    /// Cuts away everything beyond a circle about any point.
    pub(super) fn cut_circle(&mut self, center: Point, radius: f64) {
        for (index, kept) in self.radius.iter_mut().enumerate() {
            let (sin, cos) = Self::direction(index).sin_cos();
            let along = center.x * cos + center.y * sin;
            let room = along * along - center.coords.norm_squared() + radius * radius;
            if room >= 0.0 {
                let near = along - room.sqrt();
                if near > 0.0 {
                    *kept = kept.min(near);
                }
            }
        }
    }

    /// Cuts away everything beyond a circle about the origin.
    pub(super) fn limit(&mut self, radius: f64) {
        for kept in &mut self.radius {
            *kept = kept.min(radius);
        }
    }

    /// Fills a circle about the origin between two directions.
    pub(super) fn fill(&mut self, from: f64, to: f64, radius: f64) {
        for (index, kept) in self.radius.iter_mut().enumerate() {
            if (from..=to).contains(&Self::direction(index)) {
                *kept = kept.max(radius);
            }
        }
    }

    /// Cuts away everything beyond a closed polygon.
    pub(super) fn cut_polygon(&mut self, polygon: &[Point]) {
        for (index, &from) in polygon.iter().enumerate() {
            self.cut(from, polygon[(index + 1) % polygon.len()]);
        }
    }

    /// Cuts away everything beyond the region swept by a polygon between two poses: its edges and the paths of its
    /// corners. Corners beyond `reach` are skipped.
    pub(super) fn cut_moving(&mut self, before: &[Point], now: &[Point], reach: f64) {
        let near = |p: &Point| p.coords.norm_squared() <= reach * reach;
        let count = now.len();
        for index in 0..count {
            if !near(&now[index]) && !near(&before[index]) {
                continue;
            }
            self.cut(before[index], now[index]);
            self.cut(now[index], now[(index + 1) % count]);
            if !near(&now[(index + count - 1) % count]) {
                self.cut(now[(index + count - 1) % count], now[index]);
            }
        }
    }

    /// Cuts away everything beyond a segment, seen from the origin.
    fn cut(&mut self, from: Point, to: Point) {
        let (mut from, mut to) = (from.coords, to.coords);
        let mut turn = from.perp(&to).atan2(from.dot(&to));
        if turn < 0.0 {
            (from, to) = (to, from);
            turn = -turn;
        }
        // Seen edge-on, or from the origin itself.
        if turn >= PI {
            return;
        }
        let step = TAU / DIRECTIONS as f64;
        let start = from.y.atan2(from.x);
        let first = (start / step).ceil() as i64;
        let last = ((start + turn) / step).floor() as i64;
        let way = to - from;
        let moment = from.perp(&way);
        for line in first..=last {
            let index = line.rem_euclid(DIRECTIONS as i64) as usize;
            let (sin, cos) = Self::direction(index).sin_cos();
            let across = cos * way.y - sin * way.x;
            let radius = moment / across;
            if radius > 0.0 && radius < self.radius[index] {
                self.radius[index] = radius;
            }
        }
    }

    /// Corners of a polygon nowhere farther from the contour than the tolerance, counter-clockwise.
    pub(super) fn polygon(&self, tolerance: Tolerance) -> Vec<Point> {
        let place = |index: usize| {
            let (sin, cos) = Self::direction(index % DIRECTIONS).sin_cos();
            let radius = self.radius[index % DIRECTIONS];
            Point::new(radius * cos, radius * sin)
        };
        // From the outermost point, which is a corner of any such polygon.
        let start = (0..DIRECTIONS)
            .max_by(|&a, &b| self.radius[a].total_cmp(&self.radius[b]))
            .unwrap_or(0);
        let mut kept = Vec::new();
        let mut open = vec![
            (start, start + DIRECTIONS / 2),
            (start + DIRECTIONS / 2, start + DIRECTIONS),
        ];
        open.reverse();
        while let Some((from, to)) = open.pop() {
            let (a, b) = (place(from), place(to));
            let chord = b - a;
            let length = chord.norm();
            let off = |index: usize| {
                let way = place(index) - a;
                if length > 0.0 {
                    (chord.perp(&way) / length).abs()
                } else {
                    way.norm()
                }
            };
            let worst = (from + 1..to).max_by(|&i, &j| off(i).total_cmp(&off(j)));
            match worst {
                Some(middle) if off(middle) > tolerance.mm() => {
                    open.push((middle, to));
                    open.push((from, middle));
                }
                _ => kept.push(a),
            }
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    #[test]
    fn a_polygon_is_kept_and_a_circle_cut_out_of_it() {
        let square = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]].map(Point::from);
        let radial = Radial::of(&square);
        assert!((radial.at(0.0) - 2.0).abs() < 1e-12);
        assert!((radial.at(PI / 4.0) - 8.0_f64.sqrt()).abs() < 1e-12);
        let back = radial.polygon(tolerance(1e-3));
        assert_eq!(back.len(), 4, "{back:?}");
        let mut notched = radial.clone();
        notched.cut_circle(Point::new(3.0, 0.0), 1.5);
        assert!((notched.at(0.0) - 1.5).abs() < 1e-12);
        assert!((notched.at(PI) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_corner_cuts_along_its_way() {
        let mut blank = Radial::unbounded();
        blank.limit(5.0);
        let needle =
            |x: f64, y: f64| [[x, y], [x + 20.0, y + 1.0], [x + 20.0, y - 1.0]].map(Point::from);
        // A straight way of the point at x = 3, in coarse steps.
        let mut before = needle(3.0, -2.0);
        for step in 1..=4 {
            let now = needle(3.0, -2.0 + f64::from(step));
            blank.cut_moving(&before, &now, 6.0);
            before = now;
        }
        for angle in [-0.5, -0.2, 0.1, 0.3, 0.5] {
            let expected = 3.0 / f64::cos(angle);
            assert!((blank.at(angle) - expected).abs() < 2e-3, "{angle}");
        }
        assert!((blank.at(1.0) - 5.0).abs() < 1e-12);
    }
}
