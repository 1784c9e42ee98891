use std::io::{Result, Write};

use centrode::analysis::Report;

use super::figures::{HEADING, figure};

/// Width of the names and of each column of figures.
const NAME: usize = 32;
const COLUMN: usize = 12;

/// Writes every table: heading and columns, then a line a row.
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    for table in &report.tables {
        write!(out, "\n{HEADING}{:NAME$}{HEADING:#}", table.title)?;
        for column in &table.columns {
            write!(out, "  {column:>COLUMN$}")?;
        }
        writeln!(out)?;
        let (factor, unit) = match table.unit {
            "rad" => (180.0 / std::f64::consts::PI, "deg"),
            unit => (1.0, unit),
        };
        let gap = if unit.is_empty() { "" } else { "  " };
        for (name, figures) in &table.rows {
            write!(out, "  {name:width$}", width = NAME - 2)?;
            for value in figures {
                write!(out, "  {:>COLUMN$}", figure(value * factor, 4))?;
            }
            writeln!(out, "{gap}{unit}")?;
        }
    }
    Ok(())
}
