//! The command line: `centrode new`, `check`, `export` and the rest.

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
mod page;
mod progress;
mod prove;
mod report;
mod response;
mod reverse;
mod schema;
mod sheet;
mod studio;

use std::io::Write as _;
use std::process::ExitCode;

use clap::Parser as _;

use args::{Arguments, Command};
use failure::Failure;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no failures; a reader that has gone is none either.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { 2 } else { 0 });
        }
    };
    #[cfg(unix)]
    // Without it such a write ends the program: no reason not to begin.
    let _ = output::heed_file_limit();
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
    let result = result.and_then(|code| out.flush().map(|()| code).map_err(Failure::Output));
    // Bytes still buffered would fail again when dropped.
    let _ = out.into_parts();
    match result {
        Ok(code) => code,
        Err(Failure::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(Failure::Interrupted) => ExitCode::from(130),
        Err(failure) => {
            let _ = failure.write(&mut anstream::stderr());
            ExitCode::from(2)
        }
    }
}
