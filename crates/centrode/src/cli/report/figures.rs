use std::collections::BTreeMap;
use std::io::{Result, Write};

use crate::analysis::Report;
use crate::page::words::sections;
use anstyle::Style;

pub(super) const HEADING: Style = Style::new().bold();
/// Width of the names and of each column of figures.
const NAME: usize = 32;
const COLUMN: usize = 12;

/// Writes every table, then every figure in its group; figures without a group come last, with every digit. Figures in `given` are
/// marked as given by the design, or as found though the design may give them.
pub(crate) fn write(
    report: &Report,
    given: &BTreeMap<&str, bool>,
    out: &mut impl Write,
) -> Result<()> {
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
            let cells = line.cells.iter().flatten();
            let mut marks: Vec<bool> = cells
                .filter_map(|cell| given.get(&*cell.key).copied())
                .collect();
            marks.dedup();
            let mark = match marks[..] {
                [true] => "  (given)",
                [false] => "  (found)",
                _ => "",
            };
            writeln!(out, "{gap}{}{mark}", line.unit)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{FigureGroup, FigureRow, Unit};

    #[test]
    fn a_figure_of_no_group_is_written_too() {
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
        let mut out = Vec::new();
        write(&report, &BTreeMap::from([("module", true)]), &mut out).expect("written");
        let text = String::from_utf8(out).expect("text");
        assert!(
            text.contains("More") && text.contains("unheard_of"),
            "{text}"
        );
        assert!(text.contains("2.2500  mm  (given)"), "{text}");
    }
}
