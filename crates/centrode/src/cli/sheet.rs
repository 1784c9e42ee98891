use std::io::Write;

use crate::family::OpenDesign;
use crate::page;

use crate::cli::args::Report;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::{Status, output};
use crate::page::Subject;

/// Writes a design's page as one file that needs no other file.
pub(crate) fn run(command: &Report, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    source.keep_from(&command.output)?;
    let design = source.design()?;
    let progress = Progress::new(1);
    progress.step("checking");
    let (html, ok) = page(&source, &design)?;
    drop(progress);
    output::write_one(&command.output, html.into_bytes(), out)?;
    Ok(Status::new(ok))
}

/// The page of a design as one file, and whether the check of the mechanism finds no error.
pub(crate) fn page(source: &Source, design: &OpenDesign) -> Result<(String, bool), Failure> {
    let subject = match Subject::from_text(source.text()?) {
        Ok(subject) => subject,
        // Resolving once more gives the error with its line.
        Err(_) => {
            design.mechanism().map_err(|error| source.blame(error))?;
            return Err(Failure::Usage("not a design".into()));
        }
    };
    let snapshot = subject.checked();
    let json = snapshot.json().map_err(std::io::Error::from)?;
    Ok((page::report(snapshot.heading(), &json), snapshot.ok()))
}
