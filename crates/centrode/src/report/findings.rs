use std::io::{Result, Write};

use anstyle::{AnsiColor, Style};
use centrode::analysis::{Finding, Report, Severity};

use super::figures::figure;

/// Writes how many findings there are, then each: severity, rule, where, what, by how much, what helps.
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    writeln!(out, "{}", summary(report))?;
    for finding in &report.findings {
        one(finding, out)?;
    }
    Ok(())
}

/// How many findings of each severity there are, in words.
pub(crate) fn summary(report: &Report) -> String {
    let counts = [
        (Severity::Error, "error", "errors"),
        (Severity::Warning, "warning", "warnings"),
        (Severity::Note, "note", "notes"),
    ];
    let words: Vec<String> = counts
        .into_iter()
        .filter_map(|(severity, one, many)| {
            let of = |finding: &&Finding| finding.severity == severity;
            match report.findings.iter().filter(of).count() {
                0 => None,
                1 => Some(format!("1 {one}")),
                n => Some(format!("{n} {many}")),
            }
        })
        .collect();
    if words.is_empty() {
        "no findings".into()
    } else {
        words.join(", ")
    }
}

fn one(finding: &Finding, out: &mut impl Write) -> Result<()> {
    let (word, color) = match finding.severity {
        Severity::Error => ("error", AnsiColor::Red),
        Severity::Warning => ("warning", AnsiColor::Yellow),
        Severity::Note => ("note", AnsiColor::Cyan),
    };
    let style: Style = color.on_default().bold();
    writeln!(
        out,
        "{style}{word}{style:#} [{}] {}",
        finding.rule, finding.message
    )?;
    let mut about = Vec::new();
    if let Some(part) = &finding.place.part {
        let teeth = match finding.place.teeth.as_slice() {
            [] => String::new(),
            [tooth] => format!(", tooth {tooth}"),
            teeth => format!(", teeth {}", ranges(teeth)),
        };
        about.push(format!("{part}{teeth}"));
    }
    if let Some(input) = finding.place.input {
        about.push(format!("input at {:.2} deg", input.to_degrees()));
    }
    if !about.is_empty() {
        writeln!(out, "    where: {}", about.join("; "))?;
    }
    if let Some(measured) = finding.measured {
        let (factor, unit) = match finding.unit {
            "rad" if measured.abs() > 1e-3 => (180.0 / std::f64::consts::PI, " deg"),
            "rad" => (1.0, " rad"),
            "" => (1.0, ""),
            _ => (1.0, " mm"),
        };
        let show = |value: f64| format!("{}{unit}", figure(value * factor, 4));
        write!(out, "    measured {}", show(measured))?;
        if let Some(required) = finding.required {
            write!(out, ", required {}", show(required))?;
        }
        writeln!(out)?;
    }
    if let Some(remedy) = finding.remedy {
        writeln!(out, "    remedy: {remedy}")?;
    }
    Ok(())
}

/// Tooth numbers in rising order, runs of three or more shortened to first and last.
fn ranges(teeth: &[u32]) -> String {
    let mut words: Vec<String> = Vec::new();
    for run in teeth.chunk_by(|a, b| a + 1 == *b) {
        match run {
            [first, _, .., last] => words.push(format!("{first}-{last}")),
            few => words.extend(few.iter().map(u32::to_string)),
        }
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode::analysis::Place;

    #[test]
    fn runs_of_teeth_are_short() {
        assert_eq!(
            ranges(&[0, 1, 2, 5, 8, 9, 12, 13, 14, 15]),
            "0-2, 5, 8, 9, 12-15"
        );
    }

    #[test]
    fn a_finding_says_where_how_much_and_what_helps() {
        let report = Report {
            findings: vec![Finding {
                rule: "undercut",
                severity: Severity::Warning,
                message: "3 of 23 teeth of the driver are undercut".into(),
                measured: Some(0.0312),
                required: Some(0.0),
                unit: "mm",
                remedy: Some("fewer teeth of a larger module"),
                place: Place {
                    part: Some("driver".into()),
                    teeth: vec![4, 5, 6],
                    input: Some(std::f64::consts::PI),
                },
            }],
            ..Report::default()
        };
        let mut out = anstream::StripStream::new(Vec::new());
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out.into_inner()).expect("text");
        assert_eq!(
            text,
            "1 warning\nwarning [undercut] 3 of 23 teeth of the driver are undercut\n    \
             where: driver, teeth 4-6; input at 180.00 deg\n    measured 0.0312 mm, required 0\u{20}mm\n    \
             remedy: fewer teeth of a larger module\n"
        );
    }
}
