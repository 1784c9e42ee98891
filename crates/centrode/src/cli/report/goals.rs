use std::io::{Result, Write};

use crate::analysis::{Goal, Report};
use anstyle::{AnsiColor, Style};
use serde::Serialize;

use super::figures::{HEADING, exact};

/// Characters of a progress bar.
const BAR: usize = 12;

/// Writes each goal in a row: number, title, figure, range, progress, met or by how much not.
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    if report.goals.is_empty() {
        return Ok(());
    }
    let [met, open] = [Some(true), None].map(|state| {
        let goals = report.goals.iter().filter(|goal| goal.met() == state);
        goals.count()
    });
    let looked_at = report.goals.len() - open;
    let unchecked = match open {
        0 => String::new(),
        n => format!(", {n} not checked"),
    };
    writeln!(
        out,
        "\n{HEADING}Goals: {met} of {looked_at} reached{unchecked}{HEADING:#}"
    )?;
    for goal in &report.goals {
        one(goal, out)?;
    }
    Ok(())
}

/// A goal in words.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct GoalWords {
    number: u32,
    /// Number in the paper it is from, where that is another.
    paper: Option<u32>,
    name: String,
    title: String,
    value: String,
    /// Figure as in the JSON report, to the last digit.
    exact: Option<String>,
    unit: &'static str,
    /// The range it is wanted in.
    wanted: String,
    /// Met, missed by how much, or not checked.
    verdict: String,
    /// By how much it is met, with its unit.
    spare: Option<String>,
    met: Option<bool>,
    progress: Option<f64>,
}

impl GoalWords {
    /// The figure, without its unit.
    pub(crate) fn value(&self) -> &str {
        &self.value
    }

    pub(crate) fn unit(&self) -> &'static str {
        self.unit
    }

    /// The range it is wanted in.
    pub(crate) fn wanted(&self) -> &str {
        &self.wanted
    }

    /// Met, missed by how much, or not checked.
    pub(crate) fn verdict(&self) -> &str {
        &self.verdict
    }
}

/// The words for a goal.
pub(crate) fn goal_words(goal: &Goal) -> GoalWords {
    let short = |value: f64| end(value * goal.unit.factor());
    let wanted = match goal.wanted {
        [Some(least), Some(greatest)] => format!("{} to {}", short(least), short(greatest)),
        [Some(least), None] => format!("at least {}", short(least)),
        [None, Some(greatest)] => format!("at most {}", short(greatest)),
        [None, None] => String::new(),
    };
    let verdict = match (goal.met(), goal.margin) {
        (Some(true), _) => "met".into(),
        (Some(false), Some(margin)) => {
            format!("missed by {}", goal.unit.tell(-margin))
        }
        _ => "not checked".into(),
    };
    let spare = goal.margin.filter(|_| goal.met() == Some(true));
    GoalWords {
        spare: spare.map(|margin| goal.unit.tell(margin)),
        number: goal.number,
        paper: goal.paper,
        name: goal.name.clone().into_owned(),
        title: goal.title.clone().into_owned(),
        value: goal.value.map_or("-".into(), |value| goal.unit.show(value)),
        exact: goal.value.map(exact),
        unit: goal.unit.shown(),
        wanted,
        verdict,
        met: goal.met(),
        progress: goal.progress,
    }
}

/// End of a range, to a millionth; a smaller one keeps its leading digits.
fn end(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 && value != 0.0 {
        // Of six digits those that are not trailing zeros.
        let short = format!("{value:.5e}").parse().unwrap_or(value);
        format!("{short:e}")
    } else {
        // No zero below zero.
        format!("{}", rounded + 0.0)
    }
}

fn one(goal: &Goal, out: &mut impl Write) -> Result<()> {
    let words = goal_words(goal);
    write!(
        out,
        "  {:>2} {:<36} {:>10} {:<3}  {:<14}",
        words.number, words.title, words.value, words.unit, words.wanted
    )?;
    let color = match words.met {
        Some(true) => AnsiColor::Green,
        Some(false) => AnsiColor::Red,
        None => AnsiColor::Cyan,
    };
    let style: Style = color.on_default().bold();
    let bar = match goal.progress {
        Some(progress) => bar(progress),
        None => ".".repeat(BAR),
    };
    write!(out, "  [{bar}]  {style}{}{style:#}", words.verdict)?;
    match words.paper {
        Some(paper) => writeln!(out, "; goal {paper} of the paper"),
        None => writeln!(out),
    }
}

/// A bar filled in proportion; full only where the goal is reached.
fn bar(progress: f64) -> String {
    let most = if progress < 1.0 { BAR - 1 } else { BAR };
    let full = ((progress * BAR as f64).round() as usize).min(most);
    format!("{}{}", "#".repeat(full), "-".repeat(BAR - full))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Unit;

    #[test]
    fn a_bar_is_full_only_when_the_goal_is_reached() {
        assert_eq!(bar(1.0), "############");
        assert_eq!(bar(0.999), "###########-");
        assert_eq!(bar(0.5), "######------");
        assert_eq!(bar(0.0), "------------");
    }

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

    #[test]
    fn a_row_says_figure_range_and_miss() {
        let length = |number, name, title, value| {
            Goal::new(
                (number, name, title),
                value,
                [Some(20.0), None],
                Unit::Millimetre,
                20.0,
            )
        };
        let report = Report {
            goals: vec![
                length(1, "arm-clearance", "arms clear", None),
                length(6, "gearbox-clearance", "gearbox clear", Some(0.0)),
                length(7, "height", "height", Some(25.0)),
            ],
            ..Report::default()
        };
        let mut out = anstream::StripStream::new(Vec::new());
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out.into_inner()).expect("text");
        assert!(
            text.contains("Goals: 1 of 2 reached, 1 not checked"),
            "{text}"
        );
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[2].ends_with("[............]  not checked"), "{text}");
        assert!(
            lines[3].ends_with("at least 20     [######------]  missed by 20.0000 mm"),
            "{text}"
        );
        assert!(
            lines[4].contains("25.0000 mm") && lines[4].ends_with("[############]  met"),
            "{text}"
        );
    }
}
