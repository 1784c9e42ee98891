//! The gears that drive a crank as goals of its output ask: what is printed, the file, and what is refused.

use std::fs;

use crate::{centrode, fed, text};

const SLIDER: &str = r#"
family = "machine"
name = "steady-press"
frame.points = { O = [0, 0] }
bodies.crank = { on = "frame.O", law = { ratio = 1 }, points = { A = [30, 0] } }

[dyads.ram]
type = "RRP"
from = "crank.A"
lengths = [120]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"

[goals.steady]
figure = "ram.travel"
over = "departure"
within_deg = [30, 120]
course = [110, 140]
at_most = 1e-4

[goals.rest]
figure = "ram.travel"
over = "span"
within_deg = [170, 210]
at_most = 1.5
"#;

#[test]
fn the_machine_written_meets_the_goals_that_it_missed_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let [slider, press] = ["slider.toml", "press.toml"].map(|name| folder.path().join(name));
    fs::write(&slider, SLIDER).expect("written");
    let [slider, press] = [slider, press].map(|path| path.display().to_string());
    let before = centrode(&["check", &slider]);
    assert!(
        text(&before.stdout).contains("Goals: 0 of 2 reached"),
        "{}",
        text(&before.stdout)
    );
    let run = centrode(&["drive", &slider, "--center-distance", "130", "-o", &press]);
    let told = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for line in [
        "output                  90.0000 mm to 150.0000 mm",
        "pair drive              least convex radius 13.8",
        "teeth of drive          33 fitted teeth, module 3.91",
    ] {
        assert!(told.contains(line), "{line}\n{told}");
    }
    let after = centrode(&["check", &press]);
    assert_eq!(after.status.code(), Some(0), "{}", text(&after.stderr));
    assert!(
        text(&after.stdout).contains("Goals: 2 of 2 reached"),
        "{}",
        text(&after.stdout)
    );
}

#[test]
fn what_cannot_be_driven_is_refused_with_the_reason_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let shown = folder.path().join("press.toml").display().to_string();
    let pair =
        "family = \"gear-pair\"\npitch = { kind = \"circle\", module = 2, tooth_count = 20 }\n";
    for (design, words) in [
        (
            SLIDER.replace("[110, 140]", "[110, 150]"),
            "goals.steady: the output shall go evenly from 110 to 150",
        ),
        (
            SLIDER.replace("[170, 210]", "[110, 210]"),
            "goals.steady: from 30 deg to 120 deg",
        ),
        (
            SLIDER.replace("ratio = 1", "ratio = 3"),
            "crank has another law",
        ),
        (pair.into(), "not for \"gear-pair\""),
    ] {
        let arguments = ["drive", "-", "--center-distance", "130", "-o", &shown];
        let run = fed(&arguments, design.as_bytes());
        assert_eq!(run.status.code(), Some(2), "{words}");
        let told = text(&run.stderr);
        assert!(told.contains(words), "{words}\n{told}");
        assert!(!fs::exists(&shown).expect("a folder"));
    }
    let over = centrode(&["drive", "-", "--center-distance", "nan"]);
    assert_eq!(over.status.code(), Some(2));
}
