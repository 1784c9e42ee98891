use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

use crate::analysis::{Answer, Sweep};
use crate::family::Depth;

use crate::cli::args::Response;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::{Status, output};

/// Minimum width of a column, characters.
const MIN_WIDTH: usize = 10;

/// Maximum number of characters of a line of the table.
const LONGEST_LINE: usize = 100;

/// Prints the response of a design's figures to one of its numbers.
pub(crate) fn run(command: &Response, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    if let Some(path) = &command.csv {
        source.keep_from(path)?;
    }
    for (word, end) in [("--from", command.from), ("--to", command.to)] {
        if !end.is_finite() {
            let why = format!("{word} must be a finite number, not {end}");
            return Err(Failure::Usage(why));
        }
    }
    let file = source.design()?;
    let key = file.design().key_of(&command.parameter);
    let steps = f64::from(command.count - 1);
    let span = command.to - command.from;
    let value = |i: u16| command.from + span * f64::from(i) / steps;
    let values: Vec<Vec<f64>> = (0..command.count).map(|i| vec![value(i)]).collect();
    let progress = Progress::new(1);
    progress.step("checking every value");
    let (family, design) = (file.family(), file.design());
    let response = match command.depth.as_deref().and_then(Depth::named) {
        Some(depth) => family.sweep(design, &[&key], &values, depth),
        None => family.sweep_until(design, &[&key], &values, |found| is_enough(command, found)),
    };
    let response = response.map_err(|error| Failure::Usage(error.message()))?;
    let answers = response.answers();
    drop(progress);
    if let Some(path) = &command.csv {
        write_csv(path, &response, &answers)?;
    }
    if command.json {
        let json = serde_json::json!({
            "key": key, "values": response.variants.concat(), "answers": answers,
            "refused": response.reports.iter().map(|report| report.as_ref().err()).collect::<Vec<_>>(),
        });
        serde_json::to_writer_pretty(&mut *out, &json).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(Status::Good);
    }
    let shown = requested(command, &response, &answers)?;
    write_table(&response, &shown, out)?;
    Ok(Status::Good)
}

/// Whether a response has the requested figures; default: goals, or a figure that changes.
fn is_enough(command: &Response, response: &Sweep) -> bool {
    let answers = response.answers();
    match command.of.is_empty() {
        true => response.has_goals() || answers.iter().any(changes),
        false => {
            let has = |name: &String| answers.iter().any(|answer| is_named(answer, name));
            command.of.iter().all(has)
        }
    }
}

/// Requested figures; default: all goals, or, for a family without goals, the figures that change.
fn requested<'a>(
    command: &Response,
    response: &Sweep,
    answers: &'a [Answer],
) -> Result<Vec<&'a Answer>, Failure> {
    if command.of.is_empty() {
        let is_goal = |answer: &Answer| {
            let mut reports = response.reports.iter().flatten();
            reports.any(|r| r.goals.iter().any(|goal| goal.name == answer.name))
        };
        let required = |answer: &&Answer| match response.has_goals() {
            true => is_goal(answer),
            false => changes(answer),
        };
        return Ok(answers.iter().filter(required).collect());
    }
    let one = |name: &String| {
        answers.iter().find(|a| is_named(a, name)).ok_or_else(|| {
            let known: Vec<&str> = answers.iter().map(|a| &*a.name).collect();
            Failure::Usage(format!(
                "unknown figure {name:?}; known figures are {}",
                known.join(", ")
            ))
        })
    };
    command.of.iter().map(one).collect()
}

/// Whether an answer has a name: goals are written with hyphens, figures as the keys of a report.
fn is_named(answer: &Answer, name: &str) -> bool {
    answer.name.replace('_', "-") == name.replace('_', "-")
}

/// A figure as text, angles in degrees.
fn shown(answer: &Answer, at: usize) -> String {
    answer.figures[at].map_or("-".into(), |figure| answer.unit.show(figure))
}

/// Whether a figure changes in the digits shown, so that it is not just a setting or rounding.
fn changes(answer: &Answer) -> bool {
    let known = (0..answer.figures.len()).filter(|&at| answer.figures[at].is_some());
    let mut known = known.map(|at| shown(answer, at));
    let first = known.next();
    known.any(|figure| Some(figure) != first)
}

/// Writes a line per value, or a line per figure if the lines would be too long.
fn write_table(response: &Sweep, answers: &[&Answer], out: &mut impl Write) -> Result<(), Failure> {
    let given = |value: &f64| ((value * 1e6).round() / 1e6 + 0.0).to_string();
    let values: Vec<String> = response.variants.iter().flatten().map(given).collect();
    let first = std::iter::once(response.keys.concat()).chain(values.iter().cloned());
    let mut columns: Vec<Vec<String>> = vec![first.collect()];
    for answer in answers {
        let head = format!("{} {}", answer.name, answer.unit.shown());
        let figures = (0..values.len()).map(|at| shown(answer, at));
        let column = std::iter::once(head.trim_end().to_owned()).chain(figures);
        columns.push(column.collect());
    }
    let turned: Vec<Vec<String>> = (0..=values.len())
        .map(|row| columns.iter().map(|column| column[row].clone()).collect())
        .collect();
    let columns = match width(&columns) > LONGEST_LINE && width(&turned) < width(&columns) {
        true => turned,
        false => columns,
    };
    for row in 0..columns[0].len() {
        let mut line = String::new();
        for (gap, column) in std::iter::once("")
            .chain(std::iter::repeat("  "))
            .zip(&columns)
        {
            let _ = write!(line, "{gap}{:>1$}", column[row], wide(column));
        }
        writeln!(out, "{line}")?;
    }
    for (value, report) in values.iter().zip(&response.reports) {
        if let Err(why) = report {
            writeln!(out, "no mechanism at {value}: {why}")?;
        }
    }
    let known = response.reports.iter().flatten().count();
    if known > 1 && !answers.iter().any(|answer| changes(answer)) {
        writeln!(out, "no figure changes with {}", response.keys.concat())?;
    }
    Ok(())
}

/// Width of a column, characters.
fn wide(column: &[String]) -> usize {
    let cells = column.iter().map(|cell| cell.chars().count());
    cells.max().unwrap_or(0).max(MIN_WIDTH)
}

/// Width of a line of columns, characters.
fn width(columns: &[Vec<String>]) -> usize {
    columns.iter().map(|column| wide(column) + 2).sum()
}

fn write_csv(path: &Path, response: &Sweep, answers: &[Answer]) -> Result<(), Failure> {
    let mut text = response.keys.concat();
    for answer in answers {
        let _ = write!(text, ",{}", answer.name);
    }
    text.push('\n');
    for (at, value) in response.variants.iter().flatten().enumerate() {
        let _ = write!(text, "{value}");
        for answer in answers {
            text.push(',');
            if let Some(figure) = answer.figures[at] {
                let _ = write!(text, "{figure}");
            }
        }
        text.push('\n');
    }
    output::put(path, text.into_bytes())?;
    Ok(())
}
