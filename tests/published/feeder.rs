//! The six-bar of the 2022 feeder. The published figures are in the comments next to what holds.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use centrode_analysis::six_bar::{
    BestTransmissionAngle, MinimumWidening, PUBLISHED_BOUNDS, RequiredSwing,
};
use centrode_kinematics::linkage::{Branch, FourBar, Grashof, SixBar};
use centrode_optimise::{Candidate, Method, Problem, Settings, minimise};

const PUBLISHED: [f64; 4] = [77.0, 147.0, 127.0, 105.0];

fn four_bar([crank, coupler, rocker, frame]: [f64; 4]) -> FourBar {
    FourBar::new(crank, coupler, rocker, frame, Branch::Upper).expect("lengths above zero")
}

fn on_the_chord(four_bar: &FourBar, share: f64) -> SixBar {
    let dead = four_bar.dead_centers().expect("a crank-rocker");
    let pivot = dead.folded_at + share * (dead.stretched_at - dead.folded_at);
    SixBar::new(*four_bar, pivot, 200.0).expect("a six-bar")
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

#[test]
fn dead_centers_and_strokes_of_the_published_lengths() {
    let four_bar = four_bar(PUBLISHED);
    assert_eq!(four_bar.grashof(), Grashof::CrankRocker);
    let dead = four_bar.dead_centers().expect("a crank-rocker");
    close(dead.stretched.to_degrees(), 16.63192, 5e-6);
    close(dead.folded.to_degrees(), 270.79515, 5e-6);
    close(dead.stretched_at.x, 214.628571, 5e-7);
    close(dead.stretched_at.y, 64.113776, 5e-7);
    close(dead.folded_at.x, -0.971429, 5e-7);
    close(dead.folded_at.y, 69.993259, 5e-7);
    let swing = four_bar.rocker_swing().expect("a crank-rocker");
    close(swing.to_degrees(), 116.235306, 5e-7);
    let slow = four_bar.slow_stroke().expect("a crank-rocker");
    close(slow.to_degrees(), 254.163, 5e-4);
    let quick_return = four_bar.quick_return().expect("a crank-rocker");
    close(quick_return, 2.4015, 5e-5);
}

/// The paper asks for 40 degrees (16) and calls these lengths the optimum.
#[test]
fn least_transmission_angle_of_the_published_lengths() {
    let four_bar = four_bar(PUBLISHED);
    let minimum = four_bar.minimum_transmission_angle();
    close(minimum.to_degrees(), 8.224332, 5e-7);
    close(four_bar.transmission_angle(PI).to_degrees(), 82.9016, 5e-5);
    // No crank-rocker of this rocker swing could have more than 90 - swing/2.
    let swing = four_bar.rocker_swing().expect("a crank-rocker");
    assert!(minimum < PI / 2.0 - 0.5 * swing);
}

#[test]
fn any_pivot_on_the_chord_gives_half_a_turn_for_any_lengths() {
    for lengths in [
        PUBLISHED,
        [58.25, 111.21, 96.08, 130.56],
        [80.0, 140.0, 130.0, 103.0],
        [20.0, 90.0, 60.0, 77.0],
    ] {
        for share in [0.01, 0.2, 0.5, 0.77, 0.999] {
            let six_bar = on_the_chord(&four_bar(lengths), share);
            close(six_bar.swing(), PI, 1e-12);
        }
    }
}

/// With the pivot in the middle of the chord, rounding each length by half a millimetre moves the
/// swing by 3.9 degrees to first order; near the stretched end of the chord it is several times as much.
#[test]
fn roundings_of_half_a_millimeter_move_the_swing_by_degrees() {
    let half_a_millimeter = |six_bar: &SixBar| {
        let sensitivity = six_bar.swing_sensitivity().lengths;
        0.5 * sensitivity.map(f64::abs).iter().sum::<f64>()
    };
    let six_bar = on_the_chord(&four_bar(PUBLISHED), 0.5);
    let first = half_a_millimeter(&six_bar);
    close(first.to_degrees(), 3.9, 0.05);
    let (mut minimum, mut maximum) = (0.0_f64, 0.0_f64);
    for corner in 0..16_u32 {
        let lengths =
            std::array::from_fn(|k| PUBLISHED[k] + if corner >> k & 1 == 1 { 0.5 } else { -0.5 });
        let moved = SixBar::new(four_bar(lengths), six_bar.pivot(), 200.0).expect("a six-bar");
        let change = moved.swing() - PI;
        (minimum, maximum) = (minimum.min(change), maximum.max(change));
    }
    close(maximum.to_degrees(), 4.0974, 5e-5);
    close(minimum.to_degrees(), -3.7324, 5e-5);
    let near_the_end = half_a_millimeter(&on_the_chord(&four_bar(PUBLISHED), 0.9));
    assert!(near_the_end > 4.0 * first);
}

/// Equation (4) as printed is the lower branch; there, at 200 degrees, (5) as printed has an arctangent
/// of a sine and gives -41.600 degrees, an arcsine would give -62.602.
#[test]
fn the_rocker_angle_needs_both_arguments() {
    let [crank, coupler, rocker, frame] = PUBLISHED;
    let four_bar =
        FourBar::new(crank, coupler, rocker, frame, Branch::Lower).expect("lengths above zero");
    let input = 200_f64.to_radians();
    let [_, c] = four_bar.joints(input).expect("the crank turns");
    assert!(c.point.y < 0.0, "the printed sign puts C below AD");
    let angle = four_bar.rocker_angle(input).expect("the crank turns");
    let angle = angle.position.to_degrees().rem_euclid(360.0) - 360.0;
    close(angle, -117.398, 5e-4);
    close((c.point.y / rocker).atan().to_degrees(), -41.600, 5e-4);
    close((c.point.y / rocker).asin().to_degrees(), -62.602, 5e-4);
}

fn search(
    problem: &dyn Problem,
    method: Method,
    evaluations: u64,
    target: Option<f64>,
) -> Candidate {
    let settings = Settings {
        method,
        evaluations,
        target,
        ..Settings::default()
    };
    let found = minimise(problem, settings, &mut |_| ControlFlow::Continue(()));
    found.expect("a good problem").0.best()
}

fn minimum_transmission_angle(candidate: &Candidate) -> f64 {
    90.0 - candidate.evaluation.objective.to_degrees()
}

/// No point of the published bounds (18) meets constraint (16), 40 degrees.
#[test]
fn the_best_transmission_angle_of_the_published_bounds_is_12_degrees() {
    let problem = BestTransmissionAngle {
        bounds: PUBLISHED_BOUNDS,
    };
    for method in [Method::DifferentialEvolution, Method::CmaEs] {
        let best = search(&problem, method, 40_000, None);
        assert!(best.evaluation.feasible());
        close(minimum_transmission_angle(&best), 12.312, 5e-4);
        for (found, expected) in best.point.iter().zip([77.0, 136.0, 132.872, 106.0]) {
            close(*found, expected, 2e-3);
        }
    }
}

/// Bounds widened by 24.35 % have been given as the minimum that hold 40 degrees, with the first lengths
/// below. They hold it, but 22.443 % are enough, with three lengths at their bounds.
#[test]
fn bounds_widened_by_less_than_a_quarter_hold_forty_degrees() {
    let given = four_bar([58.25, 111.21, 96.08, 130.56]);
    close(given.minimum_transmission_angle().to_degrees(), 40.0, 1e-3);
    let problem = MinimumWidening {
        bounds: PUBLISHED_BOUNDS,
        minimum_transmission_angle: 40_f64.to_radians(),
    };
    for method in [Method::DifferentialEvolution, Method::CmaEs] {
        let best = search(&problem, method, 100_000, None);
        assert!(best.evaluation.feasible());
        close(100.0 * best.evaluation.objective, 22.4432, 1e-4);
        let lengths = problem.lengths(&best.point);
        let corner = problem.widened(best.evaluation.objective);
        let corner = [corner[0].0, corner[1].0, corner[2].0, corner[3].1];
        for (found, expected) in lengths.iter().zip(corner) {
            close(*found, expected, 1e-3);
        }
        let four_bar = four_bar(lengths.try_into().expect("four of them"));
        close(
            four_bar.minimum_transmission_angle().to_degrees(),
            40.0,
            1e-6,
        );
        close(on_the_chord(&four_bar, 0.4).swing(), PI, 1e-12);
    }
}

/// With the pivot fixed, (14), (15) and (17) can be met, but not with (16).
#[test]
fn half_a_turn_is_reached_without_the_transmission_angle_and_not_with_it() {
    let mut problem = RequiredSwing {
        bounds: PUBLISHED_BOUNDS,
        pivot: on_the_chord(&four_bar([79.0, 141.0, 132.0, 103.0]), 0.4).pivot(),
        branch: Branch::Upper,
        swing: PI,
        minimum_transmission_angle: None,
    };
    for (_, method) in Method::NAMES {
        let target = 1e-6_f64.to_radians();
        let best = search(&problem, method, 100_000, Some(target));
        assert!(best.evaluation.feasible());
        assert!(best.evaluation.objective < target, "{method:?}");
    }
    problem.minimum_transmission_angle = Some(40_f64.to_radians());
    let best = search(&problem, Method::DifferentialEvolution, 20_000, None);
    assert!(!best.evaluation.feasible());
    // What is missing is what the best attainable lacks.
    let missing = best.evaluation.violation().to_degrees();
    close(missing, 40.0 - 12.312, 5e-3);
}
