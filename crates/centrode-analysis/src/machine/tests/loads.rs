use std::f64::consts::TAU;

use centrode_geometry::maximum;

use super::*;
use crate::contact::tests::closed_forms::mean_ratio;

/// A slider-crank without masses: crank 30, rod 100 mm.
const SLIDER_CRANK: &str = r#"
family = "machine"
GRAVITY
[input]
speed_rpm = 120
[frame.points]
O = [0, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [30, 0] }
plate = false
CRANK
[bodies.rod]
plate = false
[bodies.ram]
plate = false
points = { tool = [12, 0] }
[dyads.push]
type = "RRP"
from = "crank.A"
lengths = [100]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"
"#;

fn with(gravity: &str, crank: &str, rest: &str) -> Machine {
    let text = SLIDER_CRANK.replace("GRAVITY", gravity);
    composed(&format!("{}{rest}", text.replace("CRANK", crank)))
}

fn goal(figure: &str, degrees: f64) -> String {
    let name = figure.replace(['(', ')', '.'], "_");
    format!("[goals.{name}]\nfigure = \"{figure}\"\nat_deg = {degrees}\nminimum = 0\n")
}

#[test]
fn a_constant_force_on_a_slider_crank_has_the_torque_of_virtual_work_and_the_forces_of_the_triangle()
 {
    for degrees in [20.0, 77.0, 150.0, 200.0, 310.0] {
        let figures = [
            "input.torque",
            "joint(rod-ram).force",
            "joint(ram).force",
            "joint(crank).force",
        ];
        let goals: String = figures.map(|figure| goal(figure, degrees)).concat();
        let load = "[loads.work]\non = \"ram.tool\"\nforce = [-150, 0]\n";
        let found = machine_goals(&with("", "", &format!("{load}{goals}")));
        let value = |figure: &str| {
            let name = figure.replace(['(', ')', '.'], "_");
            let goal = found.iter().find(|goal| goal.name == name);
            goal.and_then(|goal| goal.value).expect("a figure")
        };
        let t = f64::to_radians(degrees);
        let (sin, cos) = t.sin_cos();
        let root = (1e4 - 900.0 * sin * sin).sqrt();
        let rate = -30.0 * sin - 900.0 * sin * cos / root;
        let tan = 30.0 * sin / root;
        for (figure, expected) in [
            ("input.torque", 150.0 * rate),
            ("joint(rod-ram).force", 150.0 * tan.hypot(1.0)),
            ("joint(ram).force", 150.0 * tan.abs()),
            ("joint(crank).force", 150.0 * tan.hypot(1.0)),
        ] {
            let off = (value(figure) - expected).abs();
            assert!(off < 1e-10 * 4500.0, "{figure} at {degrees}: {off}");
        }
    }
}

#[test]
fn the_mean_torque_times_a_turn_is_the_work_of_the_loads() {
    let stroke = "[loads.work]\non = \"ram.tool\"\nforce = [-150, 0]\nover_deg = [180, 360]\n";
    let past = "[loads.work]\non = \"ram.tool\"\nforce = [-75, 3]\nover_deg = [-180, 0]\nexpression = \"2\"\n";
    for load in [stroke, past] {
        let report = check_machine(&with("", "", load));
        let value = |name: &str| report.values[name];
        // The tool goes out by 60 mm against 150 N.
        assert!((value("input_torque_mean") * TAU - 9000.0).abs() < 1e-8);
        assert!(value("input_torque_min").abs() < 1e-10);
        let rate = |t: f64| {
            let (sin, cos) = t.sin_cos();
            -30.0 * sin - 900.0 * sin * cos / (1e4 - 900.0 * sin * sin).sqrt()
        };
        let maximum = maximum(rate, &piece_ends(0.0, TAU, 16, &[])).value * 150.0;
        assert!((value("input_torque_max") - maximum).abs() < 1e-9 * maximum);
        let forces = table(&report, "joint-forces");
        let names: Vec<&str> = forces.rows.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["crank", "rod", "ram", "rod-ram"]);
    }
    // Weight and inertia give back what they take.
    let heavy = "mass_kg = 2\ncenter = [30, 10]\ninertia_kg_mm2 = 50";
    let report = check_machine(&with("gravity = [1, -9.81]", heavy, ""));
    let [low, high, mean] = ["min", "max", "mean"].map(|name| {
        let key = format!("input_torque_{name}");
        report.values[key.as_str()]
    });
    assert_eq!(mean, 0.0);
    // 2 kg at 10^(3/2) mm in a field of (1 + 9.81^2)^(1/2) m/s^2.
    let maximum = 2.0 * 1000.0_f64.sqrt() * 9.81_f64.hypot(1.0);
    assert!((high - maximum).abs() < 1e-9 * maximum && (low + maximum).abs() < 1e-9 * maximum);
    // Next to a force square to the ram's way, which does no work, the torque itself is integrated.
    let square = "[loads.side]\non = \"ram.tool\"\nforce = [0, 5]\n";
    let report = check_machine(&with("gravity = [1, -9.81]", heavy, square));
    let mean = report.values["input_torque_mean"];
    assert!(mean.abs() < 1e-10 * high, "{mean}");
}

#[test]
fn a_force_in_the_axes_of_its_body_turns_with_it_and_a_torque_adds_up() {
    let load = "[loads.brake]\non = \"crank.A\"\nforce = [7, -5]\naxes = \"body\"\n\
                [loads.motor]\non = \"crank\"\ntorque = 100\nexpression = \"cos(phi)\"\n";
    let goals = [0.0, 60.0, 200.0].map(|at| {
        let goal = goal("input.torque", at);
        goal.replace("[goals.input_torque]", &format!("[goals.at-{at}]"))
    });
    let found = machine_goals(&with("", "", &format!("{load}{}", goals.concat())));
    assert_eq!(found.len(), 3);
    for goal in found {
        let degrees: f64 = goal.name[3..].parse().expect("an angle");
        let expected = 150.0 - 100.0 * degrees.to_radians().cos();
        let value = goal.value.expect("a figure");
        assert!((value - expected).abs() < 1e-10, "{degrees}: {value}");
    }
}

#[test]
fn loads_that_cannot_be_are_told_by_key() {
    for (load, key, stated) in [
        (
            "on = \"ram.tool\"",
            "loads.work.force",
            "give one of force and torque",
        ),
        (
            "on = \"ram.tip\"\ntorque = 1",
            "loads.work.on",
            "has no point \"tip\"",
        ),
        (
            "on = \"ram\"\ntorque = 1\nexpression = \"1/phi\"",
            "loads.work.expression",
            "no value at an input of 0 deg",
        ),
        (
            "on = \"ram\"\ntorque = 1\nover_deg = [30, 390]",
            "loads.work.over_deg",
            "must end at another input than it starts at",
        ),
    ] {
        let text = SLIDER_CRANK.replace("GRAVITY", "").replace("CRANK", "");
        let text = format!("{text}[loads.work]\n{load}\n");
        let error = match MachineDesign::from_toml(&text) {
            Err(error) => error.to_string(),
            Ok(design) => {
                let error = Machine::resolve(&design).expect_err(load);
                format!("{}: {error}", error.key())
            }
        };
        assert!(error.contains(key) && error.contains(stated), "{error}");
    }
}

/// A crank turned by two like gears of circles, which a torque holds back.
const GEARED: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = { ratio = 1 }
[bodies.crank]
on = "frame"
mesh = { gear = "wheel", with = "pinion", direction_deg = 0 }
points = { A = [0, 30] }
[pairs.drive]
pitch = { kind = "circle", module = 2, tooth_count = 24 }
driver = { width = 12, bore = 10, keyway = { width = 3, depth = 1.4 } }
driven = { width = 12, bore = 10, keyway = { width = 3, depth = 1.4 } }
[gears.pinion]
pair = "drive"
role = "driver"
on = "shaft"
[gears.wheel]
pair = "drive"
role = "driven"
on = "crank"
[loads.work]
on = "crank"
torque = TORQUE
[plates]
thickness = 6
gap = 1
width = 16
pin_diameter = 6
"#;

#[test]
fn keys_pass_on_the_torque_of_the_teeth() {
    let checked = |torque: f64| {
        let text = GEARED.replace("TORQUE", &format!("{torque:?}"));
        check_machine(&composed(&text))
    };
    let key = |report: &Report| {
        let findings = report.findings.iter();
        let found = findings.filter(|finding| finding.rule == "key-pressure");
        found
            .map(|finding| finding.place.part.clone().unwrap_or_default())
            .collect::<Vec<_>>()
    };
    // The crank's key B 3 x 3 x 6 bears 1.2 mm high over 6 mm at 5 mm from the axis, those of the gears over 9 mm.
    let light = checked(1000.0);
    let pressure = light.values["key_pressure_max"];
    assert!(
        (pressure / (1000.0 / (5.0 * 1.2 * 6.0)) - 1.0).abs() < 1e-9,
        "{pressure}"
    );
    assert!(key(&light).is_empty());
    // 0.9 of 235 N/mm²: 7614 N mm on the crank's key, 11421 on the gears'.
    assert!(key(&checked(7600.0)).is_empty());
    assert_eq!(key(&checked(-7700.0)), ["crank"]);
    let mut all = key(&checked(12000.0));
    all.sort();
    assert_eq!(all, ["crank", "pinion", "wheel"]);
    // Bonded parts have no key.
    let text = GEARED.replace(", keyway = { width = 3, depth = 1.4 }", "");
    let bonded = check_machine(&composed(&text.replace("TORQUE", "1000.0")));
    assert!(!bonded.values.contains_key("key_pressure_max"));
}

/// Torque of the load, teeth of both gears, module, pressure angle in degrees.
const LOADED_GEARS: [(f64, [u32; 2], f64, f64); 12] = [
    (500.0, [40, 40], 2.0, 20.0),
    (-500.0, [40, 40], 2.0, 20.0),
    (80.0, [54, 18], 1.5, 20.0),
    (-80.0, [54, 18], 1.5, 20.0),
    (1.0, [25, 25], 1.0, 20.0),
    (-1.0, [25, 25], 1.0, 25.0),
    (3000.0, [40, 20], 3.0, 20.0),
    (-3000.0, [60, 20], 3.0, 22.5),
    (120.0, [40, 20], 1.0, 22.5),
    (-120.0, [40, 20], 1.0, 22.5),
    (1e4, [36, 36], 2.0, 17.5),
    (-0.5, [32, 32], 0.5, 20.0),
];

/// At rest the teeth hold the load: T / (r2 cos alpha), along the flanks that turn the driven gear against it.
#[test]
fn the_force_of_a_mesh_has_the_sign_of_its_flanks_in_goals_and_tables() {
    for (torque, [z1, z2], module, alpha) in LOADED_GEARS {
        let ratio = mean_ratio([z1, z2]);
        let made = composed(&format!(
            r#"family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = {{ ratio = 1 }}
[bodies.wheel]
on = "frame"
mesh = {{ gear = "big", with = "small", direction_deg = 0 }}
[pairs.drive]
mean_ratio = {ratio}
pitch = {{ kind = "circle", module = {module}, tooth_count = {z1} }}
tool = {{ kind = "rack", pressure_angle_deg = {alpha}, tip_radius_coefficient = 0.2 }}
driver = {{ width = 5, bore = 4 }}
driven = {{ width = 5, bore = 4 }}
[gears.small]
pair = "drive"
role = "driver"
on = "shaft"
[gears.big]
pair = "drive"
role = "driven"
on = "wheel"
[loads.brake]
on = "wheel"
torque = {torque}
[goals.most]
figure = "mesh(wheel).force"
over = "maximum"
minimum = 0
[goals.minimum]
figure = "mesh(wheel).force"
over = "minimum"
minimum = 0
[goals.here]
figure = "mesh(wheel).force"
at_deg = 33
minimum = 0
"#
        ));
        let radius = 0.5 * module * f64::from(z2);
        let expected = -torque / (radius * alpha.to_radians().cos());
        let report = check_machine(&made);
        let values = report.goals.iter().map(|goal| goal.value.expect("known"));
        let [(_, columns)] = &table(&report, "mesh-forces").rows[..] else {
            panic!("one mesh");
        };
        for value in values.chain(columns.iter().copied()) {
            assert!(
                (value - expected).abs() < 1e-6 * expected.abs(),
                "{torque}: {value} {expected}"
            );
        }
        assert_eq!(columns.len(), 2);
    }
}

/// A crank of 50 mm that a constant force loads at its end, driven by its shaft.
const OVERHUNG: &str = r#"
family = "machine"
hardware = "full"
input = { speed_rpm = 0.001 }
[frame]
points = { O = [0, 0] }
outline = [[-30, -30], [30, -30], [30, 30], [-30, 30]]
thickness = LENGTH
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [50, 0] }
layer = LAYER
[loads.work]
on = "crank.A"
force = [-FORCE, 0]
[plates]
thickness = 6
gap = 2
width = 16
pin_diameter = 8
material = "steel S235"
"#;

#[test]
fn a_shaft_held_at_one_end_is_stressed_by_its_load_and_what_holds_nothing_is_found() {
    for (length, layer, force) in [
        (6.0, 0, 80.0),
        (10.0, 0, 500.0),
        (6.0, 3, 200.0),
        (14.0, 1, 900.0),
        (5.0, 2, 10.0),
    ] {
        let text = OVERHUNG.replace("LENGTH", &format!("{length}"));
        let text = text.replace("LAYER", &layer.to_string());
        let text = text.replace("FORCE", &format!("{force}"));
        let report = check_machine(&composed(&text));
        // The frame begins at -8, a layer is 8 mm high.
        let arm = 8.0 * f64::from(layer) + 3.0 - (-8.0 + 0.5 * length);
        let pressure = force / (8.0 * length) + 6.0 * force * arm / (8.0 * length * length);
        let bending = force * arm / (std::f64::consts::PI * 8.0_f64.powi(3) / 32.0);
        let expected = pressure.max(bending);
        let measured = report.values["overhung_stress_max"];
        assert!(
            (measured / expected - 1.0).abs() < 1e-5,
            "{measured} {expected}"
        );
        // 0.9 of the yield strength of S235.
        let is_found = report
            .findings
            .iter()
            .any(|finding| finding.rule == "overhung");
        assert_eq!(
            is_found,
            expected > 211.5,
            "{length} {layer} {force}: {expected}"
        );
    }
    let text = OVERHUNG
        .replace("LENGTH", "6")
        .replace("LAYER", "0")
        .replace("FORCE", "1");
    let rules = |text: &str| -> Vec<String> {
        let found = check_machine(&composed(text)).findings.into_iter();
        let found = found.filter(|finding| finding.rule != "not-designed");
        found
            .map(|finding| {
                format!(
                    "{} {}",
                    finding.rule,
                    finding.place.part.unwrap_or_default()
                )
            })
            .collect()
    };
    assert_eq!(rules(&text), [""; 0]);
    // No key is as small as this shaft, no ring has this size, and nobody knows the strength of bronze.
    assert_eq!(
        rules(&text.replace("pin_diameter = 8", "pin_diameter = 5")),
        ["not-held crank"]
    );
    assert_eq!(
        rules(&text.replace("pin_diameter = 8", "pin_diameter = 8.5")),
        ["not-held shaft-crank"]
    );
    assert_eq!(
        rules(&text.replace("steel S235", "bronze")),
        ["overhung shaft of crank"]
    );
    assert_eq!(rules(&text.replace("\"full\"", "\"list\"")), [""; 0]);
}
