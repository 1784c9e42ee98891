use std::f64::consts::{PI, TAU};

use centrode_analysis::{between_arms, machine_clearance};
use centrode_geometry::{Outline, Point, Segment, Tolerance, Vector, extremes};
use centrode_kinematics::transmission::MotionJet;
use centrode_machines::machine::{Machine, MachineDesign};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;
use nalgebra::Rotation2;

use crate::data::file;

fn text(name: &str) -> String {
    let path = file(&format!("designs/{name}.toml"));
    std::fs::read_to_string(path).expect("text")
}

fn made(name: &str) -> Machine {
    let design = MachineDesign::from_toml(&text(name)).expect("a design");
    Machine::resolve(&design).expect("a machine")
}

/// Maximum difference of two motions, whole turns aside.
fn apart(one: &MotionJet, other: &MotionJet) -> f64 {
    let turns = ((one.position - other.position) / TAU).round();
    let position = one.position - other.position - TAU * turns;
    let velocity = one.velocity - other.velocity;
    position.abs().max(velocity.abs())
}

#[test]
fn the_composed_transplanter_moves_as_the_family_of_its_own() {
    let composed = made("composed-three-arm");
    let design = ThreeArmDesign::from_toml(&text("three-arm-2021")).expect("a design");
    let family = ThreeArm::resolve(&design).expect("a mechanism");
    let pusher = family.pusher().expect("push rods");
    for i in 0..90 {
        let input = 0.0701 * f64::from(i);
        for arm in 0..3 {
            let name = |of: &str| match arm {
                0 => of.to_owned(),
                _ => format!("{of}-{}", arm + 1),
            };
            let body = |of: &str| composed.body_named(&name(of)).expect("there");
            let near = |what: &str, off: f64| {
                assert!(off < 1e-9, "{what} of arm {arm} at {input}: {off}");
            };
            let own = family.own_input(input, arm);
            let train = family.train().at(own);
            let planet = composed.angle(body("planet"), input);
            near("planet", apart(&planet, &train.planet));
            let idler = composed.angle(body("idler"), input);
            near("idler", apart(&idler, &train.intermediate));
            let tip = composed.point(body("arm"), Point::new(145.0, 0.0), input);
            let theirs = family.tip(input, arm);
            near("tip", (tip.point - theirs.position).norm());
            near("tip's velocity", (tip.first - theirs.velocity).norm());
            // Along its way, from where it is thrown out.
            let rod = &composed.bodies()[body("rod")]
                .mount
                .as_ref()
                .expect("held")
                .law;
            let (rod, theirs) = (rod.at(input), pusher.retraction(own));
            near("rod", (rod.position + theirs.position).abs());
            near("rod's velocity", (rod.velocity + theirs.velocity).abs());
            let fork = composed.angle(body("fork"), input);
            let fork = fork.plus(-1.0, &composed.angle(body("arm"), input));
            let swung = pusher.fork_angle(&theirs);
            near("fork's velocity", (fork.velocity - swung.velocity).abs());
        }
    }
    let carrier = composed.body_named("carrier").expect("there");
    let turned = composed.angle(carrier, 1.0).position;
    assert!((turned - (86.0_f64.to_radians() - 1.0)).abs() < 1e-12);
}

#[test]
fn the_cam_in_every_arm_is_that_of_the_family_of_its_own() {
    let composed = made("composed-three-arm");
    let design = ThreeArmDesign::from_toml(&text("three-arm-2021")).expect("a design");
    let family = ThreeArm::resolve(&design).expect("a mechanism");
    let pusher = family.pusher().expect("push rods");
    let theirs = pusher.cam().disc();
    let names: Vec<&str> = composed.cams().iter().map(|cam| &*cam.name).collect();
    assert_eq!(names, ["opener", "opener-2", "opener-3"]);
    // Their axes stand at an angle on the carrier; those of the composed cams, not mounted at one, along it.
    let (angle, sense) = (pusher.cam_angle(), theirs.rotation().sign());
    let carrier = composed.body_named("carrier").expect("there");
    for (arm, cam) in composed.cams().iter().enumerate() {
        let disc = cam.disc();
        assert_eq!(disc.rotation(), theirs.rotation());
        for i in 0..720 {
            let turn = 0.5_f64.to_radians() * f64::from(i);
            let point = theirs.contact(turn + sense * angle).point;
            let off = (disc.contact(turn).point - Rotation2::new(angle) * point).norm();
            assert!(off < 1e-9, "{arm} {turn}: {off}");
        }
        let radii = [cam.part.radii(), pusher.cam().radii()];
        assert!((radii[0].0 - radii[1].0).abs() < 1e-9);
        assert!((radii[0].1 - radii[1].1).abs() < 1e-9);
        // And each is touched by the roller of its fork all round.
        let end = if arm == 0 {
            String::new()
        } else {
            format!("-{}", arm + 1)
        };
        let roller = composed
            .point_named(&format!("fork{end}.roller"))
            .expect("there");
        for i in 0..180 {
            let input = 0.0351 * f64::from(i);
            let turned = composed.angle(carrier, input).position + cam.mount;
            let at = disc.contact(cam.turn(input).position).point;
            let touched =
                composed.place(carrier, cam.at, input) + Rotation2::new(turned) * at.coords;
            let far = (touched - composed.place(roller.body, roller.at, input)).norm();
            assert!((far - 4.0).abs() < 1e-10, "{arm} {input}: {far}");
        }
    }
}

#[test]
fn the_composed_transplanter_has_the_goals_of_the_family_of_its_own() {
    let composed = made("composed-three-arm");
    let design = ThreeArmDesign::from_toml(&text("three-arm-2021")).expect("a design");
    let theirs = ThreeArm::resolve(&design).expect("a mechanism").figures();
    let value = |words: &str, input: f64| {
        let figure = composed.figure("", words).expect("a figure");
        composed.value(&figure, input).expect("a value")
    };
    let own = |words: &str, degrees: f64| value(words, degrees.to_radians());
    let goal = |name: &str| &composed.design().goals[name];
    let at = |name: &str| goal(name).at.expect("an input").to_degrees();
    let picking = own("clamp.angle", at("picking"));
    let planting = own("clamp.angle", at("planting"));
    assert!(
        (picking - theirs.pick_angle).abs() < 1e-9,
        "{picking} {theirs:?}"
    );
    assert!(
        (planting + theirs.push_angle).abs() < 1e-9,
        "{planting} {theirs:?}"
    );
    let ends: Vec<f64> = (0..=60).map(|i| TAU * f64::from(i) / 60.0).collect();
    let [low, high] = extremes(|input| value("arm.tip.y", input), &ends);
    let height = high.value - low.value;
    assert!(
        (height - theirs.trajectory_height).abs() < 1e-9,
        "{height} {theirs:?}"
    );
}

/// Lines and arcs of an outline as a design has them, in axes turned back by an angle.
fn corners(outline: &Outline, turned: f64) -> String {
    let corner = |segment: &Segment| {
        let at = Rotation2::new(-turned) * segment.start();
        match segment {
            Segment::Arc(arc) => format!("[{:?}, {:?}, {:?}]", at.x, at.y, arc.bulge),
            _ => format!("[{:?}, {:?}]", at.x, at.y),
        }
    };
    let corners: Vec<String> = outline.segments().iter().map(corner).collect();
    format!("outline = [{}]", corners.join(", "))
}

#[test]
fn arms_of_the_composed_transplanter_keep_as_clear_of_each_other_as_those_of_the_family_of_its_own()
{
    let design = ThreeArmDesign::from_toml(&text("three-arm-2021")).expect("a design");
    let family = ThreeArm::resolve(&design).expect("a mechanism");
    let arm = family.arm_body().expect("an arm");
    let fine = Tolerance::new(2e-8).expect("positive");
    let theirs = between_arms(&family, &arm, fine).expect("determined");
    let theirs = theirs.expect("three arms");
    // Its x axis points to the tip.
    let outline = corners(arm.outline(), arm.tip().y.atan2(arm.tip().x));
    let drawn =
        text("composed-three-arm").replace("[bodies.arm]", &format!("[bodies.arm]\n{outline}"));
    let composed = MachineDesign::from_toml(&drawn).expect("a design");
    let composed = Machine::resolve(&composed).expect("a machine");
    let machine = composed.machine().expect("links");
    let clearance = |tolerance: Tolerance, inputs: [f64; 2]| {
        let ends = composed.clearance_ends("", ["arm", "arm-2"]);
        let ends = ends.expect("bodies");
        let pair = machine_clearance(&composed, &machine, ends, tolerance).expect("bodies");
        let pair = pair.expect("in one plane");
        pair.over(inputs).expect("determined")
    };
    let coarse = Tolerance::new(1e-5).expect("positive");
    let found = clearance(coarse, [0.0, TAU]);
    assert!(
        (found.minimum - theirs.minimum).abs() < coarse.mm(),
        "{found:?}"
    );
    let found = clearance(fine, [found.input - 0.01, found.input + 0.01]);
    assert!(
        (found.minimum - theirs.minimum).abs() < 1e-9,
        "{found:?} {theirs:?}"
    );
}

/// The polynomial of fifth degree from 0 to a rise over a span, with one rate at both ends and no acceleration, by Hermite's
/// basis in powers.
fn quintic(rise: f64, span: f64, rate: f64, at: f64) -> f64 {
    let (s, rest) = (at / span, rise - rate * span);
    rate * at + rest * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
}

#[test]
fn the_indexing_table_stands_still_and_turns_by_a_quarter_a_turn_of_the_shaft() {
    let index = made("index-table");
    let [hub, table, lever] =
        ["hub", "table", "lever"].map(|name| index.body_named(name).expect("there"));
    let [rise, dwell] = [PI / 6.0, PI / 3.0];
    let swing = |input: f64| {
        let at = input.rem_euclid(TAU);
        match at < dwell {
            true => 0.5 * at,
            false => rise + quintic(-rise, TAU - dwell, 0.5, at - dwell),
        }
    };
    let start = |body: usize| index.angle(body, 0.0).position;
    for i in 0..400 {
        let input = 0.0631 * f64::from(i);
        let turned = |body: usize| index.angle(body, input).position - start(body);
        let expected = input - 2.0 * swing(input);
        assert!(
            (turned(lever) - input - swing(input)).abs() < 1e-12,
            "{input}"
        );
        assert!((turned(hub) - expected).abs() < 1e-11, "{input}");
        assert!((turned(table) + 0.25 * expected).abs() < 1e-11, "{input}");
        if input.rem_euclid(TAU) < dwell - 1e-3 {
            let jet = index.angle(table, input);
            let size = jet
                .velocity
                .abs()
                .max(jet.acceleration.abs())
                .max(jet.jerk.abs());
            assert!(size < 1e-12, "{input}: {jet:?}");
        }
    }
    let whole = index.angle(table, index.period()).position - start(table);
    assert!((whole + TAU).abs() < 1e-11);
    let seat = index.point_named("table.seat").expect("a seat");
    let radius = index.place(seat.body, seat.at, 1.0) - index.place(table, Point::origin(), 1.0);
    assert!((Vector::norm(&radius) - 50.0).abs() < 1e-12);
}

#[test]
fn a_train_of_two_different_pairs_moves_as_its_closed_form() {
    let train = made("two-stage");
    let driven = |e: f64, x: f64| x + 2.0 * (e * x.sin()).atan2(1.0 - e * x.cos());
    let near = |found: f64, expected: f64| {
        let turns = (found - expected) / TAU;
        (turns - turns.round()).abs() * TAU < 1e-10
    };
    // Two centre distances of an ellipse's long axis each: from the perimeter that the teeth divide.
    let distances = ["first-wheel", "second-wheel"].map(|name| {
        let gear = train.gears().iter().find(|gear| gear.name == name);
        gear.expect("there").pair.center_distance()
    });
    for i in 0..60 {
        let input = 0.21 * f64::from(i) - 3.0;
        for (piece, name) in ["", "-2"].into_iter().enumerate() {
            let body = |of: &str| train.body_named(&format!("{of}{name}")).expect("there");
            let carrier = input + PI * piece as f64;
            let idler = carrier + driven(0.2, carrier - 40.0_f64.to_radians());
            let leg = carrier + 20.0_f64.to_radians();
            let planet = leg + driven(0.12, leg - idler - 30.0_f64.to_radians());
            assert!(near(train.angle(body("idler"), input).position, idler));
            assert!(near(train.angle(body("planet"), input).position, planet));
            let way = |angle: f64| Vector::new(angle.cos(), angle.sin());
            let axis = way(carrier) * distances[0] + way(leg) * distances[1];
            let tip = axis + way(planet + 15.0_f64.to_radians()) * 100.0;
            let found = train.place(body("arm"), Point::new(100.0, 0.0), input);
            assert!((found.coords - tip).norm() < 1e-9, "{name} {input}");
        }
    }
}
