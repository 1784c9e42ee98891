use std::f64::consts::PI;

use super::{CharacteristicValues, Law, LawSpec, Polynomial};

fn all() -> Vec<Law> {
    let wavy = Polynomial {
        start: vec![0.3, -1.0],
        end: vec![0.5, 2.0, 7.0],
    };
    LawSpec::NAMED
        .into_iter()
        .map(|(_, law)| law)
        .chain([LawSpec::Polynomial(wavy)])
        .map(|law| law.resolve().expect("sound"))
        .collect()
}

fn law(name: &str) -> Law {
    LawSpec::named(name)
        .expect("known")
        .resolve()
        .expect("sound")
}

#[test]
fn every_law_goes_from_zero_to_one_without_a_step() {
    for law in all() {
        assert!(law.at(0.0).position.abs() < 1e-15, "{}", law.name());
        assert!((law.at(1.0).position - 1.0).abs() < 1e-14, "{}", law.name());
        for x in law.breaks() {
            let (before, after) = (law.at(x.next_down()), law.at(x));
            assert!((before.position - after.position).abs() < 1e-14);
            assert!((before.velocity - after.velocity).abs() < 1e-13);
            if law.name() != "parabolic" {
                assert!((before.acceleration - after.acceleration).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn derivatives_match_differences() {
    let h = 1e-5;
    for law in all() {
        for i in 0..97 {
            let x = (f64::from(i) + 0.5) / 97.0;
            if law.breaks().iter().any(|b| (b - x).abs() <= 2.0 * h) {
                continue;
            }
            let (low, mid, high) = (law.at(x - h), law.at(x), law.at(x + h));
            let slope = |a: f64, b: f64| (b - a) / (2.0 * h);
            for (difference, exact) in [
                (slope(low.position, high.position), mid.velocity),
                (slope(low.velocity, high.velocity), mid.acceleration),
                (slope(low.acceleration, high.acceleration), mid.jerk),
            ] {
                assert!((difference - exact).abs() < 2e-6, "{} {x}", law.name());
            }
        }
    }
}

#[test]
fn dwelling_laws_rest_at_both_ends() {
    for (name, _) in LawSpec::NAMED {
        let law = law(name);
        for x in [0.0, 1.0] {
            let at = law.at(x);
            assert_eq!(
                at.velocity.abs() < 1e-13,
                name != "constant-velocity",
                "{name}"
            );
            let soft = !["parabolic", "harmonic"].contains(&name);
            assert_eq!(at.acceleration.abs() < 1e-12, soft, "{name} {x}");
        }
        assert_eq!(LawSpec::named(name).expect("known").name(), name);
    }
    assert_eq!(LawSpec::named("sudden"), None);
}

/// Compares `Cv`, `Ca`, `Cj`, the peaks of acceleration and jerk inside, and the jumps of velocity and acceleration.
fn compare(law: &Law, expected: [f64; 7], name: &str) {
    let found = law.characteristic_values();
    for (value, expected) in [
        found.velocity,
        found.acceleration,
        found.jerk,
        found.acceleration_inside,
        found.jerk_inside,
        found.velocity_jump,
        found.acceleration_jump,
    ]
    .into_iter()
    .zip(expected)
    {
        let same = value == expected || (value - expected).abs() < 1e-11 * expected.max(1e-2);
        assert!(same, "{name}: {value} {expected}");
    }
    assert_eq!(found.torque.is_infinite(), found.velocity_jump > 0.0);
}

/// A polynomial joins what is given for its ends; what is not given is rest.
#[test]
fn polynomials_jump_where_their_ends_are_free() {
    let inf = f64::INFINITY;
    for (start, end, expected) in [
        // s = x.
        (vec![], vec![], [1.0, inf, inf, 0.0, 0.0, 1.0, 0.0]),
        (vec![1.0], vec![1.0], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        // s = 3 x^2 - 2 x^3.
        (vec![0.0], vec![0.0], [1.5, 6.0, inf, 6.0, 12.0, 0.0, 6.0]),
        (
            vec![0.0, 6.0],
            vec![0.0, -6.0],
            [1.5, 6.0, 12.0, 6.0, 12.0, 0.0, 0.0],
        ),
        // s = x^2.
        (vec![0.0], vec![2.0], [2.0, 2.0, inf, 2.0, 0.0, 0.0, 2.0]),
        (vec![0.0], vec![], [2.0, inf, inf, 2.0, 0.0, 2.0, 2.0]),
        (
            vec![0.0, 2.0],
            vec![2.0, 2.0],
            [2.0, 2.0, 0.0, 2.0, 0.0, 0.0, 0.0],
        ),
        // s = x^3.
        (vec![0.0, 0.0], vec![], [3.0, inf, inf, 6.0, 6.0, 3.0, 6.0]),
        (
            vec![0.0, 0.0],
            vec![3.0],
            [3.0, 6.0, inf, 6.0, 6.0, 0.0, 6.0],
        ),
        (
            vec![0.0, 0.0],
            vec![3.0, 6.0],
            [3.0, 6.0, 6.0, 6.0, 6.0, 0.0, 0.0],
        ),
    ] {
        let name = format!("{start:?} {end:?}");
        let law = LawSpec::Polynomial(Polynomial { start, end });
        compare(&law.resolve().expect("sound"), expected, &name);
    }
}

#[test]
fn characteristic_values_are_the_closed_forms() {
    let sine = 4.0 * PI * PI / (4.0 + PI);
    let trapezoid = 8.0 * PI / (2.0 + PI);
    let (none, inf) = (0.0, f64::INFINITY);
    let soft = |v: f64, a: f64, j: f64| [v, a, j, a, j, none, none];
    let harmonic = PI * PI / 2.0;
    let known = [
        ("constant-velocity", [1.0, inf, inf, none, none, 1.0, none]),
        ("parabolic", [2.0, 4.0, inf, 4.0, none, none, 8.0]),
        (
            "harmonic",
            [
                PI / 2.0,
                harmonic,
                inf,
                harmonic,
                PI * harmonic,
                none,
                harmonic,
            ],
        ),
        ("cycloidal", soft(2.0, 2.0 * PI, 4.0 * PI * PI)),
        ("modified-sine", soft(sine / PI, sine, 4.0 * PI * sine)),
        (
            "modified-trapezoid",
            soft(2.0, trapezoid, 4.0 * PI * trapezoid),
        ),
        ("polynomial-345", soft(1.875, 10.0 / 3.0_f64.sqrt(), 60.0)),
        (
            "polynomial-4567",
            soft(2.1875, 84.0 * 5.0_f64.sqrt() / 25.0, 52.5),
        ),
    ];
    for (name, values) in known {
        compare(&law(name), values, name);
    }
    // The figures as they are usually printed, and the dynamic torque of two of them.
    let printed = |name: &str, figures: [f64; 2]| {
        let CharacteristicValues {
            velocity,
            acceleration,
            ..
        } = law(name).characteristic_values();
        assert!((velocity - figures[0]).abs() < 5e-5, "{name} {velocity}");
        assert!(
            (acceleration - figures[1]).abs() < 5e-5,
            "{name} {acceleration}"
        );
    };
    printed("modified-sine", [1.7596, 5.5280]);
    printed("modified-trapezoid", [2.0, 4.8881]);
    printed("polynomial-345", [1.875, 5.7735]);
    printed("polynomial-4567", [2.1875, 7.5132]);
    // Maximum of (1 - cos u) sin u 2 pi is at u = 2 pi / 3.
    let torque = law("cycloidal").characteristic_values().torque;
    assert!((torque - 2.0 * PI * 0.75 * 3.0_f64.sqrt()).abs() < 1e-11);
    let torque = law("harmonic").characteristic_values().torque;
    assert!((torque - PI.powi(3) / 8.0).abs() < 1e-12);
}

#[test]
fn a_polynomial_has_the_derivatives_asked_for() {
    let spec = Polynomial {
        start: vec![0.3, -1.0],
        end: vec![0.5, 2.0, 7.0],
    };
    let law = LawSpec::Polynomial(spec).resolve().expect("sound");
    let (start, end) = (law.at(0.0), law.at(1.0));
    for (found, requested) in [
        (start.velocity, 0.3),
        (start.acceleration, -1.0),
        (end.position, 1.0),
        (end.velocity, 0.5),
        (end.acceleration, 2.0),
        (end.jerk, 7.0),
    ] {
        assert!((found - requested).abs() < 1e-11, "{found} {requested}");
    }
    for (zeros, name) in [(2, "polynomial-345"), (3, "polynomial-4567")] {
        let rest = LawSpec::Polynomial(Polynomial {
            start: vec![0.0; zeros],
            end: vec![0.0; zeros],
        });
        let (rest, named) = (rest.resolve().expect("sound"), self::law(name));
        for i in 0..=20 {
            let x = f64::from(i) / 20.0;
            assert!((rest.at(x).position - named.at(x).position).abs() < 1e-14);
            assert!((rest.at(x).jerk - named.at(x).jerk).abs() < 1e-10);
        }
    }
}

#[test]
fn bad_polynomials_name_their_key() {
    for (start, end, key) in [
        (vec![f64::NAN], vec![], "start"),
        (vec![], vec![0.0; 5], "end"),
    ] {
        let spec = LawSpec::Polynomial(Polynomial { start, end });
        assert_eq!(spec.resolve().map(|_| ()).expect_err("refused").key, key);
    }
}

#[test]
fn laws_read_and_write_as_in_a_file() {
    for text in ["kind = \"modified-sine\"\n", "kind = \"polynomial-4567\"\n"] {
        let law: LawSpec = toml::from_str(text).expect("reads");
        assert_eq!(toml::to_string(&law).expect("writes"), text);
    }
    let law: LawSpec = toml::from_str("kind = \"polynomial\"\nend = [1.0]").expect("reads");
    assert_eq!(law.name(), "polynomial");
    assert!(toml::from_str::<LawSpec>("kind = \"polynomial\"\nmiddle = 1").is_err());
}

#[test]
fn a_key_that_means_nothing_is_refused_beside_any_kind() {
    for (name, _) in LawSpec::NAMED {
        let text = format!("kind = \"{name}\"\nmiddle = 1");
        assert!(toml::from_str::<LawSpec>(&text).is_err(), "{name}");
    }
}
