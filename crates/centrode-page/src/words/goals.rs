use centrode_analysis::Goal;
use serde::Serialize;

use super::figures::exact;

/// A goal in words.
#[derive(Clone, Debug, Serialize)]
pub struct GoalWords {
    /// Number.
    pub number: u32,
    /// Number of the goal in its paper, if that is different.
    pub paper: Option<u32>,
    /// Name in the report.
    pub name: String,
    /// Title.
    pub title: String,
    /// Figure as shown, without its unit.
    pub value: String,
    /// Figure as in the JSON report, to the last digit.
    pub exact: Option<String>,
    /// Unit of the figure.
    pub unit: &'static str,
    /// The required range.
    pub required: String,
    /// Met, missed by how much, or not checked.
    pub verdict: String,
    /// Margin by which it is met, with its unit.
    pub spare: Option<String>,
    /// Whether it is met; `None` if it is not checked.
    pub met: Option<bool>,
    /// Progress towards the goal, 0 to 1; 1 if it is met.
    pub progress: Option<f64>,
}

/// The words for a goal.
pub fn goal_words(goal: &Goal) -> GoalWords {
    let short = |value: f64| end(value * goal.unit.factor());
    let required = match goal.required {
        [Some(minimum), Some(maximum)] => format!("{} to {}", short(minimum), short(maximum)),
        [Some(minimum), None] => format!("at least {}", short(minimum)),
        [None, Some(maximum)] => format!("at most {}", short(maximum)),
        [None, None] => String::new(),
    };
    let verdict = match (goal.met(), goal.margin) {
        (Some(true), _) => "met".into(),
        (Some(false), Some(margin)) => {
            format!("missed by {}", goal.unit.with_unit(-margin))
        }
        _ => "not checked".into(),
    };
    let spare = goal.margin.filter(|_| goal.met() == Some(true));
    GoalWords {
        spare: spare.map(|margin| goal.unit.with_unit(margin)),
        number: goal.number,
        paper: goal.paper,
        name: goal.name.clone().into_owned(),
        title: goal.title.clone().into_owned(),
        value: goal.value.map_or("-".into(), |value| goal.unit.show(value)),
        exact: goal.value.map(exact),
        unit: goal.unit.shown(),
        required,
        verdict,
        met: goal.met(),
        progress: goal.progress,
    }
}

/// End of a range, to a millionth; a smaller one keeps its leading digits.
fn end(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 && value != 0.0 {
        // Six digits, without trailing zeros.
        let short = format!("{value:.5e}").parse().unwrap_or(value);
        format!("{short:e}")
    } else {
        // Adding zero removes the sign of a zero.
        format!("{}", rounded + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_ranges_are_short_and_never_hidden() {
        let ends = [
            -0.0,
            0.0,
            -1e-9,
            1e-9,
            1.234_567_89e-8,
            -15.0,
            0.123_456_789,
        ]
        .map(end);
        assert_eq!(
            ends,
            ["0", "0", "-1e-9", "1e-9", "1.23457e-8", "-15", "0.123457"]
        );
    }
}
