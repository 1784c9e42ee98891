use std::io::Write;
use std::path::{Path, PathBuf};

use crate::cli::args::Prove;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::{Status, output};
use crate::family::NotProved;

/// Writes the certificates of a machine's gear pairs.
pub(crate) fn run(command: &Prove, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    source.keep_from(&command.output)?;
    let design = source.design()?;
    let progress = Progress::new(2);
    progress.step("resolving the design");
    let mechanism = design.mechanism().map_err(|error| source.blame(error))?;
    progress.step("following the contact");
    let proofs = mechanism.proofs(command.pair.as_deref());
    drop(progress);
    let proofs = proofs.map_err(|error| match error {
        NotProved::NoPairs { .. } | NotProved::Unknown { .. } => Failure::Usage(error.to_string()),
        error => Failure::Files(Box::new(error)),
    })?;
    let is_alone = proofs.len() == 1;
    let mut failed = None;
    for (name, proof) in proofs {
        let mut proof = match proof {
            Ok(proof) => proof,
            Err(error) => {
                failed = failed.or(Some(error));
                continue;
            }
        };
        // The unchanged design file, so that a checker can verify that the certificate belongs to this design.
        proof.design = source.text()?;
        let bytes = proof.file().map_err(std::io::Error::from)?;
        let path = match is_alone {
            true => command.output.clone(),
            false => of_pair(&command.output, &name),
        };
        output::write_one(&path, bytes, out)?;
    }
    match failed {
        Some(error) => Err(Failure::Files(Box::new(error))),
        None => Ok(Status::Good),
    }
}

/// Path of a file next to another one, with the name of a pair in its file name.
fn of_pair(path: &Path, pair: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let end = path
        .extension()
        .map(|end| format!(".{}", end.to_string_lossy()));
    path.with_file_name(format!("{stem}-{pair}{}", end.unwrap_or_default()))
}
