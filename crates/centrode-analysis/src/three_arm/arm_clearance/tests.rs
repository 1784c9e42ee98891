use super::*;
use centrode_gear::pitch::{Bspline, PitchSpec};
use centrode_geometry::Point;
use centrode_machines::arm::ArmBodySpec;
use centrode_machines::three_arm::design::{ArmSpec, ThreeArmDesign, Unpicked};

/// The set of section 4.1 of the 2021 paper, read as a quadratic B-spline in the polar plane.
fn published(arms: u32) -> ThreeArm {
    let radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24];
    let angle = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345];
    let pitch = PitchSpec::Bspline(Bspline {
        degree: 2,
        radius: radius.map(f64::from).to_vec(),
        angle: angle.map(|deg| f64::from(deg).to_radians()).to_vec(),
        ..Bspline::default()
    });
    let arm = ArmSpec::new(-29_f64.to_radians(), 145.0, 65.0);
    let mut design = ThreeArmDesign::new(pitch, 86_f64.to_radians(), -53_f64.to_radians(), arm);
    design.arms = arms;
    ThreeArm::resolve(&design).expect("a mechanism")
}

fn default_arm() -> ArmBody {
    ArmBody::new(&ArmBodySpec::default(), 145.0, 65.0, 60.0).expect("an arm")
}

fn tolerance(mm: f64) -> Tolerance {
    Tolerance::new(mm).expect("positive")
}

/// Distance of two polygons that do not overlap, corners against edges; no code of the search.
fn brute(a: &[Point], b: &[Point]) -> f64 {
    let to_edge = |p: &Point, c: &Point, d: &Point| {
        let t = ((p - c).dot(&(d - c)) / (d - c).norm_squared()).clamp(0.0, 1.0);
        (p - (c + (d - c) * t)).norm()
    };
    let one_way = |a: &[Point], b: &[Point]| {
        let edges = || b.iter().zip(b.iter().cycle().skip(1));
        let distances = a
            .iter()
            .flat_map(|p| edges().map(move |(c, d)| to_edge(p, c, d)));
        distances.fold(f64::INFINITY, f64::min)
    };
    one_way(a, b).min(one_way(b, a))
}

/// An outline carried by the machine's own link, in the machine's frame.
fn posed(machine: &ThreeArm, outline: &[Point], arm: u32, input: f64) -> Vec<Point> {
    let link = machine.link(ThreeArmLink::Arm(arm), input);
    outline.iter().map(|p| link.point(*p).position).collect()
}

#[test]
fn the_clearance_along_the_turn_has_the_least_one_and_is_that_of_the_outlines() {
    let (machine, arm) = (published(3), default_arm());
    let fine = tolerance(1e-3);
    let whole = ArmClearance::analyse(&machine, &arm, fine).expect("finite");
    let course = ArmClearanceCourse::analyse(&machine, &arm, fine, 90).expect("finite");
    let minimum = |list: &[f64]| list.iter().copied().fold(f64::INFINITY, f64::min);
    let off = minimum(&course.arms) - whole.arms.expect("three arms").minimum;
    assert!(off.abs() < 2e-3, "{off}");
    let off = minimum(&course.tray) - whole.tray.expect("a tray").minimum;
    assert!(off.abs() < 2e-3, "{off}");
    let corners: Vec<Point> = arm.outline().flatten(fine);
    for i in (0..90).step_by(7) {
        let looks = (0..=20).map(|j| course.input[i] + TAU / 90.0 * (f64::from(j) / 20.0 - 0.5));
        let seen = looks
            .map(|input| {
                let first = posed(&machine, &corners, 0, input);
                brute(&first, &posed(&machine, &corners, 1, input))
            })
            .fold(f64::INFINITY, f64::min);
        let over = seen - course.arms[i];
        assert!(
            (-2e-3..0.2).contains(&over),
            "{over} at {}",
            course.input[i]
        );
    }
    let single = ArmClearanceCourse::analyse(&published(1), &arm, fine, 4).expect("finite");
    assert!(single.arms.is_empty() && single.tray.len() == 4);
}

#[test]
fn the_published_arms_are_clear_of_each_other() {
    let (machine, arm) = (published(3), default_arm());
    let found = between_arms(&machine, &arm, tolerance(1e-2)).expect("finite");
    let found = found.expect("three arms");
    // Our arm in the paper's mechanism: the paper draws its arms without dimensions.
    assert!((found.minimum - 62.627).abs() < 0.01, "{found:?}");
    assert!(
        (0.0..0.0301).contains(&(found.minimum - found.lower_bound)),
        "{found:?}"
    );
    // All three pairs in the machine's frame, by samples.
    let outline = arm.outline().flatten(tolerance(1e-2));
    for pair in [[0, 1], [1, 2], [2, 0]] {
        let mut sampled = f64::INFINITY;
        for i in 0..1440 {
            let input = TAU * f64::from(i) / 1440.0;
            let [a, b] = pair.map(|arm| posed(&machine, &outline, arm, input));
            sampled = sampled.min(brute(&a, &b));
        }
        assert!(sampled > found.lower_bound, "{pair:?} {sampled}");
        assert!(
            (sampled - found.minimum).abs() < 0.03,
            "{pair:?} {sampled} {found:?}"
        );
    }
}

#[test]
fn arms_too_long_overlap_and_one_arm_is_alone() {
    let long = ArmBody::new(&ArmBodySpec::default(), 320.0, 65.0, 60.0).expect("an arm");
    let found = between_arms(&published(3), &long, tolerance(1e-2)).expect("finite");
    assert!(
        found.is_some_and(|c| c.minimum < -1.0 && c.lower_bound <= c.minimum),
        "{found:?}"
    );
    assert_eq!(
        between_arms(&published(1), &default_arm(), tolerance(1e-2)),
        Ok(None)
    );
    // With more arms between the same axes the gap closes, neighbours first.
    let mut before = f64::INFINITY;
    for arms in 2..=6 {
        let found = between_arms(&published(arms), &default_arm(), tolerance(1e-2));
        let found = found.expect("finite").expect("several arms");
        assert!(
            found.minimum < before && found.pair == [0, 1],
            "{arms} {found:?}"
        );
        before = found.minimum;
    }
}

#[test]
fn tray_and_stems_are_where_the_machine_has_them() {
    let (machine, arm) = (published(3), default_arm());
    let found = ArmClearance::analyse(&machine, &arm, tolerance(1e-2)).expect("finite");
    assert_eq!(
        found.arms,
        between_arms(&machine, &arm, tolerance(1e-2)).expect("finite")
    );
    let samples = (0..7200).map(|i| TAU * f64::from(i) / 7200.0);
    // The tray's surface is vertical here: only how far right the housing reaches counts.
    let housing = arm.parts()[0].outline.flatten(tolerance(1e-2));
    let surface = machine.tip(machine.picking(0), 0).position.x;
    let right = |input: f64| {
        let points = posed(&machine, &housing, 0, input);
        points.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max)
    };
    let gap = samples
        .clone()
        .map(|input| surface - right(input))
        .fold(f64::INFINITY, f64::min);
    let tray = found.tray.expect("a tray");
    assert!((tray.minimum - gap).abs() < 0.03, "{tray:?} {gap}");
    // Over ground, stems are fixed where the tips of the arms before were at planting.
    let outline = arm.outline().flatten(tolerance(1e-2));
    let spec = &machine.design().seedling;
    let spacing = machine.design().work.plant_spacing;
    let release = machine.planting(0);
    let planted = machine
        .over_ground(&machine.tip(release, 0), release)
        .position
        .x;
    let stem = |before: u32| {
        let x = planted - machine.advance().signum() * f64::from(before) * spacing;
        let (low, half) = (machine.ground(), 0.5 * spec.width);
        [
            [-half, 0.0],
            [half, 0.0],
            [half, spec.height],
            [-half, spec.height],
        ]
        .map(|[dx, dy]| Point::new(x + dx, low + dy))
    };
    let mut minimum = f64::INFINITY;
    for input in samples.map(|input| input + release - PI).step_by(4) {
        let link = machine.link(ThreeArmLink::Arm(0), input);
        let over = |p: &Point| machine.over_ground(&link.point(*p), input).position;
        let points: Vec<_> = outline.iter().map(over).collect();
        for before in 1..=3 {
            minimum = minimum.min(brute(&points, &stem(before)));
        }
    }
    let seedlings = found.seedlings.expect("stems");
    assert!(
        (seedlings.minimum - minimum).abs() < 0.05,
        "{seedlings:?} {minimum}"
    );
}

/// The row above is a hole's spacing over the picked one, its stems square to a vertical tray.
#[test]
fn the_arm_bends_the_row_above_by_as_much_as_samples_say() {
    let (mut design, arm) = (published(3).design().clone(), default_arm());
    design.work.picking = Some(20_f64.to_radians());
    let machine = ThreeArm::resolve(&design).expect("a mechanism");
    let outline = arm.outline().flatten(tolerance(1e-3));
    let picked = machine.tip(machine.picking(0), 0).position;
    let row = |spacing: f64, length: f64| {
        [[-length, -2.0], [0.0, -2.0], [0.0, 2.0], [-length, 2.0]]
            .map(|[x, y]| picked + Vector::new(x, y + spacing))
    };
    let found = ArmClearance::analyse(&machine, &arm, tolerance(1e-2)).expect("finite");
    let unpicked = found.unpicked.expect("stems");
    assert!((unpicked.minimum + 7.7).abs() < 0.1, "{unpicked:?}");
    // The deepest point lies on the border of one and so far inside the other.
    let deepest = unpicked.points[0];
    let arm_there = posed(&machine, &outline, 0, unpicked.input);
    let off = [arm_there.as_slice(), &row(20.0, 60.0)].map(|border| brute(&[deepest], border));
    assert!(off[0].min(off[1]) < 0.02, "{off:?}");
    assert!(
        (off[0].max(off[1]) + unpicked.minimum).abs() < 0.03,
        "{off:?} {unpicked:?}"
    );
    // With rows far enough apart, or shorter stems, samples find the clearance.
    for (spacing, length) in [(40.0, 60.0), (60.0, 25.0)] {
        let mut design = machine.design().clone();
        design.tray.hole_spacing = spacing;
        design.tray.stem_length = length;
        let wide = ThreeArm::resolve(&design).expect("a mechanism");
        let found = ArmClearance::analyse(&wide, &arm, tolerance(1e-2)).expect("finite");
        let unpicked = found.unpicked.expect("stems");
        let row = row(spacing, length);
        let samples = (0..3600).map(|i| posed(&wide, &outline, 0, TAU * f64::from(i) / 3600.0));
        let minimum = samples
            .map(|points| brute(&points, &row))
            .fold(f64::INFINITY, f64::min);
        assert!(
            (unpicked.minimum - minimum).abs() < 0.05,
            "{spacing}: {unpicked:?} {minimum}"
        );
        assert!(unpicked.minimum > 0.0);
    }
    for (rows, expected) in [(Unpicked::None, false), (Unpicked::Below, true)] {
        let mut design = machine.design().clone();
        design.tray.unpicked = rows;
        let other = ThreeArm::resolve(&design).expect("a mechanism");
        let found = ArmClearance::analyse(&other, &arm, tolerance(1e-2)).expect("finite");
        assert_eq!(found.unpicked.is_some(), expected);
    }
}

/// Minimum distance over inputs near one, by ever finer samples: no code of the search.
fn sharpened(apart: impl Fn(f64) -> f64, middle: f64) -> f64 {
    let (mut middle, mut reach, mut minimum) = (middle, 0.02, f64::INFINITY);
    while reach > 1e-7 {
        for i in -8..=8 {
            let input = middle + reach * f64::from(i) / 8.0;
            let here = apart(input);
            if here < minimum {
                (minimum, middle) = (here, input);
            }
        }
        reach *= 0.25;
    }
    minimum
}

#[test]
fn the_least_clearance_is_that_of_the_outlines_to_within_the_tolerance() {
    let (machine, arm) = (published(3), default_arm());
    let fine = arm.outline().flatten(tolerance(1e-4));
    let apart = |input: f64| {
        let [a, b] = [0, 1].map(|arm| posed(&machine, &fine, arm, input));
        brute(&a, &b)
    };
    let close = between_arms(&machine, &arm, tolerance(1e-4)).expect("finite");
    let truth = sharpened(apart, close.expect("three arms").input);
    for tol in [4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.02, 0.005] {
        let found = between_arms(&machine, &arm, tolerance(tol)).expect("finite");
        let found = found.expect("three arms");
        let over = found.minimum - truth;
        assert!(over.abs() <= tol, "{over} at {tol}");
        assert!(found.lower_bound <= truth + 2e-4, "{found:?} {truth}");
        assert!(
            found.minimum - found.lower_bound <= tol,
            "{found:?} at {tol}"
        );
    }
}
