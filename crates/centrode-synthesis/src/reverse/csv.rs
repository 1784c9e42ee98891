//! Points and poses read from CSV files.

use centrode_geometry::Point;
use centrode_spec::{CsvLine, csv_lines};

use super::path::text;
use super::{PathError, RequiredDirection};

/// Columns that a file may have.
struct Layout {
    /// Headings of each column; a file without headings has the first `needed` columns.
    headings: &'static [&'static [&'static str]],
    /// Number of columns that every file must have.
    needed: usize,
    /// The needed columns in words.
    words: &'static str,
}

const PATH: Layout = Layout {
    headings: &[
        &["x", "x_mm"],
        &["y", "y_mm"],
        &["tolerance", "tolerance_mm"],
        &["direction_deg"],
        &["direction_tolerance_deg"],
    ],
    needed: 2,
    words: "x and y in mm",
};

const POSES: Layout = Layout {
    headings: &[&["x", "x_mm"], &["y", "y_mm"], &["direction_deg"]],
    needed: 3,
    words: "x and y in mm and the direction in degrees",
};

/// Indices of the optional columns of a path.
const TOLERANCE: usize = 2;
const DIRECTION: usize = 3;
const DIRECTION_TOLERANCE: usize = 4;

/// Points that a path is required to pass.
#[derive(Clone, Debug, PartialEq)]
pub struct RequiredPoints {
    /// The points in order, mm.
    pub points: Vec<Point>,
    /// Distance within which the path may pass each point, mm; `None` if the file has no such column.
    pub tolerances: Option<Vec<f64>>,
    /// Directions of the clamp required at some of them.
    pub directions: Vec<RequiredDirection>,
}

impl RequiredPoints {
    /// Reads points as [`RequiredPath::from_csv`](super::RequiredPath::from_csv) does, and the columns headed `tolerance`,
    /// `direction_deg` and `direction_tolerance_deg`, if the file has them. An empty direction is free.
    ///
    /// # Errors
    /// [`PathError`] with the line; a tolerance must be zero or more.
    pub fn from_csv(bytes: &[u8]) -> Result<Self, PathError> {
        let table = Table::read(bytes, &PATH)?;
        let points = table.rows()?.into_iter().map(|row: [f64; 2]| row.into());
        let [tolerances, directions, off] =
            [TOLERANCE, DIRECTION, DIRECTION_TOLERANCE].map(|k| table.columns[k]);
        let tolerances = tolerances
            .map(|column| table.tolerances(column))
            .transpose()?;
        let directions = directions.map(|column| table.directions(column, off));
        Ok(Self {
            points: points.collect(),
            tolerances,
            directions: directions.transpose()?.unwrap_or_default(),
        })
    }
}

/// x, y and direction of every line of a CSV file of key poses.
pub(super) fn poses(bytes: &[u8]) -> Result<Vec<[f64; 3]>, PathError> {
    Table::read(bytes, &POSES)?.rows()
}

/// Lines of a CSV file, in words.
struct Table<'a> {
    layout: &'static Layout,
    /// Position in a line of each column of the layout.
    columns: Vec<Option<usize>>,
    lines: Vec<CsvLine<'a>>,
}

impl<'a> Table<'a> {
    fn read(bytes: &'a [u8], layout: &'static Layout) -> Result<Self, PathError> {
        let mut lines = csv_lines(text(bytes)?);
        let columns = match lines.first() {
            Some(first) if first.is_heading() => layout.columns(&lines.remove(0))?,
            _ => (0..layout.headings.len())
                .map(|k| (k < layout.needed).then_some(k))
                .collect(),
        };
        let table = Self {
            layout,
            columns,
            lines,
        };
        table.lines.iter().try_for_each(|line| table.check(line))?;
        Ok(table)
    }

    /// Refuses a line that has too few values, or a value in a column without a name.
    fn check(&self, line: &CsvLine<'_>) -> Result<(), PathError> {
        let needed = &self.columns[..self.layout.needed];
        let is_short = needed.iter().flatten().any(|k| *k >= line.words.len());
        if is_short {
            line.number_at(0)?;
        }
        let is_named = |k: usize| self.columns.contains(&Some(k));
        let mut words = line.words.iter().enumerate();
        if is_short || words.any(|(k, word)| !word.is_empty() && !is_named(k)) {
            return Err(PathError::Columns {
                line: line.number,
                count: line.words.len(),
                required: self.layout.words,
            });
        }
        Ok(())
    }

    /// The needed numbers of every line.
    fn rows<const N: usize>(&self) -> Result<Vec<[f64; N]>, PathError> {
        let row = |line: &CsvLine<'_>| {
            let mut row = [0.0; N];
            for (value, column) in row.iter_mut().zip(self.columns.iter().flatten()) {
                *value = line.number_at(*column)?;
            }
            Ok(row)
        };
        self.lines.iter().map(row).collect()
    }

    /// Tolerances of every line.
    fn tolerances(&self, column: usize) -> Result<Vec<f64>, PathError> {
        let lines = self.lines.iter();
        lines.map(|line| tolerance(line, column)).collect()
    }

    /// Directions at those lines that have one.
    fn directions(
        &self,
        column: usize,
        off: Option<usize>,
    ) -> Result<Vec<RequiredDirection>, PathError> {
        let lines = self.lines.iter().enumerate();
        let given = lines.filter(|(_, line)| line.words.get(column).is_some_and(|w| !w.is_empty()));
        let direction = |(i, line): (usize, &CsvLine<'_>)| {
            let tolerance = match off {
                Some(off) => tolerance(line, off)?.to_radians(),
                None => RequiredDirection::usual_tolerance(),
            };
            Ok(RequiredDirection {
                point: i + 1,
                direction: line.number_at(column)?.to_radians(),
                tolerance,
            })
        };
        given.map(direction).collect()
    }
}

impl Layout {
    /// Position in a line of each column, read from the line of headings.
    fn columns(&self, line: &CsvLine<'_>) -> Result<Vec<Option<usize>>, PathError> {
        let refused = |fault: String| {
            let known: Vec<&str> = self.headings.iter().map(|names| names[0]).collect();
            Err(PathError::Headings {
                line: line.number,
                fault,
                known: known.join(", "),
            })
        };
        let mut columns = vec![None; self.headings.len()];
        for (position, word) in line.words.iter().enumerate() {
            let name = line.heading(position);
            if name.is_empty() {
                continue;
            }
            let is_one = |names: &&[&str]| names.contains(&name.as_str());
            match self.headings.iter().position(is_one) {
                None => {
                    let word: String = word.chars().take(40).collect();
                    return refused(format!("unknown column {word:?}"));
                }
                Some(k) if columns[k].is_some() => {
                    return refused(format!("column {} is given twice", self.headings[k][0]));
                }
                Some(k) => columns[k] = Some(position),
            }
        }
        match columns.iter().take(self.needed).position(Option::is_none) {
            Some(k) => refused(format!("column {} is missing", self.headings[k][0])),
            None => Ok(columns),
        }
    }
}

/// A number that is zero or more.
fn tolerance(line: &CsvLine<'_>, column: usize) -> Result<f64, PathError> {
    let value = line.number_at(column)?;
    match value >= 0.0 && value.is_finite() {
        true => Ok(value),
        false => Err(PathError::Tolerance {
            line: line.number,
            value,
        }),
    }
}
