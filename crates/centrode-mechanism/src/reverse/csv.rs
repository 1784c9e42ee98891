//! Points and poses read from CSV files.

use centrode_geometry::Point;

use super::path::text;
use super::{PathError, WantedDirection};

/// Headings of the columns of tolerances, of directions and of how far these may be off.
const TOLERANCE: &[&str] = &["tolerance", "tolerance_mm"];
const DIRECTION: &[&str] = &["direction_deg"];
const DIRECTION_TOLERANCE: &[&str] = &["direction_tolerance_deg"];

/// Points that a path is wanted to pass.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedPoints {
    /// The points in order, mm.
    pub points: Vec<Point>,
    /// Distance within which the path may pass each point, mm; none where the file has no such column.
    pub tolerances: Option<Vec<f64>>,
    /// Directions of the clamp wanted at some of them.
    pub directions: Vec<WantedDirection>,
}

impl WantedPoints {
    /// Reads points as [`WantedPath::from_csv`](super::WantedPath::from_csv) does, and the columns headed `tolerance`,
    /// `direction_deg` and `direction_tolerance_deg`, if there are such. Where a direction is left empty it is free.
    ///
    /// # Errors
    /// [`PathError`] with the line; a tolerance is zero or more.
    pub fn from_csv(bytes: &[u8]) -> Result<Self, PathError> {
        let table = Table::read(bytes)?;
        let points = table.rows()?.into_iter().map(|row: [f64; 2]| row.into());
        let column = |names: &[&str]| {
            let is_one = |word: &&str| names.contains(&word.to_lowercase().as_str());
            table.headings.iter().position(is_one)
        };
        let tolerances = column(TOLERANCE);
        let tolerances = tolerances.map(|column| table.column(column)).transpose()?;
        let directions = column(DIRECTION);
        let off = column(DIRECTION_TOLERANCE);
        let directions = directions.map(|column| table.directions(column, off));
        Ok(Self {
            points: points.collect(),
            tolerances,
            directions: directions.transpose()?.unwrap_or_default(),
        })
    }
}

/// Numbers at the head of every line of a CSV file, as [`WantedPath::from_csv`](super::WantedPath::from_csv) reads it.
pub(super) fn rows<const N: usize>(bytes: &[u8]) -> Result<Vec<[f64; N]>, PathError> {
    Table::read(bytes)?.rows()
}

/// Lines of a CSV file, in words.
struct Table<'a> {
    headings: Vec<&'a str>,
    lines: Vec<Line<'a>>,
}

/// A line that is no remark.
struct Line<'a> {
    number: usize,
    words: Vec<&'a str>,
    decimal: char,
}

impl<'a> Table<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, PathError> {
        let text = text(bytes)?;
        // Old programs end a line by a carriage return alone.
        let end = if text.contains('\n') { '\n' } else { '\r' };
        let lines = text.split(end).enumerate();
        let lines = lines.map(|(i, line)| (i + 1, line.trim()));
        let written = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let mut lines: Vec<Line<'_>> = written.map(|(i, line)| Line::new(i, line)).collect();
        let is_heading =
            |line: &Line<'_>| (0..2.min(line.words.len())).any(|k| line.number_at(k).is_err());
        let headings = match lines.first() {
            Some(first) if is_heading(first) => lines.remove(0).words,
            _ => Vec::new(),
        };
        Ok(Self { headings, lines })
    }

    /// The first numbers of every line.
    fn rows<const N: usize>(&self) -> Result<Vec<[f64; N]>, PathError> {
        self.lines.iter().map(Line::row).collect()
    }

    /// Tolerances of every line.
    fn column(&self, column: usize) -> Result<Vec<f64>, PathError> {
        let lines = self.lines.iter();
        lines.map(|line| line.tolerance(column)).collect()
    }

    /// Directions at those lines that have one.
    fn directions(
        &self,
        column: usize,
        off: Option<usize>,
    ) -> Result<Vec<WantedDirection>, PathError> {
        let lines = self.lines.iter().enumerate();
        let given = lines.filter(|(_, line)| line.words.get(column).is_some_and(|w| !w.is_empty()));
        let direction = |(i, line): (usize, &Line<'_>)| {
            let tolerance = match off {
                Some(off) => line.tolerance(off)?.to_radians(),
                None => WantedDirection::usual_tolerance(),
            };
            Ok(WantedDirection {
                point: i + 1,
                direction: line.number_at(column)?.to_radians(),
                tolerance,
            })
        };
        given.map(direction).collect()
    }
}

impl<'a> Line<'a> {
    fn new(number: usize, line: &'a str) -> Self {
        // Spreadsheets that write a decimal comma separate by semicolons or tabs.
        let (separators, decimal): (&[char], _) = match line.contains([';', '\t']) {
            true => (&[';', '\t'], ','),
            false => (&[','], '.'),
        };
        Self {
            number,
            words: line.split(separators).map(str::trim).collect(),
            decimal,
        }
    }

    fn number_at(&self, column: usize) -> Result<f64, PathError> {
        let word = self.words.get(column).copied().unwrap_or_default();
        let read = word.replace(self.decimal, ".").parse::<f64>();
        read.map_err(|_| PathError::NotNumber {
            line: self.number,
            found: word.chars().take(40).collect(),
        })
    }

    /// A number that is zero or more.
    fn tolerance(&self, column: usize) -> Result<f64, PathError> {
        let value = self.number_at(column)?;
        match value >= 0.0 && value.is_finite() {
            true => Ok(value),
            false => Err(PathError::Tolerance {
                line: self.number,
                value,
            }),
        }
    }

    fn row<const N: usize>(&self) -> Result<[f64; N], PathError> {
        let mut row = [0.0; N];
        if self.words.len() < N {
            self.number_at(0)?;
            return Err(PathError::Columns {
                line: self.number,
                count: self.words.len(),
                wanted: if N == 2 {
                    "x and y in mm"
                } else {
                    "x and y in mm and the direction in degrees"
                },
            });
        }
        for (column, value) in row.iter_mut().enumerate() {
            *value = self.number_at(column)?;
        }
        Ok(row)
    }
}
