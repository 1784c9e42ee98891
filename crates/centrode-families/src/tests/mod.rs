use centrode_gear::design::GearPairDesign;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;

use super::*;

mod depth;
mod disc;
mod quick;
mod rooms;
mod searches;
mod sweep;

/// Folders of the templates and schemas.
const FOLDERS: [&str; 3] = [
    concat!(env!("CARGO_MANIFEST_DIR"), "/../centrode-gear/design"),
    concat!(env!("CARGO_MANIFEST_DIR"), "/../centrode-groove/design"),
    concat!(env!("CARGO_MANIFEST_DIR"), "/../centrode-machines/design"),
];

fn shipped() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/designs");
    let entries = std::fs::read_dir(folder).expect("the shipped designs");
    entries
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("text");
            (path.display().to_string(), text)
        })
        .collect()
}

#[test]
fn shipped_designs_and_templates_are_read_and_written_back() {
    let mut files = shipped();
    assert!(files.len() >= 7);
    for family in FAMILIES.0 {
        files.push((family.design.word.into(), family.design.template.into()));
    }
    for (name, text) in files {
        let read = |text: &str| FAMILIES.read(text.as_bytes());
        let file = read(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let design = file.design();
        let pair = design.downcast_ref().map(|d: &GearPairDesign| &d.pitch);
        let arms = design.downcast_ref().map(|d: &ThreeArmDesign| &d.pitch);
        if let Some(pitch) = pair.or(arms) {
            pitch.resolve().unwrap_or_else(|e| panic!("{name}: {e}"));
        }
        let written = design.to_toml().expect("writable");
        let again = read(&written).unwrap_or_else(|e| panic!("{name}: {e}\n{written}"));
        assert!(again.design() == design, "{written}");
    }
}

#[test]
fn a_family_is_found_by_its_word_alone() {
    for family in FAMILIES.0 {
        let word = family.design.word;
        assert_eq!(FAMILIES.template(word), Some(family.design.template));
    }
    assert!(FAMILIES.template("gear-pear").is_none());
    let error = FAMILIES.read(b"family = \"gear-pear\"").expect_err("none");
    assert!(error.to_string().contains("did you mean \"gear-pair\"?"));
}

#[test]
fn a_design_of_another_family_is_refused_at_its_family() {
    let design = FAMILIES.read(ThreeArmDesign::TEMPLATE.as_bytes());
    let design = design.expect("a design");
    let pairs = Family::new::<GearPair>();
    let error = pairs.resolve(design.design()).expect_err("another family");
    assert_eq!(error.key, "family");
    assert_eq!(
        error.to_string(),
        "unknown word \"three-arm\"; known are gear-pair"
    );
    assert!(pairs.problem(design.design()).is_err());
    assert!(pairs.widen(design.design()).is_err());
}

#[test]
fn the_checked_in_schemas_are_those_of_the_code() {
    for (family, keys) in [
        (
            "gear-pair",
            [
                "pressure_angle_deg",
                "backlash_angle_deg",
                "lobed-ellipse",
                "mean_ratio",
            ],
        ),
        (
            "three-arm",
            [
                "carrier_start_deg",
                "pick_angle_deg",
                "lobed-ellipse",
                "counter-clockwise",
            ],
        ),
        (
            "spiral-shaft",
            [
                "moved_distance",
                "window_deg",
                "rotated-sine",
                "rail_friction",
            ],
        ),
        (
            "moving-box",
            [
                "elliptic-gear",
                "speed_ratio",
                "return_offset",
                "tooth_count",
            ],
        ),
        (
            "feeder",
            [
                "effector_length",
                "driven_pitches",
                "pushing_time",
                "transmission_angle_deg",
            ],
        ),
        (
            "machine",
            ["fixed_to", "slides_deg", "second_line_deg", "pin_diameter"],
        ),
    ] {
        let file = family.replace('-', "_");
        let mut paths = FOLDERS
            .map(|folder| format!("{folder}/{file}.schema.json"))
            .into_iter();
        let path = paths.find(|path| std::fs::exists(path).is_ok_and(|found| found));
        let path = path.expect("checked in");
        let family = FAMILIES.named(family).expect("a family");
        let schema = family.design.json_schema();
        let schema = serde_json::to_string_pretty(&schema).expect("json") + "\n";
        if std::env::var_os("CENTRODE_REFRESH").is_some() {
            std::fs::write(&path, &schema).expect("writable");
        }
        let checked_in = std::fs::read_to_string(&path).expect("checked in");
        assert!(
            checked_in == schema,
            "run the tests with CENTRODE_REFRESH=1 to write {path}"
        );
        for key in keys.into_iter().chain([family.design.word]) {
            assert!(schema.contains(key), "{key}");
        }
    }
    let whole = FAMILIES.json_schema();
    let alternatives = whole["oneOf"].as_array().expect("a list");
    for (family, schema) in FAMILIES.0.iter().zip(alternatives) {
        assert_eq!(schema["properties"]["family"]["const"], family.design.word);
        assert_eq!(schema["description"], family.design.about);
    }
    assert_eq!(alternatives.len(), FAMILIES.0.len());
}
