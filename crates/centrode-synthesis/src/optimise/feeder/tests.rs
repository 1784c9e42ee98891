use std::f64::consts::PI;
use std::ops::ControlFlow;

use centrode_spec::DesignSpec as _;

use super::*;
use crate::optimise::{DesignSearch, Strategy};
use centrode_optimise::{Ended, Method, Settings};

fn shipped(text: &str) -> FeederDesign {
    FeederDesign::from_toml(text).expect("the shipped design is a feeder")
}

fn published() -> FeederDesign {
    shipped(include_str!(
        "../../../../../tests/designs/feeder-2022.toml"
    ))
}

/// The published bounds without constraint (16), from lengths that miss half a turn by 3.9 degrees.
fn free_of_16() -> FeederDesign {
    let mut design = published();
    design.goals.transmission_angle = 0.0;
    design.linkage.crank = 78.5;
    design
}

fn searched(design: &FeederDesign, method: Method, seed: u64) -> (Ended, Vec<f64>, FeederProblem) {
    let problem = FeederProblem::new(design);
    let settings = Settings {
        seed,
        ..Settings::default()
    };
    let search = DesignSearch::new(&problem, Strategy::Global(method), settings);
    let mut search = search.expect("free dimensions");
    let ended = search.run(&problem, &mut |_| ControlFlow::Continue(()));
    assert!(search.history().len() > 1);
    (ended, search.best(), problem)
}

#[test]
fn without_the_transmission_angle_half_a_turn_is_reached_by_every_method() {
    let design = free_of_16();
    for (name, method) in Method::NAMES {
        for seed in [1, 2, 3] {
            let (ended, best, problem) = searched(&design, method, seed);
            assert_eq!(ended, Ended::Target, "{name} {seed}");
            // The values in the file, not those of the search.
            let found = Feeder::resolve(&problem.design_at(&best)).expect("a feeder");
            let miss = (found.six_bar().swing() - PI).abs().to_degrees();
            assert!(miss < 1e-6, "{name} {seed}: {miss:e}");
            assert_eq!(found.design().linkage.pivot, design.linkage.pivot);
            let goals = problem.goals(&best).expect("a mechanism");
            assert!(goals.iter().all(|goal| goal.met() == Some(true)));
            assert_eq!(problem.remark(&best), None);
            assert_eq!(searched(&design, method, seed).1, best, "{name} {seed}");
        }
        assert_ne!(
            searched(&design, method, 1).1,
            searched(&design, method, 2).1
        );
    }
}

#[test]
fn with_it_the_search_says_infeasible_and_the_best_attainable() {
    let (ended, best, problem) = searched(&published(), Method::DifferentialEvolution, 1);
    assert_eq!(ended, Ended::Evaluations);
    let goals = problem.goals(&best).expect("a mechanism");
    let missed: Vec<&str> = goals
        .iter()
        .filter(|goal| goal.met() == Some(false))
        .map(|goal| &*goal.name)
        .collect();
    assert!(missed.contains(&"transmission-angle"), "{missed:?}");
    let violation = problem.evaluate(&best).violation().to_degrees();
    assert!((violation - (40.0 - 12.312)).abs() < 5e-3, "{violation}");
    let remark = problem.remark(&best).expect("why");
    for words in ["infeasible", "12.312 deg", "22.443 %"] {
        assert!(remark.contains(words), "{remark}");
    }
}

#[test]
fn held_dimensions_stay_and_decimals_are_kept() {
    let mut design = free_of_16();
    design.optimise.hold = vec![Dimension::Crank, Dimension::Frame];
    design.optimise.decimals = 2;
    let (_, best, problem) = searched(&design, Method::DifferentialEvolution, 1);
    let names: Vec<&str> = problem
        .variables()
        .iter()
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(names, ["coupler", "rocker"]);
    let found = problem.at(&best);
    assert_eq!((found.crank, found.frame), (78.5, 105.0));
    for length in [found.coupler, found.rocker] {
        assert_eq!(length, (length * 100.0).round() / 100.0);
    }
    // Hundredths still come within a hundredth of a degree.
    assert!(problem.evaluate(&best).objective.to_degrees() < 0.01);
}

#[test]
fn a_free_pivot_is_refused_without_a_weight_and_says_so_with_one() {
    let mut design = free_of_16();
    design.optimise.free_pivot = true;
    let refused = design.validate().expect_err("no weight");
    assert_eq!(refused.key, "optimise.pivot_weight_deg");
    assert!(refused.to_string().contains("lengths of any size"));
    design.optimise.pivot_weight = 0.1_f64.to_radians();
    design.validate().expect("a weight");
    let (_, best, problem) = searched(&design, Method::CmaEs, 1);
    assert_eq!(problem.variables().len(), 6);
    assert!(
        problem
            .remark(&best)
            .expect("how far")
            .contains("lengths of any size")
    );
    // Lengths alone reach the goal, so a weighed pivot has no reason to move.
    assert!(problem.moved(&problem.at(&best)) < 1e-3);
}

#[test]
fn lengths_that_do_not_turn_are_worst_and_can_be_stored() {
    let problem = FeederProblem::new(&published());
    let worst = problem.evaluate(&[81.0, 147.0, 127.0, 100.0]);
    assert!(worst.violation() > 1.0 && worst.objective.is_finite());
    assert!(problem.goals(&[81.0, 147.0, 127.0, 100.0]).is_none());
}

#[test]
fn the_widened_design_is_the_shipped_one() {
    let found = Widened::search(&published()).expect("found");
    assert!((100.0 * found.share - 22.4432).abs() < 1e-4);
    let shipped = shipped(include_str!(
        "../../../../../tests/designs/feeder-widened.toml"
    ));
    assert_eq!(found.design.linkage, shipped.linkage);
    assert_eq!(found.design.bounds, shipped.bounds);
    let feeder = Feeder::resolve(&found.design).expect("a feeder");
    assert!(
        feeder_goals(&feeder)
            .iter()
            .all(|goal| goal.met() == Some(true))
    );
    // A thousandth less all round does not hold it.
    let mut narrower = found.design.clone();
    for ends in [
        &mut narrower.bounds.crank,
        &mut narrower.bounds.coupler,
        &mut narrower.bounds.rocker,
        &mut narrower.bounds.frame,
    ] {
        *ends = [ends[0] + 0.002, ends[1] - 0.002];
    }
    let attainable = Attainable::search(&narrower).expect("crank-rockers");
    assert!(attainable.widening.is_some());
}

#[test]
fn bounds_that_need_no_widening_are_not_widened() {
    let mut design = published();
    design.goals.transmission_angle = 12_f64.to_radians();
    assert!(matches!(
        Widened::search(&design),
        Err(NotWidened::Needless { .. })
    ));
    design.goals.transmission_angle = 89.9_f64.to_radians();
    assert!(matches!(
        Widened::search(&design),
        Err(NotWidened::NoUse { .. })
    ));
    // No linkage within these bounds has a feed stroke fifty times as long as its return.
    let mut slow = published();
    slow.goals.transmission_angle = 12_f64.to_radians();
    slow.goals.quick_return = 50.0;
    let refused = Widened::search(&slow)
        .expect_err("nothing to widen")
        .to_string();
    assert!(
        refused.contains("crank angle of the feed stroke"),
        "{refused}"
    );
}
