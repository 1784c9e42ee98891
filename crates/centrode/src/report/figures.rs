use std::collections::BTreeSet;
use std::io::{Result, Write};

use anstyle::Style;
use centrode::analysis::{Figure, Report, Table};
use serde::Serialize;

use super::groups::{GROUPS, Group, Row};
use super::unit::{Unit, figure};

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
    fn of(report: &Report, key: &str, unit: Unit) -> Option<Self> {
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
    serde_json::to_string(&Figure(value)).unwrap_or_default()
}

/// Every table and figure of the report, figures of no group last.
pub(crate) fn sections(report: &Report) -> Vec<Section> {
    let mut shown: BTreeSet<&str> = BTreeSet::new();
    let mut sections: Vec<Section> = report.tables.iter().map(section).collect();
    for Group(heading, columns, rows) in &GROUPS {
        let mut lines = Vec::new();
        for Row(name, keys, unit) in *rows {
            shown.extend(*keys);
            let cells: Vec<Option<Cell>> = keys
                .iter()
                .map(|key| Cell::of(report, key, *unit))
                .collect();
            if cells.iter().any(Option::is_some) {
                let (name, unit) = ((*name).to_owned(), unit.name());
                lines.push(Line { name, unit, cells });
            }
        }
        if !lines.is_empty() {
            sections.push(Section {
                heading: (*heading).into(),
                columns: columns.iter().map(|&c| c.into()).collect(),
                rows: lines,
            });
        }
    }
    let rest = report.values.keys().filter(|key| !shown.contains(*key));
    let rows: Vec<Line> = rest
        .map(|key| Line {
            name: (*key).into(),
            unit: "",
            cells: vec![Cell::of(report, key, Unit::Number)],
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
    let (factor, unit) = match table.unit {
        "rad" => (180.0 / std::f64::consts::PI, "deg"),
        unit => (1.0, unit),
    };
    let cell = |row: &str, column: usize, value: f64| Cell {
        key: format!("{}/{row}/{column}", table.name),
        shown: figure(value * factor, 4),
        exact: exact(value),
    };
    let line = |(name, figures): &(String, Vec<f64>)| Line {
        name: name.clone(),
        unit,
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
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
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

    #[test]
    fn a_figure_of_no_group_is_shown_too() {
        let mut report = Report::default();
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
            ("clearance_min", "\"Infinity\""),
            ("module", "2.25"),
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

    #[test]
    fn the_phase_of_the_first_tooth_is_told_in_pitches() {
        let mut report = Report::default();
        report.values.insert("phase", 0.25);
        let mut out = Vec::new();
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out).expect("text");
        assert!(text.contains("0.2500  pitches"), "{text}");
    }

    #[test]
    fn every_figure_of_the_shipped_designs_has_a_name_and_one_place() {
        let keys: Vec<&str> = GROUPS
            .iter()
            .flat_map(|Group(_, _, rows)| *rows)
            .flat_map(|Row(_, keys, _)| *keys)
            .filter(|key| !key.is_empty())
            .copied()
            .collect();
        let known: BTreeSet<&str> = keys.iter().copied().collect();
        assert_eq!(keys.len(), known.len(), "a figure stands in two places");
        let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden");
        let mut read = 0;
        for entry in std::fs::read_dir(golden).expect("checked in") {
            let path = entry.expect("readable").path();
            if path.extension().is_none_or(|extension| extension != "json") {
                continue;
            }
            let text = std::fs::read_to_string(&path).expect("readable");
            let golden: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            let values = golden["values"].as_object();
            let values = values.unwrap_or_else(|| panic!("no values in {}", path.display()));
            read += values.len();
            let nameless: Vec<&String> = values
                .keys()
                .filter(|key| !known.contains(key.as_str()))
                .collect();
            assert!(nameless.is_empty(), "{}: {nameless:?}", path.display());
        }
        assert!(read > 100);
    }
}
