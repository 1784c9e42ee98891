use std::io::Write;
use std::process::ExitCode;

use centrode::analysis::Report;
use centrode::mechanism::gear::GearPair;

use crate::args::Check;
use crate::failure::Failure;
use crate::input::Source;

/// Resolves a design and prints its report.
pub(crate) fn run(command: &Check, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let source = Source::open(&command.design)?;
    let design = source.design()?;
    let pair = design.gear_pair().map_err(|error| source.blame(error))?;
    let report = centrode::analysis::check(&pair);
    if command.json {
        let json = serde_json::to_string_pretty(&report).map_err(std::io::Error::from)?;
        writeln!(out, "{json}")?;
    } else {
        print(&pair, &report, out)?;
    }
    Ok(ExitCode::from(u8::from(!report.ok())))
}

fn print(pair: &GearPair, report: &Report, out: &mut impl Write) -> std::io::Result<()> {
    let (driver, driven) = pair.mean_ratio();
    writeln!(out, "{}  {}", pair.name(), pair.title())?;
    writeln!(out, "pitch curve: {}", pair.definition())?;
    writeln!(out, "mean ratio {driver}:{driven}")?;
    let width = report.values.keys().map(|k| k.len()).max().unwrap_or(0);
    for (name, value) in &report.values {
        writeln!(out, "  {name:width$}  {value:.6}")?;
    }
    for finding in &report.findings {
        writeln!(out, "{:?}: {}", finding.severity, finding.message)?;
    }
    Ok(())
}
