use super::*;
use crate::cam::Motion;
use crate::cam::design::{Dwell, MotionSpec, SegmentSpec, Travel};
use crate::cam::law::LawSpec;
use centrode_geometry::{Point, Tolerance};

fn fork(lifts: Turn, rod: RodJoint) -> Fork {
    Fork {
        roller_radius: 5.0,
        center_distance: 52.0,
        arm_length: 45.0,
        lifts,
        rod,
    }
}

fn lever() -> Lever {
    Lever {
        length: 40.0,
        start: -0.15,
    }
}

/// Slow retraction, dwell, and a drop over so many degrees of the input.
fn throw(drop: f64, stroke: f64) -> Arc<Motion> {
    let travel = |degrees: f64, law| Travel {
        span: degrees.to_radians(),
        lift: Some(stroke),
        swing: None,
        law,
    };
    let rest = |degrees: f64| {
        SegmentSpec::Dwell(Dwell {
            span: degrees.to_radians(),
        })
    };
    let spec = MotionSpec {
        start: 1.0,
        segments: vec![
            SegmentSpec::Rise(travel(120.0, LawSpec::ModifiedSine)),
            rest(100.0),
            SegmentSpec::Return(travel(drop, LawSpec::ModifiedTrapezoid)),
            rest(140.0 - drop),
        ],
    };
    Arc::new(Motion::resolve(&spec).expect("sound"))
}

/// An arm that turns against the carrier, unevenly.
fn arm(sign: f64) -> Arc<dyn Transmission> {
    let law = move |t: f64| MotionJet {
        position: sign * (0.7 + t + 0.4 * t.sin()),
        velocity: sign * (1.0 + 0.4 * t.cos()),
        acceleration: -sign * 0.4 * t.sin(),
        jerk: -sign * 0.4 * t.cos(),
    };
    Arc::new(FromFn::new(TAU, sign * TAU, Vec::new(), law))
}

#[test]
fn swing_and_retraction_undo_each_other() {
    let jet = MotionJet {
        position: 6.0,
        velocity: -3.0,
        acceleration: 11.0,
        jerk: 40.0,
    };
    for joint in [RodJoint::PinOnRod(lever()), RodJoint::PinOnFork(lever())] {
        let back = joint.retraction(&joint.swing(&jet));
        for (a, b) in [
            (back.position, jet.position),
            (back.velocity, jet.velocity),
            (back.acceleration, jet.acceleration),
            (back.jerk, jet.jerk),
        ] {
            assert!((a - b).abs() < 1e-12, "{back:?}");
        }
    }
    // 40 (tan b - tan b0) and 40 (sin b - sin b0) by hand.
    let swing = MotionJet::at_rest(0.25);
    let by = |joint: RodJoint| joint.retraction(&swing).position;
    let tan = 40.0 * (0.1_f64.tan() + 0.15_f64.tan());
    assert!((by(RodJoint::PinOnRod(lever())) - tan).abs() < 1e-13);
    let sin = 40.0 * (0.1_f64.sin() + 0.15_f64.sin());
    assert!((by(RodJoint::PinOnFork(lever())) - sin).abs() < 1e-13);
}

/// Stand the roller on the finished profile in the machine and read the rod.
#[test]
fn the_rod_moves_as_wanted_by_the_machines_input() {
    let tolerance = Tolerance::new(1e-9).expect("positive");
    for lifts in [Turn::CounterClockwise, Turn::Clockwise] {
        for sign in [1.0, -1.0] {
            let (fork, arm) = (fork(lifts, RodJoint::PinOnRod(lever())), arm(sign));
            let retraction = throw(60.0, 9.0);
            let cam = fork
                .cam_by_input(retraction.clone(), arm.clone(), 22.0)
                .expect("follows");
            let profile = cam.profile(tolerance).expect("sound");
            assert_eq!(profile.undercut(), []);
            for i in 0..50 {
                let input = 0.05 + TAU * f64::from(i) / 50.0;
                let turned = arm.at(input).position - arm.at(0.0).position;
                // In the carrier's frame, the pivot where the arm has carried it.
                let pivot = Point::new(turned.cos(), turned.sin()) * 52.0;
                let roller = cam.contact(turned.abs()).roller.expect("a roller");
                let arm_direction = roller - pivot;
                assert!((arm_direction.norm() - 45.0).abs() < 1e-10);
                let to_axis = -pivot.coords;
                let angle = to_axis
                    .perp(&arm_direction)
                    .atan2(to_axis.dot(&arm_direction));
                let swing = MotionJet::at_rest(lifts.sign() * angle - cam.start_angle());
                let rod = fork.rod.retraction(&swing).position;
                let required = retraction.at(input).position;
                assert!((rod - required).abs() < 1e-9, "{input}: {rod} {required}");
            }
        }
    }
}

#[test]
fn the_cams_motion_has_the_derivatives_of_what_it_is_chained_of() {
    let fork = fork(Turn::Clockwise, RodJoint::PinOnFork(lever()));
    let cam = fork
        .cam_by_input(throw(60.0, 9.0), arm(-1.0), 22.0)
        .expect("follows");
    let h = 1e-5;
    let breaks = cam.motion().breaks();
    assert_eq!(breaks.len(), 4 + 2 + 4);
    for i in 0..70 {
        let angle = 0.013 + TAU * f64::from(i) / 70.0;
        if breaks.iter().any(|b| (b - angle).abs() < 2.0 * h) {
            continue;
        }
        let [a, b, c] = [-h, 0.0, h].map(|d| cam.motion().at(angle + d));
        for (difference, exact) in [
            ((c.position - a.position) / (2.0 * h), b.velocity),
            ((c.velocity - a.velocity) / (2.0 * h), b.acceleration),
            ((c.acceleration - a.acceleration) / (2.0 * h), b.jerk),
        ] {
            assert!(
                (difference - exact).abs() < 1e-6,
                "{angle} {difference} {exact}"
            );
        }
    }
}

/// Guards that figures show the effect of a quick drop, and that the cut cam is the envelope of the roller.
#[test]
fn a_quicker_drop_is_told_by_acceleration_pressure_angle_and_undercut() {
    let fork = fork(Turn::CounterClockwise, RodJoint::PinOnRod(lever()));
    let tolerance = Tolerance::new(1e-9).expect("positive");
    let mut before: Option<(f64, f64, f64)> = None;
    for drop in [60.0, 30.0, 15.0, 8.0] {
        let cam = fork
            .cam(throw(drop, 9.0), 22.0, Turn::Clockwise)
            .expect("follows");
        let (peaks, limits) = (cam.peaks(), cam.limits());
        let now = (
            peaks.acceleration.value,
            limits.return_pressure_angle.value,
            limits.minimum_radius.value,
        );
        if let Some(slower) = before {
            assert!(now.0 > 1.5 * slower.0 && now.1 > slower.1 && now.2 < slower.2);
        }
        let profile = cam.profile(tolerance).expect("there is one");
        assert_eq!(profile.undercut().is_empty(), limits.regularity.value > 0.0);
        assert_eq!(profile.outline().crossing(), None);
        before = Some(now);
    }
    assert!(before.is_some_and(|(_, _, radius)| radius < 0.0));
}

#[test]
fn forks_that_cannot_work_are_refused() {
    let joint = RodJoint::PinOnFork(lever());
    let usual = fork(Turn::Clockwise, joint);
    assert!(matches!(
        usual
            .cam(throw(60.0, 47.0), 22.0, Turn::Clockwise)
            .map(|_| ()),
        Err(CamError::Retraction { .. })
    ));
    let still: Arc<dyn Transmission> = Arc::new(FromFn::new(TAU, TAU, Vec::new(), |t: f64| {
        MotionJet::uniform(t - 1.2 * t.sin(), 1.0 - 1.2 * t.cos())
    }));
    assert!(matches!(
        usual
            .cam_by_input(throw(60.0, 9.0), still, 22.0)
            .map(|_| ()),
        Err(CamError::Transmission(_))
    ));
    let twice: Arc<dyn Transmission> =
        Arc::new(FromFn::new(TAU, 2.0 * TAU, Vec::new(), |t: f64| {
            MotionJet::uniform(2.0 * t, 2.0)
        }));
    assert!(matches!(
        usual
            .cam_by_input(throw(60.0, 9.0), twice, 22.0)
            .map(|_| ()),
        Err(CamError::Transmission(_))
    ));
    let mut short = usual;
    short.rod = RodJoint::PinOnRod(Lever {
        length: 0.0,
        start: 0.0,
    });
    let error = short
        .cam(throw(60.0, 9.0), 22.0, Turn::Clockwise)
        .map(|_| ());
    assert_eq!(error.expect_err("refused").key(), "rod.length");
}
