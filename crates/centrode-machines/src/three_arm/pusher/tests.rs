use super::*;
use crate::three_arm::ThreeArmLink;
use crate::three_arm::design::ThreeArmDesign;
use centrode_gear::pitch::PitchSpec;
use centrode_geometry::Tolerance;
use centrode_spec::DesignSpec as _;

fn template() -> ThreeArmDesign {
    ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound")
}

fn with(change: impl Fn(&mut ThreeArmDesign)) -> ThreeArm {
    let mut design = template();
    change(&mut design);
    ThreeArm::resolve(&design).expect("a mechanism")
}

/// The roller, placed by the fork on the arm, is on the cam, placed on the carrier, and the rod's pin is
/// where the slot of the fork is.
fn stands(mechanism: &ThreeArm) {
    let pusher = mechanism.pusher().expect("a pusher");
    let cam = pusher.cam();
    let profile = cam.profile().outline();
    let radius = pusher.fork_spec().roller_radius;
    let (outline, holes) = pusher.fork_outline().expect("a fork");
    assert_eq!((outline.crossing(), holes.len()), (None, 3));
    let slot = &holes[2];
    let arms = f64::from(mechanism.arms());
    for arm in 0..mechanism.arms() {
        for i in 0..24 {
            let input = 0.1 + TAU * f64::from(i) / 24.0;
            let frame = mechanism.link(ThreeArmLink::Arm(arm), input);
            let carrier = mechanism.link(ThreeArmLink::Carrier, input).angle.position;
            let back = pusher.retraction(mechanism.own_input(input, arm));
            let roller = frame.point(pusher.roller(back.position)).position;
            // Seen from the cam, whose frame turns with the carrier, each later by its share.
            let share = -mechanism.train().direction().sign() * TAU * f64::from(arm) / arms;
            let turn = carrier + pusher.cam_angle() + share;
            let seen = Point::from(Rotation2::new(-turn) * (roller - frame.origin.position));
            let nearest = profile
                .flatten(Tolerance::new(1e-5).expect("positive"))
                .iter()
                .map(|p| (p - seen).norm())
                .fold(f64::INFINITY, f64::min);
            // Points of the flattened profile are apart: the nearest is a little farther than the profile.
            assert!(
                nearest > radius - 1e-5 && nearest < radius + 5e-3,
                "arm {arm} at {input}: {nearest}"
            );
            // The pin: on the pusher's axis, drawn back from where it is thrown out.
            let side = mechanism.design().arm.pusher_offset.signum();
            let pin = Point::new(
                0.5 * pusher.stroke() - back.position,
                -mechanism.design().arm.pusher_offset,
            );
            let in_fork =
                Rotation2::new(-pusher.fork_angle(&back).position) * (pin - pusher.pivot());
            assert!(
                slot.contains(Point::from(in_fork * (1.0 - 1e-9))),
                "{side} {input}"
            );
        }
    }
}

#[test]
fn the_roller_stands_on_the_cam_and_the_pin_in_the_slot() {
    stands(&with(|_| {}));
}

/// The machine seen in a mirror.
fn mirrored(design: &mut ThreeArmDesign) {
    design.direction = crate::three_arm::design::Direction::CounterClockwise;
    design.carrier_start = 2.0 * FRAC_PI_2 - design.carrier_start;
    design.bend = -design.bend;
    design.arm.mounting_angle = -design.arm.mounting_angle;
    design.arm.pusher_offset = -design.arm.pusher_offset;
    let PitchSpec::Bspline(curve) = &mut design.pitch else {
        panic!("a B-spline")
    };
    curve.radius.reverse();
    curve.angle.reverse();
    for angle in &mut curve.angle {
        *angle = TAU - *angle;
    }
}

#[test]
fn a_machine_seen_in_a_mirror_has_the_cam_seen_in_a_mirror() {
    let (here, there) = (with(|_| {}), with(mirrored));
    stands(&there);
    let [a, b] = [&here, &there].map(|m| m.pusher().expect("a pusher"));
    let area = |p: &Pusher| p.cam().profile().outline().area();
    assert!(
        (area(&a) - area(&b)).abs() < 1e-6,
        "{} {}",
        area(&a),
        area(&b)
    );
    assert_eq!(a.cam_span(), b.cam_span());
    assert!((a.pivot().y + b.pivot().y).abs() < 1e-12);
}

#[test]
fn the_rod_is_back_from_picking_to_planting_and_out_after() {
    let mechanism = with(|_| {});
    let pusher = mechanism.pusher().expect("a pusher");
    let at = |degrees: f64| pusher.retraction(degrees.to_radians()).position;
    for (degrees, back) in [
        (20.0, 25.0),
        (100.0, 25.0),
        (191.0, 25.0),
        (221.0, 0.0),
        (300.0, 0.0),
    ] {
        assert!(
            (at(degrees) - back).abs() < 1e-9,
            "{degrees}: {}",
            at(degrees)
        );
    }
    assert!((at(206.0) - 12.5).abs() < 1e-9 && (at(350.0) - 12.5).abs() < 1e-9);
    // Regular: no undercut, and pressure angles as the sizes were chosen for.
    let limits = pusher.cam().disc().limits();
    assert!(limits.minimum_radius.value > 1.5 && limits.regularity.value > 0.0);
    assert!(
        limits.rise_pressure_angle.value < 35.0_f64.to_radians(),
        "{limits:?}"
    );
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    let error = |change: fn(&mut ThreeArmDesign)| with(change).pusher().expect_err("refused");
    let short = error(|d| {
        d.arm.pusher_offset = 20.0;
        d.fork = Some(ForkSpec::default());
    });
    assert!(matches!(short, PusherError::Pivot { .. }), "{short}");
    assert_eq!(short.key(), "fork.pivot_distance");
    let long = error(|d| {
        d.cam = Some(PusherCamSpec {
            closing: 3.0,
            release: 1.5,
            ..PusherCamSpec::default()
        });
    });
    assert!(matches!(long, PusherError::NoRest { .. }), "{long}");
    let thick = error(|d| {
        let mut cam = PusherCamSpec::default();
        cam.body.width = 20.0;
        d.cam = Some(cam);
    });
    assert!(matches!(thick, PusherError::Depth { .. }), "{thick}");
    let near = error(|d| {
        d.fork = Some(ForkSpec {
            arm_length: 3.9,
            ..ForkSpec::default()
        });
    });
    assert!(matches!(near, PusherError::Holes { .. }), "{near}");
    let wide = error(|d| {
        let mut cam = PusherCamSpec::default();
        cam.body.bore = 40.0;
        d.cam = Some(cam);
    });
    assert_eq!(wide.key(), "cam.body.bore");
    let mut design = template();
    design.cam = Some(PusherCamSpec {
        release: 0.0,
        ..PusherCamSpec::default()
    });
    let error = design.validate().expect_err("refused");
    assert_eq!(error.key, "cam.release_deg");
}

#[test]
fn every_mesh_is_a_pose_of_the_pair_at_every_input() {
    for (arms, bend, teeth) in [(3, -53.0, 37), (2, 40.0, 36), (5, -10.0, 41)] {
        let mechanism = with(|d| {
            d.arms = arms;
            d.bend = f64::to_radians(bend);
            d.tooth_count = Some(teeth);
            d.work.planting = None;
            d.work.picking = None;
        });
        let rolling = mechanism.rolling();
        for mesh in mechanism.meshes() {
            for i in 0..90 {
                let pose = mechanism.mesh_pose(mesh, TAU * f64::from(i) / 90.0 + 0.01);
                let off = pose.driven - rolling.driven_angle(pose.driver);
                let turns = (off / TAU).round();
                assert!((off - TAU * turns).abs() < 1e-11, "{mesh:?} {off}");
            }
        }
    }
}

#[test]
fn the_gearbox_encloses_the_gears_and_turns_within_its_radius() {
    let mechanism = with(|_| {});
    let body = mechanism.gearbox().expect("a body");
    assert_eq!(body.holes.len(), 7);
    let far = body
        .outline
        .flatten(Tolerance::new(1e-3).expect("positive"))
        .iter()
        .map(|p| p.coords.norm())
        .fold(0.0, f64::max);
    assert!((far - mechanism.gearbox_radius()).abs() < 0.01, "{far}");
    for hole in &body.holes {
        assert!(body.outline.contains(hole.centroid()));
    }
}

#[test]
fn the_usual_arm_fits_every_tip_and_offset_that_leave_a_clamp_its_room() {
    let mut made = 0;
    for tip in [70.0, 112.0, 180.0, 240.0] {
        for share in [0.1, 0.3, 0.625, 0.85] {
            for side in [-1.0, 1.0] {
                let offset: f64 = side * share * tip;
                let along = f64::sqrt(tip * tip - offset * offset);
                // The clamp leaves the housing next to the pusher's axis, not under the planet's.
                if along - 60.0 < 0.2 * offset.abs() {
                    continue;
                }
                let mechanism = with(|d| {
                    d.arm.tip_distance = tip;
                    d.arm.pusher_offset = offset;
                });
                let (arm, pusher) = (mechanism.arm_body(), mechanism.pusher());
                let arm = arm.unwrap_or_else(|e| panic!("{tip} {offset}: {e}"));
                let pusher = pusher.unwrap_or_else(|e| panic!("{tip} {offset}: {e}"));
                // The part that the spring pushes is clear of the fork's pin.
                let part = |name: &str| arm.parts().iter().find(|p| p.name == name);
                let spring = part("spring").expect("a spring").outline.bounds();
                assert!(spring.min.x > 0.5 * pusher.stroke(), "{tip} {offset}");
                made += 1;
            }
        }
    }
    assert!(made > 20, "{made}");
    // Behind a clamp as long as the distance to the tip there is no arm. This is an error.
    let none = with(|d| {
        d.arm.tip_distance = 80.0;
        d.arm.pusher_offset = 75.0;
    });
    let error = none.arm_body().expect_err("no arm");
    assert!(
        error.to_string().contains("shorten the clamp (60 mm)"),
        "{error}"
    );
}
