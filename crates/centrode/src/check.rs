use std::io::Write;
use std::process::ExitCode;

use centrode::analysis::Report;

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
    progress.step("resolving the design");
    let mechanism = design.mechanism().map_err(|error| source.blame(error))?;
    if command.figures {
        drop(progress);
        let tables = mechanism.figures();
        if tables.is_empty() {
            let family = mechanism.design().family().word;
            return Err(Failure::Usage(format!(
                "the goals of family {family:?} are given: only those of family \"machine\" name figures"
            )));
        }
        let report = Report {
            tables,
            ..Report::default()
        };
        if command.json {
            out.write_all(report::json(&report)?.as_bytes())?;
        } else {
            report::write_figures(&report, out)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    progress.step("checking");
    let report = mechanism.check();
    drop(progress);
    if command.json {
        out.write_all(report::json(&report)?.as_bytes())?;
    } else {
        report::write(mechanism.as_ref(), &report, out)?;
    }
    Ok(ExitCode::from(u8::from(!report.ok())))
}
