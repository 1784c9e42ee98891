mod figures;
mod findings;

use std::io::Write;

use centrode::analysis::{Finding, Report};
use centrode::mechanism::gear::GearPair;
use serde::Serialize;

pub(crate) use findings::summary;

/// The report as other programs read it.
#[derive(Serialize)]
struct Json<'a> {
    ok: bool,
    findings: &'a [Finding],
    values: &'a std::collections::BTreeMap<&'static str, f64>,
}

/// The report as JSON with every digit; an infinite figure is null. Ends with a newline.
pub(crate) fn json(report: &Report) -> std::io::Result<String> {
    let json = Json {
        ok: report.ok(),
        findings: &report.findings,
        values: &report.values,
    };
    let mut text = serde_json::to_string_pretty(&json)?;
    text.push('\n');
    Ok(text)
}

/// The report as a person reads it: findings first, then the figures in groups.
pub(crate) fn write(pair: &GearPair, report: &Report, out: &mut impl Write) -> std::io::Result<()> {
    let (driver, driven) = pair.mean_ratio();
    let name = [pair.name(), pair.title()].map(str::trim);
    let name: Vec<&str> = name.into_iter().filter(|part| !part.is_empty()).collect();
    writeln!(out, "{}", name.join(": "))?;
    writeln!(out, "{}; mean ratio {driver}:{driven}", pair.definition())?;
    writeln!(out)?;
    findings::write(report, out)?;
    figures::write(report, out)
}
