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
over = "deviation"
within_deg = [30, 120]
uniform = [110, 140]
maximum = 1e-4

[goals.rest]
figure = "ram.travel"
over = "span"
within_deg = [170, 210]
maximum = 1.5
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
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for line in [
        "output                  90.0000 mm to 150.0000 mm",
        "pair drive              minimum convex radius 13.8",
        "teeth of drive          33 fitted teeth, module 3.91",
    ] {
        assert!(stated.contains(line), "{line}\n{stated}");
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
fn angles_of_an_output_are_reported_in_the_degrees_of_the_file() {
    let rocker = |keys: &str| {
        let dyad = SLIDER.split("[dyads.ram]").next().expect("the crank");
        format!(
            "{}\n[dyads.loop]\ntype = \"RRR\"\nfrom = \"crank.A\"\nto = \"frame.D\"\nlengths = [90, 60]\nside = \"left\"\n\
             bodies = [\"coupler\", \"rocker\"]\njoint = \"C\"\n[goals.even]\nfigure = \"rocker.angle\"\n{keys}\n",
            dyad.replace("O = [0, 0]", "O = [0, 0], D = [100, 0]")
        )
    };
    // By the cosine rule the rocker is 100 from O to D, and 90 + 30 and 90 - 30 from O to C at its ends.
    let end = |bar: f64| {
        let cosine: f64 = (100.0 * 100.0 + 60.0 * 60.0 - bar * bar) / (2.0 * 100.0 * 60.0);
        180.0 - cosine.acos().to_degrees()
    };
    let ends = [end(120.0), end(60.0)].map(|end| format!("{end:.6}"));
    for course in [
        "20, 140", "90, 150", "10, 20", "-30, 100", "86, 120", "120, 86",
    ] {
        let keys = format!(
            "over = \"deviation\"\nwithin_deg = [30, 150]\nuniform = [{course}]\nmaximum = 0.1"
        );
        let run = fed(
            &["drive", "-", "--center-distance", "130"],
            rocker(&keys).as_bytes(),
        );
        let message = text(&run.stderr);
        let from = format!("evenly from {},", course.replace(", ", " to "));
        assert!(message.contains(&from), "{course}: {message}");
        for end in &ends {
            assert!(message.contains(&end[..7]), "{end}: {message}");
        }
    }
    for (band, words) in [
        ("40", "a band of 40 in"),
        ("35", "a band of 35 in"),
        ("1e-9", "a band of 1e-9 in"),
    ] {
        let keys = format!("over = \"span\"\nwithin_deg = [30, 90]\nmaximum = {band}");
        let run = fed(
            &["drive", "-", "--center-distance", "130"],
            rocker(&keys).as_bytes(),
        );
        let message = text(&run.stderr);
        assert!(message.contains(words), "{band}: {message}");
    }
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
            "goals.steady: the output must move evenly from 110 to 150",
        ),
        (
            SLIDER.replace("[170, 210]", "[110, 210]"),
            "goals.steady is from 30 deg to 120 deg",
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
        let stated = text(&run.stderr);
        assert!(stated.contains(words), "{words}\n{stated}");
        assert!(!fs::exists(&shown).expect("a folder"));
    }
    let over = centrode(&["drive", "-", "--center-distance", "nan"]);
    assert_eq!(over.status.code(), Some(2));
}
