mod figures;
mod findings;
mod goals;

use std::io::Write;

use crate::analysis::{Report, ReportFile};
use crate::family::Mechanism;
use centrode_spec::Design;

pub(crate) use figures::write as write_figures;

/// The report as JSON with every digit; an infinite figure is the string "Infinity". Ends with a newline.
pub(crate) fn json(report: &Report, design: &dyn Design) -> std::io::Result<String> {
    let mut text = serde_json::to_string_pretty(&ReportFile::new(report, design))?;
    text.push('\n');
    Ok(text)
}

/// Writes the report as text: findings first, then goals, tables and the figures in groups.
pub(crate) fn write(
    mechanism: &dyn Mechanism,
    report: &Report,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let design = mechanism.design();
    let name = [design.name(), design.title()].map(str::trim);
    let name: Vec<&str> = name.into_iter().filter(|part| !part.is_empty()).collect();
    writeln!(out, "{}", name.join(": "))?;
    writeln!(out, "{}", mechanism.definition())?;
    writeln!(out)?;
    findings::write(report, out)?;
    goals::write(report, out)?;
    figures::write(report, &report.given(design), out)
}
