use std::io::Write;

use crate::cli::Status;
use crate::cli::args::Prove;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::output;
use crate::cli::progress::Progress;

/// Writes the certificate of a pair's contact.
pub(crate) fn run(command: &Prove, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open(&command.design)?;
    source.keep_from(&command.output)?;
    let design = source.design()?;
    let progress = Progress::new(2);
    progress.step("resolving the design");
    let mechanism = design.mechanism().map_err(|error| source.blame(error))?;
    progress.step("following the contact");
    let proof = mechanism.proof();
    drop(progress);
    let Some(proof) = proof else {
        let family = mechanism.design().family().word;
        return Err(Failure::Usage(format!(
            "there is no certificate for family {family:?}, only for \"gear-pair\""
        )));
    };
    let mut proof = proof.map_err(|error| Failure::Files(Box::new(error)))?;
    // The file as it stands, so that a checker can tell that it is this design's.
    proof.design = source.text()?;
    let bytes = proof.file().map_err(std::io::Error::from)?;
    output::write_one(&command.output, bytes, out)?;
    Ok(Status::Good)
}
