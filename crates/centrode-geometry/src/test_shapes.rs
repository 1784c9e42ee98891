//! Outlines shared by the tests.

use crate::{
    Point, Vector,
    curve::{PolySegment, Segment},
    numeric::Tolerance,
    region::Outline,
};
use std::f64::consts::TAU;

/// Closes a chain of polynomial segments by rounding only.
fn closed(mut polys: Vec<PolySegment>) -> Outline {
    let first = polys[0].start();
    let mut end = first;
    for poly in polys.iter_mut().rev() {
        if poly.end() != end {
            *poly = poly.pinned(poly.start(), end);
        }
        end = poly.start();
    }
    Outline::new(polys.into_iter().map(Segment::from).collect()).expect("closed")
}

/// A smooth closed curve `r = radius + wave cos(lobes t)`.
pub(crate) fn rosette(radius: f64, wave: f64, lobes: u32, tolerance: Tolerance) -> Outline {
    let curve = |t: f64| {
        Point::from(Vector::new(t.cos(), t.sin()) * (radius + wave * (f64::from(lobes) * t).cos()))
    };
    closed(PolySegment::fit(curve, 0.0, TAU, tolerance))
}

/// A ring of involute teeth cut by a rack with rounded tips: two corners per tooth, smooth in between.
pub(crate) fn tooth_ring(teeth: u32, module: f64, tolerance: Tolerance) -> Outline {
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let r = 0.5 * module * f64::from(teeth);
    let (tip, depth, rho) = (r + module, 1.25 * module, 0.38 * module);
    let center = depth - rho;
    let quarter = 0.25 * std::f64::consts::PI * module;
    let side = quarter - center * sin / cos - rho / cos;
    // The rack moves by r a while the ring turns by a; its tip circle and flank are met where their
    // normals pass the rolling point (r, 0).
    let turned = |a: f64, p: Point| nalgebra::Rotation2::new(-a) * p;
    let fillet = |a: f64| {
        let v = Vector::new(-center, side + r * a);
        turned(a, Point::new(r, 0.0) + v + v.normalize() * rho)
    };
    let flank = |a: f64| {
        let reach = (quarter + r * a) * cos;
        turned(a, Point::new(r, 0.0) + Vector::new(-sin, cos) * reach)
    };
    let (lowest, joint) = (-side / r, (center * cos / sin - side) / r);
    let reach = r * sin - (r * r * sin * sin + tip * tip - r * r).sqrt();
    let highest = (reach / cos - quarter) / r;
    let (root_angle, corner) = (side / r, flank(highest));
    let tip_angle = corner.y.atan2(corner.x);
    let next = TAU / f64::from(teeth);
    let mut polys = Vec::new();
    for tooth in 0..teeth {
        let turn = nalgebra::Rotation2::new(next * f64::from(tooth));
        let mirrored = |p: Point| turn * Point::new(p.x, -p.y);
        let circle =
            |radius: f64| move |a: f64| turn * Point::new(radius * a.cos(), radius * a.sin());
        polys.extend(PolySegment::fit(
            |a| mirrored(flank(a)),
            highest,
            joint,
            tolerance,
        ));
        polys.extend(PolySegment::fit(
            |a| mirrored(fillet(a)),
            joint,
            lowest,
            tolerance,
        ));
        polys.extend(PolySegment::fit(
            circle(r - depth),
            -root_angle,
            root_angle,
            tolerance,
        ));
        polys.extend(PolySegment::fit(
            |a| turn * fillet(a),
            lowest,
            joint,
            tolerance,
        ));
        polys.extend(PolySegment::fit(
            |a| turn * flank(a),
            joint,
            highest,
            tolerance,
        ));
        polys.extend(PolySegment::fit(
            circle(tip),
            tip_angle,
            next - tip_angle,
            tolerance,
        ));
    }
    // Neighbours computed by different formulas differ by rounding.
    for i in 1..polys.len() {
        let start = polys[i - 1].end();
        assert!((polys[i].start() - start).norm() < 1e-9, "parts {i} meet");
        polys[i] = polys[i].pinned(start, polys[i].end());
    }
    closed(polys)
}
