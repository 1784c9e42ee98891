use centrode_mechanism::composed::{Composed, ComposedDesign};
use centrode_mechanism::design::DesignSpec;

use super::*;

fn composed(text: &str) -> Composed {
    let design = ComposedDesign::from_toml(text).expect("a design");
    Composed::resolve(&design).expect("a machine")
}

fn table<'a>(report: &'a Report, name: &str) -> &'a Table {
    let found = report.tables.iter().find(|table| table.name == name);
    found.expect("a table of that name")
}

/// A crank-rocker, and a slider-crank on the same crank.
const MACHINE: &str = r#"
family = "machine"
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
"#;

#[test]
fn a_crank_rocker_has_the_figures_of_its_closed_forms() {
    let report = check_composed(&composed(MACHINE));
    let [(name, angles)] = &table(&report, "transmission-angles").rows[..1] else {
        panic!("two dyads");
    };
    assert_eq!(name, "four-bar");
    // The cosine rule where crank and frame stretch and fold.
    let between = |base: f64| {
        let cosine = (147.0_f64.powi(2) + 127.0_f64.powi(2) - base * base) / (2.0 * 147.0 * 127.0);
        let angle = cosine.acos();
        angle.min(std::f64::consts::PI - angle)
    };
    let least = between(105.0 - 77.0).min(between(105.0 + 77.0));
    assert!((angles[0] - least).abs() < 1e-12, "{angles:?} {least}");
    // Middle lengths 105 and 127, shortest 77, longest 147.
    let margin = (105.0 + 127.0) - (77.0 + 147.0);
    assert_eq!(table(&report, "grashof").rows[0].1, [margin]);
}

#[test]
fn a_slider_crank_has_its_stroke_between_its_dead_centres() {
    let report = check_composed(&composed(MACHINE));
    let strokes = table(&report, "strokes");
    let (name, span) = &strokes.rows[0];
    assert_eq!(name, "ram");
    assert!((span[2] - 154.0).abs() < 1e-12, "{span:?}");
    let dead = table(&report, "dead-centres");
    let (_, inputs) = dead
        .rows
        .iter()
        .find(|(name, _)| name == "ram")
        .expect("it slides");
    assert!(
        (inputs[0] - std::f64::consts::PI).abs() < 1e-7,
        "{inputs:?}"
    );
    let (_, angle) = &table(&report, "transmission-angles").rows[1];
    assert!((angle[0] - (77.0_f64 / 200.0).acos()).abs() < 1e-12);
    assert!(
        report
            .findings
            .iter()
            .any(|f| f.rule == "transmission-angle")
    );
}

#[test]
fn speeds_are_those_of_the_input() {
    let report = check_composed(&composed(MACHINE));
    let rows = &table(&report, "speed").rows;
    let (_, speed) = rows
        .iter()
        .find(|(name, _)| name == "crank.B")
        .expect("a point");
    assert!(
        (speed[0] - 77.0 * std::f64::consts::TAU).abs() < 1e-9,
        "{speed:?}"
    );
}
