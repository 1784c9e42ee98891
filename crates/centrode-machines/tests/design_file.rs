//! The design file as a whole: families are read, and bad text is refused with key and line.

use centrode_gear::GearPair;
use centrode_gear::design::GearPairDesign;
use centrode_machines::machine::MachineDesign;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::{Design, DesignError, DesignFamily, DesignFile, DesignSpec};
use proptest::prelude::*;

const GOOD: &str = r#"family = "gear-pair"
name = "pair"
mean_ratio = [1, 1]

[pitch]
kind = "ellipse"
eccentricity = 0.25
module = 2.25
tooth_count = 23

[tool]
kind = "rack"
pressure_angle_deg = 20

[teeth]
backlash = 0.05

[driver]
width = 10
bore = 12
keyway = { width = 4, depth = 1.8 }
"#;

fn read(text: impl AsRef<[u8]>) -> Result<DesignFile, DesignError> {
    let families = [
        DesignFamily::new::<GearPairDesign>(),
        DesignFamily::new::<ThreeArmDesign>(),
    ];
    DesignFile::read(text.as_ref(), &families).map(|(file, _)| file)
}

fn pair_of(file: &DesignFile) -> Result<GearPair, DesignError> {
    let design = file.design().downcast_ref().expect("a gear pair");
    GearPair::resolve(design).map_err(|error| file.blame(error.blamed(design)))
}

#[test]
fn the_template_is_a_good_pair() {
    let file = read(GearPairDesign::TEMPLATE).expect("a design");
    let pair = pair_of(&file).expect("a pair");
    assert!((pair.module() - 2.25).abs() < 1e-12);
}

#[test]
fn every_mistake_of_a_file_is_reported_at_once() {
    let families = [DesignFamily::new::<GearPairDesign>()];
    let mistakes = |text: &str| -> Vec<String> {
        let found = DesignFile::mistakes(text.as_bytes(), &families);
        found.iter().map(ToString::to_string).collect()
    };
    assert!(mistakes(GOOD).is_empty());
    let bad = GOOD
        .replace("name = \"pair\"", "name = \"a/b\"")
        .replace("\"rack\"", "\"rak\"")
        .replace("backlash = 0.05", "backlsh = 0.05")
        .replace("width = 10", "width = -10");
    let starts = [
        "line 12, column 8: tool.kind: unknown word \"rak\"",
        "line 16, column 1: teeth.backlsh: unknown key",
        "line 2, column 1: name: must be",
        "line 19, column 1: driver.width: must be",
    ];
    let found = mistakes(&bad);
    for start in starts {
        assert!(
            found.iter().any(|one| one.starts_with(start)),
            "{start}: {found:#?}"
        );
    }
    assert_eq!(found.len(), starts.len(), "{found:#?}");
    assert_eq!(mistakes("family = \"gear-pair\"\n[pitch\n").len(), 1);
}

#[test]
fn names_have_letters_of_any_script_and_dates_are_dates_or_text() {
    let named = |name: &str| read(GOOD.replace("\"pair\"", &format!("{name:?}")));
    for name in ["齿轮-2", "Zahnräder", "шестерня_1"] {
        assert_eq!(named(name).expect(name).design().name(), name);
    }
    for name in ["", "a b", "a.b", "..", "名/称", "a\u{202e}b"] {
        assert!(named(name).is_err(), "{name}");
    }
    for date in ["2026-11-30", "\"2026-11-30\""] {
        let file = read(format!("{GOOD}[drawing]\ndate = {date}\n")).expect(date);
        let design: &GearPairDesign = file.design().downcast_ref().expect("a pair");
        assert_eq!(design.drawing.date, "2026-11-30");
    }
    let error = read(format!("{GOOD}[drawing]\ndate = 2026\n")).expect_err("a number");
    assert!(
        error
            .to_string()
            .contains("drawing.date: must be a date or text"),
        "{error}"
    );
}

#[test]
fn only_the_families_asked_for_are_read() {
    let error = ThreeArmDesign::from_toml(GOOD).expect_err("another family");
    let message = error.to_string();
    assert!(
        message.starts_with("line 1, column 1: family: unknown word"),
        "{message}"
    );
    assert!(message.ends_with("known are three-arm"), "{message}");
    let design = GearPairDesign::from_toml(GOOD).expect("good");
    assert!(&design as &dyn Design == read(GOOD).expect("good").design().as_ref());
    assert!(
        (&design as &dyn Design)
            .downcast_ref::<ThreeArmDesign>()
            .is_none()
    );
}

#[test]
fn every_bad_line_is_named_with_key_and_place() {
    // The line to change, its new text, and the expected message.
    for (old, new, expected) in [
        (
            "eccentricity = 0.25",
            "eccentricity = 1.25",
            "line 7, column 1: pitch.eccentricity must be at least 0 and less than 1, not 1.25",
        ),
        (
            "eccentricity = 0.25",
            "eccentricity = nan",
            "line 7, column 1: pitch.eccentricity must be a finite number",
        ),
        (
            "eccentricity = 0.25",
            "eccentricity = \"high\"",
            "line 7, column 16: pitch.eccentricity: must be a number, not \"high\"",
        ),
        (
            "eccentricity = 0.25",
            "excentricity = 0.25",
            "line 7, column 1: pitch.excentricity: unknown key, did you mean \"eccentricity\"?",
        ),
        (
            "eccentricity = 0.25\n",
            "",
            "line 5, column 2: pitch.eccentricity: the key \"eccentricity\" is missing",
        ),
        (
            "kind = \"ellipse\"",
            "kind = \"elipse\"",
            "line 6, column 8: pitch.kind: unknown word \"elipse\", did you mean \"ellipse\"?",
        ),
        (
            "kind = \"ellipse\"\n",
            "",
            "line 5, column 2: pitch.kind: the key \"kind\" is missing",
        ),
        (
            "kind = \"ellipse\"",
            "kind = 7",
            "line 6, column 8: pitch.kind: must be a word in quotes, not 7",
        ),
        (
            "module = 2.25",
            "module = 0",
            "line 8, column 1: pitch.module must be greater than 0, not 0",
        ),
        (
            "module = 2.25",
            "module = inf",
            "line 8, column 1: pitch.module must be a finite number",
        ),
        (
            "module = 2.25",
            "module = 2.25\ndiametral_pitch = 12",
            "line 9, column 1: pitch.diametral_pitch cannot be given together with module: give one of them",
        ),
        (
            "module = 2.25",
            "diametral_pitch = 0",
            "line 8, column 1: pitch.diametral_pitch must be greater than 0, not 0",
        ),
        (
            "module = 2.25",
            "diametral_pitch = -16",
            "line 8, column 1: pitch.diametral_pitch must be greater than 0, not -16",
        ),
        (
            "module = 2.25\n",
            "",
            "line 8, column 1: pitch.tooth_count is given without module",
        ),
        (
            "tooth_count = 23",
            "tooth_count = 2",
            "line 9, column 1: pitch.tooth_count must be at least 3, not 2",
        ),
        (
            "tooth_count = 23",
            "tooth_count = -23",
            "line 9, column 15: pitch.tooth_count: must be a whole number, 0 or greater, not -23",
        ),
        (
            "tooth_count = 23",
            "tooth_count = 23.5",
            "line 9, column 15: pitch.tooth_count: must be a whole number, 0 or greater, not 23.5",
        ),
        (
            "kind = \"rack\"",
            "kind = \"rake\"",
            "line 12, column 8: tool.kind: unknown word \"rake\", did you mean \"rack\"?",
        ),
        (
            "pressure_angle_deg = 20",
            "pressure_angle = 20",
            "line 13, column 1: tool.pressure_angle: unknown key, did you mean \"pressure_angle_deg\"?",
        ),
        (
            "pressure_angle_deg = 20",
            "pressure_angle_deg = 60",
            "line 13, column 1: tool.pressure_angle_deg: must be 5 to 40 deg, not 60 deg",
        ),
        (
            "pressure_angle_deg = 20",
            "tip_radius_coefficient = 0.8",
            "line 13, column 1: tool.tip_radius_coefficient: is 0.8, but",
        ),
        (
            "backlash = 0.05",
            "backlash = -0.05",
            "line 16, column 1: teeth.backlash: must not be negative, but is -0.05",
        ),
        (
            "backlash = 0.05",
            "backlash = 0.05\nbacklash_angle_deg = 1",
            "line 17, column 1: teeth.backlash_angle_deg: cannot be given together with backlash",
        ),
        (
            "backlash = 0.05",
            "addendum = \"fited\"",
            "line 16, column 12: teeth.addendum: unknown word \"fited\", did you mean \"fitted\"?",
        ),
        (
            "backlash = 0.05",
            "phase = \"twooth\"",
            "line 16, column 9: teeth.phase: must be \"auto\", \"tooth\"",
        ),
        (
            "width = 10",
            "width = true",
            "line 19, column 9: driver.width: must be a number, not true",
        ),
        (
            "width = 10",
            "width = nan",
            "line 19, column 1: driver.width: must be a finite number, not NaN",
        ),
        (
            "width = 10",
            "width = 1e308",
            "line 19, column 1: driver.width: must be 0 to 1e12, not 1e308",
        ),
        (
            "width = 10",
            "witdh = 10",
            "line 19, column 1: driver.witdh: unknown key, did you mean \"width\"?; known are shift, addendum, dedendum, tool, width",
        ),
        (
            "width = 10",
            "shift = 3",
            "line 19, column 1: driver.shift: must be -2 to 2, not 3",
        ),
        (
            "width = 10",
            "shift = \"out\"",
            "line 19, column 9: driver.shift: must be a number, not \"out\"",
        ),
        (
            "backlash = 0.05",
            "tip_shortening = \"some\"",
            "line 16, column 18: teeth.tip_shortening: must be \"keep-clearance\", \"none\" or a coefficient, not \"some\"",
        ),
        (
            "bore = 12",
            "bore = 3",
            "line 21, column 12: driver.keyway.width: is 4 mm, but the bore is only 3 mm across",
        ),
        (
            "bore = 12\n",
            "",
            "line 20, column 1: driver.keyway: needs a bore",
        ),
        (
            "depth = 1.8",
            "dept = 1.8",
            "line 21, column 23: driver.keyway.dept: unknown key, did you mean \"depth\"?",
        ),
        (
            "name = \"pair\"",
            "name = \"../pair\"",
            "line 2, column 1: name: must be 1 to 64 letters",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = [0, 1]",
            "line 3, column 1: mean_ratio: must be 1 to 60, not 0",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = [4, 2]",
            "line 3, column 1: mean_ratio: must be in lowest terms: write [2, 1] for [4, 2]",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = [1, 2]",
            "line 9, column 1: pitch.tooth_count: is 23, but with mean_ratio [1, 2]",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = [1]",
            "line 3, column 14: mean_ratio: must have 2 values, not 1",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = 3",
            "line 3, column 14: mean_ratio: must be a list of 2 values, not 3",
        ),
        (
            "tooth_count = 23",
            "tooth_count = 9223372036854775808",
            "line 9, column 15: pitch.tooth_count: must be a whole number, 0 or greater, not 9223372036854775808",
        ),
        (
            "backlash = 0.05",
            "fit = \"phase\"",
            "line 16, column 7: teeth.fit: must be a list, not \"phase\"",
        ),
        (
            "backlash = 0.05",
            "addendum = true",
            "line 16, column 12: teeth.addendum: must be a word in quotes or a table",
        ),
        (
            "mean_ratio = [1, 1]",
            "center_distance = 1",
            "line 3, column 1: center_distance is 1 mm, but",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ration = [1, 1]",
            "line 3, column 1: mean_ration: unknown key, did you mean \"mean_ratio\"?",
        ),
        (
            "mean_ratio = [1, 1]",
            "mean_ratio = [1, 1",
            "line 5, column 1: missing comma between array elements",
        ),
        (
            "family = \"gear-pair\"",
            "family = \"gear-pear\"",
            "line 1, column 1: family: unknown word \"gear-pear\", did you mean \"gear-pair\"?",
        ),
        (
            "family = \"gear-pair\"\n",
            "",
            "line 1, column 1: family: the key \"family\" is missing",
        ),
        (
            "[driver]",
            "[[driver]]",
            "line 18, column 3: driver: must be a table",
        ),
        ("[driver]", "[driver", "line 18, column 8: "),
        ("[tool]", "[pitch]", "line 11, column 2: duplicate key"),
    ] {
        assert!(GOOD.contains(old), "{old}");
        let text = GOOD.replacen(old, new, 1);
        let found = read(text).and_then(|file| pair_of(&file).map(drop));
        let message = found.expect_err(new).to_string();
        assert!(message.starts_with(expected), "{new:?}:\n  {message}");
    }
}

#[test]
fn what_is_wrong_in_a_table_of_a_kind_is_told_at_its_own_key() {
    const CAM: &str = r#"family = "machine"
[cams.still]
on = "frame.O"
follower = { kind = "swinging-roller", roller_radius = 6, arm_length = 45 }

[[cams.still.motion.segments]]
kind = "rise"
span_deg = 60
law = { kind = "polynomial", end = [0, 1] }

[[cams.still.motion.segments]]
kind = "transition"
span_deg = 61
swing_deg = 30
"#;
    for (old, new, expected) in [
        (
            "roller_radius",
            "roler_radius",
            "line 4, column 40: cams.still.follower.roler_radius: unknown key, did you mean \"roller_radius\"?",
        ),
        (
            "roller_radius = 6",
            "roller_radius = \"six\"",
            "line 4, column 56: cams.still.follower.roller_radius: must be a number, not \"six\"",
        ),
        // Which of the two is meant serde does not tell.
        (
            "roller_radius = 6, arm_length = 45",
            "roller_radius = true, arm_length = true",
            "line 4, column 12: cams.still.follower: must be a number, not true",
        ),
        (
            "swinging-roller",
            "swinging-rollr",
            "line 4, column 21: cams.still.follower.kind: unknown word \"swinging-rollr\", did you mean \"swinging-roller\"?",
        ),
        (
            "swing_deg",
            "swing_dg",
            "line 14, column 1: cams.still.motion.segments[1].swing_dg: unknown key, did you mean \"swing_deg\"?",
        ),
        (
            "span_deg = 61",
            "span_deg = \"61\"",
            "line 13, column 12: cams.still.motion.segments[1].span_deg: must be a number, not \"61\"",
        ),
        (
            "transition",
            "transitin",
            "line 12, column 8: cams.still.motion.segments[1].kind: unknown word \"transitin\", did you mean \"transition\"?",
        ),
        // Serde does not tell in which of the segments: a rise has a law, a transition has none.
        (
            "swing_deg = 30",
            "law = { kind = \"harmonic\" }",
            "line 6, column 1: cams.still.motion.segments.law: unknown key",
        ),
        (
            "end = [0, 1]",
            "ends = [0, 1]",
            "line 9, column 30: cams.still.motion.segments[0].law.ends: unknown key, did you mean \"end\"?",
        ),
        (
            "end = [0, 1]",
            "end = [0, \"1\", \"1\"]",
            "line 9, column 40: cams.still.motion.segments[0].law.end[1]: must be a number, not \"1\"",
        ),
    ] {
        assert!(CAM.contains(old), "{old}");
        let found = MachineDesign::from_toml(&CAM.replacen(old, new, 1));
        let message = found.expect_err(new).to_string();
        assert!(message.starts_with(expected), "{new:?}:\n  {message}");
    }
}

#[test]
fn a_key_in_the_wrong_table_is_told_where_it_belongs() {
    for (old, new, expected) in [
        (
            "width = 10",
            "backlash = 10",
            "; elsewhere there is teeth.backlash",
        ),
        (
            "mean_ratio = [1, 1]",
            "pressure_angle_deg = 20",
            "; elsewhere there is tool.pressure_angle_deg, driver.tool.pressure_angle_deg, driven.tool.pressure_angle_deg",
        ),
        (
            "backlash = 0.05",
            "depth = 0.05",
            "; elsewhere there is driver.keyway.depth, driven.keyway.depth",
        ),
        (
            "name = \"pair\"",
            "depth = 10",
            "depth: unknown key; known are name, title, mean_ratio, tooth_count, center_distance, pitch, tool, teeth, driver, driven, housing, cut, drawing, goals, vary; elsewhere there is driver.keyway.depth, driven.keyway.depth",
        ),
        (
            "eccentricity = 0.25",
            "width = 0.25",
            "; elsewhere there is driver.width, driven.width, driver.keyway.width and others",
        ),
        // The key of earlier versions.
        (
            "pressure_angle_deg = 20",
            "profile_shift_coefficient = 0.3",
            "; elsewhere there is driver.shift, driven.shift",
        ),
        // A key of another kind of the same table is not elsewhere.
        ("kind = \"ellipse\"", "kind = \"circle\"", ", tooth_count"),
        ("width = 10", "nowhere = 10", ", accuracy"),
    ] {
        assert!(GOOD.contains(old), "{old}");
        let error = read(GOOD.replacen(old, new, 1)).expect_err(new);
        let message = error.to_string();
        assert!(message.contains(": unknown key"), "{message}");
        assert!(message.ends_with(expected), "{new:?}:\n  {message}");
    }
}

#[test]
fn a_missing_table_is_told_by_its_own_name() {
    for (text, key) in [
        ("family = \"gear-pair\"\n", "pitch"),
        (
            "family = \"three-arm\"\n[pitch]\nkind = \"circle\"\n",
            "carrier_start_deg",
        ),
    ] {
        let error = read(text).map(drop).expect_err("missing");
        assert_eq!(error.key, key);
    }
}

#[test]
fn too_much_play_is_told_at_the_play() {
    let text = GOOD.replacen("backlash = 0.05", "backlash = 24", 1);
    let found = read(text).and_then(|file| pair_of(&file).map(drop));
    assert_eq!(found.expect_err("no tooth left").key, "teeth.backlash");
}

#[test]
fn pitch_curve_faults_name_their_line() {
    let head = "family = \"gear-pair\"\ntooth_count = 20\n[pitch]\n";
    for (pitch, expected) in [
        (
            "kind = \"polar\"\nexpression = \"10 + psi\"",
            "line 5, column 1: pitch.expression: unknown name \"psi\"",
        ),
        (
            "kind = \"polar\"\nexpression = \"10 + log(phi + 1)\"",
            "line 5, column 1: pitch.expression: unknown name \"log\", did you mean \"ln\"?",
        ),
        (
            "kind = \"polar\"\nexpression = \"10/(phi - phi)\"",
            "line 5, column 1: pitch.expression or one of its derivatives",
        ),
        (
            "kind = \"polar\"\nradius = [1, 2, 3, nan, 5, 6]",
            "line 5, column 1: pitch.radius must be a finite number",
        ),
        (
            "kind = \"polar\"\nradius = [1, 2, 3, -4, 5, 6]",
            "line 5, column 1: pitch.radius must be greater than 0, not -4",
        ),
        (
            "kind = \"polar\"\nradius = [9, 9, 9, 9, 9, 9]\nmean = 2",
            "line 5, column 1: pitch.radius cannot be given together",
        ),
        (
            "kind = \"polar\"",
            "line 3, column 2: pitch.expression is missing",
        ),
        (
            "kind = \"bspline\"\nradius = [9, 9, 9, 9]\nangle_deg = [0, 90, 80, 270]",
            "line 6, column 1: pitch.angle_deg must increase, within one turn: value 2 is 80 deg after 90 deg",
        ),
        (
            "kind = \"bspline\"\nradius = [9, 9, 9, 9]\nangle_deg = [0, 90]",
            "line 6, column 1: pitch.angle_deg: radius has 4 values but angle_deg has 2",
        ),
        (
            "kind = \"bspline\"\nplane = \"cartesian\"\nx = [9, 0, -9, 0]\ny = [0, 9, 0, -9.0]\ndegree = 9",
            "line 8, column 1: pitch.degree must be 1 to 5, not 9",
        ),
        (
            "kind = \"bspline\"\nplane = \"cartesian\"\nx = [9, 0, -9, 0]\ny = [0, -9, 0, 9]",
            "line 6, column 1: pitch.x: the points run clockwise",
        ),
        (
            "kind = \"bspline\"\nplane = \"cartesian\"\nx = [9, -9, 9, -9]\ny = [-9, 9, 9, -8]",
            "line 6, column 1: pitch.x: the curve turns back or crosses itself",
        ),
        (
            "kind = \"transmission\"\nexpression = \"phi - sin(phi)\"\ncenter_distance = 40",
            "line 5, column 1: pitch.expression: d driven / d driver falls to 0",
        ),
        (
            "kind = \"ratio\"\nexpression = \"0.7123\"\ncenter_distance = 40",
            "line 5, column 1: pitch.expression: one driver turn gives 0.7123",
        ),
        (
            "kind = \"ratio\"\nexpression = \"0.5\"\ncenter_distance = 40",
            "line 1, column 1: mean_ratio is 1:1, but",
        ),
    ] {
        let text = format!("{head}{pitch}\n");
        let found = read(text).and_then(|file| pair_of(&file).map(drop));
        let message = found.expect_err(pitch).to_string();
        assert!(message.starts_with(expected), "{pitch}:\n  {message}");
    }
}

#[test]
fn bytes_that_are_no_design_are_refused_at_once() {
    let begun = std::time::Instant::now();
    let message = |bytes: &[u8]| read(bytes).expect_err("no design").to_string();
    assert!(message(b"").contains("the file is empty"));
    assert!(message(b"# nothing\n").contains("the file is empty"));
    assert!(
        message(b"family = \"gear-pair\"\nname = \"\xff\"")
            .starts_with("line 2, column 9: the file is not UTF-8")
    );
    assert!(message(&vec![b'a'; 10_000_000]).contains("10000000 bytes"));
    for cut in 0..GOOD.len() {
        if let Err(error) = read(&GOOD.as_bytes()[..cut]) {
            assert!(error.line <= GOOD.lines().count() + 1, "{error}");
        }
    }
    assert!(
        message(b"family = \"gear-pair\"\ntool = 3").starts_with("line 2, column 1: tool: must be")
    );
    let deep = format!(
        "family = \"gear-pair\"\npitch = {}1{}",
        "[".repeat(300_000),
        "]".repeat(300_000)
    );
    assert!(message(deep.as_bytes()).starts_with("line 2"));
    let tables = format!(
        "family = \"gear-pair\"\n{} = 1",
        vec!["a"; 300_000].join(".")
    );
    assert!(message(tables.as_bytes()).starts_with("line 2"));
    let long = format!("{GOOD}\n[pitch.{}]\n", "x".repeat(900_000));
    assert!(message(long.as_bytes()).contains("unknown key"));
    // A hundred times what it takes.
    assert!(begun.elapsed().as_secs_f64() < 60.0);
}

#[test]
fn angles_are_degrees_in_the_file_and_come_back_round() {
    let design = GearPairDesign::from_toml(GOOD).expect("good");
    assert_eq!(design.tool.pressure_angle(), 20.0_f64.to_radians());
    let written = design.to_toml().expect("writable");
    assert!(written.contains("pressure_angle_deg = 20.0\n"), "{written}");
}

proptest! {
    #[test]
    fn any_text_is_a_design_or_an_error_with_a_place(text in "\\PC{0,200}") {
        if let Err(error) = read(text) {
            prop_assert!(error.line >= 1 && error.column >= 1);
        }
    }

    #[test]
    fn a_damaged_design_is_a_design_or_an_error(at in 0..GOOD.len(), byte: u8) {
        let mut bytes = GOOD.as_bytes().to_vec();
        bytes[at] = byte;
        let _ = read(&bytes).map(|f| f.design().validate());
    }

    #[test]
    fn what_is_written_reads_back(
        k in 0.0..0.99_f64,
        m in 0.01..100.0_f64,
        z in 3..200_u32,
        angle in 6.0..39.0_f64,
        backlash in 0.0..1.0_f64,
    ) {
        let mut pair = GearPairDesign::from_toml(GOOD).expect("good");
        pair.pitch = centrode_gear::pitch::PitchSpec::Ellipse(centrode_gear::pitch::Ellipse {
            eccentricity: k,
            semi_major_axis: None,
            module: Some(m),
            diametral_pitch: None,
            tooth_count: Some(z),
        });
        pair.tool = centrode_gear::design::ToolSpec::Rack(centrode_gear::design::Rack {
            pressure_angle: angle.to_radians(),
            dedendum_coefficient: 0.5,
            tip_radius_coefficient: 0.0,
            ..Default::default()
        });
        pair.teeth.backlash = backlash;
        let written = pair.to_toml().expect("writable");
        let again = GearPairDesign::from_toml(&written).expect("reads back");
        let (a, b) = (again.tool.pressure_angle(), pair.tool.pressure_angle());
        prop_assert!((a - b).abs() <= 2.0 * f64::EPSILON * b);
        prop_assert_eq!((again.pitch, again.teeth), (pair.pitch, pair.teeth));
    }
}

#[test]
fn a_conjugate_curve_is_read_and_its_faults_are_placed() {
    let text = |k: &str| {
        format!(
            "family = \"gear-pair\"\n[pitch]\nkind = \"conjugate\"\nmean_ratio = [2, 1]\ntooth_count = 40\n\
             [pitch.of]\nkind = \"ellipse\"\neccentricity = {k}\nsemi_major_axis = 20\n"
        )
    };
    let text_in = text("0.2").replace("[pitch]", "mean_ratio = [1, 2]\n[pitch]");
    let file = read(text_in).expect("a design");
    let pair = pair_of(&file).expect("a pair");
    assert_eq!(pair.driven().tooth_count(), 20);
    let written = file.design().to_toml().expect("writable");
    assert_eq!(read(&written).expect("readable").design(), file.design());

    let file = read(text("1.5")).expect("well-formed");
    let error = pair_of(&file).expect_err("no ellipse");
    assert_eq!((error.key.as_str(), error.line), ("pitch.of", 6));
}

fn published() -> ThreeArmDesign {
    ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("a design")
}

#[test]
fn a_number_is_set_where_it_stands() {
    for (key, value) in [
        ("arm.tip_distance", 150.5),
        ("pitch.radius[3]", 51.0),
        ("bend_deg", -50.0),
        ("tooth_count", 35.0),
        ("tray.distance", 240.0),
        ("work.plant_spacing", 120.0),
    ] {
        let design = published()
            .numbered(&[key])
            .expect("a number")
            .with(&[value]);
        let written = design.expect("a design").to_toml().expect("text");
        let root: toml::Value = toml::from_str(&written).expect("toml");
        let steps = key.replace('[', ".").replace(']', "");
        let here = steps
            .split('.')
            .fold(&root, |value, step| match step.parse::<usize>() {
                Ok(index) => &value[index],
                Err(_) => &value[step],
            });
        let read = here.as_float().or(here.as_integer().map(|i| i as f64));
        assert_eq!(read, Some(value), "{key}");
    }
}

#[test]
fn keys_that_hold_no_number_are_refused() {
    for key in [
        "",
        "family",
        "pitch",
        "pitch.radius[99]",
        "nothing.there",
        "a..b",
        "arm.tip_distanc",
        "name",
    ] {
        assert!(published().numbered(&[key]).is_err(), "{key}");
    }
}

fn title(c: char) -> String {
    let head = "family = \"gear-pair\"\ntitle = \"x";
    let pitch = "[pitch]\nkind = \"circle\"\nmodule = 2\ntooth_count = 17";
    format!("{head}\\U{:08x}\"\n{pitch}\n", u32::from(c))
}

#[test]
fn titles_hold_no_character_that_xml_has_not() {
    for c in [
        '\u{fffe}', '\u{ffff}', '\0', '\t', '\n', '\r', '\u{1b}', '\u{7f}', '\u{80}', '\u{85}',
        '\u{9f}',
    ] {
        let error = GearPairDesign::from_toml(&title(c)).expect_err("refused");
        let message = error.message();
        assert!(
            message.ends_with("not 2 with 1 control characters (including U+FFFE and U+FFFF)"),
            "{c:?}: {message}"
        );
    }
    for c in [
        '\u{fffd}',
        '\u{fdd0}',
        '\u{1fffe}',
        '\u{10ffff}',
        '\u{e000}',
        'ß',
        '≤',
        '\u{a0}',
    ] {
        assert!(GearPairDesign::from_toml(&title(c)).is_ok(), "{c:?}");
    }
}

#[test]
fn an_old_key_is_an_error_that_names_the_new_one() {
    for (goal, new) in [
        ("over = \"least\"\nminimum = 1", "minimum"),
        ("over = \"span\"\nat_most = 1", "maximum"),
        (
            "over = \"deviation\"\ncourse = [0, 1]\nmaximum = 1",
            "uniform",
        ),
    ] {
        let template = MachineDesign::TEMPLATE;
        let text = format!("{template}\n[goals.old]\nfigure = \"crank.angle\"\n{goal}\n");
        let error = MachineDesign::from_toml(&text).expect_err("an old key");
        let hint = format!("did you mean {new:?}?");
        assert!(error.to_string().contains(&hint), "{error}");
    }
}
