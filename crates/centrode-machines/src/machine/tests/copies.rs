use std::f64::consts::TAU;

use centrode_geometry::Point;
use nalgebra::Rotation2;

use super::{made, refused};
use crate::machine::Machine;

const TWO_ARM: &str = include_str!("../../../../../tests/designs/two-arm.toml");

/// The two-arm train with one arm written and so many in all.
fn copied(count: u32) -> String {
    let (start, rest) = TWO_ARM.split_once("[bodies.idler-2]").expect("two arms");
    let (_, end) = rest.split_once("[pairs.stage]").expect("pairs");
    let gears = end
        .lines()
        .filter(|line| !line.starts_with("idler-gear-2") && !line.starts_with("planet-gear-2"));
    let end: Vec<&str> = gears.collect();
    format!(
        "{start}[copies.arms]\nbodies = [\"idler-1\", \"planet-1\", \"arm-1\"]\ncount = {count}\nabout = \"carrier\"\n[pairs.stage]{}\n",
        end.join("\n")
    )
}

/// Position of a point and angle of its body.
fn pose(machine: &Machine, name: &str, at: Point, input: f64) -> (Point, f64) {
    let body = machine.body_named(name).expect(name);
    let angle = machine.angle(body, input).position;
    (machine.place(body, at, input), angle)
}

/// Distance of two poses, whole turns aside.
fn apart((one, a): (Point, f64), (other, b): (Point, f64)) -> f64 {
    let turns = (a - b) / TAU;
    (one - other).norm() + (turns - turns.round()).abs() * TAU
}

#[test]
fn a_copied_arm_is_one_written_out_by_hand() {
    let (one, two) = (made(&copied(2)), made(TWO_ARM));
    for i in 0..40 {
        let input = 0.37 * f64::from(i) - 3.0;
        for (name, hand) in [
            ("arm-1", "arm-1"),
            ("arm-1-2", "arm-2"),
            ("idler-1-2", "idler-2"),
        ] {
            let tip = Point::new(110.0, 0.0);
            let off = apart(pose(&one, name, tip, input), pose(&two, hand, tip, input));
            assert!(off < 1e-10, "{name} {input}: {off}");
        }
    }
    assert_eq!(one.design().bodies.len() + 3, one.whole().bodies.len());
}

#[test]
fn copies_are_pieces_of_one_part() {
    let machine = made(&copied(3)).machine().expect("plates and gears");
    assert_eq!(machine.validate(), Ok(()));
    for (name, count) in [
        ("arm-1", 3),
        ("idler-gear-1", 3),
        ("sun", 1),
        ("carrier", 1),
    ] {
        let part = machine.parts.iter().find(|part| part.name == name);
        assert_eq!(part.expect(name).quantity(), count, "{name}");
    }
    assert!(machine.parts.iter().all(|part| !part.name.ends_with("-3")));
    // A hole of the carrier for each planet, at equal distances from the middle.
    assert_eq!(machine.meshes.len(), 6);
}

#[test]
fn a_copy_stands_where_its_original_does_when_an_uneven_carrier_has_turned_on() {
    // A cam at the planet's place on a carrier that turns unevenly, a lever, a bar to a slide on the carrier.
    let text = r#"family = "machine"
[frame.points]
O = [0, 0]
[bodies.carrier]
on = "frame.O"
law = { expression = "-phi - 0.3*sin(phi)" }
points = { P = [60, 5], Q = [40, -30], C = [50, 0] }
[bodies.lever]
on = "carrier.P"
law = { follows = "still", start_deg = 40 }
points = { A = [20, 0] }
[bodies.dial]
on = "carrier.C"
law = { start_deg = 12 }
[dyads.push]
type = "RRP"
from = "lever.A"
lengths = [45]
line = "carrier.Q"
line_deg = 35
side = "backward"
bodies = ["bar", "block"]
joint = "B"
[cams.still]
on = "frame.O"
base_radius = 30
follower = { kind = "swinging-roller", roller_radius = 4, arm_length = 45 }
[[cams.still.motion.segments]]
kind = "rise"
span_deg = 180
swing_deg = 8
law = { kind = "polynomial-4567" }
[[cams.still.motion.segments]]
kind = "return"
span_deg = 180
swing_deg = 8
law = { kind = "polynomial-4567" }
[copies.arms]
bodies = ["lever", "dial", "bar", "block"]
count = 3
about = "carrier"
"#;
    // Loads and obstacles may name copies.
    let on_copies = "[loads.x]\non = \"lever-2.A\"\nforce = [1, 0]\n[obstacles.o]\non = \"dial-3\"\ncircle = { center = [0, 0], radius = 3 }\n";
    let machine = made(&format!("{text}{on_copies}"));
    let seat = machine.body_named("dial-3");
    assert_eq!(Some(machine.obstacles()[0].body), seat);
    for i in 0..60 {
        let input = 0.21 * f64::from(i);
        for piece in 1..3 {
            // The carrier runs backwards: on by less than a turn, by Newton's method.
            let required = input + 0.3 * input.sin() + TAU * (1.0 - f64::from(piece) / 3.0);
            let mut later = required;
            for _ in 0..60 {
                later -= (later + 0.3 * later.sin() - required) / (1.0 + 0.3 * later.cos());
            }
            for name in ["lever", "dial", "bar", "block"] {
                let at = Point::new(7.0, 3.0);
                let copy = pose(&machine, &format!("{name}-{}", piece + 1), at, input);
                let off = apart(copy, pose(&machine, name, at, later));
                assert!(off < 1e-10, "{name} {piece} {input}: {off}");
            }
        }
    }
    let shared = machine.cams();
    assert_eq!(shared.len(), 1);
    assert_eq!(shared[0].followers, ["lever", "lever-2", "lever-3"]);
}

#[test]
fn laws_of_copies_run_ahead_on_a_body_that_turns_evenly_and_stay_on_one_that_stands() {
    let text = |law: &str, about: &str| {
        format!(
            r#"family = "machine"
[input]
turns = 2
[frame.points]
O = [1, 2]
[bodies.table]
on = "frame.O"
law = {law}
points = {{ P = [30, 4] }}
[bodies.arm]
on = "{about}.P"
law = {{ expression = "0.4*sin(phi) - 2*phi" }}
[bodies.slide]
on = "{about}.P"
slides_deg = 20
law = {{ expression = "5*cos(phi)" }}
[copies.arms]
bodies = ["arm", "slide"]
count = 4
about = "{about}"
"#
        )
    };
    let turning = made(&text("{ ratio = -1.5 }", "table"));
    let standing = made(&text("{ start_deg = 3 }", "table"));
    for i in 0..40 {
        let input = 0.3 * f64::from(i);
        for piece in 1..4_u32 {
            let share = f64::from(piece) / 4.0;
            for name in ["arm", "slide"] {
                let (at, copy) = (Point::new(3.0, 1.0), format!("{name}-{}", piece + 1));
                let later = input + TAU * (1.0 - share) / 1.5;
                let off = apart(
                    pose(&turning, &copy, at, input),
                    pose(&turning, name, at, later),
                );
                assert!(off < 1e-10, "{copy} {input}: {off}");
                let (place, angle) = pose(&standing, name, at, input);
                let middle = Point::new(1.0, 2.0);
                let turned = middle + Rotation2::new(TAU * share) * (place - middle);
                let off = apart(
                    pose(&standing, &copy, at, input),
                    (turned, angle + TAU * share),
                );
                assert!(off < 1e-10, "{copy} {input}: {off}");
            }
        }
    }
    let uneven = refused(&text("{ expression = \"phi + 0.1*sin(phi)\" }", "table"));
    let stated = "bodies.arm.law: body table turns unevenly";
    assert!(uneven.contains(stated), "{uneven}");
    let back = refused(&text("{ expression = \"sin(phi)\" }", "table"));
    assert!(
        back.contains("copies.arms.about: body table turns to and fro"),
        "{back}"
    );
}

#[test]
fn a_train_that_does_not_repeat_is_refused_with_the_mismatch() {
    // Round gears of 1 to 1 about a sun that turns against the carrier: an idler is off by the turn of the sun meanwhile, which
    // is as much as that of the carrier.
    let text = copied(3)
        .replace(
            "[bodies.idler-1]",
            "[bodies.hub]\non = \"frame.O\"\nlaw = { ratio = -1 }\n[bodies.idler-1]",
        )
        .replace(
            "kind = \"ellipse\", eccentricity = 0.2",
            "kind = \"circle\"",
        )
        .replace("on = \"frame.O\", mount_deg = 86", "on = \"hub\"");
    let found = refused(&text);
    let stated = "copies.arms: the train does not repeat: idler-1-2 is not in the pose that idler-1 has when carrier has turned 120.0000 deg further; it is up to 0.000000 mm off";
    assert!(
        found.contains(stated) && found.contains("120.000000 deg (at"),
        "{found}"
    );
    // A rod to a point of the frame repeats, wherever it is: all that turns about it is fixed. One to a point of a hub that
    // turns is off by a chord of 120 degrees about the hub's axis, 2 mm away.
    let rod = copied(3).replace(
        "\"arm-1\"]\ncount",
        "\"arm-1\", \"guide\", \"sleeve\"]\ncount",
    );
    let rod = rod.replace(
        "[copies.arms]",
        "[bodies.hub]\non = \"frame.O\"\nlaw = { ratio = -1 }\npoints = { Z = [2, 0] }\n[dyads.rod]\ntype = \"RPR\"\nfrom = \"arm-1.tip\"\nto = \"frame.Z\"\nside = \"forward\"\nbodies = [\"sleeve\", \"guide\"]\n[copies.arms]",
    );
    let rod = rod.replace("O = [0, 0]", "O = [0, 0]\nZ = [2, 0]");
    assert_eq!(made(&rod).dyads().len(), 3);
    let found = refused(&rod.replace("to = \"frame.Z\"", "to = \"hub.Z\""));
    let stated = "guide-2 is not in the pose that guide has when carrier has turned 120.0000 deg further; it is up to 3.464102 mm off";
    assert!(found.contains(stated), "{found}");
}

#[test]
fn bad_copies_are_told_by_their_key() {
    let good = copied(3);
    for (from, to, stated) in [
        ("count = 3", "count = 1", "copies.arms.count"),
        (
            "\"arm-1\"]\ncount",
            "\"arm-9\"]\ncount",
            "copies.arms.bodies: there is no body \"arm-9\"",
        ),
        (
            "about = \"carrier\"",
            "about = \"planet-1\"",
            "copies.arms.about: body planet-1 is copied itself",
        ),
        (
            "\"arm-1\"]\ncount",
            "\"arm-1\", \"frame\"]\ncount",
            "copies.arms.bodies: the frame is fixed",
        ),
        (
            "[copies.arms]",
            "[bodies.arm-1-2]\nfixed_to = \"carrier\"\n[copies.arms]",
            "copies.arms: the name arm-1-2 of a copy of",
        ),
        (
            "\"idler-1\", \"planet-1\"",
            "\"planet-1\"",
            "copies.arms: the train does not repeat: planet-1-2 is not",
        ),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let found = refused(&text);
        assert!(found.contains(stated), "{to}\n  {found}\n  {stated}");
    }
}
