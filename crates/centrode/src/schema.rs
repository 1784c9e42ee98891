use std::io::Write;
use std::process::ExitCode;

use centrode::mechanism::design::Design;

use crate::failure::Failure;

/// Prints the JSON schema of the design file.
pub(crate) fn run(out: &mut impl Write) -> Result<ExitCode, Failure> {
    writeln!(out, "{:#}", Design::json_schema())?;
    Ok(ExitCode::SUCCESS)
}
