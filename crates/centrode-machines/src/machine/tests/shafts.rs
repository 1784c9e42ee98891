use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Point, Solid, Vector};

use super::made;
use crate::machine::{Hold, Machine};
use centrode_kinematics::machine::{Form, LinkedMachine, Supply};

/// A crank with an arm fixed to it, driven by two circular gears.
const TRAIN: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = { ratio = -1 }
[bodies.crank]
on = "frame"
mesh = { gear = "wheel", with = "pinion", direction_deg = 0 }
points = { A = [0, 30] }
[bodies.arm]
fixed_to = "crank"
turned_deg = -29
points = { tip = [60, 0] }
[pairs.drive]
pitch = { kind = "circle", module = 2, tooth_count = 24 }
driver = { width = 12, bore = 10KEY }
driven = { width = 12, bore = 10KEY }
[gears.pinion]
pair = "drive"
role = "driver"
on = "shaft"
[gears.wheel]
pair = "drive"
role = "driven"
on = "crank"
mount_deg = 17
[plates]
thickness = 6
gap = 1
width = 16
pin_diameter = 6
"#;

const KEY: &str = ", keyway = { width = 3, depth = 1.4 }";

fn train(key: &str) -> Machine {
    made(&TRAIN.replace("KEY", key))
}

/// Solids of a link, its plate first.
fn solids<'a>(machine: &'a LinkedMachine, name: &str) -> &'a [Solid] {
    let link = machine.link_named(name).expect("a link");
    let shape = machine.links[link].shape.expect("a shape");
    match &machine.shapes[shape].form {
        Form::Solids(solids) => solids,
        _ => panic!("{name}"),
    }
}

/// Direction in which a hole about a point reaches farthest, by the corners of its keyway, rad.
fn keyway(hole: &Outline, about: Point) -> f64 {
    let ways: Vec<Vector> = hole
        .segments()
        .iter()
        .map(|s| s.at(-1.0).point - about)
        .collect();
    let most = ways.iter().map(|way| way.norm()).fold(0.0, f64::max);
    let corners = ways.iter().filter(|way| way.norm() > most - 1e-9);
    let sum: Vector = corners.sum();
    sum.y.atan2(sum.x)
}

fn is_whole(turns: f64) -> bool {
    (turns - turns.round()).abs() < 1e-9
}

#[test]
fn plate_gear_and_shaft_of_a_body_have_their_keyways_on_one_line() {
    let composed = train(KEY);
    let machine = composed.machine().expect("a machine");
    let [crank, arm] = ["crank", "arm"].map(|name| solids(&machine, name));
    // The crank's hole on its axis, its wheel's bore, the arm's hole.
    let origin = Point::origin();
    let about = |solid: &Solid| {
        let holes = solid.holes().iter();
        let near = holes.min_by(|a, b| {
            a.centroid()
                .coords
                .norm()
                .total_cmp(&b.centroid().coords.norm())
        });
        keyway(near.expect("a hole"), origin)
    };
    let [plate, wheel, arm] = [&crank[0], &crank[1], &arm[0]].map(about);
    assert!((plate - 17_f64.to_radians()).abs() < 1e-9, "{plate}");
    assert!((wheel - plate).abs() < 1e-9);
    // Turned with the arm by -29 degrees.
    assert!((arm - 46_f64.to_radians()).abs() < 1e-9, "{arm}");
    let turned = composed.turned_shafts();
    let shaft = turned
        .iter()
        .find(|all| all.part.name == "shaft-wheel")
        .expect("a shaft");
    let piece = &shaft.pieces[0];
    assert_eq!(piece.link, "crank");
    assert!(is_whole((piece.turn[2] - plate) / TAU));
    // A key for the wheel, one for each plate: 12 in 12 mm, 6 in 6 mm.
    let mut long: Vec<f64> = shaft.keys.iter().map(|seated| seated.key.length).collect();
    long.sort_by(f64::total_cmp);
    assert_eq!(long, [6.0, 6.0, 12.0]);
    // Round ends would leave half of 6 mm.
    let square = |long: f64| {
        let mut keys = shaft.keys.iter().map(|seated| seated.key);
        keys.any(|key| key.length == long && key.has_square_ends)
    };
    assert!(square(6.0) && !square(12.0));
    // A straight stretch of 6 mm under each, its half round ends beyond it.
    for (keyway, ends) in shaft.part.keyways() {
        let round = 1.5 * f64::from(u8::from(ends[0]) + u8::from(ends[1]));
        let inside = |at: f64| at >= keyway[0] && at <= keyway[1];
        let mut keys = shaft.keys.iter();
        assert!(keys.any(|seated| {
            let key = seated.key;
            let needed = key.length + if key.has_square_ends { round } else { 0.0 };
            inside(seated.at + 0.5 * key.length) && keyway[1] - keyway[0] >= needed - 1e-9
        }));
    }
    let axis = composed.body_named("crank").expect("a crank");
    let fits = composed
        .shafts()
        .iter()
        .find(|shaft| shaft.body == axis)
        .expect("a shaft");
    let holds = |name: &str| {
        fits.parts
            .iter()
            .find(|part| part.name == name)
            .expect(name)
            .hold
    };
    assert_eq!(holds("frame"), Hold::Turning);
    assert!(
        ["crank", "arm", "wheel"]
            .into_iter()
            .all(|name| matches!(holds(name), Hold::Keyed(_)))
    );
}

#[test]
fn a_plate_that_turns_on_a_shaft_has_a_round_hole_of_its_size_in_the_class_of_pins() {
    let composed = train(KEY);
    let holes = composed.pin_holes(0).expect("a frame");
    assert_eq!(holes.len(), 2);
    for hole in holes {
        assert_eq!(
            (hole.hub.bore, hole.hub.keyway, &*hole.hub.bore_fit),
            (10.0, None, "H8")
        );
        assert!((hole.outline().area() - 25.0 * PI).abs() < 1e-9);
    }
    let shafts = composed.turned_shafts();
    assert!(composed.pins_in_plates().is_empty());
    // Seats of what turns with it h6, out to its ends, the rest f7; the input's goes on by three diameters.
    let [pinion, wheel] = ["pinion", "wheel"].map(|name| {
        let name = format!("shaft-{name}");
        shafts
            .iter()
            .find(|all| all.part.name == name)
            .expect("a shaft")
    });
    let classes = |all: &centrode_kinematics::machine::TurnedPieces, keyed: bool| {
        let steps = all.part.steps.iter();
        let plain = steps.filter(|step| step.ring.is_none() && step.is_keyed == keyed);
        plain.map(|step| step.class.clone()).collect::<Vec<_>>()
    };
    let seats = classes(pinion, true);
    assert_eq!(seats.iter().filter(|class| *class == "h6").count(), 1);
    assert_eq!(classes(pinion, false), ["h6", "f7", "f7"]);
    // One length of the other's, below the plate that turns on it.
    let running = classes(wheel, false);
    assert_eq!(running.iter().filter(|class| *class == "f7").count(), 1);
    // 12 + 1 + 6 of gear and frame, 0.3 of clearance between the rings, the end, and groove and land of the ring.
    assert!((pinion.part.length() - 19.3 - 30.0 - 1.7).abs() < 1e-9);
}

#[test]
fn without_keyways_the_customer_fixes_parts_and_other_bores_are_listed() {
    let plain = train("");
    let machine = plain.machine().expect("a machine");
    let remarks: Vec<&str> = machine.parts.iter().map(|part| &*part.remark).collect();
    assert!(
        remarks.iter().all(|remark| !remark.contains(';')),
        "{remarks:?}"
    );
    let shafts = plain.turned_shafts();
    assert!(
        shafts
            .iter()
            .all(|all| all.keys.is_empty() && all.part.keyway.is_none())
    );
    let parts = plain.shafts().iter().flat_map(|shaft| &shaft.parts);
    let (given, turning): (Vec<_>, Vec<_>) = parts.partition(|part| part.hold == Hold::Given);
    let names = |parts: Vec<&crate::machine::ShaftPart>| -> Vec<String> {
        parts.iter().map(|part| part.name.clone()).collect()
    };
    assert_eq!(names(given), ["pinion", "crank", "arm", "wheel"]);
    assert_eq!(names(turning), ["frame", "frame"]);
    // A gear without a bore is reported, and leaves the pins as they are.
    let solid = made(&TRAIN.replace("bore = 10KEY", "bore = 0"));
    let parts = solid.machine().expect("a machine").parts;
    let wheel = parts
        .iter()
        .find(|part| part.name == "wheel")
        .expect("a wheel");
    assert!(wheel.remark.ends_with("not joined"), "{}", wheel.remark);
}

#[test]
fn a_cam_through_which_the_shaft_of_another_body_goes_has_a_bracket() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/designs/index-table.toml"
    );
    let text = std::fs::read_to_string(path).expect("a shipped design");
    let table = made(&text);
    let machine = table.machine().expect("a machine");
    let bracket = machine
        .parts
        .iter()
        .find(|part| part.name == "Bracket of still");
    let bracket = bracket.expect("a bracket");
    assert_eq!(
        (bracket.supply, bracket.links.clone()),
        (Supply::Given, vec![0])
    );
    let around = table
        .shafts()
        .iter()
        .find(|shaft| shaft.name == "hub-pinion")
        .expect("a shaft");
    let cam = around
        .parts
        .iter()
        .find(|part| part.name == "still")
        .expect("a cam");
    assert_eq!(cam.hold, Hold::Bracket);
    // Every other gear turns with a shaft; keyways at right angles would not be one line.
    let keyed = |name: &str| {
        let mut parts = table.shafts().iter().flat_map(|shaft| &shaft.parts);
        parts.any(|part| part.name == name && matches!(part.hold, Hold::Keyed(_)))
    };
    assert!(
        ["hub-wheel", "hub-pinion", "lever-gear", "table-wheel"]
            .into_iter()
            .all(keyed)
    );
    let turned = text.replace(
        "hub-pinion = { pair = \"advance\", role = \"driver\", on = \"hub\" }",
        "hub-pinion = { pair = \"advance\", role = \"driver\", on = \"hub\", mount_deg = 90 }",
    );
    let table = made(&turned);
    let parts = table.machine().expect("a machine").parts;
    // The shaft is that of the pinion, next to the plates.
    let wheel = parts
        .iter()
        .find(|part| part.name == "hub-wheel")
        .expect("a wheel");
    assert!(
        wheel.remark.ends_with("bore or keyway differs from shaft"),
        "{}",
        wheel.remark
    );
}

/// Lower and upper faces of all that a turned part carries, in rising order.
fn faces(composed: &Machine, all: &centrode_kinematics::machine::TurnedPieces) -> Vec<[f64; 2]> {
    let piece = &all.pieces[0];
    let body = composed.body_named(&piece.link).expect("a body");
    let axis = Point::new(piece.at[0], piece.at[1]);
    let here = |other: usize, at: Point| {
        let off = |input: f64| composed.place(body, axis, input) - composed.place(other, at, input);
        [0.0, 0.7, 2.9]
            .into_iter()
            .all(|input| off(input).norm() < 1e-6)
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    for other in 0..composed.bodies().len() {
        let holes = composed.pin_holes(other).unwrap_or_default();
        if holes.into_iter().any(|hole| here(other, hole.at)) {
            let bottom = composed.bottom(other);
            found.push([bottom, bottom + composed.thickness(other)]);
        }
    }
    for gear in composed.gears() {
        let other = composed.body_named(gear.body_name()).expect("a body");
        if here(other, gear.at) {
            let bottom = composed.gear_bottom(gear);
            found.push([bottom, bottom + gear.gear().body().width]);
        }
    }
    let rings = all.spacers.iter();
    found.extend(rings.map(|(ring, at)| [piece.at[2] + at, piece.at[2] + at + ring.length]));
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    found
}

#[test]
fn rings_fill_the_gaps_between_parts_on_a_shaft_or_pin() {
    let train = train(KEY);
    let machine = train.machine().expect("a machine");
    for all in train.turned() {
        let faces = faces(&train, all);
        assert!(!all.spacers.is_empty(), "{}", all.part.name);
        for pair in faces.windows(2) {
            assert!(
                (pair[1][0] - pair[0][1]).abs() < 1e-9,
                "{}: {faces:?}",
                all.part.name
            );
        }
    }
    // Gaps of 1 mm on shafts of 10 mm: between gear and frame, and above every plate but the last of an axis.
    let mut listed = machine.parts.iter();
    let shims = listed.find(|part| part.name == "Shim DIN 988 - 10 x 16 x 1");
    let shims = shims.expect("shims");
    assert_eq!((shims.supply, shims.quantity()), (Supply::Bought, 3));
    // Without gaps only an empty layer is filled: one plate is 6 mm thick.
    let close = made(&TRAIN.replace("KEY", KEY).replace("gap = 1", "gap = 0"));
    for all in close.turned() {
        for (ring, _) in &all.spacers {
            assert!(
                (ring.length - 6.0).abs() < 1e-9,
                "{}: {ring:?}",
                all.part.name
            );
        }
    }
    // A shaft of no size of the standard has none.
    let odd = TRAIN.replace("KEY", "").replace("bore = 10", "bore = 10.5");
    assert!(made(&odd).turned().iter().all(|all| all.spacers.is_empty()));
    // A wider gap has a sleeve, made from its sheet where all is designed.
    let wide = TRAIN.replace("KEY", KEY).replace("gap = 1", "gap = 4.5");
    let wide = made(&format!("hardware = \"full\"\n{wide}"));
    let machine = wide.machine().expect("a machine");
    let mut listed = machine.parts.iter();
    let sleeves = listed.find(|part| part.name == "Sleeve 10 x 16 x 4.5");
    let sleeves = sleeves.expect("sleeves");
    assert_eq!((sleeves.supply, sleeves.quantity()), (Supply::Made, 4));
    assert_eq!(sleeves.file, "sleeve-10x16x4-5");
    let volume = PI * (64.0 - 25.0) * 4.5;
    assert!((sleeves.mass.expect("a mass") - volume * 7850e-9).abs() < 1e-12);
}

#[test]
fn heat_treatments_are_those_that_the_design_states() {
    let stated = ", shaft_heat_treatment = \"case-hardened\"";
    let text = TRAIN.replace("KEY", &format!("{KEY}{stated}"));
    let hard = made(&text);
    let shafts = hard.turned_shafts();
    assert!(
        shafts
            .iter()
            .all(|all| all.part.heat_treatment == "case-hardened")
    );
    let plain = train(KEY).turned_shafts();
    assert!(plain.iter().all(|all| all.part.heat_treatment.is_empty()));
    let two_lines = text.replace("case-hardened", "case\\nhardened");
    assert!(super::refused(&two_lines).contains("shaft_heat_treatment"));
}
