use super::*;
use centrode_gear::Gear;
use centrode_gear::design::GearPairDesign;
use centrode_gear::pitch::{Circle, Ellipse, PitchSpec, Polar};
use centrode_geometry::{Outline, Point, Tolerance, Vector};
use centrode_kinematics::machine::Keyway;
use std::f64::consts::TAU;

fn pair(pitch: PitchSpec) -> GearPair {
    let mut design = GearPairDesign::new(pitch);
    design.driver.bore = 12.0;
    design.driver.keyway = Some(Keyway {
        width: 4.0,
        depth: 1.8,
    });
    design.driven.bore = 10.0;
    GearPair::resolve(&design).expect("a sound pair")
}

fn elliptic() -> GearPair {
    pair(PitchSpec::Ellipse(Ellipse {
        eccentricity: 0.2679,
        module: Some(2.25),
        tooth_count: Some(23),
        ..Ellipse::default()
    }))
}

fn circular() -> GearPair {
    pair(PitchSpec::Circle(Circle {
        module: Some(2.0),
        tooth_count: Some(20),
        ..Circle::default()
    }))
}

/// A driver with a waist, whose tooth flanks there are concave.
fn pair_of_lobes() -> GearPair {
    pair(PitchSpec::Polar(Polar {
        expression: Some("1 + 0.35*cos(2*phi)".into()),
        module: Some(1.5),
        tooth_count: Some(40),
        ..Polar::default()
    }))
}

fn options() -> Options {
    Options::new(Tolerance::new(1e-3).expect("positive"))
}

fn text(bundle: &Bundle, name: &str) -> String {
    let (_, bytes) = bundle
        .files()
        .find(|(n, _)| *n == name)
        .expect("in the bundle");
    String::from_utf8(bytes.to_vec()).expect("text")
}

/// Names of the files but those of the convex bodies.
fn beside(bundle: &Bundle) -> Vec<&str> {
    let names = bundle.files().map(|(name, _)| name);
    names
        .filter(|name| !name.starts_with("collision/"))
        .collect()
}

#[test]
fn every_format_is_there_and_the_same_twice() {
    let pair = elliptic();
    let bundle = files(&pair, &Format::ALL, &options()).expect("made");
    let names = beside(&bundle);
    let expected = [
        "driver.dxf",
        "driver.svg",
        "driver-sheet.dxf",
        "driver-sheet.svg",
        "driver.pdf",
        "driver.step",
        "driver.stl",
        "driver.3mf",
        "driver.csv",
        "driver-pins.csv",
        "driven.dxf",
        "driven.svg",
        "driven-sheet.dxf",
        "driven-sheet.svg",
        "driven.pdf",
        "driven.step",
        "driven.stl",
        "driven.3mf",
        "driven.csv",
        "driven-pins.csv",
        "assembly.dxf",
        "assembly.svg",
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
    assert_eq!(
        bundle,
        files(&elliptic(), &Format::ALL, &options()).expect("made again")
    );
    let model = files(&pair, &[Format::Urdf], &options()).expect("made");
    assert_eq!(
        beside(&model),
        [
            "motion.csv",
            "motion.json",
            "driver.stl",
            "driven.stl",
            "machine.urdf",
            "play_pybullet.py",
        ]
    );
}

#[test]
fn a_tolerance_that_leaves_no_teeth_is_refused() {
    let coarse = Options::new(Tolerance::new(1.0).expect("positive"));
    let error = files(&elliptic(), &[Format::Dxf], &coarse).expect_err("too coarse");
    assert!(error.to_string().contains("0.2250 mm"), "{error}");
}

#[test]
fn a_tolerance_below_a_billionth_of_the_machine_is_refused_and_its_sheets_say_what_they_take() {
    let fine = Options::new(Tolerance::new(5e-8).expect("positive"));
    let error = files(&elliptic(), &[Format::Dxf], &fine).expect_err("too fine");
    let stated = error.to_string();
    assert!(
        stated.contains("too fine") && stated.contains("5.271e-8 mm"),
        "{stated}"
    );
    let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(2.0),
        tooth_count: Some(20),
        ..Circle::default()
    }));
    design.driver.width = 1e9;
    let wide = GearPair::resolve(&design).expect("a pair");
    let error = files(&wide, &[Format::Sheet], &options()).expect_err("too wide");
    assert!(error.to_string().contains("do not fit on A0"), "{error}");
}

#[test]
fn profiles_are_one_contour_of_at_most_400_arcs() {
    let pair = elliptic();
    for member in [Member::Driver, Member::Driven] {
        let arcs: Outline = pair.gear(member).outline().arcs(options().tolerance);
        assert_eq!(arcs.crossing(), None);
        assert!(
            arcs.segments().len() <= 400,
            "{} arcs",
            arcs.segments().len()
        );
    }
}

#[test]
fn only_a_linear_law_is_written_as_a_mimic_joint() {
    let curved = text(
        &files(&elliptic(), &[Format::Urdf], &options()).expect("made"),
        "machine.urdf",
    );
    assert!(
        !curved.contains("<mimic") && curved.contains("no mimic joint"),
        "{curved}"
    );
    let linear = text(
        &files(&circular(), &[Format::Urdf], &options()).expect("made"),
        "machine.urdf",
    );
    assert!(
        linear.contains("<mimic") && linear.contains("multiplier=\"-1\""),
        "{linear}"
    );
}

/// How far a point lies outside a gear, mm, judged by circles round it: whether any reaches inside.
fn outside(gear: &Gear, point: Point) -> f64 {
    let reaches = |radius: f64| {
        (0..32).any(|k| {
            let (sin, cos) = (TAU * f64::from(k) / 32.0).sin_cos();
            gear.outline()
                .contains(point + Vector::new(cos, sin) * radius)
        })
    };
    let radii = [0.0, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3];
    radii
        .into_iter()
        .find(|&r| reaches(r))
        .unwrap_or(f64::INFINITY)
}

#[test]
fn teeth_are_one_convex_body_each_or_several_where_they_are_concave() {
    let (plain, waisted) = (elliptic(), pair_of_lobes());
    for pair in [&plain, &waisted] {
        let machine = machine(pair).expect("linked");
        let simulated = crate::linked::simulated(
            &machine,
            &crate::linked::lines(&machine),
            options().tolerance,
        );
        let model = simulated.expect("made").model;
        assert!(model.note.contains("by at most"), "{}", model.note);
        for (link, gear) in model.links[1..].iter().zip([pair.driver(), pair.driven()]) {
            let width = gear.body().width;
            let (hub, teeth): (Vec<_>, Vec<_>) = link
                .collision
                .iter()
                .partition(|body| body.name.contains("hub"));
            assert!(!hub.is_empty());
            let volume: f64 = teeth.iter().map(|body| body.mesh.volume()).sum();
            let share = volume / (gear.outline().area() * width);
            assert!((0.05..0.5).contains(&share), "{share}");
            let count = gear.tooth_count() as usize;
            if std::ptr::eq(pair, &raw const plain) {
                assert_eq!((teeth.len(), hub.len()), (count, 1));
            } else {
                assert!(
                    (count..16 * count).contains(&teeth.len()),
                    "{}",
                    teeth.len()
                );
            }
            for body in &link.collision {
                assert!(
                    body.mesh.is_watertight() && body.mesh.volume() > 0.0,
                    "{}",
                    body.name
                );
                let vertices = &body.mesh.vertices;
                let (low, high) = vertices.split_at(vertices.len() / 2);
                assert!(low.iter().all(|v| v[2] == 0.0) && high.iter().all(|v| v[2] == width));
                // The hull's edges, which bridge concavities, in their middles.
                for (a, b) in low.iter().zip(low.iter().cycle().skip(1)) {
                    let middle = Point::new(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
                    let out = outside(gear, middle);
                    assert!(out <= 1e-3, "{} at {middle}: {out}", body.name);
                }
            }
        }
    }
}

#[test]
fn the_motion_is_dense_enough_to_draw_straight_lines_between() {
    let pair = elliptic();
    let table = text(
        &files(&pair, &[Format::Csv], &options()).expect("made"),
        "motion.csv",
    );
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|cell| cell.parse().expect("a number"))
                .collect()
        })
        .collect();
    assert!(rows.len() >= 721);
    for w in rows.windows(2) {
        let middle = 0.5 * (w[0][0] + w[1][0]);
        let error = (pair.driven_angle(middle) - 0.5 * (w[0][1] + w[1][1])).abs();
        assert!(error * pair.center_distance() < 1e-3);
    }
    let last = rows.last().expect("rows");
    assert!((last[0] - pair.cycle()).abs() < 1e-12 && (last[1] - pair.cycle()).abs() < 1e-9);
}

#[test]
fn outline_points_carry_role_and_outward_normal() {
    let pair = elliptic();
    let table = text(
        &files(&pair, &[Format::Csv], &options()).expect("made"),
        "driven.csv",
    );
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some("x_mm,y_mm,normal_x,normal_y,curvature_per_mm,role,tooth")
    );
    let mut roles = std::collections::BTreeSet::new();
    let outline = pair.driven().outline();
    for line in lines.step_by(7) {
        let cells: Vec<&str> = line.split(',').collect();
        let x: Vec<f64> = cells[..4]
            .iter()
            .map(|c| c.parse().expect("a number"))
            .collect();
        let at = |d: f64| centrode_geometry::Point::new(x[0] + d * x[2], x[1] + d * x[3]);
        if cells[5] == "tip" || cells[5] == "root" {
            assert!(
                outline.contains(at(-1e-4)) && !outline.contains(at(1e-4)),
                "{line}"
            );
        }
        roles.insert(cells[5].to_owned());
    }
    assert_eq!(
        roles.into_iter().collect::<Vec<_>>(),
        ["fillet", "flank", "root", "tip"]
    );
}

#[test]
fn solids_have_the_area_of_the_outline_less_the_bore() {
    let pair = elliptic();
    for member in [Member::Driver, Member::Driven] {
        let gear = pair.gear(member);
        let bore = gear.bore().expect("a bore").area();
        let volume = (gear.outline().area() - bore) * gear.body().width;
        let mesh = mesh(&pair, member, options().tolerance).expect("a solid");
        assert!(mesh.is_watertight());
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-3);
        let exact = solid(&pair, member).expect("a solid").volume();
        assert!((exact - volume).abs() < 1e-6);
    }
}

#[test]
fn kept_solids_stand_in_the_place_of_their_step_files() {
    let pair = circular();
    let options = Options {
        keep_solids: true,
        parts: Some(vec!["driven".into()]),
        ..options()
    };
    let bundle = files(&pair, &[Format::Step], &options).expect("made");
    assert_eq!(bundle.files().count(), 0);
    let exact = solid(&pair, Member::Driven).expect("a solid");
    assert_eq!(bundle.into_solids(), [("driven".to_owned(), exact)]);
}

#[test]
fn ratios_of_a_gear_of_a_machine_are_those_of_itself_and_its_mate() {
    let pair = elliptic();
    let stated = |of| {
        let data = of_both(&pair, of);
        let find = |name: &str| data.iter().find(|datum| datum.name.starts_with(name));
        let ratio = find("Ratio").expect("a ratio");
        (ratio.name.clone(), ratio.value.clone())
    };
    let ([name, value], [own, other]) = (
        <[String; 2]>::from(stated(None)),
        <[String; 2]>::from(stated(Some(Member::Driver))),
    );
    assert_eq!(
        (name.as_str(), own.as_str()),
        (
            "Ratio, driver : driven speed",
            "Ratio, this gear : mate speed"
        )
    );
    assert_eq!(value, other);
    // The ratios of an ellipse are their own inverses.
    assert_eq!(stated(Some(Member::Driven)).1, value);
    let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(2.0),
        tooth_count: Some(20),
        ..Circle::default()
    }));
    design.mean_ratio = [2, 1];
    let pair = GearPair::resolve(&design).expect("a sound pair");
    let stated = |of| {
        let data = of_both(&pair, of);
        (data[0].value.clone(), data[1].value.clone())
    };
    // Driving speed over driven speed, as ISO 1122-1 has it: the driver turns twice as fast.
    assert_eq!(stated(None), ("2:1".into(), "2".into()));
    assert_eq!(stated(Some(Member::Driver)), stated(None));
    assert_eq!(stated(Some(Member::Driven)), ("1:2".into(), "0.5".into()));
}

#[test]
fn a_centre_distance_without_backlash_may_only_be_longer() {
    let pair = circular();
    let data = by_thickness(&pair, 0.0);
    // IT8 of 30 to 50 mm is 39 um.
    assert_eq!(data[0].value, "40 +0.039 / 0");
    assert_eq!(half_backlash(&pair, 0.0), None);
    let half = half_backlash(&pair, 0.1).expect("some backlash");
    let sine = 20_f64.to_radians().sin();
    assert!((half - 0.1 / (4.0 * sine)).abs() < 1e-12);
}

#[test]
fn a_gear_without_a_bore_names_no_datum() {
    let circle = Circle {
        module: Some(2.0),
        tooth_count: Some(40),
        ..Circle::default()
    };
    let mut design = GearPairDesign::new(PitchSpec::Circle(circle));
    (design.driver.width, design.driven.width) = (12.0, 12.0);
    design.driver.bore = 12.0;
    let pair = GearPair::resolve(&design).expect("a sound pair");
    let runout = |member| {
        let data = flank_tolerances(&pair, member);
        let runout = data.into_iter().find(|datum| datum.symbol == "FrT");
        runout.expect("a runout").name
    };
    assert_eq!(runout(Member::Driver), "Runout to A, of M over pins");
    assert_eq!(runout(Member::Driven), "Runout of M over pins");
}
