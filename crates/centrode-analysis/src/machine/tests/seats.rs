//! Forces of trains whose gears stand next to their bodies' origins, and of copied loads.

use super::*;
use crate::forces::{Balance, Forces};

const PAIR: &str = r#"
[pairs.stage]
pitch = { kind = "ellipse", eccentricity = 0.2, module = 2.5, tooth_count = 23 }
teeth = { backlash = 0.05 }
driver = { width = 10, bore = 12 }
driven = { width = 10, bore = 12 }
"#;

fn balance(text: &str) -> (Machine, Balance) {
    let made = composed(text);
    let machine = made.machine().expect("plates and gears");
    (made, Balance::new(machine).expect("forces"))
}

fn forces(text: &str) -> impl Fn(f64) -> Forces + use<> {
    let (made, balance) = balance(text);
    move |input| balance.at(input, made.speed()).expect("it turns")
}

/// A sun that is fixed at a position of the frame, a carrier about it, an idler and a planet with a torque.
fn train([x, y]: [f64; 2], speed_rpm: f64) -> String {
    format!(
        r#"family = "machine"
[input]
speed_rpm = {speed_rpm}
[frame.points]
O = [{x}, {y}]
[bodies.carrier]
on = "frame.O"
law = {{ ratio = 1 }}
[bodies.idler]
on = "carrier"
mesh = {{ gear = "idler-gear", with = "sun", direction_deg = 0 }}
[bodies.planet]
on = "carrier"
mesh = {{ gear = "planet-gear", with = "idler-gear", direction_deg = 20 }}
points = {{ tip = [60, 10] }}
[gears]
sun = {{ pair = "stage", role = "driver", on = "frame.O", mount_deg = 86 }}
idler-gear = {{ pair = "stage", role = "driven", on = "idler" }}
planet-gear = {{ pair = "stage", role = "driver", on = "planet" }}
{PAIR}
[loads.soil]
on = "planet.tip"
force = [-30, 12]
"#
    )
}

#[test]
fn forces_of_a_train_do_not_depend_on_where_its_sun_stands_on_the_frame() {
    let middle = forces(&train([0.0, 0.0], 60.0));
    for place in [[100.0, 40.0], [-300.0, 5.0]] {
        let aside = forces(&train(place, 60.0));
        for i in 0..40 {
            let input = 0.17 * f64::from(i);
            let (one, other) = (middle(input), aside(input));
            assert!((one.input_torque - other.input_torque).abs() < 1e-7);
            let sides = one.joints.iter().zip(&other.joints);
            for (a, b) in sides {
                let [a, b] = [a, b].map(|joint| joint.reaction.expect("known").force);
                assert!((a - b).norm() < 1e-8, "{input}: {a} {b}");
            }
            assert_eq!(other.meshes.len(), 2);
            for (a, b) in one.meshes.iter().zip(&other.meshes) {
                let [a, b] = [a, b].map(|mesh| mesh.normal.expect("known"));
                assert!((a - b).abs() < 1e-8, "{input}: {a} {b}");
            }
        }
    }
}

#[test]
fn teeth_beside_the_origins_of_their_bodies_do_the_work_of_the_load() {
    // Held still, a sun at a point of a crank that turns; its carrier turns on that point, too.
    let hub = "[bodies.hub]\nfixed_to = \"crank.A\"\nplate = false\n";
    let text = |hub: &str, seat: &str| {
        format!(
            r#"family = "machine"
[frame.points]
O = [20, -35]
[bodies.crank]
on = "frame.O"
law = {{ ratio = 1 }}
points = {{ A = [70, 15] }}
{hub}
[bodies.carrier]
on = "crank.A"
law = {{ expression = "-2*phi + 0.3*sin(phi)" }}
[bodies.planet]
on = "carrier"
mesh = {{ gear = "wheel", with = "sun", direction_deg = 30 }}
[gears]
sun = {{ pair = "stage", role = "driver", on = "{seat}", mount_deg = 12 }}
wheel = {{ pair = "stage", role = "driven", on = "planet" }}
{PAIR}
[loads.brake]
on = "planet"
torque = -500
"#
        )
    };
    let (made, aside) = balance(&text("", "crank.A"));
    let (_, centred) = balance(&text(hub, "hub"));
    let [planet, carrier] = ["planet", "carrier"].map(|name| made.body_named(name).expect(name));
    let mut either = [false; 2];
    for i in 0..60 {
        let input = 0.11 * f64::from(i);
        let found = aside.at(input, 0.0).expect("it turns");
        let turned = |body: usize| made.angle(body, input).velocity;
        let work = 500.0 * turned(planet);
        assert!((found.input_torque - work).abs() < 1e-9 * 5000.0, "{input}");
        let mesh = found.meshes[0];
        // Cut at the teeth, their force moves the planet against the crank as much as the load does.
        let origin = made.place(planet, Default::default(), input);
        let arm = mesh.at.xy() - origin.coords;
        assert!((arm.perp(&mesh.force.xy()) - 500.0).abs() < 1e-8, "{input}");
        // A body without mass between tooth and bearing: the carrier's drive is the bearing's force at the planet's axis.
        let bearing = found.joints[planet - 1].reaction.expect("known").force.xy();
        let at = made.place(carrier, Default::default(), input);
        let torque = (origin - at).perp(&bearing);
        assert!((found.joints[carrier - 1].drive - torque).abs() < 1e-8);
        assert!((bearing + mesh.force.xy()).norm() < 1e-9);
        // Teeth push gears apart.
        let [apart, along] = [origin - at, mesh.force.xy()];
        assert!(apart.dot(&along) > 0.0, "{input}");
        let known = centred.at(input, 0.0).expect("it turns").meshes[0];
        assert!((known.force - mesh.force).norm() < 1e-9, "{input}");
        assert!((known.normal.expect("known") - mesh.normal.expect("known")).abs() < 1e-9);
        either[usize::from(mesh.normal.expect("known") > 0.0)] = true;
    }
    assert_eq!(either, [false, true]);
}

#[test]
fn loads_on_a_copied_arm_are_those_of_one_written_out_by_hand() {
    let start = TWO_ARM.split_once("[bodies.idler-2]").expect("two arms").0;
    let end = TWO_ARM.split_once("[pairs.stage]").expect("pairs").1;
    let gears = end.lines().filter(|line| !line.contains("gear-2 ="));
    let end = gears.collect::<Vec<_>>().join("\n");
    let load = |name: &str, arm: &str, rest: &str| {
        format!("[loads.{name}]\non = \"{arm}.tip\"\nforce = [-20, 35]\ntorque = 90\n{rest}\n")
    };
    let soil = [
        ("always", "", ""),
        ("turning", "axes = \"body\"", "axes = \"body\""),
        // Half a turn of the carrier later.
        (
            "wave",
            "expression = \"1 + sin(phi)\"",
            "expression = \"1 - sin(phi)\"",
        ),
        ("arc", "over_deg = [200, 260]", "over_deg = [20, 80]"),
    ];
    for (name, own, later) in soil {
        let first = load(name, "arm-1", own);
        let copies = "[copies.arms]\nbodies = [\"idler-1\", \"planet-1\", \"arm-1\"]\ncount = 2\nabout = \"carrier\"";
        let copied = forces(&format!("{start}{first}{copies}\n[pairs.stage]{end}\n"));
        let hand = forces(&format!(
            "{TWO_ARM}{first}{}",
            load("later", "arm-2", later)
        ));
        let alone = forces(&format!("{TWO_ARM}{first}"));
        // Arms next to each other have shafts of other lengths than one and its copy: the loads are what is left.
        let bare = [
            forces(&format!("{start}{copies}\n[pairs.stage]{end}\n")),
            forces(TWO_ARM),
        ];
        let mut more = 0.0_f64;
        for i in 0..50 {
            let input = 0.131 * f64::from(i) - 0.05;
            let torque = |forces: &dyn Fn(f64) -> Forces| forces(input).input_torque;
            let copied = torque(&copied) - torque(&bare[0]);
            let [hand, alone] = [torque(&hand), torque(&alone)].map(|one| one - torque(&bare[1]));
            assert!(
                (copied - hand).abs() < 1e-6,
                "{name} {input}: {copied} {hand}"
            );
            more = more.max((hand - alone).abs());
        }
        assert!(more > 100.0, "{name}: {more}");
    }
}

const TWO_ARM: &str = include_str!("../../../../../tests/designs/two-arm.toml");

/// A slider-crank next to the middle of the frame, with a load on its ram. Layers are written, so that the pins of copies are as long
/// as its own.
const BESIDE: &str = r#"family = "machine"
[input]
speed_rpm = 90
[frame.points]
O = [80, 20]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [30, 0] }
layer = 0
[bodies.rod]
layer = 1
[bodies.ram]
points = { tool = [12, 5] }
layer = 2
[dyads.push]
type = "RRP"
from = "crank.A"
lengths = [100]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"
[loads.work]
on = "ram.tool"
force = [-150, 40]
over_deg = [190, 350]
expression = "1 + 0.2*cos(phi)"
"#;

#[test]
fn copies_about_the_frame_have_their_loads_turned_with_them() {
    let one = forces(BESIDE);
    let copies = "[copies.all]\nbodies = [\"crank\", \"rod\", \"ram\"]\ncount = 3\n";
    let three = forces(&format!("{BESIDE}{copies}"));
    let mut maximum = 0.0_f64;
    for i in 0..60 {
        let input = 0.1 * f64::from(i);
        let [one, three] = [one(input), three(input)];
        maximum = maximum.max(one.input_torque.abs());
        assert!(
            (three.input_torque - 3.0 * one.input_torque).abs() < 1e-7,
            "{input}"
        );
        let force = one.joints[0].reaction.expect("known").force.norm();
        let alike = three.joints.iter().filter(|joint| {
            let own = joint.reaction.expect("known").force.norm();
            (own - force).abs() < 1e-8 * force
        });
        assert!(alike.count() >= 3, "{input}");
    }
    assert!(maximum > 1000.0, "{maximum}");
}

#[test]
fn a_changing_load_has_no_copies_about_a_body_that_turns_unevenly() {
    let text = |rest: &str| {
        format!(
            "family = \"machine\"\n[frame.points]\nO = [0, 0]\n[bodies.table]\non = \"frame.O\"\n\
             law = {{ expression = \"phi + 0.2*sin(phi)\" }}\npoints = {{ P = [60, 0] }}\n\
             [bodies.seat]\non = \"table.P\"\nlaw = {{ start_deg = 12 }}\n\
             [copies.all]\nbodies = [\"seat\"]\ncount = 3\nabout = \"table\"\n\
             [loads.work]\non = \"seat\"\nforce = [3, 4]\n{rest}\n"
        )
    };
    assert_eq!(composed(&text("")).whole().loads.len(), 3);
    let design = MachineDesign::from_toml(&text("over_deg = [0, 90]")).expect("a design");
    let error = Machine::resolve(&design).expect_err("uneven");
    assert_eq!(error.key(), "loads.work");
    assert!(
        error
            .to_string()
            .contains("load work, which changes with the input, cannot be copied"),
        "{error}"
    );
}
