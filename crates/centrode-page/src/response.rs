//! Response of the figures of a design to one of its numbers, for the page.

use centrode_analysis::{Goal, Sweep, Unit};
use centrode_families::FAMILIES;
use serde::{Deserialize, Serialize};

/// Number of values at which the design is checked.
const COUNT: u32 = 13;

/// Maximum number of charts of a family without goals.
const MOST: usize = 12;

/// Request of the page: one number of the design, between two values in the file's unit.
#[derive(Debug, Deserialize)]
pub struct Ask {
    /// Text of the design.
    pub text: String,
    key: String,
    from: f64,
    to: f64,
}

/// Responses of the figures.
#[derive(Debug, Serialize)]
pub struct Answers {
    values: Vec<f64>,
    charts: Vec<Chart>,
}

/// One figure at each of the values.
#[derive(Debug, Serialize)]
struct Chart {
    title: String,
    unit: &'static str,
    /// Figures; `None` if there is no mechanism.
    figures: Vec<Option<f64>>,
    /// Minimum and maximum required figure.
    required: [Option<f64>; 2],
}

/// Checks the design at every value.
///
/// # Errors
/// The reason in words if the design cannot be read, the values do not rise, or the key does not hold a number.
pub fn answers(ask: &Ask) -> Result<Answers, String> {
    let file = FAMILIES
        .read(ask.text.as_bytes())
        .map_err(|error| error.message())?;
    if !(ask.from.is_finite() && ask.to.is_finite()) || ask.from >= ask.to {
        let (from, to) = (ask.from, ask.to);
        return Err(format!(
            "the values must increase, but go from {from} to {to}"
        ));
    }
    let step = (ask.to - ask.from) / f64::from(COUNT - 1);
    let values: Vec<Vec<f64>> = (0..COUNT)
        .map(|i| vec![ask.from + step * f64::from(i)])
        .collect();
    // Without goals, figures that change are shown.
    let shows = |found: &Sweep| {
        found.has_goals() || found.answers().iter().any(|answer| moves(&answer.figures))
    };
    let response = file
        .family()
        .sweep_until(file.design(), &[&ask.key], &values, shows);
    let response = response.map_err(|error| error.message())?;
    let given: Vec<f64> = response.variants.concat();
    // For a key of whole numbers several values may round to the same number.
    let kept: Vec<usize> = (0..given.len())
        .filter(|&i| i == 0 || given[i] != given[i - 1])
        .collect();
    let values = kept.iter().map(|&i| given[i]).collect();
    let scaled = |unit: Unit, figures: &[Option<f64>]| {
        let one = |&i: &usize| figures[i].map(|figure| figure * unit.factor());
        kept.iter().map(one).collect()
    };
    let goals: Vec<&Goal> = response
        .reports
        .iter()
        .flatten()
        .map(|report| &report.goals)
        .next()
        .map_or_else(Vec::new, |goals| goals.iter().collect());
    let answers = response.answers();
    let charts = if goals.is_empty() {
        answers
            .iter()
            .filter(|answer| moves(&answer.figures))
            .take(MOST)
            .map(|answer| Chart {
                title: answer.name.replace('_', " "),
                unit: answer.unit.shown(),
                figures: scaled(answer.unit, &answer.figures),
                required: [None, None],
            })
            .collect()
    } else {
        let chart = |goal: &&Goal| {
            let answer = answers.iter().find(|answer| answer.name == goal.name)?;
            Some(Chart {
                title: format!("{}. {}", goal.number, goal.title),
                unit: goal.unit.shown(),
                figures: scaled(goal.unit, &answer.figures),
                required: goal
                    .required
                    .map(|end| end.map(|end| end * goal.unit.factor())),
            })
        };
        goals.iter().filter_map(chart).collect()
    };
    Ok(Answers { values, charts })
}

/// Whether a figure changes, so that it is not just a setting.
fn moves(figures: &[Option<f64>]) -> bool {
    let mut known = figures.iter().flatten();
    let first = known.next();
    known.any(|figure| Some(figure) != first)
}
