//! The published machines written as composed ones: motions and figures of the special families, which share no code with the
//! composition.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use centrode_analysis::{Goal, Report, check_feeder, check_machine};
use centrode_groove::{MovingBox, MovingBoxDesign};
use centrode_kinematics::transmission::MotionJet;
use centrode_machines::feeder::{Feeder, FeederDesign};
use centrode_machines::machine::{Machine, MachineDesign};
use centrode_spec::DesignSpec;

const SAMPLES: u32 = 500;

fn design<D: DesignSpec>(name: &str) -> D {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let text = fs::read_to_string(folder.join(name)).expect("a shipped design");
    D::from_toml(&text).expect("a design")
}

fn composed(name: &str) -> Machine {
    Machine::resolve(&design::<MachineDesign>(name)).expect("a machine")
}

/// Two motions but for whole turns, each derivative of its own size.
fn same(one: &MotionJet, other: &MotionJet, size: [f64; 4], about: &str) {
    let turned = ((one.position - other.position) / TAU).round() * TAU;
    let pairs = [
        (one.position - turned, other.position),
        (one.velocity, other.velocity),
        (one.acceleration, other.acceleration),
        (one.jerk, other.jerk),
    ];
    for ((a, b), size) in pairs.into_iter().zip(size) {
        assert!((a - b).abs() < 1e-9 * size, "{about}: {one:?} {other:?}");
    }
}

fn goal<'a>(report: &'a Report, title: &str) -> &'a Goal {
    let found = report.goals.iter().find(|goal| goal.title == title);
    found.unwrap_or_else(|| panic!("no goal {title}"))
}

#[test]
fn a_composed_feeder_moves_as_the_feeder_does() {
    let whole = Feeder::resolve(&design::<FeederDesign>("feeder-2022.toml")).expect("a feeder");
    let made = composed("composed-feeder.toml");
    assert!((made.speed() - whole.speed()).abs() < 1e-12);
    let body = |name: &str| made.body_named(name).expect(name);
    let tip = made.point_named("effector.tip").expect("a tip");
    for i in 0..SAMPLES {
        let input = TAU * f64::from(i) / f64::from(SAMPLES);
        let (crank, effector) = (whole.crank(input), whole.effector(input));
        let size = [1.0, 1.0, 10.0, 100.0];
        same(&made.angle(body("crank"), input), &crank, size, "crank");
        let found = made.angle(body("effector"), input);
        same(&found, &effector, [1.0, 10.0, 1e3, 1e5], "effector");
        let place = made.place(tip.body, tip.at, input);
        assert!(
            (place - whole.tip(input)).norm() < 1e-9 * 200.0,
            "tip at {input}"
        );
        let speed = made.point(tip.body, tip.at, input).first.norm() * made.speed();
        assert!(
            (speed - whole.tip_speed(input)).abs() < 1e-9 * 2e3,
            "speed at {input}"
        );
    }
    let (own, of_family) = (check_machine(&made), check_feeder(&whole));
    for (one, other) in [
        ("swing: span of effector.swing", "swing of the effector"),
        (
            "transmission: minimum transmission(four-bar)",
            "minimum transmission angle",
        ),
    ] {
        let (one, other) = (goal(&own, one), goal(&of_family, other));
        let [a, b] = [one.value, other.value].map(|value| value.expect("a value"));
        assert!((a - b).abs() < 1e-9, "{}: {a} {b}", one.title);
        assert_eq!(one.met(), other.met());
    }
}

#[test]
fn a_composed_box_moves_as_the_moving_box_does() {
    let whole = design::<MovingBoxDesign>("moving-box-2018.toml");
    let whole = MovingBox::resolve(&whole).expect("a moving box");
    let made = composed("composed-box.toml");
    let travel = made.figure("", "box.travel").expect("a figure");
    let middle = made.point_named("box.middle").expect("a point");
    let shaft = made.body_named("shaft").expect("a shaft");
    assert!((made.period() - whole.motion().period()).abs() < 1e-12);
    for i in 0..SAMPLES {
        let input = made.period() * (f64::from(i) + 0.37) / f64::from(SAMPLES);
        let turn = whole.shaft_turn(input);
        same(
            &made.angle(shaft, input),
            &turn,
            [100.0, 1.0, 10.0, 100.0],
            "shaft",
        );
        let motion = whole.motion().at(input);
        let found = made.point(middle.body, middle.at, input);
        let at = made.value(&travel, input).expect("a place");
        for (a, b, size) in [
            (at, motion.position, 270.0),
            (found.point.x, motion.position, 270.0),
            (found.first.x, motion.velocity, 10.0),
            (found.second.x, motion.acceleration, 100.0),
            (found.third.x, motion.jerk, 1e3),
        ] {
            assert!((a - b).abs() < 1e-9 * size, "at {input}: {a} {b}");
        }
    }
    let report = check_machine(&made);
    let moved = goal(&report, "moved: span of box.travel")
        .value
        .expect("a value");
    assert!((moved - whole.moved_in_window()).abs() < 1e-9, "{moved}");
}
