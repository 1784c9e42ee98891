use std::f64::consts::TAU;

use super::*;
use centrode_spec::{DesignFamily, DesignFile, DesignSpec};

mod cams;
mod copies;
mod cutting;
mod drawn;
mod gears;
mod hardware;
mod limits;
mod random;
mod shafts;
mod slots;
mod tables;
mod trains;

fn read(text: &str) -> MachineDesign {
    MachineDesign::from_toml(text).expect("a design")
}

fn made(text: &str) -> Machine {
    Machine::resolve(&read(text)).expect("a machine")
}

/// The error of a design file, with line and key.
fn refused(text: &str) -> String {
    let families = [DesignFamily::new::<MachineDesign>()];
    let (file, _) = match DesignFile::read(text.as_bytes(), &families) {
        Ok(read) => read,
        Err(error) => return error.to_string(),
    };
    let design: &MachineDesign = file.design().downcast_ref().expect("the family");
    let error = Machine::resolve(design).expect_err(text);
    file.blame(error.into()).to_string()
}

const LEG: &str = MachineDesign::TEMPLATE;

#[test]
fn the_template_is_a_machine_whatever_the_order_of_its_names() {
    let leg = made(LEG);
    // The same leg, its bodies and dyads named so that the alphabet turns their order round.
    let mut text = LEG.to_owned();
    for (name, other) in [
        ("crank", "zcrank"),
        ("ankle", "aankle"),
        ("knee", "zknee"),
        ("heel", "xheel"),
        ("thigh", "a"),
    ] {
        text = text.replace(name, other);
    }
    let other = made(&text);
    let [one, two] = [&leg, &other].map(|leg| leg.point_named("foot").expect("a foot"));
    for i in 0..50 {
        let input = 0.3 * f64::from(i) - 4.0;
        assert_eq!(
            leg.place(one.body, one.at, input),
            other.place(two.body, two.at, input)
        );
    }
}

#[test]
fn joints_and_closures_hang_together_as_the_linkage_does() {
    let leg = made(LEG);
    let machine = leg.machine().expect("plates");
    assert_eq!(machine.validate(), Ok(()));
    random::agrees(&leg, &machine);
    assert_eq!(machine.closures.len(), 3);
}

#[test]
fn bad_files_are_told_by_key_and_line() {
    for (from, to, stated) in [
        (
            "on = \"frame.O\"",
            "on = \"frame.Q\"",
            "bodies.crank.on: body \"frame\" has no point \"Q\"; it has O, P",
        ),
        (
            "on = \"frame.O\"",
            "on = \"crank.A\"",
            "bodies.crank.on: the position of body crank depends on itself",
        ),
        (
            "on = \"frame.O\"",
            "on = \"wheel.W\"",
            "bodies.crank.on: there is no body \"wheel\"; there are frame, crank,",
        ),
        (
            "on = \"frame.O\"",
            "on = \"frame\"",
            "bodies.crank.on: \"frame\" names no point of a body",
        ),
        (
            "on = \"frame.O\"\n",
            "",
            "bodies.crank.on: is needed for a body with a law",
        ),
        (
            "on = \"frame.O\"",
            "on = \"frame.O\"\nfixed_to = \"frame\"",
            "bodies.crank.fixed_to: cannot be given together with on",
        ),
        (
            "on = \"frame.O\"",
            "on = \"shin.foot\"",
            "depend on each other",
        ),
        (
            "law = { ratio = 1 }",
            "law = { ratio = 0.5 }",
            "bodies.crank.law.ratio: turns the body by 0.5 turns in the period of 1 turns",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"phi^2\" }",
            "bodies.crank.law.expression: its first derivative is",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"0.3*phi\" }",
            "bodies.crank.law.expression: turns the body by 0.3 turns",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"tan(phi)\" }",
            "bodies.crank.law.expression: moves the body at",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"tan(phi + 0.004)\" }",
            "bodies.crank.law.expression: moves the body at",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"sin(phi\" }",
            "bodies.crank.law.expression:",
        ),
        (
            "law = { ratio = 1 }",
            "law = { expression = \"1/phi\" }",
            "has no value at an input of 0 deg",
        ),
        (
            "law = { ratio = 1 }",
            "law = { table = [1, 2] }",
            "bodies.crank.law.table: has no meaning except for a body that slides",
        ),
        (
            "law = { ratio = 1 }",
            "law = { ratio = 1, by = \"thigh\" }",
            "depend on each other",
        ),
        (
            "law = { ratio = 1 }",
            "law = { ratio = 1, by = \"frame\" }",
            "bodies.crank.law.by: body \"frame\" does not turn on a pin",
        ),
        (
            "law = { ratio = 1 }",
            "law = { start_deg = 1, by = \"thigh\" }",
            "bodies.crank.law.by: has no meaning except for a law that moves",
        ),
        (
            "law = { ratio = 1 }",
            "law = { traverse = { lead = 20, holes = 14 } }",
            "bodies.crank.law.traverse: has no meaning except for a body that slides",
        ),
        (
            "law = { ratio = 1 }",
            "law = { intermittent = { driver_pitches = 30, driven_pitches = 30, teeth = 30 } }",
            "bodies.crank.law.intermittent: 30 teeth with entry and exit take",
        ),
        (
            "law = { ratio = 1 }",
            "law = \"input\"",
            "bodies.crank.law: must be a table, not \"input\"",
        ),
        (
            "points = { A = [15, 0] }",
            "points = { A = [15, 0, 7] }",
            "bodies.crank.points.A: must have 2 values, not 3",
        ),
        (
            "law = { ratio = 1 }",
            "law = {}",
            "bodies.crank.law.start_deg: is missing: give one of",
        ),
        (
            "law = { ratio = 1 }",
            "law = { ratio = 1, expression = \"phi\" }",
            "bodies.crank.law.expression: cannot be given together with ratio",
        ),
        (
            "[bodies.crank]",
            "[bodies.idle]\n[bodies.crank]",
            "bodies.idle: nothing holds body \"idle\"",
        ),
        (
            "\"upper-rod\", \"thigh\"",
            "\"upper-rod\", \"crank\"",
            "body \"crank\" is already held by bodies.crank.on",
        ),
        (
            "\"upper-rod\", \"thigh\"",
            "\"upper-rod\", \"frame\"",
            "body \"frame\" is already held by frame",
        ),
        (
            "lengths = [50, 41.5]",
            "lengths = [10, 41.5]",
            "dyads.knee: dyad \"knee\" closes only for inputs of",
        ),
        (
            "lengths = [50, 41.5]",
            "lengths = [500, 41.5]",
            "dyads.knee: dyad \"knee\" closes at no input: at",
        ),
        (
            "lengths = [50, 41.5]",
            "lengths = [50]",
            "dyads.knee.lengths: is needed with two numbers for a dyad RRR",
        ),
        (
            "lengths = [50, 41.5]",
            "lengths = [50, -1]",
            "dyads.knee.lengths: must be greater than 0, not -1",
        ),
        (
            "side = \"right\"\nbodies = [\"upper",
            "side = \"forward\"\nbodies = [\"upper",
            "dyads.knee.side: is needed as left or right for a dyad RRR",
        ),
        (
            "joint = \"B\"",
            "",
            "dyads.knee.joint: is needed for a dyad RRR",
        ),
        (
            "joint = \"B\"",
            "joint = \"B\"\nslot_deg = 9",
            "dyads.knee.slot_deg: has no meaning in a dyad RRR",
        ),
        (
            "lengths = [40.1, 55.8]",
            "lengths = [1, 2]",
            "bodies.thigh.corners.D: sides of 1 and 2 mm cannot meet over points",
        ),
        (
            "from = [\"P\", \"B\"]",
            "from = [\"P\", \"X\"]",
            "bodies.thigh.corners.D: body \"thigh\" has no point \"X\"; it has P, B",
        ),
        (
            "points = { A = [15, 0] }",
            "points = { O = [15, 0] }",
            "body \"crank\" would have two points \"O\"",
        ),
        ("type = \"RRR\"", "type = \"RRRR\"", "did you mean \"RRR\""),
    ] {
        let text = LEG.replacen(from, to, 1);
        assert_ne!(text, LEG, "{from}");
        let found = refused(&text);
        assert!(found.contains(stated), "{to}\n  {found}\n  {stated}");
        // The line named holds the key, or begins the table it is missing from.
        let key = stated.split([':', ' ']).next().unwrap_or_default();
        let line: usize = found[5..]
            .split(',')
            .next()
            .and_then(|n| n.parse().ok())
            .expect("a line");
        let line = text.lines().nth(line - 1).expect("in the file");
        let words = key.split('.');
        assert!(
            !key.contains('.') || words.clone().any(|word| line.contains(word)),
            "{key} is not in the line {line:?}"
        );
    }
}

#[test]
fn a_dyad_that_does_not_close_tells_its_range_and_what_is_missing() {
    // A slider-crank of 30 mm on a rod of 20 mm closes where the crank's end is within 20 mm of the line.
    let text = r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [30, 0] }
[dyads.ram]
type = "RRP"
from = "crank.A"
lengths = [20]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"
"#;
    let Err(MachineError::DoesNotClose { dyads }) = Machine::resolve(&read(text)) else {
        panic!("the rod is too short");
    };
    let [(dyad, found)] = &dyads[..] else {
        panic!("one dyad");
    };
    assert_eq!(dyad, "ram");
    let (open, input, missing) = (&found.open, found.input, found.missing);
    assert_eq!(open.len(), 3);
    let limit = (20.0_f64 / 30.0).asin();
    let expected = [
        (0.0, limit),
        (TAU / 2.0 - limit, TAU / 2.0 + limit),
        (TAU - limit, TAU),
    ];
    for ((low, high), (from, to)) in open.iter().zip(expected) {
        assert!(
            (low - from).abs() < 1e-12 && (high - to).abs() < 1e-12,
            "{open:?}"
        );
    }
    assert!((missing - 10.0).abs() < 1e-12, "{missing}");
    assert!((input.sin().abs() - 1.0).abs() < 1e-12);
    let stated = "dyads.ram: dyad \"ram\" closes only for inputs of 0 to 41.8103, 138.1897 to 221.8103 and 318.1897 to 360 deg: at 90 deg 10 mm are missing";
    let found = refused(text);
    assert!(found.contains(stated), "{found}");
}

/// A four-bar with a crank of this length and phase on a frame of this length, with a second one of other lengths.
fn four_bars(lengths: [f64; 4], phase: f64, more: &str) -> String {
    let [crank, coupler, rocker, frame] = lengths;
    format!(
        "family = \"machine\"\n[frame.points]\nA = [0, 0]\nD = [{frame}, 0]\n[bodies.crank]\non = \"frame.A\"\nlaw = {{ ratio = 1, start_deg = {phase} }}\npoints = {{ B = [{crank}, 0] }}\n[dyads.loop]\ntype = \"RRR\"\nfrom = \"crank.B\"\nto = \"frame.D\"\nlengths = [{coupler}, {rocker}]\nside = \"left\"\nbodies = [\"coupler\", \"rocker\"]\njoint = \"C\"\n{more}"
    )
}

#[test]
fn change_points_and_gaps_are_reported_with_the_digits_that_matter() {
    let second = |lengths: [f64; 2]| {
        let [one, other] = lengths;
        format!(
            "[dyads.more]\ntype = \"RRR\"\nfrom = \"crank.B\"\nto = \"frame.D\"\nlengths = [{one}, {other}]\nside = \"right\"\nbodies = [\"link\", \"arm\"]\njoint = \"E\"\n"
        )
    };
    let flat = "where its links lie in one line and both its branches meet";
    for (lengths, phase, more, words) in [
        (
            [40.0, 80.0, 60.0, 100.0],
            0.0,
            String::new(),
            vec![format!(
                "dyad \"loop\" has a change point at 180 deg, {flat}"
            )],
        ),
        (
            [40.0, 80.0, 60.0, 100.0],
            37.5,
            String::new(),
            vec![format!("has a change point at 142.5 deg, {flat}")],
        ),
        (
            [40.0, 120.0, 40.0, 120.0],
            0.0,
            String::new(),
            vec![format!("has change points at 0 and 180 deg, {flat}")],
        ),
        (
            [40.0, 120.0, 40.0, 120.0],
            90.0,
            String::new(),
            vec!["has change points at 90 and 270 deg".into()],
        ),
        (
            [0.1, 0.2, 0.15, 0.25],
            0.0,
            String::new(),
            vec!["has a change point at 180 deg".into()],
        ),
        (
            [40.0, 120.0, 60.0, 100.0],
            0.0,
            String::new(),
            vec!["has a change point at 0 deg".into()],
        ),
        (
            [40.0, 80.0, 59.99999, 100.0],
            0.0,
            String::new(),
            vec![
                "closes only for inputs of 0 to 179.9521 and 180.0479 to 360 deg".into(),
                "at 180 deg 0.00001 mm are missing".into(),
            ],
        ),
        (
            [40.0, 1.0, 2.0, 100.0],
            0.0,
            String::new(),
            vec!["closes at no input: at 180 deg 137 mm are missing".into()],
        ),
        (
            [40.0, 80.0, 60.0, 100.0],
            0.0,
            second([70.0, 60.0]),
            vec![
                "dyad \"loop\" has a change point at 180 deg".into(),
                "; dyad \"more\" closes only for inputs of 0 to".into(),
                "at 180 deg 10 mm are missing".into(),
            ],
        ),
        (
            [40.0, 80.0, 50.0, 100.0],
            0.0,
            second([70.0, 50.0]),
            vec![
                "dyad \"loop\" closes only".into(),
                "180 deg 10 mm".into(),
                "dyad \"more\" closes only".into(),
                "180 deg 20 mm".into(),
            ],
        ),
    ] {
        let found = refused(&four_bars(lengths, phase, &more));
        for word in words {
            assert!(found.contains(&word), "{lengths:?}: {found}\n  {word}");
        }
        assert!(!found.contains(" 0.0000 "), "{found}");
    }
}

#[test]
fn guides_that_become_parallel_are_named_as_such() {
    let text = |law: &str, dyad: &str| {
        format!(
            "family = \"machine\"\n[frame.points]\nO = [0, 0]\nP = [5, 0]\n[bodies.crank]\non = \"frame.O\"\nlaw = {{ {law} }}\npoints = {{ A = [30, 0] }}\n[dyads.slides]\n{dyad}"
        )
    };
    let blocks = "type = \"PRP\"\nline = \"crank.A\"\nline_deg = 20\nsecond_line = \"frame.P\"\nsecond_line_deg = 0\nbodies = [\"one\", \"other\"]\njoint = \"B\"\n";
    let yoke = "type = \"RPP\"\nfrom = \"crank.A\"\nline = \"frame.O\"\nline_deg = 0\nslot_deg = 0\nbodies = [\"block\", \"yoke\"]\n";
    for (law, dyad, words) in [
        (
            "ratio = 1",
            blocks,
            "the guides of dyad \"slides\" are parallel at 160 and 340 deg",
        ),
        (
            "expression = \"0.5*(1 - cos(phi))\", start_deg = -20",
            blocks,
            "the guides of dyad \"slides\" are parallel at 0 deg",
        ),
        (
            "expression = \"0.5*(1 + cos(phi))\", start_deg = -20",
            blocks,
            "the guides of dyad \"slides\" are parallel at 180 deg",
        ),
        (
            "ratio = 1",
            yoke,
            "dyad \"slides\" closes at no input: at 0 deg its guides are parallel",
        ),
    ] {
        let found = refused(&text(law, dyad));
        assert!(found.contains(words), "{law}: {found}");
        assert!(!found.contains("inf"), "{found}");
    }
    assert!(Machine::resolve(&read(&text("expression = \"0.3*sin(phi)\"", blocks))).is_ok());
}

#[test]
fn every_kind_of_law_moves_a_body_as_it_says() {
    let with = |law: &str, slides: bool| {
        let slides = if slides { "slides_deg = 90\n" } else { "" };
        let text = format!(
            "family = \"machine\"\n[input]\nturns = 2\n[frame.points]\nO = [3, 4]\n[bodies.a]\non = \"frame.O\"\n{slides}law = {{ {law} }}\n"
        );
        made(&text)
    };
    let turned = with("ratio = 1.5, start_deg = 30", false);
    assert!((turned.angle(1, 2.0).position - (3.0 + TAU / 12.0)).abs() < 1e-15);
    assert_eq!(turned.angle(1, 2.0).velocity, 1.5);
    let still = with("start = 7", true);
    let place = still.place(1, Point::origin(), 1.0);
    assert!((place - Point::new(3.0, 11.0)).norm() < 1e-14);
    let waved = with("expression = \"phi/2 + 0.1*sin(phi/2)\"", false);
    let angle = waved.angle(1, 20.0).position;
    assert!((angle - (10.0 + 0.1 * 10.0_f64.sin())).abs() < 1e-13);
    let table = with("table_deg = [0, 10, 20, 10, 0, -10, -20, -10]", false);
    for (i, degrees) in [0.0_f64, 10.0, 20.0, 10.0, 0.0, -10.0, -20.0, -10.0]
        .iter()
        .enumerate()
    {
        let input = 2.0 * TAU * i as f64 / 8.0;
        assert!((table.angle(1, input).position - degrees.to_radians()).abs() < 1e-12);
    }
    let cam = "cam = { start_deg = 0, segments = [{ kind = \"rise\", span_deg = 90, lift = 5 }, { kind = \"dwell\", span_deg = 90 }, { kind = \"return\", span_deg = 90, lift = 5 }, { kind = \"dwell\", span_deg = 90 }] }";
    let cam = with(cam, true);
    for (input, lift) in [
        (0.0, 0.0),
        (0.25, 5.0),
        (0.375, 5.0),
        (0.75, 0.0),
        (1.25, 5.0),
    ] {
        let place = cam.place(1, Point::origin(), input * TAU);
        assert!((place.y - 4.0 - lift).abs() < 1e-12, "{input}: {place}");
    }
    assert_eq!(cam.linkage().breaks().len(), 8);
}

#[test]
fn a_machine_k_times_as_large_moves_k_times_as_far() {
    let k = 7.0;
    let mut large = read(LEG);
    let scaled = |points: &mut MachineBodySpec| {
        points.points.values_mut().flatten().for_each(|x| *x *= k);
        let corners = points.corners.values_mut();
        corners.for_each(|corner| corner.lengths = corner.lengths.map(|l| l * k));
    };
    large.bodies.values_mut().for_each(scaled);
    large
        .frame
        .points
        .values_mut()
        .flatten()
        .for_each(|x| *x *= k);
    for dyad in large.dyads.values_mut() {
        dyad.lengths.iter_mut().for_each(|l| *l *= k);
    }
    let [one, other] = [&read(LEG), &large].map(|d| Machine::resolve(d).expect("a machine"));
    let BodyPoint { body, at } = one.point_named("foot").expect("a foot");
    let large_foot = other.point_named("foot").expect("a foot");
    assert!((large_foot.at.coords - at.coords * k).norm() < 1e-12 * k * at.coords.norm());
    for i in 0..40 {
        let input = 0.17 * f64::from(i);
        let (a, b) = (
            one.point(body, at, input),
            other.point(large_foot.body, large_foot.at, input),
        );
        let off = (a.point.coords * k - b.point.coords).norm() + (a.third * k - b.third).norm();
        assert!(
            off < 1e-10 * k * (a.point.coords.norm() + a.third.norm()),
            "{off}"
        );
    }
}
