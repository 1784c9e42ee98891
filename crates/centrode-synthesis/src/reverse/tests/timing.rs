use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use proptest::prelude::{any, prop_assert, prop_assume, proptest};

use super::assert_keyed;
use crate::reverse::{
    GearDrive, GearDriveError, GearDriveSpec, Required, Section, Timing, TimingError,
};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use centrode_machines::machine::{Machine, MachineDesign, MachineFigure};
use centrode_spec::DesignSpec as _;

const CRANK: f64 = 30.0;
const ROD: f64 = 120.0;

/// Position of the ram of a slider-crank by the crank's angle, in closed form with three derivatives.
fn ram() -> Arc<dyn Transmission> {
    Arc::new(FromFn::new(TAU, 0.0, Vec::new(), |t: f64| {
        let (s, c) = t.sin_cos();
        let [r, l] = [CRANK, ROD];
        // g = l² - r² sin², with three derivatives.
        let g = l * l - r * r * s * s;
        let [g1, g2, g3] = [
            -2.0 * r * r * s * c,
            -2.0 * r * r * (c * c - s * s),
            8.0 * r * r * s * c,
        ];
        let h = g.sqrt();
        let h1 = g1 / (2.0 * h);
        let h2 = (g2 - 2.0 * h1 * h1) / (2.0 * h);
        let h3 = (g3 - 6.0 * h1 * h2) / (2.0 * h);
        MotionJet {
            position: r * c + h,
            velocity: -r * s + h1,
            acceleration: -r * c + h2,
            jerk: r * s + h3,
        }
    }))
}

fn section(name: &str, [from, to]: [f64; 2], required: Required) -> Section {
    Section {
        name: name.into(),
        within: [from.to_radians(), to.to_radians()],
        required,
    }
}

fn even(within: [f64; 2], places: [f64; 2]) -> Section {
    section("even", within, Required::Even(places))
}

fn rest(within: [f64; 2], band: f64) -> Section {
    section("rest", within, Required::Rest(band))
}

/// Maximum jumps of position, speed and acceleration at breaks.
fn jumps(law: &Timing) -> [f64; 3] {
    let mut jumps = [0.0_f64; 3];
    for input in law.breaks() {
        let [before, after] = [input - 1e-12, input].map(|x| law.at(x));
        jumps[0] = jumps[0].max((after.position - before.position).abs());
        jumps[1] = jumps[1].max((after.velocity - before.velocity).abs());
        jumps[2] = jumps[2].max((after.acceleration - before.acceleration).abs());
    }
    jumps
}

#[test]
fn the_ram_goes_evenly_and_rests_where_asked() {
    let sections = [
        even([40.0, 120.0], [105.0, 140.0]),
        rest([160.0, 210.0], 0.5),
    ];
    let law = Timing::new(ram(), &sections).expect("a law");
    let place = |input: f64| ram().at(law.at(input).position).position;
    for i in 0..=1000 {
        let share = f64::from(i) / 1000.0;
        let required = 105.0 + 35.0 * share;
        let off = place((40.0 + 80.0 * share).to_radians()) - required;
        assert!(off.abs() < 1e-12 * 150.0, "{share}: {off:e}");
        let rests = place((160.0 + 50.0 * share).to_radians());
        assert!((149.5 - 1e-12..=150.0 + 1e-12).contains(&rests), "{rests}");
    }
    let [low, high] = law.ratios();
    assert!(low.value > 0.0 && high.value < 6.0, "{low:?} {high:?}");
    let [p, v, a] = jumps(&law);
    assert!(p < 1e-10 && v < 1e-9 && a < 1e-7, "{p:e} {v:e} {a:e}");
    // Its jet is that of its position, and a turn is a turn.
    for i in 0..400 {
        let input = TAU * (f64::from(i) + 0.37) / 400.0;
        let h = 1e-5;
        let [before, here, after] = [input - h, input, input + h].map(|x| law.at(x));
        let slope = (after.position - before.position) / (2.0 * h);
        assert!(
            (slope - here.velocity).abs() < 1e-6 * (1.0 + here.velocity.abs() + here.jerk.abs())
        );
        let bend = (after.velocity - before.velocity) / (2.0 * h);
        assert!(
            (bend - here.acceleration).abs() < 1e-4 * (1.0 + here.jerk.abs()),
            "{input}"
        );
        let next = law.at(input + TAU).position - here.position;
        assert!((next - TAU).abs() < 1e-12);
    }
}

#[test]
fn of_two_rests_each_is_at_an_end_of_its_own() {
    let law = Timing::new(ram(), &[rest([0.0, 60.0], 0.2), rest([180.0, 240.0], 0.2)]);
    let law = law.expect("a law");
    let place = |input: f64| ram().at(law.at(f64::to_radians(input)).position).position;
    let [one, other] = [place(30.0), place(210.0)];
    assert!((one - other).abs() > 59.0, "{one} {other}");
}

#[test]
fn what_no_crank_can_do_is_refused_by_name() {
    let error = |sections: &[Section]| Timing::new(ram(), sections).expect_err("no law");
    let is = |found: TimingError, words: &str| {
        let stated = found.to_string();
        assert!(stated.contains(words), "{stated}");
    };
    is(error(&[]), "nothing is required");
    is(
        error(&[even([0.0, 90.0], [100.0, 150.0])]),
        "its stroke is from 90 to 150",
    );
    is(error(&[even([0.0, 90.0], [100.0, 100.0])]), "never stop");
    is(error(&[rest([0.0, 90.0], 0.0)]), "a band of 0 in");
    is(
        error(&[rest([0.0, 90.0], 1e-12)]),
        "a band of 1e-12 in a stroke of 60; the band must be above 6e-8",
    );
    is(
        error(&[rest([0.0, 90.0], 31.0)]),
        "below half of the stroke",
    );
    is(
        error(&[even([0.0, 90.0], [100.0, 120.0]), rest([90.0, 120.0], 0.1)]),
        "leave a gap between them",
    );
    is(
        error(&[
            even([0.0, 60.0], [100.0, 140.0]),
            even([90.0, 120.0], [110.0, 120.0]),
        ]),
        "in this order",
    );
    is(
        error(&[
            rest([0.0, 60.0], 0.1),
            rest([100.0, 150.0], 0.1),
            rest([200.0, 250.0], 0.1),
        ]),
        "in this order",
    );
    is(
        error(&[even([0.0, 359.9], [100.0, 100.1])]),
        "leave a larger gap",
    );
    let twice = FromFn::new(TAU, 0.0, Vec::new(), |t: f64| {
        MotionJet::uniform((2.0 * t).sin(), 2.0 * (2.0 * t).cos())
    });
    is(
        Timing::new(Arc::new(twice), &[rest([0.0, 9.0], 0.1)]).expect_err("no law"),
        "turns back 4 times",
    );
}

proptest! {
    #[test]
    fn a_law_found_never_turns_back_and_does_what_is_asked(
        shares in any::<[u16; 6]>(),
        band in 0.05..3.0_f64,
    ) {
        let share = |k: usize| f64::from(shares[k]) / f64::from(u16::MAX);
        let from = 10.0 + 60.0 * share(0);
        let to = from + 30.0 + 80.0 * share(1);
        let [start, end] = [95.0 + 20.0 * share(2), 120.0 + 25.0 * share(3)];
        let begin = to + 25.0 + 30.0 * share(4);
        let stop = begin + 10.0 + 50.0 * share(5);
        let sections = [even([from, to], [start, end]), rest([begin, stop], band)];
        let law = Timing::new(ram(), &sections);
        prop_assume!(law.is_ok());
        let law = law.expect("a law");
        let mut before = law.at(0.0).position;
        for i in 1..=720 {
            let input = f64::from(i) * PI / 360.0;
            let jet = law.at(input);
            prop_assert!(jet.velocity > 0.0 && jet.position > before);
            before = jet.position;
            let degrees = input.to_degrees();
            let place = ram().at(jet.position).position;
            if degrees > from && degrees < to {
                let required = start + (end - start) * (degrees - from) / (to - from);
                prop_assert!((place - required).abs() < 1e-10);
            }
            if degrees > begin && degrees < stop {
                let off = (place - 90.0).min(150.0 - place);
                prop_assert!(off < band + 1e-10, "{} mm from an end", off);
            }
        }
    }
}

const SLIDER: &str = r#"
family = "machine"
hardware = "list"
frame.points = { O = [5, -7] }
bodies.crank = { on = "frame.O", law = { ratio = 1, start_deg = 20 }, points = { A = [30, 0] } }
[dyads.ram]
type = "RRP"
from = "crank.A"
lengths = [120]
line = "frame.O"
line_deg = 0
side = "forward"
bodies = ["rod", "ram"]
joint = "B"
[goals.steady]
figure = "ram.travel"
over = "deviation"
within_deg = [40, 120]
uniform = [105, 140]
maximum = 1e-4
[goals.rest]
figure = "ram.travel"
over = "span"
within_deg = [160, 210]
maximum = 0.5
[goals.held]
figure = "transmission(ram)"
over = "minimum"
minimum = 60
"#;

fn slider(change: impl Fn(String) -> String) -> MachineDesign {
    MachineDesign::from_toml(&change(SLIDER.into())).expect("a design")
}

fn requested(direction: f64) -> GearDriveSpec {
    GearDriveSpec {
        body: "crank".into(),
        center_distance: 130.0,
        direction,
    }
}

/// The machine driven by gears shares no code with the way its law was found.
#[test]
fn the_machine_driven_by_the_gears_does_what_its_goals_ask() {
    for (sense, direction) in [("1", PI), ("1", 0.4), ("-1", -1.3)] {
        let design = slider(|text| text.replace("ratio = 1", &format!("ratio = {sense}")));
        let made = GearDrive::new(&design, &requested(direction)).expect("a drive");
        assert!(made.miss.value < 1e-5, "{:?}", made.miss);
        let driven = Machine::resolve(&made.design).expect("a machine");
        let ram = driven.figure("ram", "ram.travel").expect("a figure");
        let place = |degrees: f64| driven.value(&ram, degrees.to_radians()).expect("a place");
        for i in 0..=100 {
            let share = f64::from(i) / 100.0;
            let off = place(40.0 + 80.0 * share) - (105.0 + 35.0 * share);
            assert!(off.abs() < 1e-5, "{sense} {share}: {off:e}");
            let rests = place(160.0 + 50.0 * share);
            assert!((149.49999..150.00001).contains(&rests), "{rests}");
        }
        assert_keyed(&driven);
        // The crank's axis is where it was.
        let crank = driven.body_named("crank").expect("a crank");
        let axis = driven.place(crank, Default::default(), 1.0);
        assert!((axis.x - 5.0).abs() < 1e-12 && (axis.y + 7.0).abs() < 1e-12);
        assert!(matches!(ram, MachineFigure::Travel(_)));
    }
}

#[test]
fn machines_that_cannot_be_driven_so_are_refused_with_the_reason() {
    let error = |change: &dyn Fn(String) -> String, body: &str| {
        let spec = GearDriveSpec {
            body: body.into(),
            ..requested(0.0)
        };
        let error = GearDrive::new(&slider(change), &spec).expect_err("no drive");
        error.to_string()
    };
    let same = |text: String| text;
    let is = |stated: String, words: &str| assert!(stated.contains(words), "{stated}");
    is(
        error(&same, "rod"),
        "rod belongs to dyads.ram: the crank must turn",
    );
    is(error(&same, "fan"), "fan is not in bodies");
    is(
        error(&|t| t.replace("ratio = 1", "ratio = 2"), "crank"),
        "crank has another law",
    );
    is(
        error(
            &|t| {
                t.replace("over = \"span\"", "over = \"maximum\"")
                    .replace("over = \"deviation\"", "over = \"maximum\"")
                    .replace("uniform = [105, 140]\n", "")
            },
            "crank",
        ),
        "no goal defines the output",
    );
    is(
        error(&|t| t.replacen("ram.travel", "rod.angle", 1), "crank"),
        "another goal has figure",
    );
    is(
        error(&|t| t.replace("ram.travel", "A.speed"), "crank"),
        "must be a position or an angle",
    );
    is(
        error(
            &|t| {
                t.replace(
                    "[dyads.ram]",
                    "bodies.fan = { on = \"frame.O\", law = { ratio = 3 } }\n[dyads.ram]",
                )
            },
            "crank",
        ),
        "also moves fan by the input",
    );
    for distance in [f64::NAN, 0.0, -5.0, f64::INFINITY] {
        let spec = GearDriveSpec {
            center_distance: distance,
            ..requested(0.0)
        };
        let error = GearDrive::new(&slider(same), &spec).expect_err("no drive");
        assert!(matches!(error, GearDriveError::Distance { .. }), "{error}");
    }
    for direction in [f64::NAN, 1e18, -6.4] {
        let error = GearDrive::new(&slider(same), &requested(direction)).expect_err("no drive");
        assert!(matches!(error, GearDriveError::Direction { .. }), "{error}");
    }
    let made = GearDrive::new(&slider(same), &requested(0.0)).expect("a drive");
    assert_eq!(made.left_alone, ["held"]);
    let spanless = |text: String| text.replace("within_deg = [160, 210]\n", "");
    let made = GearDrive::new(&slider(spanless), &requested(0.0)).expect("a drive");
    assert_eq!(made.left_alone, ["rest", "held"]);
}
