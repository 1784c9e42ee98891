use centrode_machines::machine::{Machine, MachineDesign};
use centrode_spec::DesignSpec;

use super::*;

mod clearances;
mod followers;
mod layers;
mod loads;
mod seats;
mod teeth;

fn composed(text: &str) -> Machine {
    let design = MachineDesign::from_toml(text).expect("a design");
    Machine::resolve(&design).expect("a machine")
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
    let report = check_machine(&composed(MACHINE));
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
    let minimum = between(105.0 - 77.0).min(between(105.0 + 77.0));
    assert!((angles[0] - minimum).abs() < 1e-12, "{angles:?} {minimum}");
    // Middle lengths 105 and 127, shortest 77, longest 147.
    let margin = (105.0 + 127.0) - (77.0 + 147.0);
    assert_eq!(table(&report, "grashof").rows[0].1, [margin]);
}

/// A four-bar of a crank, coupler, rocker and frame.
fn four_bar([crank, coupler, rocker, frame]: [f64; 4], side: &str) -> Machine {
    composed(&format!(
        "family = \"machine\"\n[frame.points]\nA = [0, 0]\nD = [{frame}, 0]\n[bodies.crank]\non = \"frame.A\"\nlaw = {{ ratio = 1 }}\npoints = {{ B = [{crank}, 0] }}\n[dyads.loop]\ntype = \"RRR\"\nfrom = \"crank.B\"\nto = \"frame.D\"\nlengths = [{coupler}, {rocker}]\nside = \"{side}\"\nbodies = [\"coupler\", \"rocker\"]\njoint = \"C\"\n"
    ))
}

/// The angle at the joint by the cosine rule, at the shortest and the longest distance of the bars' other ends.
#[test]
fn the_transmission_angle_of_two_bars_is_not_folded() {
    for lengths in [
        [0.5, 1.2, 0.8, 1.0],
        [77.0, 147.0, 127.0, 105.0],
        [30.0, 80.0, 90.0, 100.0],
        [20.0, 40.0, 90.0, 100.0],
        [60.0, 80.0, 90.0, 40.0],
        [105.0, 147.0, 127.0, 77.0],
        [10.0, 100.0, 60.0, 120.0],
        [10.0, 50.0, 50.0, 80.0],
        [25.0, 60.0, 70.0, 40.0],
        [5.0, 60.0, 61.0, 115.0],
        [5.0, 60.0, 61.0, 8.0],
    ] {
        for side in ["left", "right"] {
            let [crank, coupler, rocker, frame] = lengths;
            let angle = |distance: f64| {
                let squares = coupler * coupler + rocker * rocker - distance * distance;
                (squares / (2.0 * coupler * rocker)).acos()
            };
            let low = angle((frame - crank).abs());
            let high = angle(frame + crank);
            let report = check_machine(&four_bar(lengths, side));
            let (_, row) = &table(&report, "transmission-angles").rows[0];
            assert!((row[0] - low).abs() < 1e-9, "{lengths:?}: {row:?} {low}");
            assert!((row[2] - high).abs() < 1e-9, "{lengths:?}: {row:?} {high}");
            assert!((row[1] / PI).fract().abs() < 1e-6, "{lengths:?}: {row:?}");
            assert!((row[3] - PI).abs() < 1e-6, "{lengths:?}: {row:?}");
            let held = low.min(PI - high);
            let found = report.values["transmission_angle_min"];
            assert!((found - held).abs() < 1e-9, "{lengths:?}: {found} {held}");
            let warned = report
                .findings
                .iter()
                .find(|f| f.rule == "transmission-angle");
            assert_eq!(warned.is_some(), held.to_degrees() < 30.0, "{lengths:?}");
            if let Some(finding) = warned {
                let obtuse = PI - high < low;
                assert_eq!(
                    finding.message.contains("rises to"),
                    obtuse,
                    "{}",
                    finding.message
                );
                let at = finding.place.input.expect("an input");
                assert!((at - row[if obtuse { 3 } else { 1 }]).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn the_readings_of_tables_are_reported() {
    let read = |law: &str| {
        composed(&format!(
            "family = \"machine\"\n[frame.points]\nW = [0, 0]\n[bodies.wheel]\non = \"frame.W\"\nlaw = {{ {law} }}\n"
        ))
    };
    for (law, expected) in [
        (
            "table_deg = [0, 45, 90, 135, 180, 225, 270, 315]",
            [360.0, 45.0, 45.0],
        ),
        (
            "table_deg = [0, 50, 100, 150, 200, 100]",
            [0.0, 100.0, -100.0],
        ),
        (
            "table_deg = [0, 40, 80, 120, 160, 200], turns = 1",
            [360.0, 40.0, 160.0],
        ),
        (
            "table_deg = [0, 40, 80, 120, 160, 200], turns = 0",
            [0.0, 40.0, -200.0],
        ),
        (
            "table_deg = [0, -60, -120, -180, -240, -300]",
            [-360.0, 60.0, -60.0],
        ),
    ] {
        let report = check_machine(&read(law));
        let (name, row) = &table(&report, "table-readings").rows[0];
        assert_eq!(name, "wheel");
        for (value, expected) in row.iter().zip(expected) {
            assert!(
                (value.to_degrees() - expected).abs() < 1e-9,
                "{law}: {row:?}"
            );
        }
    }
    let report = check_machine(&read("ratio = 1"));
    assert!(
        report
            .tables
            .iter()
            .all(|table| table.name != "table-readings")
    );
}

#[test]
fn a_slider_crank_has_its_stroke_between_its_dead_centres() {
    let report = check_machine(&composed(MACHINE));
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
    let report = check_machine(&composed(MACHINE));
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

/// Goals on every form of figure, with those of the closed forms next to them.
const GOALS: &str = r#"
[goals.ram-stroke]
figure = "ram.travel"
over = "span"
minimum = 154
[goals.ram-far]
figure = "rod.W.x"
over = "maximum"
between = [276.9, 277.1]
[goals.crank-speed]
figure = "B.speed"
at_deg = 40
maximum = 1
[goals.crank-pull]
figure = "B.acceleration"
over = "minimum"
minimum = 1
[goals.level]
figure = "crank.angle"
at_deg = 90
between = [89, 91]
[goals.steady]
figure = "crank.angular_speed"
over = "span"
maximum = 1e-9
[goals.swing]
figure = "rocker.swing"
over = "span"
between = [100, 120]
[goals.holds]
figure = "transmission(slider)"
over = "minimum"
minimum = 60
[goals.apart]
figure = "distance(crank.B, frame.O)"
over = "maximum"
maximum = 77.000000001
[goals.clear]
figure = "clearance(crank, rod)"
over = "minimum"
minimum = 0
"#;

#[test]
fn every_form_of_figure_is_measured_as_its_closed_form_has_it() {
    let machine = composed(&format!("{MACHINE}{GOALS}"));
    let report = check_machine(&machine);
    let goal = |name: &str| {
        let found = report.goals.iter().find(|goal| goal.name == name);
        let goal = found.expect("a goal");
        (goal.value.expect("a figure"), goal.met())
    };
    let turn = std::f64::consts::TAU;
    let near = |name: &str, value: f64| {
        let (found, _) = goal(name);
        assert!(
            (found - value).abs() < 1e-9 * value.abs().max(1.0),
            "{name}: {found} {value}"
        );
    };
    near("ram-stroke", 154.0);
    near("ram-far", 277.0);
    near("crank-speed", 77.0 * turn);
    near("crank-pull", 0.077 * turn * turn);
    near("level", turn / 4.0);
    near("steady", 0.0);
    near("apart", 77.0);
    near("holds", (77.0_f64 / 200.0).acos());
    // Plates above each other never meet.
    assert_eq!(goal("clear"), (f64::INFINITY, Some(true)));
    // The rocker's ends: crank and coupler stretched and folded, by the cosine rule.
    let side = |base: f64| {
        let cosine = (105.0_f64.powi(2) + 127.0_f64.powi(2) - base * base) / (2.0 * 105.0 * 127.0);
        cosine.acos()
    };
    near("swing", side(147.0 + 77.0) - side(147.0 - 77.0));
    let missed: Vec<&str> = report
        .findings
        .iter()
        .filter(|f| f.rule == "goal")
        .map(|f| f.message.as_str())
        .collect();
    assert_eq!(missed.len(), 1, "{missed:?}");
    assert!(
        missed[0].contains("crank-speed: B.speed at 40 deg: 483.81 mm/s, missed by 482.81 mm/s"),
        "{missed:?}"
    );
}

#[test]
fn figures_that_are_not_there_are_told_at_their_goal() {
    for (figure, stated) in [
        (
            "B.colour",
            "there is no figure \"B.colour\"; its forms are point.x",
        ),
        (
            "transmission(foot)",
            "there is no dyad \"foot\"; there are four-bar, slider",
        ),
        ("clearance(crank, wheel)", "there is no body \"wheel\""),
        ("crank.Z.x", "body \"crank\" has no point \"Z\""),
        ("rocker.travel", "there is no figure"),
        (
            "clearance(crank, rod)",
            "must be \"minimum\" for the figure clearance",
        ),
    ] {
        let text =
            format!("{MACHINE}[goals.a]\nfigure = \"{figure}\"\nover = \"span\"\nminimum = 1\n");
        let design = MachineDesign::from_toml(&text).expect("a design");
        let error = Machine::resolve(&design).expect_err(figure);
        assert!(error.to_string().contains(stated), "{error}");
        assert!(error.key().starts_with("goals.a."), "{}", error.key());
    }
}

#[test]
fn a_cam_has_its_figures_and_one_that_is_too_small_is_told() {
    const INDEX: &str = include_str!("../../../../tests/designs/index-table.toml");
    let made = composed(INDEX);
    let report = check_machine(&made);
    let limits = made.cams()[0].disc().limits();
    let row = |name: &str| table(&report, name).rows[0].1.clone();
    assert_eq!(
        row("cam-pressure-angles")[0],
        limits.rise_pressure_angle.value
    );
    assert_eq!(row("cam-radii")[2], limits.minimum_radius.value);
    let rules = |report: &Report| report.findings.iter().map(|f| f.rule).collect::<Vec<_>>();
    assert!(
        !rules(&report).contains(&"cam-undercut"),
        "{:?}",
        rules(&report)
    );
    let steep = limits.rise_pressure_angle.value > std::f64::consts::FRAC_PI_4;
    assert_eq!(rules(&report).contains(&"cam-pressure-angle"), steep);
    // A rise and a return of 20 degrees each leave a point too sharp for the roller.
    let hasty = composed(
        r#"family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = { ratio = -1 }
[bodies.rod]
on = "frame.O"
slides_deg = 0
law = { follows = "push" }
[cams.push]
on = "shaft"
base_radius = 20
follower = { kind = "translating-roller", roller_radius = 6 }
[cams.push.motion]
segments = [
    { kind = "rise", span_deg = 20, lift = 8 },
    { kind = "return", span_deg = 20, lift = 8 },
    { kind = "dwell", span_deg = 320 },
]
"#,
    );
    let report = check_machine(&hasty);
    let stated = report.findings.iter().find(|f| f.rule == "cam-undercut");
    let stated = stated.expect("undercut");
    let message = "cam push is undercut: rod cannot follow its motion there";
    assert_eq!(stated.message, message);
    // The angle of the shaft is that of the cam here.
    let minimum = hasty.cams()[0].disc().limits().regularity.input;
    let input = stated.place.input.expect("an input");
    assert!((input - minimum).abs() < 1e-9, "{input} {minimum}");
    assert!(rules(&report).contains(&"cam-pressure-angle"));
}

/// A crank whose block slides in the slot of a lever, with what follows.
fn quick_return(more: &str) -> Report {
    check_machine(&composed(&format!(
        r#"
family = "machine"
hardware = "list"
[frame.points]
O = [0, 0]
P = [0, -60]
Q = [0, 30]
[bodies.crank]
on = "frame.O"
law = {{ ratio = 1 }}
points = {{ A = [24, 0] }}
[dyads.drive]
type = "RPR"
from = "crank.A"
to = "frame.P"
side = "forward"
bodies = ["block", "lever"]
{more}"#
    )))
}

#[test]
fn a_block_in_its_slot_is_no_collision_but_a_pin_that_leaves_the_slot_is_one() {
    let collides = |report: &Report| {
        let findings = report.findings.iter();
        let rules = findings.filter(|finding| finding.rule.ends_with("-collide"));
        rules
            .map(|finding| finding.message.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(collides(&quick_return("")), Vec::<String>::new());
    // The pin at Q goes from the frame to the post above the lever, through whose slot it passes: 90 mm from the lever's pin it is
    // in the slot where the lever is upright, and runs into its wall where the lever swings.
    let post =
        "[bodies.post]\non = \"frame.Q\"\nlaw = { start_deg = 90 }\nlayer = 3\nthickness = 5";
    let found = collides(&quick_return(post));
    // And into the block, 36 to 84 mm and 8 mm from there.
    let is_met = |name: &str| {
        found
            .iter()
            .any(|words| words.contains(&format!("shaft-post and {name} ")))
    };
    assert!(
        found.len() == 2 && is_met("lever") && is_met("block"),
        "{found:?}"
    );
}
