//! New goals.

use centrode_families::FAMILIES;

use super::adding::numbers;
use super::scene::Scene;
use super::writing::{digits, put};
use super::{Composed, Refusal, naming};

/// A goal for a figure, with a limit or the figure of the machine as it is.
pub(super) fn goal(
    mut scene: Scene,
    figure: &str,
    over: &str,
    below: bool,
    limit: Option<f64>,
) -> Result<Composed, Box<Refusal>> {
    let word = figure.split(['(', '.']).next().unwrap_or("goal");
    let name = naming::within(&scene.design, "goals", word);
    let limit_key = if below { "maximum" } else { "minimum" };
    let text =
        |limit: f64| format!("figure = \"{figure}\"\nover = \"{over}\"\n{limit_key} = {limit}\n");
    let mut probe = scene.document.clone();
    put(&mut probe, "goals", &name, &text(0.0))?;
    let read = FAMILIES.read(probe.to_string().as_bytes());
    let made = read.and_then(|file| file.mechanism());
    let made = made.map_err(|error| Box::new(Refusal::because(error.message())))?;
    let report = made.check_goals();
    let found = report.goals.iter().find(|goal| goal.name == name);
    let value = found.and_then(|goal| goal.value);
    // Rounded so that the machine as it is meets the goal.
    let met = |value: f64| {
        let short = digits(value);
        let missed = if below { short < value } else { short > value };
        let last = 10_f64.powf(value.abs().max(f64::MIN_POSITIVE).log10().floor() - 5.0);
        match (missed, below) {
            (false, _) => short,
            (true, true) => digits(short + last),
            (true, false) => digits(short - last),
        }
    };
    let Some(limit) = limit.or(value.map(met)) else {
        let why = format!("{figure} is known after the checks only: give a limit");
        return Err(Box::new(Refusal::because(why)));
    };
    put(&mut scene.document, "goals", &name, &text(limit))?;
    scene.reread();
    let mut part = Composed {
        numbers: numbers([("limit", limit.into())]),
        ..Composed::default()
    };
    if let Some(value) = value {
        part.numbers.insert("now".into(), digits(value).into());
    }
    scene.finish(&format!("goals.{name}"), part)
}
