use std::error;

use thiserror::Error;

use super::visible;
use crate::digits::shortened;
use crate::{Rule, SpecError};

/// Error of a design file: the fault and its position.
#[derive(Debug, Error)]
#[error("line {line}, column {column}: {}", self.message())]
pub struct DesignError {
    /// Fault.
    #[source]
    pub fault: DesignFault,
    /// Key at fault with the tables around it, `teeth.backlash`; empty if the fault has no key.
    pub key: String,
    /// Line of the key, from one.
    pub line: usize,
    /// Column of the key, in characters, from one.
    pub column: usize,
}

/// Rule that a design file breaks.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DesignFault {
    /// A file above the maximum size; it is not read to its end.
    #[error("the file has at least {bytes} bytes; the limit for a design file is {limit}")]
    TooLarge {
        /// Number of bytes read so far.
        bytes: usize,
        /// Maximum size read.
        limit: usize,
    },
    /// Not text.
    #[error("the file is not UTF-8 text")]
    NotText,
    /// Nothing but blanks and comments.
    #[error("the file is empty: write family = {example:?} and the keys of that family")]
    Empty {
        /// Word of a family.
        example: &'static str,
    },
    /// Not TOML.
    #[error("{0}")]
    Syntax(String),
    /// A key that its table does not have.
    #[error("unknown key{}; known are {}{}", near.as_ref().map_or(String::new(), |n| format!(", did you mean {n:?}?")), known.join(", "), in_words(elsewhere))]
    UnknownKey {
        /// Nearest known key.
        near: Option<String>,
        /// All keys known here.
        known: Vec<String>,
        /// Where else the family has a key of this name, at most four, the nearest first.
        elsewhere: Vec<String>,
    },
    /// A required key that is missing.
    #[error("the key {0:?} is missing")]
    MissingKey(String),
    /// A word that is not allowed.
    #[error("unknown word {word:?}{}; known are {}", near.as_ref().map_or(String::new(), |n| format!(", did you mean {n:?}?")), known.join(", "))]
    UnknownWord {
        /// Word as written.
        word: String,
        /// The nearest known word.
        near: Option<String>,
        /// All words known here.
        known: Vec<String>,
    },
    /// A value of another type than the key takes.
    #[error("{0}")]
    WrongType(String),
    /// A value outside its range, or in conflict with another key.
    #[error("{0}")]
    Value(Rule),
    /// A file with samples that cannot be read, with its line.
    #[error("{0}")]
    File(String),
    /// The mechanism is not possible: the error that states why.
    #[error("{0}")]
    Mechanism(#[source] Box<dyn error::Error + Send + Sync>),
    /// A design that TOML cannot hold.
    #[error("{0}")]
    NotWritable(String),
}

/// Error of a design whose mechanism is not possible: key and fault.
#[derive(Debug, Error)]
#[error("{fault}")]
pub struct MechanismError {
    /// Key of the design file.
    pub key: String,
    /// Fault.
    #[source]
    pub fault: DesignFault,
}

impl MechanismError {
    /// Wraps an error of a mechanism that is not possible.
    #[must_use]
    pub fn new(key: String, error: impl error::Error + Send + Sync + 'static) -> Self {
        let fault = DesignFault::Mechanism(Box::new(error));
        Self { key, fault }
    }

    /// Error of a word at a key that is not among the known words.
    #[must_use]
    pub fn unknown_word(key: String, word: &str, known: &[&str]) -> Self {
        let known: Vec<String> = known.iter().map(|&word| word.to_owned()).collect();
        let fault = DesignFault::UnknownWord {
            near: nearest(word, &known),
            word: word.to_owned(),
            known,
        };
        Self { key, fault }
    }

    /// The key and what is wrong with it.
    #[must_use]
    pub fn message(&self) -> String {
        named(&self.key, &self.fault)
    }
}

impl From<SpecError> for MechanismError {
    fn from(SpecError { key, rule }: SpecError) -> Self {
        let fault = DesignFault::Value(rule);
        Self { key, fault }
    }
}

impl DesignError {
    /// A fault without a key, at the start of the file.
    pub(super) fn at_start(fault: DesignFault) -> Self {
        Self {
            fault,
            key: String::new(),
            line: 1,
            column: 1,
        }
    }

    /// The key and what is wrong with it, without the position.
    #[must_use]
    pub fn message(&self) -> String {
        named(&self.key, &self.fault)
    }
}

/// Other keys of the same name, in words.
fn in_words(keys: &[String]) -> String {
    match keys {
        [] => String::new(),
        [key] if !key.contains('.') => format!("; {key} belongs above the first table"),
        [one, two, three, _, ..] => {
            format!("; elsewhere there is {one}, {two}, {three} and others")
        }
        keys => format!("; elsewhere there is {}", keys.join(", ")),
    }
}

/// A key and what is wrong with it, without characters that cannot be seen.
fn named(key: &str, fault: &DesignFault) -> String {
    let key = &visible(key);
    let fault = visible(&shortened(&fault.to_string()));
    let (tables, last) = match key.rfind('.') {
        Some(dot) => key.split_at(dot + 1),
        None => ("", key.as_str()),
    };
    // Some rules already begin with their key.
    let named = fault
        .strip_prefix(last)
        .is_some_and(|rest| rest.starts_with(|c: char| !c.is_alphanumeric() && c != '_'));
    if last.is_empty() {
        fault
    } else if named {
        format!("{tables}{fault}")
    } else {
        format!("{key}: {fault}")
    }
}

/// Keys and words of an earlier file format, and those that replace them.
const RENAMED: [(&str, &str); 8] = [
    ("at_least", "minimum"),
    ("at_most", "maximum"),
    ("least", "minimum"),
    ("greatest", "maximum"),
    ("departure", "deviation"),
    ("course", "uniform"),
    ("least-change", "minimum-change"),
    (
        "least_tip_width_coefficient",
        "minimum_tip_width_coefficient",
    ),
];

/// The known word that replaces `word`, or the nearest one, if any is near at all.
pub(super) fn nearest(word: &str, known: &[String]) -> Option<String> {
    let renamed = RENAMED.iter().find(|(old, _)| *old == word);
    if let Some((_, new)) = renamed
        && known.iter().any(|known| known == new)
    {
        return Some((*new).to_owned());
    }
    let short: String = word.chars().take(60).collect();
    known
        .iter()
        .map(|k| (strsim::damerau_levenshtein(&short, k), k))
        // A word with the same first letter may be one edit farther away.
        .filter(|(distance, k)| {
            let starts_alike = k.chars().next() == short.chars().next();
            *distance <= (k.len() / 4).max(1) + usize::from(starts_alike)
        })
        .min()
        .map(|(_, k)| k.clone())
}
