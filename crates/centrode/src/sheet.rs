use std::io::Write;
use std::process::ExitCode;

use centrode::export::page;

use crate::args::Report;
use crate::failure::Failure;
use crate::input::Source;
use crate::output;
use crate::page::Subject;
use crate::progress::Progress;

/// Writes a design's page as one file that needs no other.
pub(crate) fn run(command: &Report, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let source = Source::open(&command.design)?;
    source.keep_from(&command.output)?;
    let design = source.design()?;
    let progress = Progress::new(2);
    progress.step("resolving the design");
    let text = source.text()?;
    let subject = match Subject::of(text) {
        Ok(subject) => subject,
        // Resolving once more gives the error with its line.
        Err(_) => {
            return design
                .mechanism()
                .map(|_| ExitCode::from(2))
                .map_err(|e| source.blame(e));
        }
    };
    progress.step("checking");
    let snapshot = subject.checked();
    drop(progress);
    let html = page::report(
        snapshot.heading(),
        &snapshot.json().map_err(std::io::Error::from)?,
    );
    output::write_one(&command.output, html.into_bytes(), out)?;
    Ok(ExitCode::from(u8::from(!snapshot.ok())))
}
