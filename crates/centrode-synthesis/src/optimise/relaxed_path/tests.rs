use std::f64::consts::PI;

use crate::reverse::RequiredDirection;

use super::*;

const DRAWN: [[f64; 2]; 13] = [
    [0.0, 0.0],
    [60.0, 70.0],
    [150.0, 150.0],
    [230.0, 215.0],
    [262.0, 262.0],
    [235.0, 300.0],
    [170.0, 330.0],
    [100.0, 330.0],
    [40.0, 300.0],
    [-5.0, 250.0],
    [-30.0, 190.0],
    [-38.0, 130.0],
    [-30.0, 60.0],
];

fn easing(band: f64, axis: [f64; 2]) -> Easing {
    let points: Vec<Point> = DRAWN.iter().map(|&p| p.into()).collect();
    let bend = 40.0_f64.to_radians();
    let spec = EasingSpec {
        axis: Some(axis.into()),
        ..EasingSpec::new(&[band], bend)
    };
    Easing::new(&points, &spec).expect("a machine")
}

fn search(easing: &Easing, required: Option<f64>) -> EasedPath {
    let found = easing.search(required, &mut |_| ControlFlow::Continue(()));
    found.expect("a path")
}

#[test]
fn within_a_band_gears_grow_blunter_and_no_point_leaves_it() {
    let easing = easing(5.0, [260.0, 160.0]);
    let found = search(&easing, None);
    let (before, after) = found.module;
    let before = before.expect("the wanted path has a machine");
    assert!(after > 1.5 * before, "{before} {after}");
    assert!(found.moved.iter().all(|&moved| moved <= 5.0 + 1e-12));
    // The eased path passes its own points.
    let path = found.chain.path();
    for (i, point) in found.points.iter().enumerate() {
        assert!((path.at(i as f64).point - point).norm() < 1e-9);
    }
    let axis = found.chain.axis();
    assert!((axis.x, axis.y) == (260.0, 160.0));
}

#[test]
fn a_band_as_wide_as_the_path_is_no_worse_than_a_narrow_one() {
    let [narrow, wide] = [5.0, 200.0].map(|band| search(&easing(band, [260.0, 160.0]), None));
    assert!(wide.module.1 > narrow.module.1, "{:?}", wide.module);
}

#[test]
fn wishes_out_of_reach_are_missed_by_no_more_within_a_wider_band() {
    missed_by_no_more_within([25.0, 100.0]);
}

#[test]
#[ignore = "a campaign"]
fn wishes_out_of_reach_are_missed_by_no_more_within_wider_bands() {
    missed_by_no_more_within([0.0, 25.0, 100.0, 200.0]);
}

fn missed_by_no_more_within<const N: usize>(bands: [f64; N]) {
    let points: Vec<Point> = DRAWN.iter().map(|&p| p.into()).collect();
    let direction = |point: usize, direction: f64| RequiredDirection {
        point,
        direction,
        tolerance: RequiredDirection::usual_tolerance(),
    };
    let wishes = Wishes {
        directions: vec![direction(1, 0.0), direction(5, 0.5 * PI)],
        ..Wishes::default()
    };
    let missed = bands.map(|band| {
        let spec = EasingSpec {
            wishes: wishes.clone(),
            ..EasingSpec::new(&[band], 40.0_f64.to_radians())
        };
        let found = search(&Easing::new(&points, &spec).expect("a machine"), None);
        let goals = found.goals.iter();
        goals.fold(0.0_f64, |most, goal| most.max(-goal.margin.unwrap_or(0.0)))
    });
    // A search finds no more than it finds.
    assert!(
        missed.windows(2).all(|pair| pair[1] < pair[0] + 0.05),
        "{missed:?}"
    );
}

#[test]
fn a_module_wanted_is_reached_with_less_than_the_whole_band() {
    let easing = easing(5.0, [260.0, 160.0]);
    let all = search(&easing, None);
    let (Some(before), after) = all.module else {
        panic!("the wanted path has a machine");
    };
    let required = 0.5 * (before + after);
    let some = search(&easing, Some(required));
    let most = |path: &EasedPath| path.moved.iter().fold(0.0_f64, |most, m| most.max(*m));
    assert!(some.module.1 >= required);
    assert!(
        most(&some) < 0.8 * most(&all),
        "{} {}",
        most(&some),
        most(&all)
    );
    let beyond = search(&easing, Some(100.0 * after));
    assert!((beyond.module.1 / after - 1.0).abs() < 1e-9);
}

#[test]
fn many_points_move_along_harmonics() {
    let points: Vec<Point> = (0..200)
        .map(|i| {
            let t = TAU * f64::from(i) / 200.0;
            Point::new(t.cos() * (300.0 + 100.0 * t.cos()), 200.0 * t.sin())
        })
        .collect();
    let easing = Easing::new(&points, &EasingSpec::new(&[3.0], 1.0)).expect("a machine");
    let found = search(&easing, None);
    assert!(found.module.0.is_none_or(|before| found.module.1 > before));
    assert!(found.moved.iter().all(|&moved| moved < 3.0));
    assert!(found.moved.iter().any(|&moved| moved > 0.5));
}

#[test]
fn what_is_no_band_is_told() {
    let points: Vec<Point> = DRAWN.iter().map(|&p| p.into()).collect();
    let fault =
        |bands: &[f64]| Easing::new(&points, &EasingSpec::new(bands, 1.0)).expect_err("no bands");
    let stated = "the band of point 1 must be zero or more, in mm, not -1.0";
    assert_eq!(fault(&[-1.0]).to_string(), stated);
    let stated = "there are 2 bands for 13 points: give one for each, or one for all";
    assert_eq!(fault(&[1.0, 2.0]).to_string(), stated);
    let mut bands = [1.0; 13];
    bands[4] = f64::NAN;
    assert!(fault(&bands).to_string().contains("point 5"));
    let none = easing(5.0, [260.0, 160.0]);
    let none = none.search(Some(0.0), &mut |_| ControlFlow::Continue(()));
    assert!(none.is_err());
}

/// Of the drawn path the stroke from the lower left corner upwards; the way back is free.
#[test]
fn a_free_return_is_found_and_the_stroke_is_kept() {
    let stroke: Vec<Point> = DRAWN[..6].iter().map(|&p| p.into()).collect();
    let bend = 40.0_f64.to_radians();
    let easing =
        Easing::with_free_return(&stroke, &EasingSpec::new(&[0.0], bend)).expect("a return");
    let found = search(&easing, None);
    assert_eq!(found.points[..6], stroke[..]);
    assert_eq!(found.moved, [0.0; 6]);
    assert!(found.points.len() > 9 && found.module.0.is_none());
    // The whole drawn path bears 0.11 mm with the axis that suits it.
    assert!(found.module.1 > 1.0, "{:?}", found.module);
    let path = found.chain.path();
    for (i, point) in stroke.iter().enumerate() {
        assert!((path.at(i as f64).point - point).norm() < 1e-9);
    }
    let few = Easing::with_free_return(&stroke[..2], &EasingSpec::new(&[0.0], bend))
        .expect_err("too few");
    let stated = "the working part of a path must have 3 points or more, not 2";
    assert_eq!(few.to_string(), stated);
    let nowhere = EasingSpec {
        axis: Some(Point::new(150.0, 150.0)),
        ..EasingSpec::new(&[0.0], bend)
    };
    let none = Easing::with_free_return(&stroke, &nowhere).expect_err("no machine");
    assert!(none.to_string().contains("6 returns tried"), "{none}");
}
