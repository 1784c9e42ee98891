use std::io::Write;

use crate::FAMILIES;
use crate::formats::write_new_file;

use crate::cli::Status;
use crate::cli::args::New;
use crate::cli::failure::Failure;
use crate::cli::shipped::{shipped, shipped_of};

/// Prints or writes a template or a shipped design; without a name, lists both.
pub(crate) fn run(command: &New, out: &mut impl Write) -> Result<Status, Failure> {
    let Some(name) = command.name.as_deref() else {
        list(out)?;
        return Ok(Status::Good);
    };
    let text = FAMILIES.template(name).or_else(|| shipped(name));
    let text = text.ok_or_else(|| Failure::Usage(format!("unknown design {name:?}")))?;
    match &command.output {
        None => out.write_all(text.as_bytes())?,
        Some(path) if path.exists() => {
            let message = format!("{} exists: choose another name", path.display());
            return Err(Failure::Usage(message));
        }
        Some(path) => {
            write_new_file(path, text.as_bytes())?;
            writeln!(out, "{}", path.display())?;
        }
    }
    Ok(Status::Good)
}

/// Families with their templates, and the shipped designs of each below it, one line each.
fn list(out: &mut impl Write) -> std::io::Result<()> {
    for family in FAMILIES.0 {
        let design = &family.design;
        writeln!(out, "{:<25}{}", design.word, design.about)?;
        for (name, title) in shipped_of(design.word) {
            writeln!(out, "  {name:<23}{title}")?;
        }
    }
    Ok(())
}
