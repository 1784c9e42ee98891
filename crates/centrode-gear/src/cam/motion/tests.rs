use super::*;
use crate::cam::design::{Dwell, Transition, Travel};
use crate::cam::law::LawSpec;

fn travel(degrees: f64, lift: f64, law: &str) -> Travel {
    Travel {
        span: degrees.to_radians(),
        lift: Some(lift),
        swing: None,
        law: LawSpec::named(law).expect("known"),
    }
}

fn dwell(degrees: f64) -> SegmentSpec {
    SegmentSpec::Dwell(Dwell {
        span: degrees.to_radians(),
    })
}

fn spec(segments: Vec<SegmentSpec>) -> MotionSpec {
    MotionSpec {
        start: 0.4,
        segments,
    }
}

/// Slow rise, dwell, quick drop, dwell.
fn quick_drop() -> MotionSpec {
    spec(vec![
        SegmentSpec::Rise(travel(150.0, 8.0, "modified-sine")),
        dwell(100.0),
        SegmentSpec::Return(travel(12.0, 8.0, "modified-trapezoid")),
        dwell(98.0),
    ])
}

#[test]
fn a_cycle_follows_its_laws_and_repeats() {
    let motion = Motion::resolve(&quick_drop()).expect("sound");
    let span = 150.0_f64.to_radians();
    let law = LawSpec::ModifiedSine.resolve().expect("sound");
    for i in 0..40 {
        let x = f64::from(i) / 40.0;
        let (at, s) = (motion.at(0.4 + x * span), law.at(x));
        assert!((at.position - 8.0 * s.position).abs() < 1e-13);
        assert!((at.velocity - 8.0 * s.velocity / span).abs() < 1e-12);
        assert!((at.jerk - 8.0 * s.jerk / span.powi(3)).abs() < 1e-9);
        let later = motion.at(0.4 + x * span - 3.0 * TAU);
        assert!((later.position - at.position).abs() < 1e-12);
    }
    assert!((motion.at(0.4 + 200.0_f64.to_radians()).position - 8.0).abs() < 1e-14);
    assert_eq!(motion.at(0.3), MotionJet::default());
    assert_eq!(motion.breaks().len(), 4 + 2 + 2 + 4 - 2);
    let peaks = motion.peaks();
    let drop = 12.0_f64.to_radians();
    let expected = 8.0 * 8.0 * std::f64::consts::PI / (2.0 + std::f64::consts::PI);
    assert!((peaks.acceleration.value * drop * drop / expected - 1.0).abs() < 1e-9);
    assert!((peaks.velocity.value * drop / 16.0 - 1.0).abs() < 1e-12);
    let middle = (0.4 + 256.0_f64.to_radians() - peaks.velocity.input).abs();
    assert!(middle < 1e-6, "{middle}");
}

#[test]
fn joins_tell_the_jumps_of_acceleration_and_jerk() {
    let motion = Motion::resolve(&spec(vec![
        SegmentSpec::Rise(travel(90.0, 5.0, "harmonic")),
        dwell(90.0),
        SegmentSpec::Return(travel(180.0, 5.0, "cycloidal")),
    ]))
    .expect("sound");
    let joins = motion.joins();
    // h pi^2 / (2 B^2) with B = pi / 2: 2 h.
    assert!((joins[0].acceleration_jump - 2.0 * 5.0).abs() < 1e-12);
    assert!((joins[1].acceleration_jump - 2.0 * 5.0).abs() < 1e-12);
    assert!(joins[2].acceleration_jump.abs() < 1e-12);
    let jerk = -5.0 * 4.0 * std::f64::consts::PI.powi(2) / std::f64::consts::PI.powi(3);
    assert!((joins[2].jerk_jump - jerk).abs() < 1e-11);
    assert!((joins[1].input - (0.4 + 0.5 * std::f64::consts::PI)).abs() < 1e-15);
}

#[test]
fn a_transition_takes_over_velocity_and_acceleration() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let transition = |lift, start_velocity, end_velocity| {
        SegmentSpec::Transition(Transition {
            span: quarter,
            lift: Some(lift),
            start_velocity,
            end_velocity,
            ..Transition::default()
        })
    };
    let steady = Travel {
        span: quarter,
        lift: Some(6.0),
        law: LawSpec::ConstantVelocity,
        swing: None,
    };
    let v = 6.0 / quarter;
    let segments = vec![
        transition(3.0, 0.0, v),
        SegmentSpec::Rise(steady.clone()),
        transition(1.0, v, 0.0),
        SegmentSpec::Return(travel(90.0, 10.0, "polynomial-345")),
    ];
    let motion = Motion::resolve(&spec(segments.clone())).expect("sound");
    for join in motion.joins() {
        assert!(join.acceleration_jump.abs() < 1e-11, "{join:?}");
    }
    let mid = motion.at(0.4 + 1.5 * quarter);
    assert!((mid.position - 6.0).abs() < 1e-12 && (mid.velocity - v).abs() < 1e-12);

    let mut abrupt = segments;
    abrupt[0] = transition(3.0, 0.0, 0.5 * v);
    let Err(MotionError::VelocityJump {
        degrees,
        before,
        after,
    }) = Motion::resolve(&spec(abrupt))
    else {
        panic!("a jump of velocity")
    };
    assert!((degrees - (0.4_f64.to_degrees() + 90.0)).abs() < 1e-9);
    assert!((before - 0.5 * v).abs() < 1e-12 && (after - v).abs() < 1e-12);
}

#[test]
fn the_lowest_level_is_zero_wherever_the_cycle_starts() {
    let motion = Motion::resolve(&spec(vec![
        SegmentSpec::Return(travel(100.0, 4.0, "cycloidal")),
        SegmentSpec::Rise(travel(260.0, 4.0, "cycloidal")),
    ]))
    .expect("sound");
    assert!((motion.at(0.4).position - 4.0).abs() < 1e-14);
    assert!(motion.at(0.4 + 100.0_f64.to_radians()).position.abs() < 1e-14);
}

#[test]
fn cycles_that_do_not_close_are_refused() {
    let rise = SegmentSpec::Rise(travel(100.0, 4.0, "cycloidal"));
    let fall = |degrees, lift| SegmentSpec::Return(travel(degrees, lift, "cycloidal"));
    assert!(matches!(
        Motion::resolve(&spec(vec![rise.clone(), fall(250.0, 4.0)])),
        Err(MotionError::Spans { degrees }) if (degrees - 350.0).abs() < 1e-9
    ));
    assert_eq!(
        Motion::resolve(&spec(vec![rise.clone(), fall(260.0, 3.0)])).map(|_| ()),
        Err(MotionError::Open {
            rise: 4.0,
            fall: 3.0,
            swings: false,
        })
    );
    let swung = |swing: f64| {
        let mut travel = travel(180.0, 0.0, "cycloidal");
        (travel.lift, travel.swing) = (None, Some(swing.to_radians()));
        travel
    };
    let segments = vec![
        SegmentSpec::Rise(swung(12.0)),
        SegmentSpec::Return(swung(11.0)),
    ];
    let error = Motion::resolve(&spec(segments)).map(|_| ());
    let stated =
        "the follower rises by 12 deg and returns by 11 deg: a cycle must end where it started";
    assert_eq!(error.expect_err("refused").to_string(), stated);
    let error = Motion::resolve(&spec(vec![rise, fall(-1.0, 4.0)])).map(|_| ());
    assert_eq!(error.expect_err("refused").key(), "segments.1.span_deg");
}
