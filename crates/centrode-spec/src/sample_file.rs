//! Tables of a design whose samples are in a CSV file: the samples replace the name of the file.

use std::borrow::Cow;
use std::fmt::Write;
use std::ops::Range;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::csv::{CsvLine, NotNumber, csv_lines};
use super::keys::line_and_column;
use super::path::Path;
use super::{DesignError, DesignFault, DesignFile};

/// Key with the name of the file.
const FILE: &str = "file";
/// Key with the column of the samples.
const COLUMN: &str = "column";
/// Key of the angles of the samples, degrees.
const ANGLE: &str = "angle_deg";

/// Gap between the last angle and the first one a turn later, as a multiple of the largest other step, up to which the angles cover
/// a turn. At 20 a column of numbers from 1 to 36 passes for degrees, at 1 rounded angles do not.
const GAP: f64 = 3.0;

/// A column of a CSV file: its heading, or its number from one.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(
    untagged,
    expecting = "must be a heading in quotes or the number of a column"
)]
pub enum Column {
    /// Number, from one.
    Number(u32),
    /// Heading.
    Heading(String),
}

/// A kind of table whose samples may be in a file.
#[derive(Clone, Copy, Debug)]
pub struct SampleTable {
    /// Word at the key `kind`.
    pub kind: &'static str,
    /// Key of the samples.
    pub values: &'static str,
}

/// Bytes of a file that a design names, or the reason why there are none.
pub type OpenFile<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A table that names a file.
struct Named<'t> {
    path: String,
    name: &'t str,
    column: Option<Column>,
    values: &'static str,
    /// Positions of the key `file` and the end of its value.
    span: Range<usize>,
    /// Key that contradicts the file.
    other: Option<&'static str>,
}

/// Text of a design with the samples of its files instead of their names, `file = { ratio = [...] }`, on the same lines.
///
/// A text that is not TOML is returned as it is.
///
/// # Errors
/// [`DesignError`] at the key `file` or `column`, with the line of the file.
pub(super) fn with_files<'t>(
    text: &'t str,
    tables: &[SampleTable],
    open: OpenFile<'_>,
) -> Result<Cow<'t, str>, DesignError> {
    let Ok(root) = DeTable::parse(text) else {
        return Ok(text.into());
    };
    let mut named = Vec::new();
    search(root.get_ref(), tables, &mut Path::default(), &mut named);
    named.sort_by_key(|one| one.span.start);
    let (mut whole, mut from) = (String::new(), 0);
    for one in &named {
        whole += &text[from..one.span.start];
        from = one.span.end;
        let samples = one.samples(open).map_err(|(key, message)| {
            let (line, column) = line_and_column(text, one.span.start);
            DesignError {
                fault: DesignFault::File(message),
                key: format!("{}.{key}", one.path),
                line,
                column,
            }
        })?;
        let _ = write!(whole, "{FILE} = {samples}");
    }
    if named.is_empty() {
        return Ok(text.into());
    }
    whole += &text[from..];
    Ok(whole.into())
}

/// Finds all tables that name a file.
fn search<'t>(
    table: &'t DeTable<'t>,
    kinds: &[SampleTable],
    path: &mut Path,
    found: &mut Vec<Named<'t>>,
) {
    let word = |key: &str| table.get(key).and_then(|value| value.get_ref().as_str());
    let kind = kinds.iter().find(|one| Some(one.kind) == word("kind"));
    if let (Some(kind), Some(name), Some((key, value))) =
        (kind, word(FILE), table.get_key_value(FILE))
    {
        let column = table.get(COLUMN).map(Spanned::get_ref);
        found.push(Named {
            path: path.written().to_owned(),
            name,
            column: column.and_then(|column| match column {
                DeValue::String(heading) => Some(Column::Heading(heading.to_string())),
                DeValue::Integer(number) => Some(Column::Number(number.as_str().parse().ok()?)),
                _ => None,
            }),
            values: kind.values,
            span: key.span().start..value.span().end,
            other: [kind.values, ANGLE]
                .into_iter()
                .find(|key| table.contains_key(*key)),
        });
    }
    for (key, value) in table {
        path.name(key.get_ref(), |path| {
            inside(value.get_ref(), kinds, path, found)
        });
    }
}

fn inside<'t>(
    value: &'t DeValue<'t>,
    kinds: &[SampleTable],
    path: &mut Path,
    found: &mut Vec<Named<'t>>,
) {
    match value {
        DeValue::Table(table) => search(table, kinds, path, found),
        DeValue::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                path.index(i, |path| inside(value.get_ref(), kinds, path, found));
            }
        }
        _ => {}
    }
}

/// Moves the keys that were read from files, `file = { ratio = [...] }`, into the tables around them.
pub(super) fn spread<'t>(table: &mut DeTable<'t>) {
    for (_, value) in table.iter_mut() {
        spread_inside(value.get_mut());
    }
    // A body may be named like the key, but a table of bodies has no kind.
    let is_kind = table
        .get("kind")
        .is_some_and(|kind| kind.get_ref().is_str());
    let is_read = table
        .get(FILE)
        .is_some_and(|file| file.get_ref().is_table());
    if is_kind
        && is_read
        && let Some((name, file)) = table.remove_entry(FILE)
        && let DeValue::Table(samples) = file.into_inner()
    {
        table.remove(COLUMN);
        for (key, value) in samples {
            // Errors of the samples are at the key that names the file.
            let key = Spanned::new(name.span(), key.into_inner());
            table.entry(key).or_insert(value);
        }
    }
}

fn spread_inside(value: &mut DeValue<'_>) {
    match value {
        DeValue::Table(table) => spread(table),
        DeValue::Array(list) => list.iter_mut().for_each(|one| spread_inside(one.get_mut())),
        _ => {}
    }
}

impl Named<'_> {
    /// Samples of the file as an inline table; or the key at fault, and the reason.
    fn samples(&self, open: OpenFile<'_>) -> Result<String, (&'static str, String)> {
        let Self { name, values, .. } = self;
        if let Some(other) = self.other {
            return Err((
                FILE,
                format!("cannot be given together with {other}: give one of them"),
            ));
        }
        let bytes = open(name).map_err(|why| (FILE, format!("cannot read {name}: {why}")))?;
        if bytes.len() > DesignFile::LARGEST {
            let limit = DesignFile::LARGEST;
            return Err((
                FILE,
                format!("{name} has more than {limit} bytes, the limit for a file"),
            ));
        }
        let text = std::str::from_utf8(&bytes);
        let text = text.map_err(|_| (FILE, format!("{name} is not UTF-8 text")))?;
        let mut lines = csv_lines(text.trim_start_matches('\u{feff}'));
        let heading = match lines.first() {
            Some(first) if first.is_heading() => Some(lines.remove(0)),
            _ => None,
        };
        let Some(first) = heading.as_ref().or(lines.first()) else {
            return Err((FILE, format!("{name} has no samples")));
        };
        let column = self.column(first, heading.is_some())?;
        let list = |column: usize| -> Result<Vec<f64>, (&'static str, String)> {
            let cell = |line: &CsvLine<'_>| match line.number_at(column) {
                Ok(number) if number.is_finite() => Ok(number),
                Ok(number) => Err((number.to_string(), line.number)),
                Err(NotNumber { line, found }) => Err((format!("{found:?}"), line)),
            };
            let cells = lines.iter().map(cell).collect::<Result<_, _>>();
            cells.map_err(|(found, line)| {
                let column = column + 1;
                (
                    FILE,
                    format!("{name}, line {line}: {found} in column {column} is not a number"),
                )
            })
        };
        let samples = format!("{values} = {:?}", list(column)?);
        // The first of several columns has the angles.
        if column == 0 {
            return Ok(format!("{{ {samples} }}"));
        }
        let angles = list(0)?;
        self.covers_a_turn(&angles)?;
        Ok(format!("{{ {ANGLE} = {angles:?}, {samples} }}"))
    }

    /// Position of the column with the samples: by default the second one, or the only one.
    fn column(
        &self,
        first: &CsvLine<'_>,
        is_heading: bool,
    ) -> Result<usize, (&'static str, String)> {
        let (name, count) = (self.name, first.words.len());
        match &self.column {
            None => Ok(1.min(count - 1)),
            Some(Column::Number(number)) => match (1..=count).contains(&(*number as usize)) {
                true => Ok(*number as usize - 1),
                false => Err((
                    COLUMN,
                    format!("{name} has {count} columns, but no column {number}"),
                )),
            },
            Some(Column::Heading(heading)) => {
                let lower = heading.trim().to_lowercase();
                let found = (0..count).find(|&k| is_heading && first.heading(k) == lower);
                found.ok_or_else(|| {
                    let known = match is_heading {
                        true => format!("its headings are {}", first.words.join(", ")),
                        false => "it has no headings: give the number of the column".into(),
                    };
                    (COLUMN, format!("{name} has no column {heading:?}; {known}"))
                })
            }
        }
    }

    /// Refuses angles that leave most of a turn without samples.
    fn covers_a_turn(&self, angles: &[f64]) -> Result<(), (&'static str, String)> {
        let [from, .., to] = angles else {
            return Ok(());
        };
        let steps = angles.windows(2).map(|pair| pair[1] - pair[0]);
        let step = steps.fold(0.0, f64::max);
        if 360.0 - (to - from) <= GAP * step {
            return Ok(());
        }
        let name = self.name;
        Err((
            FILE,
            format!(
                "{name}: column 1 must have the driver angles of a whole turn in degrees, but they go from {from} to {to} in steps of up to {step}"
            ),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [SampleTable; 1] = [SampleTable {
        kind: "ratio",
        values: "ratio",
    }];

    fn whole(text: &str) -> Result<String, DesignError> {
        let open = |name: &str| match name {
            "a.csv" => Ok(b"1\n2\n".to_vec()),
            "b.csv" => Ok(b"# two columns\nphi, q\n0, 3\n180, 4\n".to_vec()),
            _ => Err("there is no such file".into()),
        };
        with_files(text, &TABLES, &open).map(Cow::into_owned)
    }

    #[test]
    fn samples_replace_the_names_of_files_on_the_same_lines() {
        let text = "[p]\nkind = \"ratio\"\nfile = \"b.csv\" # measured\nn = 1\n[[q]]\nof = { file = \"a.csv\", kind = \"ratio\" }\n";
        let found = whole(text).expect("files");
        let expected = "[p]\nkind = \"ratio\"\nfile = { angle_deg = [0.0, 180.0], ratio = [3.0, 4.0] } # measured\nn = 1\n[[q]]\nof = { file = { ratio = [1.0, 2.0] }, kind = \"ratio\" }\n";
        assert_eq!(found, expected);
        let mut root = DeTable::parse(&found).expect("TOML").into_inner();
        spread(&mut root);
        let table = root["p"].get_ref().as_table().expect("a table");
        let keys: Vec<&str> = table.keys().map(|key| key.get_ref().as_ref()).collect();
        assert!(
            keys.contains(&"ratio") && keys.contains(&"angle_deg"),
            "{keys:?}"
        );
        assert!(!keys.contains(&"file"), "{keys:?}");
    }

    #[test]
    fn only_tables_of_a_kind_with_samples_name_files() {
        for text in [
            "[p]\nkind = \"circle\"\nfile = \"lost.csv\"\n",
            "[bodies.file]\nkind = 1\n[bodies.file.ring]\nkind = \"ring\"\n",
            "[p]\nkind = \"ratio\"\nfile = 3\n",
            "not TOML",
        ] {
            assert_eq!(whole(text).expect("unchanged"), text);
        }
        let text = "[bodies.file]\nx = 1\n";
        let mut root = DeTable::parse(text).expect("TOML").into_inner();
        spread(&mut root);
        assert!(
            root["bodies"]
                .get_ref()
                .as_table()
                .is_some_and(|bodies| bodies.contains_key("file"))
        );
        let error = whole("a = 1\n[p]\nkind = \"ratio\"\nfile = \"lost.csv\"\n").expect_err("lost");
        assert_eq!(
            (error.key.as_str(), error.line, error.column),
            ("p.file", 4, 1)
        );
        assert!(
            error.message().contains("lost.csv: there is no such file"),
            "{error}"
        );
    }
}
