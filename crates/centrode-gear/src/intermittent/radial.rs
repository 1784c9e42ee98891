use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use centrode_geometry::{Point, Tolerance, Vector};
use nalgebra::Isometry2;

/// Difference of the distances of two points from a chord, as a share of the tolerance, below which they count as equal:
/// rounding.
const ALIKE: f64 = 1e-6;
/// Number of directions in which a contour's radius is stored. Fewer make the contour coarser, more take memory and
/// time.
const DIRECTIONS: usize = 32_768;

/// Unit vectors of the directions.
static UNIT: LazyLock<Vec<Vector>> = LazyLock::new(|| {
    let unit = |index| {
        let (sin, cos) = direction(index).sin_cos();
        Vector::new(cos, sin)
    };
    (0..DIRECTIONS).map(unit).collect()
});

fn direction(index: usize) -> f64 {
    TAU * index as f64 / DIRECTIONS as f64
}

/// Corner of a polygon, and its direction where it is near enough to matter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    at: Vector,
    direction: Option<f64>,
}

impl Corner {
    fn new(at: &Point) -> Self {
        Self::within(at, f64::INFINITY)
    }

    /// The corner, near if within `reach` of the origin.
    fn within(at: &Point, reach: f64) -> Self {
        let near = at.coords.norm_squared() <= reach * reach;
        Self {
            at: at.coords,
            direction: near.then(|| at.y.atan2(at.x)),
        }
    }

    fn is_near(&self) -> bool {
        self.direction.is_some()
    }

    fn direction(&self) -> f64 {
        self.direction.unwrap_or_else(|| self.at.y.atan2(self.at.x))
    }
}

/// Number of corners per chain of a polygon: a chain that is far away is skipped as a whole. It only affects the time.
const CHAIN: usize = 32;

/// Part of a closed polygon: corners one after the other, with the one before them and the one after them.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    corners: Vec<Point>,
    middle: Point,
    radius: f64,
}

impl Chain {
    /// The chains of a closed polygon.
    pub(super) fn new(polygon: &[Point]) -> Vec<Self> {
        let count = polygon.len();
        let chain = |start: usize| {
            let end = (start + CHAIN).min(count);
            let around = start + count - 1..=end + count;
            let corners: Vec<Point> = around.map(|i| polygon[i % count]).collect();
            let sum: Vector = corners.iter().map(|p| p.coords).sum();
            let middle = Point::from(sum / corners.len() as f64);
            let radius = corners.iter().map(|p| (p - middle).norm());
            Self {
                radius: radius.fold(0.0, f64::max),
                corners,
                middle,
            }
        };
        (0..count).step_by(CHAIN).map(chain).collect()
    }

    /// Whether any corner of the placed chain can be within `reach` of the origin.
    pub(super) fn is_near(&self, place: &Isometry2<f64>, reach: f64) -> bool {
        let reach = (reach + self.radius) * (1.0 + 1e-12);
        (place * self.middle).coords.norm_squared() <= reach * reach
    }

    pub(super) fn placed(&self, place: &Isometry2<f64>, reach: f64) -> Vec<Corner> {
        let corner = |p| Corner::within(&(place * p), reach);
        self.corners.iter().map(corner).collect()
    }
}

/// Contour around the origin that every ray from there meets once, given by its radius in equally spaced directions.
///
/// Bodies that pass through it make it smaller: from a blank, a moving mate removes all that it touches.
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
    pub(super) fn new(polygon: &[Point]) -> Self {
        let mut radial = Self::unbounded();
        radial.cut_polygon(polygon);
        radial
    }

    pub(super) fn maximum(&self) -> f64 {
        self.radius.iter().copied().fold(0.0, f64::max)
    }

    /// The radius in the stored direction nearest to a direction.
    pub(super) fn at(&self, direction: f64) -> f64 {
        let index = (direction.rem_euclid(TAU) / TAU * DIRECTIONS as f64).round();
        self.radius[index as usize % DIRECTIONS]
    }

    /// Cuts away everything beyond a circle about any point.
    pub(super) fn cut_circle(&mut self, center: Point, radius: f64) {
        for (unit, kept) in UNIT.iter().zip(&mut self.radius) {
            let along = center.coords.dot(unit);
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
            if (from..=to).contains(&direction(index)) {
                *kept = kept.max(radius);
            }
        }
    }

    /// Cuts away everything beyond a closed polygon.
    pub(super) fn cut_polygon(&mut self, polygon: &[Point]) {
        let corners: Vec<Corner> = polygon.iter().map(Corner::new).collect();
        for (index, from) in corners.iter().enumerate() {
            self.cut(from, &corners[(index + 1) % corners.len()]);
        }
    }

    /// Cuts away everything beyond the region swept by a chain between two poses: its edges and the paths of its
    /// corners. Corners without a direction are skipped, and so are the first and the last.
    pub(super) fn cut_moving(&mut self, before: &[Corner], now: &[Corner]) {
        for (before, now) in before.windows(3).zip(now.windows(3)) {
            if !now[1].is_near() && !before[1].is_near() {
                continue;
            }
            self.cut(&before[1], &now[1]);
            self.cut(&now[1], &now[2]);
            if !now[0].is_near() {
                self.cut(&now[0], &now[1]);
            }
        }
    }

    /// Cuts away everything beyond a segment, seen from the origin.
    fn cut(&mut self, from: &Corner, to: &Corner) {
        let (mut from, mut to) = (from, to);
        if from.at.perp(&to.at) < 0.0 {
            (from, to) = (to, from);
        }
        let start = from.direction();
        let mut end = to.direction();
        if end < start {
            end += TAU;
        }
        // The segment passes through the origin.
        if end - start >= PI {
            return;
        }
        let step = TAU / DIRECTIONS as f64;
        let way = to.at - from.at;
        let moment = from.at.perp(&way);
        for line in (start / step).ceil() as i64..=(end / step).floor() as i64 {
            let index = line.rem_euclid(DIRECTIONS as i64) as usize;
            let radius = moment / UNIT[index].perp(&way);
            if radius > 0.0 && radius < self.radius[index] {
                self.radius[index] = radius;
            }
        }
    }

    /// Corners of a polygon within the tolerance of the contour everywhere, counter-clockwise.
    pub(super) fn polygon(&self, tolerance: Tolerance) -> Vec<Point> {
        let place = |index: usize| {
            let index = index % DIRECTIONS;
            Point::from(UNIT[index] * self.radius[index])
        };
        // Starts at the outermost point, which is a corner of any such polygon.
        let start = (0..DIRECTIONS)
            .max_by(|&a, &b| self.radius[a].total_cmp(&self.radius[b]))
            .unwrap_or(0);
        // Point between two points that is farthest from their chord, the first of equally far ones, and its distance from the
        // chord.
        let farthest = |from: usize, to: usize| {
            let (a, chord) = (place(from), place(to) - place(from));
            let length = chord.norm();
            let off = |index: usize| {
                let way = place(index) - a;
                if length > 0.0 {
                    (chord.perp(&way) / length).abs()
                } else {
                    way.norm()
                }
            };
            (from + 1..to).fold((from, 0.0), |worst, index| {
                let off = off(index);
                match off > worst.1 + ALIKE * tolerance.mm() {
                    true => (index, off),
                    false => worst,
                }
            })
        };
        let mut kept = Vec::new();
        let mut open = vec![
            (start, start + DIRECTIONS / 2),
            (start + DIRECTIONS / 2, start + DIRECTIONS),
        ];
        open.reverse();
        while let Some((from, to)) = open.pop() {
            match farthest(from, to) {
                (middle, off) if off > tolerance.mm() => {
                    open.push((middle, to));
                    open.push((from, middle));
                }
                _ => kept.push(from),
            }
        }
        kept.push(start + DIRECTIONS);
        // A corner is omitted if the chord between its neighbours stays within the tolerance without it.
        let mut corners: Vec<usize> = Vec::new();
        for (index, &corner) in kept.iter().enumerate() {
            let next = kept.get(index + 1);
            let needed = match (corners.last(), next) {
                (Some(&before), Some(&next)) => farthest(before, next).1 > tolerance.mm(),
                _ => true,
            };
            if needed {
                corners.push(corner);
            }
        }
        corners.pop();
        corners.into_iter().map(place).collect()
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
        let radial = Radial::new(&square);
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
        let needle = [[0.0, 0.0], [20.0, 1.0], [20.0, -1.0]].map(Point::from);
        let at = |y: f64| Isometry2::translation(3.0, y);
        // A straight path of the point at x = 3, in coarse steps.
        for step in 0..4 {
            let (before, now) = (at(f64::from(step) - 2.0), at(f64::from(step) - 1.0));
            for chain in Chain::new(&needle) {
                assert!(chain.is_near(&now, 6.0) && !chain.is_near(&at(30.0), 6.0));
                blank.cut_moving(&chain.placed(&before, 6.0), &chain.placed(&now, 6.0));
            }
        }
        for angle in [-0.5, -0.2, 0.1, 0.3, 0.5] {
            let expected = 3.0 / f64::cos(angle);
            assert!((blank.at(angle) - expected).abs() < 2e-3, "{angle}");
        }
        assert!((blank.at(1.0) - 5.0).abs() < 1e-12);
    }
}
