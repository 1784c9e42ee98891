//! Tables of angles that turn on or swing back.

use super::*;

/// A wheel that follows a table, with further keys of its law; or why there is none.
fn wheel(table: &[f64], keys: &str) -> Result<Machine, String> {
    let text = format!(
        "family = \"machine\"\n[frame.points]\nW = [0, 0]\n[bodies.wheel]\non = \"frame.W\"\nlaw = {{ table_deg = {table:?}{keys} }}\n"
    );
    Machine::resolve(&read(&text)).map_err(|error| error.to_string())
}

/// Whole turns of the wheel in a cycle, and the farthest it runs outside the angles of its table, deg.
fn motion(wheel: &Machine, table: &[f64]) -> (i32, f64) {
    let angle = |input: f64| wheel.angle(1, input).position.to_degrees();
    let turns = (angle(TAU) - angle(0.0)) / 360.0;
    assert!((turns - turns.round()).abs() < 1e-12, "{table:?}: {turns}");
    for (i, expected) in table.iter().enumerate() {
        let off = angle(TAU * i as f64 / table.len() as f64) - expected;
        assert!(off.abs() < 1e-9, "{table:?}: {off} at {i}");
    }
    let last = table[0] + 360.0 * turns;
    let ends = table.iter().copied().chain([last]);
    let (low, high) = ends.fold((f64::MAX, f64::MIN), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let outside = (0..=1000).map(|i| {
        let x = angle(TAU * f64::from(i) / 1000.0);
        (x - high).max(low - x)
    });
    (turns.round() as i32, outside.fold(0.0, f64::max))
}

#[test]
fn a_table_turns_on_or_swings_back_as_its_steps_show() {
    let even = |count: u32, step: f64| -> Vec<f64> {
        (0..count).map(|i| 7.0 + step * f64::from(i)).collect()
    };
    for (table, turns) in [
        (vec![0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0], 1),
        (vec![0.0, 50.0, 100.0, 150.0, 200.0, 100.0], 0),
        (even(12, 30.0), 1),
        (even(12, -30.0), -1),
        (even(12, 60.0), 2),
        (even(24, -45.0), -3),
        // The last step is just twice the largest.
        (even(8, 40.0), 1),
        (vec![0.0, 10.0, 20.0, 10.0, 0.0, -10.0, -20.0, -10.0], 0),
        (vec![0.0; 6], 0),
        // Full turns and back again; nearly a full turn, and a rest.
        (vec![0.0, 90.0, 180.0, 270.0, 360.0, 270.0, 180.0, 90.0], 0),
        (vec![0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0, 360.0], 1),
        (vec![0.0, 20.0, 60.0, 120.0, 200.0, 270.0, 320.0, 350.0], 1),
    ] {
        let made = wheel(&table, "").expect("a clear table");
        let (turned, outside) = motion(&made, &table);
        assert_eq!(turned, turns, "{table:?}");
        // The curve runs past the ends of a swing, but by less than a step.
        let step = table.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let step = step.fold(0.0, f64::max);
        assert!(outside <= 0.25 * step + 1e-9, "{table:?}: {outside} deg");
    }
    // Equal steps all round are an even turn.
    for (count, step) in [(8, 45.0), (12, -30.0), (9, 80.0), (6, 60.0)] {
        let made = wheel(&even(count, step), "").expect("a clear table");
        let rate = f64::from(count) * step / 360.0;
        for i in -30..30 {
            let jet = made.angle(1, 0.3 * f64::from(i));
            let expected = 7.0_f64.to_radians() + rate * 0.3 * f64::from(i);
            assert!((jet.position - expected).abs() < 1e-13, "{count}: {jet:?}");
            assert!((jet.velocity - rate).abs() < 1e-13, "{count}: {jet:?}");
            assert!(jet.acceleration.abs() < 1e-12, "{count}: {jet:?}");
        }
    }
}

#[test]
fn a_table_that_is_not_clear_needs_its_turns() {
    for (table, small, large) in [
        (
            [0.0, 40.0, 80.0, 120.0, 160.0, 200.0],
            (1, "160"),
            (0, "-200"),
        ),
        (
            [0.0, -40.0, -80.0, -120.0, -160.0, -200.0],
            (-1, "-160"),
            (0, "200"),
        ),
        (
            [0.0, 36.0, 72.0, 108.0, 144.0, 180.0],
            (1, "180"),
            (0, "-180"),
        ),
        (
            [0.0, 170.0, 0.0, 170.0, 0.0, 170.0],
            (0, "-170"),
            (1, "190"),
        ),
        (
            [0.0, 95.0, 190.0, 285.0, 380.0, 190.0],
            (1, "170"),
            (0, "-190"),
        ),
        ([5.0, 10.0, 15.0, 20.0, 25.0, 30.0], (0, "-25"), (1, "335")),
        (
            [0.0, 30.0, 60.0, 90.0, 120.0, 500.0],
            (1, "-140"),
            (2, "220"),
        ),
    ] {
        let error = wheel(&table, "").expect_err("two readings");
        for (turns, step) in [small, large] {
            let words = format!("turns = {turns} ");
            let step = format!("a last step of {step} deg");
            assert!(error.contains(&words) && error.contains(&step), "{error}");
        }
        // Either reading may be given, and any other.
        for turns in [small.0, large.0, 3, -2] {
            let made = wheel(&table, &format!(", turns = {turns}"));
            let made = made.expect("the turns are given");
            assert_eq!(motion(&made, &table).0, turns, "{table:?}");
        }
    }
}

#[test]
fn the_turns_of_a_table_are_a_key_of_tables_of_angles_alone() {
    let file = |law: &str, slides: &str| {
        format!(
            "family = \"machine\"\n[frame.points]\nW = [0, 0]\n[bodies.wheel]\non = \"frame.W\"\n{slides}law = {{ {law} }}\n"
        )
    };
    for (law, slides, words) in [
        (
            "ratio = 1, turns = 1",
            "",
            "turns: has no meaning without table_deg",
        ),
        ("turns = 1", "", "start_deg: is missing"),
        (
            "table = [0, 1, 2, 3, 2, 1], turns = 1",
            "slides_deg = 0\n",
            "turns: has no meaning without table_deg",
        ),
        (
            "table_deg = [0, 1, 2, 3, 2, 1], turns = 1001",
            "",
            "turns: must be -1000 to 1000",
        ),
        (
            "table_deg = [0, 1, 0], turns = 0",
            "",
            "law.table_deg has 3 values",
        ),
        (
            "table_deg = [0, 40, 80, 120, 160, 200]",
            "",
            "law.table_deg: its last step is ambiguous",
        ),
    ] {
        let error = refused(&file(law, slides));
        assert!(error.contains(words), "{law}: {error}");
    }
}

#[test]
fn a_table_over_several_turns_of_the_input_turns_on_over_all_of_them() {
    let text = "family = \"machine\"\n[input]\nturns = 3\n[frame.points]\nW = [0, 0]\n[bodies.shaft]\non = \"frame.W\"\nlaw = { ratio = -1 }\n[bodies.wheel]\non = \"frame.W\"\nlaw = { table_deg = [0, 60, 120, 180, 240, 300], start_deg = 5 }\n[bodies.after]\non = \"frame.W\"\nlaw = { table_deg = [0, 60, 120, 180, 240, 300], by = \"shaft\" }\n";
    let made = made(text);
    for i in 0..40 {
        let input = 0.5 * f64::from(i);
        let angle = |name: &str| {
            let body = made.bodies().iter().position(|body| body.name == name);
            made.angle(body.expect("a body"), input).position
        };
        let start = 5.0_f64.to_radians();
        assert!((angle("wheel") - start - input / 3.0).abs() < 1e-12);
        assert!((angle("after") + input / 3.0).abs() < 1e-12);
    }
}
