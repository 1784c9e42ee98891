//! How severe a finding is: one rule for every family, in docs/findings.md.

use std::cmp::Reverse;

use schemars::JsonSchema;
use serde::Serialize;

use crate::Finding;

/// Severity of a finding.
#[derive(Clone, Copy, Debug, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Nobody can make or measure it, or it is no fault: what the check chose or could not examine.
    Note,
    /// The part works, but worse than a good one.
    Warning,
    /// The part cannot work, or it misses what the design requires.
    Error,
}

/// Maximum length that is too small to make or to measure, mm: half the default tolerance of the files. Ten times more hides
/// overlaps that are felt in a mesh; ten times less reports rounding of the files as faults.
const MEASURABLE: f64 = 0.005;

impl Severity {
    /// Severity of bodies or flanks that overlap by a depth, mm.
    pub(crate) fn of_overlap(depth: f64) -> Self {
        if depth > MEASURABLE {
            Self::Error
        } else {
            Self::Note
        }
    }

    /// Severity of a deviation of a length, mm, if the part still works.
    pub(crate) fn of_deviation(length: f64) -> Self {
        if length > MEASURABLE {
            Self::Warning
        } else {
            Self::Note
        }
    }

    /// Severity of a pressure angle above its usual limit, rad: from 90 degrees on the force no longer drives.
    pub(crate) fn of_pressure_angle(angle: f64) -> Self {
        if angle >= std::f64::consts::FRAC_PI_2 {
            Self::Error
        } else {
            Self::Warning
        }
    }
}

/// Rules whose findings cause others, each before the rules of its consequences. All other rules come last.
const CAUSES: [&str; 26] = [
    "detail",
    "noisy-law",
    "pitch-curves-overlap",
    "pitch-curve-corner",
    "shaper-radius",
    "pressure-angle",
    "teeth",
    "tooth-phase",
    "cut-through",
    "undercut",
    "short-tooth",
    "pointed",
    "no-flank",
    "no-gears",
    "disengaged",
    "contact-lost",
    "interference",
    "tip-interference",
    "negative-backlash",
    "seat-jump",
    "cam-undercut",
    "cam-pressure-angle",
    "forces-undetermined",
    "transmission-angle",
    "excessive-force",
    "jamming",
];

/// Puts the worst findings first, and among equals causes before their consequences.
pub(crate) fn worst_first(findings: &mut [Finding]) {
    let rank = |rule: &str| CAUSES.iter().position(|cause| *cause == rule);
    findings.sort_by_key(|finding| {
        let rank = rank(finding.rule).unwrap_or(CAUSES.len());
        (Reverse(finding.severity), rank)
    });
}
