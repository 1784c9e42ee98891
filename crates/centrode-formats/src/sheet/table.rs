use super::{Draft, Pen, lettering};
use crate::csv::Column;
use crate::drawing::Anchor;
use centrode_geometry::{Bounds, Point};
use std::ops::Range;

/// Height of the letters, mm.
const LETTERS: f64 = 2.5;
/// Height of the letters of a table's title, mm.
const TITLE: f64 = 3.5;
/// Height of a row, mm.
pub(super) const ROW: f64 = 4.6;
/// Height of the title's row, mm.
const TITLE_ROW: f64 = 7.0;
/// Room on each side of a cell's words, mm.
const PAD: f64 = 1.6;

/// A table of words: a title, headings, and rows as long as the headings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The title above.
    pub title: String,
    /// Headings; empty for a table without headings.
    pub headings: Vec<String>,
    /// Anchor of the words in each column.
    pub columns: Vec<Anchor>,
    /// The cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// Lines of words below.
    pub notes: Vec<String>,
}

impl Table {
    /// Table that names a CSV file of points with the number of its rows and its columns.
    pub fn of_file(title: &str, file: &str, columns: &[Column]) -> Self {
        let rows = columns.first().map_or(0, Column::len);
        let headings: Vec<&str> = columns.iter().map(|c| c.heading.as_str()).collect();
        let lines = [
            ("File", file.to_owned()),
            ("Rows", rows.to_string()),
            ("Columns", headings.join(", ")),
        ];
        let mut rows: Vec<Vec<String>> = Vec::new();
        for (name, value) in lines {
            rows.extend(broken(name, "", &value));
        }
        Self {
            title: title.to_owned(),
            columns: vec![Anchor::Left; 3],
            rows,
            ..Self::default()
        }
        .filled()
    }

    /// Table without the columns that are empty in every row.
    pub fn filled(mut self) -> Self {
        let said = |k: usize| {
            self.rows
                .iter()
                .any(|row| row.get(k).is_some_and(|cell| !cell.is_empty()))
        };
        let said: Vec<bool> = (0..self.columns.len()).map(said).collect();
        let keep = |cells: &mut Vec<String>| {
            let mut column = said.iter();
            cells.retain(|_| column.next() != Some(&false));
        };
        self.rows.iter_mut().for_each(keep);
        keep(&mut self.headings);
        let mut column = said.iter();
        self.columns.retain(|_| column.next() != Some(&false));
        self
    }

    /// Width of each column, mm: that of its longest cell.
    fn widths(&self) -> Vec<f64> {
        let longest = |k: usize| {
            let cells = self.rows.iter().chain([&self.headings]);
            let widths = cells.filter_map(|row| row.get(k)).map(|w| width(w));
            widths.fold(0.0, f64::max) + 2.0 * PAD
        };
        let mut widths: Vec<f64> = (0..self.columns.len()).map(longest).collect();
        let minimum = lettering::width(&self.title, TITLE) + 2.0 * PAD;
        let total: f64 = widths.iter().sum();
        if let Some(last) = widths.last_mut() {
            *last += (minimum - total).max(0.0);
        }
        widths
    }

    /// Width of the table, mm.
    pub(super) fn width(&self) -> f64 {
        let notes = self.notes.iter().map(|line| width(line));
        let table: f64 = self.widths().iter().sum();
        notes.fold(table, f64::max)
    }

    /// Height of a part of the table with this many rows, mm; the last part includes the notes.
    pub(super) fn height(&self, rows: usize, last: bool) -> f64 {
        let notes = if last { self.notes.len() } else { 0 };
        self.head() + ROW * (rows + notes) as f64 + if notes > 0 { 1.5 } else { 0.0 }
    }

    /// Number of rows that fit a height, mm.
    pub(super) fn rows_in(&self, height: f64) -> usize {
        ((height - self.head()) / ROW + 1e-9).floor().max(0.0) as usize
    }

    fn head(&self) -> f64 {
        let headings = if self.headings.is_empty() { 0.0 } else { ROW };
        TITLE_ROW + headings
    }

    /// Draft of the whole table, the upper left corner in the origin.
    pub fn whole(&self) -> Draft {
        self.draft(0..self.rows.len(), false, true)
    }

    /// Draft of some of its rows, the upper left corner in the origin.
    pub(super) fn draft(&self, rows: Range<usize>, continued: bool, last: bool) -> Draft {
        let mut draft = Draft::default();
        let widths = self.widths();
        let total: f64 = widths.iter().sum();
        let title = if continued {
            format!("{} (continued)", self.title)
        } else {
            self.title.clone()
        };
        let at = Point::new(PAD, -TITLE_ROW + 0.5 * (TITLE_ROW - TITLE));
        draft.text_within(
            at,
            &[TITLE, LETTERS],
            &title,
            Anchor::Left,
            total - 2.0 * PAD,
        );
        let mut top = -TITLE_ROW;
        let headings = [&self.headings].into_iter().filter(|h| !h.is_empty());
        let body = self.rows[rows].iter();
        for (index, row) in headings.chain(body).enumerate() {
            let mut x = 0.0;
            for ((words, width), anchor) in row.iter().zip(&widths).zip(&self.columns) {
                let anchor = if index == 0 && !self.headings.is_empty() {
                    Anchor::Middle
                } else {
                    *anchor
                };
                let at = match anchor {
                    Anchor::Left => x + PAD,
                    Anchor::Middle => x + 0.5 * width,
                    Anchor::Right => x + width - PAD,
                };
                let baseline = top - ROW + 0.5 * (ROW - LETTERS);
                draft.text(Point::new(at, baseline), LETTERS, words, anchor);
                x += width;
            }
            draft.line(Pen::Rule, Point::new(0.0, top), Point::new(total, top));
            top -= ROW;
        }
        let mut x = 0.0;
        for width in &widths[..widths.len().saturating_sub(1)] {
            x += width;
            draft.line(Pen::Rule, Point::new(x, -TITLE_ROW), Point::new(x, top));
        }
        let frame = Bounds {
            min: Point::new(0.0, top),
            max: Point::new(total, 0.0),
        };
        draft.rectangle(Pen::Outline, frame);
        if last {
            for (i, line) in self.notes.iter().enumerate() {
                let at = Point::new(0.0, top - 1.5 - ROW * (i as f64 + 1.0) + 1.0);
                draft.text(at, LETTERS, line, Anchor::Left);
            }
        }
        draft
    }
}

fn width(words: &str) -> f64 {
    lettering::width(words, LETTERS)
}

/// Maximum number of letters of a value on one line.
const LINE: usize = 38;

/// Rows of a name, a symbol and a value. A long value is split at blanks, and within words longer than a line.
pub fn broken(name: &str, symbol: &str, value: &str) -> Vec<Vec<String>> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in value.split(' ') {
        let letters: Vec<char> = word.chars().collect();
        for part in letters.chunks(LINE) {
            let part: String = part.iter().collect();
            let last = lines.last_mut();
            match last {
                Some(line) if line.is_empty() => line.push_str(&part),
                Some(line) if line.chars().count() + 1 + part.chars().count() <= LINE => {
                    line.push(' ');
                    line.push_str(&part);
                }
                _ => lines.push(part),
            }
        }
    }
    let row = |(row, line)| {
        let (name, symbol) = if row == 0 { (name, symbol) } else { ("", "") };
        vec![name.to_owned(), symbol.to_owned(), line]
    };
    lines.into_iter().enumerate().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_that_say_nothing_are_left_out_and_long_values_are_broken() {
        let row = |cells: [&str; 3]| cells.map(String::from).to_vec();
        let table = Table {
            title: "Data".into(),
            headings: row(["name", "symbol", "value"]),
            columns: vec![Anchor::Left, Anchor::Middle, Anchor::Right],
            rows: vec![row(["a", "", "1"]), row(["b", "", ""])],
            notes: Vec::new(),
        }
        .filled();
        assert_eq!(table.headings, ["name", "value"]);
        assert_eq!(table.columns, [Anchor::Left, Anchor::Right]);
        assert_eq!(table.rows, [["a", "1"], ["b", ""]]);
        let long = format!("{} {}", "x".repeat(30), "y".repeat(40));
        let rows = broken("name", "n", &long);
        let values: Vec<usize> = rows.iter().map(|row| row[2].len()).collect();
        assert_eq!(values, [30, 38, 2]);
        assert_eq!(rows[1][..2], ["", ""]);
        assert_eq!(broken("name", "", ""), [["name", "", ""]]);
    }
}
