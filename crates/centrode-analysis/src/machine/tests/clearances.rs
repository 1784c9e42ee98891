use centrode_geometry::{Tolerance, maximum, piece_ends};
use centrode_kinematics::machine::{Part, Supply};

use super::*;

/// A crank of 40 mm with a disc of radius 5 at its end and a ram on a line of its own, both of one layer.
const CRANK: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
P = [70, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
plate = false
[bodies.disc]
fixed_to = "crank"
layer = 3
circle = { center = [40, 0], radius = 5 }
[bodies.ram]
on = "frame.P"
slides_deg = 90
law = { expression = "10*sin(phi)" }
layer = LAYER
outline = [[-8, -8], [8, -8], [8, 8], [-8, 8]]
"#;

fn machine(layer: u32, rest: &str) -> Machine {
    composed(&format!(
        "{}{rest}",
        CRANK.replace("LAYER", &layer.to_string())
    ))
}

fn minimum(made: &Machine, names: [&str; 2]) -> f64 {
    let links = made.machine().expect("plates");
    let ends = made.clearance_ends("key", names).expect("two ends");
    let tolerance = Tolerance::new(1e-6).expect("positive");
    let pair = machine_clearance(made, &links, ends, tolerance).expect("bodies");
    let found = pair.expect("level").over([0.0, made.period()]);
    found.expect("found").minimum
}

#[test]
fn a_disc_on_a_crank_clears_ground_wall_and_tray_as_the_drawing_tells() {
    let obstacles = "[obstacles.ground]\nbelow = -60\n\
        [obstacles.wall]\non = \"frame.P\"\noutline = [[-10, 30], [-10, 50], [10, 50], [10, 30]]\n\
        [obstacles.post]\ncircle = { center = [0, 62], radius = 3 }\n\
        [obstacles.tray]\non = \"ram\"\ncircle = { center = [62, 70], radius = 3 }\n\
        [obstacles.high]\nbelow = 0\nheights = [500, 600]\n";
    let made = machine(3, obstacles);
    assert!((minimum(&made, ["disc", "ground"]) - 15.0).abs() < 2e-6);
    assert!((minimum(&made, ["ground", "disc"]) - 15.0).abs() < 2e-6);
    // Nearest corner of the wall at (60, 30).
    let corner = 60.0_f64.hypot(30.0) - 45.0;
    assert!((minimum(&made, ["disc", "wall"]) - corner).abs() < 2e-6);
    assert!((minimum(&made, ["disc", "post"]) - 14.0).abs() < 2e-6);
    // The tray's middle moves with the ram, along 0, 62 + 10 sin t: nearest at a right angle.
    assert!((minimum(&made, ["disc", "tray"]) - 24.0).abs() < 2e-6);
    let links = made.machine().expect("plates");
    let ends = made.clearance_ends("key", ["disc", "high"]).expect("ends");
    let tolerance = Tolerance::new(1e-3).expect("positive");
    assert!(
        machine_clearance(&made, &links, ends, tolerance)
            .expect("bodies")
            .is_none()
    );
    let both = made
        .clearance_ends("key", ["ram", "tray"])
        .expect_err("one body");
    assert!(
        both.to_string().contains("ram and tray are both on ram"),
        "{both}"
    );
    assert!(made.clearance_ends("key", ["ram", "trey"]).is_err());
    // No part and no link, but drawn.
    let is_made = |part: &&Part| part.supply == Supply::Made;
    let mut parts = links.parts.iter().filter(is_made);
    assert!(parts.all(|part| made.body_named(&part.name).is_some()));
    for name in ["ground", "wall", "post", "tray", "high"] {
        assert!(links.figures.iter().any(|figure| figure.name == name));
    }
    assert_eq!(links.validate(), Ok(()));
}

#[test]
fn a_disc_that_dips_into_the_ground_overlaps_it_by_the_depth_of_its_lowest_point() {
    let made = machine(3, "[obstacles.ground]\nbelow = -41.5\n");
    assert!((minimum(&made, ["disc", "ground"]) + 3.5).abs() < 2e-6);
}

#[test]
fn a_goal_of_a_clearance_from_an_obstacle_has_its_figure_and_one_of_no_common_height_a_note() {
    let goals = "[obstacles.ground]\nbelow = -60\n\
        [goals.free]\nfigure = \"clearance(disc, ground)\"\nover = \"minimum\"\nminimum = 16\n\
        [goals.pass]\nfigure = \"clearance(disc, ram)\"\nover = \"minimum\"\nminimum = 1\n";
    let report = check_machine(&machine(2, goals));
    assert!((report.goals[0].value.expect("a figure") - 15.0).abs() < 1e-3);
    assert_eq!(report.goals[0].met(), Some(false));
    assert_eq!(report.goals[1].value, Some(f64::INFINITY));
    let note = report
        .findings
        .iter()
        .find(|f| f.rule == "no-common-height");
    let note = note.expect("a note");
    assert!(note.message.contains("pass") || note.message.contains("disc and ram"));
    let level = check_machine(&machine(3, goals));
    assert!(level.findings.iter().all(|f| f.rule != "no-common-height"));
    assert!(level.goals[1].value.expect("a figure").is_finite());
}

#[test]
fn plates_of_one_layer_that_collide_are_found_with_the_depth_and_others_are_not() {
    // The disc reaches 45 mm out, the ram begins at 62.
    let apart = check_machine(&machine(3, ""));
    assert!(apart.findings.iter().all(|f| f.rule != "plates-collide"));
    let near = CRANK.replace("P = [70, 0]", "P = [50, 0]");
    let other = check_machine(&composed(&near.replace("LAYER", "2")));
    assert!(other.findings.iter().all(|f| f.rule != "plates-collide"));
    let level = check_machine(&composed(&near.replace("LAYER", "3")));
    let found = level.findings.iter().find(|f| f.rule == "plates-collide");
    let found = found.expect("they collide");
    // The disc's outermost point lies 45 - 42 mm behind the ram's face at the start, where both are level.
    let depth = |t: f64| {
        let disc = [40.0 * t.cos(), 40.0 * t.sin()];
        let inside = [disc[0] + 5.0 - 42.0, disc[1] - 10.0 * t.sin()];
        if inside[1].abs() < 8.0 {
            inside[0]
        } else {
            0.0
        }
    };
    let deepest = maximum(depth, &piece_ends(-0.2, 0.2, 4, &[])).value;
    assert!((deepest - 3.0).abs() < 1e-9);
    let measured = found.measured.expect("a depth");
    assert!((measured + deepest).abs() < 2e-2, "{measured} {deepest}");
    assert_eq!(found.place.part.as_deref(), Some("disc"));
}

/// A shaft in the frame, a lever on it that is joined with a link three layers higher, and a plate between them that is fixed.
const BETWEEN: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
Q = [70, 0]
[bodies.shaft]
on = "frame.O"
law = { ratio = 1 }
points = { A = [20, 0] }
[bodies.stop]
fixed_to = "frame.Q"
layer = LAYER
circle = { center = [-30, 0], radius = 22 }
[bodies.link]
on = "shaft.A"
law = { ratio = -1 }
points = { B = [20, 0] }
layer = 3
"#;

#[test]
fn a_pin_that_runs_into_a_plate_without_a_hole_for_it_is_found_with_the_depth() {
    let check = |layer: &str| check_machine(&composed(&BETWEEN.replace("LAYER", layer)));
    for layer in ["4", "-3"] {
        let fine = check(layer);
        assert!(
            fine.findings.iter().all(|f| f.rule != "pins-collide"),
            "{layer}"
        );
    }
    let found = check("1");
    let found = found.findings.iter().find(|f| f.rule == "pins-collide");
    let found = found.expect("they collide");
    assert_eq!(found.place.part.as_deref(), Some("pin"));
    assert!(found.message.contains("pin and stop"), "{}", found.message);
    // The pin, 3 mm in diameter, passes at 20 mm from the shaft; the disc begins at 18.
    let depth = found.measured.expect("a depth");
    assert!((depth + 3.5).abs() < 2e-2, "{depth}");
}

/// A lever of 40 mm that follows a cam 8 mm wide.
const CAM: &str = r#"
family = "machine"
hardware = "list"
[frame]
points = { O = [0, 0], P = [50, 10] }
outline = [[-6, -6], [56, -6], [56, 16], [-6, 16]]
[bodies.shaft]
on = "frame.O"
law = { ratio = 1 }
[bodies.lever]
on = "frame.P"
law = { follows = "push" }
[cams.push]
on = "shaft"
base_radius = 25
LAYER
follower = { kind = "swinging-roller", roller_radius = RADIUS, arm_length = 40 }
body = { width = 8 }
[[cams.push.motion.segments]]
kind = "rise"
span_deg = 180
swing_deg = 14
[[cams.push.motion.segments]]
kind = "return"
span_deg = 180
swing_deg = 14
"#;

#[test]
fn cams_in_the_height_of_a_plate_and_rollers_without_a_wall_are_found() {
    let check = |layer: &str, radius: &str| {
        let text = CAM.replace("LAYER", layer).replace("RADIUS", radius);
        let report = check_machine(&composed(&text));
        let rules = report.findings.into_iter().map(|finding| finding.rule);
        rules
            .filter(|rule| *rule != "not-designed")
            .collect::<Vec<_>>()
    };
    assert_eq!(check("", "5"), [""; 0]);
    // The frame is between -6 and -1 mm.
    assert!(check("layer = -1", "5").contains(&"parts-collide"));
    assert!(check("layer = -2", "5").contains(&"parts-collide"));
    assert!(!check("layer = -3", "5").contains(&"parts-collide"));
    // Next to the lever in its own layer.
    assert!(check("layer = 1", "5").contains(&"pins-collide"));
    assert_eq!(check("", "1.6"), ["thin-roller"]);
    assert_eq!(check("", "0"), [""; 0]);
}

#[test]
fn obstacles_that_cannot_be_are_told_by_key() {
    for (obstacle, key, stated) in [
        (
            "",
            "obstacles.tray.outline",
            "give one of outline, circle and below",
        ),
        (
            "below = 1\ncircle = { radius = 3 }",
            "obstacles.tray.below",
            "together with a shape",
        ),
        (
            "below = 1\non = \"trolley\"",
            "obstacles.tray.on",
            "there is no body \"trolley\"",
        ),
        (
            "below = 1\nheights = [3, 2]",
            "obstacles.tray.heights",
            "from low to high",
        ),
        (
            "outline = [[0, 0], [1, 1], [1, 0], [0, 1]]",
            "obstacles.tray.outline",
            "crosses or touches itself",
        ),
    ] {
        let text = format!(
            "{}[obstacles.tray]\n{obstacle}\n",
            CRANK.replace("LAYER", "1")
        );
        let error = match MachineDesign::from_toml(&text) {
            Err(error) => error.to_string(),
            Ok(design) => {
                let error = Machine::resolve(&design).expect_err(obstacle);
                format!("{}: {error}", error.key())
            }
        };
        assert!(error.contains(key) && error.contains(stated), "{error}");
    }
}

#[test]
fn gears_that_overlap_without_a_mesh_are_found() {
    let wheels = |count: u32| {
        composed(&format!(
            r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.carrier]
on = "frame.O"
law = {{ ratio = 1 }}
[bodies.wheel]
on = "carrier"
mesh = {{ gear = "outer", with = "sun", direction_deg = 0 }}
[pairs.round]
pitch = {{ kind = "circle", module = 2, tooth_count = 20 }}
teeth = {{ backlash = 0.05 }}
[gears]
sun = {{ pair = "round", role = "driver", on = "frame.O" }}
outer = {{ pair = "round", role = "driven", on = "wheel" }}
[copies.ring]
bodies = ["wheel"]
count = {count}
about = "carrier"
"#
        ))
    };
    let collisions = |count: u32| {
        let report = check_machine(&wheels(count));
        let found = report.findings.into_iter();
        found
            .filter(|found| found.rule == "gears-collide")
            .collect::<Vec<_>>()
    };
    // Four wheels of 20 teeth stand 56.57 mm apart and reach 22 mm each; ten stand 24.7 mm apart.
    assert!(collisions(4).is_empty());
    let found = collisions(10);
    assert!(found.len() >= 10, "{}", found.len());
    let stated = "gears outer and outer-2 share a height and overlap by ";
    assert!(found.iter().any(|found| found.message.contains(stated)));
    assert!(found.iter().all(|f| f.measured.is_some_and(|m| m < -10.0)));
}
