use std::io::Write;
use std::process::ExitCode;

use crate::args::Check;
use crate::failure::Failure;
use crate::input::Source;
use crate::progress::Progress;
use crate::report;

/// Resolves a design and prints its report.
pub(crate) fn run(command: &Check, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let source = Source::open(&command.design)?;
    let design = source.design()?;
    let progress = Progress::new(2);
    progress.step("cutting the teeth");
    let pair = design.gear_pair().map_err(|error| source.blame(error))?;
    progress.step("running the gears together");
    let report = centrode::analysis::check(&pair);
    drop(progress);
    if command.json {
        out.write_all(report::json(&report)?.as_bytes())?;
    } else {
        report::write(&pair, &report, out)?;
    }
    Ok(ExitCode::from(u8::from(!report.ok())))
}
