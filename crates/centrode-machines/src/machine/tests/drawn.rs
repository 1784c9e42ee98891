use std::f64::consts::PI;

use super::{made, refused};
use crate::machine::Machine;
use centrode_kinematics::machine::{LinePath, LineRole, Link};

const PRESS: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [30, 0] }
CRANK
[bodies.ram]
RAM
[dyads.ram]
type = "RRP"
from = "crank.A"
lengths = [120]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"
[plates]
thickness = 4
gap = 1
width = 10
pin_diameter = 4
density = 2000
"#;

fn with(crank: &str, ram: &str) -> String {
    PRESS.replace("CRANK", crank).replace("RAM", ram)
}

fn link(made: &Machine, name: &str) -> Link {
    let machine = made.machine().expect("plates");
    let link = machine.link_named(name).expect("a link");
    machine.links[link].clone()
}

#[test]
fn a_body_drawn_by_its_corners_has_their_area_with_holes_at_its_pins_whichever_way_they_go() {
    let forward = "[[-20, -10], [20, -10], [20, 10], [-20, 10]]";
    let backward = "[[-20, 10], [20, 10], [20, -10], [-20, -10]]";
    for corners in [forward, backward] {
        let ram = format!("outline = {corners}\ncorner_radius = 3\nthickness = 7");
        let drawn = made(&with("", &ram));
        let ram = drawn.body_named("ram").expect("a ram");
        let plate = drawn.plate(ram).expect("a solid").expect("a plate");
        let area = 800.0 - (4.0 - PI) * 9.0 - PI * 4.0;
        assert!((plate.volume() - 7.0 * area).abs() < 1e-9);
        let mass = link(&drawn, "ram").mass.expect("a mass");
        assert!((mass.mass - 2e-6 * 7.0 * area).abs() < 1e-15);
        assert!(mass.center.coords.xy().norm() < 1e-12);
        assert!((mass.center.z - 0.5 * (plate.bottom() + plate.top())).abs() < 1e-12);
    }
    let disc = made(&with("circle = { center = [10, 0], radius = 25 }", ""));
    let crank = disc.body_named("crank").expect("a crank");
    let plate = disc.plate(crank).expect("a solid").expect("a plate");
    let area = PI * (625.0 - 2.0 * 4.0);
    assert!((plate.volume() - 4.0 * area).abs() < 1e-9);
    let wide = made(&with("width = 20", ""));
    let plate = wide.plate(crank).expect("a solid").expect("a plate");
    let area = 30.0 * 20.0 + PI * (100.0 - 2.0 * 4.0);
    assert!((plate.volume() - 4.0 * area).abs() < 1e-9);
}

#[test]
fn a_body_that_slides_is_drawn_as_a_block_along_its_slide() {
    let drawn = made(&with("", ""));
    let ram = drawn.body_named("ram").expect("a ram");
    let (outline, holes) = drawn.contours(ram).expect("a plate");
    let bounds = outline.bounds();
    assert!((bounds.max.x - 10.0).abs() < 1e-12 && (bounds.min.x + 10.0).abs() < 1e-12);
    assert!((bounds.max.y - 6.0).abs() < 1e-12 && (bounds.min.y + 6.0).abs() < 1e-12);
    assert!((outline.area() - 240.0 + (4.0 - PI)).abs() < 1e-12);
    assert_eq!(holes.len(), 1);
}

#[test]
fn a_given_mass_replaces_that_of_the_plate_in_whole_or_in_part() {
    let plain = link(&made(&with("", "")), "ram").mass.expect("a mass");
    let heavy = link(&made(&with("", "mass_kg = 2.5")), "ram");
    let heavy = heavy.mass.expect("a mass");
    assert_eq!(heavy.mass, 2.5);
    assert!((heavy.center - plain.center).norm() < 1e-12);
    let scaled = plain.inertia * (2.5 / plain.mass);
    assert!((heavy.inertia - scaled).norm() < 1e-12 * scaled.norm());
    let text = "mass_kg = 2.5\ncenter = [3, -4]\ninertia_kg_mm2 = 60";
    let given = link(&made(&with("", text)), "ram").mass.expect("a mass");
    assert_eq!(
        (given.mass, given.center.x, given.center.y),
        (2.5, 3.0, -4.0)
    );
    assert_eq!((given.inertia[(2, 2)], given.inertia[(0, 0)]), (60.0, 30.0));
}

#[test]
fn a_body_without_a_plate_is_neither_drawn_nor_a_part_unless_its_mass_is_given() {
    let abstract_ram = made(&with("", "plate = false"));
    let machine = abstract_ram.machine().expect("plates");
    let index = machine.link_named("ram").expect("a link");
    let link = &machine.links[index];
    assert!(link.mass.is_none() && link.shape.is_none() && link.surfaces.is_empty());
    assert!(machine.parts.iter().all(|part| part.name != "ram"));
    let figure = machine.figures.iter().find(|figure| figure.name == "ram");
    let sketch = &machine.sketches[figure.expect("a figure").sketch];
    assert!(sketch.lines.is_empty());
    let given = "plate = false\nmass_kg = 2\ninertia_kg_mm2 = 5";
    let machine = made(&with("", given)).machine().expect("plates");
    let part = machine.parts.iter().find(|part| part.name == "ram");
    let part = part.expect("a given part");
    assert_eq!((part.mass, part.file.as_str()), (Some(2.0), ""));
    assert_eq!(machine.validate(), Ok(()));
    let outlines = machine.sketches.iter().flat_map(|sketch| &sketch.lines);
    let bodies = outlines.filter(|line| line.role == LineRole::Body);
    assert!(bodies.clone().count() == 2);
    assert!(
        bodies
            .into_iter()
            .all(|line| matches!(line.path, LinePath::Contour(_)))
    );
}

#[test]
fn sides_of_an_outline_may_be_arcs_either_way_round() {
    // Half a circle of 20 mm, and a slot with round ends of 6 mm, written clockwise.
    for (corners, area) in [
        ("[[-20, 5, 1], [20, 5]]", 200.0 * PI),
        (
            "[[-15, 6], [15, 6, -1], [15, -6], [-15, -6, -1]]",
            360.0 + 36.0 * PI,
        ),
    ] {
        let composed = made(&with("", &format!("outline = {corners}")));
        let ram = composed.body_named("ram").expect("a ram");
        let (outline, _) = composed.contours(ram).expect("a plate");
        assert!((outline.area() - area).abs() < 1e-11, "{}", outline.area());
        assert!(outline.is_counter_clockwise());
    }
}

#[test]
fn contours_and_masses_that_cannot_be_are_told_by_key() {
    for (ram, stated) in [
        (
            "outline = [[0, 0], [1, 0]]",
            "bodies.ram.outline: is needed with three corners or more",
        ),
        (
            "outline = [[0, 0], [1, 0, 1, 2], [3, 4]]",
            "a corner is x and y, or x, y and the bulge of the side that starts there, not 4 numbers",
        ),
        (
            "outline = [[-20, 0, 1], [20, 0, 101]]",
            "bodies.ram.outline: must be -100 to 100, not 101",
        ),
        (
            "outline = [[-20, 0, 1], [20, 0, 1]]\ncorner_radius = 3",
            "bodies.ram.corner_radius: cannot be given together with arcs in the outline",
        ),
        (
            "outline = [[-20, 0, 1], [20, 0], [20, 30], [10, -30]]",
            "bodies.ram.outline: the outline crosses or touches itself at",
        ),
        (
            "outline = [[-20, -20], [20, 20], [20, -20], [-20, 20]]",
            "bodies.ram.outline: the outline crosses or touches itself at 0.000000, 0.000000 mm",
        ),
        (
            "outline = [[-20, -20], [20, -20], [0, 0.5]]",
            "bodies.ram.outline: the hole of 4 mm for the pin at 0, 0 mm is not inside the outline",
        ),
        (
            "outline = [[-9, -9], [9, -9], [9, 9], [-9, 9]]\ncorner_radius = 10",
            "bodies.ram.corner_radius: corners of 10 mm radius take 20.000000 mm of the side from [-9.0, -9.0] to [9.0, -9.0], which is 18.000000 mm long: at most 9.000000 mm fits there",
        ),
        (
            "corner_radius = 2",
            "bodies.ram.corner_radius: has no meaning without an outline",
        ),
        (
            "circle = { radius = 9 }\noutline = [[0, 0], [1, 0], [0, 1]]",
            "bodies.ram.circle: cannot be given together with outline",
        ),
        (
            "circle = { radius = 0 }",
            "bodies.ram.circle.radius: must be greater than 0, not 0",
        ),
        ("width = 4", "bodies.ram.width: must be 4.44"),
        (
            "thickness = -1",
            "bodies.ram.thickness: must be greater than 0, not -1",
        ),
        (
            "plate = false\nlayer = 2",
            "bodies.ram.layer: has no meaning for a body without a plate",
        ),
        (
            "center = [1, 2]",
            "bodies.ram.center: has no meaning without mass_kg",
        ),
        (
            "plate = false\nmass_kg = 2",
            "bodies.ram.inertia_kg_mm2: is needed with mass_kg for a body without a plate",
        ),
        (
            "mass_kg = 0",
            "bodies.ram.mass_kg: must be greater than 0, not 0",
        ),
    ] {
        let found = refused(&with("", ram));
        assert!(found.contains(stated), "{ram}\n  {found}\n  {stated}");
    }
}

/// Each change of a design without keys for plates, and whether plates, pins and shafts are designed then.
#[test]
fn hardware_is_designed_where_the_design_describes_or_weighs_plates() {
    const BARS: &str = r#"family = "machine"
HEAD
[frame.points]
O = [0, 0]
P = [50, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [15, 0] }
CRANK
[dyads.knee]
type = "RRR"
from = "crank.A"
to = "frame.P"
lengths = [45, 40]
side = "left"
bodies = ["rod", "rocker"]
joint = "B"
TAIL
"#;
    for (word, text, is_full) in [
        ("HEAD", "", false),
        ("HEAD", "hardware = \"none\"", false),
        ("HEAD", "hardware = \"full\"", true),
        ("HEAD", "gravity = [0, -9.81]", true),
        ("HEAD", "gravity = [0, -9.81]\nhardware = \"none\"", false),
        ("CRANK", "layer = 2", true),
        ("CRANK", "width = 9", true),
        ("CRANK", "thickness = 5", true),
        ("CRANK", "circle = { center = [0, 0], radius = 25 }", true),
        ("CRANK", "mass_kg = 0.1", true),
        ("CRANK", "mass_kg = 0.1\ninertia_kg_mm2 = 3", false),
        ("CRANK", "plate = false", false),
        ("TAIL", "[plates]", false),
        ("TAIL", "[plates]\nwidth = 9", true),
        ("TAIL", "[plates]\nwidth = 9\n[input]\nspeed_rpm = 20", true),
    ] {
        let text = BARS.replace(word, text);
        let text = ["HEAD", "CRANK", "TAIL"]
            .iter()
            .fold(text, |text, word| text.replace(word, ""));
        let machine = made(&text);
        let made = machine.machine().expect("plates");
        let bodies = 1..machine.bodies().len();
        let plates = bodies
            .clone()
            .filter(|&body| machine.contours(body).is_some())
            .count();
        let bars = bodies.filter(|&body| machine.bar(body).is_some()).count();
        assert_eq!(
            (plates, bars),
            if is_full { (3, 0) } else { (0, 3) },
            "{text}"
        );
        assert_eq!(machine.turned().is_empty(), !is_full, "{text}");
        assert_eq!(made.parts.len() > 1, is_full, "{text}");
        assert!(
            made.sketches
                .iter()
                .skip(1)
                .all(|sketch| !sketch.lines.is_empty()),
            "{text}"
        );
    }
}
