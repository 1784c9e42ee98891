//! Designs without a mechanism: one clear message at its line, quickly, and nothing written.

use std::fs;
use std::time::{Duration, Instant};

use crate::{centrode, text};

/// Guards the words the message must contain, and the line it must point to, for a design.
fn refused(design: &[u8], words: &[&str], line: usize) {
    let folder = tempfile::tempdir().expect("a place to write");
    let file = folder.path().join("pair.toml");
    let out = folder.path().join("out");
    fs::write(&file, design).expect("written");
    let [file, to] = [&file, &out].map(|path| path.display().to_string());
    // A design that takes a hundred times as long as any of these does is hung.
    let start = Instant::now();
    let done = centrode(&["export", &file, "--to", &to]);
    let shown = String::from_utf8_lossy(&design[..design.len().min(300)]);
    assert!(start.elapsed() < Duration::from_secs(20), "hung: {shown}");
    let message = text(&done.stderr);
    assert_eq!(done.status.code(), Some(2), "{shown}{message}");
    assert!(done.stdout.is_empty(), "{shown}");
    assert!(!out.exists(), "{shown}");
    for word in words {
        assert!(message.contains(word), "{word:?} for\n{shown}{message}");
    }
    assert!(message.contains(&format!("pair.toml:{line}:")), "{message}");
}

fn pitch(keys: &str) -> String {
    format!("family = \"gear-pair\"\n[pitch]\n{keys}\n")
}

fn ellipse(eccentricity: &str, module: &str, teeth: &str) -> String {
    pitch(&format!(
        "kind = \"ellipse\"\neccentricity = {eccentricity}\nmodule = {module}\ntooth_count = {teeth}"
    ))
}

fn sized(kind: &str, keys: &str) -> String {
    pitch(&format!(
        "kind = \"{kind}\"\n{keys}\nmodule = 2\ntooth_count = 20"
    ))
}

#[test]
fn numbers_out_of_range_are_refused() {
    for value in ["nan", "inf", "-0.1", "1.0", "1e308"] {
        refused(
            ellipse(value, "2", "20").as_bytes(),
            &["eccentricity must"],
            4,
        );
    }
    for value in ["0", "-2", "nan", "-inf"] {
        refused(ellipse("0.1", value, "20").as_bytes(), &["module must"], 5);
    }
    for value in ["2", "0", "4000000000"] {
        refused(
            ellipse("0.1", "2", value).as_bytes(),
            &["tooth_count must"],
            6,
        );
    }
    let body = sized("circle", "") + "[driver]\nwidth = -1\n";
    refused(body.as_bytes(), &["driver.width", "greater than 0"], 8);
    let body = sized("circle", "") + "[driver]\nbore = 50\n";
    refused(body.as_bytes(), &["driver.bore"], 8);
}

#[test]
fn curves_that_roll_on_nothing_are_refused() {
    let falls = sized("polar", "expression = \"cos(phi)\"");
    refused(falls.as_bytes(), &["expression", "must stay above 0"], 4);
    let negative = sized("polar", "radius = [1, 1, 1, -1]");
    refused(negative.as_bytes(), &["pitch.radius"], 4);
    let backwards = sized("transmission", "expression = \"phi - 0.8*sin(2*phi)\"");
    refused(
        backwards.as_bytes(),
        &["expression", "must stay above 0"],
        4,
    );
    let crossing = pitch(
        "kind = \"bspline\"\ndegree = 2\nplane = \"cartesian\"\nx = [30, 10, -30, 30, -30, 10]\n\
         y = [-20, 30, 20, 10, -20, -30]\nmodule = 2\ntooth_count = 20",
    );
    refused(crossing.as_bytes(), &["pitch.x"], 6);
    let apart = format!("center_distance = 7\n{}", sized("circle", ""));
    refused(apart.as_bytes(), &["center_distance is 7 mm"], 1);
}

#[test]
fn teeth_without_a_profile_are_blamed_where_their_number_is_written() {
    let sharp = r#"family = "gear-pair"
[pitch]
kind = "limacon"
mean_radius = 20.0
amplitude = 17.813983445845935
lobes = 8
module = 2.0
tooth_count = 4
[tool]
kind = "rack"
dedendum_coefficient = 1.1113154541348957
tip_radius_coefficient = 0.028999047585876816
[driver]
shift = 0.03618225534148756
[teeth]
thickness_split = 0.5321383116182223
"#;
    let refusal = "pitch.tooth_count: the driver has no profile";
    refused(sharp.as_bytes(), &[refusal], 8);
}

#[test]
fn bad_formulas_are_refused() {
    let name = sized("polar", "expression = \"1 + x\"");
    refused(name.as_bytes(), &["expression", "unknown name \"x\""], 4);
    let zero = sized("polar", "expression = \"1/(phi - phi)\"");
    refused(zero.as_bytes(), &["expression", "not a finite number"], 4);
    let deep = sized(
        "polar",
        &format!("expression = \"{}1\"", "(".repeat(50_000)),
    );
    refused(deep.as_bytes(), &["expression"], 4);
}

#[test]
fn bad_files_are_refused() {
    let unknown = sized("circle", "tooth_cuont = 20");
    refused(
        unknown.as_bytes(),
        &["tooth_cuont: unknown key", "did you mean \"tooth_count\""],
        4,
    );
    refused(
        b"family = \"gear-pair\"\n[pitch]\nkind = \"circ",
        &["string"],
        3,
    );
    refused(b"", &["empty"], 1);
    refused(&[b'x'; 10_000_000], &["is 1048576"], 1);
    refused(b"family = \"gear-pair\"\nname = \"\xff\"\n", &["UTF-8"], 2);
}

/// The published mechanism with one line changed.
fn arms(old: &str, new: &str) -> String {
    let text = "family = \"three-arm\"\narms = 3\ncarrier_start_deg = 86\nbend_deg = -53\ntooth_count = 37\n\
                [pitch]\nkind = \"bspline\"\ndegree = 2\n\
                radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]\n\
                angle_deg = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]\n\
                [arm]\nmounting_angle_deg = -29\ntip_distance = 145\npusher_offset = 65\n\
                [goals]\nmodule = 2.5\n";
    assert!(text.contains(old), "{old}");
    text.replace(old, new)
}

#[test]
fn three_arm_mechanisms_that_cannot_be_are_refused() {
    for (old, new, words, line) in [
        (
            "arms = 3",
            "arms = 0",
            &["arms: must be 1 to 6, not 0"][..],
            2,
        ),
        ("arms = 3", "arms = 7", &["arms: must be 1 to 6, not 7"], 2),
        ("arms = 3", "gearbox = 3", &["gearbox: must be a table"], 2),
        ("-53", "-180", &["bend_deg: must be -175 to 175 deg"], 4),
        ("-53", "nan", &["bend_deg: must be a finite number"], 4),
        (
            "distance = 145",
            "distance = 0",
            &["arm.tip_distance: must be greater than 0"],
            13,
        ),
        (
            "offset = 65",
            "offset = 146",
            &["arm.pusher_offset: must be -145 to 145 mm"],
            14,
        ),
        (
            "pusher_offset = 65\n",
            "",
            &["\"pusher_offset\" is missing"],
            11,
        ),
        ("degree = 2", "degree = 0", &["pitch.degree must"], 8),
        (
            "\"bspline\"",
            "\"bspine\"",
            &["did you mean \"bspline\""],
            7,
        ),
        (
            "module = 2.5",
            "modul = 2.5",
            &["did you mean \"module\""],
            16,
        ),
        (
            "module = 2.5",
            "pick_angle_deg = [15, -5]",
            &["goals.pick_angle_deg: must be a range from low to high"],
            16,
        ),
        // Gears that do not close at the distance requested.
        (
            "tooth_count = 37",
            "center_distance = 80",
            &["center_distance is 80 mm", "only at 82.04634"],
            5,
        ),
        ("49, 58", "49, -58", &["pitch.radius"], 9),
        (
            "[goals]\nmodule = 2.5",
            "[tray]\ndistance = 500",
            &["tray.distance is 500 mm"],
            16,
        ),
        (
            "family = \"three-arm\"",
            "family = \"three-arms\"",
            &["did you mean \"three-arm\""],
            1,
        ),
    ] {
        refused(arms(old, new).as_bytes(), words, line);
    }
    let crossing = arms(
        "radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]\n\
         angle_deg = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]",
        "plane = \"cartesian\"\nx = [30, 10, -30, 30, -30, 10]\ny = [-20, 30, 20, 10, -20, -30]",
    );
    refused(crossing.as_bytes(), &["pitch.x"], 10);
}

#[test]
fn a_key_that_means_nothing_is_refused_also_in_what_is_only_a_detail() {
    let known = "unknown key; known are shift, addendum, dedendum, tool, width, bore";
    for key in ["internal", "inner", "ring", "helix_deg", "bores_extra"] {
        for body in ["driver", "driven"] {
            let design = format!("{}[{body}]\n{key} = 1\n", sized("circle", ""));
            refused(design.as_bytes(), &[&format!("{body}.{key}: {known}")], 8);
        }
    }
    let near = format!("{}[driven]\nbores = 1\n", sized("circle", ""));
    refused(near.as_bytes(), &["did you mean \"bore\"?"], 8);
}

#[test]
fn axes_nearer_than_their_pins_are_named_with_the_key() {
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().join("out");
    for (ground, crank, pin, overlap) in [
        // Sizes that are not given follow the distances.
        ("1", "0.5", "", ""),
        ("2.9", "1", "", ""),
        (
            "12",
            "2",
            "width = 4\npin_diameter = 3",
            "axes A and B of body crank are 2 mm apart",
        ),
        ("12", "2", "pin_diameter = 1.9", ""),
        ("1", "0.5", "pin_diameter = 0.4\nwidth = 0.6", ""),
        ("20", "10", "pin_diameter = 7", ""),
        (
            "20",
            "6",
            "pin_diameter = 7",
            "but their holes of 7 and 7 mm overlap",
        ),
    ] {
        let [a, b]: [f64; 2] = [ground, crank].map(|number| number.parse().expect("a number"));
        let (coupler, rocker) = (1.2 * a, a - 0.4 * b);
        let design = format!(
            "family = \"machine\"\nhardware = \"list\"\n[frame.points]\nA = [0, 0]\nD = [{ground}, 0]\n\
             [bodies.crank]\non = \"frame.A\"\nlaw = {{ ratio = 1 }}\npoints = {{ B = [{crank}, 0] }}\n\
             [dyads.loop]\ntype = \"RRR\"\nfrom = \"crank.B\"\nto = \"frame.D\"\nlengths = [{coupler}, {rocker}]\n\
             side = \"left\"\nbodies = [\"coupler\", \"rocker\"]\njoint = \"C\"\n[plates]\n{pin}\n"
        );
        let arguments = ["export", "-", "--format", "dxf", "--to"];
        let to = to.display().to_string();
        let done = crate::fed(&[&arguments[..], &[&to]].concat(), design.as_bytes());
        let message = text(&done.stderr);
        if overlap.is_empty() {
            assert_ne!(done.status.code(), Some(2), "{message}");
        } else {
            assert_eq!(done.status.code(), Some(2), "{ground} {crank}");
            assert!(message.contains("plates.pin_diameter: "), "{message}");
            assert!(message.contains(overlap), "{message}");
        }
    }
}

#[test]
fn a_check_lists_every_wrong_key_of_a_file() {
    let wrong = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\nexcentricity = 0.3\nmodule = 2\ntooth_count = 20\n\
                 [driver]\nbores = 6\n[cut]\nkerff = 0.1\n";
    for command in [&["check", "-"][..], &["export", "-", "--to", "unused"]] {
        let done = crate::fed(command, wrong.as_bytes());
        assert_eq!(done.status.code(), Some(2));
        let message = text(&done.stderr);
        let listed: Vec<&str> = message
            .lines()
            .filter(|l| l.starts_with("error: "))
            .collect();
        let keys = ["pitch.excentricity", "driver.bores", "cut.kerff"];
        assert_eq!(listed.len(), keys.len(), "{message}");
        for (line, key) in listed.iter().zip(keys) {
            assert!(
                line.contains(&format!("error: {key}: unknown key")),
                "{line}"
            );
        }
    }
}
