use std::f64::consts::{PI, TAU};

use centrode_geometry::Point;

use super::{drawn, published, published_path};
use crate::reverse::{
    PossibleAxis, RequiredPath, ReversedMachine, Split, SplitError, SplitKind, TwoBar,
};
use centrode_gear::{Member, PlannedPair};
use centrode_kinematics::transmission::Transmission as _;

#[test]
fn powers_make_the_total_law_and_halve_the_logarithm_of_its_ratio() {
    for (x, y) in [(210.0, 200.0), (260.0, 160.0)] {
        let chain = TwoBar::new(&drawn(), Point::new(x, y), None).expect("a chain");
        let bend = 40.0_f64.to_radians();
        let split = Split::new(&chain, SplitKind::Powers, bend).expect("a split");
        let law = chain.law().expect("a law");
        let step = 1e-4;
        let slope = |f: &dyn Fn(f64) -> f64, x: f64| (f(x + step) - f(x - step)) / (2.0 * step);
        for i in -50..100 {
            let psi = 0.1 * f64::from(i);
            let planet = law.at(psi);
            let [one, other] = [split.first(psi), split.second(planet.position)];
            assert!(
                (one - other).abs() < 1e-12 * (1.0 + one.abs()),
                "{psi}: {one} {other}"
            );
            assert!((split.first(psi + TAU) - one - TAU).abs() < 1e-12);
            let first = slope(&|x| split.first(x), psi);
            let second = slope(&|x| split.second(x), planet.position);
            // g' = f'/G', and both are powers of G' but for one factor.
            let factor = first / planet.velocity.sqrt();
            assert!(
                (second * planet.velocity.sqrt() / factor - 1.0).abs() < 1e-5,
                "{psi}"
            );
        }
    }
}

#[test]
fn the_mildest_split_makes_the_total_law_with_blunter_gears_than_powers() {
    for (x, y, gain) in [(210.0, 200.0, 1.2), (260.0, 160.0, 1.2)] {
        let chain = TwoBar::new(&drawn(), Point::new(x, y), None).expect("a chain");
        let bend = 40.0_f64.to_radians();
        let law = chain.law().expect("a law");
        let sharpest = |kind: SplitKind| {
            let split = Split::new(&chain, kind, bend).expect("a split");
            for i in -50..100 {
                let psi = 0.1 * f64::from(i);
                let planet = law.at(psi).position;
                let [one, other] = [split.first(psi), split.second(planet)];
                assert!((one - other).abs() < 1e-12 * (1.0 + one.abs()), "{psi}");
                assert!((split.first(psi + TAU) - one - TAU).abs() < 1e-12);
            }
            let made = ReversedMachine::new(&chain, &split, 1, None).expect("a machine");
            assert!(made.tip_error.value < 1e-4, "{:?}", made.tip_error);
            let radii = made.minimum_radii.iter().flatten();
            radii.fold(f64::INFINITY, |minimum, r| minimum.min(*r))
        };
        let [powers, mildest] = [SplitKind::Powers, SplitKind::Mildest].map(sharpest);
        assert!(mildest > gain * powers, "({x}, {y}): {powers} {mildest}");
    }
}

#[test]
fn the_pair_of_the_published_machine_comes_back_from_its_path() {
    let (machine, path) = (published(), published_path());
    let chain = TwoBar::new(&path, Point::origin(), None).expect("a chain");
    let bend = machine.train().bend();
    let split = Split::new(&chain, SplitKind::OnePair, bend).expect("a split");
    let rolling = machine.rolling();
    // Sun at 86 degrees, seen from the first leg: the polar angle here is the direction of the planet's axis.
    let shift = machine.train().carrier_start() + 0.5 * bend;
    let known = |psi: f64| rolling.driven_angle(psi - shift);
    let start = split.first(0.0) - known(0.0);
    let mut worst = 0.0_f64;
    // The bend of 53 degrees is 127/360 of a turn: many laws do it, of which the smoothest is the one of the machine.
    for i in 0..3000 {
        let psi = TAU * f64::from(i) / 3000.0;
        worst = worst.max((split.first(psi) - known(psi) - start).abs());
    }
    assert!(worst < 1e-8, "{worst:e}");
    // The offset of the planet is the one at which it is mounted there.
    let law = chain.law().expect("a law");
    for i in 0..1000 {
        let psi = TAU * f64::from(i) / 1000.0;
        let planet = law.at(psi).position + split.planet_offset();
        let miss = split.first(planet) - split.first(psi) + bend + PI;
        assert!(miss.abs() < 1e-10, "{psi}: {miss:e}");
    }
}

/// On a path of splines the law of one pair is rough: its breaks are those of the path and all their images.
#[test]
fn one_pair_of_the_drawn_path_solves_its_equation() {
    for (x, y, bend) in [
        (260.0, 160.0, 40.3_f64),
        (260.0, 160.0, -53.17),
        (250.0, 170.0, 65.2),
    ] {
        let chain = TwoBar::new(&drawn(), Point::new(x, y), None).expect("a chain");
        let bend = bend.to_radians();
        let split = Split::new(&chain, SplitKind::OnePair, bend).expect("a split");
        let law = chain.law().expect("a law");
        let mut worst = 0.0_f64;
        for i in 0..7919 {
            let psi = TAU * f64::from(i) / 7919.0;
            let planet = law.at(psi).position + split.planet_offset();
            let miss = split.first(planet) - split.first(psi) + bend + PI;
            worst = worst.max(miss.abs());
        }
        assert!(worst < 1e-10, "({x}, {y}) {bend}: {worst:e}");
        assert!(split.miss() < 1e-10, "{:e}", split.miss());
    }
}

#[test]
fn one_pair_is_refused_at_and_near_fractions() {
    let chain = TwoBar::new(&published_path(), Point::origin(), None).expect("a chain");
    let split = |bend: f64| Split::new(&chain, SplitKind::OnePair, bend.to_radians());
    for (bend, fraction) in [
        (-60.0, (1, 3)),
        (-60.2, (1, 3)),
        (0.0, (1, 2)),
        (-90.0, (1, 4)),
    ] {
        let Err(SplitError::Resonance {
            numerator,
            denominator,
            ..
        }) = split(bend)
        else {
            panic!("{bend} deg is near a fraction");
        };
        assert_eq!((numerator, denominator), fraction);
    }
    // 7/20 of a turn: no small denominator, but the orbits close all the same.
    let error = split(-54.0).expect_err("no law at 7/20");
    let (SplitError::Resonance {
        numerator,
        denominator,
        ..
    }
    | SplitError::Inexact {
        numerator,
        denominator,
        ..
    }) = error
    else {
        panic!("{error}");
    };
    assert_eq!((numerator, denominator), (7, 20));
    for bend in [f64::NAN, 171.0, -1e9] {
        assert!(matches!(split(bend), Err(SplitError::Bend { .. })));
    }
}

/// Minimum convex radius of the four pitch curves of the split by powers, of a carrier that turns evenly under an arm of the
/// direction `swing sin p`: the ratio is `1 - swing cos p`. By circles through three points of each curve.
fn closed_form(leg: f64, swing: f64) -> f64 {
    const COUNT: usize = 20_000;
    let step = TAU / COUNT as f64;
    let ratio = |i: usize| 1.0 - swing * (step * i as f64).cos();
    let mean = (0..COUNT).map(|i| ratio(i).sqrt()).sum::<f64>() / COUNT as f64;
    let mut driven = vec![0.0];
    for i in 0..=COUNT {
        let middle = 1.0 - swing * (step * (i as f64 + 0.5)).cos();
        driven.push(driven[i] + middle.sqrt() / mean * step);
    }
    let polar = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
    let places = |i: usize| {
        let p = step * i as f64;
        let planet = p - swing * p.sin();
        let [one, two] = [ratio(i).sqrt() / mean, 1.0 / ratio(i).sqrt() / mean];
        [
            polar(leg * one / (1.0 + one), p),
            polar(leg / (1.0 + one), driven[i]),
            polar(leg * two / (1.0 + two), planet),
            polar(leg / (1.0 + two), driven[i]),
        ]
    };
    let mut sharpest = 0.0_f64;
    for i in 1..COUNT {
        let three = [i - 1, i, i + 1].map(places);
        for k in 0..4 {
            let [a, b, c] = three.map(|all| all[k]);
            let side = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            sharpest = sharpest.max(2.0 * area / (side(a, b) * side(b, c) * side(a, c)));
        }
    }
    1.0 / sharpest
}

/// Minimum radius of the circles through three points of the pitch curves of a machine, where they are convex.
fn rolled_radius(made: &ReversedMachine) -> f64 {
    const COUNT: usize = 20_000;
    let mut sharpest = 0.0_f64;
    for pair in made.design.pairs.values() {
        let (_, rolling) = PlannedPair::roll(pair).expect("pitch curves");
        let period = rolling.curve().period();
        for member in [Member::Driver, Member::Driven] {
            let at = |i: usize| {
                rolling
                    .frame(member, period * i as f64 / COUNT as f64)
                    .point
            };
            let points: Vec<Point> = (0..COUNT + 2).map(at).collect();
            let turned: f64 = points
                .windows(2)
                .map(|p| p[0].coords.perp(&p[1].coords))
                .sum();
            for three in points.windows(3) {
                let [a, b, c] = [three[0], three[1], three[2]];
                let area = (b - a).perp(&(c - a)) * turned.signum();
                let sides = (b - a).norm() * (c - b).norm() * (c - a).norm();
                sharpest = sharpest.max(2.0 * area / sides);
            }
        }
    }
    1.0 / sharpest
}

/// Near the position where its bars are stretched a spline through points has a law with a peak of curvature, which no gear has.
#[test]
fn the_radius_is_that_of_the_gears_written_and_no_mildest_split_is_sharper() {
    // Points, bars, swing of the arm, its direction, the carrier's, and the bend, deg.
    let neighbours = [
        (12, [90.0, 140.0], 0.2, 2.0, 0.1, 50.0),
        (12, [90.0, 140.0], 0.2, 2.0, 0.05, 50.0),
        (16, [90.0, 140.0], 0.2, 2.0, 0.1, 50.0),
        (24, [90.0, 140.0], 0.2, 2.0, 0.1, 50.0),
        (36, [90.0, 140.0], 0.2, 2.0, 0.1, 40.0),
        (48, [90.0, 140.0], 0.2, 2.0, 0.1, 50.0),
        (720, [90.0, 140.0], 0.2, 2.0, 0.1, 50.0),
        (12, [140.0, 90.0], 0.15, 1.5, 0.4, 60.0),
        (14, [70.0, 100.0], 0.1, 0.7, -0.3, 30.0),
        (18, [120.0, 60.0], 0.2, 2.6, 0.2, 20.0),
        (20, [100.0, 150.0], 0.12, 1.1, 0.9, -40.0),
        (30, [80.0, 130.0], 0.18, 2.0, 0.0, 70.0),
    ];
    for (count, [carrier, arm], swing, direction, start, bend) in neighbours {
        let case = format!("{count} {carrier} {arm} {swing} {direction} {start} {bend}");
        // Rounded points near each other are no longer those of a smooth path.
        let digits = if count < 48 { 1e3 } else { 1e9 };
        let rounded = |x: f64| (digits * x).round() / digits;
        let points = (0..count).map(|k| {
            let p = TAU * f64::from(k) / f64::from(count);
            let d = swing * p.sin() + direction;
            let (x, y) = (p + start).sin_cos();
            let (x, y) = (carrier * y + arm * d.cos(), carrier * x + arm * d.sin());
            Point::new(rounded(x), rounded(y))
        });
        let path = RequiredPath::through(&points.collect::<Vec<_>>()).expect("a path");
        let chain = TwoBar::new(&path, Point::origin(), None).expect("a chain");
        let bend = f64::to_radians(bend);
        let made = |kind| {
            let split = Split::new(&chain, kind, bend).expect("a split");
            ReversedMachine::new(&chain, &split, 1, None).expect("a machine")
        };
        let [powers, mildest] = [SplitKind::Powers, SplitKind::Mildest].map(made);
        let [written, milder] = [&powers, &mildest].map(ReversedMachine::minimum_radius);
        let closed = closed_form(0.5 * carrier / (0.5 * bend).cos(), swing);
        let on_map = PossibleAxis::from(&chain).minimum_radius(bend);
        for (made, radius) in [(&powers, written), (&mildest, milder)] {
            let rolled = rolled_radius(made);
            assert!(
                (radius / rolled - 1.0).abs() < 1e-3,
                "{case}: {radius} {rolled}"
            );
        }
        // Many points are the machine's own path; through a few the spline is another.
        if count >= 720 {
            for radius in [written, on_map] {
                assert!(
                    (radius / closed - 1.0).abs() < 1e-4,
                    "{case}: {radius} {closed}"
                );
            }
        }
        assert!(
            (on_map / written - 1.0).abs() < 0.4,
            "{case}: {on_map} {written}"
        );
        assert!(milder >= written, "{case}: {milder} {written}");
    }
}
