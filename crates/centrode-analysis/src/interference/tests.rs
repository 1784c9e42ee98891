use super::*;
use centrode_geometry::{Outline, Vector};
use nalgebra::Isometry2;
use std::f64::consts::{PI, TAU};

fn tolerance(mm: f64) -> Tolerance {
    Tolerance::new(mm).expect("positive")
}

fn body(outline: Outline) -> Body {
    Body::new(&[outline], tolerance(1e-3)).expect("a body")
}

fn polygon(points: &[[f64; 2]]) -> Outline {
    Outline::polygon(&points.iter().map(|&p| Point::from(p)).collect::<Vec<_>>())
}

fn rectangle(x: f64, y: f64) -> Outline {
    polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]])
}

fn moving<'a>(body: &'a Body, motion: &'a dyn Motion) -> Moving<'a> {
    Moving { body, motion }
}

/// Linear congruential sequence in `[0, 1)`, equal on every machine.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A star-shaped, mostly concave polygon.
    fn star(&mut self, corners: u32, minimum: f64, maximum: f64) -> Vec<Point> {
        (0..corners)
            .map(|i| {
                let angle = TAU * f64::from(i) / f64::from(corners);
                Point::from(Vector::new(angle.cos(), angle.sin()) * self.between(minimum, maximum))
            })
            .collect()
    }
}

/// Distance of two polygons: every corner to every edge; no code of the crate.
fn brute_distance(a: &[Point], b: &[Point]) -> f64 {
    let to_edge = |p: &Point, c: &Point, d: &Point| {
        let t = ((p - c).dot(&(d - c)) / (d - c).norm_squared()).clamp(0.0, 1.0);
        (p - (c + (d - c) * t)).norm()
    };
    let one_way = |a: &[Point], b: &[Point]| {
        let mut minimum = f64::INFINITY;
        for p in a {
            for i in 0..b.len() {
                minimum = minimum.min(to_edge(p, &b[i], &b[(i + 1) % b.len()]));
            }
        }
        minimum
    };
    one_way(a, b).min(one_way(b, a))
}

/// Whether polygons that do not contain one another overlap.
fn brute_crossing(a: &[Point], b: &[Point]) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).perp(&(r - p)) > 0.0;
    (0..a.len()).any(|i| {
        let (p, q) = (a[i], a[(i + 1) % a.len()]);
        (0..b.len()).any(|j| {
            let (r, s) = (b[j], b[(j + 1) % b.len()]);
            side(p, q, r) != side(p, q, s) && side(r, s, p) != side(r, s, q)
        })
    })
}

#[test]
fn distance_at_a_pose_is_that_of_all_corners_against_all_edges() {
    let mut chance = Chance(1);
    let (mut apart, mut overlapping) = (0, 0);
    for _ in 0..300 {
        let shapes = [chance.star(17, 3.0, 20.0), chance.star(23, 5.0, 15.0)];
        let bodies = shapes.each_ref().map(|s| body(Outline::polygon(s)));
        let poses = [0, 1].map(|_| {
            let far = Vector::new(chance.between(-30.0, 30.0), chance.between(-30.0, 30.0));
            Isometry2::new(far, chance.between(-9.0, 9.0))
        });
        let placed = [0, 1].map(|i| {
            let points = shapes[i].iter();
            points.map(|p| poses[i] * p).collect::<Vec<_>>()
        });
        let rest = poses.map(Rest);
        let (a, b) = (moving(&bodies[0], &rest[0]), moving(&bodies[1], &rest[1]));
        let found = clearance(&a, &b, [0.0, 1.0], tolerance(1e-9)).expect("finite");
        if brute_crossing(&placed[0], &placed[1]) {
            overlapping += 1;
            assert!(found.minimum < 0.0, "{found:?}");
        } else {
            apart += 1;
            let expected = brute_distance(&placed[0], &placed[1]);
            assert!(
                (found.minimum - expected).abs() < 1e-12,
                "{found:?} {expected}"
            );
            assert!(found.lower_bound <= found.minimum && found.lower_bound > found.minimum - 2e-9);
            let [p, q] = found.points;
            assert!(((p - q).norm() - expected).abs() < 1e-9);
        }
    }
    assert!(apart > 50 && overlapping > 50, "{apart} {overlapping}");
}

#[test]
fn a_turning_bar_passes_a_circle_at_the_distance_of_the_closed_form() {
    // The bar's end runs on a circle of 100 mm; the disc's centre is 130 mm away.
    let bar = body(rectangle(100.0, 2.0));
    let disc = body(Outline::circle(Point::origin(), 5.0));
    let turning = Uniform {
        start: Isometry2::identity(),
        velocity: Vector::zeros(),
        turning: 1.0,
    };
    let place = Rest(Isometry2::new(
        Vector::new(130.0 * 2_f64.cos(), 130.0 * 2_f64.sin()),
        0.0,
    ));
    for (inputs, at) in [([0.0, PI], 2.0), ([PI, TAU], 2.0 + PI)] {
        let (a, b) = (moving(&bar, &turning), moving(&disc, &place));
        let found = clearance(&a, &b, inputs, tolerance(1e-4)).expect("finite");
        // The bar's corners pass closest, and the circle is flattened from within.
        let exact = 125.0 - 100_f64.hypot(2.0);
        assert!((found.minimum - exact).abs() < 1.2e-3, "{found:?}");
        assert!(
            (0.0..2.3e-3).contains(&(exact - found.lower_bound)),
            "{found:?}"
        );
        assert!((found.input - at).abs() < 0.03, "{found:?}");
    }
}

#[test]
fn a_thin_bar_that_swings_past_within_a_thousandth_of_a_radian_is_caught() {
    // 0.02 mm thick at 100 mm: it covers the pin's middle for 0.0002 rad only.
    let bar = body(rectangle(100.0, 0.01));
    let pin = body(rectangle(0.01, 0.01));
    let place = Rest(Isometry2::new(
        Vector::new(90.0 * 1.2345_f64.cos(), 90.0 * 1.2345_f64.sin()),
        1.2345,
    ));
    for turning in [1.0, -1.0, 3.0] {
        let swing = Uniform {
            start: Isometry2::identity(),
            velocity: Vector::zeros(),
            turning,
        };
        let (a, b) = (moving(&bar, &swing), moving(&pin, &place));
        let found = clearance(&a, &b, [0.0, 3.0], tolerance(1e-4)).expect("finite");
        assert!((found.minimum + 0.01).abs() < 2e-4, "{turning} {found:?}");
        assert!(found.lower_bound <= found.minimum && found.lower_bound > -0.0103);
        let beside = Rest(Isometry2::new(place.0.translation.vector * 1.2, 1.2345));
        let b = moving(&pin, &beside);
        let found = clearance(&a, &b, [0.0, 3.0], tolerance(1e-4)).expect("finite");
        assert!(
            (found.minimum - (108.0 - 0.01 - 100.0)).abs() < 1e-4,
            "{found:?}"
        );
    }
}

#[test]
fn bodies_that_stay_in_each_other_are_as_deep_as_they_are_to_a_told_bound() {
    // A small square in a large one, both carried round together: 7 mm deep at every input.
    let bodies = [rectangle(10.0, 10.0), rectangle(3.0, 3.0)].map(body);
    let carried = |t: f64| PoseJet {
        position: Point::new(90.0 * t.cos(), 90.0 * t.sin()),
        angle: 2.0 * t,
        velocity: Vector::new(-90.0 * t.sin(), 90.0 * t.cos()),
        turning: 2.0,
    };
    let motions = [&bodies[0], &bodies[1]].map(|body| {
        let within = Tabulated::within([0.0, TAU], body.reach(), carried, tolerance(1e-6));
        within.expect("a motion")
    });
    let (a, b) = (
        moving(&bodies[0], &motions[0]),
        moving(&bodies[1], &motions[1]),
    );
    let found = clearance(&a, &b, [0.0, TAU], tolerance(1e-6)).expect("finite");
    assert!((found.minimum + 7.0).abs() < 1e-5, "{found:?}");
    assert!(
        (found.lower_bound..=found.lower_bound + 0.1).contains(&found.minimum),
        "{found:?}"
    );
}

#[test]
fn inside_is_overlap_and_pulled_apart_is_not() {
    let (large, small) = (body(rectangle(10.0, 10.0)), body(rectangle(1.0, 1.0)));
    let home = Rest(Isometry2::identity());
    let deep = Rest(Isometry2::new(Vector::new(4.0, 1.0), 0.0));
    let found = |shift: f64, within: f64| {
        let place = Rest(Isometry2::new(Vector::new(shift, 0.0), 0.0));
        let (a, b) = (moving(&large, &home), moving(&small, &place));
        clearance(&a, &b, [0.0, 1.0], tolerance(within)).expect("finite")
    };
    // The deepest of the small square's border: its left side is 7 mm from the right, 8 from above.
    let (a, b) = (moving(&large, &home), moving(&small, &deep));
    let inside = clearance(&a, &b, [0.0, 1.0], tolerance(1e-6)).expect("finite");
    assert!((inside.minimum + 7.0).abs() < 1e-5, "{inside:?}");
    assert!((found(12.0, 1e-6).minimum - 1.0).abs() < 1e-12);
    for gap in [1e-3, 1e-6, 1e-9] {
        let apart = found(11.0 + gap, 1e-12);
        assert!(
            (apart.minimum - gap).abs() < 1e-12 && apart.lower_bound > 0.0,
            "{apart:?}"
        );
        let into = found(11.0 - gap, 0.1 * gap);
        assert!((into.minimum + gap).abs() < 0.2 * gap, "{into:?}");
    }
    // A ring has a hole: a body in the hole is clear of it.
    let hole = Outline::circle(Point::origin(), 8.0).reversed();
    let ring = Body::new(&[rectangle(10.0, 10.0), hole], tolerance(1e-6)).expect("a body");
    let (a, b) = (moving(&ring, &home), moving(&small, &home));
    let concave = clearance(&a, &b, [0.0, 1.0], tolerance(1e-6)).expect("finite");
    assert!(
        (concave.minimum - (8.0 - 2_f64.sqrt())).abs() < 3e-6,
        "{concave:?}"
    );
}

/// Two arms like those of a planetary machine, with the law of their turning.
fn arms(k: f64) -> ([Body; 2], [Tabulated; 2]) {
    let shape = [
        [-30.0, -25.0],
        [40.0, -30.0],
        [60.0, -70.0],
        [150.0, -66.0],
        [150.0, -62.0],
        [70.0, -50.0],
        [45.0, 20.0],
        [-20.0, 30.0],
    ];
    let outline = polygon(&shape).scaled(k);
    let bodies = [0, 1]
        .map(|_| Body::new(std::slice::from_ref(&outline), tolerance(1e-3 * k)).expect("a body"));
    let motions = [0.0_f64, 2.1].map(|phase| {
        Tabulated::new([0.0, TAU], 720, |t| PoseJet {
            position: Point::new(k * 190.0 * phase.cos(), k * 190.0 * phase.sin()),
            angle: 1.3 + phase - t + 0.5 * (t + phase).sin(),
            velocity: Vector::zeros(),
            turning: -1.0 + 0.5 * (t + phase).cos(),
        })
        .expect("smooth")
    });
    (bodies, motions)
}

#[test]
fn a_moving_pair_is_nowhere_closer_than_the_bound_and_scales() {
    let within = 1e-3;
    let ([p, q], [m, n]) = arms(1.0);
    let (a, b) = (moving(&p, &m), moving(&q, &n));
    let found = clearance(&a, &b, [0.0, TAU], tolerance(within)).expect("finite");
    assert!(m.deviation().1 < 1e-10, "{:?}", m.deviation());
    // Sampled densely by corners against edges.
    let placed = |body: &Body, motion: &Tabulated, input: f64| {
        let pose = motion.at(input).isometry();
        (0..)
            .take(body.vertex_count())
            .map(|i| pose * body.edge(i)[0])
            .collect::<Vec<_>>()
    };
    let mut sampled = f64::INFINITY;
    for i in 0..20_000 {
        let input = TAU * f64::from(i) / 20_000.0;
        let (x, y) = (placed(&p, &m, input), placed(&q, &n, input));
        let distance = brute_distance(&x, &y);
        sampled = sampled.min(distance);
        assert!(!brute_crossing(&x, &y));
        assert!(distance > found.lower_bound, "{input}");
    }
    assert!(
        (found.minimum - sampled).abs() < within + 1e-3,
        "{found:?} {sampled}"
    );
    assert!(
        found.lower_bound >= found.minimum - 1.01 * within,
        "{found:?}"
    );
    let ([p, q], [m, n]) = arms(1000.0);
    let (a, b) = (moving(&p, &m), moving(&q, &n));
    let large = clearance(&a, &b, [0.0, TAU], tolerance(1000.0 * within)).expect("finite");
    assert!(
        (large.minimum - 1000.0 * found.minimum).abs() < 1e-7,
        "{large:?}"
    );
    assert!(
        (large.lower_bound - 1000.0 * found.lower_bound).abs() < 1e-4,
        "{large:?}"
    );
    assert!((large.input - found.input).abs() < 1e-12);
}

#[test]
fn bounds_of_a_table_hold_everywhere_and_a_later_body_does_the_same() {
    let law = |t: f64| PoseJet {
        position: Point::new(40.0 * t.cos(), 20.0 * (2.0 * t).sin()),
        angle: 0.4 - t + 0.8 * (3.0 * t).sin(),
        velocity: Vector::new(-40.0 * t.sin(), 40.0 * (2.0 * t).cos()),
        turning: -1.0 + 2.4 * (3.0 * t).cos(),
    };
    let table = Tabulated::new([0.0, TAU], 97, law).expect("smooth");
    let (far, turned) = table.deviation();
    assert!(far < 1e-3 && turned < 1e-3, "{far} {turned}");
    let later = DelayedMotion {
        first: &table,
        delay: 1.9,
        turned: 0.6,
    };
    let mut chance = Chance(5);
    for _ in 0..3000 {
        let input = chance.between(0.0, TAU);
        let (ours, theirs) = (table.at(input), law(input));
        assert!((ours.position - theirs.position).norm() <= far);
        assert!((ours.angle - theirs.angle).abs() <= turned);
        // The rigid motion of the first, turned about the origin.
        let pose = later.at(input).isometry();
        let first = table.at((input - 1.9).rem_euclid(TAU)).isometry();
        let expected = Isometry2::rotation(0.6) * first;
        let corner = Point::new(70.0, -30.0);
        assert!((pose * corner - expected * corner).norm() < 1e-11);
        let width = chance.between(0.0, 0.3);
        let inside = input + width * chance.next();
        if input + width > TAU {
            continue;
        }
        for motion in [&table as &dyn Motion, &later] {
            let (bend, h) = (motion.bend(input, input + width), 1e-6);
            let (a, b) = (motion.at(inside), motion.at(inside + h));
            assert!(a.turning.abs() <= bend.turning * (1.0 + 1e-12));
            if inside + h < input + width {
                assert!((b.turning - a.turning).abs() <= h * bend.turning_change + 1e-12);
                assert!((b.velocity - a.velocity).norm() <= h * bend.acceleration + 1e-11);
            }
        }
    }
}

#[test]
fn random_motions_are_never_closer_than_proven() {
    let mut chance = Chance(11);
    let (mut clear, mut overlapping) = (0, 0);
    for _ in 0..60 {
        let shapes = [chance.star(9, 4.0, 20.0), chance.star(13, 5.0, 15.0)];
        let bodies = shapes.each_ref().map(|s| body(Outline::polygon(s)));
        let motions = [0, 1].map(|_| Uniform {
            start: Isometry2::new(
                Vector::new(chance.between(-60.0, 60.0), chance.between(-60.0, 60.0)),
                chance.between(-3.0, 3.0),
            ),
            velocity: Vector::new(chance.between(-9.0, 9.0), chance.between(-9.0, 9.0)),
            turning: chance.between(-4.0, 4.0),
        });
        let both = [0, 1].map(|i| moving(&bodies[i], &motions[i]));
        let found = clearance(&both[0], &both[1], [-1.0, 2.0], tolerance(1e-3)).expect("finite");
        let mut sampled = f64::INFINITY;
        for k in 0..=3000 {
            let input = -1.0 + f64::from(k) / 1000.0;
            let placed = [0, 1].map(|i| {
                let pose = motions[i].at(input).isometry();
                shapes[i].iter().map(|p| pose * p).collect::<Vec<_>>()
            });
            let inside = |p: &Point, own: usize| {
                let local = motions[1 - own].at(input).isometry().inverse() * p;
                bodies[1 - own].contains(local)
            };
            // Depths of corners: the deepest point of a border is at least as deep.
            let deepest = [0, 1].into_iter().flat_map(|own| {
                let other = &placed[1 - own];
                let corners = placed[own].iter().filter(move |p| inside(p, own));
                corners.map(move |p| brute_distance(&[*p], other))
            });
            let depth = deepest.fold(f64::NEG_INFINITY, f64::max);
            sampled = sampled.min(if depth > 0.0 {
                -depth
            } else if brute_crossing(&placed[0], &placed[1]) {
                0.0
            } else {
                brute_distance(&placed[0], &placed[1])
            });
        }
        assert!(sampled >= found.lower_bound, "{sampled} {found:?}");
        assert!(found.lower_bound >= found.minimum - 1.001e-3, "{found:?}");
        if sampled > 0.0 {
            clear += 1;
            assert!((sampled - found.minimum).abs() < 0.2, "{sampled} {found:?}");
        } else {
            overlapping += 1;
            assert!(found.minimum <= sampled + 1e-3, "{sampled} {found:?}");
        }
    }
    assert!(clear > 10 && overlapping > 10, "{clear} {overlapping}");
}

#[test]
fn the_least_of_several_pairs_is_that_of_the_closest() {
    let square = body(rectangle(1.0, 1.0));
    let places = [0.0, 10.0, 15.0, 40.0].map(|x| Rest(Isometry2::new(Vector::new(x, 0.0), 0.0)));
    let bodies = places.each_ref().map(|place| moving(&square, place));
    let pairs = [[0, 1], [2, 3], [1, 2], [0, 3]];
    let found = minimum_clearance(&bodies, &pairs, [0.0, 1.0], tolerance(1e-6)).expect("finite");
    let found = found.expect("pairs");
    assert_eq!(found.pair, [1, 2]);
    assert!((found.minimum - 3.0).abs() < 1e-12 && (found.lower_bound - 3.0).abs() < 2e-6);
    assert_eq!(
        minimum_clearance(&bodies, &[], [0.0, 1.0], tolerance(1e-6)),
        Ok(None)
    );
    let error = minimum_clearance(&bodies, &[[1, 1]], [0.0, 1.0], tolerance(1e-6));
    assert!(matches!(
        error,
        Err(InterferenceError::Pair {
            pair: [1, 1],
            bodies: 4
        })
    ));
}

#[test]
fn bad_input_is_an_error() {
    assert_eq!(Body::new(&[], tolerance(1.0)).err(), Some(BodyError::Empty));
    let nan = polygon(&[[0.0, 0.0], [1.0, f64::NAN], [2.0, 1.0]]);
    let error = Body::new(&[rectangle(1.0, 1.0), nan], tolerance(1.0)).err();
    assert_eq!(error, Some(BodyError::NotFinite { outline: 1 }));
    let square = body(rectangle(1.0, 1.0));
    let (home, lost) = (
        Rest(Isometry2::identity()),
        Rest(Isometry2::new(Vector::new(f64::NAN, 0.0), 0.0)),
    );
    let (a, b) = (moving(&square, &home), moving(&square, &lost));
    assert!(clearance(&a, &b, [0.0, 1.0], tolerance(1.0)).is_err());
    assert!(clearance(&a, &a, [1.0, 1.0], tolerance(1.0)).is_err());
    let still = |_: f64| home.at(0.0);
    assert!(Tabulated::new([0.0, 1.0], 0, still).is_err());
    assert!(Tabulated::new([0.0, f64::INFINITY], 3, still).is_err());
    assert!(Tabulated::new([0.0, 1.0], 3, |_| lost.at(0.0)).is_err());
}

#[test]
fn bodies_that_stay_as_near_all_along_have_an_answer_and_sizes_without_a_square_have_none() {
    // A disc of 720 corners that turns on a crank about another: 10 mm apart at every input, to within a corner's height.
    let disc = |radius: f64| {
        let corner = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / 720.0).sin_cos();
            [radius * cos, radius * sin]
        };
        body(polygon(&(0..720).map(corner).collect::<Vec<_>>()))
    };
    let (own, middle) = (disc(5.0), disc(15.0));
    let pose = |phi: f64| PoseJet {
        position: Point::new(30.0 * phi.cos(), 30.0 * phi.sin()),
        angle: phi,
        velocity: Vector::new(-30.0 * phi.sin(), 30.0 * phi.cos()),
        turning: 1.0,
    };
    let crank = Tabulated::within([0.0, TAU], own.reach(), pose, tolerance(1e-9)).expect("finite");
    let rest = Rest(Isometry2::identity());
    let still = moving(&middle, &rest);
    let found = clearance(&moving(&own, &crank), &still, [0.0, TAU], tolerance(1e-9));
    let found = found.expect("finite");
    assert!((found.minimum - 10.0).abs() < 1e-3, "{found:?}");
    assert!(
        found.lower_bound <= found.minimum && found.lower_bound > 9.99,
        "{found:?}"
    );
    let far = Uniform {
        start: Isometry2::identity(),
        velocity: Vector::new(1e300, 0.0),
        turning: 0.0,
    };
    let refused = clearance(&moving(&own, &far), &still, [0.0, TAU], tolerance(1e-9));
    assert!(refused.is_err(), "{refused:?}");
    let huge = Body::new(&[rectangle(1e300, 1.0)], tolerance(1e-3));
    assert_eq!(huge.err(), Some(BodyError::NotFinite { outline: 0 }));
}
