//! Small machines, and layers in which nothing collides.

use super::*;

fn four_bar(ground: f64, [crank, coupler, rocker]: [f64; 3]) -> String {
    format!(
        r#"
family = "machine"
hardware = "list"
[frame.points]
A = [0, 0]
D = [{ground}, 0]
[bodies.crank]
on = "frame.A"
law = {{ ratio = 1 }}
points = {{ B = [{crank}, 0] }}
[dyads.loop]
type = "RRR"
from = "crank.B"
to = "frame.D"
lengths = [{coupler}, {rocker}]
side = "left"
bodies = ["coupler", "rocker"]
joint = "C"
"#
    )
}

/// The four-bar with a dyad from its rocker to a third pivot.
fn six_bar(k: f64) -> String {
    format!(
        r#"{}
[dyads.second]
type = "RRR"
from = "rocker.C"
to = "frame.E"
lengths = [{}, {}]
side = "left"
bodies = ["link", "output"]
joint = "F"
"#,
        four_bar(4.0 * k, [1.5 * k, 4.0 * k, 3.0 * k]).replace(
            "[bodies",
            &format!("E = [{}, {}]\n[bodies", 8.0 * k, 0.5 * k)
        ),
        4.0 * k,
        3.0 * k
    )
}

/// A machine of a crank and one dyad, whose keys follow; the frame has points O and P.
fn cranked(radius: f64, below: f64, dyad: &str) -> String {
    format!(
        r#"
family = "machine"
hardware = "list"
[frame.points]
O = [0, 0]
P = [0, {}]
[bodies.crank]
on = "frame.O"
law = {{ ratio = 1 }}
points = {{ A = [{radius}, 0] }}
[dyads.drive]
from = "crank.A"
{dyad}
"#,
        -below
    )
}

fn slider_crank(ground: f64) -> String {
    let rod = format!(
        "type = \"RRP\"\nline = \"frame.O\"\nline_deg = 0\nlengths = [{ground}]\nside = \"forward\"\nbodies = [\"rod\", \"ram\"]\njoint = \"C\""
    );
    cranked(0.25 * ground, ground, &rod)
}

const LEVER: &str =
    "type = \"RPR\"\nto = \"frame.P\"\nside = \"forward\"\nbodies = [\"block\", \"lever\"]";

fn scotch_yoke(radius: f64) -> String {
    let yoke = "type = \"RPP\"\nline = \"frame.O\"\nline_deg = 0\nslot_deg = 90\nbodies = [\"block\", \"yoke\"]";
    cranked(radius, radius, yoke).replace(&format!("P = [0, {}]\n", -radius), "")
}

/// Message of the finding with a rule.
fn finding(report: &Report, rule: &str) -> Option<String> {
    let mut findings = report.findings.iter();
    let found = findings.find(|finding| finding.rule == rule);
    found.map(|finding| finding.message.clone())
}

/// Checks that a machine has no error, and that none of its holes overlap.
fn is_good(text: &str) {
    let machine = composed(text);
    let report = check_machine(&machine);
    assert!(report.ok(), "{text}{:?}", report.findings);
    assert_eq!(machine.overlapping_holes(), None, "{text}");
}

#[test]
fn machines_of_1_to_20_mm_have_plates_and_pins_of_their_size() {
    for ground in [1.0, 2.0, 4.0, 7.0, 12.0, 20.0] {
        is_good(&four_bar(
            ground,
            [0.3, 0.9, 0.7].map(|share| share * ground),
        ));
        is_good(&slider_crank(ground));
    }
    for ground in [1.0, 2.0, 6.0, 20.0] {
        is_good(&six_bar(0.25 * ground));
    }
    // With plates described as far as they are.
    is_good(&format!(
        "{}[plates]\nmaterial = \"brass\"\nthickness = 2\n",
        slider_crank(4.0)
    ));
    is_good(&format!(
        "{}[plates]\nwidth = 0.5\n",
        four_bar(3.0, [0.9, 2.7, 2.1])
    ));
}

#[test]
fn sizes_that_are_given_stay_and_others_follow_the_shortest_distance() {
    let sizes = |text: &str| {
        let machine = composed(text);
        let plates = machine.plates();
        [
            plates.thickness,
            plates.gap,
            plates.width,
            plates.pin_diameter,
        ]
    };
    let small = four_bar(8.0, [2.0, 6.0, 7.0]);
    // 2 mm of 8 mm: a quarter of 5, 1, 8 and 3 mm, rounded down.
    assert_eq!(sizes(&small), [1.2, 0.25, 2.0, 0.7]);
    let given = format!("{small}[plates]\nwidth = 1.5\nthickness = 3\n");
    assert_eq!(sizes(&given), [3.0, 0.25, 1.5, 0.7]);
    let narrow = format!("{small}[plates]\nwidth = 0.5\n");
    assert_eq!(sizes(&narrow), [1.2, 0.25, 0.5, 0.18]);
    assert_eq!(
        sizes(&four_bar(40.0, [8.0, 30.0, 35.0])),
        [5.0, 1.0, 8.0, 3.0]
    );
    // The path of the block is 15 to 25 mm from the pin of its lever: 15 mm count as 6.82 mm.
    assert_eq!(sizes(&cranked(20.0, 40.0, LEVER))[2], 8.0);
    assert_eq!(sizes(&cranked(10.0, 25.0, LEVER))[2], 6.0);
}

#[test]
fn quick_returns_whitworths_and_yokes_have_an_order_of_layers_at_every_scale() {
    for scale in [1.0, 20.0, 400.0] {
        is_good(&cranked(0.4 * scale, scale, LEVER));
        is_good(&scotch_yoke(scale));
        // The crank of a Whitworth sweeps over the pin of its lever, and the lever over the crank's.
        let whitworth = composed(&cranked(scale, 0.4 * scale, LEVER));
        let report = check_machine(&whitworth);
        assert!(!report.ok());
        let order = "with layers crank -2, lever 0 there are no collisions";
        assert_eq!(finding(&report, "layer-order").as_deref(), Some(order));
        let (words, design) = machine_layers(&whitworth).expect("layers");
        assert_eq!(words, "layers crank -2, lever 0");
        let toml = centrode_spec::Design::to_toml(&design).expect("a file");
        is_good(&toml);
    }
}

#[test]
fn layers_that_are_given_stay_and_pins_that_no_order_helps_are_named() {
    let drag = four_bar(20.0, [40.0, 44.0, 50.0]);
    let order = |text: &str| finding(&check_machine(&composed(text)), "layer-order");
    let found = order(&drag).expect("they collide");
    assert_eq!(
        found,
        "with layers crank -2, coupler 0, rocker 1 there are no collisions"
    );
    let given = order(&format!("{drag}[bodies.rocker]\nlayer = 4\n")).expect("they collide");
    assert!(!given.contains("rocker"), "{given}");
    // A frame that reaches as far as the crank's pin is in its way, too.
    let outline = "outline = [[-10, -10], [100, -10], [100, 10], [-10, 10]]";
    let longer = drag.replace(
        "[frame.points]\nA = [0, 0]\nD = [20, 0]\n",
        &format!("[frame]\npoints = {{ A = [0, 0], D = [20, 0] }}\n{outline}\n"),
    );
    let found = order(&longer).expect("they collide");
    assert!(
        found.starts_with("no order of the plates is free of collisions"),
        "{found}"
    );
    for pin in ["frame.A joins", "frame.D joins"] {
        assert!(found.contains(pin), "{found}");
    }
    assert!(machine_layers(&composed(&longer)).is_none());
    // Nothing is proposed where nothing collides.
    assert_eq!(order(&four_bar(20.0, [6.0, 18.0, 14.0])), None);
}
