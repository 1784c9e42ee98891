use std::borrow::Cow;

use centrode_analysis::Report;
use serde::Serialize;

/// Value that a goal or a finding requires of the figure that a chart shows, in the unit of the chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Chart that shows the figure.
    pub chart: Cow<'static, str>,
    /// Minimum or maximum required figure.
    pub value: f64,
    /// Whether `value` is the minimum; otherwise it is the maximum.
    pub minimum: bool,
}

impl Limit {
    /// Ends of the range that a goal of the report requires for a figure; empty if the report has no such goal.
    #[must_use]
    pub fn of_goal(
        report: &Report,
        goal: &str,
        chart: impl Into<Cow<'static, str>> + Clone,
    ) -> Vec<Self> {
        let goals = report.goals.iter().filter(|found| found.name == goal);
        let ends = goals.flat_map(|goal| {
            let [minimum, maximum] = goal
                .required
                .map(|end| end.map(|end| end * goal.unit.factor()));
            [(minimum, true), (maximum, false)]
        });
        ends.filter_map(|(end, minimum)| {
            Some(Self {
                chart: chart.clone().into(),
                value: end?,
                minimum,
            })
        })
        .collect()
    }

    /// Values that the findings of a rule require of a figure; empty if there is no such finding.
    #[must_use]
    pub fn of_rule(report: &Report, rule: &str, chart: &'static str) -> Vec<Self> {
        let findings = report.findings.iter().filter(|found| found.rule == rule);
        findings
            .filter_map(|found| {
                let required = found.required?;
                Some(Self {
                    chart: chart.into(),
                    value: required * found.unit.factor(),
                    minimum: found.measured? < required,
                })
            })
            .collect()
    }
}
