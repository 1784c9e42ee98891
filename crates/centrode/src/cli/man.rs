use std::io::Write;

use clap::CommandFactory as _;

use crate::cli::Status;
use crate::cli::args::{Arguments, Man};
use crate::cli::failure::Failure;

/// Prints a man page.
pub(crate) fn run(command: &Man, out: &mut impl Write) -> Result<Status, Failure> {
    let mut program = Arguments::command();
    program.build();
    let described = match &command.command {
        None => program,
        Some(name) => match program.find_subcommand(name) {
            Some(found) => found.clone(),
            None => return Err(Failure::Usage(format!("unknown command {name:?}"))),
        },
    };
    clap_mangen::Man::new(described).render(out)?;
    Ok(Status::Good)
}
