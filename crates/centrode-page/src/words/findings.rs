use centrode_analysis::{Finding, FlankPlace, Report, Severity};
use serde::Serialize;
use std::borrow::Cow;

/// Number of findings of each severity, in words.
pub fn summary(report: &Report) -> String {
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

/// A finding in words.
#[derive(Clone, Debug, Serialize)]
pub struct FindingWords {
    /// Rule.
    pub rule: &'static str,
    /// Severity.
    pub severity: Severity,
    /// The finding itself.
    pub message: String,
    /// Part, teeth and input.
    #[serde(rename = "where")]
    pub place: String,
    /// Flanks, each with the radius at which it ends; if there are many, the first ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flanks: Option<String>,
    /// Measured and required figure.
    pub figures: String,
    /// Remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<Cow<'static, str>>,
    /// Keys of the design that the finding depends on.
    pub causes: &'static [&'static str],
    /// Part at fault.
    pub part: Option<String>,
    /// Input at which it is found, rad.
    pub input: Option<f64>,
}

/// The words for a finding.
pub fn finding_words(finding: &Finding) -> FindingWords {
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
        // Adding zero removes the sign of a zero.
        let degrees = (100.0 * input.to_degrees()).round() / 100.0 + 0.0;
        about.push(format!("input at {degrees:.2} deg"));
    }
    let figures = finding.measured.map_or_else(String::new, |measured| {
        let show = |value: f64| finding.unit.with_unit(value);
        let required = finding
            .required
            .map(|required| format!(", required {}", show(required)));
        format!(
            "measured {}{}",
            show(measured),
            required.unwrap_or_default()
        )
    });
    FindingWords {
        rule: finding.rule,
        severity: finding.severity,
        message: finding.message.clone(),
        place: about.join("; "),
        flanks: flanks(&finding.place.flanks),
        figures,
        remedy: finding.remedy.clone(),
        causes: causes(finding.rule),
        part: finding.place.part.clone(),
        input: finding.place.input,
    }
}

/// Keys of the design on which a finding depends most.
fn causes(rule: &str) -> &'static [&'static str] {
    match rule {
        "cut-through" | "undercut" | "short-tooth" => &[
            "pitch.module",
            "tooth_count",
            "pitch.tooth_count",
            "teeth.addendum",
        ],
        "pointed" | "thin-tip" => &[
            "tool.addendum_coefficient",
            "tool.pressure_angle_deg",
            "driver.shift",
            "driven.shift",
        ],
        "no-flank" | "disengaged" | "contact-lost" | "seat-jump" => {
            &["pitch.module", "tooth_count", "pitch.tooth_count"]
        }
        "interference" | "tip-interference" => &["tool.dedendum_coefficient", "teeth.backlash"],
        "negative-backlash" => &["teeth.thickness_deviations", "teeth.backlash"],
        "pitch-curve-corner" => &["pitch.radius", "pitch.ratio", "pitch.driven_angle_deg"],
        "noisy-law" => &[
            "pitch.smooth",
            "pitch.file",
            "pitch.radius",
            "pitch.ratio",
            "pitch.driven_angle_deg",
        ],
        "scaled-mean" => &[
            "pitch.file",
            "pitch.ratio",
            "pitch.driven_angle_deg",
            "mean_ratio",
        ],
        "pressure-angle" => &["pitch.eccentricity", "tool.pressure_angle_deg"],
        "shaper-radius" => &["tool.tooth_count"],
        "pitch-curve-swings" => &["pitch.expression"],
        "pitch-curves-overlap" => &[
            "pitch.expression",
            "pitch.eccentricity",
            "pitch.amplitude",
            "pitch.lobes",
            "mean_ratio",
        ],
        _ => &[],
    }
}

/// Tooth, side and end radius of flanks; if there are many, the first ones.
fn flanks(flanks: &[FlankPlace]) -> Option<String> {
    const SHOWN: usize = 6;
    let one = |flank: &FlankPlace| {
        let end = match flank.radius {
            Some(radius) => format!("ends at radius {radius:.3} mm"),
            None => "is gone".into(),
        };
        format!("{} {} {end}", flank.tooth, flank.side)
    };
    let mut words: Vec<String> = flanks.iter().take(SHOWN).map(one).collect();
    if flanks.len() > SHOWN {
        words.push(format!("and {} more (--json)", flanks.len() - SHOWN));
    }
    (!words.is_empty()).then(|| words.join(", "))
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
    use centrode_analysis::Unit;

    #[test]
    fn runs_of_teeth_are_short() {
        assert_eq!(
            ranges(&[0, 1, 2, 5, 8, 9, 12, 13, 14, 15]),
            "0-2, 5, 8, 9, 12-15"
        );
    }

    #[test]
    fn an_angle_is_in_degrees_whatever_its_size() {
        for (measured, figures) in [
            (2e-9, "measured 1.1e-7 deg, required 0 deg"),
            (1e-6, "measured 5.7e-5 deg, required 0 deg"),
            (6.235e-6, "measured 3.6e-4 deg, required 0 deg"),
            (8.7e-5, "measured 5.0e-3 deg, required 0 deg"),
            (9.9e-4, "measured 0.0567 deg, required 0 deg"),
            (1e-3, "measured 0.0573 deg, required 0 deg"),
            (1.01e-3, "measured 0.0579 deg, required 0 deg"),
            (-5e-4, "measured -0.0286 deg, required 0 deg"),
            (0.0, "measured 0 deg, required 0 deg"),
            (1.6, "measured 91.6732 deg, required 0 deg"),
        ] {
            let finding = Finding::new("contact-lost", Severity::Note, String::new()).measured(
                measured,
                0.0,
                Unit::Angle,
            );
            assert_eq!(
                finding_words(&finding).figures.replace('\u{a0}', " "),
                figures
            );
        }
    }
}
