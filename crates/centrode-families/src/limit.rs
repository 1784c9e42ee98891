use std::borrow::Cow;

use centrode_analysis::Report;
use serde::Serialize;

/// Value that a goal or a finding requires of the figure of a chart, in the unit shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Chart whose figure it is.
    pub chart: Cow<'static, str>,
    /// Minimum or maximum required figure.
    pub value: f64,
    /// Whether the figure is to be no less.
    pub minimum: bool,
}

impl Limit {
    /// Ends of the range in which a goal of the report requires a figure; `None` without that goal.
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

    /// Figure that the findings of a rule require; none without such a finding.
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
