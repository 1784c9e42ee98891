//! Severity of findings and the exit status that follows: the table of docs/findings.md, case by case.

use crate::{fed, text};

/// Exit status of `check`, and severity and rule of each finding, in their order.
fn checked(design: &str) -> (Option<i32>, Vec<String>) {
    let done = fed(&["check", "-"], design.as_bytes());
    let report = text(&done.stdout);
    let found = report.lines().filter_map(|line| {
        let severities = ["error [", "warning [", "note ["];
        let found = severities.iter().any(|start| line.starts_with(start));
        found.then(|| line.split(']').next().unwrap_or(line).replace('[', ""))
    });
    (done.status.code(), found.collect())
}

fn pair(pitch: &str, teeth: &str) -> String {
    format!("family = \"gear-pair\"\n[pitch]\n{pitch}\n[teeth]\n{teeth}\n")
}

fn steep(amplitude: &str) -> String {
    let pitch = format!(
        "kind = \"polar\"\nexpression = \"1 + {amplitude}*tanh(10*sin(3*phi))\"\nmodule = 1\ntooth_count = 12"
    );
    pair(&pitch, "addendum = \"fitted\"\nbacklash = 0.05")
}

fn round(teeth: u32) -> String {
    let pitch = format!("kind = \"circle\"\nmodule = 3\ntooth_count = {teeth}");
    pair(&pitch, "backlash = 0.05")
}

fn oval(eccentricity: &str, backlash: &str) -> String {
    let pitch = format!(
        "kind = \"lobed-ellipse\"\nlobes = 2\neccentricity = {eccentricity}\nmodule = 1\ntooth_count = 40"
    );
    format!(
        "mean_ratio = [2, 1]\n{}",
        pair(&pitch, &format!("backlash = {backlash}"))
    )
}

fn four_bar(ground: f64, [crank, coupler, rocker]: [f64; 3], more: &str) -> String {
    format!(
        r#"
family = "machine"
[frame.points]
A = [0, 0]
D = [{ground}, 0]
[bodies.crank]
on = "frame.A"
law = {{ ratio = 1 }}
points = {{ B = [{crank}, 0] }}
[dyads.loop]
type = "RRR"
from = "crank.B"
to = "frame.D"
lengths = [{coupler}, {rocker}]
side = "left"
bodies = ["coupler", "rocker"]
joint = "C"
{more}
"#
    )
}

fn cam(roller: f64) -> String {
    format!(
        r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = {{ ratio = 1 }}
[bodies.slide]
on = "frame.O"
slides_deg = 0
law = {{ follows = "push" }}
[cams.push]
on = "shaft"
base_radius = 50
follower = {{ kind = "translating-roller", roller_radius = {roller} }}
body = {{ width = 8, bore = 20 }}
[cams.push.motion]
segments = [
    {{ kind = "rise", span_deg = 40, lift = 15, law = {{ kind = "modified-sine" }} }},
    {{ kind = "dwell", span_deg = 150 }},
    {{ kind = "return", span_deg = 40, lift = 15, law = {{ kind = "modified-sine" }} }},
    {{ kind = "dwell", span_deg = 130 }},
]
"#
    )
}

const LOAD: &str = "[loads.work]\non = \"rocker\"\ntorque = 1000";

#[test]
fn what_cannot_work_is_an_error_and_what_nobody_can_measure_is_a_note() {
    let small = [0.5, 1.2, 0.8];
    for (design, status, first) in [
        (steep("0.1"), 1, "error pressure-angle"),
        (steep("0.096"), 1, "error pressure-angle"),
        (steep("0.09"), 0, "warning pressure-angle"),
        (round(3), 1, "error contact-lost"),
        (round(4), 1, "error contact-lost"),
        (round(4) + "addendum = \"fitted\"\n", 1, "error disengaged"),
        // Teeth that all but fail to reach each other, with much backlash.
        (
            round(24).replace("0.05", "1.5")
                + "[tool]\nkind = \"rack\"\naddendum_coefficient = 0.03\ndedendum_coefficient = 0.28\ntip_radius_coefficient = 0.2\n",
            1,
            "error disengaged",
        ),
        (oval("0.15", "0.0"), 0, "note contact-lost"),
        (cam(60.0), 1, "error cam-undercut"),
        (cam(80.0), 1, "error cam-undercut"),
        (four_bar(1.0, small, ""), 0, "warning transmission-angle"),
        // A size of the plates, or the word itself, makes them part of the machine.
        (
            four_bar(1.0, small, "[plates]\nthickness = 4"),
            1,
            "error pins-collide",
        ),
        // Almost flat once per turn: its angle is 0.76 mrad by the law of cosines, and 24 mrad in the second.
        (
            four_bar(100.0, [40.0, 80.0, 60.000_001], LOAD),
            1,
            "error excessive-force",
        ),
        (
            four_bar(100.0, [40.0, 80.0, 60.01], LOAD),
            0,
            "warning transmission-angle",
        ),
    ] {
        let (code, found) = checked(&design);
        let opening = found.first().map(String::as_str);
        assert_eq!(
            (code, opening),
            (Some(status), Some(first)),
            "{found:?}\n{design}"
        );
    }
}

/// Linkages as sketched in kinematics programs: 1 to 20 mm between the pins of the frame, nothing of plates.
#[test]
fn small_kinematic_linkages_have_no_fault_of_hardware() {
    let slider_crank = |crank: f64, rod: f64| {
        format!(
            "family = \"machine\"\n[frame.points]\nO = [0, 0]\n[bodies.crank]\non = \"frame.O\"\nlaw = {{ ratio = 1 }}\n\
             points = {{ A = [{crank}, 0] }}\n[dyads.slide]\ntype = \"RRP\"\nfrom = \"crank.A\"\nline = \"frame.O\"\n\
             line_deg = 0\nlengths = [{rod}]\nbodies = [\"rod\", \"piston\"]\njoint = \"B\"\nside = \"forward\"\n"
        )
    };
    let six_bar = |ground: f64| {
        let [near, far] = [2.2 * ground, 3.0 * ground];
        let more = format!(
            "[bodies.rocker]\npoints = {{ E = [{}, {}] }}\n[frame.points]\nF = [{near}, 0]\n[dyads.second]\ntype = \"RRR\"\n\
             from = \"rocker.E\"\nto = \"frame.F\"\nlengths = [{far}, {far}]\nside = \"left\"\n\
             bodies = [\"link\", \"lever\"]\njoint = \"G\"",
            0.5 * ground,
            0.2 * ground
        );
        four_bar(ground, [0.3, 0.9, 0.7].map(|share| share * ground), &more)
            .replacen("[frame.points]\nF", "#", 1)
            .replace(
                &format!("D = [{ground}, 0]"),
                &format!("D = [{ground}, 0]\nF = [{near}, 0]"),
            )
    };
    let mut all: Vec<String> = [1.0, 2.0, 5.0, 12.0, 20.0].map(six_bar).into();
    for ground in [1.0, 2.9, 4.0, 7.5, 12.0, 20.0] {
        all.push(four_bar(
            ground,
            [0.3, 0.9, 0.7].map(|share| share * ground),
            LOAD,
        ));
        all.push(slider_crank(0.3 * ground, ground));
    }
    for design in &all {
        let (code, found) = checked(design);
        assert_eq!(code, Some(0), "{found:?}\n{design}");
        assert!(found.contains(&"note not-designed".to_owned()), "{found:?}");
        let hardware = ["plates-collide", "pins-collide", "parts-collide"];
        let of_hardware = |found: &String| hardware.iter().any(|rule| found.ends_with(rule));
        assert!(!found.iter().any(of_hardware), "{found:?}\n{design}");
    }
}

#[test]
fn a_sound_machine_has_no_error_and_the_worst_comes_first() {
    for design in [
        round(20),
        oval("0.1", "0.05"),
        oval("0.2", "0.0"),
        cam(30.0),
        cam(20.0),
    ] {
        let (code, found) = checked(&design);
        assert_eq!(code, Some(0), "{found:?}\n{design}");
        let rank = |finding: &String| match finding.split(' ').next() {
            Some("error") => 0,
            Some("warning") => 1,
            _ => 2,
        };
        assert!(found.is_sorted_by_key(rank), "{found:?}");
    }
}
