use std::f64::consts::{PI, TAU};

use centrode_geometry::Point;

use super::{drawn, published, published_path};
use crate::reverse::{ReversedMachine, Split, SplitError, SplitKind, TwoBar};
use crate::transmission::Transmission as _;

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
            let radii = made.least_radii.iter().flatten();
            radii.fold(f64::INFINITY, |least, r| least.min(*r))
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
