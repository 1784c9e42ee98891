use std::collections::BTreeMap;

use serde::Serialize;

use crate::Goal;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing; the part works as asked.
    Note,
    /// The part works, but worse than a good one.
    Warning,
    /// The part does not do its job.
    Error,
}

/// Where in the mechanism and its cycle a finding was made.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Place {
    /// Link or part, as named in the design.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Tooth numbers, counted from zero counter-clockwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub teeth: Vec<u32>,
    /// Input angle, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub input: Option<f64>,
}

/// A way in which a mechanism is worse than it should be: measured, required, where.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Short stable name of the rule, such as `undercut`.
    pub rule: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// One sentence for a person.
    pub message: String,
    /// The measured figure, in `unit`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<f64>,
    /// The figure it is held against, in `unit`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required: Option<f64>,
    /// Unit of both figures: `mm`, `rad`, or empty for a plain number.
    pub unit: &'static str,
    /// What usually helps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<&'static str>,
    /// Where it was found.
    pub place: Place,
}

/// Figures in rows and columns.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// Short stable name.
    pub name: &'static str,
    /// What the figures are.
    pub title: &'static str,
    /// Unit of every figure: `mm`, `rad`, `N`, or empty for a plain number.
    pub unit: &'static str,
    /// What each column is of.
    pub columns: Vec<String>,
    /// What each row is of, and its figures.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// All findings and figures of one mechanism.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// What is wrong or worth knowing, worst first.
    pub findings: Vec<Finding>,
    /// Figures by name; the unit is in the documentation of the check that makes them.
    pub values: BTreeMap<&'static str, f64>,
    /// What it is to reach, if its design says.
    pub goals: Vec<Goal>,
    /// Figures in rows and columns.
    pub tables: Vec<Table>,
}

impl Report {
    /// True when no finding is an error.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.findings.iter().all(|f| f.severity < Severity::Error)
    }
}
