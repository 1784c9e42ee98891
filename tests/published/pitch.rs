use std::f64::consts::{PI, TAU};

use centrode_gear::pitch::{Bspline, Ellipse, LobedEllipse, Pitch, PitchSpec, Plane};
use centrode_geometry::{Antiderivative, Curve};

use crate::data::{EllipticPair, LobedPair, TransplanterPair, cases};

/// Ends of the analytic pieces over one period.
fn ends(curve: &dyn Curve) -> Vec<f64> {
    let mut ends = curve.breaks();
    if ends.first() != Some(&0.0) {
        ends.insert(0, 0.0);
    }
    ends.push(curve.period());
    ends
}

fn assert_perimeter(pitch: &Pitch, goal: f64) {
    let curve = pitch.curve.as_ref();
    let length = Antiderivative::new(|t| curve.at(t).first.norm(), &ends(curve)).total();
    assert!((length - goal).abs() < 1e-12 * goal, "{length} {goal}");
}

/// Driven turn for one turn of the driver, at the given centre distance.
fn driven_turn(pitch: &Pitch, a: f64) -> Antiderivative {
    let curve = pitch.curve.as_ref();
    Antiderivative::new(
        |t| {
            let jet = curve.at(t);
            let r = jet.point.coords.norm();
            jet.point.coords.perp(&jet.first) / (r * (a - r))
        },
        &ends(curve),
    )
}

#[test]
fn elliptic_pair_of_2018() {
    for case in cases::<EllipticPair>("elliptic_pair") {
        let pitch = PitchSpec::Ellipse(Ellipse {
            eccentricity: case.eccentricity,
            module: Some(case.module),
            tooth_count: Some(case.tooth_count),
            ..Ellipse::default()
        })
        .resolve()
        .expect("the pair exists");
        assert_perimeter(&pitch, case.perimeter);
        let (far, near) = (pitch.curve.at(0.0), pitch.curve.at(PI));
        assert!((far.point.x - case.maximum_radius).abs() < 1e-12);
        assert!((near.point.x + case.minimum_radius).abs() < 1e-12);
        assert!((1.0 / far.curvature() - case.minimum_curvature_radius).abs() < 1e-11);
        let turn = driven_turn(&pitch, case.center_distance);
        assert!((turn.total() - TAU).abs() < 1e-12);
        for [phi, driven] in case.driven_angle {
            assert!((turn.at(phi) - driven).abs() < 1e-12, "at {phi}");
        }
    }
}

#[test]
fn transplanter_pair_of_2021() {
    for case in cases::<TransplanterPair>("transplanter_pair") {
        let angle: Vec<f64> = case.angle_deg.iter().map(|a| a.to_radians()).collect();
        let along = |f: fn(f64) -> f64| {
            let points = case.radius.iter().zip(&angle);
            points.map(|(r, a)| r * f(*a)).collect()
        };
        let mut spec = Bspline {
            degree: case.degree,
            ..Bspline::default()
        };
        if case.plane == "polar" {
            (spec.radius, spec.angle) = (case.radius.clone(), angle.clone());
        } else {
            spec.plane = Plane::Cartesian;
            (spec.x, spec.y) = (along(f64::cos), along(f64::sin));
        }
        let pitch = PitchSpec::Bspline(spec).resolve().expect("it goes round");
        assert_perimeter(&pitch, case.perimeter);
        let turn = driven_turn(&pitch, case.center_distance);
        assert!((turn.total() - TAU).abs() < 1e-12);
        let (curve, period) = (pitch.curve.as_ref(), pitch.curve.period());
        let start = parameter(curve, 0.0);
        for [phi, radius, driven] in case.driven_angle {
            let t = parameter(curve, phi);
            assert!((curve.at(t).point.coords.norm() - radius).abs() < 1e-11);
            let past = turn.at(t.rem_euclid(period)) - turn.at(start.rem_euclid(period));
            assert!((past.rem_euclid(TAU) - driven).abs() < 1e-12, "at {phi}");
        }
    }
}

/// The parameter at a polar angle, by Newton from a scan.
fn parameter(curve: &dyn Curve, phi: f64) -> f64 {
    let away = |t: f64| {
        let p = curve.at(t).point;
        (p.y.atan2(p.x) - phi + PI).rem_euclid(TAU) - PI
    };
    let count = 2000;
    let step = curve.period() / f64::from(count);
    let mut t = (0..count)
        .map(|i| f64::from(i) * step)
        .min_by(|a, b| away(*a).abs().total_cmp(&away(*b).abs()))
        .expect("two thousand of them");
    for _ in 0..30 {
        let jet = curve.at(t);
        let rate = jet.point.coords.perp(&jet.first) / jet.point.coords.norm_squared();
        t -= away(t) / rate;
    }
    assert!(away(t).abs() < 1e-13);
    t
}

#[test]
fn lobed_pairs_of_every_mean_ratio() {
    let mut tried = 0;
    for case in cases::<LobedPair>("lobed_pairs") {
        if case.kind != "lobed-ellipse" {
            continue;
        }
        let pitch = PitchSpec::LobedEllipse(LobedEllipse {
            lobes: case.lobes,
            eccentricity: case.eccentricity,
            module: Some(case.module),
            tooth_count: Some(case.tooth_count),
            ..LobedEllipse::default()
        })
        .resolve()
        .expect("the pair exists");
        assert_perimeter(&pitch, case.perimeter);
        let far = pitch.curve.at(0.0).point.x;
        assert!((far - case.parameter / (1.0 - case.eccentricity)).abs() < 1e-11);
        let turn = driven_turn(&pitch, case.center_distance);
        let [n1, n2] = case.mean_ratio.map(f64::from);
        assert!((turn.total() - TAU * n2 / n1).abs() < 1e-12);
        for [phi, driven] in case.driven_angle {
            assert!((turn.at(phi) - driven).abs() < 1e-12, "at {phi}");
        }
        tried += 1;
    }
    assert_eq!(tried, 6, "cases of this kind");
}
