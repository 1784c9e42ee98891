use std::sync::Arc;

use crate::forces::Balance;

use super::*;

/// Cams with the bodies that follow them, without masses, and a load on each.
const FOLLOWERS: [[&str; 3]; 4] = [
    [
        "{ kind = \"translating-roller\", roller_radius = 4, offset = 3 }",
        "lift = 8",
        "on = \"CARRIER.Q\"\nslides_deg = 30\n",
    ],
    [
        "{ kind = \"translating-flat\" }",
        "lift = 8",
        "on = \"CARRIER.Q\"\nslides_deg = 30\n",
    ],
    [
        "{ kind = \"swinging-roller\", roller_radius = 4, arm_length = 40, lifts = \"clockwise\" }",
        "swing_deg = 14",
        "on = \"CARRIER.P\"\n",
    ],
    [
        "{ kind = \"swinging-flat\", face_offset = 2 }",
        "swing_deg = 14",
        "on = \"CARRIER.P\"\n",
    ],
];

/// A cam that turns backwards, and one that stands while its carrier goes round it.
const DRIVES: [[&str; 3]; 2] = [
    [
        "[bodies.shaft]\non = \"frame.O\"\nplate = false\nlaw = { ratio = -2, start_deg = 11 }",
        "shaft",
        "frame",
    ],
    [
        "[bodies.arm]\non = \"frame.O\"\nplate = false\nlaw = { expression = \"phi + 0.4*cos(phi)\" }\npoints = { P = [50, 10], Q = [9, 9] }",
        "frame.O",
        "arm",
    ],
];

/// Load on a follower: N along the slide, or N mm.
const LOAD: f64 = -30.0;

fn machine([follower, stroke, held]: [&str; 3], [bodies, on, carrier]: [&str; 3]) -> Machine {
    let (held, load) = (
        held.replace("CARRIER", carrier),
        match held.contains("slides") {
            true => format!("force = [{LOAD}, 0]\naxes = \"body\""),
            false => format!("torque = {LOAD}"),
        },
    );
    // The slide passes (9, 9) at 30 degrees.
    let offset = 9.0 * (30.0_f64.to_radians().cos() - 0.5);
    let follower = follower.replace("offset = 3 ", &format!("offset = {offset} "));
    let segment = |kind: &str, span: f64| {
        format!(
            "[[cams.push.motion.segments]]\nkind = \"{kind}\"\nspan_deg = {span}\n{stroke}\nlaw = {{ kind = \"polynomial-4567\" }}\n"
        )
    };
    composed(&format!(
        "family = \"machine\"\n[frame.points]\nO = [0, 0]\nP = [50, 10]\nQ = [9, 9]\n{bodies}\n\
         [bodies.lever]\nplate = false\n{held}law = {{ follows = \"push\" }}\n[loads.work]\non = \"lever\"\n{load}\n\
         [cams.push]\non = \"{on}\"\nmount_deg = 17\nbase_radius = 25\nfollower = {follower}\n{}{}",
        segment("rise", 160.0),
        segment("return", 200.0),
    ))
}

#[test]
fn a_cam_pushes_along_its_normal_so_that_the_input_does_the_work_of_the_load() {
    for drive in DRIVES {
        for follower in FOLLOWERS {
            let made = machine(follower, drive);
            let lever = made.body_named("lever").expect("there");
            let links = made.machine().expect("a machine");
            assert_eq!(links.contacts.len(), 1);
            let balance = Balance::new(Arc::new(links)).expect("determined");
            for i in 0..61 {
                let input = 0.1 * f64::from(i);
                let forces = balance.at(input, 0.0).expect("forces");
                // The load goes with the follower, and with what carries it.
                let turned = made.angle(lever, input);
                let moved = made.point(lever, Default::default(), input).first;
                let (sin, cos) = turned.position.sin_cos();
                let rate = match follower[2].contains("slides") {
                    true => moved.x * cos + moved.y * sin,
                    false => turned.velocity,
                };
                let work = -LOAD * rate;
                let off = (forces.input_torque - work).abs();
                assert!(off < 1e-9 * 500.0, "{follower:?} {drive:?} {input}: {off}");
                // Nothing else moves the follower.
                assert!(forces.joints[lever - 1].drive.abs() < 1e-9);
                assert!(forces.contacts[0].norm() > LOAD.abs() / 60.0);
            }
        }
    }
}

#[test]
fn the_guide_of_a_roller_carries_the_load_times_the_tangent_of_the_pressure_angle() {
    let made = machine(FOLLOWERS[0], DRIVES[0]);
    let lever = made.body_named("lever").expect("there");
    let cam = &made.cams()[0];
    let balance = Balance::new(Arc::new(made.machine().expect("a machine"))).expect("determined");
    for i in 0..61 {
        let input = 0.1 * f64::from(i);
        let forces = balance.at(input, 0.0).expect("forces");
        let tangent = cam.disc().contact(cam.turn(input).position).pressure_angle;
        let reaction = forces.joints[lever - 1].reaction.expect("known").force;
        let off = reaction.norm() - (LOAD * tangent.tan()).abs();
        assert!(off.abs() < 1e-10, "{input}: {off}");
        let normal = forces.contacts[0].norm() - (LOAD / tangent.cos()).abs();
        assert!(normal.abs() < 1e-10, "{input}: {normal}");
    }
}
