use std::collections::BTreeSet;
use std::f64::consts::TAU;

use centrode_formats::sheet::{number, overlaps};
use centrode_geometry::{Point, Solid, Tolerance};
use centrode_kinematics::machine::{Column, Form, JointKind, LineRole, Quantity};
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;

use super::*;
use crate::linked::{self, arrangement};
use crate::picture::Picture;

fn mechanism(change: impl Fn(&mut ThreeArmDesign)) -> ThreeArm {
    let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
    change(&mut design);
    ThreeArm::resolve(&design).expect("a mechanism")
}

fn options() -> Options {
    Options::new(Tolerance::new(1e-2).expect("positive"))
}

fn names(bundle: &Bundle) -> BTreeSet<String> {
    bundle.files().map(|(name, _)| name.to_owned()).collect()
}

#[test]
fn every_part_has_a_file_of_every_format_the_same_each_time() {
    let machine = mechanism(|_| {});
    let bundle = files(&machine, &Format::ALL, &options()).expect("written");
    let names = names(&bundle);
    for part in ThreeArmPart::ALL {
        let endings: &[&str] = match part {
            ThreeArmPart::Assembly => &["dxf", "svg", "pdf"],
            _ => &["dxf", "svg", "pdf", "step", "stl", "3mf"],
        };
        for ending in endings {
            let name = format!("{part}.{ending}");
            assert!(names.contains(&name), "{name}");
        }
        let sheets = names
            .iter()
            .any(|n| n.starts_with(&format!("{part}-sheet")));
        assert!(sheets, "{part}");
    }
    let machine_files = [
        "machine.urdf",
        "machine.xml",
        "motion.csv",
        "motion.json",
        "parts.csv",
        "play_mujoco.py",
        "play_pybullet.py",
        "cam.csv",
        "sun.csv",
        "tray.stl",
        "ground.stl",
    ];
    for name in machine_files {
        assert!(names.contains(name), "{name}");
    }
    for body in [
        "sun_tooth_0",
        "sun_hub",
        "intermediate_tooth_36",
        "arm_housing",
        "arm_flake_left",
    ] {
        let begins = format!("collision/{body}");
        assert!(names.iter().any(|name| name.starts_with(&begins)), "{body}");
    }
    assert!(
        !names
            .iter()
            .any(|name| name.starts_with("collision/planet"))
    );
    let again = files(&machine, &Format::ALL, &options()).expect("written");
    assert!(bundle.files().eq(again.files()));
}

#[test]
fn parts_and_formats_asked_for_are_all_that_is_written() {
    let machine = mechanism(|_| {});
    let mut options = options();
    options.parts = Some(["cam", "planet"].map(String::from).to_vec());
    let some = files(&machine, &[Format::Dxf], &options).expect("written");
    let expected = ["cam.dxf", "planet.dxf"].map(String::from);
    assert_eq!(names(&some), BTreeSet::from(expected));
    options.parts = Some(
        ThreeArmPart::ALL
            .map(|part| part.name().to_owned())
            .to_vec(),
    );
    let all = files(&machine, &[Format::Dxf], &options).expect("every name is known");
    assert_eq!(all.files().count(), ThreeArmPart::ALL.len());
    options.parts = Some(vec!["arm".into()]);
    let error = files(&machine, &[Format::Dxf], &options).expect_err("no such part");
    let error = error.to_string();
    assert!(
        error.starts_with("a three-arm mechanism has no part named arm; there are sun,"),
        "{error}"
    );
    assert!(error.contains("push-rod"), "{error}");
}

#[test]
fn words_touch_nothing_on_the_sheets_of_plates() {
    let machine = mechanism(|_| {});
    let machine = Parts::new(&machine).expect("resolved");
    let design = machine.mechanism.design();
    let tolerance = options().tolerance;
    let mut seen = 0;
    for plate in ThreeArmPart::ALL
        .into_iter()
        .filter_map(|p| machine.plate_of(p))
    {
        let sheet = options().sheet;
        let sheets = plate.sheets(&design.drawing, &design.title, &sheet, tolerance);
        for sheet in sheets.expect("laid out") {
            assert_eq!(overlaps(&sheet), [], "{}", plate.name);
            seen += 1;
        }
    }
    assert!(seen >= 9, "{seen}");
}

#[test]
fn the_general_arrangement_lists_every_part_and_its_words_touch_nothing() {
    for arms in [1, 3] {
        let machine = mechanism(|d| d.arms = arms);
        let tip = machine.tip(machine.picking(0), 0).position;
        let lengths = [
            tip.x,
            -machine.ground(),
            machine.trajectory().height(),
            machine.design().work.plant_spacing,
        ];
        let kept = [machine.center_distance(), machine.design().arm.tip_distance];
        let lengths = lengths.map(|length| number(length, 3));
        let stated = [
            lengths.to_vec(),
            kept.map(|length| number(length, 4)).to_vec(),
        ]
        .concat();
        let machine = Parts::new(&machine).expect("resolved");
        let machine = linked(&machine).expect("linked");
        let sheets = arrangement(&machine, &options().sheet, options().tolerance);
        let sheets = sheets.expect("laid out");
        for sheet in &sheets {
            assert_eq!(overlaps(sheet), [], "{arms} arms");
        }
        let words: Vec<&str> = sheets
            .iter()
            .flat_map(|sheet| sheet.drawing.plain())
            .filter_map(|entity| match &entity.shape {
                centrode_formats::drawing::EntityShape::Text(text) => Some(text.words.as_str()),
                _ => None,
            })
            .collect();
        for part in ThreeArmPart::ALL {
            assert!(words.contains(&part.title()), "{part}");
        }
        for length in &stated {
            assert!(words.contains(&length.as_str()), "{length}: {words:?}");
        }
        for balloon in ["1", "2", "3", "9, 10, 11", "13"] {
            assert!(words.contains(&balloon), "{balloon}");
        }
    }
}

#[test]
fn meshes_are_closed_and_as_large_as_their_solids() {
    let machine = mechanism(|_| {});
    let machine = Parts::new(&machine).expect("resolved");
    let tolerance = options().tolerance;
    for plate in ThreeArmPart::ALL
        .into_iter()
        .filter_map(|p| machine.plate_of(p))
    {
        let solid = plate.solid().expect("a solid");
        let (mesh, volume) = (solid.mesh(tolerance).expect("apart"), solid.volume());
        assert!(mesh.is_watertight(), "{}", plate.name);
        assert!(
            (mesh.volume() / volume - 1.0).abs() < 5e-3,
            "{}",
            plate.name
        );
    }
    for shape in linked(&machine).expect("linked").shapes {
        let meshes = match &shape.form {
            Form::Mesh(mesh, _) => vec![mesh.clone()],
            Form::Solids(solids) => {
                let mesh = |solid: &Solid| solid.mesh(tolerance).expect("apart");
                solids.iter().map(mesh).collect()
            }
            Form::Turned(part) => {
                let body = part.solid().expect("a body");
                vec![body.mesh(tolerance).expect("a mesh")]
            }
            Form::Body(_) => panic!("no such body in an arm"),
        };
        for mesh in meshes {
            assert!(
                mesh.is_watertight() && mesh.volume() > 0.0,
                "{}",
                shape.name
            );
        }
    }
}

#[test]
fn the_model_has_every_link_once_and_every_law_a_joint() {
    for arms in [1, 3, 4] {
        let machine = mechanism(|d| d.arms = arms);
        let machine = Parts::new(&machine).expect("resolved");
        let linked = linked(&machine).expect("linked");
        // Base, tray, ground, carrier, sun; gears, cam, arm, fork and rod of each chain.
        assert_eq!(linked.links.len() as u32, 5 + 6 * arms);
        assert_eq!(linked.joints.len() + 1, linked.links.len());
        for (joint, about) in linked.joints.iter().enumerate() {
            let moves = about.kind != JointKind::Fixed;
            let stated = |column: &Column| matches!(column.quantity, Quantity::Joint { joint: j, .. } if j == joint);
            assert_eq!(linked.columns.iter().any(stated), moves);
        }
        let options = options();
        let formats = [Format::Urdf, Format::Mjcf];
        let mut package = Package::new("a three-arm mechanism", "", "", &formats, &options);
        let added = package.machine(|| Ok(linked));
        assert!(added.is_ok(), "{added:?}");
    }
}

#[test]
fn what_cannot_be_made_is_refused_by_name() {
    let none = mechanism(|d| d.arm.pusher_offset = 0.0);
    let error = files(&none, &[Format::Dxf], &options()).expect_err("no fork");
    assert!(
        error.to_string().starts_with("fork.pivot_distance"),
        "{error}"
    );
    let coarse = Options::new(Tolerance::new(1.0).expect("positive"));
    let error = files(&mechanism(|_| {}), &[Format::Dxf], &coarse);
    assert!(matches!(error, Err(ExportError::Tolerance { .. })));
    let without = mechanism(|d| d.tooth_count = None);
    let error = files(&without, &[Format::Dxf], &options()).expect_err("no teeth");
    assert!(error.to_string().contains("tooth_count"), "{error}");
    let thin = mechanism(|d| {
        let mut body = centrode_machines::arm::ArmBodySpec::default();
        body.clamp.root_height = 22.0;
        d.arm.body = Some(body);
    });
    let error = files(&thin, &[Format::Dxf], &options()).expect_err("no arm");
    assert!(error.to_string().contains("arm.body"), "{error}");
}

fn picture(mechanism: &ThreeArm) -> Picture {
    let tolerance = Tolerance::new(1e-3).expect("positive");
    linked::picture(&drawn(mechanism, None).expect("linked"), tolerance)
}

#[test]
fn arms_that_work_have_their_tips_at_the_marks() {
    let picture = picture(&mechanism(|_| {}));
    let poses = picture.links[0].paths.iter();
    let poses = poses.filter(|path| path.role == LineRole::Pose);
    assert_eq!(picture.marks.len(), 2);
    for (pose, mark) in poses.zip(&picture.marks) {
        let tip = Point::new(pose.vertices[9], pose.vertices[10]);
        assert!((tip - Point::from(mark.at)).norm() < 1e-9, "{}", mark.name);
    }
}

#[test]
fn the_path_left_on_the_ground_goes_through_the_tip_at_every_input() {
    let mechanism = mechanism(|_| {});
    let picture = picture(&mechanism);
    let link = picture.links.iter().position(|l| l.name == "ground");
    let link = link.expect("drawn");
    let way = &picture.links[link].paths[0].vertices;
    let poses = &picture.motion.poses[link];
    let corners: Vec<Point> = way.chunks(3).map(|v| Point::new(v[0], v[1])).collect();
    for (i, &phi) in picture.motion.input.iter().enumerate() {
        let tip = mechanism.tip(phi, 0).position;
        let seen = Point::new(tip.x - poses[3 * i], tip.y - poses[3 * i + 1]);
        let off = corners.windows(2).map(|side| {
            let (along, to) = (side[1] - side[0], seen - side[0]);
            let share = (along.dot(&to) / along.norm_squared()).clamp(0.0, 1.0);
            (to - along * share).norm()
        });
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off < 1e-3, "the way passes {tip} at {off} mm at {phi}");
    }
    // One arm plants once per turn, and the machine has gone on by all seedlings of that turn.
    let gone = poses[0] - poses[poses.len() - 3];
    assert!(
        (gone.abs() - TAU * mechanism.advance()).abs() < 1e-3,
        "{gone}"
    );
}

#[test]
fn planted_seedlings_stand_where_arms_have_planted_them() {
    let mechanism = mechanism(|_| {});
    let picture = picture(&mechanism);
    let stems: Vec<&Vec<f64>> = (1..=4)
        .map(|k| format!("planted seedling {k}"))
        .map(|name| picture.links.iter().position(|l| l.name == name))
        .map(|link| &picture.motion.poses[link.expect("drawn")])
        .collect();
    let apart = TAU / f64::from(mechanism.arms());
    let release = mechanism.planting(0);
    for (i, &phi) in picture.motion.input.iter().enumerate() {
        let since = (phi - release).rem_euclid(apart);
        // Where an arm plants there is one sample just before, and inputs are rounded.
        if !(2e-6..apart - 2e-6).contains(&since) {
            continue;
        }
        for (poses, foot) in stems.iter().zip(mechanism.planted(phi, 4)) {
            let at = Point::new(poses[3 * i], poses[3 * i + 1]);
            assert!((at - foot).norm() < 1e-3, "{at} is not {foot} at {phi}");
        }
    }
}
