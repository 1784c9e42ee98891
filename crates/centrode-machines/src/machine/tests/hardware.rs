use centrode_geometry::{Outline, Point, Tolerance};

use super::{made, refused};
use crate::machine::Machine;
use centrode_kinematics::machine::{ArrangementTable, Form, LinkedMachine, Supply};

/// A press: a pair of elliptic gears, crank, rod and ram.
fn press(hardware: &str) -> String {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/designs/press.toml"
    );
    let text = std::fs::read_to_string(path).expect("a shipped design");
    text.replace("hardware = \"full\"", &format!("hardware = \"{hardware}\""))
        .replace("gap = 2.5", "gap = 1")
}

fn table<'a>(machine: &'a LinkedMachine, title: &str) -> &'a ArrangementTable {
    let tables = &machine.arrangement.tables;
    let found = tables.iter().find(|table| table.title.starts_with(title));
    found.unwrap_or_else(|| panic!("{title}: {tables:?}"))
}

fn supplies(machine: &LinkedMachine, supply: Supply) -> Vec<&str> {
    let parts = machine.parts.iter().filter(|part| part.supply == supply);
    parts.map(|part| &*part.name).collect()
}

#[test]
fn a_list_has_a_table_per_axis_with_what_sits_on_it_in_order() {
    let composed = made(&press("list"));
    let machine = composed.machine().expect("a machine");
    assert_eq!(machine.validate(), Ok(()));
    let shaft = table(&machine, "Axis frame.O: Ø10 ");
    let rows: Vec<String> = shaft.rows.iter().map(|row| row[1..].join("|")).collect();
    assert_eq!(
        rows,
        [
            "Circlip DIN 471 - 10 x 1||in its groove|bought",
            "frame|Ø10 H8|turns on it|given",
            "Shim DIN 988 - 10 x 16 x 1||between|bought",
            "pinion|Ø10 H7|Key DIN 6885-1 A 3 x 3 x 12|made",
            "Circlip DIN 471 - 10 x 1||in its groove|bought",
        ]
    );
    // Heights one on another: 6 mm of frame, 1 mm of shim, 12 mm of gear.
    let heights: Vec<&str> = shaft.rows[1..4].iter().map(|row| &*row[0]).collect();
    assert_eq!(heights, ["-7 to -1", "-8 to -7", "-20 to -8"]);
    assert!(shaft.title.ends_with("driven at its free end"));
    // One table for each of two equal pins.
    assert_eq!(table(&machine, "Axis crank.A: Ø6 ").rows.len(), 5);
    assert_eq!(table(&machine, "Axis rod.B: Ø6 ").rows.len(), 5);
    let frame = table(&machine, "Frame (given)");
    let held: Vec<&str> = frame.rows.iter().map(|row| &*row[0]).collect();
    assert_eq!(held, ["O", "axis-of-crank", "guide of ram"]);
    assert_eq!(frame.rows[1][1], "63.453");
    assert_eq!(
        supplies(&machine, Supply::Made),
        ["crank", "rod", "ram", "pinion", "wheel"]
    );
    let given = supplies(&machine, Supply::Given);
    for name in [
        "frame",
        "Guide of ram",
        "Shaft of pinion",
        "Pin through 13 mm",
    ] {
        assert!(given.contains(&name), "{name}: {given:?}");
    }
    // Solids of plates and gears alone.
    let forms = machine.shapes.iter().map(|shape| &shape.form);
    assert!(
        forms
            .into_iter()
            .all(|form| matches!(form, Form::Solids(_)))
    );
}

#[test]
fn a_frame_that_is_drawn_is_a_plate_with_its_bores_and_given_otherwise() {
    let outline =
        "[frame]\noutline = [[-20, -20], [160, -20], [160, 20], [-20, 20]]\nthickness = 8\n";
    let drawn =
        press("list").replacen("\n[frame.points]", &format!("\n{outline}[frame.points]"), 1);
    let composed = made(&drawn);
    let plate = composed.plate(0).expect("sound").expect("a plate");
    assert_eq!(plate.holes().len(), 2);
    assert_eq!((plate.bottom(), plate.top()), (-7.0, 1.0));
    let machine = composed.machine().expect("a machine");
    assert!(supplies(&machine, Supply::Made).contains(&"frame"));
    let tables = machine.arrangement.tables.iter();
    assert!(
        tables
            .into_iter()
            .all(|table| !table.title.starts_with("Frame"))
    );
    let narrow = drawn.replace("[160, -20], [160, 20]", "[50, -20], [50, 20]");
    let message = refused(&narrow);
    assert!(message.contains("frame.outline"), "{message}");
    assert!(made(&press("list")).plate(0).expect("sound").is_none());
}

/// Corners of the plates, gears and cams of all bodies that move, in the axes of the frame.
fn corners(composed: &Machine, input: f64) -> Vec<Point> {
    let machine = composed.outlined().expect("a machine");
    let fine = Tolerance::new(1e-2).expect("a tolerance");
    let mut found = Vec::new();
    for (index, link) in machine.links.iter().enumerate().skip(1) {
        for surface in &link.surfaces {
            let outline: &Outline = &machine.surfaces[*surface].outline;
            let corners = outline.flatten(fine).into_iter();
            found.extend(corners.map(|at| composed.place(index, at, input)));
        }
    }
    found
}

#[test]
fn a_frame_in_full_is_two_plates_round_all_that_moves_on_posts_around_it() {
    for (name, posts) in [
        ("press", 4),
        ("jansen-leg", 4),
        ("two-arm", 4),
        ("two-stage", 4),
    ] {
        let path = format!(
            "{}/../../tests/designs/{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = std::fs::read_to_string(path).expect("a shipped design");
        let text = text.replacen("hardware = \"full\"\n", "", 1);
        let composed = made(&text.replacen("\n[", "\nhardware = \"full\"\n[", 1));
        let lower = composed.plate(0).expect("sound").expect("a plate");
        let upper = composed.top_plate().expect("sound").expect("a plate");
        let screws = composed.frame_screws().expect("screws");
        assert_eq!(screws.at.len(), posts);
        for step in 0..97 {
            let input = composed.period() * f64::from(step) / 97.0;
            for at in corners(&composed, input) {
                assert!(lower.outline().contains(at), "{name}: {at} at {input}");
                let near = screws.at.iter().map(|post| (post - at).norm());
                let near = near.fold(f64::INFINITY, f64::min);
                // A post is as thick as two of its screws.
                assert!(near > screws.screw.diameter + 1.0, "{name}: {near}");
            }
        }
        // All parts lie between both plates.
        let machine = composed.outlined().expect("a machine");
        for link in &machine.links[1..] {
            for surface in &link.surfaces {
                let [low, high] = machine.surfaces[*surface].span;
                assert!(low > lower.top() && high < upper.bottom(), "{name}");
            }
        }
        // Four holes of screws in each, and bores of the upper plate above those of the lower one.
        let centers = |plate: &centrode_geometry::Solid| -> Vec<Point> {
            plate.holes().iter().map(|hole| hole.centroid()).collect()
        };
        let below = centers(&lower);
        for at in centers(&upper) {
            let off = below.iter().map(|below| (below - at).norm());
            assert!(off.fold(f64::INFINITY, f64::min) < 0.1, "{name}: {at}");
        }
        // Every shaft that ends in the upper plate has its hole there.
        for pieces in composed.turned_in_plates() {
            let piece = &pieces.pieces[0];
            let end = piece.at[2] + pieces.part.length();
            let axis = Point::new(piece.at[0], piece.at[1]);
            let body = composed.body_named(&piece.link).expect("a body");
            let axis = composed.place(body, axis, 0.0);
            let is_in_hole = upper.holes().iter().any(|hole| hole.contains(axis));
            assert!(
                end < upper.bottom() || is_in_hole,
                "{name}: {}",
                pieces.part.name
            );
        }
    }
    // The pinion of the press is held in both plates, its wheel in one: the rod passes above it.
    let press = made(&press("full"));
    let names: Vec<String> = press
        .top_holes()
        .into_iter()
        .map(|hole| hole.name)
        .collect();
    assert_eq!(names, ["O"]);
    let overhung = press.overhangs();
    assert_eq!(overhung.len(), 1);
    assert_eq!(overhung[0].name, "shaft of wheel");
    assert_eq!((overhung[0].diameter, overhung[0].length), (10.0, 6.0));
}

#[test]
fn plates_too_thin_for_screws_have_no_frame_in_full() {
    let thin = press("full").replace("thickness = 6", "thickness = 1");
    let message = refused(&thin);
    assert!(message.contains("hardware"), "{message}");
    assert!(message.contains("frame.outline"), "{message}");
    made(&thin.replace("\"full\"", "\"list\""));
}
