//! Parts of a machine requested by name.

use std::fs;
use std::path::Path;

use crate::{centrode, shipped, text};

fn export(to: &Path, more: &[&str]) -> std::process::Output {
    let (design, to) = (shipped("three-arm-2021.toml"), to.display().to_string());
    centrode(&[&["export", &design, "--to", &to], more].concat())
}

/// Names of the files in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let listed = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = listed
        .map(|entry| entry.expect("readable").file_name().into_string())
        .map(|name| name.expect("text"))
        .filter(|name| name != ".centrode-files")
        .collect();
    names.sort();
    names
}

#[test]
fn the_parts_asked_for_and_no_others_are_written() {
    for (more, expected) in [
        (
            &["--part", "cam,planet", "--format", "dxf,stl"][..],
            &["cam.dxf", "cam.stl", "planet.dxf", "planet.stl"][..],
        ),
        (
            &["--part", "push-rod", "--part", "fork", "--format", "step"],
            &["fork.step", "push-rod.step"],
        ),
        (
            &["--part", "assembly", "--format", "svg,pdf"],
            &["assembly.pdf", "assembly.svg"],
        ),
        (
            &["--part", "cam", "--format", "csv"],
            &["cam.csv", "motion.csv", "motion.json", "parts.csv"],
        ),
    ] {
        let folder = tempfile::tempdir().expect("a place to write");
        let done = export(folder.path(), more);
        let message = text(&done.stderr);
        // The published mechanism misses a goal; its files are written all the same.
        assert_eq!(done.status.code(), Some(1), "{more:?}: {message}");
        assert_eq!(names(folder.path()), expected, "{more:?}");
        // Every file is named on a line of its own.
        assert_eq!(text(&done.stdout).lines().count(), expected.len());
    }
}

#[test]
fn a_part_is_the_same_alone_and_among_others() {
    let [alone, among] = [0, 1].map(|_| tempfile::tempdir().expect("a place to write"));
    export(alone.path(), &["--part", "cam", "--format", "dxf"]);
    export(among.path(), &["--format", "dxf"]);
    let [one, all] = [&alone, &among].map(|folder| fs::read(folder.path().join("cam.dxf")));
    assert_eq!(one.expect("written"), all.expect("written"));
    assert!(names(among.path()).len() > 10);
}

#[test]
fn a_machine_whose_design_names_the_parts_is_asked_for_them() {
    let folder = tempfile::tempdir().expect("a place to write");
    let (design, to) = (
        shipped("jansen-leg.toml"),
        folder.path().display().to_string(),
    );
    let requested = |part: &str| {
        let requested = ["--format", "svg", "--part", part];
        centrode(&[&["export", &design, "--to", &to][..], &requested].concat())
    };
    for part in ["crank", "assembly"] {
        let done = requested(part);
        assert_ne!(done.status.code(), Some(2), "{}", text(&done.stderr));
    }
    assert_eq!(names(folder.path()), ["assembly.svg", "crank.svg"]);
    let refused = requested("wheel");
    assert_eq!(refused.status.code(), Some(2));
    let stated = text(&refused.stderr);
    assert!(
        stated.contains("a composed machine has no part named wheel; there are "),
        "{stated}"
    );
    assert!(
        stated.contains("crank") && stated.contains("assembly"),
        "{stated}"
    );
}

#[test]
fn parts_the_machine_has_not_are_refused_and_nothing_is_written() {
    for (more, word) in [
        (
            &["--part", "driver"][..],
            "a three-arm mechanism has no part named driver",
        ),
        (
            &["--part", "wheel"],
            "a three-arm mechanism has no part named wheel; there are ",
        ),
        (&["--part", ""], "a value is required"),
        (
            &["--part", "assembly", "--format", "stl"],
            "--part assembly is only for drawings and the assembly",
        ),
        (
            &["--part", "cam", "--format", "urdf"],
            "--part is only for drawings, solids and tables",
        ),
    ] {
        let folder = tempfile::tempdir().expect("a place to write");
        let out = folder.path().join("out");
        let done = export(&out, more);
        let message = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{more:?}: {message}");
        assert!(message.contains(word), "{more:?}: {message}");
        assert!(!out.exists(), "{more:?}");
    }
}
