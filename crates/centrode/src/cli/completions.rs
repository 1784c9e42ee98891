use std::io::Write;

use clap::CommandFactory as _;

use crate::cli::Status;
use crate::cli::args::{Arguments, Completions};
use crate::cli::failure::Failure;

/// Prints a completion script.
pub(crate) fn run(command: &Completions, out: &mut impl Write) -> Result<Status, Failure> {
    // The generator panics if its writer fails, so it writes to memory.
    let mut script = Vec::new();
    let mut program = Arguments::command();
    clap_complete::generate(command.shell, &mut program, "centrode", &mut script);
    out.write_all(&script)?;
    Ok(Status::Good)
}
