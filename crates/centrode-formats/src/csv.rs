//! Comma-separated tables.

use thiserror::Error;

/// Characters with which a spreadsheet begins a formula, and those that it skips before one.
const FORMULA: [char; 9] = ['=', '+', '-', '@', '\t', '＝', '＋', '－', '＠'];

/// One column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Heading, with the unit: `x_mm`, `driver_angle_rad`.
    pub heading: String,
    /// The values, top to bottom.
    pub values: Values,
}

/// Values of one column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers, written with the fewest digits that read back to the same number.
    Numbers(Vec<f64>),
    /// Words without commas, double quotes or line ends. A word that a spreadsheet would run is written with an apostrophe before it.
    Words(Vec<String>),
}

/// Reason why columns make no table.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TableError {
    /// Columns of different lengths.
    #[error("column {heading} has {length} rows, the first has {first}")]
    Ragged {
        /// The column.
        heading: String,
        /// Its length.
        length: usize,
        /// The first column's length.
        first: usize,
    },
    /// A value that is not a finite number.
    #[error("column {heading} has {value} in row {row}")]
    NotFinite {
        /// The column.
        heading: String,
        /// The row, the first is 1.
        row: usize,
        /// The value.
        value: f64,
    },
    /// A heading or word that would break its row.
    #[error("{word:?} contains a comma, quote or line end")]
    Separator {
        /// The word.
        word: String,
    },
}

impl Column {
    /// A column of numbers.
    #[must_use]
    pub fn numbers(heading: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self {
            heading: heading.to_owned(),
            values: Values::Numbers(values.into_iter().collect()),
        }
    }

    /// A column of words.
    #[must_use]
    pub fn words(heading: &str, values: impl IntoIterator<Item = String>) -> Self {
        Self {
            heading: heading.to_owned(),
            values: Values::Words(values.into_iter().collect()),
        }
    }

    pub(crate) fn len(&self) -> usize {
        match &self.values {
            Values::Numbers(numbers) => numbers.len(),
            Values::Words(words) => words.len(),
        }
    }
}

/// A comma-separated table: one heading row, a decimal point, lines ended by `\n`.
///
/// No word runs as a formula in a spreadsheet: one that begins with `=`, `+`, `-`, `@` or a tab and is no number gets an
/// apostrophe before it. So does the part after a semicolon or a tab, which some spreadsheets take for the next cell.
///
/// # Errors
/// [`TableError`] where columns differ in length, a number is not finite or a word contains a separator.
pub fn write(columns: &[Column]) -> Result<Vec<u8>, TableError> {
    let rows = columns.first().map_or(0, Column::len);
    for column in columns {
        check(column, rows)?;
    }
    let headings: Vec<&str> = columns.iter().map(|c| c.heading.as_str()).collect();
    let mut text = headings.join(",");
    text.push('\n');
    for row in 0..rows {
        centrode_geometry::checkpoint();
        for (i, column) in columns.iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            match &column.values {
                // Adding zero turns -0 into 0.
                Values::Numbers(numbers) => text.push_str(&format!("{:?}", numbers[row] + 0.0)),
                Values::Words(words) => text.push_str(&inert(&words[row])),
            }
        }
        text.push('\n');
    }
    Ok(text.into_bytes())
}

/// A word in a form that a spreadsheet does not run as a formula.
fn inert(word: &str) -> String {
    if word.parse::<f64>().is_ok_and(f64::is_finite) {
        return word.to_owned();
    }
    let mut cell = String::with_capacity(word.len());
    let mut is_start = true;
    for c in word.chars() {
        if is_start && FORMULA.contains(&c) {
            cell.push('\'');
        }
        cell.push(c);
        is_start = matches!(c, ';' | '\t');
    }
    cell
}

fn check(column: &Column, rows: usize) -> Result<(), TableError> {
    let safe = |word: &String| {
        if word.contains([',', '"', '\n', '\r']) {
            Err(TableError::Separator { word: word.clone() })
        } else {
            Ok(())
        }
    };
    safe(&column.heading)?;
    if column.len() != rows {
        return Err(TableError::Ragged {
            heading: column.heading.clone(),
            length: column.len(),
            first: rows,
        });
    }
    match &column.values {
        Values::Words(words) => words.iter().try_for_each(safe),
        Values::Numbers(numbers) => match numbers.iter().position(|x| !x.is_finite()) {
            Some(row) => Err(TableError::NotFinite {
                heading: column.heading.clone(),
                row: row + 1,
                value: numbers[row],
            }),
            None => Ok(()),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_reads_back_to_the_bit() {
        let numbers = [
            0.1,
            -1.0 / 3.0,
            1e-300,
            6.02e23,
            0.0,
            f64::MIN_POSITIVE,
            123_456_789.123_456_79,
        ];
        let table = write(&[
            Column::numbers("x_mm", numbers),
            Column::words("role", vec!["tip".to_owned(); 7]),
        ])
        .expect("well formed");
        let text = String::from_utf8(table).expect("text");
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("x_mm,role"));
        for x in numbers {
            let line = lines.next().expect("a row");
            let cell = line.strip_suffix(",tip").expect("the word");
            assert_eq!(
                cell.parse::<f64>().expect("a number").to_bits(),
                x.to_bits()
            );
        }
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn tables_that_would_not_read_back_are_refused() {
        let x = Column::numbers("x", [1.0, f64::NAN]);
        assert!(matches!(
            write(&[x]),
            Err(TableError::NotFinite { row: 2, .. })
        ));
        let short = [Column::numbers("x", [1.0]), Column::numbers("y", [])];
        assert!(matches!(
            write(&short),
            Err(TableError::Ragged {
                length: 0,
                first: 1,
                ..
            })
        ));
        let comma = Column::words("role", ["a,b".to_owned()]);
        assert!(matches!(write(&[comma]), Err(TableError::Separator { .. })));
    }

    #[test]
    fn no_word_runs_in_a_spreadsheet() {
        for (word, cell) in [
            ("=cmd|' /C calc'!A0", "'=cmd|' /C calc'!A0"),
            ("+1+1", "'+1+1"),
            ("-2+3", "'-2+3"),
            ("@SUM(A1:A9)", "'@SUM(A1:A9)"),
            ("\t=1+1", "'\t'=1+1"),
            ("＝1+1", "'＝1+1"),
            ("＠x", "'＠x"),
            ("steel;=1+1", "steel;'=1+1"),
            ("steel\t-1+1;+2+2", "steel\t'-1+1;'+2+2"),
            ("=", "'="),
            ("--", "'--"),
            ("-inf", "'-inf"),
            ("-1e5x", "'-1e5x"),
            // Numbers and words that begin otherwise stay as they are.
            ("-12.5", "-12.5"),
            ("+3", "+3"),
            ("-1e-5", "-1e-5"),
            ("16MnCr5", "16MnCr5"),
            ("1.7225 = 42CrMo4", "1.7225 = 42CrMo4"),
            ("'=1", "'=1"),
            ("bore 8; +0.02", "bore 8; +0.02"),
            ("", ""),
        ] {
            let table = write(&[Column::words("material", [word.to_owned()])]).expect("a table");
            let text = String::from_utf8(table).expect("text");
            assert_eq!(text, format!("material\n{cell}\n"));
        }
    }
}
