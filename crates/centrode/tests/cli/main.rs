//! Tests of the program as its user meets it: output, errors, exit status.
#![cfg(feature = "cli")]

mod bad_designs;
mod drive;
mod export;
mod law_file;
mod parts;
mod reverse;
#[cfg(unix)]
mod scarce;
mod search;
mod severity;

use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn centrode(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.args(arguments).output().expect("the program runs")
}

fn fed(arguments: &[&str], input: &[u8]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let command = command.args(arguments);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = piped.stderr(Stdio::piped()).spawn().expect("runs");
    let mut stdin = child.stdin.take().expect("piped");
    // The program may stop reading before the end.
    let _ = stdin.write_all(input);
    drop(stdin);
    child.wait_with_output().expect("ends")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

fn shipped(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/designs");
    folder.join(name).display().to_string()
}

#[test]
fn what_a_design_can_start_from_is_listed_and_written_once() {
    let listed = text(&centrode(&["new"]).stdout);
    for line in ["gear-pair ", "  press ", "  elliptic-pair-2018 ", "feeder "] {
        assert!(
            listed.lines().any(|found| found.starts_with(line)),
            "{line}: {listed}"
        );
    }
    assert!(listed.lines().all(|line| line.len() > 24), "{listed}");
    let folder = tempfile::tempdir().expect("a place to write");
    let file = folder.path().join("press.toml").display().to_string();
    let write = ["new", "press", "-o", &file];
    assert_eq!(text(&centrode(&write).stdout).trim(), file);
    let shipped = std::fs::read(shipped("press.toml")).expect("there");
    assert_eq!(std::fs::read(&file).expect("written"), shipped);
    let again = centrode(&write);
    assert_eq!(again.status.code(), Some(2));
    assert!(
        text(&again.stderr).contains("press.toml"),
        "{}",
        text(&again.stderr)
    );
    assert_eq!(centrode(&["new", "press"]).stdout, shipped);
}

#[test]
fn a_new_design_checks() {
    let new = centrode(&["new", "gear-pair"]);
    assert_eq!(new.status.code(), Some(0));
    let check = fed(&["check", "-"], &new.stdout);
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stderr));
    assert!(text(&check.stdout).contains("centre distance"));
}

#[test]
fn a_new_three_arm_mechanism_is_checked_and_a_missed_goal_is_an_error() {
    let new = centrode(&["new", "three-arm"]);
    assert_eq!(new.status.code(), Some(0));
    let check = fed(&["check", "-"], &new.stdout);
    assert_eq!(check.status.code(), Some(1), "{}", text(&check.stderr));
    let report = text(&check.stdout);
    for line in [
        "Goals: 8 of 9 reached",
        "2 clamp above horizontal at picking        0.6161 deg  -5 to 15        [############]  met",
        "3 clamp below horizontal at planting      51.7072 deg",
        "7 height of the trajectory               370.8206 mm   at least 260",
        "missed by",
        "picking                              20.0000      140.0000      260.0000  deg",
        "planting                            191.0000      311.0000       71.0000  deg",
    ] {
        assert!(report.contains(line), "{line}\n{report}");
    }
}

#[test]
fn every_goal_of_a_three_arm_mechanism_is_checked_or_found_open() {
    let new = text(&centrode(&["new", "three-arm"]).stdout);
    let check = |tip: &str, offset: &str| {
        let design = new
            .replace("tip_distance = 145", &format!("tip_distance = {tip}"))
            .replace("pusher_offset = 65", &format!("pusher_offset = {offset}"));
        let done = fed(&["check", "-"], design.as_bytes());
        (done.status.code(), text(&done.stdout), design)
    };
    // An arm of its own size follows from both.
    let (_, report, design) = check("112", "70");
    assert!(!report.contains("not checked"), "{report}");
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().display().to_string();
    let done = fed(
        &["export", "-", "--to", &to, "--format", "csv"],
        design.as_bytes(),
    );
    assert!(
        folder.path().join("motion.csv").exists(),
        "{}",
        text(&done.stderr)
    );
    // No arm at all.
    let (code, report, _) = check("80", "75");
    assert_eq!(code, Some(1), "{report}");
    assert!(report.contains("goal 1 is not checked"), "{report}");
}

#[test]
fn new_shafts_and_boxes_check_and_export() {
    for (family, line) in [
        (
            "spiral-shaft",
            "moves while picking                   2.0500  mm",
        ),
        ("moving-box", "gears only"),
    ] {
        let new = centrode(&["new", family]);
        assert_eq!(new.status.code(), Some(0));
        let check = fed(&["check", "-"], &new.stdout);
        let report = text(&check.stdout);
        assert_eq!(check.status.code(), Some(0), "{report}");
        assert!(report.contains(line), "{line}\n{report}");
        let out = std::env::temp_dir().join(format!("centrode-{family}-{}", std::process::id()));
        let to = out.display().to_string();
        let export = ["export", "-", "--to", &to, "--format", "csv"];
        let export = fed(&export, &new.stdout);
        assert_eq!(export.status.code(), Some(0), "{}", text(&export.stderr));
        for file in ["lead-table.csv", "groove.ngc", "motion.csv"] {
            assert!(out.join(file).exists(), "{file}");
        }
        std::fs::remove_dir_all(&out).expect("was made");
    }
}

#[test]
fn a_new_feeder_is_good_and_the_published_one_is_infeasible() {
    let new = centrode(&["new", "feeder"]);
    assert_eq!(new.status.code(), Some(0));
    let check = fed(&["check", "-"], &new.stdout);
    let report = text(&check.stdout);
    assert_eq!(check.status.code(), Some(0), "{report}");
    assert!(report.contains("Goals: 10 of 10 reached"), "{report}");
    let check = centrode(&["check", &shipped("feeder-2022.toml")]);
    let report = text(&check.stdout);
    assert_eq!(check.status.code(), Some(1), "{report}");
    let report: Vec<&str> = report.split_whitespace().collect();
    let report = report.join(" ");
    for line in [
        "minimum transmission angle: 8.2243 deg, missed by 31.7757 deg",
        "the maximum found within the bounds is 12.312 deg",
        "widen them by 22.443 %",
        "time 3.0093 1.3407 1.0500 s",
        "cuttings per minute 55.5556 1/min at least 55",
    ] {
        assert!(report.contains(line), "{line}\n{report}");
    }
    let out = std::env::temp_dir().join(format!("centrode-feeder-{}", std::process::id()));
    let to = out.display().to_string();
    let export = ["export", "-", "--to", &to, "--format", "dxf,csv,mjcf,urdf"];
    let export = fed(&export, &new.stdout);
    assert_eq!(export.status.code(), Some(0), "{}", text(&export.stderr));
    let read = |name: &str| std::fs::read_to_string(out.join(name)).expect("was written");
    assert_eq!(read("machine.xml").matches("<connect ").count(), 2);
    assert!(read("machine.urdf").contains("URDF has no loops"));
    for name in [
        "crank.dxf",
        "gears.dxf",
        "gear-entry-cam.dxf",
        "motion.csv",
        "links/slider.stl",
    ] {
        assert!(
            !std::fs::read(out.join(name))
                .expect("was written")
                .is_empty(),
            "{name}"
        );
    }
    std::fs::remove_dir_all(&out).expect("was made");
    let long = text(&new.stdout).replace("slider_length = 16", "slider_length = 40");
    let export = ["export", "-", "--to", &to, "--format", "dxf"];
    let refused = fed(&export, long.as_bytes());
    assert_eq!(refused.status.code(), Some(2));
    let why = text(&refused.stderr);
    assert!(why.contains("from the effector's pivot"), "{why}");
    let widened = centrode(&["check", &shipped("feeder-widened.toml")]);
    assert_eq!(widened.status.code(), Some(0), "{}", text(&widened.stdout));
}

#[test]
fn the_published_three_arm_set_has_its_goals() {
    let check = centrode(&["check", &shipped("three-arm-2021.toml"), "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    let keys = |table: &str| -> Vec<String> {
        let table = report[table].as_object().expect("a table");
        table.keys().cloned().collect()
    };
    // Every figure has its unit, and there is no unit without a figure.
    assert_eq!(keys("values"), keys("units"));
    let goals = report["goals"].as_array().expect("goals");
    let goal = |name: &str| goals.iter().find(|g| g["name"] == name).expect("a goal");
    let value = |name: &str| goal(name)["value"].as_f64().expect("a figure");
    assert!((value("pick-angle").to_degrees() - 0.616_147).abs() < 5e-7);
    assert!((value("trajectory-height") - 370.8206).abs() < 5e-5);
    assert_eq!(goal("pick-angle")["progress"], 1.0);
    assert!((value("arm-clearance") - 62.63).abs() < 0.02);
    assert!(goal("sound-teeth")["margin"].as_f64().expect("a margin") < 0.0);
    assert_eq!(report["tables"][0]["columns"][2], "arm III");
}

#[test]
fn the_published_pair_has_its_figures() {
    let check = centrode(&["check", &shipped("elliptic-pair-2018.toml"), "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    let value = |name: &str| report["values"][name].as_f64().expect(name);
    assert!((value("center_distance") - 52.709_221).abs() < 5e-7);
    assert!((value("module") - 2.25).abs() < 1e-12);
}

#[test]
fn bad_designs_and_bad_usage_end_with_two_and_say_why() {
    let design = b"family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 1.5\nmodule = 2\ntooth_count = 20\n";
    let bad = fed(&["check", "-"], design);
    assert_eq!(bad.status.code(), Some(2));
    assert!(bad.stdout.is_empty());
    let message = text(&bad.stderr);
    assert!(
        message.contains("error: pitch.eccentricity must"),
        "{message}"
    );
    assert!(message.contains("--> standard input:4:1"), "{message}");
    assert!(message.contains("4 | eccentricity = 1.5"), "{message}");
    assert!(
        !message.contains('\u{1b}'),
        "no colour off a terminal: {message:?}"
    );

    let absent = centrode(&["check", "no-such-file.toml"]);
    assert_eq!(absent.status.code(), Some(2));
    assert!(text(&absent.stderr).contains("cannot read no-such-file.toml"));
    let large = fed(&["check", "-"], &vec![b'#'; 10_000_000]);
    assert_eq!(large.status.code(), Some(2));
    assert!(text(&large.stderr).contains("the limit for a design file is"));
    for usage in [
        &["chek"][..],
        &["new", "gear"],
        &["man", "chek"],
        &["check"],
        &[],
    ] {
        let bad = centrode(usage);
        assert_eq!(bad.status.code(), Some(2), "{usage:?}");
        assert!(bad.stdout.is_empty(), "{usage:?}");
        assert!(!bad.stderr.is_empty(), "{usage:?}");
    }
}

#[test]
fn help_version_schema_completions_and_man_pages_are_printed() {
    for (arguments, expected) in [
        (&["--help"][..], "Usage: centrode"),
        (&["--version"], "centrode "),
        (&["check", "--help"], "Exit status"),
        (&["schema"], "\"$schema\""),
        (&["schema", "three-arm"], "\"carrier_start_deg\""),
        (&["completions", "bash"], "_centrode"),
        (&["completions", "zsh"], "#compdef centrode"),
        (&["completions", "fish"], "complete -c centrode"),
        (&["man"], ".TH centrode"),
        (&["man", "check"], ".TH centrode-check"),
        (&["man", "export"], "\\-\\-tolerance"),
        (&["export", "--help"], "urdf"),
        (&["completions", "bash"], "--tolerance"),
    ] {
        let output = centrode(arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        let printed = text(&output.stdout);
        assert!(printed.contains(expected), "{arguments:?}: {printed}");
    }
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    for arguments in [
        &["schema"][..],
        &["new", "gear-pair"],
        &["man"],
        &["--help"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
        let command = command.args(arguments).stdout(Stdio::piped());
        let mut child = command.stderr(Stdio::piped()).spawn().expect("runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("ends");
        let message = text(&output.stderr);
        assert!(!message.contains("panicked"), "{arguments:?}: {message}");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {message}");
    }
}

#[test]
fn the_figures_that_goals_can_name_are_listed_with_their_extremes() {
    let listed = centrode(&["check", "--figures", &shipped("press.toml")]);
    assert_eq!(listed.status.code(), Some(0), "{}", text(&listed.stderr));
    let lines = text(&listed.stdout);
    let travel = lines.lines().find(|line| line.contains("ram.travel"));
    let travel: Vec<&str> = travel.expect("a travel").split_whitespace().collect();
    assert_eq!(travel, ["ram.travel", "153.4527", "213.4527", "mm"]);
    let checked = centrode(&["check", "--json", &shipped("press.toml")]);
    let checked: serde_json::Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let listed = centrode(&["check", "--figures", "--json", &shipped("press.toml")]);
    let listed: serde_json::Value = serde_json::from_slice(&listed.stdout).expect("JSON");
    let row = |report: &serde_json::Value, name: &str| -> Vec<f64> {
        let tables = report["tables"].as_array().expect("tables");
        let mut rows = tables
            .iter()
            .flat_map(|table| table["rows"].as_array().expect("rows"));
        let row = rows.find(|row| row[0] == name).expect("a row");
        row[1]
            .as_array()
            .expect("numbers")
            .iter()
            .filter_map(serde_json::Value::as_f64)
            .collect()
    };
    let torque =
        ["input_torque_min", "input_torque_max"].map(|name| checked["values"][name].as_f64());
    assert_eq!(
        row(&listed, "input.torque")
            .into_iter()
            .map(Some)
            .collect::<Vec<_>>(),
        torque
    );
    for (named, stated) in [
        ("joint(crank).force", "crank"),
        ("mesh(crank).force", "shaft-crank"),
    ] {
        let ends = row(&checked, stated);
        assert_eq!(row(&listed, named)[2 - ends.len()..], ends, "{named}");
    }
    let feeder = ["check", "--json", &shipped("feeder-2022.toml")];
    let [listed, checked] = [&["check", "--figures"][..], &["check"]].map(|words| {
        let stdout = centrode(&[words, &feeder[1..]].concat()).stdout;
        serde_json::from_slice::<serde_json::Value>(&stdout).expect("JSON")
    });
    assert_eq!(
        row(&listed, "feed_rate"),
        [checked["values"]["feed_rate"].as_f64().expect("a number")]
    );
}

#[test]
fn a_remedy_is_a_design_that_mends_what_the_check_finds() {
    let weak = b"family = \"gear-pair\"\npitch = { kind = \"ratio\", expression = \"1 + 0.35*cos(2*phi)\", module = 2, tooth_count = 14 }\n";
    let found = fed(&["check", "--remedy", "-"], weak);
    assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
    let design = text(&found.stdout);
    assert!(
        design.starts_with("# fitted teeth transmit the motion by their flanks alone with 17 teeth of the driver (not with 16; a larger number may fail again: check the number you choose): module 1.6471 mm on these pitch curves, or module 2.0000 mm on curves 1.2143 times as large\n"),
        "{design}"
    );
    let mended = fed(&["check", "--json", "-"], design.as_bytes());
    assert_eq!(mended.status.code(), Some(0), "{}", text(&mended.stdout));
    let report: serde_json::Value = serde_json::from_slice(&mended.stdout).expect("JSON");
    assert!(report["values"]["transmission_error_max"].as_f64() < Some(1e-9));
    assert_eq!(report["values"]["driver_tooth_count"], 17.0);
    let json = fed(&["check", "--remedy", "--json", "-"], weak);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    let stated = json["remedies"][0]["design"].as_str().expect("a design");
    assert!(
        design.contains(&format!("\n{stated}\n# fitted teeth of thickness split")),
        "{stated}"
    );
    // With a choice as many teeth as written are enough.
    let words = json["remedies"][1]["words"].as_str().expect("words");
    assert!(
        words.ends_with("the number in the design") && design.contains(words),
        "{words}"
    );
    let chosen = json["remedies"][1]["design"].as_str().expect("a design");
    let mended = fed(&["check", "--json", "-"], chosen.as_bytes());
    assert_eq!(mended.status.code(), Some(0), "{}", text(&mended.stdout));
    let none = centrode(&["check", "--remedy", &shipped("press.toml")]);
    assert_eq!(none.status.code(), Some(2));
    assert!(text(&none.stderr).contains("no remedy is known for this design"));
}
