use std::f64::consts::TAU;

use super::{made, read, refused};
use crate::machine::Machine;

const TWO_ARM: &str = include_str!("../../../../../tests/designs/two-arm.toml");
const PRESS: &str = include_str!("../../../../../tests/designs/press.toml");

#[test]
fn gears_mesh_where_they_are_carried() {
    let train = made(TWO_ARM);
    let machine = train.machine().expect("plates and gears");
    assert_eq!(machine.validate(), Ok(()));
    super::random::agrees(&train, &machine);
    assert_eq!(machine.meshes.len(), 4);
    for mesh in &machine.meshes {
        // The joint is that of one of the two, and its axis keeps the pair's distance.
        assert!(mesh.links.contains(&machine.joints[mesh.joint].child));
        let distance = train.gears()[0].pair.center_distance();
        for i in 0..9 {
            let frames = machine.pose(0.9 * f64::from(i));
            let [one, other] = mesh.links.map(|link| frames[link].point([0.0; 3]).position);
            assert!(((one - other).norm() - distance).abs() < 1e-10);
        }
    }
}

#[test]
fn pitch_curves_touch_and_roll_on_each_other() {
    let press = made(PRESS);
    let [pinion, wheel] = [0, 1].map(|gear: usize| &press.gears()[gear]);
    let bodies = ["shaft", "crank"].map(|name| press.body_named(name).expect("there"));
    let pair = &pinion.pair;
    for i in 0..40 {
        let input = 0.31 * f64::from(i);
        // The point of the pinion's curve on the line of centres is the wheel's, too, and both move in the same manner.
        let own = pair.rolling().driven_jet(input).velocity;
        let radius = pair.center_distance() * own / (1.0 + own);
        let contact = centrode_geometry::Point::new(radius, 0.0);
        let speeds = bodies.map(|body| {
            let origin = press.point(body, Default::default(), input);
            let turning = press.angle(body, input).velocity;
            let arm = contact - origin.point;
            centrode_geometry::Vector::new(-arm.y, arm.x) * turning
        });
        assert!((speeds[0] - speeds[1]).norm() < 1e-10, "{speeds:?}");
    }
    assert_eq!(
        (pinion.name.as_str(), wheel.name.as_str()),
        ("pinion", "wheel")
    );
}

#[test]
fn a_compound_gear_hands_its_turn_on_to_another_pair() {
    // Shaft to idler by an elliptic pair, idler to wheel by a round pair of 1 to 2: two turns of the shaft a cycle.
    let text = PRESS
        .replace("speed_rpm = 60", "speed_rpm = 60\nturns = 2")
        .replace(
            "[dyads.ram]",
            r#"[pairs.round]
pitch = { kind = "circle", module = 2, tooth_count = 20 }
mean_ratio = [2, 1]
[gears.small]
pair = "round"
role = "driver"
on = "crank"
mount_deg = 7
[gears.big]
pair = "round"
role = "driven"
on = "drum"
mount_deg = 3
[bodies.drum]
on = "frame"
mesh = { gear = "big", with = "small", direction_deg = 120 }
[dyads.ram]"#,
        );
    let train = made(&text);
    let [crank, drum] = ["crank", "drum"].map(|name| train.body_named(name).expect("there"));
    for i in -5..30 {
        let input = 0.7 * f64::from(i);
        let jets = [crank, drum].map(|body| train.angle(body, input));
        assert!((jets[1].velocity + 0.5 * jets[0].velocity).abs() < 1e-12);
        assert!((jets[1].jerk + 0.5 * jets[0].jerk).abs() < 1e-10);
    }
    let turned = train.angle(drum, 2.0 * TAU).position - train.angle(drum, 0.0).position;
    assert!((turned + TAU).abs() < 1e-12);
    let short = text.replace("turns = 2", "turns = 1");
    let stated = "bodies.drum.mesh: turns body drum by -0.5 turns relative to frame in the period of 1 turns";
    let found = refused(&short);
    assert!(found.contains(stated), "{found}");
}

#[test]
fn a_loop_of_meshes_closes_or_is_refused_with_its_gears_and_the_mismatch() {
    let looped = |mount: f64| {
        TWO_ARM.replace(
            "[plates]",
            &format!(
                "spare = {{ pair = \"stage\", role = \"driven\", on = \"idler-1\", mount_deg = {mount} }}\n[meshes.loop]\ngears = [\"spare\", \"sun\"]\n[plates]"
            ),
        )
    };
    let closed = Machine::resolve(&read(&looped(0.0)));
    assert!(closed.is_ok(), "{closed:?}");
    let found = refused(&looped(10.0));
    let stated = "meshes.loop: the loop of meshes does not close: the other meshes hold gears sun and spare 10.000000 deg off";
    assert!(found.contains(stated), "{found}");
}

/// Four equal gears with their axes on a rhomb of this angle, deg, of a pitch curve.
fn rhomb(pitch: &str, degrees: f64) -> String {
    let next = |name: &str, role: &str, with: &str, direction: f64| {
        format!(
            "[gears.{name}]\npair = \"round\"\nrole = \"{role}\"\non = \"{name}-body\"\n[bodies.{name}-body]\non = \"frame\"\nmesh = {{ gear = \"{name}\", with = \"{with}\", direction_deg = {direction} }}\n"
        )
    };
    format!(
        "family = \"machine\"\n[frame.points]\nA = [0, 0]\n[pairs.round]\npitch = {pitch}\n[gears.a]\npair = \"round\"\nrole = \"driver\"\non = \"a-body\"\n[bodies.a-body]\non = \"frame.A\"\nlaw = {{ ratio = 1 }}\n{}{}{}[meshes.close]\ngears = [\"a\", \"d\"]\n",
        next("b", "driven", "a", 0.0),
        next("c", "driver", "b", degrees),
        next("d", "driven", "c", 180.0),
    )
}

/// With lambda the directions along the sides, teeth meet spaces at each if the sum of the two gears' phases there is the same,
/// so that a loop of four is off by twice the sum of the directions with alternating signs: four times its angle, up to pitches.
#[test]
fn a_loop_of_round_gears_may_be_off_by_whole_pitches() {
    for (teeth, degrees) in [
        (20, 72.0),
        (20, 76.5),
        (20, 67.5),
        (20, 90.0),
        (20, 81.0),
        (20, 108.0),
        (24, 75.0),
        (24, 63.75),
        (25, 72.0),
        (31, 90.0 - 90.0 / 31.0 / 2.0),
        (20, 70.0),
        (20, 72.3),
        (20, 74.25),
        (24, 72.0),
        (25, 75.0),
        (31, 90.0),
    ] {
        let pitch = format!("{{ kind = \"circle\", module = 2, tooth_count = {teeth} }}");
        let text = rhomb(&pitch, degrees);
        let part = 360.0 / f64::from(teeth);
        let off = 4.0 * degrees / part;
        let off = (off - off.round()).abs() * part;
        if off < 1e-9 {
            let made = Machine::resolve(&read(&text));
            assert!(made.is_ok(), "{teeth} {degrees}: {made:?}");
        } else {
            let found = refused(&text);
            let stated = format!("gears a and d {off:.6} deg off their mesh");
            assert!(found.contains(&stated), "{teeth} {degrees}: {found}");
        }
    }
}

/// A gear that repeats after part of a turn only meshes there, not a pitch farther.
#[test]
fn a_loop_of_lobed_gears_may_be_off_by_whole_lobes_only() {
    let ellipse = "{ kind = \"ellipse\", eccentricity = 0.3, module = 2, tooth_count = 23 }";
    let lobed = |lobes: u32, teeth: u32| {
        format!(
            "{{ kind = \"lobed-ellipse\", lobes = {lobes}, eccentricity = 0.1, module = 2, tooth_count = {teeth} }}"
        )
    };
    for (pitch, parts, teeth) in [
        (ellipse.to_owned(), 1, 23),
        (lobed(2, 40), 2, 40),
        (lobed(2, 24), 2, 24),
        (lobed(3, 30), 3, 30),
        (lobed(3, 31), 1, 31),
        (lobed(4, 48), 4, 48),
    ] {
        // The last gear turned on its body by whole pitches, and by a part of one.
        let with = |mount: f64| {
            let text = rhomb(&pitch, 60.0).replace(
                "[meshes.close]\ngears = [\"a\", \"d\"]",
                &format!(
                    "[gears.e]\npair = \"round\"\nrole = \"driven\"\non = \"b-body\"\nmount_deg = {mount}\n[meshes.close]\ngears = [\"a\", \"e\"]"
                ),
            );
            Machine::resolve(&read(&text))
        };
        let pitches = 360.0 / f64::from(teeth);
        for part in -parts..=parts {
            let turned = 360.0 * f64::from(part) / f64::from(parts);
            let made = with(turned);
            assert!(made.is_ok(), "{pitch} {turned}: {made:?}");
            for more in [pitches, 0.5 * pitches, 1e-3] {
                assert!(with(turned + more).is_err(), "{pitch} {turned} {more}");
            }
        }
    }
}

#[test]
fn bad_gears_are_told_by_their_key() {
    for (from, to, stated) in [
        (
            "with = \"pinion\"",
            "with = \"pinon\"",
            "bodies.crank.mesh.with: there is no gear \"pinon\"; there are pinion, wheel",
        ),
        (
            "pair = \"drive\"\nrole = \"driver\"",
            "pair = \"drift\"\nrole = \"driver\"",
            "gears.pinion.pair: there is no pair \"drift\"; there are drive",
        ),
        (
            "role = \"driven\"",
            "role = \"driver\"",
            "bodies.crank.mesh: wheel is the driver of drive and pinion is the driver of drive: only",
        ),
        ("eccentricity = 0.3", "eccentricity = 1.3", "pairs.drive."),
        (
            "on = \"crank\"",
            "on = \"rod\"",
            "bodies.crank.mesh: gear wheel must be at the origin of body crank",
        ),
        (
            "law = { ratio = -1 }",
            "mesh = { gear = \"pinion\", with = \"wheel\", direction_deg = 0 }",
            "depend on each other",
        ),
        (
            "on = \"frame\"\nmesh",
            "on = \"rod\"\nmesh",
            "depend on each other",
        ),
        (
            "direction_deg = 0 }",
            "direction_deg = 0 }\nlaw = { ratio = 1 }",
            "bodies.crank.law: cannot be given together with mesh",
        ),
    ] {
        let text = PRESS.replacen(from, to, 1);
        assert_ne!(text, PRESS, "{from}");
        let found = refused(&text);
        assert!(found.contains(stated), "{to}\n  {found}\n  {stated}");
    }
    // A gear that swings on what should carry its axis.
    let text = PRESS.replace("on = \"frame\"\nmesh", "on = \"slider\"\nmesh").replace(
        "[pairs.drive]",
        "[bodies.slider]\non = \"frame.O\"\nslides_deg = 90\nlaw = { expression = \"sin(phi)\" }\n[pairs.drive]",
    );
    let found = refused(&text);
    assert!(
        found.contains(
            "the axis of gear pinion must be fixed on body slider, but moves relative to it"
        ),
        "{found}"
    );
}

#[test]
fn laws_that_are_kept_are_those_of_the_design() {
    // A whole circle of one planet's angle, bit by bit.
    let motion = |text: &str| {
        let train = made(text);
        let planet = train.body_named("planet-1").expect("there");
        let at = |i: u32| train.angle(planet, 0.7 * f64::from(i)).position.to_bits();
        (0..10).map(at).collect::<Vec<u64>>()
    };
    let first = motion(TWO_ARM);
    let moved = TWO_ARM.replace("turned_deg = -29", "turned_deg = -28");
    assert_eq!(motion(&moved), first);
    for (old, new) in [
        ("ratio = 1", "ratio = -1"),
        ("ratio = 1", "ratio = 1, start_deg = 3"),
        ("mount_deg = 86", "mount_deg = 87"),
        ("direction_deg = 0", "direction_deg = 1"),
        ("direction_deg = 20", "direction_deg = 21"),
        ("eccentricity = 0.2", "eccentricity = 0.21"),
        ("on = \"planet-1\" }", "on = \"planet-1\", mount_deg = 5 }"),
    ] {
        let text = TWO_ARM.replacen(old, new, 1);
        assert_ne!(text, TWO_ARM, "{old}");
        let other = motion(&text);
        assert_ne!(other, first, "{new}");
        assert_eq!(motion(&text), other, "{new}");
    }
    assert_eq!(motion(TWO_ARM), first);
}

#[test]
fn a_gear_meets_the_gears_of_its_meshes_alone() {
    let machine = made(TWO_ARM);
    let mates = |gear: &str| -> Vec<&str> {
        let mates = machine.mates(gear).into_iter();
        mates.map(|mate| mate.name.as_str()).collect()
    };
    assert_eq!(mates("sun"), ["idler-gear-1", "idler-gear-2"]);
    assert_eq!(mates("planet-gear-1"), ["idler-gear-1"]);
    assert_eq!(mates("idler-gear-2"), ["planet-gear-2", "sun"]);
    let carrier = machine.body_named("carrier").expect("a carrier");
    assert_eq!(machine.carried_pairs(carrier).len(), 4);
    assert!(machine.carried_pairs(0).is_empty());
}

#[test]
fn a_tooth_runs_in_the_space_of_which_the_note_tells() {
    use centrode_gear::Member;

    for design in [TWO_ARM, PRESS] {
        let machine = made(design);
        let middle = |gear: &crate::machine::MachineGear, pitches: f64, input: f64| {
            let (pair, rolling) = (&gear.pair, gear.pair.rolling());
            let own = match gear.member {
                Member::Driver => 0.0,
                Member::Driven => 0.5,
            };
            let pitch = gear.gear().pitch_length() / f64::from(gear.gear().tooth_count());
            let arc = (pitches + pair.phase() + own) * pitch;
            let frame = rolling.frame(gear.member, rolling.parameter(arc));
            let turned = nalgebra::Rotation2::new(gear.mount) * frame.point;
            let body = machine.body_named(&gear.body_name).expect("a body");
            machine.point(body, gear.at + turned.coords, input).point
        };
        let notes = machine.machine().expect("a machine").arrangement.notes;
        for mesh in &machine.meshes {
            let mut both = mesh.gears.map(|gear| &machine.gears()[gear]);
            both.sort_by_key(|gear| gear.member == Member::Driven);
            let [driver, driven] = both;
            let stated = format!(
                "Tooth k of {} runs in space k - 1 of {}",
                driver.name, driven.name
            );
            assert!(
                notes.iter().any(|note| note.starts_with(&stated)),
                "{stated}: {notes:?}"
            );
            let teeth = driver.gear().tooth_count();
            for input in [0.0, 0.7, 3.1] {
                // The tooth that is deepest in a space.
                let off = |tooth: u32| {
                    let tooth = f64::from(tooth);
                    let at = middle(driver, tooth, input);
                    (at - middle(driven, tooth - 1.0 + 0.5, input)).norm()
                };
                let nearest = (0..teeth).map(off).fold(f64::INFINITY, f64::min);
                assert!(
                    nearest < 0.2 * driver.pair.module(),
                    "{stated} at {input}: {nearest}"
                );
            }
        }
    }
}

#[test]
fn pins_have_a_diameter() {
    let bare = PRESS.replace("pin_diameter = 6", "pin_diameter = 0");
    let stated = refused(&bare);
    assert!(stated.contains("plates.pin_diameter"), "{stated}");
    assert!(stated.contains("must be greater than 0"), "{stated}");
}

#[test]
fn what_no_shaft_of_the_machine_drives_or_holds_is_told() {
    let remark = |design: &str, name: &str| {
        let machine = made(design).machine().expect("a machine");
        let part = machine.parts.iter().find(|part| part.name == name);
        part.map(|part| part.remark.clone()).expect("in the list")
    };
    assert_eq!(remark(TWO_ARM, "Drive of carrier"), "turns it on frame");
    let role = |design: &str, title: &str| {
        let machine = made(design);
        let mut turned = machine.turned().iter();
        let own = turned.find(|pieces| pieces.part.title == title);
        own.map(|pieces| pieces.role.clone()).expect("a shaft")
    };
    assert_eq!(role(TWO_ARM, "Shaft of sun"), "fixed in the frame");
    assert_eq!(role(PRESS, "Shaft of pinion"), "driven at its free end");
    assert_eq!(remark(PRESS, "rod"), "");
}
