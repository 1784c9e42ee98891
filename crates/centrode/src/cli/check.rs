use std::collections::BTreeMap;
use std::io::Write;

use crate::analysis::{MAX_TEETH, Report};
use crate::family::Mechanism;
use centrode_spec::{Design, DesignError};

use crate::cli::args::Check;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::{Status, report};
use crate::page::Made;

/// Resolves a design and prints its report.
pub(crate) fn run(command: &Check, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    let text = source.text()?;
    let progress = Progress::new(2);
    progress.step("resolving the design");
    let Made {
        mechanism,
        mut left_out,
    } = Made::new(&text).map_err(|error| {
        // Where the file cannot be read, all its mistakes are listed.
        source.design().err().unwrap_or_else(|| source.blame(error))
    })?;
    // Figures and remedies need the design as written, with its details.
    if (command.figures || command.remedy)
        && let Some(left_out) = left_out.take()
    {
        return Err(source.blame(left_out.error));
    }
    if command.figures {
        drop(progress);
        let tables = mechanism.figures();
        let report = Report {
            tables,
            ..Report::default()
        };
        if command.json {
            out.write_all(report::json(&report, mechanism.design())?.as_bytes())?;
        } else {
            report::write_figures(&report, &BTreeMap::new(), out)?;
        }
        return Ok(Status::Good);
    }
    if command.remedy {
        progress.step("searching for remedies");
        let found = mechanism.remedies();
        drop(progress);
        return remedies(command, mechanism.as_ref(), &found, out);
    }
    progress.step("checking");
    let mut report = mechanism.check();
    if let Some(left_out) = left_out {
        left_out.report(&mut report);
    }
    drop(progress);
    if command.json {
        out.write_all(report::json(&report, mechanism.design())?.as_bytes())?;
    } else {
        report::write(mechanism.as_ref(), &report, out)?;
    }
    Ok(Status::new(report.ok()))
}

/// Prints changed designs, each with its effect.
fn remedies(
    command: &Check,
    mechanism: &dyn Mechanism,
    found: &[(String, Box<dyn Design>)],
    out: &mut impl Write,
) -> Result<Status, Failure> {
    if found.is_empty() {
        if let Some(why) = mechanism.no_remedy() {
            return Err(Failure::Usage(format!(
                "no teeth transmit the motion: {why}"
            )));
        }
        let family = mechanism.design().family().word;
        return Err(Failure::Usage(format!(
            "no remedy is known for this design of family {family:?}: remedies exist for gear pairs whose flanks can transmit the motion with {MAX_TEETH} teeth or fewer, and for machines whose colliding plates or pins can be moved to other layers"
        )));
    }
    let designs: Vec<(&str, String)> = found
        .iter()
        .map(|(words, design)| Ok((words.as_str(), design.to_toml()?)))
        .collect::<Result<_, DesignError>>()
        .map_err(|error| Failure::Files(Box::new(error)))?;
    if command.json {
        let all: Vec<_> = designs
            .iter()
            .map(|(words, design)| serde_json::json!({ "words": words, "design": design }))
            .collect();
        let all = serde_json::json!({ "remedies": all });
        writeln!(out, "{all:#}")?;
        return Ok(Status::Good);
    }
    for (at, (words, design)) in designs.into_iter().enumerate() {
        // The output is one design file: the designs after the first are comments.
        let design = match at {
            0 => design,
            _ => design
                .lines()
                .fold(String::new(), |text, line| text + "# " + line + "\n"),
        };
        writeln!(out, "# {words}\n{design}")?;
    }
    Ok(Status::Good)
}
