//! Exported files: all or nothing, whole or absent, the same twice.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::{centrode, fed, shipped, text};

const ALL: [&str; 36] = [
    "assembly-sheet.dxf",
    "assembly-sheet.svg",
    "assembly.3mf",
    "assembly.dxf",
    "assembly.pdf",
    "assembly.step",
    "assembly.svg",
    "driven-pins.csv",
    "driven-sheet.dxf",
    "driven-sheet.svg",
    "driven.3mf",
    "driven.csv",
    "driven.dxf",
    "driven.pdf",
    "driven.step",
    "driven.stl",
    "driven.svg",
    "driver-pins.csv",
    "driver-sheet.dxf",
    "driver-sheet.svg",
    "driver.3mf",
    "driver.csv",
    "driver.dxf",
    "driver.pdf",
    "driver.step",
    "driver.stl",
    "driver.svg",
    "machine.urdf",
    "machine.xml",
    "motion.csv",
    "motion.json",
    "parts.csv",
    "play_mujoco.py",
    "play_pybullet.py",
    "report.json",
    "sheets.pdf",
];

fn elliptic() -> String {
    shipped("elliptic-pair-2018.toml")
}

fn export(to: &Path, more: &[&str]) -> std::process::Output {
    let (design, to) = (elliptic(), to.display().to_string());
    centrode(&[&["export", &design, "--to", &to], more].concat())
}

/// Every file of a folder and of the folders in it, without the record of written files.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut read = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("entry").path();
        let name = path.file_name().expect("a name").to_string_lossy();
        if path.is_dir() {
            let below = files(&path).into_iter();
            read.extend(below.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else if name != ".centrode-files" {
            read.insert(name.into_owned(), fs::read(&path).expect("readable"));
        }
    }
    read
}

/// Names of the files, those of the bodies to touch with aside, and how many of these there are.
fn names(files: &BTreeMap<String, Vec<u8>>) -> (Vec<&str>, usize) {
    let touching = |name: &&str| name.starts_with("collision/");
    let (bodies, names): (Vec<_>, Vec<_>) = files.keys().map(String::as_str).partition(touching);
    (names, bodies.len())
}

#[test]
fn every_kind_is_written_named_and_the_same_twice() {
    for more in [
        &["--format", "all"][..],
        &["--dxf", "r12", "--format", "dxf"],
        &["--dxf", "spline", "--format", "dxf"],
        &["--dxf", "chords", "--for", "laser"],
        &["--for", "simulation", "--tolerance", "0.1"],
    ] {
        let folder = tempfile::tempdir().expect("a place to write");
        let [first, second] = ["new/first", "second"].map(|name| folder.path().join(name));
        let done = export(&first, more);
        assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
        assert!(text(&done.stderr).contains("files written; 1 note"));
        let written = files(&first);
        let printed = text(&done.stdout);
        assert_eq!(printed.lines().count(), written.len());
        for line in printed.lines() {
            assert!(Path::new(line).is_file(), "{line}");
        }
        if more[1] == "all" {
            // One body per tooth, 23 per gear, and two hubs.
            assert_eq!(names(&written), (ALL.to_vec(), 48));
        }
        export(&second, more);
        // Not assert_eq: it would print megabytes.
        assert!(written == files(&second), "{more:?}");
    }
}

#[test]
fn the_kinds_asked_for_and_no_others_are_written() {
    for (kinds, expected) in [
        ("json", &["report.json"][..]),
        (
            "svg,json",
            &["assembly.svg", "driven.svg", "driver.svg", "report.json"],
        ),
        (
            "urdf",
            &[
                "driven.stl",
                "driver.stl",
                "machine.urdf",
                "motion.csv",
                "motion.json",
                "play_pybullet.py",
            ],
        ),
        (
            "mjcf",
            &[
                "driven.stl",
                "driver.stl",
                "machine.xml",
                "motion.csv",
                "motion.json",
                "play_mujoco.py",
            ],
        ),
        (
            "csv,csv",
            &[
                "driven-pins.csv",
                "driven.csv",
                "driver-pins.csv",
                "driver.csv",
                "motion.csv",
                "motion.json",
                "parts.csv",
            ],
        ),
        (
            "step,3mf",
            &[
                "assembly.3mf",
                "assembly.step",
                "driven.3mf",
                "driven.step",
                "driver.3mf",
                "driver.step",
            ],
        ),
    ] {
        let folder = tempfile::tempdir().expect("a place to write");
        let done = export(folder.path(), &["--format", kinds]);
        assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
        let bodies = if kinds == "urdf" { 48 } else { 0 };
        let written = files(folder.path());
        assert_eq!(names(&written), (expected.to_vec(), bodies), "{kinds}");
    }
}

#[test]
fn the_report_file_is_what_check_prints() {
    let folder = tempfile::tempdir().expect("a place to write");
    export(folder.path(), &["--format", "json"]);
    let check = centrode(&["check", &elliptic(), "--json"]);
    assert_eq!(files(folder.path())["report.json"], check.stdout);
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    assert_eq!(report["ok"], true);
}

#[test]
fn bad_options_write_nothing_and_end_with_two() {
    for (more, word) in [
        (["--tolerance", "nan"], "NaN"),
        (["--tolerance", "0"], "positive"),
        (["--tolerance", "-0.001"], "positive"),
        (["--tolerance", "inf"], "inf"),
        (["--tolerance", "1e-9"], "at least"),
        (["--tolerance", "5"], "too coarse"),
        (["--tolerance", "fine"], "must be a number"),
        (["--format", "png"], "png"),
        (["--format", ""], "possible values"),
        (["--dxf", "r9"], "r9"),
        (["--for", "paper"], "paper"),
        (["--layers", "some"], "some"),
    ] {
        let folder = tempfile::tempdir().expect("a place to write");
        let out = folder.path().join("out");
        let done = export(&out, &more);
        let message = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{more:?}: {message}");
        assert!(message.contains(word), "{more:?}: {message}");
        assert!(!out.exists(), "{more:?}");
    }
}

#[test]
fn an_export_without_any_file_says_so_and_makes_no_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let to = folder.path().join("out");
    let (design, place) = (shipped("feeder-2022.toml"), to.display().to_string());
    let run = ["export", &design, "--to", &place, "--part", "gears"];
    let run = centrode(&[&run[..], &["--format", "step"]].concat());
    assert_eq!(run.status.code(), Some(2));
    let stated = text(&run.stderr);
    assert!(
        stated.contains("no files of gears in the requested formats"),
        "{stated}"
    );
    assert!(!to.exists());
}

#[test]
fn a_bad_pair_is_written_and_ends_with_one() {
    // Tips higher than the spaces are deep.
    let design = "family = \"gear-pair\"\n[pitch]\nkind = \"circle\"\nmodule = 2\ntooth_count = 20\n\
                  [tool]\nkind = \"rack\"\naddendum_coefficient = 1.2\ndedendum_coefficient = 1\n\
                  tip_radius_coefficient = 0.1\n";
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().display().to_string();
    let done = fed(
        &["export", "-", "--to", &to, "--format", "svg,json"],
        design.as_bytes(),
    );
    let message = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{message}");
    assert!(message.contains("4 files written;"), "{message}");
    let report: serde_json::Value =
        serde_json::from_slice(&files(folder.path())["report.json"]).expect("JSON");
    assert_eq!(report["ok"], false);
    let check = fed(&["check", "-"], design.as_bytes());
    assert_eq!(check.status.code(), Some(1));
    assert!(
        text(&check.stdout).contains("\nerror [interference]"),
        "{}",
        text(&check.stdout)
    );
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().expect("a place to write");
    let taken = folder.path().join("taken");
    fs::write(&taken, "mine").expect("written");
    for to in [taken.clone(), taken.join("below")] {
        let done = export(&to, &["--format", "svg"]);
        assert_eq!(done.status.code(), Some(2));
        assert!(
            text(&done.stderr).contains("taken"),
            "{}",
            text(&done.stderr)
        );
        assert!(done.stdout.is_empty());
    }
    assert_eq!(fs::read(&taken).expect("there"), b"mine");
    // A folder in the way of one file: none of them is written.
    let way = folder.path().join("way");
    fs::create_dir_all(way.join("driven.svg")).expect("made");
    let done = export(&way, &["--format", "svg"]);
    assert_eq!(done.status.code(), Some(2));
    assert_eq!(fs::read_dir(&way).expect("readable").count(), 1);
}

#[cfg(unix)]
#[test]
fn a_read_only_folder_is_left_alone() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().expect("a place to write");
    let locked = folder.path().join("locked");
    fs::create_dir(&locked).expect("made");
    let mode = |bits| fs::set_permissions(&locked, fs::Permissions::from_mode(bits));
    mode(0o555).expect("locked");
    // The superuser may write anywhere: the kernel's own read-only folder serves instead.
    let powerful = fs::write(locked.join("probe"), "").is_ok();
    let target = if powerful {
        Path::new("/proc/self")
    } else {
        &locked
    };
    let done = export(target, &["--format", "svg"]);
    mode(0o755).expect("unlocked");
    assert_eq!(done.status.code(), Some(2), "{}", text(&done.stdout));
    assert!(
        text(&done.stderr).contains("cannot create"),
        "{}",
        text(&done.stderr)
    );
    assert!(files(&locked).keys().all(|name| name == "probe"));
}

/// Kills the program while it writes: a file is then there whole or not at all.
#[test]
fn a_killed_export_leaves_no_half_file() {
    let more = ["--tolerance", "0.0001", "--format", "all"];
    let folder = tempfile::tempdir().expect("a place to write");
    let whole = folder.path().join("whole");
    assert_eq!(export(&whole, &more).status.code(), Some(0));
    let whole = files(&whole);
    let mut caught = 0;
    for attempt in 0..6 {
        let out = folder.path().join(format!("killed{attempt}"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
        command
            .args(["export", &elliptic(), "--to"])
            .arg(&out)
            .args(more);
        let command = command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().expect("runs");
        let required = 1 + 2 * attempt;
        while fs::read_dir(&out).map_or(0, Iterator::count) < required
            && child.try_wait().expect("watched").is_none()
        {}
        child.kill().expect("killed");
        caught += u32::from(!child.wait().expect("ended").success());
        for (name, bytes) in files(&out) {
            assert!(
                name.contains(".centrode-") || whole[&name] == bytes,
                "{name} is not whole"
            );
        }
    }
    assert!(caught > 0, "the program was never caught writing");
}
