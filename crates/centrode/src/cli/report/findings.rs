use std::io::{Result, Write};

use crate::analysis::{Finding, Report, Severity};
use crate::page::words::{finding_words, summary};
use anstyle::{AnsiColor, Style};

/// Writes the number of findings, then each: severity, rule, position, figures, remedy.
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    writeln!(out, "{}", summary(report))?;
    for finding in &report.findings {
        one(finding, out)?;
    }
    Ok(())
}

fn one(finding: &Finding, out: &mut impl Write) -> Result<()> {
    let (word, color) = match finding.severity {
        Severity::Error => ("error", AnsiColor::Red),
        Severity::Warning => ("warning", AnsiColor::Yellow),
        Severity::Note => ("note", AnsiColor::Cyan),
    };
    let style: Style = color.on_default().bold();
    let words = finding_words(finding);
    writeln!(
        out,
        "{style}{word}{style:#} [{}] {}",
        words.rule, words.message
    )?;
    if !words.place.is_empty() {
        writeln!(out, "    where: {}", words.place)?;
    }
    if let Some(flanks) = words.flanks {
        writeln!(out, "    flanks: {flanks}")?;
    }
    if !words.figures.is_empty() {
        writeln!(out, "    {}", words.figures)?;
    }
    if let Some(remedy) = words.remedy {
        writeln!(out, "    remedy: {remedy}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{FlankPlace, Unit};

    #[test]
    fn a_finding_says_where_how_much_and_what_helps() {
        let report = Report {
            findings: vec![
                Finding::new(
                    "undercut",
                    Severity::Warning,
                    "3 of 23 teeth of the driver are undercut",
                )
                .measured(0.0312, 0.0, Unit::Millimetre)
                .remedy("fewer teeth of a larger module")
                .on("driver")
                .at(std::f64::consts::PI)
                .teeth(
                    vec![4, 5, 6],
                    vec![FlankPlace {
                        tooth: 4,
                        side: "trailing",
                        radius: Some(21.340_4),
                    }],
                ),
            ],
            ..Report::default()
        };
        let mut out = anstream::StripStream::new(Vec::new());
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out.into_inner()).expect("text");
        assert_eq!(
            text,
            "1 warning\nwarning [undercut] 3 of 23 teeth of the driver are undercut\n    \
             where: driver, teeth 4-6; input at 180.00 deg\n    flanks: 4 trailing ends at radius 21.340 mm\n    measured 0.0312 mm, required 0\u{20}mm\n    \
             remedy: fewer teeth of a larger module\n"
        );
    }
}
