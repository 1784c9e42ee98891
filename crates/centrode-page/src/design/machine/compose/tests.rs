use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_families::FAMILIES;
use centrode_machines::machine::Machine;
use serde_json::json;

use super::*;
use crate::design::kind::tests::designs;

/// Shipped designs of composed machines, by name.
fn machines() -> Vec<(String, String)> {
    let mut all = designs();
    all.retain(|(_, text)| text.contains("family = \"machine\""));
    all.sort();
    assert!(all.len() > 8);
    all
}

fn machine(text: &str) -> Arc<Machine> {
    let file = FAMILIES.read(text.as_bytes()).expect("a design");
    let made = file
        .mechanism()
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    made.downcast().expect("a machine")
}

fn gesture(value: Json) -> Gesture {
    serde_json::from_value(value).expect("a gesture")
}

fn made(text: &str, input: f64, value: Json) -> Composed {
    let done = composed(text, input, &gesture(value.clone()));
    done.unwrap_or_else(|refusal| panic!("{value}: {}\n{text}", refusal.refused))
}

fn refused(text: &str, value: Json) -> Refusal {
    *composed(text, 0.0, &gesture(value)).expect_err("refused")
}

/// Positions of a point over a turn.
fn path(text: &str, point: &str) -> Vec<[f64; 2]> {
    let machine = machine(text);
    let at = machine.point_named(point).expect("a point");
    let inputs = (0..36).map(|i| TAU * f64::from(i) / 36.0);
    let places = inputs.map(|input| machine.place(at.body, at.at, input).coords.into());
    places.collect()
}

#[test]
fn jansens_leg_is_composed_from_an_empty_machine_with_its_published_lengths() {
    let pin = |x: f64, y: f64| json!({ "body": "frame", "at": [x, y] });
    let crank = json!({ "part": "body", "on": pin(0.0, 0.0), "length": 15, "angle_deg": 0 });
    let text = made(EMPTY_MACHINE, 0.0, crank).text;
    let text = made(
        &text,
        0.0,
        json!({ "part": "point", "on": "frame", "x": -38, "y": -7.8 }),
    )
    .text;
    let bars = |from: &str, to: &str, lengths: [f64; 2], side: &str| json!({ "part": "bars", "from": from, "to": to, "lengths": lengths, "side": side });
    let text = made(
        &text,
        0.0,
        bars("crank.A", "frame.P", [50.0, 41.5], "right"),
    )
    .text;
    let text = made(&text, 0.0, bars("crank.A", "frame.P", [61.9, 39.3], "left")).text;
    let corner = |from: &str, to: &str, lengths: [f64; 2]| json!({ "part": "corner", "from": from, "to": to, "lengths": lengths, "side": "left" });
    let text = made(&text, 0.0, corner("frame.P", "rod.B", [40.1, 55.8])).text;
    let text = made(
        &text,
        0.0,
        bars("rocker.D", "rod2.C", [39.4, 36.7], "right"),
    )
    .text;
    let text = made(&text, 0.0, corner("rod2.C", "rod3.E", [49.0, 65.7])).text;
    let (_, shipped) = machines()
        .into_iter()
        .find(|(name, _)| name.contains("jansen"))
        .expect("shipped");
    let (own, other) = (path(&text, "rocker3.F"), path(&shipped, "shin.foot"));
    for (a, b) in own.iter().zip(&other) {
        assert!(
            (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9,
            "{a:?} {b:?}\n{text}"
        );
    }
}

#[test]
fn a_new_part_closes_where_it_was_clicked_at_the_input_shown() {
    let crank =
        json!({ "part": "body", "on": { "body": "frame", "at": [3.0, 4.0] }, "at": [23.7, 9.1] });
    let first = made(EMPTY_MACHINE, 0.0, crank);
    let input = 1.234;
    let to = json!({ "body": "frame", "at": [80.0, -10.0] });
    for (at, side) in [([61.0, 55.0], "left"), ([45.0, -70.0], "right")] {
        let part = json!({ "part": "bars", "from": "crank.A", "to": to, "at": at });
        let bars = made(&first.text, input, part);
        assert_eq!(bars.numbers["side"], side);
        let machine = machine(&bars.text);
        let joint = machine.point_named("rod.B").expect("the joint");
        let now = machine.place(joint.body, joint.at, input);
        assert!(
            (now - centrode_geometry::Point::from(at)).norm() < 1e-3,
            "{now}"
        );
        assert!(
            (bars.lines[0][1][0] - at[0]).abs() < 1e-3,
            "{:?}",
            bars.lines
        );
        let other = bars.other.expect("another solution").lines[0][1];
        assert!((other[0] - at[0]).hypot(other[1] - at[1]) > 1.0);
    }
    let line = json!({ "body": "frame", "at": [0.0, -30.0] });
    let part = json!({ "part": "slider", "from": "crank.A", "line": line, "at": [110.0, -35.0] });
    let slide = made(&first.text, input, part);
    let machine = machine(&slide.text);
    let joint = machine.point_named("slider.B").expect("the joint");
    let now = machine.place(joint.body, joint.at, input);
    assert!(
        (now - centrode_geometry::Point::new(110.0, -35.0)).norm() < 1e-3,
        "{now}"
    );
}

#[test]
fn lengths_that_do_not_close_are_refused_with_the_nearest_that_do() {
    let crank = json!({ "part": "body", "on": { "body": "frame", "at": [0, 0] }, "length": 30, "angle_deg": 0 });
    let text = made(EMPTY_MACHINE, 0.0, crank).text;
    let to = json!({ "body": "frame", "at": [100, 0] });
    let bars = |lengths: [f64; 2]| json!({ "part": "bars", "from": "crank.A", "to": to, "lengths": lengths, "side": "left" });
    let refusal = refused(&text, bars([40.0, 50.0]));
    let nearest = refusal.nearest.expect("nearest lengths");
    let [one, other] = ["length", "length2"].map(|key| nearest[key].as_f64().expect("a length"));
    assert!(one + other > 130.0 && one + other < 133.0 && (other - one - 10.0).abs() < 1e-3);
    made(&text, 0.0, bars([one, other]));
    let line = json!({ "body": "frame", "at": [0, 50] });
    let slider = |length: f64| json!({ "part": "slider", "from": "crank.A", "line": line, "length": length, "angle_deg": 0 });
    let refusal = refused(&text, slider(60.0));
    let long = refusal.nearest.expect("a nearest length")["length"].clone();
    assert!(
        long.as_f64().is_some_and(|long| long > 80.0 && long < 82.0),
        "{long}"
    );
    made(&text, 0.0, slider(long.as_f64().expect("a number")));
}

#[test]
fn a_press_with_an_elliptic_pair_and_a_cam_driven_lever_are_composed() {
    let shaft = json!({ "part": "body", "on": { "body": "frame", "at": [0, 0] }, "length": 20, "angle_deg": 90 });
    let text = made(EMPTY_MACHINE, 0.0, shaft).text;
    let gears = json!({ "part": "gears", "on": "crank", "at": [60.0, 1.0], "curve": "ellipse", "eccentricity": 0.3 });
    let pair = made(&text, 0.0, gears);
    // A module of the series, and axes nearly where they were clicked.
    assert_eq!(pair.numbers["module"], 2.0);
    let at = pair.lines[0][1];
    assert!((at[0] - 60.0).hypot(at[1] - 1.0) < 1.5, "{at:?}");
    let pin = made(
        &pair.text,
        0.0,
        json!({ "part": "point", "on": "wheel", "x": 0, "y": 30 }),
    );
    let slider = json!({ "part": "slider", "from": "wheel.B", "line": "frame.O", "length": 120, "angle_deg": 0, "side": "forward" });
    let press = made(&pin.text, 0.0, slider).text;
    let places = path(&press, "slider.C").into_iter().map(|[x, _]| x);
    let [low, high] = places.fold([f64::INFINITY, 0.0], |[low, high], x| {
        [low.min(x), high.max(x)]
    });
    // Twice the crank, sampled every 10 degrees.
    assert!(high - low > 59.0 && high - low < 60.1, "{low} {high}");
    let cam = json!({ "part": "cam", "on": "crank", "to": { "body": "frame", "at": [70, 0] }, "at": [20.0, 25.0], "swing_deg": 12 });
    for input in [0.0, 2.0] {
        let lever = made(&text, input, cam.clone());
        let machine = machine(&lever.text);
        let roller = machine.point_named("lever.roller").expect("a roller");
        let now = machine.place(roller.body, roller.at, input);
        assert!(
            (now - centrode_geometry::Point::new(20.0, 25.0)).norm() < 1e-3,
            "{now}"
        );
        let body = machine.body_named("lever").expect("a lever");
        let angles = (0..72).map(|i| {
            machine
                .angle(body, TAU * f64::from(i) / 72.0)
                .position
                .to_degrees()
        });
        let [low, high] = angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
            [a.min(x), b.max(x)]
        });
        assert!((high - low - 12.0).abs() < 1e-6, "{low} {high}");
    }
}

#[test]
fn a_goal_begins_with_the_figure_of_the_machine() {
    let (_, text) = machines()
        .into_iter()
        .find(|(name, _)| name.contains("jansen"))
        .expect("shipped");
    let part = json!({ "part": "goal", "figure": "shin.foot.y", "over": "minimum" });
    let goal = made(&text, 0.0, part);
    let lowest = path(&text, "shin.foot")
        .into_iter()
        .map(|[_, y]| y)
        .fold(0.0, f64::min);
    let limit = goal.numbers["limit"].as_f64().expect("a number");
    assert!(
        limit <= lowest + 1e-3 && limit > lowest - 1.0,
        "{limit} {lowest}"
    );
    assert!(
        goal.text
            .contains("[goals.shin]\nfigure = \"shin.foot.y\"\nover = \"minimum\"\nminimum = ")
    );
    assert!(goal.text.starts_with(&text));
    for (over, below) in [
        ("minimum", false),
        ("maximum", true),
        ("span", false),
        ("span", true),
    ] {
        let part = json!({ "part": "goal", "figure": "shin.foot.x", "over": over, "below": below });
        let file = FAMILIES
            .read(made(&text, 0.0, part).text.as_bytes())
            .expect("a design");
        let report = file.mechanism().expect("a machine").check_goals();
        assert_eq!(report.goals[0].met(), Some(true), "{over} {below}");
    }
}

/// Poses of all links over the cycle, in no order.
fn motions(text: &str) -> BTreeSet<String> {
    let file = FAMILIES.read(text.as_bytes()).expect("a design");
    let made = file
        .mechanism()
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    let poses = made.picture().motion.poses.into_iter();
    poses.map(|poses| format!("{poses:?}")).collect()
}

#[test]
fn a_name_that_changes_changes_nothing_else() {
    let mut names = 0;
    for (name, text) in machines() {
        let design =
            serde_json::to_value(text.parse::<toml::Table>().expect("TOML")).expect("a value");
        let before = motions(&text);
        let list = Composition::of(&*machine(&text), &text).expect("a machine");
        let comments = |text: &str| text.lines().filter(|line| line.contains('#')).count();
        for (i, key) in list.parts().iter().enumerate() {
            // Of designs with many parts some names of each kind are enough.
            if i % (1 + list.parts().len() / 5) != 0 {
                continue;
            }
            let to = "zz-new";
            let part = json!({ "part": "rename", "key": key, "to": to });
            let renamed = made(&text, 0.0, part);
            names += 1;
            assert_eq!(motions(&renamed.text), before, "{name}: {key}");
            assert_eq!(comments(&renamed.text), comments(&text), "{name}: {key}");
            assert_eq!(
                renamed.text.lines().count(),
                text.lines().count(),
                "{name}: {key}"
            );
            let (_, old) = key.rsplit_once('.').expect("a key");
            let back = made(
                &renamed.text,
                0.0,
                json!({ "part": "rename", "key": renamed.key, "to": old }),
            );
            let again: Json = serde_json::to_value(back.text.parse::<toml::Table>().expect("TOML"))
                .expect("a value");
            assert_eq!(again, design, "{name}: {key}");
        }
    }
    assert!(names > 40, "{names}");
}

#[test]
fn a_removal_names_what_depends_on_the_part_and_takes_it_along() {
    let (_, jansen) = machines()
        .into_iter()
        .find(|(name, _)| name.contains("jansen"))
        .expect("shipped");
    let refusal = refused(&jansen, json!({ "part": "delete", "key": "dyads.heel" }));
    assert_eq!(
        refusal.dependents,
        [
            "bodies.shin",
            "bodies.shin.corners.foot",
            "bodies.tie",
            "dyads.ankle"
        ]
    );
    let gone = made(
        &jansen,
        0.0,
        json!({ "part": "delete", "key": "dyads.heel", "all": true }),
    )
    .text;
    assert!(!gone.contains("ankle") && !gone.contains("shin") && gone.contains("[dyads.knee]"));
    assert!(gone.contains("# The leg of Theo Jansen"));
    let mut count = 0;
    for (name, text) in machines() {
        let list = Composition::of(&*machine(&text), &text).expect("a machine");
        for (i, key) in list.parts().iter().enumerate() {
            if i % (1 + list.parts().len() / 5) != 0 {
                continue;
            }
            let part = json!({ "part": "delete", "key": key, "all": true });
            match composed(&text, 0.0, &gesture(part)) {
                Ok(done) => {
                    count += 1;
                    let gone = done.text.parse::<toml::Table>().expect("TOML");
                    let there = key
                        .split('.')
                        .try_fold(&toml::Value::Table(gone), |here, key| here.get(key))
                        .is_some();
                    assert!(!there, "{name}: {key}");
                }
                Err(refusal) => panic!("{name}: {key}: {}", refusal.refused),
            }
        }
    }
    assert!(count > 40, "{count}");
}

#[test]
fn a_copy_of_a_part_moves_next_to_the_original() {
    let (_, jansen) = machines()
        .into_iter()
        .find(|(name, _)| name.contains("jansen"))
        .expect("shipped");
    let before = motions(&jansen);
    for (key, more) in [("bodies.crank", 1), ("dyads.heel", 2), ("dyads.knee", 2)] {
        let copy = made(&jansen, 0.0, json!({ "part": "copy", "key": key }));
        let after = motions(&copy.text);
        assert!(after.is_superset(&before), "{key}");
        assert_eq!(after.len(), before.len() + more, "{key}\n{}", copy.text);
    }
}

#[test]
fn other_designs_and_faulty_ones_are_not_composed() {
    let pair = FAMILIES.template("gear-pair").expect("a template");
    let point = json!({ "part": "point", "on": "frame", "x": 0, "y": 0 });
    assert!(
        refused(pair, point.clone())
            .refused
            .contains("family machine")
    );
    let wrong = "family = \"machine\"\n[bodies.crank]\non = \"frame.O\"\n";
    assert!(
        refused(wrong, point)
            .refused
            .contains("correct the design first")
    );
}
