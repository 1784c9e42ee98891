use std::ops::ControlFlow;

use centrode_machines::feeder::FeederDesign;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;

use crate::optimise::feeder::FeederProblem;
use crate::optimise::three_arm::ThreeArmProblem;
use crate::optimise::{DesignProblem, DesignSearch, Strategy};
use centrode_optimise::{Ended, Settings};

fn json(search: &DesignSearch) -> String {
    serde_json::to_string(search).expect("JSON")
}

fn search(problem: &dyn DesignProblem, evaluations: u64) -> DesignSearch {
    let settings = Settings {
        evaluations,
        ..Settings::default()
    };
    DesignSearch::new(problem, Strategy::Guided, settings).expect("free parameters")
}

fn through(problem: &dyn DesignProblem, evaluations: u64) -> String {
    let mut search = search(problem, evaluations);
    search.run(problem, &mut |_| ControlFlow::Continue(()));
    json(&search)
}

/// Breaks off at every so many looks, stores the search and reads it back each time.
fn broken(problem: &dyn DesignProblem, evaluations: u64, looks: u32) -> String {
    let mut search = search(problem, evaluations);
    loop {
        let mut left = looks;
        let ended = search.run(problem, &mut |_| {
            left -= 1;
            match left {
                0 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        let stored = json(&search);
        search = serde_json::from_str(&stored).expect("a search");
        if ended != Ended::Stopped {
            return stored;
        }
    }
}

/// Uses up a first number of evaluations and is allowed the rest.
fn allowed_more(problem: &dyn DesignProblem, first: u64, evaluations: u64) -> String {
    let mut search = search(problem, first);
    search.run(problem, &mut |_| ControlFlow::Continue(()));
    let mut search: DesignSearch = serde_json::from_str(&json(&search)).expect("a search");
    search.allow(evaluations);
    search.run(problem, &mut |_| ControlFlow::Continue(()));
    json(&search)
}

fn feeder(crank: f64, angle: f64) -> FeederProblem {
    let text = include_str!("../../../../../tests/designs/feeder-2022.toml");
    let mut design = FeederDesign::from_toml(text).expect("a feeder");
    design.linkage.crank = crank;
    design.goals.transmission_angle = f64::to_radians(angle);
    FeederProblem::new(&design)
}

#[test]
fn a_guided_search_cut_in_two_is_the_search_in_one() {
    for (crank, angle) in [(78.5, 0.0), (80.0, 12.0), (77.4, 9.0), (79.3, 40.0)] {
        let problem = feeder(crank, angle);
        for (looks, first) in [(2, 20), (3, 45), (5, 61), (7, 100), (20, 203)] {
            let whole = through(&problem, 400);
            let case = format!("{crank} {angle} {looks} {first}");
            assert_eq!(broken(&problem, 400, looks), whole, "{case}");
            assert_eq!(allowed_more(&problem, first, 400), whole, "{case}");
        }
    }
}

/// Its points are evaluated side by side, by whichever thread is free.
#[test]
fn a_guided_search_of_a_three_arm_machine_gives_the_same_bytes_every_time() {
    let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("a design");
    for (start, bend) in [(60.0, -30.0), (95.0, -50.0)] {
        design.carrier_start = f64::to_radians(start);
        design.bend = f64::to_radians(bend);
        let problem = ThreeArmProblem::new(&design).expect("of the kind");
        let whole = through(&problem, 60);
        assert_eq!(through(&problem, 60), whole, "{start} {bend}");
        assert_eq!(broken(&problem, 60, 3), whole, "{start} {bend}");
        assert_eq!(allowed_more(&problem, 30, 60), whole, "{start} {bend}");
    }
}
