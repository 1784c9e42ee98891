use std::io::Write;

use crate::FAMILIES;

use crate::cli::Status;
use crate::cli::args::New;
use crate::cli::failure::Failure;

/// Prints the template of a family.
pub(crate) fn run(command: &New, out: &mut impl Write) -> Result<Status, Failure> {
    let Some(template) = FAMILIES.template(&command.family) else {
        return Err(Failure::Usage(format!(
            "unknown family {:?}",
            command.family
        )));
    };
    out.write_all(template.as_bytes())?;
    Ok(Status::Good)
}
