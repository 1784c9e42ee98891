use super::*;
use centrode_geometry::Tolerance;
use centrode_groove::SpiralShaftDesign;
use std::f64::consts::TAU;

fn shaft(holes: u32) -> SpiralShaft {
    let design = SpiralShaftDesign {
        moved_distance: Some(2.05),
        holes,
        ..SpiralShaftDesign::default()
    };
    SpiralShaft::resolve(&design).expect("resolves")
}

fn options() -> Options {
    Options::new(Tolerance::new(0.01).expect("positive"))
}

fn text(bundle: &Bundle, name: &str) -> String {
    let found = bundle.files().find(|(n, _)| *n == name);
    String::from_utf8(found.expect("in the bundle").1.to_vec()).expect("text")
}

#[test]
fn every_file_is_there_and_the_same_twice() {
    let bundle = files(&shaft(4), &Format::ALL, &options()).expect("made");
    let names: Vec<&str> = bundle.files().map(|(name, _)| name).collect();
    let expected = [
        "groove.dxf",
        "groove.svg",
        "shaft.dxf",
        "shaft.svg",
        "slider.dxf",
        "slider.svg",
        "shaft-sheet-1.dxf",
        "shaft-sheet-1.svg",
        "shaft-sheet-2.dxf",
        "shaft-sheet-2.svg",
        "shaft.pdf",
        "slider-sheet.dxf",
        "slider-sheet.svg",
        "slider.pdf",
        "pin.dxf",
        "pin.svg",
        "pin-sheet.dxf",
        "pin-sheet.svg",
        "pin.pdf",
        "pin.step",
        "pin.stl",
        "pin.3mf",
        "shaft.step",
        "shaft.stl",
        "shaft.3mf",
        "slider.step",
        "slider.stl",
        "slider.3mf",
        "lead-table.csv",
        "schedule.csv",
        "tool-path.csv",
        "groove.ngc",
        "assembly-sheet.dxf",
        "assembly-sheet.svg",
        "assembly.pdf",
        "assembly.3mf",
        "assembly.step",
        "motion.csv",
        "motion.json",
        "parts.csv",
        "machine.urdf",
        "play_pybullet.py",
        "machine.xml",
        "play_mujoco.py",
        "sheets.pdf",
    ];
    assert_eq!(names, expected);
    let again = files(&shaft(4), &Format::ALL, &options()).expect("made");
    assert!(bundle == again);
}

#[test]
fn a_tolerance_that_leaves_no_groove_is_refused() {
    let coarse = Options::new(Tolerance::new(1.0).expect("positive"));
    let refused = files(&shaft(4), &[Format::Stl], &coarse);
    assert!(matches!(refused, Err(ExportError::Tolerance { .. })));
}

#[test]
fn the_lead_table_has_a_row_every_degree_of_28_turns() {
    let table = text(
        &files(&shaft(14), &[Format::Csv], &options()).expect("made"),
        "lead-table.csv",
    );
    assert_eq!(table.lines().count(), 1 + 28 * 360 + 1);
    let last = table.lines().last().expect("rows");
    let cells: Vec<f64> = last
        .split(',')
        .map(|c| c.parse().expect("number"))
        .collect();
    assert!((cells[0] - 28.0 * 360.0).abs() < 1e-9 && cells[1].abs() < 1e-12);
}

/// Moves of a program: X, A, Z in force at the end of each G1 line, with its feed word.
fn moves(program: &str) -> Vec<[f64; 4]> {
    let mut place = [0.0; 4];
    let mut moves = Vec::new();
    for line in program.lines() {
        let cutting = line.starts_with("G1");
        if !line.starts_with('G') {
            continue;
        }
        for word in line.split(' ') {
            let (letter, value) = word.split_at(1);
            let slot = ["X", "A", "Z", "F"].iter().position(|l| *l == letter);
            if let (Some(slot), Ok(value)) = (slot, value.parse()) {
                place[slot] = value;
            }
        }
        if cutting {
            moves.push(place);
        }
    }
    moves
}

#[test]
fn the_program_follows_the_groove_at_its_feed_and_never_turns_back() {
    let shaft = shaft(4);
    let tolerance = options().tolerance;
    let program = program(&shaft, tolerance);
    let moves = moves(&program);
    let (r, turns) = (15.0, shaft.traverse().turns());
    for pair in moves.windows(2) {
        let [before, after] = [pair[0], pair[1]];
        assert!(after[1] >= before[1] - 1e-9, "A turns back");
        // On the way: the middle of each chord is near the centre line.
        let middle = 0.5 * (before[1] + after[1]);
        let turn = f64::from(turns) * 360.0;
        let there = (middle.rem_euclid(turn)).to_radians();
        if before[2] == after[2] && after[1] - before[1] < 90.0 {
            let off = shaft.groove().center(there).y - 0.5 * (before[0] + after[0]);
            assert!(off.abs() < 1.05 * tolerance.mm(), "{off}");
            let length = (r * (after[1] - before[1]).to_radians()).hypot(after[0] - before[0]);
            // Minutes for the block, times its length.
            assert!(
                (length * after[3] - 150.0).abs() < 0.5,
                "{}",
                length * after[3]
            );
        }
    }
    let deepest = moves.iter().map(|m| m[2]).fold(f64::INFINITY, f64::min);
    assert!((deepest - 11.0).abs() < 1e-9);
    let last = moves.last().expect("moves");
    assert!((last[1] - 4.0 * f64::from(turns) * 360.0).abs() < 1e-4);
    // Nothing turns before the operator has been asked.
    let stop = program.find("M0").expect("asks");
    assert!(stop < program.find("G1 ").expect("cuts") && !program.contains("M3"));
}

#[test]
fn the_developed_walls_stand_half_the_width_from_the_centre_line() {
    let shaft = shaft(3);
    let edges = shaft.wall_edges(options().tolerance).expect("fits");
    let way = shaft
        .groove()
        .way(0.0, Tolerance::new(1e-5).expect("positive"));
    let around = TAU * 15.0;
    assert!(edges.len() >= 8, "{}", edges.len());
    for edge in edges.iter().step_by(3) {
        for point in edge.iter().step_by(5) {
            let nearest = way
                .windows(2)
                .map(|pair| {
                    let shift = ((pair[0].x - point.x) / around).round() * around;
                    let (a, b) = (pair[0].coords, pair[1].coords);
                    let q = point.coords + nalgebra::Vector2::new(shift, 0.0);
                    let along = b - a;
                    let share = ((q - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                    (q - a - along * share).norm()
                })
                .fold(f64::INFINITY, f64::min);
            assert!((nearest - 5.0).abs() < 1e-4, "{nearest}");
        }
    }
}

#[test]
fn a_moving_box_has_the_files_of_shaft_and_gears() {
    use centrode_groove::{EllipticGears, MovingBox, MovingBoxDesign, Scheme};
    let mut design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    design.shaft.holes = 3;
    let machine = MovingBox::resolve(&design).expect("resolves");
    let formats = [Format::Csv, Format::Mjcf];
    let bundle = moving_box_files(&machine, &formats, &options()).expect("made");
    let names: Vec<&str> = bundle.files().map(|(name, _)| name).collect();
    for name in [
        "lead-table.csv",
        "motion.csv",
        "machine.xml",
        "gears-driver.stl",
        "gears-driven.csv",
    ] {
        assert!(names.contains(&name), "{name} in {names:?}");
    }
    let table = text(&bundle, "motion.csv");
    let row = |line: &str| -> Vec<f64> {
        line.split(',')
            .map(|c| c.parse().expect("number"))
            .collect()
    };
    let last = row(table.lines().last().expect("rows"));
    assert!((last[0] - last[2]).abs() < 1e-9 && last[4].abs() < 1e-9);
    let model = text(&bundle, "machine.xml");
    for part in [
        "type=\"slide\"",
        "name=\"driven\"",
        "file=\"gears-driven.stl\"",
    ] {
        assert!(model.contains(part), "{part} in\n{model}");
    }
}

#[test]
fn the_gears_of_the_model_turn_the_shaft_as_the_law_has_it() {
    use centrode_groove::{EllipticGears, MovingBoxDesign, Scheme};
    let mut design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    design.shaft.pick = 0.3;
    let machine = MovingBox::resolve(&design).expect("resolves");
    let machine = Parts::of_box(&machine).expect("gears");
    let gears = machine.gears.as_ref().expect("gears");
    let turned = |input: f64| input - gears.drive.phase - gears.slowest();
    let mesh = |input: f64| gears.pair.driven_angle(-turned(input));
    let rest = gears.pair.driven_angle(gears.slowest()) + gears.drive.phase;
    for i in 0..100 {
        let input = 0.13 * f64::from(i) - 2.0;
        let shaft = -machine.turn(input).position;
        let off = (mesh(input) - shaft - rest).rem_euclid(TAU);
        assert!(off.min(TAU - off) < 1e-9, "{input}: {off}");
    }
}
