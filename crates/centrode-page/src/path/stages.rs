use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Vector};

/// Steps per turn of each driver.
pub(super) const STEPS: u32 = 360;

/// A stage of gears as it is drawn: both pitch curves at equal steps of the driver's polar angle, computed from the law by
/// differences of fourth order.
pub(super) struct Stage {
    /// Pitch curves of driver and driven gear, each about its own axis.
    pub(super) curves: [Vec<Point>; 2],
    /// Their curvatures, 1/mm; positive where convex.
    curvatures: [Vec<f64>; 2],
    ratio: Vec<f64>,
}

impl Stage {
    /// The stage of a law at equal steps of a turn, both ends included, with a centre distance.
    pub(super) fn new(law: &[f64], distance: f64) -> Self {
        let count = STEPS as usize;
        let step = TAU / f64::from(STEPS);
        let lead: Vec<f64> = (0..count).map(|i| law[i] - step * i as f64).collect();
        let ratio: Vec<f64> = (0..count)
            .map(|i| 1.0 + slope(|k| lead[around(i, k)]) / step)
            .collect();
        let at = |radius: f64, angle: f64| Point::new(radius * angle.cos(), radius * angle.sin());
        let driver = |i: usize| at(distance * ratio[i] / (1.0 + ratio[i]), step * i as f64);
        let driven = |i: usize| at(distance / (1.0 + ratio[i]), PI - law[i]);
        let curves: [Vec<Point>; 2] = [
            (0..count).map(driver).collect(),
            (0..count).map(driven).collect(),
        ];
        // The points of the driven curve follow each other clockwise.
        let curvatures = [(0, 1.0), (1, -1.0)].map(|(k, sense): (usize, f64)| {
            let bent = |i: usize| sense * curvature(&curves[k], i);
            (0..count).map(bent).collect()
        });
        Self {
            curves,
            curvatures,
            ratio,
        }
    }

    /// Ratio, and curvatures of both pitch curves, 1/mm, at a polar angle of the driver.
    pub(super) fn at(&self, polar: f64) -> [f64; 3] {
        let place = polar.rem_euclid(TAU) / TAU * f64::from(STEPS);
        let (before, share) = (place.floor(), place - place.floor());
        let [i, j] = [before as usize, before as usize + 1].map(|i| i % STEPS as usize);
        let [driver, driven] = &self.curvatures;
        [&self.ratio, driver, driven].map(|of| of[i] + share * (of[j] - of[i]))
    }

    /// Maximum radii of both pitch curves, mm.
    pub(super) fn reach(&self) -> [f64; 2] {
        let radius =
            |points: &Vec<Point>| points.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        [radius(&self.curves[0]), radius(&self.curves[1])]
    }
}

/// Index of the point `k` steps after point `i`.
fn around(i: usize, k: i32) -> usize {
    (i as i32 + k).rem_euclid(STEPS as i32) as usize
}

/// Slope per step, from two values on each side.
fn slope(at: impl Fn(i32) -> f64) -> f64 {
    (at(-2) - at(2) + 8.0 * (at(1) - at(-1))) / 12.0
}

fn curvature(points: &[Point], i: usize) -> f64 {
    let at = |k: i32| points[around(i, k)].coords;
    let first: Vector = (at(-2) - at(2) + (at(1) - at(-1)) * 8.0) / 12.0;
    let second: Vector = ((at(1) + at(-1)) * 16.0 - at(2) - at(-2) - at(0) * 30.0) / 12.0;
    first.perp(&second) / first.norm().powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pitch_curves_of_a_law_touch_and_bend_as_they_should() {
        // An ellipse about its focus rolls on an equal one.
        let (eccentricity, distance) = (0.4_f64, 50.0);
        let part = (1.0 - eccentricity) / (1.0 + eccentricity);
        let law: Vec<f64> = (0..=STEPS)
            .map(|i| {
                let half = PI * f64::from(i) / f64::from(STEPS);
                2.0 * (part * half.sin()).atan2(half.cos())
            })
            .collect();
        let stage = Stage::new(&law, distance);
        let half_axis = 0.5 * distance;
        let focal = half_axis * (1.0 - eccentricity * eccentricity);
        for i in [0_usize, 45, 100, 180, 299] {
            let angle = TAU * i as f64 / f64::from(STEPS);
            let radius = stage.curves[0][i].coords.norm();
            let other = stage.curves[1][i].coords.norm();
            assert!((radius + other - distance).abs() < 1e-9);
            // The rolling ellipse has its far focus on the axis where the ratio is smallest.
            let required = focal / (1.0 + eccentricity * angle.cos());
            let mirrored = focal / (1.0 - eccentricity * angle.cos());
            let off = (radius - required).abs().min((radius - mirrored).abs());
            assert!(off < 1e-4, "{radius} at {angle}");
            // Curvature of an ellipse by the distances of both foci: a b / (r1 r2)^(3/2).
            let short = half_axis * (1.0 - eccentricity * eccentricity).sqrt();
            let known = half_axis * short / (radius * (distance - radius)).powf(1.5);
            let [_, driver, driven] = stage.at(angle);
            assert!((driver - known).abs() < 1e-4 * known, "{driver} {known}");
            assert!((driven - known).abs() < 1e-4 * known, "{driven} {known}");
        }
    }
}
