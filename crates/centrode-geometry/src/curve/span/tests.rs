use super::*;
use crate::{
    curve::{Arc, PolySegment},
    numeric::Tolerance,
};

#[test]
fn the_bounds_hold_every_stretch_and_tighten_with_it() {
    let spiral = |t: f64| Point::new((1.0 + t * t) * t.cos(), (1.0 + t * t) * t.sin());
    let fine = Tolerance::new(1e-9).expect("positive");
    let mut segments: Vec<Segment> = PolySegment::fit(spiral, -0.9, 0.8, fine)
        .into_iter()
        .map(Segment::from)
        .collect();
    segments.push(Segment::Arc(Arc {
        start: Point::new(3.0, 1.0),
        end: Point::new(2.0, 2.0),
        bulge: -0.4,
    }));
    for segment in &segments {
        for u in [[-1.0, 1.0], [-1.0, -0.5], [0.2, 0.7], [0.5, 0.501]] {
            let [u0, u1] = u;
            let span = SpanBounds::new(segment, u);
            let start = segment.at(u0);
            let chord = segment.at(u1).point - start.point;
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let axis = Point::new(1.3, 0.4);
            let (lower, upper) = segment.lever_range(u, axis);
            let (mut min_lever, mut max_lever) = (f64::INFINITY, f64::NEG_INFINITY);
            for i in 0..=200 {
                let jet = segment.at(u0 + (u1 - u0) * f64::from(i) / 200.0);
                let k = jet.first.perp(&jet.second) / jet.first.norm().powi(3);
                (low, high) = (low.min(k), high.max(k));
                let lever = (jet.point - axis).dot(&jet.first) / jet.first.norm();
                assert!(
                    lower - 1e-12 <= lever && lever <= upper + 1e-12,
                    "{lower} {lever} {upper}"
                );
                (min_lever, max_lever) = (min_lever.min(lever), max_lever.max(lever));
                let slope = chord.perp(&jet.first) / chord.dot(&jet.first);
                assert!(span.slopes.0 - 1e-9 <= slope && slope <= span.slopes.1 + 1e-9);
                let off = chord.perp(&(jet.point - start.point)).abs() / chord.norm();
                assert!(off <= span.sagitta * (1.0 + 1e-9) + 1e-14);
            }
            let (minimum, maximum) = segment.curvature_range(u);
            assert!(
                minimum <= low + 1e-6 && high - 1e-6 <= maximum,
                "{minimum} {low} {high} {maximum}"
            );
            if u1 - u0 < 0.01 {
                let width = max_lever - min_lever;
                assert!(
                    upper - lower < 1.1 * width + 1e-6,
                    "{lower} {upper} {width}"
                );
                assert!(
                    maximum - minimum < 2.0 * (high - low) + 1e-2,
                    "{minimum} {low} {high} {maximum}"
                );
            }
        }
    }
}
