use std::io::Write;

use crate::export::page;

use crate::cli::Status;
use crate::cli::args::Report;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::output;
use crate::cli::page::Subject;
use crate::cli::progress::Progress;

/// Writes a design's page as one file that needs no other.
pub(crate) fn run(command: &Report, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open(&command.design)?;
    source.keep_from(&command.output)?;
    let design = source.design()?;
    let progress = Progress::new(2);
    progress.step("resolving the design");
    let text = source.text()?;
    let subject = match Subject::from_text(text) {
        Ok(subject) => subject,
        // Resolving once more gives the error with its line.
        Err(_) => {
            design.mechanism().map_err(|error| source.blame(error))?;
            return Err(Failure::Usage("not a design".into()));
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
    Ok(Status::new(snapshot.ok()))
}
