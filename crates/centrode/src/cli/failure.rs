use crate::InternalFault;
use crate::export::ExportError;
use crate::formats::BundleError;
use anstyle::{AnsiColor, Style};
use centrode_spec::{DesignError, visible};
use std::io::{self, Write};

/// Longest part of a line shown below an error, in characters.
const WIDEST: usize = 100;

const ERROR: Style = AnsiColor::Red.on_default().bold();
const MARGIN: Style = AnsiColor::Blue.on_default().bold();

/// Reason why a command could not do its job.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The design is bad: its errors, and the text that contains them.
    Design {
        name: String,
        text: String,
        errors: Vec<DesignError>,
    },
    /// A file cannot be read.
    Input { name: String, error: io::Error },
    /// The output cannot be written.
    Output(io::Error),
    /// The page cannot be served.
    Serve(io::Error),
    /// The files of the design cannot be made or written.
    Files(Box<dyn std::error::Error + Send + Sync>),
    /// Ctrl-C was pressed.
    Interrupted,
    /// The program is at fault.
    Internal(InternalFault),
    /// A word on the command line has no meaning.
    Usage(String),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Self::Files(Box::new(error))
    }
}

impl From<BundleError> for Failure {
    fn from(error: BundleError) -> Self {
        Self::Files(Box::new(error))
    }
}

impl Failure {
    /// Writes the failure as text to read, with the line of the file if it has one.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        if let Self::Design { name, text, errors } = self {
            return errors
                .iter()
                .try_for_each(|error| at_line(out, name, text, error));
        }
        let words = shown(&without_code(&self.to_string()));
        writeln!(out, "{ERROR}error{ERROR:#}: {words}")
    }
}

impl std::fmt::Display for Failure {
    /// Failure in one line; for a design, one line per mistake.
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Design { errors, .. } => {
                let mut lines = errors.iter().map(ToString::to_string);
                write!(out, "{}", lines.next().unwrap_or_default())?;
                lines.try_for_each(|line| write!(out, "\n{line}"))
            }
            Self::Input { name, error } => write!(out, "cannot read {name}: {error}"),
            Self::Output(error) => write!(out, "cannot write the output: {error}"),
            Self::Serve(error) => write!(out, "cannot serve the page: {error}"),
            Self::Files(error) => write!(out, "{error}"),
            Self::Interrupted => write!(out, "interrupted"),
            Self::Internal(fault) => write!(out, "{fault}"),
            Self::Usage(message) => write!(out, "{message}"),
        }
    }
}

fn at_line(out: &mut impl Write, name: &str, text: &str, error: &DesignError) -> io::Result<()> {
    let DesignError {
        key, line, column, ..
    } = error;
    writeln!(out, "{ERROR}error{ERROR:#}: {}", shown(&error.message()))?;
    let gutter = line.to_string().len();
    writeln!(
        out,
        "{MARGIN}{:gutter$}-->{MARGIN:#} {}:{line}:{column}",
        "",
        shown(name)
    )?;
    let Some(written) = text.lines().nth(line - 1) else {
        return Ok(());
    };
    // A long line is shown from a little before the position.
    let first = if *column > WIDEST - 20 {
        column - 20
    } else {
        0
    };
    let excerpt: Vec<char> = written.chars().skip(first).take(WIDEST).collect();
    let (before, from) = excerpt.split_at((column - 1 - first).min(excerpt.len()));
    let name: Vec<char> = key.rsplit('.').next().unwrap_or_default().chars().collect();
    let marked = match !name.is_empty() && from.starts_with(&name[..name.len().min(from.len())]) {
        true => name.len().min(from.len()),
        false => from.len().min(1),
    };
    // An escaped character takes more than one column.
    let line_part = |part: &[char]| shown(&part.iter().collect::<String>().replace('\t', " "));
    let room = |part: &[char]| line_part(part).chars().count();
    let before_width = room(before);
    let marked = room(&from[..marked]).max(1);
    writeln!(out, "{MARGIN}{:gutter$} |{MARGIN:#}", "")?;
    writeln!(out, "{MARGIN}{line} |{MARGIN:#} {}", line_part(&excerpt))?;
    writeln!(
        out,
        "{MARGIN}{:gutter$} |{MARGIN:#} {:before_width$}{ERROR}{}{ERROR:#}",
        "",
        "",
        "^".repeat(marked)
    )
}

/// The text without the error numbers of the system, which repeat the words.
fn without_code(text: &str) -> String {
    const CODE: &str = " (os error ";
    let mut parts = text.split(CODE);
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once(')') {
            Some((number, rest)) if number.chars().all(|c| c.is_ascii_digit()) => kept += rest,
            _ => {
                kept += CODE;
                kept += part;
            }
        }
    }
    kept
}

/// The first 600 characters of a text, as a message shows them.
fn shown(text: &str) -> String {
    visible(&text.chars().take(600).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FAMILIES;

    #[test]
    fn errors_of_the_system_are_told_in_words_alone() {
        let failure = Failure::Input {
            name: "a.toml".into(),
            error: io::Error::from_raw_os_error(2),
        };
        let mut stated = Vec::new();
        failure.write(&mut stated).expect("written");
        let stated = String::from_utf8(stated).expect("text");
        assert!(
            stated.contains("cannot read a.toml: ") && !stated.contains("os error"),
            "{stated}"
        );
        let kept = "left (os error two) alone (os error 3), and on";
        assert_eq!(without_code(kept), "left (os error two) alone, and on");
    }

    fn shown_error(text: &str) -> String {
        let error = FAMILIES.read(text.as_bytes()).expect_err("a bad design");
        let failure = Failure::Design {
            name: "pair.toml".into(),
            text: text.into(),
            errors: vec![error],
        };
        let mut out = anstream::StripStream::new(Vec::new());
        failure.write(&mut out).expect("written");
        String::from_utf8(out.into_inner()).expect("text")
    }

    #[test]
    fn the_line_and_the_key_are_shown() {
        let text = "family = \"gear-pair\"\n[pitch]\nkind = \"circle\"\nradius = 9\n[teeth]\nbacklsh = 1\n";
        assert_eq!(
            shown_error(text),
            "error: teeth.backlsh: unknown key, did you mean \"backlash\"?; known are addendum, fit, tip_shortening, \
             phase, backlash, backlash_angle_deg, thickness_split, minimum_tip_width_coefficient, thickness_deviations, pin_diameter\n \
             --> pair.toml:6:1\n  |\n6 | backlsh = 1\n  | ^^^^^^^\n"
        );
    }

    #[test]
    fn a_long_line_and_control_characters_stay_on_screen() {
        let text = format!("family = \"gear-pair\"\n{}\u{1b}[2J = 1", "x".repeat(5000));
        let message = shown_error(&text);
        assert!(!message.contains('\u{1b}'), "{message:?}");
        assert!(message.lines().all(|line| line.chars().count() < 700));
    }

    #[test]
    fn characters_that_cannot_be_seen_are_shown_by_number() {
        for c in [
            '\u{202a}', '\u{202b}', '\u{202c}', '\u{202d}', '\u{202e}', '\u{2066}', '\u{2067}',
            '\u{2068}', '\u{2069}', '\u{200e}', '\u{200f}', '\u{61c}', '\u{7f}', '\u{85}',
            '\u{fffe}', '\u{ffff}',
        ] {
            // In TOML DEL is written as an escape alone.
            let written = if c == '\u{7f}' {
                r"\u007f".into()
            } else {
                c.to_string()
            };
            let number = format!("\\u{{{:x}}}", u32::from(c));
            let message = shown_error(&format!(
                "family = \"gear-pair\"\n\"a{written}b\" = 1 # {written}\n"
            ));
            assert!(!message.contains(c), "{message:?}");
            let lines: Vec<&str> = message.lines().collect();
            assert!(
                lines[0].starts_with(&format!("error: a{number}b: unknown key")),
                "{message}"
            );
            let excerpt = lines[3].strip_prefix("2 | ").expect("the line");
            assert_eq!(excerpt.contains(&number), c != '\u{7f}', "{message}");
            // A word and a syntax error show them no more than a key.
            for text in [
                format!("family = \"gear{written}-pair\"\n"),
                format!("family = \"gear-pair\"\nb{c} = 1\n"),
                format!("family = \"gear-pair\"\n[pitch]\nkind = \"{written}\"\n"),
            ] {
                let message = shown_error(&text);
                assert!(!message.contains(c), "{message:?}");
            }
        }
    }

    #[test]
    fn marks_are_below_what_they_mark_after_escapes_and_tabs() {
        let text = "family = \"gear-pair\"\n\t\"\u{202e}\" = { }\n";
        let message = shown_error(text);
        let lines: Vec<&str> = message.lines().collect();
        assert_eq!(lines[3], r#"2 |  "\u{202e}" = { }"#);
        let (mark, place) = (lines[4].find('^'), lines[3].find(['"', '\\']));
        assert_eq!(mark, place, "{message}");
    }
}
