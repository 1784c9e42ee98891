use std::io::{Result, Write};

use crate::analysis::{Goal, Report};
use crate::page::words::goal_words;
use anstyle::{AnsiColor, Style};

use super::figures::HEADING;

/// Characters of a progress bar.
const BAR: usize = 12;

/// Writes each goal in a row: number, title, figure, range, progress, and whether it is met or the amount by which it is missed.
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

fn one(goal: &Goal, out: &mut impl Write) -> Result<()> {
    let words = goal_words(goal);
    write!(
        out,
        "  {:>2} {:<36} {:>10} {:<3}  {:<14}",
        words.number, words.title, words.value, words.unit, words.required
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

/// A bar filled in proportion; full only if the goal is reached.
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
    fn a_row_says_figure_range_and_miss() {
        let length = |number, name, title, value: Option<f64>| {
            Goal::new(number, name, title, Unit::Millimetre)
                .minimum(20.0, 20.0)
                .with(value)
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
