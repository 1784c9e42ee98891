use super::*;
use proptest::prelude::*;

fn value(text: &str, phi: f64) -> f64 {
    Formula::read(text).expect(text).at(phi).0[0]
}

#[test]
fn precedence_is_that_of_written_mathematics() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("2**3", 8.0),
        ("8/4/2", 1.0),
        ("1-2-3", -4.0),
        ("-(1+2)*3", -9.0),
        ("1.5e1 + .5", 15.5),
        ("2*cos(0)^2", 2.0),
        ("sqrt(16) - ln(exp(1))", 3.0),
        ("asin(1) + acos(0) - 2*atan(1)", std::f64::consts::FRAC_PI_2),
        ("pi", std::f64::consts::PI),
        ("tanh(1000) - 2*tanh(-1000)", 3.0),
        ("tanh(2) - sinh(2)/cosh(2)", 0.0),
        ("1 + 2/(1 + exp(800))", 1.0),
        ("1 + 2/(1 + exp(700*cos(phi/300)))", 1.0),
    ] {
        assert!((value(text, 0.3) - expected).abs() < 1e-14, "{text}");
    }
    assert!((value("phi^phi", 2.0) - 4.0).abs() < 1e-14);
}

#[test]
fn derivatives_agree_with_differences_for_every_function() {
    let inner = "(0.4 + 0.3*sin(phi))";
    let mut texts: Vec<String> = "sin cos tan asin acos atan sinh cosh tanh exp ln sqrt"
        .split(' ')
        .map(|f| format!("{f}{inner}"))
        .collect();
    texts.extend(["tanh(2 + phi)", "tanh(-3000*phi)"].map(str::to_owned));
    texts.extend(["^2", "^-3", "^2.5", "^phi"].map(|p| format!("{inner}{p}")));
    texts.push(format!("phi/{inner} - phi*{inner}"));
    let h = 1e-4;
    for text in texts {
        let formula = Formula::read(&text).expect(&text);
        for i in 1..20 {
            let phi = 0.3 * f64::from(i);
            let (low, at, high) = (formula.at(phi - h), formula.at(phi), formula.at(phi + h));
            for k in 0..4 {
                let slope = (high.0[k] - low.0[k]) / (2.0 * h);
                let exact = at.0[k + 1] * (k + 1) as f64;
                let size = 1.0 + at.0.iter().fold(0.0_f64, |m, c| m.max(c.abs())) * 50.0;
                assert!(
                    (slope - exact).abs() < 2e-6 * size,
                    "{text} order {k}: {slope} {exact}"
                );
            }
        }
    }
}

#[test]
fn a_turn_is_parted_where_a_formula_has_what_is_narrow() {
    let parts = |text: &str| {
        Formula::read(text)
            .expect(text)
            .parts(std::f64::consts::TAU)
    };
    // Curves of pitch curves in use, with waves, and a sum that is one but for its rounding.
    for text in [
        "1 + 0.5*cos(3*phi)",
        "20/(1 - 0.9*cos(phi))",
        "1 + 0.00001*cos(963*phi)",
        "sqrt(cos(phi)^2 + sin(phi)^2)",
        "1 + 0.1*exp(-20*(1 - cos(2*phi)))",
    ] {
        assert_eq!(parts(text), Ok(Vec::new()), "{text}");
    }
    // Bumps 1/(5 sqrt(a)) wide, steps 1/(7 a) wide; the rate of a bump is exp(-1/2) over its width, that of a step half.
    for (text, rate) in [
        (
            "1 + 0.0001*exp(-700*(1 - cos(5*phi)))",
            5.0 * 700_f64.sqrt() * (-0.5_f64).exp(),
        ),
        (
            "1 + exp(-20000*(1 - cos(5*phi - 0.3)))",
            5.0 * 20_000_f64.sqrt() * (-0.5_f64).exp(),
        ),
        ("1 + 0.002*tanh(300*sin(7*phi))", 1050.0),
        ("1/(1 + exp(600*(cos(phi) - 0.99)))", 40.0),
    ] {
        let found = parts(text).expect(text);
        let required = std::f64::consts::TAU * rate / 24.0;
        assert!(
            found.len() as f64 + 1.0 >= required,
            "{text}: {} {required}",
            found.len()
        );
        assert!(
            (found.len() as f64) < 2.0 * required + 60.0,
            "{text}: {} {required}",
            found.len()
        );
        assert_eq!((found.len() + 1) % 60, 0);
    }
    for text in [
        "1 + 0.002*tanh(3000*sin(7*phi))",
        "1 + 0.01*tanh(1e9*sin(2*phi))*cos(phi)",
        "1 + 0.1*exp(-1e9*(1 - cos(5*phi - 0.3)))",
    ] {
        let steep = parts(text).expect_err(text);
        assert!(steep.width < steep.minimum, "{text}: {steep:?}");
    }
}

#[test]
fn faults_name_their_place() {
    for (text, reason, column) in [
        ("", "empty", 1),
        ("1 + ", "ends too early", 5),
        ("1 + psi", "did you mean \"phi\"", 5),
        ("1 + velocity", "known are sin", 5),
        ("(1 + 2", "')' is missing", 7),
        ("1)", "without its '('", 2),
        ("2 phi", "operator is missing", 3),
        ("sin phi", "'(' is missing", 5),
        ("1..2", "not a number", 1),
        ("1e999", "not a number", 1),
        ("1 + *2", "missing before '*'", 5),
        ("phi $ 2", "missing before '$'", 5),
    ] {
        let error = Formula::read(text).expect_err(text);
        assert!(error.reason.contains(reason), "{text}: {error}");
        assert_eq!(error.column, column, "{text}: {error}");
    }
}

#[test]
fn hostile_formulas_are_refused_or_cheap() {
    let deep = "(".repeat(900) + "phi" + &")".repeat(900);
    assert!(Formula::read(&deep).is_err());
    assert!(Formula::read(&("-".repeat(1900) + "1")).is_err());
    assert!(Formula::read(&("1+".repeat(5_000_000) + "1")).is_err());
    let right = "phi+(".repeat(40) + "1" + &")".repeat(40);
    assert!(Formula::read(&right).is_err());
    let product = vec!["sin(phi)"; 180].join("*");
    assert!(Formula::read(&product).expect("long").at(1.0).0[0].is_finite());
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "[-+*/^(). 0-9a-z]{0,60}") {
        if let Ok(formula) = Formula::read(&text) {
            let _ = formula.at(1.0);
        }
    }
}
