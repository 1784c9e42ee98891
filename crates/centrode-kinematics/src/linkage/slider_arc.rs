use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Vector, bracketed_root};

use super::four_bar::FourBar;
use super::six_bar::EffectorExtremes;

/// The arc about D on which the slider runs.
pub(super) struct SliderArc {
    center: Point,
    radius: f64,
    /// Rocker angle and crank angle at the two ends, the smaller rocker angle first.
    ends: [(f64, f64); 2],
    four_bar: FourBar,
}

impl SliderArc {
    pub(super) fn new(four_bar: &FourBar) -> Option<Self> {
        let dead = four_bar.dead_centers()?;
        let mut ends =
            [dead.stretched, dead.folded].map(|phi| (four_bar.unwrapped_rocker(phi), phi));
        if ends[0].0 > ends[1].0 {
            ends.reverse();
        }
        // Both rocker angles are unwrapped at crank angles in [0, 2 pi), where they have no jump.
        let [_, _, radius, frame] = four_bar.lengths();
        Some(Self {
            center: Point::new(frame, 0.0),
            radius,
            ends,
            four_bar: *four_bar,
        })
    }

    fn at(&self, rocker: f64) -> Point {
        self.center + self.radius * Vector::new(rocker.cos(), rocker.sin())
    }

    pub(super) fn ends(&self) -> [Point; 2] {
        self.ends.map(|(rocker, _)| self.at(rocker))
    }

    /// Rocker angle, shifted by whole turns into the arc's range; `None` if it lies outside.
    fn within(&self, rocker: f64) -> Option<f64> {
        let [low, high] = self.ends.map(|e| e.0);
        let angle = low + (rocker - low).rem_euclid(TAU);
        (angle <= high).then_some(angle)
    }

    pub(super) fn distance(&self, from: Point) -> f64 {
        let way = from - self.center;
        if self.within(way.y.atan2(way.x)).is_some() {
            return (way.norm() - self.radius).abs();
        }
        let [a, b] = self.ends();
        (a - from).norm().min((b - from).norm())
    }

    pub(super) fn farthest(&self, from: Point) -> f64 {
        let way = self.center - from;
        if self.within(way.y.atan2(way.x)).is_some() {
            return way.norm() + self.radius;
        }
        let [a, b] = self.ends();
        (a - from).norm().max((b - from).norm())
    }

    /// Direction from `from` to the arc's point at a rocker angle, without jumps along the arc.
    ///
    /// With w the vector from `from` to D as a complex number and r the arc's radius it is
    /// arg(w + r e^(i theta)), taken as theta + arg(1 + w/r e^(-i theta)) inside the circle and as
    /// arg w + arg(1 + r/w e^(i theta)) outside, where the second term never leaves (-pi/2, pi/2).
    fn direction(&self, from: Point, rocker: f64) -> f64 {
        let w = self.center - from;
        let (sin, cos) = rocker.sin_cos();
        let (r, s) = (self.radius, w.norm_squared());
        if s <= r * r {
            let turned = (w.x * cos + w.y * sin, w.y * cos - w.x * sin);
            rocker + turned.1.atan2(r + turned.0)
        } else {
            let turned = (w.x * cos + w.y * sin, w.x * sin - w.y * cos);
            w.y.atan2(w.x) + (r * turned.1).atan2(s + r * turned.0)
        }
    }

    /// Crank angle at which the slider is at a rocker angle.
    fn crank(&self, rocker: f64) -> f64 {
        for (end, crank) in self.ends {
            if rocker == end {
                return crank;
            }
        }
        let [a, b, _, _] = self.four_bar.lengths();
        let c = self.at(rocker);
        let reach = c.coords.norm();
        let cosine = (a * a + reach * reach - b * b) / (2.0 * a * reach);
        (c.y.atan2(c.x) + cosine.clamp(-1.0, 1.0).acos()).rem_euclid(TAU)
    }

    pub(super) fn extremes(&self, from: Point) -> EffectorExtremes {
        let mut rockers: Vec<f64> = self.ends.iter().map(|e| e.0).collect();
        let way = from - self.center;
        let distance = way.norm();
        if distance > self.radius {
            // The tangents from outside touch where the radius is square to them.
            let (towards, half) = (way.y.atan2(way.x), (self.radius / distance).acos());
            let touching = [towards + half, towards - half];
            rockers.extend(touching.into_iter().filter_map(|t| self.within(t)));
        }
        let end = |rocker: f64| (self.crank(rocker), self.direction(from, rocker));
        let first = end(rockers[0]);
        let mut extremes = EffectorExtremes {
            low: first,
            high: first,
        };
        for &rocker in &rockers[1..] {
            let here = end(rocker);
            if here.1 < extremes.low.1 {
                extremes.low = here;
            }
            if here.1 > extremes.high.1 {
                extremes.high = here;
            }
        }
        extremes
    }

    fn swing(&self, from: Point) -> f64 {
        let extremes = self.extremes(from);
        extremes.high.1 - extremes.low.1
    }

    /// The unit vector square to the chord, towards the arc.
    pub(super) fn outwards(&self, middle: Point, chord: Vector) -> Vector {
        let across = Vector::new(-chord.y, chord.x).normalize();
        let half = 0.5 * (self.ends[0].0 + self.ends[1].0);
        across * across.dot(&(self.at(half) - middle)).signum()
    }

    /// Point on a ray from the chord's middle at which the arc subtends the angle `swing`.
    pub(super) fn seen_at(&self, middle: Point, ray: Vector, swing: f64) -> Option<Point> {
        // Distance along the ray to the point where it leaves the circle.
        let way = middle - self.center;
        let along = way.dot(&ray);
        let to_circle =
            -along + (along * along + self.radius * self.radius - way.norm_squared()).sqrt();
        let crossing = middle + ray * to_circle - self.center;
        let crosses = self.within(crossing.y.atan2(crossing.x)).is_some();
        let off = |t: f64| self.swing(middle + ray * t) - swing;
        let small = 1e-12 * self.radius;
        let (low, high) = match (swing > PI, crosses) {
            (true, true) => (small, to_circle * (1.0 - 1e-12)),
            (true, false) => return None,
            (false, true) => {
                let mut far = 2.0 * to_circle;
                while off(far) > 0.0 && far < 1e9 * self.radius {
                    far *= 2.0;
                }
                (to_circle * (1.0 + 1e-12), far)
            }
            (false, false) => {
                let mut far = self.radius;
                while off(far) > 0.0 && far < 1e9 * self.radius {
                    far *= 2.0;
                }
                (small, far)
            }
        };
        let (at_low, at_high) = (off(low), off(high));
        if at_low * at_high > 0.0 {
            return None;
        }
        Some(middle + ray * bracketed_root(off, low, high, at_low, at_high))
    }
}
