use centrode_spec::DesignSpec as _;

use super::*;
use crate::optimise::{DesignSearch, Strategy};
use centrode_analysis::check_three_arm;
use centrode_optimise::{Ended, Method, Settings, minimise};
use std::ops::ControlFlow;

fn template() -> ThreeArmDesign {
    ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("a good design")
}

fn problem(design: &ThreeArmDesign) -> ThreeArmProblem {
    ThreeArmProblem::new(design).expect("of the kind")
}

/// A gentle sun far from any limit: a shallow wave with twelve control points.
fn gentle() -> ThreeArmDesign {
    let mut design = template();
    if let centrode_gear::pitch::PitchSpec::Bspline(spline) = &mut design.pitch {
        for (radius, angle) in spline.radius.iter_mut().zip(&spline.angle) {
            *radius = 40.0 + 4.0 * (angle - 1.0).sin();
        }
    }
    design
}

#[test]
fn the_start_is_the_design_itself() {
    let design = template();
    let problem = problem(&design);
    let start = problem.start().expect("a start");
    assert_eq!(start.len(), problem.bounds().len());
    let again = problem.design(&start);
    let again: &ThreeArmDesign = again.downcast_ref().expect("a three-arm mechanism");
    assert_eq!(again.pitch, design.pitch);
    assert_eq!(again.tooth_count, Some(37));
    assert!(problem.moved(&start) < 1e-12);
    // The published set misses only the goals of sound teeth and of the contact of full teeth.
    let goals = problem.goals(&start).expect("a mechanism");
    let missed: Vec<_> = goals
        .iter()
        .filter(|g| g.met() == Some(false))
        .map(|g| &*g.name)
        .collect();
    assert_eq!(
        missed,
        ["sound-teeth", "transmission-error", "tooth-findings"]
    );
}

#[test]
fn what_is_met_in_the_search_is_met_in_the_check() {
    let design = gentle();
    let problem = problem(&design);
    let start = problem.start().expect("a start");
    let settled = problem.design(&start);
    let settled = settled.downcast_ref().expect("a three-arm mechanism");
    let mechanism = ThreeArm::resolve(settled).expect("a mechanism");
    let report = check_three_arm(&mechanism);
    let goals = problem.goals(&start).expect("a mechanism");
    assert_eq!(report.goals.len() + 6, goals.len());
    for (ours, checked) in goals.iter().zip(&report.goals) {
        assert_eq!((&ours.name, ours.value), (&checked.name, checked.value));
    }
    // As many teeth as leave the required module, and not one more.
    let module = mechanism.module().expect("teeth");
    let z = f64::from(settled.tooth_count.expect("follows"));
    assert!(module >= 2.5 && module * z / (z + 1.0) < 2.5, "{module}");
    let sound = goals
        .iter()
        .find(|g| g.name == "sound-teeth")
        .and_then(Goal::met);
    assert_eq!(sound, Some(true));
    // An evaluation breaks exactly the goals that are missed.
    let broken = goals.iter().filter(|g| g.met() != Some(true)).count();
    let evaluation = problem.evaluate(&start);
    assert_eq!(evaluation.feasible(), broken == 0, "{goals:?}");
}

#[test]
fn points_without_a_mechanism_are_worst() {
    let problem = problem(&template());
    let mut point = problem.start().expect("a start");
    let last = problem
        .variables()
        .iter()
        .position(|v| v.name == "theta1")
        .expect("free");
    point[last] = 3.0;
    let worst = problem.evaluate(&point);
    assert!(worst.violation() >= 1e3 && !worst.objective.is_nan());
    assert!(problem.goals(&point).is_none() && problem.guides(&point).is_none());
}

#[test]
fn bounds_and_held_parameters_are_those_of_the_design() {
    let mut design = template();
    let spec = &mut design.optimise;
    spec.bounds.insert(Parameter::Radius(0), [15.0, 27.0]);
    spec.hold = (0..12).map(Parameter::Angle).collect();
    spec.hold.push(Parameter::TipDistance);
    let problem = problem(&design);
    let names: Vec<&str> = problem
        .variables()
        .iter()
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(names.len(), 12 + 6);
    assert!(!names.contains(&"tip_distance") && !names.contains(&"theta3"));
    assert_eq!(problem.variables()[0].bounds, [15.0, 27.0]);
}

#[test]
fn values_are_written_on_a_grid() {
    let variable = Variable {
        name: "bend".into(),
        key: "bend_deg".into(),
        bounds: [-1.0, 0.0],
        is_angle: true,
        decimals: 3,
    };
    assert_eq!(variable.written(-53.123_456_f64.to_radians()), -53.123);
    assert_eq!(
        variable.rounded(-53.123_456_f64.to_radians()),
        (-53.123_f64).to_radians()
    );
}

/// The shipped design that reaches every goal.
fn shipped() -> ThreeArmDesign {
    let text = include_str!("../../../../../tests/designs/three-arm-all-goals.toml");
    ThreeArmDesign::from_toml(text).expect("the shipped design is a three-arm mechanism")
}

#[test]
fn the_shipped_design_is_feasible_and_the_published_one_is_not() {
    let problem = problem(&shipped());
    let start = problem.start().expect("a start");
    assert!(problem.evaluate(&start).feasible());
    let goals = problem.goals(&start).expect("a mechanism");
    // Every goal was evaluated, those of arms, tray and stems, too.
    assert_eq!(goals.len(), 15);
    assert!(
        goals.iter().all(|goal| goal.met() == Some(true)),
        "{goals:?}"
    );
    let published = super::tests::problem(&template());
    assert!(
        !published
            .evaluate(&published.start().expect("a start"))
            .feasible()
    );
}

/// Shipped design tilted by an angle that one parameter corrects.
fn tilted() -> ThreeArmDesign {
    let mut design = shipped();
    design.carrier_start += 20.0_f64.to_radians();
    design.optimise.hold = (0..12)
        .flat_map(|i| [Parameter::Radius(i), Parameter::Angle(i)])
        .collect();
    design
}

#[test]
fn the_guide_mends_what_one_parameter_spoils_and_says_so() {
    let problem = problem(&tilted());
    let settings = Settings {
        evaluations: 400,
        ..Settings::default()
    };
    let mut search = DesignSearch::new(&problem, Strategy::Guided, settings).expect("variables");
    let ended = search.run(&problem, &mut |_| ControlFlow::Continue(()));
    assert_eq!(ended, Ended::Target, "{:?}", search.log());
    let log = search.log();
    assert!(!log.is_empty());
    for step in log {
        assert!(
            step.miss[1] < step.miss[0] && !step.moves.is_empty(),
            "{step:?}"
        );
        assert!(
            step.others <= 0.5 * (step.miss[0] - step.miss[1]) + 1e-12,
            "{step:?}"
        );
    }
    let goals = problem.goals(&search.best()).expect("a mechanism");
    assert!(goals.iter().all(|goal| goal.met() == Some(true)));
    // Deterministic: a second run makes the same steps.
    let mut again = DesignSearch::new(&problem, Strategy::Guided, settings).expect("variables");
    again.run(&problem, &mut |_| ControlFlow::Continue(()));
    assert_eq!(again.log(), log);
}

#[test]
fn a_search_is_the_same_on_any_number_of_cores_and_goes_on_from_its_file() {
    let problem = problem(&template());
    let settings = Settings {
        method: Method::DifferentialEvolution,
        evaluations: 400,
        population: Some(20),
        ..Settings::default()
    };
    let on = |cores: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build();
        pool.expect("threads").install(|| {
            let found = minimise(&problem, settings, &mut |_| ControlFlow::Continue(()));
            found.expect("variables").0
        })
    };
    let whole = on(1);
    assert_eq!(whole, on(3));
    let first = Settings {
        evaluations: 160,
        ..settings
    };
    let strategy = Strategy::Global(Method::DifferentialEvolution);
    let mut part = DesignSearch::new(&problem, strategy, first).expect("variables");
    part.run(&problem, &mut |_| ControlFlow::Continue(()));
    let text = serde_json::to_string(&part).expect("a search in JSON");
    let mut part: DesignSearch = serde_json::from_str(&text).expect("the search again");
    assert!(part.is_of(&problem));
    part.allow(400);
    part.run(&problem, &mut |_| ControlFlow::Continue(()));
    assert_eq!(part.best(), whole.best().point);
}

#[test]
fn a_search_of_other_bounds_is_another() {
    let mut design = template();
    let one = problem(&design);
    design.optimise.bounds.insert(Parameter::Bend, [-1.0, -0.5]);
    let other = problem(&design);
    let settings = Settings {
        evaluations: 20,
        population: Some(10),
        ..Settings::default()
    };
    let strategy = Strategy::Global(Method::Genetic);
    let search = DesignSearch::new(&one, strategy, settings).expect("variables");
    assert!(search.is_of(&one) && !search.is_of(&other));
}
