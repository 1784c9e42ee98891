//! Outlines the tests share.

use crate::{Outline, Point, Segment, Spline, Tolerance, Vector};
use std::f64::consts::TAU;

/// Closes a chain of splines by rounding only.
fn closed(mut splines: Vec<Spline>) -> Outline {
    let first = splines[0].start();
    let mut end = first;
    for spline in splines.iter_mut().rev() {
        if spline.end() != end {
            *spline = spline.pinned(spline.start(), end);
        }
        end = spline.start();
    }
    Outline::new(splines.into_iter().map(Segment::from).collect()).expect("closed")
}

/// A smooth closed curve `r = radius + wave cos(lobes t)`.
pub(crate) fn rosette(radius: f64, wave: f64, lobes: u32, tolerance: Tolerance) -> Outline {
    let curve = |t: f64| {
        Point::from(Vector::new(t.cos(), t.sin()) * (radius + wave * (f64::from(lobes) * t).cos()))
    };
    closed(Spline::fit(curve, 0.0, TAU, tolerance))
}

/// A ring of involute flanks with rounded roots and sharp tips: two corners a tooth.
pub(crate) fn tooth_ring(teeth: u32, module: f64, tolerance: Tolerance) -> Outline {
    let alpha = 20_f64.to_radians();
    let pitch_radius = 0.5 * module * f64::from(teeth);
    let base = pitch_radius * alpha.cos();
    let tip = pitch_radius + module;
    let turn = |angle: f64, p: Point| nalgebra::Rotation2::new(angle) * p;
    let involute = |roll: f64| {
        Point::from(
            base * Vector::new(
                roll.cos() + roll * roll.sin(),
                roll.sin() - roll * roll.cos(),
            ),
        )
    };
    let roll_tip = ((tip / base).powi(2) - 1.0).sqrt();
    let roll_low = 0.1;
    let half = TAU / f64::from(4 * teeth) + alpha.tan() - alpha;
    let mut splines = Vec::new();
    for tooth in 0..teeth {
        let middle = TAU * f64::from(tooth) / f64::from(teeth);
        let right = |roll: f64| turn(middle - half, involute(roll));
        let left = |roll: f64| {
            let p = involute(roll);
            turn(middle + half, Point::new(p.x, -p.y))
        };
        let next = TAU / f64::from(teeth);
        splines.extend(Spline::fit(right, roll_low, roll_tip, tolerance));
        let tips = [right(roll_tip), left(roll_tip)].map(|p| p.y.atan2(p.x));
        let span = (tips[1] - tips[0]).rem_euclid(TAU);
        splines.extend(Spline::fit(
            |a| Point::new(tip * a.cos(), tip * a.sin()),
            tips[0],
            tips[0] + span,
            tolerance,
        ));
        splines.extend(Spline::fit(left, roll_tip, roll_low, tolerance));
        // The root: a cubic Hermite curve with the flanks' tangents, so the joints are smooth.
        let start = left(roll_low);
        let end = turn(next, right(roll_low));
        let inward = |p: Point, q: Point| (p - q).normalize() * module * 2.5;
        let leave = inward(left(roll_low), left(roll_low + 1e-7));
        let arrive = -inward(right(roll_low), right(roll_low + 1e-7));
        let arrive = nalgebra::Rotation2::new(next) * arrive;
        let hermite = |t: f64| {
            let s = 1.0 - t;
            Point::from(
                start.coords * (s * s * (1.0 + 2.0 * t))
                    + end.coords * (t * t * (1.0 + 2.0 * s))
                    + leave * (t * s * s)
                    - arrive * (t * t * s),
            )
        };
        splines.extend(Spline::fit(hermite, 0.0, 1.0, tolerance));
    }
    // Neighbours computed by different formulas differ by rounding.
    for i in 1..splines.len() {
        let start = splines[i - 1].end();
        assert!((splines[i].start() - start).norm() < 1e-9, "parts {i} meet");
        splines[i] = splines[i].pinned(start, splines[i].end());
    }
    closed(splines)
}
