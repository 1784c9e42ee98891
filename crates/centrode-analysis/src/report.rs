use std::borrow::Cow;
use std::collections::BTreeMap;

use centrode_spec::{Design, FigureGoalSpec, Given, Named};
use schemars::{JsonSchema, generate::SchemaSettings};
use serde::Serialize;

use crate::{FigureGroup, Goal, JsonNumber, Severity, Unit, figure, severity};

/// Position in the mechanism and its cycle at which a finding was made.
#[derive(Clone, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct Place {
    /// Link or part, as named in the design.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Tooth numbers, counted from zero counter-clockwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub teeth: Vec<u32>,
    /// Sides of these teeth, where the finding is about flanks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flanks: Vec<FlankPlace>,
    /// Input angle, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub input: Option<f64>,
}

/// Side of a tooth, and from where on a finding holds there.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct FlankPlace {
    /// Tooth number, counted from zero counter-clockwise.
    pub tooth: u32,
    /// Side: `leading` is reached first in the order the teeth mesh, `trailing` last.
    pub side: &'static str,
    /// Distance from the gear's axis at which the flank ends, mm: below it undercut has taken the flank, or above it no more can
    /// be cut; absent where no flank is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
}

/// A respect in which a mechanism is worse than it should be: measured, required, where.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Finding {
    /// Short stable name of the rule, such as `undercut`.
    pub rule: &'static str,
    /// Severity.
    pub severity: Severity,
    /// One sentence for a person.
    pub message: String,
    /// The measured figure, in `unit`.
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "figure::option"
    )]
    #[schemars(with = "Option<JsonNumber>")]
    pub measured: Option<f64>,
    /// Required figure, in `unit`.
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "figure::option"
    )]
    #[schemars(with = "Option<JsonNumber>")]
    pub required: Option<f64>,
    /// Unit of both figures.
    pub unit: Unit,
    /// Usual remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<Cow<'static, str>>,
    /// Position at which it was found.
    pub place: Place,
}

impl Finding {
    /// A finding of a rule, with its message for a person. The methods below add figures, remedy and position.
    #[must_use]
    pub fn new(rule: &'static str, severity: Severity, message: impl Into<String>) -> Self {
        Self {
            rule,
            severity,
            message: message.into(),
            measured: None,
            required: None,
            unit: Unit::Count,
            remedy: None,
            place: Place::default(),
        }
    }

    /// With its figures.
    #[must_use]
    pub fn measured(
        self,
        measured: impl Into<Option<f64>>,
        required: impl Into<Option<f64>>,
        unit: Unit,
    ) -> Self {
        Self {
            measured: measured.into(),
            required: required.into(),
            unit,
            ..self
        }
    }

    /// With its usual remedy.
    #[must_use]
    pub fn remedy(self, remedy: impl Into<Option<&'static str>>) -> Self {
        Self {
            remedy: remedy.into().map(Cow::Borrowed),
            ..self
        }
    }

    /// On a link or part.
    #[must_use]
    pub fn on(mut self, part: impl Into<String>) -> Self {
        self.place.part = Some(part.into());
        self
    }

    /// On teeth of the part, with the flanks concerned.
    #[must_use]
    pub fn teeth(mut self, teeth: Vec<u32>, flanks: Vec<FlankPlace>) -> Self {
        self.place.teeth = teeth;
        self.place.flanks = flanks;
        self
    }

    /// Adds the finding to a report.
    pub(crate) fn add_to(self, report: &mut Report) {
        report.findings.push(self);
    }

    /// At an input, rad.
    #[must_use]
    pub fn at(mut self, input: impl Into<Option<f64>>) -> Self {
        self.place.input = input.into();
        self
    }
}

/// Figures in rows and columns.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Table {
    /// Short stable name.
    pub name: &'static str,
    /// Title of the table.
    pub title: &'static str,
    /// Unit of every figure.
    pub unit: Unit,
    /// Headings of the columns.
    pub columns: Vec<String>,
    /// Rows, each with its heading and its figures.
    #[serde(serialize_with = "figure::rows")]
    #[schemars(with = "Vec<(String, Vec<JsonNumber>)>")]
    pub rows: Vec<(String, Vec<f64>)>,
}

impl Table {
    /// A table without columns or rows.
    #[must_use]
    pub fn new(name: &'static str, title: &'static str, unit: Unit) -> Self {
        Self {
            name,
            title,
            unit,
            columns: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Tables of figures with their values, one per unit, in the order of the figures.
    #[must_use]
    pub fn of_figures<const N: usize>(
        columns: [&str; N],
        figures: impl IntoIterator<Item = (Unit, String, Vec<f64>)>,
    ) -> Vec<Self> {
        let mut tables: Vec<Self> = Vec::new();
        for (unit, name, values) in figures {
            match tables.iter_mut().find(|table| table.unit == unit) {
                Some(table) => table.rows.push((name, values)),
                None => tables.push(
                    Self::new("figures", "Figure", unit)
                        .columns(columns)
                        .rows(vec![(name, values)]),
                ),
            }
        }
        tables
    }

    /// With headings of columns.
    #[must_use]
    pub fn columns<C: Into<String>>(self, headings: impl IntoIterator<Item = C>) -> Self {
        let columns = headings.into_iter().map(C::into).collect();
        Self { columns, ..self }
    }

    /// With rows, each with its heading.
    #[must_use]
    pub fn rows(self, rows: Vec<(String, Vec<f64>)>) -> Self {
        Self { rows, ..self }
    }
}

/// All findings and figures of one mechanism.
///
/// In JSON an infinite figure is a string, see [`JsonNumber`](crate::JsonNumber).
#[derive(Clone, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct Report {
    /// Findings, worst first.
    pub findings: Vec<Finding>,
    /// Figures by key.
    #[serde(serialize_with = "figure::values")]
    #[schemars(with = "BTreeMap<String, JsonNumber>")]
    pub values: BTreeMap<&'static str, f64>,
    /// Titles and units of the figures, in the order in which they are shown.
    #[serde(skip)]
    pub groups: Vec<FigureGroup>,
    /// Goals, if its design has any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub goals: Vec<Goal>,
    /// Figures in rows and columns.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<Table>,
}

impl Report {
    /// Adds a table, unless it has no rows.
    pub(crate) fn table(&mut self, table: Table) {
        if !table.rows.is_empty() {
            self.tables.push(table);
        }
    }

    /// Whether no finding is an error.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.findings.iter().all(|f| f.severity < Severity::Error)
    }

    /// Unit of a figure of `values`; `None` for a key that is in no group.
    #[must_use]
    pub fn unit(&self, key: &str) -> Option<Unit> {
        let mut rows = self.groups.iter().flat_map(|group| group.rows);
        let found = rows.find(|row| !key.is_empty() && row.keys.contains(&key));
        found.map(|row| row.unit)
    }

    /// Units of the figures by key.
    #[must_use]
    pub fn units(&self) -> BTreeMap<&'static str, Unit> {
        let keys = self.values.keys();
        keys.filter_map(|key| Some((*key, self.unit(key)?)))
            .collect()
    }

    /// Whether each figure is given by the design, or found by the program though the design may give it; figures that are results
    /// are not in the list.
    #[must_use]
    pub fn given(&self, design: &dyn Design) -> BTreeMap<&'static str, bool> {
        let given = Given::new(design);
        let of = |(&key, &value): (&&'static str, &f64)| {
            let factor = self.unit(key).map_or(1.0, Unit::factor);
            Some((key, given.has(key, value * factor)?))
        };
        self.values.iter().filter_map(of).collect()
    }

    /// Puts the worst findings first, and causes before their consequences.
    pub(crate) fn worst_first(&mut self) {
        severity::worst_first(&mut self.findings);
    }

    /// The report with the goals of a design for its figures, and an error for each missed goal.
    ///
    /// Figures that this depth of the check does not have give goals without a figure. A complete check reports them as errors:
    /// there a figure is missing only if it cannot be determined.
    #[must_use]
    pub fn with_goals(mut self, goals: &Named<FigureGoalSpec>, is_complete: bool) -> Self {
        if goals.is_empty() {
            return self;
        }
        let before = self.goals.len();
        for (number, (name, spec)) in (before as u32 + 1..).zip(goals) {
            let figure = &*spec.figure;
            let unit = self.unit(figure).unwrap_or(Unit::Number);
            let title = match &*spec.title {
                "" => format!("{name}: {figure}"),
                title => title.to_owned(),
            };
            let value = self.values.get(figure).copied();
            if is_complete && value.is_none() {
                let message =
                    format!("goal {number}, {title}: the figure {figure} cannot be determined");
                Finding::new("goal", Severity::Error, message).add_to(&mut self);
            }
            let goal = Goal::new(number, name.clone(), title, unit);
            self.goals
                .push(goal.required(spec.range(), spec.scale).with(value));
        }
        let added = self.goals.split_off(before);
        let fixed = std::mem::replace(&mut self.goals, added);
        self.blame_goals(|_| Missed::default());
        self.goals.splice(..0, fixed);
        self.worst_first();
        self
    }

    /// Adds an error for each goal that is missed. `about` gives the position, the remedy and further words for a goal.
    pub(crate) fn blame_goals(&mut self, about: impl Fn(&Goal) -> Missed) {
        let missed = self.goals.iter().filter(|goal| goal.met() == Some(false));
        let findings = missed.filter_map(|goal| {
            let (value, margin) = (goal.value?, goal.margin?);
            let Missed {
                input,
                remedy,
                words,
            } = about(goal);
            let Goal {
                number,
                title,
                unit,
                ..
            } = goal;
            let [value_stated, margin_stated] =
                [value, -margin].map(|figure| unit.with_unit(figure));
            Some(Finding {
                // Goals that a design names share the rule `goal`.
                rule: match &goal.name {
                    Cow::Borrowed(name) => name,
                    Cow::Owned(_) => "goal",
                },
                severity: Severity::Error,
                message: format!(
                    "goal {number}, {title}: {value_stated}, missed by {margin_stated}{words}"
                ),
                measured: Some(value),
                required: match goal.required {
                    [Some(minimum), _] if value < minimum => Some(minimum),
                    [_, maximum] => maximum,
                },
                unit: *unit,
                remedy: remedy.map(Cow::Borrowed),
                place: Place {
                    input,
                    ..Place::default()
                },
            })
        });
        let findings: Vec<Finding> = findings.collect();
        self.findings.extend(findings);
    }
}

/// Findings, figures and goals of a design as `report.json` has them, and the answer of `centrode check --json`.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[schemars(rename = "Report")]
pub struct ReportFile<'a> {
    /// Whether no finding is an error.
    pub ok: bool,
    /// Findings, figures and goals.
    #[serde(flatten)]
    pub report: &'a Report,
    /// Units of the figures in `values`.
    pub units: BTreeMap<&'static str, Unit>,
    /// Whether a figure is given by the design (true) or found by the program though the design may give it (false); other figures
    /// are results.
    pub given: BTreeMap<&'static str, bool>,
}

impl<'a> ReportFile<'a> {
    /// The file of a report on a design.
    #[must_use]
    pub fn new(report: &'a Report, design: &dyn Design) -> Self {
        Self {
            ok: report.ok(),
            report,
            units: report.units(),
            given: report.given(design),
        }
    }

    /// JSON schema of the file.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let settings = SchemaSettings::default().for_serialize();
        let schema = settings.into_generator().into_root_schema_for::<Self>();
        schema.to_value()
    }
}

/// Additions to the finding of a missed goal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Missed {
    /// Input angle at which the figure is found, rad.
    pub(crate) input: Option<f64>,
    /// Usual remedy.
    pub(crate) remedy: Option<&'static str>,
    /// Further words at the end of the message.
    pub(crate) words: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_infinite_figure_is_a_word_in_json_that_readers_take_for_it() {
        let mut report = Report::default();
        report.values.insert("limit", f64::INFINITY);
        report.values.insert("minimum", f64::NEG_INFINITY);
        report.values.insert("module", 2.25);
        let goal = Goal::new(1, "a", "a", Unit::Count).with(f64::INFINITY);
        report.goals.push(goal);
        report.tables.push(Table {
            name: "t",
            title: "t",
            unit: Unit::Count,
            columns: vec!["a".into(), "b".into()],
            rows: vec![("row".into(), vec![1.0, f64::INFINITY])],
        });
        let json = serde_json::to_value(&report).expect("JSON");
        assert_eq!(json["values"]["limit"], "Infinity");
        assert_eq!(json["values"]["minimum"], "-Infinity");
        assert_eq!(json["values"]["module"], 2.25);
        assert_eq!(json["goals"][0]["value"], "Infinity");
        assert_eq!(json["tables"][0]["rows"][0][1][1], "Infinity");
        let word = json["values"]["limit"].as_str().expect("a string");
        assert_eq!(word.parse(), Ok(f64::INFINITY));
    }
}
