//! The program `centrode`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(centrode::cli::run(std::env::args_os().skip(1)))
}
