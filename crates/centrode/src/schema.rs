use std::io::Write;
use std::process::ExitCode;

use centrode::mechanism::design::Design;

use crate::args::Schema;
use crate::failure::Failure;

/// Files beside the design file that have a schema.
pub(crate) const FILES: [&str; 2] = ["machine-model", "motion"];

/// Prints the JSON schema of the design file, or of a file that is exported.
pub(crate) fn run(command: &Schema, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let family = command.family.as_deref();
    let file = match family {
        Some("machine-model") => Some(centrode::export::machine::schema()),
        Some("motion") => Some(centrode::export::machine::motion_schema()),
        _ => None,
    };
    if let Some(schema) = file {
        writeln!(out, "{schema:#}")?;
        return Ok(ExitCode::SUCCESS);
    }
    let schema = family.map_or_else(|| Some(Design::json_schema()), Design::json_schema_of);
    let Some(schema) = schema else {
        let family = family.unwrap_or_default();
        return Err(Failure::Usage(format!("unknown family {family:?}")));
    };
    writeln!(out, "{schema:#}")?;
    Ok(ExitCode::SUCCESS)
}
