//! Guards that families stay in rooms of their own.

use std::fs;
use std::path::{Path, PathBuf};

use super::FAMILIES;

/// Names of files and folders that are a family's own, wherever they are.
const OWN: [&str; 10] = [
    "gear",
    "centrode-gear",
    "centrode-groove",
    "gear_pair",
    "three_arm",
    "shaft",
    "spiral_shaft",
    "moving_box",
    "feeder",
    "machine",
];

/// Other files of one family, and the lists: that of the families and that of their Python classes. The files of every
/// model and the view of every general arrangement begin with the word of a family.
const OTHERS: [&str; 7] = [
    "centrode-export/src/linked/arrangement/mod.rs",
    "centrode-export/src/linked/mod.rs",
    "centrode-families/src/lib.rs",
    "python/src/design.rs",
    "python/src/lib.rs",
    "python/src/pitch/mod.rs",
    "python/src/reverse.rs",
];

/// Types of a family. A gear pair is an element of other families too.
const TYPES: [&str; 11] = [
    "GearPairDesign",
    "ThreeArm",
    "ThreeArmDesign",
    "SpiralShaft",
    "SpiralShaftDesign",
    "MovingBox",
    "MovingBoxDesign",
    "Feeder",
    "FeederDesign",
    "Machine",
    "MachineDesign",
];

/// Types and words of the family of composed machines, and of gear pairs, which are its elements.
const MACHINE: [&str; 4] = ["Machine", "MachineDesign", "GearPairDesign", "\"machine\""];

/// Rooms of other families that a composed machine has nothing of.
const FOREIGN: [&str; 4] = ["three_arm::", "feeder::", "moving_box::", "arm::"];

/// Every source file below a folder, tests aside.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let test = path.file_stem().is_some_and(|stem| stem == "tests");
        if path.is_dir() && !test {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") && !test {
            found.push(path);
        }
    }
}

/// The words of a family that a source names outside its comments and tests.
fn named(source: &str) -> Vec<String> {
    let code = source.split("#[cfg(test)]\nmod tests {").next();
    let lines = code.unwrap_or_default().lines().map(str::trim_start);
    let code: Vec<&str> = lines.filter(|line| !line.starts_with("//")).collect();
    let code = code.join("\n");
    let quoted = FAMILIES.words().into_iter().map(|word| format!("{word:?}"));
    let mut found: Vec<String> = quoted.filter(|word| code.contains(word)).collect();
    let mut tokens: Vec<&str> = code
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|token| TYPES.contains(token))
        .collect();
    tokens.sort_unstable();
    tokens.dedup();
    found.extend(tokens.into_iter().map(String::from));
    found
}

#[test]
fn no_family_is_named_outside_its_rooms() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    sources(&root.join("crates"), &mut files);
    sources(&root.join("python/src"), &mut files);
    assert!(files.len() > 300, "only {} files", files.len());
    let mut named_in_rooms = 0;
    let mut strays = Vec::new();
    for path in files {
        let found = named(&fs::read_to_string(&path).expect("text"));
        if found.is_empty() {
            continue;
        }
        let path = path.strip_prefix(&root).expect("below the root");
        let own = |part: &Path| {
            let stem = part.file_stem().unwrap_or_default();
            OWN.iter().any(|room| stem == *room)
        };
        if path.iter().any(|part| own(Path::new(part))) || OTHERS.iter().any(|o| path.ends_with(o))
        {
            named_in_rooms += 1;
        } else {
            strays.push(format!("{}: {}", path.display(), found.join(", ")));
        }
    }
    assert!(strays.is_empty(), "{strays:#?}");
    assert!(
        named_in_rooms > 50,
        "only {named_in_rooms} files of families"
    );
}

/// Maximum number of lines of a crate, tests aside: what one person can keep in view.
const MAXIMUM_LINES: usize = 20_000;

#[test]
fn a_crate_is_small_enough_to_know_and_says_what_it_holds() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for entry in fs::read_dir(crates).expect("the crates") {
        let source = entry.expect("an entry").path().join("src");
        let mut files = Vec::new();
        sources(&source, &mut files);
        let texts = files
            .iter()
            .map(|path| fs::read_to_string(path).expect("text"));
        let lines: usize = texts.map(|text| text.lines().count()).sum();
        assert!(lines <= MAXIMUM_LINES, "{}: {lines}", source.display());
        let head = fs::read_to_string(source.join("lib.rs")).expect("text");
        let head = head.lines().take_while(|line| line.starts_with("//!"));
        let head = head.collect::<Vec<_>>().join(" ");
        let boundary = [
            "contains no",
            "knows no",
            "know no",
            "may not know",
            "checks nothing",
            "writes no",
            "draws nothing",
        ];
        assert!(boundary.iter().any(|words| head.contains(words)), "{head}");
    }
}

#[test]
fn a_general_machine_knows_no_other_family() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for room in ["machines", "analysis", "synthesis", "export"] {
        let folder = root.join(format!("crates/centrode-{room}/src/machine"));
        sources(&folder, &mut files);
    }
    assert!(files.len() > 25, "only {} files", files.len());
    for path in files {
        let source = fs::read_to_string(&path).expect("text");
        let mut found = named(&source);
        found.retain(|word| !MACHINE.contains(&word.as_str()));
        let uses = source.lines().filter(|line| line.contains("use "));
        let foreign = uses.filter(|line| FOREIGN.iter().any(|room| line.contains(room)));
        found.extend(foreign.map(String::from));
        assert!(found.is_empty(), "{}: {found:?}", path.display());
    }
}

#[test]
fn a_match_over_families_would_be_found() {
    let matched = "match family {\n    \"three-arm\" => 3,\n    // \"feeder\"\n    _ => 1,\n}";
    assert_eq!(named(matched), ["\"three-arm\""]);
    assert_eq!(named("let Mechanism::Feeder(feeder) = it"), ["Feeder"]);
    assert!(named("FeederForces::analyse(three_arm)").is_empty());
}
