use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

use crate::analysis::{Answer, Response as Found};
use crate::family::Depth;

use crate::cli::Status;
use crate::cli::args::Response;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::output;
use crate::cli::progress::Progress;

/// Prints the response of a design's figures to one of its numbers.
pub(crate) fn run(command: &Response, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open(&command.design)?;
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
    let values: Vec<f64> = (0..command.count).map(value).collect();
    let progress = Progress::new(1);
    progress.step("checking at every value");
    let find = |depth| {
        let response = file.family().response(file.design(), &key, &values, depth);
        let response = response.map_err(|error| Failure::Usage(error.message()))?;
        let answers = response.answers();
        Ok::<_, Failure>((response, answers))
    };
    let mut found = find(if command.whole {
        Depth::Whole
    } else {
        Depth::Motion
    })?;
    let told = |name: &String| found.1.iter().any(|answer| answer.name == *name);
    if !command.of.iter().all(told) {
        found = find(Depth::Whole)?;
    }
    drop(progress);
    let (response, answers) = found;
    if let Some(path) = &command.csv {
        write_csv(path, &response, &answers)?;
    }
    if command.json {
        let json = serde_json::json!({
            "key": response.key, "values": response.values, "answers": answers,
        });
        serde_json::to_writer_pretty(&mut *out, &json).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(Status::Good);
    }
    let shown = asked(command, &response, &answers)?;
    write_table(&response, &shown, out)?;
    Ok(Status::Good)
}

/// Answers asked for; all goals, or all figures of a family without goals, where none is asked for.
fn asked<'a>(
    command: &Response,
    response: &Found,
    answers: &'a [Answer],
) -> Result<Vec<&'a Answer>, Failure> {
    if command.of.is_empty() {
        let mut goals = response.reports.iter().flatten().flat_map(|r| &r.goals);
        let any = goals.next().is_some();
        let is_goal = |answer: &Answer| {
            let mut reports = response.reports.iter().flatten();
            reports.any(|r| r.goals.iter().any(|goal| goal.name == answer.name))
        };
        return Ok(answers.iter().filter(|a| !any || is_goal(a)).collect());
    }
    let one = |name: &String| {
        answers.iter().find(|a| a.name == *name).ok_or_else(|| {
            let known: Vec<&str> = answers.iter().map(|a| &*a.name).collect();
            Failure::Usage(format!(
                "no figure {name:?}; there are {}",
                known.join(", ")
            ))
        })
    };
    command.of.iter().map(one).collect()
}

/// A figure as a person reads it: degrees for radians.
fn shown(answer: &Answer, at: usize) -> String {
    answer.figures[at].map_or("-".into(), |figure| answer.unit.show(figure))
}

fn write_table(response: &Found, answers: &[&Answer], out: &mut impl Write) -> Result<(), Failure> {
    let head = |answer: &&Answer| {
        let unit = answer.unit.shown();
        format!("{} {unit}", answer.name).trim_end().to_owned()
    };
    let heads: Vec<String> = answers.iter().map(head).collect();
    let width = response.key.len().max(10);
    write!(out, "{:>width$}", response.key)?;
    for head in &heads {
        write!(out, "  {head:>12}")?;
    }
    writeln!(out)?;
    for (at, value) in response.values.iter().enumerate() {
        write!(out, "{:>width$}", (value * 1e6).round() / 1e6 + 0.0)?;
        for (answer, head) in answers.iter().zip(&heads) {
            let column = head.len().max(12);
            write!(out, "  {:>column$}", shown(answer, at))?;
        }
        if response.reports[at].is_none() {
            write!(out, "  no mechanism")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_csv(path: &Path, response: &Found, answers: &[Answer]) -> Result<(), Failure> {
    let mut text = response.key.clone();
    for answer in answers {
        let _ = write!(text, ",{}", answer.name);
    }
    text.push('\n');
    for (at, value) in response.values.iter().enumerate() {
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
