use std::io::Write;
use std::process::ExitCode;

use centrode::FAMILIES;

use crate::args::New;
use crate::failure::Failure;

/// Prints the template of a family.
pub(crate) fn run(command: &New, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let Some(template) = FAMILIES.template(&command.family) else {
        return Err(Failure::Usage(format!(
            "unknown family {:?}",
            command.family
        )));
    };
    out.write_all(template.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
