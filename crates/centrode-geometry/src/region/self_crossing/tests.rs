use super::*;
use crate::{
    Vector,
    curve::{Arc, PolySegment, Segment},
    numeric::Tolerance,
    test_shapes::{rosette, tooth_ring},
};

fn tolerance(mm: f64) -> Tolerance {
    Tolerance::new(mm).expect("positive")
}

fn pinned(curve: impl FnMut(f64) -> Point, t1: f64) -> Outline {
    let mut polys = PolySegment::fit(curve, 0.0, t1, tolerance(1e-9));
    let first = polys[0].start();
    if let Some(last) = polys.last_mut() {
        *last = last.pinned(last.start(), first);
    }
    Outline::new(polys.into_iter().map(Segment::from).collect()).expect("closed")
}

#[test]
fn simple_outlines_are_simple_at_every_scale() {
    let ring = tooth_ring(23, 2.25, tolerance(1e-10));
    for outline in [
        rosette(20.0, 3.0, 7, tolerance(1e-9)),
        ring.arcs(tolerance(1e-3)),
        ring.scaled(1e-4),
        ring.scaled(1e4),
        ring,
        Outline::circle(Point::origin(), 3.0),
    ] {
        assert_eq!(outline.crossing(), None);
    }
}

#[test]
fn a_limacon_crosses_at_its_node_only_with_an_inner_loop() {
    let limacon = |b: f64| {
        pinned(
            move |t| Point::from(Vector::new(t.cos(), t.sin()) * (10.0 * (b + t.cos()))),
            std::f64::consts::TAU,
        )
    };
    let crossing = limacon(0.8).crossing().expect("inner loop");
    assert!(crossing.point.coords.norm() < 1e-7, "{crossing:?}");
    assert_eq!(limacon(1.001).crossing(), None);
}

#[test]
fn a_gap_a_billionth_wide_is_no_crossing_and_an_overlap_is() {
    // A slot whose curved sides nearly meet in the middle.
    let slot = |gap: f64| {
        let p = Point::new;
        let line = Segment::Line;
        let (depth, half) = (1.0, 5.0);
        let bulge = 2.0 * depth / (2.0 * half);
        let low = p(0.0, -depth - 0.5 * gap);
        let high = p(0.0, depth + 0.5 * gap);
        let arc = |start: Point, end: Point| Segment::Arc(Arc { start, end, bulge });
        let (a, b) = (p(10.0, low.y), p(10.0, high.y));
        let (e, f) = (p(0.0, 8.0), p(0.0, -8.0));
        Outline::new(vec![
            line(f, p(30.0, -8.0)),
            line(p(30.0, -8.0), p(30.0, 8.0)),
            line(p(30.0, 8.0), e),
            line(e, high),
            arc(high, b),
            line(b, a),
            arc(a, low),
            line(low, f),
        ])
        .expect("closed")
    };
    // Each side has a sagitta of exactly its depth.
    assert_eq!(slot(4.0).crossing(), None);
    let closing = |gap: f64| {
        let outline = slot(gap);
        outline.crossing().is_some()
    };
    assert!(!closing(1e-7));
    assert!(closing(-1e-7) && closing(0.0));
}

#[test]
fn polygons_that_touch_cross_or_fold_are_found() {
    let p = Point::new;
    let eight = Outline::polygon(&[p(0.0, 0.0), p(4.0, 4.0), p(4.0, 0.0), p(0.0, 4.0)]);
    let found = eight.crossing().expect("crosses");
    assert!((found.point - p(2.0, 2.0)).norm() < 1e-12 && found.segments == [0, 2]);
    let touching = [
        p(0.0, 0.0),
        p(4.0, 0.0),
        p(4.0, 4.0),
        p(2.0, 0.0),
        p(0.0, 4.0),
    ];
    assert!(Outline::polygon(&touching).crossing().is_some());
    let folded = [p(0.0, 0.0), p(4.0, 0.0), p(2.0, 0.0), p(2.0, 4.0)];
    assert!(Outline::polygon(&folded).crossing().is_some());
    let sharp = [p(0.0, 0.0), p(4.0, 0.0), p(0.0, 1e-6)];
    assert_eq!(Outline::polygon(&sharp).crossing(), None);
}

/// Two curves that leave a cusp at the origin in one direction, closed by two lines.
fn cusp(lower: impl Fn(f64) -> f64, upper: impl Fn(f64) -> f64) -> Outline {
    let arc = |height: &dyn Fn(f64) -> f64| {
        let curve = |t: f64| Point::new(t, height(t));
        Segment::from(PolySegment::fit(curve, 0.0, 0.3, tolerance(1e-12))[0])
    };
    let (lower, upper) = (arc(&lower), arc(&upper));
    let far = Point::new(2.0, 0.1);
    let line = Segment::Line;
    let sides = [line(lower.end(), far), line(far, upper.end())];
    Outline::new(vec![lower, sides[0], sides[1], upper.reversed()]).expect("closed")
}

#[test]
fn curves_that_part_from_a_cusp_do_not_touch_however_flat_and_those_that_swap_sides_do() {
    for power in [2, 3, 4] {
        for bend in [1.0, 0.01] {
            let outline = cusp(|t| t * t, |t| t * t + bend * t.powi(power));
            assert_eq!(outline.crossing(), None, "{power} {bend}");
            assert_eq!(outline.scaled(1e-3).crossing(), None, "{power} {bend}");
        }
    }
    let swapped = cusp(|t| t * t, |t| t * t + t * t * (t - 0.1));
    let found = swapped.crossing().expect("crosses");
    assert!(
        found.segments == [0, 3] && found.point.x < 0.11,
        "{found:?}"
    );
    assert!(swapped.crossing_ignoring(0.05, 0.0).is_some());
    // A loop below the size is ignored, a larger one is not.
    assert_eq!(swapped.crossing_ignoring(0.12, 0.0), None);
    // They overlap by up to 4e-3/27.
    assert!(swapped.crossing_ignoring(0.0, 1.4e-4).is_some());
    assert_eq!(swapped.crossing_ignoring(0.0, 1.5e-4), None);
    let coincident = cusp(|t| t * t, |t| t * t);
    assert!(coincident.crossing().is_some());
}

#[test]
fn a_loop_in_a_segment_below_the_size_is_ignored() {
    // x = t^2, y = t (t^2 - e) has a loop e long.
    let looped = |e: f64| {
        let polys = PolySegment::fit(
            |t| Point::new(t * t, t * (t * t - e)),
            -1.0,
            1.1,
            tolerance(1e-13),
        );
        assert_eq!(polys.len(), 1);
        let (start, end) = (polys[0].start(), polys[0].end());
        let far = Point::new(3.0, 0.0);
        let line = Segment::Line;
        Outline::new(vec![polys[0].into(), line(end, far), line(far, start)]).expect("closed")
    };
    for e in [1e-3, 1e-6] {
        let outline = looped(e);
        let found = outline.crossing().expect("crosses");
        assert_eq!(found.segments, [0, 0]);
        assert!(outline.crossing_ignoring(0.5 * e, 0.0).is_some());
        assert_eq!(outline.crossing_ignoring(1.5 * e, 0.0), None);
    }
}

#[test]
fn a_small_loop_over_very_short_segments_is_ignored() {
    // The two long sides cross below the short segments that join them.
    let tip = |e: f64, count: usize| {
        let mut corners = vec![Point::new(0.0, 0.0), Point::new(1.0 + e, 1.0)];
        corners.extend((1..count).map(|i| {
            let share = i as f64 / count as f64;
            Point::new(1.0 + e - 2.0 * e * share, 1.0 + 1e-3 * e)
        }));
        corners.extend([Point::new(1.0 - e, 1.0), Point::new(2.0, 0.0)]);
        Outline::polygon(&corners)
    };
    for count in [1, 3] {
        for e in [1e-2, 1e-8] {
            let outline = tip(e, count);
            assert_eq!(
                outline.crossing().expect("crosses").segments,
                [0, count + 1]
            );
            assert!(
                outline.crossing_ignoring(0.9 * e, 0.0).is_some(),
                "{count} {e}"
            );
            assert_eq!(outline.crossing_ignoring(3.0 * e, 0.0), None, "{count} {e}");
        }
    }
}
