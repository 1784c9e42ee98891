use super::*;
use crate::pitch::{Bspline, PitchSpec, Polar};

#[test]
fn a_knot_where_the_cycle_starts_is_its_start_whatever_the_rounding() {
    for degree in 2..=5 {
        for count in 6..30 {
            let step = TAU / f64::from(count);
            let spline = Bspline {
                degree,
                interpolate: true,
                radius: (0..count).map(|i| 30.0 + f64::from(i * i % 7)).collect(),
                angle: (0..count).map(|i| step * f64::from(i)).collect(),
                ..Bspline::default()
            };
            let curve = PitchSpec::Bspline(spline).resolve().expect("a curve").curve;
            let rolling = Rolling::new(curve, (1, 1)).expect("rolls");
            let (start, end) = (rolling.start, rolling.start + f64::from(count));
            let frame = rolling.frame(Member::Driven, end);
            assert!((frame.arc / rolling.arc.total() - 1.0).abs() < 1e-15);
            assert!(frame.point.coords.norm().is_finite());
            // Between knots there is a whole span, or where the cycle starts inside one, two parts of it.
            let inside = rolling.breaks_between(start, end);
            let spans = inside.windows(2).map(|w| w[1] - w[0]);
            assert!(spans.clone().all(|s| (s - 1.0).abs() < 1e-9), "{inside:?}");
            let knot = degree % 2 == 1;
            assert_eq!(
                inside.len(),
                count as usize - usize::from(knot),
                "{degree} {count}"
            );
        }
    }
}

#[test]
fn pitch_curves_touch_where_their_frames_have_it() {
    for (expression, ratio) in [
        ("30 + 6*cos(2*phi) + sin(4*phi)", (1, 1)),
        ("20/(1 - 0.4*cos(2*phi))", (3, 2)),
    ] {
        let spec = PitchSpec::Polar(Polar {
            expression: Some(expression.into()),
            ..Polar::default()
        });
        let curve = spec.resolve().expect("a curve").curve;
        let rolling = Rolling::new(curve, ratio).expect("rolls");
        let [mut minimum, mut maximum] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for i in -40..90 {
            let t = 0.0713 * f64::from(i);
            let contact = rolling.pitch_contact(t);
            let frames = [Member::Driver, Member::Driven].map(|m| rolling.frame(m, t));
            let curvatures = rolling.curvatures(t);
            for (k, frame) in frames.iter().enumerate() {
                assert!((frame.point.coords.norm() - contact.radii[k]).abs() < 1e-12);
                assert!((frame.curvature - curvatures[k]).abs() < 1e-13);
                minimum[k] = minimum[k].min(curvatures[k]);
                maximum[k] = maximum[k].max(curvatures[k]);
            }
            let [driver, _] = &frames;
            assert!((contact.direction * contact.radii[0] - driver.point.coords).norm() < 1e-12);
            assert!((contact.input - rolling.angle(t)).abs() < 1e-14);
            assert!((contact.driven_angle - rolling.driven_angle_at(t)).abs() < 1e-14);
            let (cos, sin) = contact.inclination;
            assert!((cos - contact.direction.perp(&driver.tangent)).abs() < 1e-14);
            assert!((sin - contact.direction.dot(&driver.tangent)).abs() < 1e-14);
            assert!((contact.ratio() - rolling.ratio(contact.input)).abs() < 1e-13);
        }
        for (k, range) in rolling.curvature_ranges().iter().enumerate() {
            assert!(range.minimum.1 <= minimum[k] && maximum[k] <= range.maximum.1);
            assert!(range.maximum.1 - maximum[k] < 0.01 * (range.maximum.1 - range.minimum.1));
        }
    }
}

/// Pitch curves of a radius by formula.
fn polar(expression: &str) -> Result<Rolling, RollingError> {
    let spec = PitchSpec::Polar(Polar {
        expression: Some(expression.into()),
        ..Polar::default()
    });
    Rolling::new(spec.resolve().expect("a curve").curve, (1, 1))
}

#[test]
fn a_radius_swings_once_a_wave() {
    for (expression, swings) in [
        ("30", 0),
        ("30 + 0.00000001*cos(5*phi)", 0),
        ("30 + cos(phi)", 1),
        ("30 + 0.001*cos(200*phi)", 200),
        ("30 + 6*cos(2*phi) + 2*sin(4*phi)", 4),
        ("20/(1 - 0.3*cos(phi)) + 0.0001*cos(500*phi)", 500),
    ] {
        let found = polar(expression).expect("rolls").swings();
        assert_eq!(found, swings, "{expression}");
    }
}

#[test]
fn bumps_that_lie_between_the_nodes_of_a_whole_turn_count() {
    let rolling = polar("1 + 0.0001*exp(-700*(1 - cos(5*phi)))").expect("rolls");
    // Of the driver 5 bumps of the area of a bell, whose width is 1/(5 sqrt(700)): by a sum over even places, which is
    // exact for what repeats.
    let law = |phi: f64| 1.0 + 0.0001 * (-700.0 * (1.0 - (5.0 * phi).cos())).exp();
    let slope = |phi: f64| {
        -0.0001 * 3500.0 * (5.0 * phi).sin() * (-700.0 * (1.0 - (5.0 * phi).cos())).exp()
    };
    let places = 20_000;
    let sum: f64 = (0..places)
        .map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(places))
        .map(|phi| law(phi).hypot(slope(phi)))
        .sum();
    let length = sum * std::f64::consts::TAU / f64::from(places);
    let found = rolling.pitch_length(Member::Driver) / rolling.radius(0.3) * law(0.3);
    assert!((found / length - 1.0).abs() < 1e-13, "{found} {length}");
    // The law keeps step: a fifth of a turn is one of the driven gear, too.
    for fifth in 1..5 {
        let phi = std::f64::consts::TAU * f64::from(fifth) / 5.0;
        assert!((rolling.driven_angle(phi) - phi).abs() < 1e-13, "{fifth}");
    }
}

#[test]
fn a_pitch_curve_that_swings_too_often_to_be_followed_is_refused() {
    assert!(polar("30 + 0.001*cos(1003*phi)").is_ok());
    for waves in ["20001", "1000003"] {
        let refused = polar(&format!("30 + 0.001*cos({waves}*phi)"));
        let Err(RollingError::Unsettled { unsettled, most }) = refused else {
            panic!("{waves}: {refused:?}");
        };
        assert!(unsettled > most, "{waves}: {unsettled}");
    }
    // A spike and a handful of kinks are.
    assert!(polar("30 + 0.1*exp(-(1000*(phi - 2))^2)").is_ok());
    assert!(polar("30 + 0.1*sqrt(sin(3*phi + 1)^2)").is_ok());
}
