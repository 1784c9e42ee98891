use std::f64::consts::{PI, TAU};

use crate::feeder::{Feeder, FeederDesign, FeederError, FeederPart, LinkageSpec};
use centrode_gear::IntermittentError;
use centrode_kinematics::linkage::{Branch, SixBarError};

fn published() -> FeederDesign {
    FeederDesign::new(LinkageSpec {
        crank: 77.0,
        coupler: 147.0,
        rocker: 127.0,
        frame: 105.0,
        branch: Branch::Upper,
        pivot: [106.83, 67.05],
        effector_length: 200.0,
    })
}

#[test]
fn the_effector_goes_slowly_and_comes_back_quickly_from_rest_to_rest() {
    for branch in [Branch::Upper, Branch::Lower] {
        let mut design = published();
        design.linkage.branch = branch;
        design.linkage.pivot[1] *= branch.sign();
        let feeder = Feeder::resolve(&design).expect("resolves");
        let [feed, back] = feeder.strokes();
        assert_eq!((feed.from, feed.to), (0.0, back.from));
        assert!((back.to - feeder.drive().motion_angle()).abs() < 1e-12);
        assert!(feed.to - feed.from > 2.0 * (back.to - back.from));
        assert!(back.speed > 4.0 * feed.speed);
        for at in [feed.from, feed.to, back.to] {
            assert!(feeder.effector(at).velocity.abs() < 1e-9, "{at}");
        }
        let angles = [feed.from, feed.to, back.to].map(|at| feeder.effector(at).position);
        assert!(((angles[1] - angles[0]).abs() - feeder.six_bar().swing()).abs() < 1e-12);
        assert!((angles[2] - angles[0]).abs() < 1e-12);
        // The derivatives are those of the whole chain, and the sampled speed never exceeds the maximum.
        for i in 1..500 {
            let (x, h) = (0.0101 * f64::from(i), 1e-6);
            let jet = feeder.effector(x);
            let [a, b] = [x - h, x + h].map(|x| feeder.effector(x).position);
            assert!(((b - a) / (2.0 * h) - jet.velocity).abs() < 1e-7);
            let stroke = if x < feed.to { feed } else { back };
            assert!(jet.velocity.abs() <= stroke.speed * (1.0 + 1e-12));
        }
    }
}

#[test]
fn chain_and_motor_feed_five_times_eleven_cuttings_a_minute() {
    let feeder = Feeder::resolve(&published()).expect("resolves");
    assert!((feeder.cycles_per_minute() - 30.0 / 2.7).abs() < 1e-12);
    assert!((feeder.feed_rate() - 55.555_555_555_555_56).abs() < 1e-12);
    let share = feeder.drive().dwell_angle() / TAU;
    assert!((feeder.dwell_time() - share * 60.0 * 2.7 / 30.0).abs() < 1e-12);
    assert!((feeder.crank(TAU).position - feeder.start() - TAU).abs() < 1e-12);
}

#[test]
fn the_pivot_lies_on_the_chord_or_beside_it() {
    let mut design = published();
    let near = |design: &FeederDesign| {
        let feeder = Feeder::resolve(design).expect("resolves");
        feeder.distance_from_chord()
    };
    assert!(near(&design).expect("next to the chord") < 0.005);
    design.linkage.pivot[1] -= 20.0;
    let off = near(&design).expect("next to the chord");
    assert!((off - 20.0).abs() < 0.02, "{off}");
    design.linkage.pivot = [300.0, 60.0];
    assert_eq!(near(&design), None);
}

#[test]
fn what_is_no_feeder_is_refused_with_its_key() {
    let refused = |change: &dyn Fn(&mut FeederDesign)| {
        let mut design = published();
        change(&mut design);
        Feeder::resolve(&design).expect_err("refused")
    };
    // The paper's ratio 1 with a full turn and a dwell.
    let equal = refused(&|d| d.gears.driver_pitches = 30);
    assert!(matches!(
        equal,
        FeederError::Drive(IntermittentError::NoDwell { kept: 30, .. })
    ));
    assert_eq!(equal.key(), "gears.teeth");
    let half = refused(&|d| d.gears.teeth = 15);
    assert!(matches!(half, FeederError::NotOneTurn { teeth: 15, .. }));
    let long = refused(&|d| d.linkage.crank = 140.0);
    assert!(matches!(
        long,
        FeederError::SixBar(SixBarError::NotCrankRocker { .. })
    ));
    let entry = refused(&|d| d.gears.entry = PI);
    assert!(matches!(entry, FeederError::Drive(_)));
    for (change, key) in [
        (
            (|d: &mut FeederDesign| d.drive.slots = 0) as fn(&mut FeederDesign),
            "drive.slots",
        ),
        (|d| d.linkage.rocker = -1.0, "linkage.rocker"),
        (|d| d.linkage.pivot[0] = f64::NAN, "linkage.pivot"),
        (|d| d.bounds.frame = [6.0, 5.0], "bounds.frame"),
        (|d| d.goals.swing = 7.0, "goals.swing_deg"),
        (|d| d.gears.module = 0.0, "gears.module"),
        (|d| d.gears.lock_clearance = -1.0, "gears.lock_clearance"),
        (|d| d.plates.width = f64::INFINITY, "plates.width"),
        (
            |d| d.making.pivot_tolerance = -0.1,
            "making.pivot_tolerance",
        ),
    ] {
        assert_eq!(refused(&change).key(), key);
    }
}

#[test]
fn holes_that_meet_and_bores_wider_than_the_plates_are_refused() {
    let mut design = published();
    design.gears.bore = 24.0;
    let error = Feeder::resolve(&design).expect_err("no material about the shafts");
    assert_eq!(error.key(), "gears.bore");
    design.gears.bore = 16.0;
    design.linkage = LinkageSpec {
        crank: 15.0,
        coupler: 60.0,
        rocker: 50.0,
        frame: 55.0,
        ..design.linkage
    };
    let small = Feeder::resolve(&design).expect("a six-bar");
    let error = small.plate(FeederPart::Crank).expect_err("16 and 10 wide");
    assert!(
        matches!(
            &error,
            FeederError::HolesMeet { joints, distance: 15.0, .. } if *joints == ["A", "B"]
        ),
        "{error}"
    );
}
