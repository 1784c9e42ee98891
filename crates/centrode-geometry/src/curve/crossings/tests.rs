use super::*;
use crate::curve::{PolySegment, Segment};

fn fine() -> Tolerance {
    Tolerance::new(1e-13).expect("positive")
}

fn crossings(
    a: &Segment,
    b: &Segment,
    joined: bool,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, CrossingError> {
    meetings(
        &Span::whole(a),
        &Span::whole(b),
        joined,
        Resolution::of_crossings(tolerance),
    )
    .map(|met| met.crossings)
}

fn self_crossings(
    segment: &Segment,
    tolerance: Tolerance,
) -> Result<Vec<(f64, f64)>, CrossingError> {
    self_meetings(&Span::whole(segment), Resolution::of_crossings(tolerance))
        .map(|met| met.crossings)
}

fn polys(f: impl Fn(f64) -> Point, a: f64, b: f64) -> Vec<Segment> {
    let tolerance = Tolerance::new(1e-10).expect("positive");
    PolySegment::fit(f, a, b, tolerance)
        .into_iter()
        .map(Segment::from)
        .collect()
}

#[test]
fn the_loop_of_a_folium_is_found_at_every_size() {
    // x = t^2, y = t^3 - e t crosses itself at t = +-sqrt e.
    for exponent in 0..3 {
        let e = 10_f64.powi(-exponent);
        let whole = polys(|t| Point::new(t * t, t * (t * t - e)), -1.2, 1.2);
        let found: Vec<_> = if whole.len() == 1 {
            self_crossings(&whole[0], fine()).expect("determined")
        } else {
            crossings(&whole[0], &whole[1], true, fine()).expect("determined")
        };
        assert_eq!(found.len(), 1, "{e}");
        let point = whole[0].at(found[0].0).point;
        assert!((point - Point::new(e, 0.0)).norm() < 1e-9, "{point} {e}");
    }
}

#[test]
fn a_loop_a_ten_thousandth_of_its_curve_between_two_cusps_is_found() {
    // The swallowtail of a fillet: dx/dt = (t^2 - a^2), dy/dt = t (t^2 - a^2), which crosses itself.
    let a = 2e-2_f64;
    let tail = |t: f64| {
        let x = t * t * t / 3.0 - a * a * t;
        let y = 0.25 * t.powi(4) - 0.5 * a * a * t * t;
        Point::new(y, x)
    };
    let curve = polys(tail, -1.0, 0.93)[0];
    let found = self_crossings(&curve, fine()).expect("determined");
    assert_eq!(found.len(), 1, "{found:?}");
    let [p, q] = [found[0].0, found[0].1].map(|u| curve.at(u).point);
    // At t = -+ a sqrt 3, where x is zero again.
    let expected = Point::new(0.75 * a.powi(4), 0.0);
    assert!(
        (p - expected).norm() < 1e-13 && (q - expected).norm() < 1e-13,
        "{p} {q}"
    );
}

#[test]
fn a_loop_as_small_as_rounding_is_found_at_most_once() {
    let found = |start: [f64; 2], end: [f64; 2], coefficients: [[f64; 2]; 14], shortest: f64| {
        let [start, end] = [start, end].map(|[x, y]| Point::new(x, y));
        let coefficients = coefficients.map(|[x, y]| Vector::new(x, y));
        let fillet = Segment::from(PolySegment::new(start, end, coefficients));
        self_crossings(&fillet, Tolerance::new(shortest).expect("positive")).expect("determined")
    };
    // Fillet of 24 teeth by the law phi - 0.03278 sin 3 phi: it turns back twice within 1e-11 mm.
    let of_a_law = found(
        [7.588094067389572, 8.040740352332753],
        [6.313432288736567, 7.521567601432942],
        [
            [6.59907941734634, 7.713939780263254],
            [-0.6272941014006377, -0.33386347164329866],
            [0.36966769641306096, 0.06897440028494461],
            [-0.01093942151680971, 0.07773161972194975],
            [-0.018417017992289786, -0.0018670447919362232],
            [0.0009444171000758672, -0.003499408105279045],
            [0.00042847074843876953, 0.00011722791063206728],
            [-4.2906112625473725e-5, 4.2540394844081675e-5],
            [5.066306698608969e-6, -1.0678072797531968e-5],
            [1.1738233496316752e-6, 2.452239300509973e-6],
            [-4.6996501623652875e-7, 2.9339764751057373e-7],
            [-5.22232426192204e-8, -1.100887629945646e-7],
            [1.5205841918941587e-8, -2.1088908397359774e-9],
            [1.003400029730983e-9, 2.0313564164098352e-9],
        ],
        8.26e-11,
    );
    assert!(of_a_law.len() <= 1, "{of_a_law:?}");
    // Fillet of 40 teeth on a cubic B-spline, whose loop is 4e-10 mm long where rounding is 2e-10 mm.
    let of_a_spline = found(
        [-8.148466338874403, -20.117184654759644],
        [-8.38802712052259, -19.66655649530719],
        [
            [-8.355402800262846, -19.732082059442682],
            [-0.12794652749919583, 0.27225162990161156],
            [0.09208818317931455, -0.1521557311764239],
            [0.010015494228538868, -0.04612497474053345],
            [-0.004456769908246727, -0.007808040028788099],
            [-0.0017727129071669623, -0.0009267342525127731],
            [-0.0004748105632934596, 0.00013917171949628937],
            [-8.140084599972397e-05, 0.0001066256068753546],
            [-2.5966362073859273e-06, 3.529784643774292e-05],
            [4.20986334859208e-06, 7.711145883604331e-06],
            [1.9948539033975976e-06, 9.355762813356705e-07],
            [5.529681743610126e-07, -1.349824287899537e-07],
            [6.96388724463759e-08, -1.495277501817327e-07],
            [-6.6318079916527495e-09, -4.295270628063008e-08],
        ],
        1e-10,
    );
    assert!(of_a_spline.len() <= 1, "{of_a_spline:?}");
}

#[test]
fn strands_that_leave_a_cusp_in_one_direction_are_apart_however_little_their_curvatures_differ() {
    for share in [1.0, 1e-2, 1e-4, 3e-6] {
        let bend = |curvature: f64, from: f64, to: f64| {
            let parabola = |x: f64| Point::new(x, 0.5 * curvature * x * x);
            let part = PolySegment::fit(parabola, from, to, fine());
            Segment::from(part[0])
        };
        let (there, back) = (bend(0.3, 1.0, 0.0), bend(0.3 * (1.0 + share), 0.0, 1.0));
        let found = crossings(
            &there,
            &back,
            true,
            Tolerance::new(1e-10).expect("positive"),
        );
        // Rounding may have them cross where they part by no more than it.
        let parted = |u: f64| 0.15 * share * (0.5 * (1.0 - u)).powi(2);
        let crossed = found.expect("determined");
        assert!(
            crossed.iter().all(|&(u, _)| parted(u) < 1e-15),
            "{share}: {crossed:?}"
        );
    }
}

#[test]
fn curves_that_lie_on_each_other_are_an_error_that_names_a_point() {
    let quarter = polys(|t| Point::new(t.cos(), t.sin()), 0.0, 1.5)[0];
    let found = crossings(&quarter, &quarter.reversed(), false, fine());
    let Err(CrossingError::Overlap { near }) = found else {
        panic!("{found:?}")
    };
    assert!((near.coords.norm() - 1.0).abs() < 1e-9, "{near}");
}

#[test]
fn a_curve_that_is_not_a_number_is_an_error_and_ends() {
    let inside = |t: f64| Point::new(t, if t.abs() < 0.5 { f64::NAN } else { t * t });
    for nowhere in [
        polys(inside, -1.0, 1.0)[0],
        Segment::Line(Point::origin(), Point::new(f64::NAN, 1.0)),
    ] {
        let line = Segment::Line(Point::origin(), Point::new(1.0, 1.0));
        assert_eq!(
            self_crossings(&nowhere, fine()),
            Err(CrossingError::NotFinite)
        );
        assert_eq!(
            crossings(&line, &nowhere, true, fine()),
            Err(CrossingError::NotFinite)
        );
    }
}

#[test]
fn a_tolerance_below_every_rounding_ends_as_well() {
    let tiny = Tolerance::new(f64::MIN_POSITIVE).expect("positive");
    let cusp = polys(|t| Point::new(t * t, t * t * t), -1.0, 1.0)[0];
    // Rounding may make a loop of the cusp, as small as itself.
    let found = self_crossings(&cusp, tiny).expect("ends");
    assert!(
        found.iter().all(|c| c.0.abs().max(c.1.abs()) < 1e-6),
        "{found:?}"
    );
    let [a, b] = [-1.0, 1.0].map(|x| Segment::Line(Point::new(x, 2.0), Point::origin()));
    assert_eq!(crossings(&a, &b, false, tiny).map(|c| c.len()), Ok(1));
}
