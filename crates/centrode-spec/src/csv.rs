//! Lines of a CSV file.

/// Longest part of a word that an error shows, characters.
const SHOWN: usize = 40;

/// A line of a CSV file that is neither blank nor a comment.
#[derive(Clone, Debug)]
pub struct CsvLine<'a> {
    /// Number of the line in the file, from one.
    pub number: usize,
    /// The words between the separators.
    pub words: Vec<&'a str>,
    decimal: char,
}

/// A word of a CSV file that is not a number.
#[derive(Clone, Debug, PartialEq)]
pub struct NotNumber {
    /// Line, from one.
    pub line: usize,
    /// Beginning of the word.
    pub found: String,
}

/// The lines of a text that are neither blank nor comments, which start with `#`.
#[must_use]
pub fn csv_lines(text: &str) -> Vec<CsvLine<'_>> {
    // Old programs end a line by a carriage return alone.
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let lines = text.split(end).enumerate();
    let lines = lines.map(|(i, line)| (i + 1, line.trim()));
    let written = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    written.map(|(i, line)| CsvLine::new(i, line)).collect()
}

impl<'a> CsvLine<'a> {
    fn new(number: usize, line: &'a str) -> Self {
        // Spreadsheets that write a decimal comma separate columns by semicolons or tabs.
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

    /// Whether this is a line of headings: one of its first words is not a number.
    #[must_use]
    pub fn is_heading(&self) -> bool {
        (0..2.min(self.words.len())).any(|k| self.number_at(k).is_err())
    }

    /// Heading in a column, without quotes and in small letters.
    #[must_use]
    pub fn heading(&self, column: usize) -> String {
        let word = self.words.get(column).copied().unwrap_or_default();
        word.trim_matches('"').trim().to_lowercase()
    }

    /// Number in a column.
    ///
    /// # Errors
    /// [`NotNumber`] for a word that is not a number.
    pub fn number_at(&self, column: usize) -> Result<f64, NotNumber> {
        let word = self.words.get(column).copied().unwrap_or_default();
        let read = word.replace(self.decimal, ".").parse::<f64>();
        read.map_err(|_| NotNumber {
            line: self.number,
            found: word.chars().take(SHOWN).collect(),
        })
    }
}
