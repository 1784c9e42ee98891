use std::io::Write;
use std::process::ExitCode;

use centrode::FAMILIES;

use crate::args::Schema;
use crate::failure::Failure;

/// Prints the JSON schema of the design file.
pub(crate) fn run(command: &Schema, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let schema = match &command.family {
        None => FAMILIES.json_schema(),
        Some(word) => match FAMILIES.named(word) {
            Some(family) => family.design.json_schema(),
            None => return Err(Failure::Usage(format!("unknown family {word:?}"))),
        },
    };
    writeln!(out, "{schema:#}")?;
    Ok(ExitCode::SUCCESS)
}
