use std::io::Write;
use std::process::ExitCode;

use clap::CommandFactory as _;

use crate::args::{Arguments, Completions};
use crate::failure::Failure;

/// Prints a completion script.
pub(crate) fn run(command: &Completions, out: &mut impl Write) -> Result<ExitCode, Failure> {
    // The generator panics when its writer fails: it writes to memory.
    let mut script = Vec::new();
    let mut program = Arguments::command();
    clap_complete::generate(command.shell, &mut program, "centrode", &mut script);
    out.write_all(&script)?;
    Ok(ExitCode::SUCCESS)
}
