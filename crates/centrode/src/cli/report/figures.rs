use std::collections::BTreeSet;
use std::io::{Result, Write};

use crate::analysis::{JsonNumber, Report, Table, Unit};
use anstyle::Style;
use serde::Serialize;

pub(super) const HEADING: Style = Style::new().bold();
/// Width of the names and of each column of figures.
const NAME: usize = 32;
const COLUMN: usize = 12;

/// Figures that go together, as rows and columns.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Section {
    heading: String,
    columns: Vec<String>,
    rows: Vec<Line>,
}

/// A row of a [`Section`].
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Line {
    name: String,
    unit: &'static str,
    cells: Vec<Option<Cell>>,
}

/// A figure of the report.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Cell {
    /// Its key in the report.
    key: String,
    /// Figure as the command line shows it.
    shown: String,
    /// Figure as in the JSON report, to the last digit.
    exact: String,
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

/// Every table and figure of the report, figures of no group last.
pub(crate) fn sections(report: &Report) -> Vec<Section> {
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

/// Writes every table, then every figure in its group; figures of no group come last, as they are.
pub(crate) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    for section in sections(report) {
        let width = if section.columns.is_empty() { 0 } else { NAME };
        write!(out, "\n{HEADING}{:width$}{HEADING:#}", section.heading)?;
        for column in &section.columns {
            write!(out, "  {column:>COLUMN$}")?;
        }
        writeln!(out)?;
        for line in &section.rows {
            write!(out, "  {:width$}", line.name, width = NAME - 2)?;
            for cell in &line.cells {
                let shown = cell.as_ref().map_or("", |cell| &cell.shown);
                write!(out, "  {shown:>COLUMN$}")?;
            }
            let gap = if line.unit.is_empty() { "" } else { "  " };
            writeln!(out, "{gap}{}", line.unit)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{FigureGroup, FigureRow};

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
        let mut out = Vec::new();
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out).expect("text");
        assert!(
            text.contains("More") && text.contains("unheard_of"),
            "{text}"
        );
        assert!(text.contains("2.2500  mm"), "{text}");
    }
}
