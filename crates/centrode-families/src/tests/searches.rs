use std::ops::ControlFlow;

use centrode_optimise::{Ended, Settings};
use centrode_synthesis::optimise::{DesignSearch, Strategy};

use crate::FAMILIES;

/// Base radius of the start, mm: a step of a guided search below the smallest one without undercut.
const START: f64 = 48.0;

/// A disc cam that is undercut below a base radius, whatever its goal: the stroke, which no base radius changes.
fn steep(base_radius: f64) -> String {
    let cam = include_str!("../../../../tests/designs/disc-cam.toml");
    let cam = cam
        .replace("base_radius = 35", &format!("base_radius = {base_radius}"))
        .replace("\nlift = 20", "\nlift = 50")
        .replace("roller_radius = 8", "roller_radius = 20")
        .replace("span_deg = 120", "span_deg = 40")
        .replace("span_deg = 60", "span_deg = 140");
    let goal = "[goals.stroke]\nfigure = \"slide.travel\"\nover = \"span\"\nminimum = 49\n";
    format!("{cam}\n{goal}\n[vary]\n\"cams.lift.base_radius\" = [12, 90]\n")
}

#[test]
fn a_design_that_meets_its_goals_but_not_the_check_is_searched_on() {
    for (_, strategy) in Strategy::NAMES {
        for seed in 1..4 {
            let file = FAMILIES.read(steep(START).as_bytes()).expect("a design");
            let start = file.mechanism().expect("a machine").check();
            assert!(!start.ok() && start.goals.iter().all(|g| g.met() == Some(true)));
            let problem = file.family().problem(file.design()).expect("a problem");
            let settings = Settings {
                seed,
                evaluations: 400,
                ..Settings::default()
            };
            let mut search =
                DesignSearch::new(problem.as_ref(), strategy, settings).expect("a search");
            let ended = search.run(problem.as_ref(), &mut |_| ControlFlow::Continue(()));
            assert_eq!(ended, Ended::Target, "{strategy:?}");
            let best = search.best();
            let found = file.family().resolve(problem.design(&best).as_ref());
            assert!(
                found.expect("a machine").check().ok(),
                "{strategy:?}: {best:?}"
            );
            let goals = problem.goals(&best).expect("goals");
            assert!(goals.iter().all(|g| g.met() == Some(true)), "{goals:?}");
        }
    }
}

#[test]
fn errors_of_the_check_are_a_goal_that_is_missed() {
    let file = FAMILIES.read(steep(START).as_bytes()).expect("a design");
    let problem = file.family().problem(file.design()).expect("a problem");
    let start = problem.start().expect("a start");
    let goals = problem.goals(&start).expect("goals");
    let missed: Vec<_> = goals.iter().filter(|g| g.met() == Some(false)).collect();
    assert_eq!(missed.len(), 1, "{goals:?}");
    assert_eq!((&*missed[0].name, missed[0].value), ("check", Some(1.0)));
    assert!(!problem.evaluate(&start).feasible());
}
