use std::io::Write;
use std::process::ExitCode;

use centrode::FAMILIES;

use crate::args::Schema;
use crate::failure::Failure;

/// Files beside the design file that have a schema.
pub(crate) const FILES: [&str; 2] = ["machine-model", "motion"];

/// Prints the JSON schema of the design file, or of a file that is exported.
pub(crate) fn run(command: &Schema, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let schema = match command.family.as_deref() {
        None => FAMILIES.json_schema(),
        Some("machine-model") => centrode::export::machine::schema(),
        Some("motion") => centrode::export::machine::motion_schema(),
        Some(word) => match FAMILIES.named(word) {
            Some(family) => family.design.json_schema(),
            None => return Err(Failure::Usage(format!("unknown family {word:?}"))),
        },
    };
    writeln!(out, "{schema:#}")?;
    Ok(ExitCode::SUCCESS)
}
