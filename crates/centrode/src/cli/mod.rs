//! The command line: `centrode new`, `check`, `export` and the other commands.
//!
//! Unlike the rest of the library, this module prints, reads and writes files, and catches signals. It is a whole
//! program behind one function. The program `centrode` and the command of the Python package call that function.

mod args;
mod check;
mod completions;
mod drive;
mod export;
mod failure;
mod input;
mod interrupt;
mod man;
mod new;
mod optimise;
mod output;
mod progress;
mod prove;
mod report;
mod response;
mod reverse;
mod schema;
mod sheet;
mod shipped;
mod studio;

use std::ffi::OsString;
use std::io::Write as _;

use clap::Parser as _;

use crate::InternalFault;
use args::{Arguments, Command};
use failure::Failure;

/// Outcome of a command that did its job.
#[derive(Clone, Copy)]
pub(crate) enum Status {
    /// Nothing is wrong.
    Good,
    /// A finding is of severity error.
    Bad,
}

impl Status {
    pub(crate) fn new(good: bool) -> Self {
        if good { Self::Good } else { Self::Bad }
    }
}

/// Runs the program with its arguments, without its own name, and returns its exit status.
///
/// The status is 0 if all is good, 1 for a finding of severity error, 2 if there is no mechanism, a file cannot be read or
/// written or the usage is bad, 101 if the program is at fault, and 130 after Ctrl-C in a command that catches it. All printed
/// text has been written when the function returns.
#[must_use]
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let status = InternalFault::catch(|| command(arguments)).unwrap_or_else(|fault| {
        let _ = Failure::Internal(fault).write(&mut anstream::stderr());
        101
    });
    // The buffer may still hold an unfinished line; if nobody reads the output any more, nothing is lost.
    let _ = std::io::stdout().flush();
    status
}

fn command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let words = std::iter::once(OsString::from("centrode")).chain(arguments);
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no failures, and neither is a closed output.
            let _ = error.print();
            return if error.use_stderr() { 2 } else { 0 };
        }
    };
    #[cfg(unix)]
    // If this fails, a write beyond the limit ends the program; commands can still run.
    let _ = output::heed_file_limit();
    // The requests of the page wait on threads of their own, so the studio needs no preparation.
    if !matches!(arguments.command, Command::Studio(_)) {
        crate::analysis::prepare_threads();
    }
    let mut out = std::io::BufWriter::new(anstream::stdout());
    let result = match &arguments.command {
        Command::New(command) => new::run(command, &mut out),
        Command::Check(command) => check::run(command, &mut out),
        Command::Export(command) => export::run(command, &mut out),
        Command::Optimise(command) => optimise::run(command, &mut out),
        Command::Response(command) => response::run(command, &mut out),
        Command::Drive(command) => drive::run(command, &mut out),
        Command::Reverse(command) => reverse::run(command, &mut out),
        Command::Studio(command) => studio::run(command, &mut out),
        Command::Report(command) => sheet::run(command, &mut out),
        Command::Prove(command) => prove::run(command, &mut out),
        Command::Schema(command) => schema::run(command, &mut out),
        Command::Completions(command) => completions::run(command, &mut out),
        Command::Man(command) => man::run(command, &mut out),
    };
    let result = result.and_then(|status| out.flush().map(|()| status).map_err(Failure::Output));
    // Bytes still buffered would fail again when dropped.
    let _ = out.into_parts();
    match result {
        Ok(Status::Good) => 0,
        Ok(Status::Bad) => 1,
        Err(Failure::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => 0,
        Err(Failure::Interrupted) => 130,
        Err(failure) => {
            let _ = failure.write(&mut anstream::stderr());
            2
        }
    }
}
