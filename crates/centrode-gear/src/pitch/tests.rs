use super::*;
use centrode_geometry::Jet;
use proptest::prelude::*;

const ANGLE: [f64; 12] = [
    20., 45., 76., 105., 132., 165., 195., 225., 255., 285., 316., 345.,
];
const RADIUS: [f64; 12] = [21., 28., 50., 49., 58., 47., 18., 12., 28., 60., 48., 24.];

fn published(degree: u32) -> Bspline {
    Bspline {
        degree,
        radius: RADIUS.to_vec(),
        angle: ANGLE.map(f64::to_radians).to_vec(),
        ..Bspline::default()
    }
}

fn cartesian(radius: impl Fn(usize) -> f64, count: usize) -> (Vec<f64>, Vec<f64>) {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
    (0..count)
        .map(|i| (radius(i) * angle(i).cos(), radius(i) * angle(i).sin()))
        .unzip()
}

fn length(pitch: &Pitch) -> f64 {
    perimeter(pitch.curve.as_ref())
}

fn resolve(spec: &PitchSpec) -> Pitch {
    spec.resolve().expect("a good design")
}

fn error(spec: &PitchSpec) -> PitchError {
    spec.resolve().expect_err("a bad design")
}

/// One good description of every kind and every way to write it.
fn every_kind() -> Vec<PitchSpec> {
    let wave = |n: usize, c: f64| -> Vec<f64> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| 20.0 + c * angle(i).cos()).collect()
    };
    let mut all = vec![
        PitchSpec::Circle(Circle {
            radius: Some(20.0),
            ..Circle::default()
        }),
        PitchSpec::EccentricCircle(EccentricCircle {
            eccentricity: 0.4,
            radius: Some(20.0),
            ..EccentricCircle::default()
        }),
        PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.5,
            semi_major_axis: Some(20.0),
            ..Ellipse::default()
        }),
        PitchSpec::LobedEllipse(LobedEllipse {
            lobes: 3,
            eccentricity: 0.2,
            semi_major_axis: Some(20.0),
            ..LobedEllipse::default()
        }),
        PitchSpec::Limacon(Limacon {
            mean_radius: 20.0,
            amplitude: 5.0,
            lobes: 2,
            ..Limacon::default()
        }),
        PitchSpec::Polar(Polar::expression("20 + 3*cos(2*phi) + sin(phi)^3")),
        PitchSpec::Polar(Polar::expression("20 + 0.01*phi*(2*pi - phi)")),
        PitchSpec::Polar(Polar {
            mean: Some(20.0),
            cos: vec![1.0, 0.5],
            sin: vec![0.0, 0.3, 0.2],
            ..Polar::default()
        }),
        PitchSpec::Polar(Polar {
            radius: RADIUS.map(|r| 20.0 + 0.1 * r).to_vec(),
            angle: ANGLE.map(|a| (a - 100.0).to_radians()).to_vec(),
            ..Polar::default()
        }),
        PitchSpec::Transmission(Transmission {
            center_distance: Some(40.0),
            ..Transmission::expression("phi - 0.08*sin(2*phi)")
        }),
        PitchSpec::Transmission(Transmission {
            center_distance: Some(40.0),
            driven_angle: (0..=24)
                .map(|i| f64::from(i) * PI / 12.0)
                .map(|t| 0.5 * t - 0.1 * t.sin())
                .collect(),
            ..Transmission::default()
        }),
        PitchSpec::Ratio(Ratio {
            center_distance: Some(40.0),
            ..Ratio::expression("2/3 + 0.1*cos(phi)")
        }),
        PitchSpec::Ratio(Ratio {
            center_distance: Some(40.0),
            ratio: wave(24, 2.0).iter().map(|r| r / 10.0).collect(),
            ..Ratio::default()
        }),
    ];
    for interpolation in [
        Interpolation::Cubic,
        Interpolation::Quintic,
        Interpolation::Trigonometric,
    ] {
        all.push(PitchSpec::Polar(Polar {
            radius: wave(20, 4.0),
            interpolation: Some(interpolation),
            ..Polar::default()
        }));
    }
    let (x, y) = cartesian(|i| 20.0 + (i % 3) as f64, 12);
    for degree in 1..=5 {
        for interpolate in [false, true] {
            all.push(PitchSpec::Bspline(Bspline {
                interpolate,
                radius: wave(12, 4.0),
                ..published(degree)
            }));
            all.push(PitchSpec::Bspline(Bspline {
                plane: Plane::Cartesian,
                degree,
                interpolate,
                x: x.clone(),
                y: y.clone(),
                ..Bspline::default()
            }));
        }
        let count = 5 * degree as usize;
        let (x, y) = cartesian(|i| 20.0 + (i % 2) as f64, count);
        all.push(PitchSpec::Bezier(Bezier {
            plane: Plane::Cartesian,
            degree,
            x,
            y,
            ..Bezier::default()
        }));
        all.push(PitchSpec::Bezier(Bezier {
            degree,
            radius: wave(count, 3.0),
            angle: (0..count).map(|i| 6.0 * i as f64 / count as f64).collect(),
            ..Bezier::default()
        }));
    }
    all
}

#[test]
fn the_elliptic_pair_of_2018() {
    let pitch = resolve(&PitchSpec::Ellipse(Ellipse {
        eccentricity: 1.0 / (2.0 + 3.0_f64.sqrt()),
        module: Some(2.25),
        tooth_count: Some(23),
        ..Ellipse::default()
    }));
    assert!((length(&pitch) - 162.577_420).abs() < 5e-7);
    let far = pitch.curve.at(0.0).point;
    let near = pitch.curve.at(PI).point;
    assert!((far.x - 33.416_307).abs() < 5e-7 && (near.x + 19.292_914).abs() < 5e-7);
}

#[test]
fn the_control_points_of_2021() {
    let quadratic = resolve(&PitchSpec::Bspline(published(2)));
    assert!((length(&quadratic) - 291.330_811).abs() < 5e-7);
    let cubic = resolve(&PitchSpec::Bspline(published(3)));
    assert!((length(&cubic) - 285.018_587).abs() < 5e-7);
    let (x, y) = ANGLE
        .iter()
        .zip(RADIUS)
        .map(|(a, r)| (r * a.to_radians().cos(), r * a.to_radians().sin()))
        .unzip();
    let cartesian = resolve(&PitchSpec::Bspline(Bspline {
        plane: Plane::Cartesian,
        x,
        y,
        ..Bspline::default()
    }));
    assert!((length(&cartesian) - 264.237).abs() < 5e-4);
}

#[test]
fn derivatives_agree_with_differences_for_every_kind() {
    for spec in every_kind() {
        let curve = resolve(&spec).curve;
        let ends = proof::piece_ends(curve.as_ref());
        for w in ends.windows(2) {
            for k in 1..10 {
                let h = 1e-4 * (w[1] - w[0]);
                let t = w[0] + (w[1] - w[0]) * f64::from(k) / 10.0;
                let [low, at, high] = [t - h, t, t + h].map(|t| curve.at(t));
                let rows = |j: &Jet| [j.point.coords, j.first, j.second, j.third];
                for order in 0..3 {
                    let slope = (rows(&high)[order] - rows(&low)[order]) / (2.0 * h);
                    let exact = rows(&at)[order + 1];
                    let miss = (slope - exact).norm();
                    assert!(
                        miss < 2e-5 * (20.0 + exact.norm()),
                        "{spec:?} at {t}: {miss}"
                    );
                }
            }
        }
    }
}

#[test]
fn every_kind_is_periodic_and_joins_at_its_breaks() {
    for spec in every_kind() {
        let curve = resolve(&spec).curve;
        for t in proof::piece_ends(curve.as_ref()) {
            let before = if t == 0.0 { curve.period() } else { t }.next_down();
            let gap = (curve.at(t).point - curve.at(before).point).norm();
            assert!(
                gap < 1e-12 * 40.0 * curve.period(),
                "{spec:?} at {t}: {gap}"
            );
        }
        for t in [0.3, 1.7] {
            let next = curve.at(t + curve.period()).point;
            assert!((curve.at(t).point - next).norm() < 1e-12, "{spec:?}");
        }
    }
}

#[test]
fn interpolated_curves_pass_through_their_points() {
    for degree in 1..=5 {
        let curve = resolve(&PitchSpec::Bspline(Bspline {
            interpolate: true,
            radius: RADIUS.map(|r| 40.0 + 0.3 * r).to_vec(),
            ..published(degree)
        }))
        .curve;
        let offset = if degree % 2 == 1 { 0.0 } else { 0.5 };
        for (i, (a, r)) in ANGLE.iter().zip(RADIUS).enumerate() {
            let p = curve.at(i as f64 + offset).point;
            assert!((p.coords.norm() - (40.0 + 0.3 * r)).abs() < 1e-12);
            let angle = p.y.atan2(p.x).rem_euclid(2.0 * PI);
            assert!((angle - a.to_radians()).abs() < 1e-13);
        }
    }
    for interpolation in [
        Interpolation::Cubic,
        Interpolation::Quintic,
        Interpolation::Trigonometric,
    ] {
        let curve = resolve(&PitchSpec::Polar(Polar {
            radius: RADIUS.map(|r| 40.0 + 0.3 * r).to_vec(),
            interpolation: Some(interpolation),
            ..Polar::default()
        }))
        .curve;
        for (i, r) in RADIUS.iter().enumerate() {
            let p = curve.at(i as f64 * PI / 6.0).point;
            assert!((p.coords.norm() - (40.0 + 0.3 * r)).abs() < 1e-12);
        }
    }
    let curve = resolve(&every_kind()[8]).curve;
    for (a, r) in ANGLE.iter().zip(RADIUS) {
        let p = curve.at((a - 100.0).to_radians()).point;
        assert!((p.coords.norm() - (20.0 + 0.1 * r)).abs() < 1e-12);
    }
}

#[test]
fn a_law_and_its_derivative_give_the_same_curve() {
    let law = PitchSpec::Transmission(Transmission {
        module: Some(1.5),
        tooth_count: Some(24),
        ..Transmission::expression("phi - 0.08*sin(2*phi)")
    });
    let ratio = PitchSpec::Ratio(Ratio {
        module: Some(1.5),
        tooth_count: Some(24),
        ..Ratio::expression("1 - 0.16*cos(2*phi)")
    });
    let (law, ratio) = (resolve(&law), resolve(&ratio));
    assert_eq!(law.implied_ratio, Some((1, 1)));
    assert_eq!(ratio.implied_ratio, Some((1, 1)));
    for i in 0..100 {
        let t = 0.0628 * f64::from(i);
        assert!((law.curve.at(t).point - ratio.curve.at(t).point).norm() < 1e-13);
    }
    assert_eq!(resolve(&every_kind()[10]).implied_ratio, Some((2, 1)));
    assert_eq!(resolve(&every_kind()[11]).implied_ratio, Some((3, 2)));
    assert_eq!(resolve(&every_kind()[12]).implied_ratio, Some((1, 2)));
}

#[test]
fn module_and_tooth_count_set_the_length() {
    let spec = PitchSpec::Polar(Polar {
        module: Some(1.5),
        tooth_count: Some(24),
        ..Polar::expression("1 + 0.08*cos(2*phi)")
    });
    assert!((length(&resolve(&spec)) - PI * 36.0).abs() < 1e-12);
    let mut spec = published(2);
    spec.tooth_count = Some(37);
    let pitch = resolve(&PitchSpec::Bspline(spec));
    let module = pitch.module.expect("follows");
    assert!((module * PI * 37.0 - 291.330_811).abs() < 5e-7);
}

#[test]
fn a_diametral_pitch_is_a_module() {
    for kind in [
        "kind = \"circle\"",
        "kind = \"eccentric-circle\"\neccentricity = 0.2",
        "kind = \"ellipse\"\neccentricity = 0.3",
        "kind = \"lobed-ellipse\"\nlobes = 2\neccentricity = 0.2",
        "kind = \"limacon\"\nmean_radius = 20\namplitude = 3",
        "kind = \"bspline\"\nradius = [20, 22, 20, 22]\nangle_deg = [0, 90, 180, 270]",
        "kind = \"bezier\"\ndegree = 1\nradius = [20, 22, 20, 22]\nangle_deg = [0, 90, 180, 270]",
        "kind = \"polar\"\nexpression = \"1 + 0.1*cos(2*phi)\"",
        "kind = \"transmission\"\nexpression = \"phi - 0.08*sin(2*phi)\"",
        "kind = \"ratio\"\nexpression = \"1 - 0.16*cos(2*phi)\"",
        "kind = \"conjugate\"\nof = { kind = \"circle\", radius = 20 }",
    ] {
        let of =
            |size: &str| -> PitchSpec { toml::from_str(&format!("{size}\n{kind}")).expect(kind) };
        let written = of("diametral_pitch = 16\ntooth_count = 40");
        let (inch, metric) = (
            resolve(&written),
            resolve(&of("module = 1.5875\ntooth_count = 40")),
        );
        assert_eq!(inch.module, Some(25.4 / 16.0), "{kind}");
        assert_eq!(inch.definition, metric.definition);
        for i in 0..8 {
            let t = 0.125 * f64::from(i) * inch.curve.period();
            assert_eq!(inch.curve.at(t).point, metric.curve.at(t).point, "{kind}");
        }
        // More teeth on a curve of the same size.
        let mut more = written.clone();
        more.set_tooth_count(50);
        assert_eq!(resolve(&more).module, Some(25.4 / 20.0), "{kind}");
        for (size, message) in [
            (
                "module = 2\ndiametral_pitch = 16\ntooth_count = 40",
                "cannot be given together with module",
            ),
            ("diametral_pitch = 0\ntooth_count = 40", "greater than 0"),
            ("diametral_pitch = -16\ntooth_count = 40", "greater than 0"),
            ("diametral_pitch = nan\ntooth_count = 40", "finite"),
            (
                "diametral_pitch = 1e-60\ntooth_count = 40",
                "gives a pitch curve",
            ),
            ("diametral_pitch = 16", "given without tooth_count"),
        ] {
            let fault = error(&of(size));
            assert_eq!(fault.key(), "diametral_pitch", "{kind}: {fault}");
            assert!(fault.to_string().contains(message), "{kind}: {fault}");
        }
    }
    let twice = error(&PitchSpec::Circle(Circle {
        radius: Some(20.0),
        diametral_pitch: Some(16.0),
        tooth_count: Some(40),
        ..Circle::default()
    }));
    assert_eq!(twice, PitchError::SizeTwice("radius", "diametral_pitch"));
}

#[test]
fn faults_are_named_with_key_and_place() {
    let ellipse = |k: f64, m: f64, z: u32| {
        error(&PitchSpec::Ellipse(Ellipse {
            eccentricity: k,
            module: Some(m),
            tooth_count: Some(z),
            ..Ellipse::default()
        }))
    };
    assert_eq!(ellipse(1.0, 2.0, 20), PitchError::Eccentricity(1.0));
    assert_eq!(ellipse(0.2, 0.0, 20).key(), "module");
    assert_eq!(ellipse(0.2, f64::NAN, 20).key(), "module");
    assert_eq!(ellipse(0.2, 2.0, 2), PitchError::ToothCount(2));
    assert_eq!(ellipse(f64::NAN, 2.0, 20).key(), "eccentricity");

    let polar = |text: &str| error(&PitchSpec::Polar(Polar::expression(text)));
    for (text, expected) in [
        ("1 + 2*cos(phi)", "falls to -1.000000 mm at 180.000 deg"),
        ("1 + cos(phi)", "falls to 0"),
        ("1 + psi", "did you mean \"phi\"? at character 5"),
        ("1/phi", "at phi = 0.000 deg"),
        ("1 + 0.1/sin(phi - 1)", "falls to -"),
        ("1 + sqrt(sin(phi))", "phi"),
        ("1 + phi", "open"),
    ] {
        let error = polar(text);
        assert!(error.to_string().contains(expected), "{text}: {error}");
        assert_eq!(error.key(), "expression");
    }
    let noise = polar("1.001 + cos(1e6*phi)");
    assert!(matches!(noise, PitchError::TooRough { .. }), "{noise}");
    // A dip far narrower than the spacing of the first samples.
    let dip = polar("1 - 1.1*exp(-(40*(phi - 3.1234))^2)");
    assert!(
        matches!(dip, PitchError::RadiusNotPositive { angle, .. } if (angle - 178.957).abs() < 0.01)
    );

    let law = |text: &str| {
        error(&PitchSpec::Transmission(Transmission {
            center_distance: Some(40.0),
            ..Transmission::expression(text)
        }))
    };
    assert!(matches!(
        law("phi - 0.8*sin(2*phi)"),
        PitchError::RatioNotPositive { .. }
    ));
    assert!(
        matches!(law("phi + 0.8*sin(2*phi)"), PitchError::RatioNotPositive { angle, ratio, .. }
        if (ratio + 0.6).abs() < 1e-9 && (angle.rem_euclid(180.0) - 90.0).abs() < 1e-3)
    );
    assert!(matches!(law("-phi"), PitchError::RatioNotPositive { .. }));
    assert!(matches!(
        law("0.7123*phi"),
        PitchError::RatioNotRational { .. }
    ));
    assert!(matches!(
        law("phi + 0.01*phi^2"),
        PitchError::OpenCurve { .. }
    ));
    let no_size = error(&PitchSpec::Transmission(Transmission::expression("phi")));
    assert_eq!(no_size, PitchError::NoSize("center_distance"));
}

#[test]
fn faulty_points_are_named() {
    let (x, y) = cartesian(|_| 20.0, 12);
    let square = |x: Vec<f64>, y: Vec<f64>| {
        error(&PitchSpec::Bspline(Bspline {
            plane: Plane::Cartesian,
            x,
            y,
            ..Bspline::default()
        }))
    };
    let back: (Vec<f64>, Vec<f64>) = (
        x.iter().rev().copied().collect(),
        y.iter().rev().copied().collect(),
    );
    assert_eq!(square(back.0, back.1), PitchError::Clockwise { key: "x" });
    let aside = x.iter().map(|x| x + 100.0).collect();
    assert!(matches!(
        square(aside, y.clone()),
        PitchError::SelfCrossing { .. }
    ));
    let swapped = (
        [&x[..4], &[x[5], x[4]], &x[6..]].concat(),
        [&y[..4], &[y[5], y[4]], &y[6..]].concat(),
    );
    assert!(matches!(
        square(swapped.0, swapped.1),
        PitchError::SelfCrossing { .. }
    ));
    let twice = (
        [x.clone(), x.clone()].concat(),
        [y.clone(), y.clone()].concat(),
    );
    assert_eq!(
        square(twice.0, twice.1),
        PitchError::NotAroundAxis { key: "x", turns: 2 }
    );
    assert!(matches!(
        square(x.clone(), y[1..].to_vec()),
        PitchError::LengthMismatch { .. }
    ));
    assert!(matches!(
        square(vec![1.0; 3], vec![1.0; 3]),
        PitchError::TooFewPoints { .. }
    ));

    let mut spec = published(2);
    spec.angle.swap(3, 4);
    let crossing = error(&PitchSpec::Bspline(spec));
    assert!(
        matches!(crossing, PitchError::AnglesNotIncreasing { index: 4, .. }),
        "{crossing}"
    );
    let mut spec = published(2);
    spec.radius[3] = -1.0;
    assert_eq!(error(&PitchSpec::Bspline(spec)).key(), "radius");
    assert_eq!(error(&PitchSpec::Bspline(published(6))).key(), "degree");
    let many = Bspline {
        radius: vec![1.0; 10_001],
        ..Bspline::default()
    };
    assert!(matches!(
        error(&PitchSpec::Bspline(many)),
        PitchError::TooManyPoints { .. }
    ));
    // Through these points the curve itself turns back, though the points are in order.
    let overshoot = Bspline {
        interpolate: true,
        angle: [0.0, 1.0, 2.0, 100.0, 101.0, 102.0, 200.0, 201.0]
            .map(f64::to_radians)
            .to_vec(),
        radius: vec![20.0; 8],
        ..Bspline::default()
    };
    assert!(matches!(
        error(&PitchSpec::Bspline(overshoot)),
        PitchError::SelfCrossing { .. }
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_resolved_curve_goes_round_once(
        radius in prop::collection::vec(5.0..50.0_f64, 4..20),
        degree in 1_u32..=5,
        interpolate: bool,
        polar: bool,
    ) {
        let count = radius.len();
        let (x, y) = cartesian(|i| radius[i], count);
        let angle = (0..count).map(|i| std::f64::consts::TAU * i as f64 / count as f64).collect();
        let spec = if polar {
            Bspline { degree, interpolate, radius, angle, ..Bspline::default() }
        } else {
            Bspline { plane: Plane::Cartesian, degree, interpolate, x, y, ..Bspline::default() }
        };
        if let Ok(pitch) = PitchSpec::Bspline(spec).resolve() {
            let steps = 4000;
            let mut turned = 0.0;
            let mut before = pitch.curve.at(0.0).point;
            for i in 1..=steps {
                let p = pitch.curve.at(pitch.curve.period() * f64::from(i) / f64::from(steps)).point;
                let step = before.coords.perp(&p.coords).atan2(before.coords.dot(&p.coords));
                prop_assert!(step > 0.0);
                turned += step;
                before = p;
            }
            prop_assert!((turned - std::f64::consts::TAU).abs() < 1e-9);
        }
    }

    #[test]
    fn scale_is_carried_through(k in 0.01..100.0_f64, e in 0.0..0.9_f64) {
        let ellipse = |axis| resolve(&PitchSpec::Ellipse(Ellipse {
            eccentricity: e,
            semi_major_axis: Some(axis),
            ..Ellipse::default()
        })).curve;
        let (one, scaled) = (ellipse(1.0), ellipse(k));
        for i in 0..20 {
            let t = 0.314 * f64::from(i);
            let miss = (one.at(t).third * k - scaled.at(t).third).norm();
            prop_assert!(miss <= 1e-12 * scaled.at(t).third.norm());
        }
    }
}

#[test]
fn a_definition_in_words_tells_the_size() {
    let ellipse = Ellipse {
        eccentricity: 0.25,
        module: Some(2.0),
        tooth_count: Some(20),
        ..Ellipse::default()
    };
    let pitch = resolve(&PitchSpec::Ellipse(ellipse));
    let far = pitch.curve.at(0.0).point.coords.norm();
    let words = pitch.definition.rsplit("A = ").next().expect("its size");
    let stated: f64 = words.trim_end_matches(" mm").parse().expect("a number");
    // The far apex lies A (1 + k) from the focus.
    assert!((stated * 1.25 - far).abs() < 1e-8, "{}", pitch.definition);
    let polar = |expression: &str, module| {
        resolve(&PitchSpec::Polar(Polar {
            expression: Some(expression.into()),
            module,
            tooth_count: Some(20),
            ..Polar::default()
        }))
    };
    for expression in ["30 + 2*cos(phi)", "3e10 + 2e9*cos(phi)"] {
        let [written, scaled] = [None, Some(2.0)].map(|module| polar(expression, module));
        assert_eq!(written.definition, format!("polar, r = {expression}"));
        let factor = scaled.definition.rsplit("times ").next();
        let factor: f64 = factor.expect("its factor").parse().expect("a number");
        let ratio = length(&scaled) / length(&written);
        assert!((factor / ratio - 1.0).abs() < 1e-8, "{factor} {ratio}");
    }
}

/// Radius of three arcs `1 / (1 + e cos(n (phi - c)))`, scaled to meet each other, and the corners between them by closed form.
///
/// The slope of ln r is `n e sin / (1 + e cos)`.
fn joined(corners: [f64; 3], e: [f64; 3], n: f64) -> (impl Fn(f64) -> f64, Vec<SampledCorner>) {
    let corners = corners.map(f64::to_radians);
    let center = [1.9_f64, 0.4, 3.3];
    let shape = move |k: usize, phi: f64| 1.0 / (1.0 + e[k] * (n * (phi - center[k])).cos());
    let slope = move |k: usize, phi: f64| {
        let (sin, cos) = (n * (phi - center[k])).sin_cos();
        n * e[k] * sin / (1.0 + e[k] * cos)
    };
    let end = |k: usize| corners[(k + 1) % 3] + if k == 2 { std::f64::consts::TAU } else { 0.0 };
    // The last arc meets the first one by a factor that grows with the angle; its slope is a constant of ln r.
    let at = |k: usize| {
        if k == 2 {
            corners[0] + std::f64::consts::TAU
        } else {
            corners[k + 1]
        }
    };
    let mut size = [1.0; 3];
    for k in 0..2 {
        size[k + 1] = size[k] * shape(k, at(k)) / shape(k + 1, at(k));
    }
    let growth =
        (size[0] * shape(0, corners[0]) / (size[2] * shape(2, at(2)))).ln() / (end(2) - corners[2]);
    let radius = move |phi: f64| {
        let turned = (phi - corners[0]).rem_euclid(std::f64::consts::TAU) + corners[0];
        let k = (1..3).rev().find(|&k| turned >= corners[k]).unwrap_or(0);
        let grown = if k == 2 {
            (growth * (turned - corners[2])).exp()
        } else {
            1.0
        };
        40.0 * size[k] * shape(k, turned) * grown
    };
    let slopes = [
        (slope(2, at(2)) + growth, slope(0, corners[0])),
        (slope(0, corners[1]), slope(1, corners[1])),
        (slope(1, corners[2]), slope(2, corners[2]) + growth),
    ];
    let list = slopes
        .iter()
        .zip(corners)
        .map(|(&(before, after), angle)| SampledCorner {
            angle,
            turn: before.atan() - after.atan(),
        });
    (radius, list.collect())
}

#[test]
fn corners_of_samples_are_found_where_pieces_meet() {
    use std::f64::consts::TAU;
    // Corners at samples, between them and at the start of the turn; coarse and fine steps; convex and concave.
    for (corners, e, n, count) in [
        ([75.0, 135.0, 240.0], [0.1, -0.1, 0.05], 2.0, 72),
        ([75.0, 135.0, 240.0], [0.1, -0.1, 0.05], 2.0, 360),
        ([0.0, 90.0, 200.0], [0.2, 0.1, -0.1], 1.0, 72),
        ([0.0, 120.0, 240.0], [0.15, 0.0, 0.15], 2.0, 180),
        ([33.3, 151.7, 290.2], [0.1, 0.2, -0.2], 1.0, 120),
        ([10.0, 60.0, 300.0], [0.05, 0.1, 0.0], 3.0, 144),
        ([47.1, 171.9, 222.2], [0.3, 0.05, 0.1], 1.0, 200),
        ([20.0, 140.0, 260.0], [0.0, 0.2, 0.1], 2.0, 90),
        ([100.0, 190.0, 310.0], [0.1, 0.15, 0.0], 2.0, 1000),
        ([5.0, 125.0, 245.0], [0.25, -0.25, 0.1], 1.0, 96),
    ] {
        let (radius, expected) = joined(corners, e, n);
        let angles: Vec<f64> = (0..count)
            .map(|k| TAU * f64::from(k) / f64::from(count))
            .collect();
        let radii: Vec<f64> = angles.iter().map(|&phi| radius(phi)).collect();
        let even = Polar {
            radius: radii.clone(),
            ..Polar::default()
        };
        let uneven = Polar {
            angle: angles.clone(),
            ..even.clone()
        };
        // A ratio has the pitch curve r = a q / (1 + q).
        let ratio = Ratio {
            ratio: radii.iter().map(|r| r / (100.0 - r)).collect(),
            center_distance: Some(100.0),
            ..Ratio::default()
        };
        let points = Bspline {
            plane: Plane::Cartesian,
            interpolate: true,
            x: angles
                .iter()
                .zip(&radii)
                .map(|(a, r)| r * a.cos())
                .collect(),
            y: angles
                .iter()
                .zip(&radii)
                .map(|(a, r)| r * a.sin())
                .collect(),
            ..Bspline::default()
        };
        let of_kinds = [even.draft(None), uneven.draft(None), points.draft()];
        // The mean ratio need not be one of small numbers.
        let of_ratio = sampled::of_ratios(
            &table::Table::new("ratio", &[], &ratio.ratio)
                .expect("a table")
                .samples(),
        );
        // Coarse samples need not show weak corners.
        let weak = if count < 100 { 0.05 } else { 0.01 };
        let same = |one: &SampledCorner, other: &SampledCorner| {
            let off = (one.angle - other.angle + 1.0).rem_euclid(TAU) - 1.0;
            off.abs() < 0.03 * TAU / f64::from(count)
                && (one.turn - other.turn).abs() < 0.02 * other.turn.abs() + 3e-4
        };
        let drafts = of_kinds
            .into_iter()
            .map(|draft| draft.expect("a curve").sampled)
            .inspect(|sampled| assert_eq!(sampled.noise, None, "{corners:?} {count}"))
            .map(|sampled| sampled.corners);
        for found in drafts.chain([of_ratio]) {
            let is_real = |one: &SampledCorner| expected.iter().any(|other| same(one, other));
            assert!(
                found.iter().all(is_real),
                "{corners:?} {count}: {found:?} {expected:?}"
            );
            let is_found = |other: &SampledCorner| found.iter().any(|one| same(one, other));
            let mut strong = expected.iter().filter(|corner| corner.turn.abs() > weak);
            assert!(
                strong.all(is_found),
                "{corners:?} {count}: {found:?} {expected:?}"
            );
        }
    }
}

#[test]
fn samples_of_smooth_laws_have_no_corner() {
    use std::f64::consts::TAU;
    type Radius = fn(f64) -> f64;
    let laws: [Radius; 12] = [
        |_| 40.0,
        |t| 40.0 + 8.0 * t.cos(),
        |t| 40.0 + 4.0 * (5.0 * t).sin(),
        |t| 40.0 / (1.0 + 0.6 * t.cos()),
        |t| 40.0 / (1.0 - 0.4 * (2.0 * t).cos()),
        |t| 40.0 + 4.0 * (10.0 * (3.0 * t).sin()).tanh(),
        |t| 40.0 + 6.0 * (-8.0 * (1.0 - t.cos())).exp(),
        |t| 40.0 * (0.3 * (t + 0.4 * t.sin()).cos()).exp(),
        |t| 40.0 + 2.0 * (3.0 * t).cos() + 1.5 * (7.0 * t + 1.0).sin(),
        |t| (40.0 + 8.0 * t.cos() * (2.0 * t).sin()).sqrt(),
        // Written with three decimals.
        |t| (1e3 * (40.0 + 8.0 * t.cos())).round() / 1e3,
        |t| (1e3 * (40.0 + 4.0 * (5.0 * t).sin())).round() / 1e3,
    ];
    for (k, law) in laws.iter().enumerate() {
        for count in [6, 15, 36, 72, 90, 180, 360] {
            // Fewer show no more of ten waves in a turn than their sharpness.
            if k == 5 && count < 180 {
                continue;
            }
            let angles = (0..count).map(|k| TAU * f64::from(k) / f64::from(count));
            let radius: Vec<f64> = angles.map(law).collect();
            let draft = Polar {
                radius,
                ..Polar::default()
            }
            .draft(None)
            .expect("a curve");
            assert!(
                draft.sampled.corners.is_empty(),
                "law {k}, {count}: {:?}",
                draft.sampled.corners
            );
            assert_eq!(draft.sampled.noise, None, "law {k}, {count}");
        }
    }
}
