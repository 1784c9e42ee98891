use std::io::Write;
use std::process::ExitCode;

use centrode::analysis::optimise::feeder::Widened;
use centrode::mechanism::design::Design;
use centrode::mechanism::feeder::Dimension;

use super::stored::Stored;
use crate::args::Optimise;
use crate::failure::Failure;
use crate::page::{Edit, edited};

/// Writes a feeder's design with the least widening of its bounds.
pub(super) fn run(
    command: &Optimise,
    design: &Design,
    text: &str,
    out: &mut impl Write,
) -> Result<ExitCode, Failure> {
    let usage = |error: &dyn std::error::Error| Failure::Usage(error.to_string());
    let Design::Feeder(design) = design else {
        let message = "only the bounds of a feeder can be widened".to_owned();
        return Err(Failure::Usage(message));
    };
    let widened = Widened::of(design).map_err(|error| usage(&error))?;
    let design = &widened.design;
    let lengths = Dimension::ALL
        .into_iter()
        .filter(|dimension| !dimension.is_of_pivot())
        .map(|d| Edit::number(d.key(), d.of(&design.linkage), false));
    let pivot = [Edit::list("linkage.pivot", &design.linkage.pivot)];
    // Whole lists: a file may leave its bounds out.
    let bounds = design.bounds.named();
    let bounds = bounds.map(|(name, ends)| Edit::list(&format!("bounds.{name}"), &ends));
    let edits: Vec<Edit> = lengths.chain(pivot).chain(bounds).collect();
    let better = edited(text, &edits).map_err(|error| usage(&error))?;
    Stored::beside(&command.output).write_design(&better)?;
    if command.json {
        let told = serde_json::json!({
            "share": widened.share, "linkage": design.linkage, "bounds": design.bounds,
        });
        serde_json::to_writer_pretty(&mut *out, &told).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(ExitCode::SUCCESS);
    }
    writeln!(
        out,
        "bounds widened by {:.4} %, rounded outwards to a thousandth of a millimetre\n",
        100.0 * widened.share
    )?;
    for (dimension, (_, [low, high])) in Dimension::ALL.into_iter().zip(design.bounds.named()) {
        let length = dimension.of(&design.linkage);
        writeln!(
            out,
            "  {:<8} {length:>9.3} mm, within {low:.3} to {high:.3}",
            dimension.name()
        )?;
    }
    let [x, y] = design.linkage.pivot;
    writeln!(out, "  {:<8} ({x:.3}, {y:.3}) mm", "pivot")?;
    writeln!(out, "\n{}", command.output.display())?;
    Ok(ExitCode::SUCCESS)
}
