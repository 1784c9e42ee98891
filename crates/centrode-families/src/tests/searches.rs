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

/// Designs with goals for figures of the check that their starts miss, one per family without other goals.
const FIGURE_GOALS: [&str; 3] = [
    r#"family = "gear-pair"
[pitch]
kind = "ellipse"
eccentricity = 0.1
module = 2
tooth_count = 31
[goals.fastest]
figure = "ratio_max"
between = [1.9, 1.95]
[goals.size]
figure = "center_distance"
maximum = 55
[vary]
"pitch.eccentricity" = [0, 0.4]
"pitch.module" = [1, 3]
"#,
    r#"family = "spiral-shaft"
slider = { length = 42, clearance = 1 }
[goals.moves]
figure = "moved_distance"
maximum = 2.2
[goals.pressure]
figure = "pressure_angle_max"
maximum = 25
[vary]
"law.amplitude" = [0, 1.6]
radius = [10, 30]
"#,
    r#"family = "moving-box"
scheme = "elliptic-gear"
gears = { eccentricity = 0.1 }
[shaft.slider]
length = 42
clearance = 1
[goals.moves]
figure = "box_moved_distance"
maximum = 2.2
[vary]
"gears.eccentricity" = [0, 0.5]
"#,
];

#[test]
fn a_search_meets_goals_for_figures_and_its_design_passes_the_check() {
    for text in FIGURE_GOALS {
        let file = FAMILIES.read(text.as_bytes()).expect("a design");
        let start = file.mechanism().expect("a machine").check();
        assert!(start.goals.iter().any(|g| g.met() == Some(false)), "{text}");
        assert!(start.findings.iter().any(|f| f.rule == "goal"), "{text}");
        for (_, strategy) in &Strategy::NAMES[..3] {
            let search = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                pool.expect("threads").install(|| {
                    let problem = file.family().problem(file.design()).expect("a problem");
                    let settings = Settings {
                        seed: 3,
                        evaluations: 900,
                        ..Settings::default()
                    };
                    let mut search =
                        DesignSearch::new(problem.as_ref(), *strategy, settings).expect("a search");
                    let ended = search.run(problem.as_ref(), &mut |_| ControlFlow::Continue(()));
                    assert_eq!(ended, Ended::Target, "{strategy:?}: {text}");
                    problem.design(&search.best())
                })
            };
            let design = search(1);
            assert_eq!(
                design.to_toml().ok(),
                search(2).to_toml().ok(),
                "{strategy:?}"
            );
            let found = file.family().resolve(design.as_ref());
            assert!(
                found.expect("a machine").check().ok(),
                "{strategy:?}: {text}"
            );
        }
    }
}

#[test]
fn goals_that_no_design_meets_together_are_reported_as_infeasible() {
    // A wide range of ratios needs an eccentricity that a nearly constant ratio does not allow.
    let both = FIGURE_GOALS[0].replace("between = [1.9, 1.95]", "minimum = 1.9")
        + "[goals.slowest]\nfigure = \"ratio_min\"\nminimum = 0.9\n";
    let file = FAMILIES.read(both.as_bytes()).expect("a design");
    let problem = file.family().problem(file.design()).expect("a problem");
    let settings = Settings {
        evaluations: 200,
        ..Settings::default()
    };
    let (_, strategy) = Strategy::NAMES[2];
    let mut search = DesignSearch::new(problem.as_ref(), strategy, settings).expect("a search");
    search.run(problem.as_ref(), &mut |_| ControlFlow::Continue(()));
    let remark = problem.remark(&search.best()).expect("a remark");
    assert!(
        remark.contains("goal 1 (fastest: ratio_max) and goal 3 (slowest: ratio_min) contradict"),
        "{remark}"
    );
    let refused = |text: &str, key: &str, words: &str| {
        let error = match FAMILIES.read(text.as_bytes()) {
            Err(error) => error,
            Ok(file) => file.mechanism().map(|_| ()).expect_err("an error"),
        };
        assert_eq!(error.key, key);
        assert!(error.message().contains(words), "{}", error.message());
    };
    let twice = format!(
        "{}[goals.slow]\nfigure = \"ratio_max\"\nmaximum = 1.5\n",
        FIGURE_GOALS[0]
    );
    refused(
        &twice,
        "goals.slow",
        "contradicts goals.fastest: ratio_max cannot be at least 1.9 and at most 1.5",
    );
    let unknown = FIGURE_GOALS[0].replace("\"ratio_max\"", "\"ratio_maxi\"");
    refused(
        &unknown,
        "goals.fastest.figure",
        "did you mean \"ratio_max\"?",
    );
    let varied = FIGURE_GOALS[0].replace("\"pitch.module\"", "\"pitch.modul\"");
    refused(
        &varied,
        "vary.pitch.modul",
        "did you mean \"pitch.module\"?",
    );
}

#[test]
fn a_search_finds_lengths_of_a_linkage_that_meet_the_goals() {
    let text = r#"family = "machine"
[frame.points]
O = [0, 0]
D = [105, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { B = [77, 0] }
[dyads.four-bar]
type = "RRR"
from = "crank.B"
to = "frame.D"
lengths = [147, 127]
side = "left"
bodies = ["coupler", "rocker"]
joint = "C"
[dyads.slider]
type = "RRP"
from = "crank.B"
lengths = [200]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "W"
[goals.swing]
figure = "rocker.swing"
over = "span"
between = [59.95, 60.05]
[goals.holds]
figure = "transmission(four-bar)"
over = "minimum"
minimum = 24
[vary]
"bodies.crank.points.B[0]" = [20, 80]
"dyads.four-bar.lengths[0]" = [100, 180]
"#;
    let file = FAMILIES.read(text.as_bytes()).expect("a design");
    let problem = file.family().problem(file.design()).expect("a problem");
    let (_, strategy) = Strategy::NAMES[1];
    let settings = Settings {
        evaluations: 3000,
        seed: 2,
        ..Settings::default()
    };
    let mut search = DesignSearch::new(problem.as_ref(), strategy, settings).expect("a search");
    let ended = search.run(problem.as_ref(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(ended, Ended::Target);
    let best = problem.goals(&search.best()).expect("a machine");
    assert!(best.iter().all(|goal| goal.met() == Some(true)), "{best:?}");
    let without = text.split("[goals").next().expect("a start");
    let file = FAMILIES.read(without.as_bytes()).expect("a design");
    assert!(file.family().problem(file.design()).is_err());
}
