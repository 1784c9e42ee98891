use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use centrode_geometry::{Outline, Point, Tolerance, Vector, bracketed_minimum};

use super::design::{
    CamSpec, Dwell, Follower, MotionSpec, SegmentSpec, SwingingFlat, SwingingRoller,
    TranslatingFlat, TranslatingRoller, Travel, Turn,
};
use super::law::LawSpec;
use super::{CamError, DiscCam, Profile};
use centrode_kinematics::transmission::{FromFn, MotionJet};

fn fine() -> Tolerance {
    Tolerance::new(1e-10).expect("positive")
}

/// Slow rise, dwell, quick drop, dwell.
fn motion(stroke: f64, swings: bool, drop: f64) -> MotionSpec {
    let travel = |degrees: f64, law: LawSpec| Travel {
        span: degrees.to_radians(),
        lift: (!swings).then_some(stroke),
        swing: swings.then_some(stroke),
        law,
    };
    let dwell = |degrees: f64| {
        SegmentSpec::Dwell(Dwell {
            span: degrees.to_radians(),
        })
    };
    MotionSpec {
        start: 0.3,
        segments: vec![
            SegmentSpec::Rise(travel(140.0, LawSpec::ModifiedSine)),
            dwell(60.0),
            SegmentSpec::Return(travel(drop, LawSpec::Polynomial4567)),
            dwell(160.0 - drop),
        ],
    }
}

fn followers(lifts: Turn) -> Vec<Follower> {
    vec![
        Follower::TranslatingRoller(TranslatingRoller {
            roller_radius: 7.0,
            offset: 4.0 * lifts.sign(),
        }),
        Follower::TranslatingRoller(TranslatingRoller::default()),
        Follower::SwingingRoller(SwingingRoller {
            roller_radius: 6.0,
            center_distance: 70.0,
            arm_length: 60.0,
            lifts,
        }),
        Follower::TranslatingFlat(TranslatingFlat {}),
        Follower::SwingingFlat(SwingingFlat {
            center_distance: 90.0,
            face_offset: 5.0,
            lifts,
        }),
    ]
}

/// Sound cams with every follower, both ways round.
fn cams() -> Vec<DiscCam> {
    let mut cams = Vec::new();
    for rotation in [Turn::CounterClockwise, Turn::Clockwise] {
        for lifts in [Turn::CounterClockwise, Turn::Clockwise] {
            for follower in followers(lifts) {
                let flat = follower.roller_radius().is_none();
                let swings = follower.swings();
                let stroke = match (swings, flat) {
                    (false, false) => 9.0,
                    (false, true) => 5.0,
                    (true, _) => 0.12,
                };
                let mut spec = CamSpec::new(40.0, follower, motion(stroke, swings, 100.0));
                spec.rotation = rotation;
                cams.push(DiscCam::resolve(&spec).expect("sound"));
            }
        }
    }
    cams
}

/// Distance of a point from an outline, accurate enough when found by samples of each segment.
fn distance(outline: &Outline, point: Point) -> f64 {
    let mut best = f64::INFINITY;
    for segment in outline.segments() {
        let off = |u: f64| (segment.at(u).point - point).norm();
        let looks: Vec<f64> = (0..=16).map(|i| off(-1.0 + 0.125 * f64::from(i))).collect();
        let (i, _) = looks
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(b.1))
            .expect("looks");
        if looks[i] > best + 2.0 {
            continue;
        }
        let at = |i: usize| -1.0 + 0.125 * i as f64;
        let (_, value) = bracketed_minimum(off, at(i.saturating_sub(1)), at((i + 1).min(16)));
        best = best.min(value).min(looks[i]);
    }
    best
}

#[test]
fn a_roller_always_touches_the_profile_and_never_enters_it() {
    for cam in cams() {
        let Some(radius) = cam.follower().roller_radius() else {
            continue;
        };
        let profile = cam.profile(fine()).expect("sound");
        assert_eq!(profile.undercut(), []);
        assert!(profile.outline().is_counter_clockwise());
        assert_eq!(profile.outline().crossing(), None);
        for i in 0..60 {
            let input = TAU * (f64::from(i) + 0.31) / 60.0;
            let contact = cam.contact(input);
            let center = contact.roller.expect("a roller");
            let found = distance(profile.outline(), center);
            assert!(
                (found - radius).abs() < 1e-9,
                "{:?} {input}: {found}",
                cam.follower()
            );
            assert!((contact.point + contact.normal * radius - center).norm() < 1e-12);
            assert!(radius == 0.0 || !profile.outline().contains(center));
        }
    }
}

#[test]
fn a_flat_face_always_touches_the_profile_and_never_enters_it() {
    for cam in cams() {
        if cam.follower().roller_radius().is_some() {
            continue;
        }
        let profile = cam.profile(fine()).expect("sound");
        assert_eq!(profile.undercut(), []);
        let segments = profile.outline().segments();
        for i in 0..60 {
            let contact = cam.contact(TAU * (f64::from(i) + 0.31) / 60.0);
            let height = contact.normal.dot(&contact.point.coords);
            let mut highest = f64::NEG_INFINITY;
            for segment in segments {
                let below = |u: f64| -contact.normal.dot(&segment.at(u).point.coords);
                for k in 0..8 {
                    let (low, high) = (-1.0 + 0.25 * f64::from(k), -0.75 + 0.25 * f64::from(k));
                    highest = highest.max(-bracketed_minimum(below, low, high).1);
                }
            }
            assert!((highest - height).abs() < 1e-9, "{:?}", cam.follower());
        }
    }
}

#[test]
fn a_flat_follower_stands_where_its_motion_says() {
    for cam in cams() {
        let contact = cam.contact(1.7);
        let angle = -cam.rotation().sign() * 1.7;
        match cam.follower() {
            Follower::TranslatingFlat(_) => {
                let out = Vector::new(angle.cos(), angle.sin());
                let height = 40.0 + contact.motion.position;
                assert!((contact.point.coords.dot(&out) - height).abs() < 1e-12);
                assert!((contact.normal - out).norm() < 1e-14);
                assert!(contact.pressure_angle.abs() < 1e-14);
            }
            Follower::SwingingFlat(follower) => {
                // The face is a line at its offset from the pivot, at the arm's angle to the centre line.
                let pivot = Point::new(angle.cos(), angle.sin()) * 90.0;
                let before = (pivot - contact.point).dot(&contact.normal);
                assert!((before - follower.face_offset).abs() < 1e-12);
                let along = Vector::new(contact.normal.y, -contact.normal.x);
                let to_axis = -pivot.coords.normalize();
                let arm = cam.start_angle() + contact.motion.position;
                assert!((along.dot(&to_axis).abs() - arm.cos()).abs() < 1e-12);
                assert!(
                    ((contact.point - pivot).norm()
                        - contact.face.expect("flat").hypot(follower.face_offset))
                    .abs()
                        < 1e-12
                );
            }
            _ => {}
        }
    }
}

#[test]
fn normals_curvature_and_pressure_angle_match_differences() {
    let h = 1e-5;
    for cam in cams() {
        if cam.follower().roller_radius() == Some(0.0) {
            continue;
        }
        for i in 0..40 {
            let input = TAU * (f64::from(i) + 0.37) / 40.0;
            let [before, at, after] = [-h, 0.0, h].map(|d| cam.contact(input + d));
            let step = after.point - before.point;
            // The normal is perpendicular to the profile, and turns along it at the rate given by the curvature.
            assert!(
                step.dot(&at.normal).abs() < 1e-9,
                "{:?} {input}",
                cam.follower()
            );
            let turn = before.normal.perp(&after.normal);
            let along = step.dot(&Vector::new(-at.normal.y, at.normal.x));
            assert!(
                (turn - at.curvature * along).abs() < 1e-8,
                "{:?} {input}",
                cam.follower()
            );
            // Without friction the cam's work is the follower's: the moment of the normal about the
            // axis over its share along the lift is the follower's velocity by the cam angle.
            let moment = -at.normal.perp(&at.point.coords);
            let lever = match cam.follower() {
                Follower::SwingingRoller(follower) => follower.arm_length,
                Follower::SwingingFlat(follower) => {
                    at.face.expect("flat").hypot(follower.face_offset)
                }
                _ => 1.0,
            };
            let force = at.pressure_angle.cos() * lever;
            let gained = cam.rotation().sign() * moment;
            assert!(
                (gained - at.motion.velocity * force).abs() < 1e-10,
                "{:?}",
                cam.follower()
            );
        }
    }
}

#[test]
fn the_pressure_angle_of_a_slide_is_the_textbooks() {
    for rotation in [Turn::CounterClockwise, Turn::Clockwise] {
        let follower = Follower::TranslatingRoller(TranslatingRoller {
            roller_radius: 8.0,
            offset: 5.0,
        });
        let mut spec = CamSpec::new(32.0, follower, motion(10.0, false, 70.0));
        spec.rotation = rotation;
        let cam = DiscCam::resolve(&spec).expect("sound");
        for i in 0..50 {
            let contact = cam.contact(0.1 + f64::from(i) / 8.0);
            // tan alpha = (s' - e) / (d + s), e positive on the side the cam comes from.
            let along = (40.0_f64 * 40.0 - 25.0).sqrt() + contact.motion.position;
            let tan = (contact.motion.velocity - rotation.sign() * -5.0) / along;
            assert!((contact.pressure_angle.tan().abs() - tan.abs()).abs() < 1e-12);
        }
    }
}

/// An eccentric circle under a flat face: simple harmonic motion.
#[test]
fn an_eccentric_circle_moves_a_flat_face_harmonically() {
    let eccentricity = 6.0;
    let harmonic = FromFn::new(TAU, 0.0, vec![], move |t: f64| MotionJet {
        position: eccentricity * (1.0 - t.cos()),
        velocity: eccentricity * t.sin(),
        acceleration: eccentricity * t.cos(),
        jerk: -eccentricity * t.sin(),
    });
    let follower = Follower::TranslatingFlat(TranslatingFlat {});
    let cam = DiscCam::new(Arc::new(harmonic), follower, 20.0, Turn::CounterClockwise);
    let cam = cam.expect("sound");
    let profile = cam.profile(fine()).expect("sound");
    // Radius base + e, centre at -e from the axis.
    let center = Point::new(-eccentricity, 0.0);
    for i in 0..100 {
        let contact = cam.contact(f64::from(i));
        assert!(((contact.point - center).norm() - 26.0).abs() < 1e-13);
        assert!((contact.curvature - 1.0 / 26.0).abs() < 1e-15);
    }
    assert!((profile.outline().area() - PI * 26.0 * 26.0).abs() < 1e-8);
    let limits = cam.limits();
    assert!((limits.minimum_radius.value - 26.0).abs() < 1e-12);
    let (low, high) = limits.face.expect("flat");
    assert!((low + 6.0).abs() < 1e-12 && (high - 6.0).abs() < 1e-12);
    assert!(limits.rise_pressure_angle.value < 1e-15);
}

/// An eccentric circle under a roller: the roller's centre runs on a circle about the cam's own centre.
#[test]
fn an_eccentric_circle_under_a_roller_is_found_again() {
    let (e, reach) = (5.0_f64, 30.0_f64);
    let slide = FromFn::new(TAU, 0.0, vec![], move |t: f64| {
        // d = sqrt(reach^2 - e^2 sin^2 t) - e cos t, from its minimum value reach - e.
        let (sin, cos) = t.sin_cos();
        let root = (reach * reach - e * e * sin * sin).sqrt();
        let (u, u1, u2) = (
            -e * e * sin * cos,
            -e * e * (cos * cos - sin * sin),
            4.0 * e * e * sin * cos,
        );
        let r1 = u / root;
        let r2 = (u1 - r1 * r1) / root;
        let r3 = (u2 - 3.0 * r1 * r2) / root;
        MotionJet {
            position: root - e * cos - (reach - e),
            velocity: r1 + e * sin,
            acceleration: r2 + e * cos,
            jerk: r3 - e * sin,
        }
    });
    let follower = Follower::TranslatingRoller(TranslatingRoller {
        roller_radius: 10.0,
        offset: 0.0,
    });
    let cam = DiscCam::new(Arc::new(slide), follower, reach - e - 10.0, Turn::Clockwise);
    let cam = cam.expect("sound");
    let center = Point::new(-e, 0.0);
    for i in 0..100 {
        let contact = cam.contact(f64::from(i));
        assert!(((contact.point - center).norm() - 20.0).abs() < 1e-12);
        assert!((contact.curvature - 0.05).abs() < 1e-14);
        let jet = cam.roller_center(f64::from(i)).expect("a roller");
        assert!((jet.curvature() - 1.0 / reach).abs() < 1e-14);
    }
    let limits = cam.limits();
    assert!((limits.largest_roller.expect("a roller").value - reach).abs() < 1e-10);
    // sin alpha = e sin t / reach at most.
    assert!((limits.rise_pressure_angle.value - (e / reach).asin()).abs() < 1e-12);
}

#[test]
fn no_lift_is_a_circle() {
    for follower in followers(Turn::Clockwise) {
        let still = MotionSpec {
            start: 0.0,
            segments: vec![SegmentSpec::Dwell(Dwell { span: TAU })],
        };
        let cam = DiscCam::resolve(&CamSpec::new(25.0, follower, still)).expect("sound");
        let profile = cam.profile(fine()).expect("sound");
        assert!((profile.outline().area() - PI * 625.0).abs() < 1e-9);
        assert!(profile.outline().segments().len() <= 4);
        let limits = cam.limits();
        assert!((limits.minimum_radius.value - 25.0).abs() < 1e-12);
        assert_eq!(limits.rise_pressure_angle.value, 0.0);
    }
}

#[test]
fn scaling_scales() {
    let k = 3.7;
    let spec = |k: f64| {
        let follower = Follower::TranslatingRoller(TranslatingRoller {
            roller_radius: 6.0 * k,
            offset: 3.0 * k,
        });
        CamSpec::new(30.0 * k, follower, motion(8.0 * k, false, 60.0))
    };
    let [one, other] = [1.0, k].map(|k| DiscCam::resolve(&spec(k)).expect("sound"));
    let [a, b] = [(&one, 1.0), (&other, k)].map(|(cam, k)| {
        let tolerance = fine().scaled(k);
        cam.profile(tolerance).expect("sound")
    });
    assert_eq!(a.outline().segments().len(), b.outline().segments().len());
    assert!((a.outline().area() * k * k / b.outline().area() - 1.0).abs() < 1e-12);
    let (a, b) = (one.limits(), other.limits());
    assert!((a.rise_pressure_angle.value - b.rise_pressure_angle.value).abs() < 1e-12);
    assert!((a.minimum_radius.value * k - b.minimum_radius.value).abs() < 1e-9);
    let [a, b] = [&one, &other].map(|cam| {
        cam.minimum_base_radius(30.0_f64.to_radians(), FRAC_PI_2)
            .expect("found")
    });
    assert!((a * k / b - 1.0).abs() < 1e-9);
}

#[test]
fn a_roller_larger_than_the_path_allows_undercuts() {
    let with = |radius: f64, base: f64| {
        let follower = Follower::TranslatingRoller(TranslatingRoller {
            roller_radius: radius,
            offset: 0.0,
        });
        let spec = CamSpec::new(base - radius, follower, motion(12.0, false, 40.0));
        DiscCam::resolve(&spec).expect("follows")
    };
    let largest = with(5.0, 30.0)
        .limits()
        .largest_roller
        .expect("a roller")
        .value;
    for (share, undercut) in [
        (0.999, false),
        (1.0001, true),
        (1.001, true),
        (1.01, true),
        (1.2, true),
    ] {
        let cam = with(share * largest, 30.0);
        let limits = cam.limits();
        assert_eq!(limits.regularity.value <= 0.0, undercut);
        assert_eq!(limits.minimum_radius.value <= 0.0, undercut);
        let profile = cam.profile(fine()).expect("there is one");
        assert_eq!(profile.outline().crossing(), None);
        assert_eq!(!profile.undercut().is_empty(), undercut, "{share}");
        for &(from, to) in profile.undercut() {
            assert!(from < limits.regularity.input && limits.regularity.input < to);
        }
    }
    // What is left of the profile no roller enters, and where nothing is lost each touches it.
    let cam = with(1.2 * largest, 30.0);
    let profile = cam.profile(fine()).expect("there is one");
    assert_eq!(profile.outline().crossing(), None);
    let radius = 1.2 * largest;
    let mut losses = 0;
    for i in 0..180 {
        let input = TAU * f64::from(i) / 180.0;
        let found = distance(
            profile.outline(),
            cam.contact(input).roller.expect("a roller"),
        );
        assert!(found > radius - 1e-9, "{input} {found}");
        if profile.is_undercut(input) {
            losses += 1;
            assert!(found > radius + 1e-9, "{input} {found}");
        } else {
            assert!(found < radius + 1e-9, "{input} {found}");
        }
    }
    assert!(losses > 3);
}

#[test]
fn the_least_base_circle_is_where_the_limit_is_met() {
    for cam in cams() {
        if cam.follower().roller_radius().is_none() || cam.rotation() == Turn::Clockwise {
            continue;
        }
        let required = 25.0_f64.to_radians();
        let Some(radius) = cam.minimum_base_radius(required, FRAC_PI_2) else {
            panic!("{:?}", cam.follower())
        };
        let minimum = cam.with_base_radius(radius).expect("sound").limits();
        assert!(
            (minimum.rise_pressure_angle.value - required).abs() < 1e-9,
            "{:?}",
            cam.follower()
        );
        let smaller = cam.with_base_radius(0.99 * radius).expect("sound").limits();
        assert!(smaller.rise_pressure_angle.value > required);
    }
    let follower = Follower::TranslatingFlat(TranslatingFlat {});
    let spec = CamSpec::new(90.0, follower, motion(10.0, false, 60.0));
    let cam = DiscCam::resolve(&spec).expect("sound");
    let radius = cam.minimum_regular_base_radius(2.0).expect("found");
    // rho = base + s + s''; s'' is smallest in the drop.
    let exact = cam.with_base_radius(radius).expect("sound").limits();
    assert!((exact.minimum_radius.value - 2.0).abs() < 1e-9);
    assert!((radius - 2.0 - (90.0 - cam.limits().minimum_radius.value)).abs() < 1e-9);
}

#[test]
fn a_motion_too_fast_for_a_contour_is_refused() {
    // 20,000 oscillations per turn: each takes segments of its own.
    let swings = 2e4;
    let motion = FromFn::new(TAU, 0.0, vec![], move |input: f64| {
        let (sin, cos) = (swings * input).sin_cos();
        MotionJet {
            position: 1e-6 * (1.0 - cos),
            velocity: 1e-6 * swings * sin,
            acceleration: 1e-6 * swings * swings * cos,
            jerk: -1e-6 * swings * swings * swings * sin,
        }
    });
    let follower = Follower::TranslatingRoller(TranslatingRoller::default());
    let cam = DiscCam::new(Arc::new(motion), follower, 30.0, Turn::Clockwise).expect("a cam");
    let found = cam.profile(fine());
    assert!(
        matches!(found, Err(CamError::Wild { degrees: 0.0, .. })),
        "{found:?}"
    );
}

#[test]
fn followers_that_cannot_follow_are_refused() {
    let sliding = |follower, base, stroke, drop| {
        DiscCam::resolve(&CamSpec::new(base, follower, motion(stroke, false, drop))).map(|_| ())
    };
    let swinging = |follower, base, stroke, drop| {
        DiscCam::resolve(&CamSpec::new(base, follower, motion(stroke, true, drop))).map(|_| ())
    };
    let roller = |offset| {
        Follower::TranslatingRoller(TranslatingRoller {
            roller_radius: 5.0,
            offset,
        })
    };
    assert!(matches!(
        sliding(roller(25.0), 20.0, 5.0, 60.0),
        Err(CamError::Offset { .. })
    ));
    let arm = |center_distance, arm_length| {
        Follower::SwingingRoller(SwingingRoller {
            roller_radius: 5.0,
            center_distance,
            arm_length,
            lifts: Turn::CounterClockwise,
        })
    };
    assert!(matches!(
        swinging(arm(80.0, 40.0), 20.0, 0.1, 60.0),
        Err(CamError::Reach { .. })
    ));
    assert!(matches!(
        swinging(arm(50.0, 40.0), 20.0, 3.0, 60.0),
        Err(CamError::ArmTurnsOver { .. })
    ));
    let face = Follower::SwingingFlat(SwingingFlat {
        center_distance: 60.0,
        lifts: Turn::Clockwise,
        ..SwingingFlat::default()
    });
    assert!(matches!(
        swinging(face, 20.0, 0.6, 12.0),
        Err(CamError::FaceTurnsBack { .. })
    ));
    let error = sliding(roller(0.0), -1.0, 5.0, 60.0).expect_err("refused");
    assert_eq!(error.key(), "base_radius");
    let wild = FromFn::new(TAU, 0.0, vec![], |_| MotionJet::at_rest(f64::NAN));
    assert!(matches!(
        DiscCam::new(Arc::new(wild), roller(0.0), 20.0, Turn::Clockwise).map(|_| ()),
        Err(CamError::NotFinite { .. })
    ));
    let half = FromFn::new(PI, 0.0, vec![], |_| MotionJet::default());
    assert!(matches!(
        DiscCam::new(Arc::new(half), roller(0.0), 20.0, Turn::Clockwise).map(|_| ()),
        Err(CamError::NotPeriodic { .. })
    ));
}

#[test]
fn each_segment_knows_the_inputs_it_serves() {
    for cam in cams() {
        let profile: Profile = cam.profile(fine()).expect("sound");
        let segments = profile.outline().segments();
        assert_eq!(segments.len(), profile.inputs().len());
        for (segment, &(from, to)) in segments.iter().zip(profile.inputs()) {
            let way = (to - from).signum();
            for (point, input) in [
                (segment.start(), from + 1e-12 * way),
                (segment.at(0.0).point, 0.5 * (from + to)),
                (segment.end(), to - 1e-12 * way),
            ] {
                assert!((cam.contact(input).point - point).norm() < 1e-9);
            }
        }
        let (minimum, maximum) = profile.radii();
        assert!((minimum - 40.0).abs() < 1e-9 && maximum > 43.0);
    }
}
