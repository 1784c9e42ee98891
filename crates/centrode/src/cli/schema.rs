use std::io::Write;

use crate::FAMILIES;
use centrode_machines::machine::FIGURE_FORMS;
use centrode_spec::DesignFamily;
use centrode_synthesis::reverse::PathDesign;

use crate::cli::Status;
use crate::cli::args::Schema;
use crate::cli::failure::Failure;

/// Words apart from the families that have a schema: the figures of a composed machine, and exported files.
pub(crate) const FILES: [&str; 6] = [
    "figures",
    "machine-model",
    "motion",
    "path",
    "proof",
    "report",
];

/// Grammar of the figures of a composed machine: form, meaning, unit.
fn figures() -> serde_json::Value {
    let form = |[form, meaning, unit]: [&str; 3]| serde_json::json!({ "form": form, "meaning": meaning, "unit": unit });
    FIGURE_FORMS.map(form).into_iter().collect()
}

/// Prints the JSON schema of the design file, or of a file that is exported.
pub(crate) fn run(command: &Schema, out: &mut impl Write) -> Result<Status, Failure> {
    let schema = match command.family.as_deref() {
        None => FAMILIES.json_schema(),
        Some("figures") => figures(),
        Some("machine-model") => crate::export::linked::schema(),
        Some("motion") => crate::export::linked::motion_schema(),
        Some("path") => DesignFamily::new::<PathDesign>().json_schema(),
        Some("report") => crate::analysis::ReportFile::schema(),
        Some("proof") => crate::analysis::Proof::schema(),
        Some(word) => match FAMILIES.named(word) {
            Some(family) => family.design.json_schema(),
            None => return Err(Failure::Usage(format!("unknown family {word:?}"))),
        },
    };
    writeln!(out, "{schema:#}")?;
    Ok(Status::Good)
}
