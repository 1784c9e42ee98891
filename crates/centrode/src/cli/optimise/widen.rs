use std::io::Write;

use crate::family::OpenDesign;
use serde_json::json;

use super::stored::Stored;
use crate::cli::Status;
use crate::cli::args::Optimise;
use crate::cli::failure::Failure;
use crate::page::{Edit, edited};

/// Writes a design with the minimum widening of its bounds.
pub(super) fn run(
    command: &Optimise,
    file: &OpenDesign,
    text: &str,
    out: &mut impl Write,
) -> Result<Status, Failure> {
    let widened = file.family().widen(file.design());
    let widened = widened.map_err(|error| Failure::Usage(error.to_string()))?;
    let numbers = widened.numbers.iter();
    let numbers = numbers.map(|(key, value)| Edit::number(key, *value, false));
    let lists = widened.lists.iter();
    let lists = lists.map(|(key, values)| Edit::list(key, values));
    let edits: Vec<Edit> = numbers.chain(lists).collect();
    let better = edited(text, &edits).map_err(|error| Failure::Usage(error.to_string()))?;
    Stored::beside(&command.output).write_design(&better)?;
    if command.json {
        let mut stated = json!({ "share": widened.share });
        for (name, table) in widened.tables {
            stated[name] = table;
        }
        serde_json::to_writer_pretty(&mut *out, &stated).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(Status::Good);
    }
    writeln!(
        out,
        "bounds widened by {:.4} %, rounded outwards to 0.001 mm\n",
        100.0 * widened.share
    )?;
    for line in &widened.lines {
        writeln!(out, "  {line}")?;
    }
    writeln!(out, "\n{}", command.output.display())?;
    Ok(Status::Good)
}
