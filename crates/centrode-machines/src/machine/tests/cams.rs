use std::f64::consts::TAU;

use centrode_geometry::{Point, Vector};
use nalgebra::Isometry2;

use super::{made, refused};
use crate::machine::{BodyPoint, Machine};
use centrode_kinematics::machine::JointKind;

/// Followers of every kind, with their motion and the way the body is held on its carrier.
const FOLLOWERS: [(&str, &str, &str); 4] = [
    (
        "{ kind = \"translating-roller\", roller_radius = 4, offset = 3 }",
        "lift = 8",
        "on = \"CARRIER.Q\"\nslides_deg = 30\nlaw = { follows = \"push\", start = 2 }",
    ),
    (
        "{ kind = \"translating-flat\" }",
        "lift = 8",
        "on = \"CARRIER.Q\"\nslides_deg = 30\nlaw = { follows = \"push\" }",
    ),
    (
        "{ kind = \"swinging-roller\", roller_radius = 4, arm_length = 40, lifts = \"clockwise\" }",
        "swing_deg = 14",
        "on = \"CARRIER.P\"\nlaw = { follows = \"push\", start_deg = 25 }",
    ),
    (
        "{ kind = \"swinging-flat\", face_offset = 2 }",
        "swing_deg = 14",
        "on = \"CARRIER.P\"\nlaw = { follows = \"push\" }",
    ),
];

/// Cams that turn, swing, and stand still while the carrier turns: the bodies, the cam's body, the carrier.
const DRIVES: [(&str, &str, &str); 3] = [
    (
        "[bodies.shaft]\non = \"frame.O\"\nlaw = { ratio = -2, start_deg = 11 }",
        "shaft",
        "frame",
    ),
    (
        "[bodies.shaft]\non = \"frame.O\"\nlaw = { expression = \"0.3 + 0.9*sin(phi)\" }\n[bodies.hub]\nfixed_to = \"shaft\"\nturned_deg = 50",
        "hub",
        "frame",
    ),
    (
        "[bodies.arm]\non = \"frame.O\"\nlaw = { expression = \"phi + 0.4*cos(phi)\" }\npoints = { P = [50, 10], Q = [9, 9.660254037844386] }",
        "frame.O",
        "arm",
    ),
];

/// The machine of a follower and a drive. The slide passes (9, 9.66), 3.87 mm and with `offset` 3 mm to the left of the axis.
fn text(follower: usize, drive: usize) -> String {
    let (follower, stroke, held) = FOLLOWERS[follower];
    let (bodies, on, carrier) = DRIVES[drive];
    format!(
        r#"family = "machine"
hardware = "list"
[frame.points]
O = [0, 0]
P = [50, 10]
Q = [9, 9.660254037844386]
{bodies}
[bodies.lever]
{}
[cams.push]
on = "{on}"
mount_deg = 17
base_radius = 25
follower = {follower}
body = {{ width = 7, bore = 6 }}
[[cams.push.motion.segments]]
kind = "rise"
span_deg = 120
{stroke}
law = {{ kind = "polynomial-4567" }}
[[cams.push.motion.segments]]
kind = "dwell"
span_deg = 40
[[cams.push.motion.segments]]
kind = "return"
span_deg = 150
{stroke}
law = {{ kind = "polynomial-4567" }}
[[cams.push.motion.segments]]
kind = "dwell"
span_deg = 50
"#,
        held.replace("CARRIER", carrier)
            .replace("offset = 3", "offset = 3.8660254037844384"),
    )
    .replace("offset = 3 ", &format!("offset = {} ", offset()))
}

/// Distance of the slide through (9, 9.66...) at 30 degrees from the axis.
fn offset() -> f64 {
    9.660_254_037_844_386 * 30.0_f64.to_radians().cos() - 9.0 * 0.5
}

/// Position of a body.
fn frame(machine: &Machine, body: usize, input: f64) -> Isometry2<f64> {
    let at = machine.place(body, Point::origin(), input);
    Isometry2::new(at.coords, machine.angle(body, input).position)
}

#[test]
fn every_follower_stays_on_its_cam_whatever_turns() {
    for (drive, (_, seat, ..)) in DRIVES.iter().enumerate() {
        for follower in 0..FOLLOWERS.len() {
            let machine = made(&text(follower, drive));
            let body = |name: &str| machine.body_named(name).expect("there");
            let (cam, lever) = (&machine.cams()[0], body("lever"));
            let on = body(seat.split('.').next().expect("a name"));
            let (disc, roller) = (cam.disc(), machine.point_named("lever.roller"));
            assert_eq!(roller.is_some(), disc.follower().roller_radius().is_some());
            for i in 0..97 {
                let input = 0.13 * f64::from(i) - 2.0;
                let place = frame(&machine, on, input) * Isometry2::new(cam.at.coords, cam.mount);
                let turn = cam.turn(input).position;
                let contact = disc.contact(turn);
                // The contact in the follower's axes: on its roller, or on its face.
                let touched = frame(&machine, lever, input).inverse() * (place * contact.point);
                let off = match (roller, follower) {
                    (Some(BodyPoint { at, .. }), _) => {
                        let path = disc.roller_center(turn).expect("a roller").point;
                        let off = place * path - machine.place(lever, at, input);
                        off.norm().max(((touched - at).norm() - 4.0).abs())
                    }
                    (None, 1) => touched.x,
                    (None, _) => touched.y.abs() - 2.0,
                };
                assert!(off.abs() < 1e-10, "{drive} {follower} {input}: {off}");
            }
        }
    }
}

#[test]
fn a_follower_moves_as_its_cam_does_and_its_derivatives_as_differences() {
    for drive in 0..DRIVES.len() {
        for follower in 0..FOLLOWERS.len() {
            let machine = made(&text(follower, drive));
            let lever = machine.body_named("lever").expect("there");
            let mount = machine.bodies()[lever].mount.as_ref().expect("held");
            let (law, cam) = (&mount.law, &machine.cams()[0]);
            let sense = if follower == 2 { -1.0 } else { 1.0 };
            let zero = law.at(0.0).position
                - sense * cam.disc().motion().at(cam.turn(0.0).position).position;
            assert_eq!(matches!(mount.kind, JointKind::Sliding(_)), follower < 2);
            for i in 0..80 {
                let input = 0.077 * f64::from(i) + 0.01;
                let lift = cam.disc().motion().at(cam.turn(input).position).position;
                let own = law.at(input);
                assert!((own.position - zero - sense * lift).abs() < 1e-12);
                let far = law.breaks().iter().all(|b| (input - b).abs() > 1e-3);
                let step = 1e-5;
                let [before, after] = [input - step, input + step].map(|at| law.at(at));
                let rate = |a: f64, b: f64| (b - a) / (2.0 * step);
                for (exact, found) in [
                    (own.velocity, rate(before.position, after.position)),
                    (own.acceleration, rate(before.velocity, after.velocity)),
                    (own.jerk, rate(before.acceleration, after.acceleration)),
                ] {
                    let off = (exact - found).abs();
                    assert!(!far || off < 1e-4 * (1.0 + exact.abs()), "{exact} {found}");
                }
            }
            let [start, end] = [0.0, TAU].map(|at| law.at(at).position);
            assert!((start - end).abs() < 1e-12 && law.advance() == 0.0);
        }
    }
}

#[test]
fn a_break_of_a_cams_motion_is_one_of_its_follower() {
    // Two turns per cycle, four breaks per turn.
    let machine = made(&text(0, 0).replace("-4567", "-345"));
    let lever = machine.body_named("lever").expect("there");
    let law = &machine.bodies()[lever].mount.as_ref().expect("held").law;
    let cam = &machine.cams()[0];
    let breaks = law.breaks();
    assert_eq!(breaks.len(), 8, "{breaks:?}");
    for input in breaks {
        let turn = cam.turn(input).position.rem_euclid(TAU).to_degrees();
        let near = [0.0, 120.0, 160.0, 310.0, 360.0].into_iter();
        let off = near.map(|b: f64| (turn - b).abs()).fold(9.0, f64::min);
        assert!(off < 1e-9, "{turn}");
    }
}

#[test]
fn a_cam_is_a_part_with_its_mass_on_its_body_and_a_roller_in_the_picture() {
    let machine = made(&text(0, 0));
    let made = machine.machine().expect("plates and cams");
    assert_eq!(made.validate(), Ok(()));
    super::random::agrees(&machine, &made);
    let part = made.parts.iter().find(|part| part.name == "push");
    let part = part.expect("listed");
    let shaft = machine.body_named("shaft").expect("there");
    assert_eq!(
        (part.links[0], part.remark.as_str()),
        (shaft, "moves lever, on shaft")
    );
    let outline = machine.cams()[0].part.profile().outline();
    let area = outline.area() - 9.0 * std::f64::consts::PI;
    let mass = part.mass.expect("a mass");
    let density = machine.cams()[0].part.body().density;
    assert!((mass - area * 7.0 * density * 1e-9).abs() < 1e-9 * mass);
    // On a single point, the body has no plate, and its shaft comes from the customer.
    let with = made.links[shaft].mass.expect("a mass").mass;
    assert!(machine.plate(shaft).expect("sound").is_none());
    assert!((with - mass).abs() < 1e-12 * with);
    // A roller of 4 mm about the origin moved by the start of 2 mm.
    let lever = machine.body_named("lever").expect("there");
    let roller = machine.roller("lever").expect("a roller");
    let middle = 0.5 * (roller.bounds().min.coords + roller.bounds().max.coords);
    assert!((middle - Vector::new(-2.0, 0.0)).norm() < 1e-12);
    let lines = &made.sketches[made.figures[lever].sketch].lines;
    let drawn = |line: &centrode_kinematics::machine::Line| {
        line.path == centrode_kinematics::machine::LinePath::Contour(roller.clone())
    };
    assert!(lines.iter().any(drawn));
}

#[test]
fn a_roller_is_a_part_on_a_pin_from_its_plate_to_its_cam_at_whatever_height_that_is() {
    let full = |follower: usize| text(follower, 0).replace("\"list\"", "\"full\"");
    let text = full(2);
    for (layer, clear) in [
        ("", None),
        ("layer = 4\n", Some(4.0)),
        ("layer = -9\n", Some(-9.0)),
    ] {
        let machine =
            made(&text.replace("base_radius = 25\n", &format!("base_radius = 25\n{layer}")));
        let plates = machine.plates();
        let step = plates.thickness + plates.gap;
        let made = machine.machine().expect("plates and cams");
        let part = made.parts.iter().find(|part| part.file == "roller-3x8x7");
        let part = part.expect("listed");
        assert_eq!((&*part.name, part.quantity()), ("Cam roller 3 x 8 x 7", 1));
        // A ring of steel.
        let mass = std::f64::consts::PI * (16.0 - 2.25) * 7.0 * plates.density * 1e-9;
        assert!((part.mass.expect("a mass") - mass).abs() < 1e-12);
        let low = clear.map_or(-step - 7.0 - plates.gap, |layer: f64| layer * step);
        let pins = machine.pins_in_plates();
        let pin = pins.iter().find(|pin| pin.pieces[0].link == "lever");
        let pin = pin.expect("a pin");
        let bottom = pin.pieces[0].at[2];
        let (_, at) = pin
            .spacers
            .iter()
            .find(|(ring, _)| ring.outer == 8.0)
            .expect("on it");
        assert!((bottom + at - low).abs() < 1e-9, "{bottom} {at} {low}");
        // It goes through the plate and the roller.
        let lever = machine.bottom(machine.body_named("lever").expect("there"));
        let ends = [lever.min(low), (lever + plates.thickness).max(low + 7.0)];
        assert!(bottom <= ends[0] + 1e-9 && bottom + pin.part.length() >= ends[1] - 1e-9);
    }
    // A flat face has none, and a pin that the roller does not hold neither.
    let files = |text: &str| {
        let parts = made(text).machine().expect("plates").parts;
        parts
            .iter()
            .filter(|part| part.file.starts_with("roller"))
            .count()
    };
    assert_eq!(files(&full(1)), 0);
    assert_eq!(files(&format!("{text}[plates]\npin_diameter = 7\n")), 0);
}

#[test]
fn bad_cams_are_told_by_their_key_with_both_numbers() {
    let sliding = text(0, 0);
    let swinging = text(2, 0);
    for (text, from, to, stated) in [
        (
            &sliding,
            format!("offset = {}", offset()),
            "offset = 5".to_owned(),
            "cams.push.follower.offset: is 5 mm, but body lever is at 3.8660",
        ),
        (
            &swinging,
            "arm_length = 40".into(),
            "arm_length = 40, center_distance = 60".into(),
            "cams.push.follower.center_distance: is 60 mm, but body lever is at 50.990",
        ),
        (
            &sliding,
            "base_radius = 25".into(),
            "base_radius = 25\nrotation = \"counter-clockwise\"".into(),
            "cams.push.rotation: cam push makes -2 turns (counter-clockwise positive) relative to body frame, which carries its follower lever: this is opposite to rotation",
        ),
        (
            &swinging,
            "\nlaw = { follows = \"push\", start_deg = 25 }".into(),
            "\nslides_deg = 0\nlaw = { follows = \"push\" }".into(),
            "bodies.lever.law.follows: the follower of cam push needs a body that turns, not a body that slides",
        ),
        (
            &sliding,
            "follows = \"push\"".into(),
            "follows = \"pull\"".into(),
            "bodies.lever.law.follows: there is no cam \"pull\"; there are push",
        ),
        (
            &sliding,
            "law = { follows = \"push\", start = 2 }".into(),
            "law = { start = 2 }".into(),
            "cams.push: no body follows cam push",
        ),
        (
            &sliding,
            "on = \"shaft\"".into(),
            "on = \"lever\"".into(),
            "bodies.lever: the position of bodies.lever depends on itself",
        ),
        (
            &sliding,
            "ratio = -2".into(),
            "ratio = -2.5".into(),
            "bodies.shaft.law.ratio: turns the body by -2.",
        ),
        (
            &sliding,
            "ratio = -2, ".into(),
            String::new(),
            "bodies.lever.law.follows: cam push does not turn relative to body frame, which carries its follower lever",
        ),
        (
            &sliding,
            "bore = 6".into(),
            "bore = 60".into(),
            "cams.push.body.bore: the bore reaches 30 mm",
        ),
        (
            &sliding,
            "base_radius = 25".into(),
            "base_radius = 0".into(),
            "cams.push.base_radius: ",
        ),
        (
            &sliding,
            "on = \"shaft\"\nmount".into(),
            "on = \"crank\"\nmount".into(),
            "cams.push.on: there is no body \"crank\"",
        ),
    ] {
        let bad = text.replacen(&from, &to, 1);
        assert_ne!(&bad, text, "{from}");
        let found = refused(&bad);
        assert!(found.contains(stated), "{to}\n  {found}\n  {stated}");
    }
    // A cam whose axis runs about on what should carry the follower.
    let moving = sliding
        .replace("on = \"shaft\"", "on = \"shaft.A\"")
        .replace(
            "start_deg = 11 }",
            "start_deg = 11 }\npoints = { A = [5, 0] }",
        );
    let stated = "bodies.lever.law.follows: the axis of cam push must be fixed on body frame, but moves relative to it";
    assert!(refused(&moving).contains(stated), "{}", refused(&moving));
}

#[test]
fn two_bodies_follow_one_cam_only_where_they_are_held_alike() {
    let other = |at: &str| {
        text(2, 0)
            .replace("[frame.points]", &format!("[frame.points]\nR = {at}"))
            .replace(
                "[cams.push]\n",
                "[bodies.second]\non = \"frame.R\"\nlaw = { follows = \"push\" }\n[cams.push]\n",
            )
    };
    // A quarter of a turn on, the same motion at half the shaft's quarter.
    let machine = made(&other("[-10, 50]"));
    assert_eq!(machine.cams()[0].followers, ["lever", "second"]);
    let [one, two] = ["lever", "second"].map(|name| machine.body_named(name).expect("there"));
    for i in 0..20 {
        let input = 0.3 * f64::from(i);
        let lead = machine.angle(one, input + TAU / 8.0).velocity;
        let lag = machine.angle(two, input).velocity;
        assert!((lead - lag).abs() < 1e-10, "{lead} {lag}");
    }
    let found = refused(&other("[-10, 51]"));
    let stated = "bodies.second.law.follows: body second is 51.97";
    assert!(
        found.contains(stated) && found.contains("but body lever is at 50.99"),
        "{found}"
    );
}
