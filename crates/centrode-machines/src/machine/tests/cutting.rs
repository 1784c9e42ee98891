use std::f64::consts::TAU;

use centrode_geometry::{Point, Vector};
use nalgebra::Isometry2;

use super::{made, refused};
use crate::machine::Machine;

/// Followers of every kind, with a motion of their own and the way the body is held on its carrier.
const FOLLOWERS: [(&str, &str); 5] = [
    (
        "{ kind = \"translating-roller\", roller_radius = 4 }",
        "on = \"CARRIER.Q\"\nslides_deg = 30\nlaw = { start = 19, expression = \"3 - 3*cos(2*phi - 0.4)\" }",
    ),
    (
        "{ kind = \"translating-flat\" }",
        "on = \"CARRIER.Q\"\nslides_deg = 30\nlaw = { expression = \"3 - 3*cos(2*phi - 0.4)\" }",
    ),
    (
        "{ kind = \"swinging-roller\", roller_radius = 4, arm_length = 40, lifts = \"clockwise\" }",
        "on = \"CARRIER.P\"\nlaw = { start_deg = 25, expression = \"0.1*sin(2*phi) + 0.02*sin(4*phi)\" }",
    ),
    (
        "{ kind = \"swinging-flat\", face_offset = 2 }",
        "on = \"CARRIER.P\"\nlaw = { expression = \"0.1*sin(2*phi)\" }",
    ),
    (
        "{ kind = \"swinging-flat\", face_offset = -3, lifts = \"clockwise\" }",
        "on = \"CARRIER.P\"\nlaw = { expression = \"0.1*sin(2*phi)\" }",
    ),
];

/// Cams that turn twice, that turn unevenly in either direction, and that are fixed while the carrier turns: bodies, cam,
/// carrier.
const DRIVES: [[&str; 3]; 3] = [
    [
        "[bodies.shaft]\non = \"frame.O\"\nlaw = { ratio = -2, start_deg = 11 }",
        "shaft",
        "frame",
    ],
    [
        "[bodies.shaft]\non = \"frame.O\"\nlaw = { expression = \"0.3 + phi + 0.4*sin(phi)\" }",
        "shaft",
        "frame",
    ],
    [
        "[bodies.arm]\non = \"frame.O\"\nlaw = { expression = \"phi + 0.4*cos(phi)\" }\npoints = { P = [50, 10], Q = [9, 9.660254037844386] }",
        "frame.O",
        "arm",
    ],
];

fn text(follower: usize, drive: usize) -> String {
    let (follower, held) = FOLLOWERS[follower];
    let [bodies, on, carrier] = DRIVES[drive];
    format!(
        r#"family = "machine"
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
cut_to = "lever"
follower = {follower}
body = {{ width = 7, bore = 6 }}
"#,
        held.replace("CARRIER", carrier)
    )
}

fn frame(machine: &Machine, body: usize, input: f64) -> Isometry2<f64> {
    let at = machine.place(body, Point::origin(), input);
    Isometry2::new(at.coords, machine.angle(body, input).position)
}

#[test]
fn a_cam_cut_to_a_moving_body_touches_it_all_round_and_its_base_circle_where_it_is_lowest() {
    for (drive, [_, _, carrier]) in DRIVES.iter().enumerate() {
        for follower in 0..FOLLOWERS.len() {
            let machine = made(&text(follower, drive));
            let body = |name: &str| machine.body_named(name).expect("there");
            let (cam, lever, on) = (&machine.cams()[0], body("lever"), body(carrier));
            assert_eq!(cam.followers, ["lever"]);
            let disc = cam.disc();
            let cam_body = body(DRIVES[drive][1].split('.').next().expect("a name"));
            let axis = machine.place(cam_body, cam.at, 0.0);
            assert!((axis - machine.place(on, Point::origin(), 0.0)).norm() < 1e-12);
            let touches: Vec<(f64, Point, Point)> = (0..97)
                .map(|i| {
                    let input = 0.13 * f64::from(i) - 2.0;
                    let place =
                        frame(&machine, cam_body, input) * Isometry2::new(cam.at.coords, cam.mount);
                    let turn = cam.turn(input).position;
                    let own = frame(&machine, lever, input).inverse() * place;
                    let contact = own * disc.contact(turn).point;
                    let path = disc.roller_center(turn).map(|center| own * center.point);
                    (turn, contact, path.unwrap_or(contact))
                })
                .collect();
            if let Some(roller) = machine.point_named("lever.roller").map(|point| point.at) {
                for (turn, contact, path) in &touches {
                    let off = (path - roller).norm();
                    assert!(off < 1e-10, "{drive} {follower} {turn}: {off}");
                    assert!(((contact - roller).norm() - 4.0).abs() < 1e-10);
                }
                let reach = if follower == 0 { 0.0 } else { 40.0 };
                let off = match follower {
                    0 => roller.y,
                    _ => roller.coords.norm() - reach,
                };
                assert!(off.abs() < 1e-10, "{off}");
            } else {
                let face = machine.point_named("lever.face").expect("a face").at;
                // All that is touched lies on a straight line, square to a slide or at its distance from the pin.
                let far = touches.iter().map(|(_, contact, _)| contact - face);
                let far = far.max_by(|a, b| a.norm().total_cmp(&b.norm()));
                let way: Vector = far.expect("some").normalize();
                for (turn, contact, _) in &touches {
                    let off = way.perp(&(contact - face));
                    assert!(off.abs() < 1e-10, "{drive} {follower} {turn}: {off}");
                }
                let off = match follower {
                    1 => way.x,
                    3 => way.perp(&face.coords).abs() - 2.0,
                    _ => way.perp(&face.coords).abs() - 3.0,
                };
                assert!(off.abs() < 1e-9, "{follower}: {off}");
            }
            // The base circle is touched, and nothing lies within it.
            let nearest = (0..2000).map(|i| {
                let turn = TAU * f64::from(i) / 2000.0;
                disc.motion().at(turn).position
            });
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!((-1e-12..1e-5).contains(&nearest), "{nearest}");
        }
    }
}

#[test]
fn a_cam_cut_to_what_another_cam_moves_is_that_cam() {
    let first = r#"family = "machine"
[frame.points]
O = [0, 0]
P = [50, 10]
[bodies.shaft]
on = "frame.O"
law = { ratio = -2, start_deg = 11 }
[bodies.lever]
on = "frame.P"
law = { follows = "push" }
[cams.push]
on = "shaft"
base_radius = 25
follower = { kind = "swinging-roller", roller_radius = 4, arm_length = 40 }
[[cams.push.motion.segments]]
kind = "rise"
span_deg = 120
swing_deg = 14
law = { kind = "polynomial-345" }
[[cams.push.motion.segments]]
kind = "dwell"
span_deg = 40
[[cams.push.motion.segments]]
kind = "return"
span_deg = 200
swing_deg = 14
law = { kind = "polynomial-345" }
"#;
    // Its roller is that of the body already.
    let again = "[cams.again]\non = \"shaft\"\nbase_radius = 25\ncut_to = \"lever\"\nfollower = { kind = \"swinging-roller\", roller_radius = 4, arm_length = 40 }\n";
    let stated = refused(&format!("{first}{again}"));
    assert!(
        stated.contains("cams.again.cut_to: body \"lever\" would have two points \"roller\""),
        "{stated}"
    );
    // Of another on the same pin that moves alike.
    let twin = "[bodies.twin]\non = \"frame.P\"\nlaw = { ratio = 1, by = \"lever\" }\n";
    let cut = again.replace("\"lever\"", "\"twin\"");
    let machine = made(&format!("{first}{twin}{cut}"));
    let [again, push] = [0, 1].map(|i| machine.cams()[i].disc());
    for i in 0..360 {
        let turn = f64::from(i).to_radians();
        let off = (again.contact(turn).point - push.contact(turn).point).norm();
        assert!(off < 1e-10, "{i}: {off}");
    }
    assert_eq!(
        again.motion().breaks().len(),
        push.motion().breaks().len(),
        "{:?}",
        again.motion().breaks()
    );
}

#[test]
fn cams_that_cannot_be_cut_are_told_with_their_numbers() {
    let sliding = text(0, 0);
    let swinging = text(2, 1);
    for (text, from, to, stated) in [
        (
            &sliding,
            "cos(2*phi - 0.4)",
            "cos(phi)",
            "cams.push.cut_to: the motion of body lever does not repeat with every turn of cam push relative to body frame (2 turns in a period): at inputs of ",
        ),
        (
            &sliding,
            "expression = \"3 - 3*cos(2*phi - 0.4)\"",
            "expression = \"0*phi\"",
            "cams.push.cut_to: body lever does not move",
        ),
        (
            &swinging,
            "phi + 0.4*sin(phi)",
            "phi + 1.4*sin(phi)",
            "cams.push.cut_to: cam push must turn in one direction relative to body frame, which carries its follower lever, but at an input of 135.",
        ),
        (
            &swinging,
            "phi + 0.4*sin(phi)",
            "0.4*sin(phi)",
            "cams.push.cut_to: cam push makes no whole turn relative to body frame",
        ),
        (
            &swinging,
            "law = { start_deg = 25, expression = \"0.1*sin(2*phi) + 0.02*sin(4*phi)\" }",
            "law = { ratio = 1 }",
            "cams.push.cut_to: body lever makes 1.000000 turns on frame in a period",
        ),
        (
            &swinging,
            "cut_to = \"lever\"",
            "cut_to = \"shuttle\"",
            "cams.push.cut_to: there is no body \"shuttle\"",
        ),
        (
            &swinging,
            "cut_to = \"lever\"",
            "cut_to = \"frame\"",
            "cams.push.cut_to: body frame neither turns nor slides",
        ),
        (&swinging, "cut_to = \"lever\"\n", "", "cams.push.motion: "),
        (
            &swinging,
            "base_radius = 25",
            "base_radius = 25\nabout = \"lever.roller\"",
            "cams.push.about: body \"lever\" has no point \"roller\"",
        ),
        (
            &swinging,
            "base_radius = 25",
            "base_radius = 25\nabout = \"lever\"",
            "cams.push.about: lever moves relative to body shaft: cam push on this body cannot be mounted about it",
        ),
        (
            &swinging,
            "base_radius = 25",
            "base_radius = 95",
            "cams.push.follower: ",
        ),
    ] {
        let bad = text.replacen(from, to, 1);
        assert_ne!(&bad, text, "{from}");
        let found = refused(&bad);
        assert!(found.contains(stated), "{to}\n  {found}\n  {stated}");
    }
    // The speed of what an intermittent gear without entry turns jumps.
    let held = "[bodies.star]\non = \"frame.Q\"\nlaw = { intermittent = { driver_pitches = 40, driven_pitches = 30, teeth = 30 } }\n[bodies.lever]";
    let jumping = swinging.replace("[bodies.lever]", held).replace(
        "{ start_deg = 25, expression = \"0.1*sin(2*phi) + 0.02*sin(4*phi)\" }",
        "{ expression = \"0.1*sin(phi)\", by = \"star\" }",
    );
    let found = refused(&jumping);
    let stated = "cams.push.cut_to: the speed of body lever jumps from 0 to 0.133333333 per radian";
    assert!(
        found.contains(stated) && found.contains("of the input at 0.0000 deg"),
        "{found}"
    );
}
