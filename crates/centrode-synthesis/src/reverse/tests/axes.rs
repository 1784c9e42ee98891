use std::f64::consts::{PI, TAU};

use centrode_geometry::Point;

use super::{drawn, points, published, published_path};
use crate::reverse::{
    AxisFault, AxisMap, AxisRange, ChainJet, PossibleAxis, RequiredPath, ReversedMachine, Split,
    SplitKind, TwoBar,
};
use centrode_kinematics::transmission::Transmission as _;
use centrode_machines::three_arm::design::Direction;

fn chain(x: f64, y: f64) -> TwoBar {
    TwoBar::new(&drawn(), Point::new(x, y), None).expect("a chain")
}

fn fault(path: &RequiredPath, x: f64, y: f64) -> AxisFault {
    TwoBar::new(path, Point::new(x, y), None).expect_err("no chain")
}

fn ellipse(a: f64, b: f64) -> RequiredPath {
    let point = |i: u32| f64::from(i) * TAU / 60.0;
    let list: Vec<[f64; 2]> = (0..60)
        .map(point)
        .map(|t| [a * t.cos(), b * t.sin()])
        .collect();
    RequiredPath::through(&points(&list)).expect("a path")
}

#[test]
fn bars_and_ratios_of_two_axes_are_those_computed_before() {
    for (x, y, bars, ratios, shaft) in [
        (210.0, 200.0, [148.015, 146.096], [0.234, 2.489], 1.9),
        (260.0, 160.0, [125.612, 186.594], [0.5155, 2.1793], 60.982),
    ] {
        let chain = chain(x, y);
        assert!((chain.carrier() - bars[0]).abs() < 6e-4, "{chain:?}");
        assert!((chain.arm() - bars[1]).abs() < 6e-4);
        let found = chain.ratios().map(|ratio| ratio.value);
        for (found, known) in found.iter().zip(ratios) {
            assert!((found - known).abs() < 6e-4, "{found} {known}");
        }
        assert!((chain.shaft_distance() - shaft).abs() < 0.03);
    }
}

#[test]
fn the_tip_runs_along_the_path_forwards() {
    for (x, y) in [(210.0, 200.0), (260.0, 160.0)] {
        let (path, chain) = (drawn(), chain(x, y));
        let mut before = chain.at(-0.01 * path.period());
        for i in 0..3000 {
            let t = path.period() * f64::from(i) / 1000.0 - 0.005;
            let jet = chain.at(t);
            let tip = chain.tip(jet.carrier[0], jet.elbow[0]);
            let off = (tip - path.at(t).point).norm();
            assert!(off < 2e-11, "{t}: {off:e}");
            let sense = chain.direction().sign();
            assert!(sense * jet.carrier[1] > 0.0 && sense * jet.elbow[1] < 0.0);
            if i > 0 {
                let step = sense * (jet.carrier[0] - before.carrier[0]);
                assert!(step > 0.0 && step < 0.1, "{t}: {step}");
                let step = -sense * (jet.elbow[0] - before.elbow[0]);
                assert!(step > 0.0 && step < 0.1, "{t}: {step}");
            }
            before = jet;
        }
    }
}

/// At the extremes of the distance the speeds are 0/0: there, too, they are those of the angles.
#[test]
fn derivatives_are_those_of_the_angles_everywhere() {
    let chain = chain(260.0, 160.0);
    let path = drawn();
    let [far, near] = [chain.stretched(), folded(&chain)];
    let beside = [
        0.0, 1e-12, -1e-12, 1e-7, -1e-7, 1e-3, -1e-3, 0.03, -0.03, 0.3, -0.3,
    ];
    let places = beside.iter().flat_map(|h| [far + h, near + h]);
    let step = 1e-4;
    for t in places.chain((0..130).map(|i| 0.1 * f64::from(i) + 0.05)) {
        let [low, here, high] = [t - step, t, t + step].map(|t| chain.at(t));
        for angle in [|j: &ChainJet| j.carrier, |j: &ChainJet| j.elbow] {
            let (low, here, high) = (angle(&low), angle(&here), angle(&high));
            let speed = (high[0] - low[0]) / (2.0 * step);
            assert!((speed - here[1]).abs() < 1e-7, "{t}: {speed} {here:?}");
            let second = (high[1] - low[1]) / (2.0 * step);
            assert!((second - here[2]).abs() < 1e-3, "{t}: {second} {here:?}");
        }
        // The quick formula for the speeds is another one.
        let quick = chain.speeds(t, &path.at(t));
        let slow = [here.carrier[1], -here.elbow[1]].map(|x| x * chain.direction().sign());
        for (quick, slow) in quick.iter().zip(slow) {
            assert!((quick / slow - 1.0).abs() < 1e-11, "{t}: {quick} {slow}");
        }
    }
}

/// Speeds with two derivatives, next to both extremes too, where they are limits.
#[test]
fn derivatives_of_the_speeds_are_those_of_the_speeds() {
    let (chain, path) = (chain(260.0, 160.0), drawn());
    let [far, near] = [chain.stretched(), folded(&chain)];
    let beside = [0.0, 1e-9, -1e-9, 1e-5, -2e-4, 3e-3, -0.02, 0.3];
    let places = beside.iter().flat_map(|h| [far + h, near + h]);
    let step = 1e-3;
    for t in places.chain((0..130).map(|i| 0.1 * f64::from(i) + 0.05)) {
        // The third derivative of the path jumps at whole numbers.
        if (t - t.round()).abs() < 2.0 * step {
            continue;
        }
        let series = chain.speed_series::<3>(t, &path.at(t));
        let at = |t: f64| chain.speeds(t, &path.at(t));
        let [low, here, high] = [t - step, t, t + step].map(at);
        for k in 0..2 {
            let [value, slope, bend, _] = series[k].derivatives();
            assert_eq!(value, here[k]);
            let first = (high[k] - low[k]) / (2.0 * step);
            let second = (high[k] - 2.0 * here[k] + low[k]) / (step * step);
            assert!(
                (first - slope).abs() < 2e-5 * (1.0 + slope.abs()),
                "{t}: {first} {slope}"
            );
            assert!(
                (second - bend).abs() < 2e-3 * (1.0 + bend.abs()),
                "{t}: {second} {bend}"
            );
        }
    }
}

/// The pitch curves of the machine made are rolled from tables of its laws.
#[test]
fn the_least_radius_is_that_of_the_pitch_curves_rolled() {
    for (x, y) in [(210.0, 200.0), (260.0, 160.0)] {
        let (chain, bend) = (chain(x, y), 40.0_f64.to_radians());
        let found = chain.minimum_radius(bend);
        let split = Split::new(&chain, SplitKind::Powers, bend).expect("a split");
        let made = ReversedMachine::new(&chain, &split, 1, Some(5000)).expect("a machine");
        let rolled = made.minimum_radii.iter().flatten();
        let rolled = rolled.fold(f64::INFINITY, |minimum, r| minimum.min(*r));
        assert!((found / rolled - 1.0).abs() < 2e-4, "{found} {rolled}");
        // The sharpness is that of axes one apart.
        let sharpest = chain.sharpness();
        let leg = 0.5 * chain.carrier() / (0.5 * bend).cos();
        assert!((leg / sharpest.value - found).abs() < 1e-12 * found);
    }
}

fn folded(chain: &TwoBar) -> f64 {
    // Where the arm has made half a turn.
    let inverse = chain.by_planet().expect("a law");
    inverse.at(chain.direction().sign() * PI).position
}

#[test]
fn the_total_law_grows_by_a_turn_and_its_speed_is_the_ratio() {
    let chain = chain(210.0, 200.0);
    let law = chain.law().expect("a law");
    let [minimum, maximum] = chain.ratios();
    let mut range = [f64::INFINITY, 0.0_f64];
    for i in 0..4000 {
        let t = 13.0 * f64::from(i) / 4000.0;
        let jet = chain.at(t);
        let found = law.at(jet.carrier[0]);
        assert!((found.position + jet.elbow[0]).abs() < 1e-12);
        let ratio = -jet.elbow[1] / jet.carrier[1];
        assert!((found.velocity - ratio).abs() < 1e-7, "{t}");
        range = [range[0].min(ratio), range[1].max(ratio)];
    }
    assert!(law.advance() == TAU && law.period() == TAU);
    assert!((range[0] - minimum.value).abs() < 1e-4 && range[0] >= minimum.value);
    assert!((range[1] - maximum.value).abs() < 1e-4 && range[1] <= maximum.value);
}

#[test]
fn bars_and_angles_of_the_published_machine_come_back_from_its_path() {
    let (machine, path) = (published(), published_path());
    let chain = TwoBar::new(&path, Point::origin(), None).expect("a chain");
    let bend = machine.train().bend();
    let carrier = 2.0 * machine.center_distance() * (0.5 * bend).cos();
    assert!((carrier - 146.8522).abs() < 5e-5);
    assert!((chain.carrier() - carrier).abs() < 1e-9);
    assert!((chain.arm() - 145.0).abs() < 1e-9);
    assert_eq!(chain.direction(), Direction::Clockwise);
    let turn = |angle: f64| angle - TAU * (angle / TAU).round();
    for i in 0..500 {
        let theta = TAU * f64::from(i) / 500.0;
        let train = machine.train().at(theta);
        let jet = chain.at(theta);
        let direction = train.carrier.position + 0.5 * bend;
        assert!(turn(jet.carrier[0] - direction).abs() < 1e-10, "{theta}");
        assert!((jet.carrier[1] + 1.0).abs() < 1e-9, "{theta}: {jet:?}");
        let arm = train.arm.position + machine.design().arm.mounting_angle;
        assert!(turn(jet.carrier[0] + jet.elbow[0] - arm).abs() < 1e-10);
    }
}

#[test]
fn the_map_of_the_drawn_path_has_both_kinds_of_axes() {
    let range = AxisRange {
        x: [-60.0, 260.0],
        y: [-20.0, 340.0],
        count: [33, 37],
    };
    let path = drawn();
    let map = AxisMap::new(&path, range);
    let longer = |axis: &&PossibleAxis| axis.carrier > axis.arm;
    let inside = map.found().iter().flatten().filter(longer).count();
    let outside = map.possible() - inside;
    // About 90 and about 440 by another program.
    assert_eq!((inside, outside), (93, 421));
    for (n, found) in map.found().iter().enumerate() {
        if found.is_ok() {
            turns_one_way(&path, range.axis(n as u32 % 33, n as u32 / 33));
        }
    }
    // In the map nearly as at the position itself: there averaged over a step of a table.
    for (x, y) in [(15, 20), (30, 18), (32, 18)] {
        let axis = range.axis(x, y);
        let found = &map.found()[(y * 33 + x) as usize];
        let (Ok(found), Ok(chain)) = (found, TwoBar::new(&path, axis, None)) else {
            continue;
        };
        let [one, other] = [found.minimum_radius(0.7), chain.minimum_radius(0.7)];
        assert!((one / other - 1.0).abs() < 0.05, "{one} {other}");
    }
    let mildest = map.mildest(&path).expect("a chain");
    let of_grid = map.found().iter().flatten();
    let of_grid = of_grid.map(|axis| axis.unevenness());
    assert!(mildest.unevenness() < of_grid.fold(f64::INFINITY, f64::min));
    // No place a little next to it is milder.
    for i in 0..12 {
        let (sin, cos) = (f64::from(i) * PI / 6.0).sin_cos();
        let axis = mildest.axis() + centrode_geometry::Vector::new(cos, sin) * 0.01;
        // It may lie on the bounds of the search.
        if axis.x > 260.0 || axis.x < -60.0 || axis.y > 340.0 || axis.y < -20.0 {
            continue;
        }
        let beside = TwoBar::new(&path, axis, None).map(|chain| chain.unevenness());
        assert!(beside.is_err() || beside.is_ok_and(|u| u > mildest.unevenness() - 1e-9));
    }
}

/// Both bars turn in one direction at many samples, and put the tip on the path.
fn turns_one_way(path: &RequiredPath, axis: Point) {
    let chain = TwoBar::new(path, axis, None).expect("a chain");
    let sense = chain.direction().sign();
    let mut before = chain.at(0.0);
    for i in 1..=520 {
        let t = 0.025 * f64::from(i);
        let now = chain.at(t);
        assert!(
            sense * (now.carrier[0] - before.carrier[0]) > 0.0,
            "{axis} {t}"
        );
        assert!(sense * (before.elbow[0] - now.elbow[0]) > 0.0, "{axis} {t}");
        let off = chain.tip(now.carrier[0], now.elbow[0]) - path.at(t).point;
        assert!(off.norm() < 1e-9, "{axis} {t}");
        before = now;
    }
    let turned = before.carrier[0] - chain.at(0.0).carrier[0];
    assert!((turned - sense * TAU).abs() < 1e-12, "{axis}");
}

#[test]
fn places_that_are_no_axis_are_refused_with_the_reason() {
    let path = drawn();
    assert!(matches!(
        fault(&path, f64::NAN, 0.0),
        AxisFault::NotFinite { .. }
    ));
    assert!(matches!(
        fault(&path, 0.0, f64::INFINITY),
        AxisFault::NotFinite { .. }
    ));
    let AxisFault::Extremes { maxima } = fault(&ellipse(100.0, 50.0), 0.0, 0.0) else {
        panic!("two maximum distances");
    };
    assert_eq!(maxima.len(), 2);
    assert!(maxima.iter().all(|p| (p.x.abs() - 100.0).abs() < 1e-9));
    assert!(matches!(
        fault(&ellipse(100.0, 100.0), 0.0, 0.0),
        AxisFault::Circle { .. } | AxisFault::Extremes { .. }
    ));
    assert!(matches!(
        fault(&ellipse(100.0, 99.0), 100.0, 0.0),
        AxisFault::OnAxis { .. } | AxisFault::Extremes { .. }
    ));
    let outside = TwoBar::new(&path, Point::new(260.0, 160.0), None).expect("a chain");
    let inside = chain(210.0, 200.0);
    let (carrier, arm) = (
        outside.carrier() < outside.arm(),
        inside.carrier() > inside.arm(),
    );
    assert!(carrier && arm);
    let against = Some(match inside.direction() {
        Direction::Clockwise => Direction::CounterClockwise,
        Direction::CounterClockwise => Direction::Clockwise,
    });
    let error = TwoBar::new(&path, Point::new(210.0, 200.0), against).expect_err("no chain");
    assert!(matches!(error, AxisFault::Sense { .. }), "{error}");
    let turning = fault(&path, 150.0, 250.0);
    assert!(!turning.to_string().is_empty());
}
