use std::f64::consts::{PI, TAU};

use centrode_gear::pitch::PitchSpec;
use centrode_geometry::{Antiderivative, Curve};
use centrode_tests::pitch;
use proptest::prelude::{prop_assert, proptest};

/// Ends of the analytic pieces over one period.
fn ends(curve: &dyn Curve) -> Vec<f64> {
    let mut ends = curve.breaks();
    if ends.first() != Some(&0.0) {
        ends.insert(0, 0.0);
    }
    ends.push(curve.period());
    ends
}

fn perimeter(curve: &dyn Curve) -> f64 {
    Antiderivative::new(|t| curve.at(t).first.norm(), &ends(curve)).total()
}

fn scaled(spec: &PitchSpec, factor: f64) -> PitchSpec {
    let mut out = spec.clone();
    let module = match &mut out {
        PitchSpec::Circle(spec) => &mut spec.module,
        PitchSpec::EccentricCircle(spec) => &mut spec.module,
        PitchSpec::Ellipse(spec) => &mut spec.module,
        PitchSpec::LobedEllipse(spec) => &mut spec.module,
        PitchSpec::Limacon(spec) => &mut spec.module,
        PitchSpec::Bspline(spec) => &mut spec.module,
        PitchSpec::Polar(spec) => &mut spec.module,
        PitchSpec::Transmission(spec) => &mut spec.module,
        other => unreachable!("no strategy makes {other:?}"),
    };
    *module = module.map(|m| m * factor);
    out
}

proptest! {
    #[test]
    fn the_length_is_pi_module_teeth(spec in pitch()) {
        let pitch = spec.resolve().expect("the strategy makes valid curves");
        let (m, z) = (pitch.module.expect("given"), pitch.tooth_count.expect("given"));
        let goal = PI * m * f64::from(z);
        prop_assert!((perimeter(pitch.curve.as_ref()) - goal).abs() <= 1e-12 * goal);
    }

    #[test]
    fn the_curve_goes_once_round_in_order(spec in pitch()) {
        let pitch = spec.resolve().expect("the strategy makes valid curves");
        let curve = pitch.curve.as_ref();
        let jet = |i: i32| curve.at(curve.period() * f64::from(i) / 720.0);
        let mut turned = 0.0;
        for i in 0..720 {
            let (here, next) = (jet(i), jet(i + 1));
            prop_assert!(here.point.coords.norm() > 0.0);
            prop_assert!(here.point.coords.perp(&here.first) > 0.0);
            let (a, b) = (here.point.coords, next.point.coords);
            turned += a.perp(&b).atan2(a.dot(&b));
        }
        prop_assert!((turned - TAU).abs() < 1e-9);
    }

    #[test]
    fn derivatives_are_those_of_the_point(spec in pitch(), at in 0.0..1.0_f64) {
        let pitch = spec.resolve().expect("the strategy makes valid curves");
        let curve = pitch.curve.as_ref();
        let t = at * curve.period();
        let step = 1e-5;
        // A centered difference must not straddle a break.
        if curve.breaks().iter().any(|b| (b - t).abs() < 2.0 * step) {
            return Ok(());
        }
        let (before, here, after) = (curve.at(t - step), curve.at(t), curve.at(t + step));
        let size = here.point.coords.norm() + here.third.norm();
        let first = (after.point - before.point) / (2.0 * step);
        let second = (after.first - before.first) / (2.0 * step);
        let third = (after.second - before.second) / (2.0 * step);
        prop_assert!((first - here.first).norm() < 1e-6 * size);
        prop_assert!((second - here.second).norm() < 1e-6 * size);
        prop_assert!((third - here.third).norm() < 1e-4 * size);
    }

    #[test]
    fn a_scaled_description_is_a_scaled_curve(spec in pitch(), k in 0.1..10.0_f64) {
        let one = spec.resolve().expect("the strategy makes valid curves");
        let other = scaled(&spec, k).resolve().expect("scaling keeps a curve valid");
        for i in 0..60 {
            let t = one.curve.period() * f64::from(i) / 60.0;
            let (a, b) = (one.curve.at(t).point.coords * k, other.curve.at(t).point.coords);
            prop_assert!((a - b).norm() <= 1e-12 * a.norm());
        }
    }
}
