use std::collections::BTreeSet;

use centrode_analysis::{JsonNumber, Report, Table, Unit};
use serde::Serialize;

/// Figures that go together, as rows and columns.
#[derive(Clone, Debug, Serialize)]
pub struct Section {
    /// Title.
    pub heading: String,
    /// Headings of the columns; empty if there is one column.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<Line>,
}

/// A row of a [`Section`].
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// Name.
    pub name: String,
    /// Unit of its figures.
    pub unit: &'static str,
    /// Figures, column by column; `None` if the report has none.
    pub cells: Vec<Option<Cell>>,
}

/// A figure of the report.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    /// Its key in the report.
    pub key: String,
    /// Figure as the command line shows it.
    pub shown: String,
    /// Figure as in the JSON report, to the last digit.
    pub exact: String,
}

impl Cell {
    fn new(report: &Report, key: &str, unit: Unit) -> Option<Self> {
        let value = *report.values.get(key)?;
        Some(Self {
            key: key.into(),
            shown: unit.show(value),
            exact: exact(value),
        })
    }
}

/// Figure as the writer of the JSON report writes it.
pub(super) fn exact(value: f64) -> String {
    serde_json::to_string(&JsonNumber(value)).unwrap_or_default()
}

/// Every table and figure of the report; figures without a group come last.
pub fn sections(report: &Report) -> Vec<Section> {
    let mut shown: BTreeSet<&str> = BTreeSet::new();
    let mut sections: Vec<Section> = report.tables.iter().map(section).collect();
    for group in &report.groups {
        let mut lines = Vec::new();
        for row in group.rows {
            shown.extend(row.keys);
            let cells: Vec<Option<Cell>> = row
                .keys
                .iter()
                .map(|key| Cell::new(report, key, row.unit))
                .collect();
            if cells.iter().any(Option::is_some) {
                let (name, unit) = (row.title.to_owned(), row.unit.shown());
                lines.push(Line { name, unit, cells });
            }
        }
        if !lines.is_empty() {
            sections.push(Section {
                heading: group.heading.into(),
                columns: group.columns.iter().map(|&c| c.into()).collect(),
                rows: lines,
            });
        }
    }
    let rest = report.values.keys().filter(|key| !shown.contains(*key));
    let rows: Vec<Line> = rest
        .map(|key| Line {
            name: (*key).into(),
            unit: "",
            cells: vec![Cell::new(report, key, Unit::Number)],
        })
        .collect();
    if !rows.is_empty() {
        sections.push(Section {
            heading: "More".into(),
            columns: Vec::new(),
            rows,
        });
    }
    sections
}

/// A table as a section, in the units in which it is shown.
fn section(table: &Table) -> Section {
    let cell = |row: &str, column: usize, value: f64| Cell {
        key: format!("{}/{row}/{column}", table.name),
        shown: table.unit.show(value),
        exact: exact(value),
    };
    let line = |(name, figures): &(String, Vec<f64>)| Line {
        name: name.clone(),
        unit: table.unit.shown(),
        cells: (0..)
            .zip(figures)
            .map(|(column, &value)| Some(cell(name, column, value)))
            .collect(),
    };
    Section {
        heading: table.title.into(),
        columns: table.columns.clone(),
        rows: table.rows.iter().map(line).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_analysis::{FigureGroup, FigureRow};

    #[test]
    fn a_figure_of_no_group_is_shown_too() {
        let mut report = Report::default();
        report.groups.push(FigureGroup {
            heading: "Limits",
            columns: &[],
            rows: &[FigureRow {
                title: "module",
                keys: &["module"],
                unit: Unit::Millimetre,
            }],
        });
        report.values.insert("module", 2.25);
        report.values.insert("unheard_of", 0.5);
        report.values.insert("clearance_min", f64::INFINITY);
        let exact: Vec<(String, String)> = sections(&report)
            .into_iter()
            .flat_map(|section| section.rows)
            .flat_map(|row| row.cells)
            .flatten()
            .map(|cell| (cell.key, cell.exact))
            .collect();
        let expected = [
            ("module", "2.25"),
            ("clearance_min", "\"Infinity\""),
            ("unheard_of", "0.5"),
        ];
        assert_eq!(
            exact,
            expected.map(|(key, text)| (key.to_owned(), text.to_owned()))
        );
    }
}
