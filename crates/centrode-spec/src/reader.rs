use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::family::{DesignFamily, DesignSpec};
use super::fault::nearest;
use super::keys::{Keys, inside, line_and_column};
use super::number::written;
use super::{DesignError, DesignFault, sample_file};
use crate::SpecError;

/// Keys of earlier versions, and their present names in another table.
const RENAMED: [(&str, &str); 1] = [("profile_shift_coefficient", "shift")];

/// State of reading a file.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    text: &'a str,
    keys: Keys,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            text,
            keys: Keys::default(),
        }
    }

    /// The positions of the keys.
    pub(super) fn into_keys(self) -> Keys {
        self.keys
    }

    /// Splits the file into its family, from the key `family`, and all other keys.
    pub(super) fn root<'f, F: AsRef<DesignFamily>>(
        &mut self,
        families: &'f [F],
    ) -> Result<(Spanned<DeTable<'a>>, &'f F), DesignError> {
        let mut root = DeTable::parse(self.text).map_err(|e| self.syntax(&e))?;
        sample_file::spread(root.get_mut());
        self.keys = Keys::new(root.get_ref());
        if root.get_ref().is_empty() {
            let example = families.first().map_or("", |family| family.as_ref().word);
            return Err(self.error(DesignFault::Empty { example }, String::new(), 0));
        }
        let word = self.word(root.get_ref(), "family", "family", 0)?;
        let Some(family) = families.iter().find(|f| f.as_ref().word == word) else {
            let known: Vec<String> = families.iter().map(|f| f.as_ref().word.into()).collect();
            return Err(self.unknown_word("family", word, &known));
        };
        root.get_mut().remove("family");
        Ok((root, family))
    }

    /// Reads the design of a family.
    pub(super) fn design<D: DesignSpec>(
        &self,
        root: Spanned<DeTable<'a>>,
    ) -> Result<D, DesignError> {
        self.tables(root.get_ref(), D::TABLES)?;
        let design = D::deserialize(Deserializer::from(root))
            .map_err(|e| self.shape(&e, DesignFamily::new::<D>()))?;
        let read = written(&design).ok();
        if let Some((key, length, kept)) = read.and_then(|read| self.keys.cut(&read)) {
            let fault = DesignFault::WrongType(format!("must have {kept} values, not {length}"));
            let offset = self.keys.offset(&key).unwrap_or(0);
            return Err(self.error(fault, key, offset));
        }
        design.rules().map_err(|SpecError { key, rule }| {
            let offset = self.keys.offset(&key).unwrap_or(0);
            self.error(DesignFault::Value(rule), key, offset)
        })?;
        Ok(design)
    }

    /// Refuses any value but a table at the keys; serde would read a list as the values of a table in order.
    fn tables(&self, root: &DeTable<'_>, keys: &[&str]) -> Result<(), DesignError> {
        for &key in keys {
            if root.get(key).is_some_and(|v| !v.get_ref().is_table()) {
                let fault = DesignFault::WrongType(format!("must be a table: write [{key}]"));
                let offset = self.keys.offset(key).unwrap_or(0);
                return Err(self.error(fault, key.into(), offset));
            }
        }
        Ok(())
    }

    /// The string at a key that must be there.
    fn word(
        &self,
        table: &DeTable<'_>,
        key: &str,
        path: &str,
        around: usize,
    ) -> Result<String, DesignError> {
        let Some(value) = table.get(key) else {
            let fault = DesignFault::MissingKey(key.into());
            return Err(self.error(fault, path.into(), around));
        };
        match value.get_ref() {
            DeValue::String(word) => Ok(word.to_string()),
            _ => {
                let fault = DesignFault::WrongType("must be a word in quotes".into());
                let offset = self.keys.offset(path).unwrap_or(around);
                Err(self.error(fault, path.into(), offset))
            }
        }
    }

    fn unknown_word(&self, path: &str, word: String, known: &[String]) -> DesignError {
        let fault = DesignFault::UnknownWord {
            near: nearest(&word, known),
            word,
            known: known.to_vec(),
        };
        let offset = self.keys.offset(path).unwrap_or(0);
        self.error(fault, path.into(), offset)
    }

    fn error(&self, fault: DesignFault, key: String, offset: usize) -> DesignError {
        let (line, column) = line_and_column(self.text, offset);
        DesignError {
            fault,
            key,
            line,
            column,
        }
    }

    fn syntax(&self, error: &toml::de::Error) -> DesignError {
        let offset = error.span().map_or(self.text.len(), |s| s.start);
        let fault = DesignFault::Syntax(error.message().into());
        self.error(fault, String::new(), offset)
    }

    /// Names the key of an error that serde has found, in the words of the file rather than of Rust.
    fn shape(&self, error: &toml::de::Error, family: DesignFamily) -> DesignError {
        let offset = error.span().map_or(0, |s| s.start);
        let key = self.keys.around(offset).unwrap_or_default().to_owned();
        let message = error.message();
        let (key, offset) = inside(self.text, &key, offset, message).unwrap_or((key, offset));
        let names = quoted(message);
        if message.starts_with("unknown field") {
            let mut known: Vec<String> = names.iter().skip(1).cloned().collect();
            // Serde does not list the keys of a table that is read in two parts.
            if known.is_empty() {
                known = family.keys_next_to(&key);
            }
            let name = names.first().map_or("", String::as_str);
            let near = nearest(name, &known);
            let now = RENAMED.iter().find(|(before, _)| *before == name);
            let elsewhere = family.keys_named(now.map_or(name, |(_, now)| now), &key);
            let fault = DesignFault::UnknownKey {
                near,
                known,
                elsewhere,
            };
            return self.error(fault, key, offset);
        }
        if message.starts_with("unknown variant") {
            let known: Vec<String> = names.iter().skip(1).cloned().collect();
            let word = names.first().cloned().unwrap_or_default();
            let near = nearest(&word, &known);
            return self.error(DesignFault::UnknownWord { word, near, known }, key, offset);
        }
        if let (true, Some(name)) = (message.starts_with("missing field"), names.first()) {
            let fault = DesignFault::MissingKey(name.clone());
            // At offset 0 no table has been opened: the key is missing at the root, whatever key comes first.
            let path = if key.is_empty() || offset == 0 {
                name.clone()
            } else {
                format!("{key}.{name}")
            };
            let offset = self.keys.offset(&path).unwrap_or(0);
            return self.error(fault, path, offset);
        }
        self.error(DesignFault::WrongType(plain(message)), key, offset)
    }
}

/// Rewords a message of serde about a value of the wrong type, without the names of Rust types.
fn plain(message: &str) -> String {
    let after = |start: &str| message.strip_prefix(start)?.split_once(", expected ");
    if let Some((given, expected)) = after("invalid length ")
        && let Some(count) = expected.strip_prefix("an array of length ")
    {
        return format!("must have {count} values, not {given}");
    }
    if message == "wanted string or table" {
        return "must be a word in quotes or a table".into();
    }
    let Some((given, expected)) = after("invalid type: ").or_else(|| after("invalid value: "))
    else {
        return message.into();
    };
    let given = match given.split_once(' ') {
        // The value itself follows the name of its type, numbers in backticks.
        Some((_, value)) if value.starts_with(['"', '`']) || value.starts_with("point `") => {
            let value = value.trim_start_matches("point ");
            value.trim_end_matches(" as i128").trim_matches('`')
        }
        _ => match given {
            "sequence" => "a list",
            "map" => "a table",
            other => other,
        },
    };
    let expected = match expected {
        "f64" => "a number",
        "u32" | "u64" | "usize" => "a whole number, 0 or greater",
        "i32" | "i64" => "a whole number",
        "a sequence" => "a list",
        "variant identifier" => "a word in quotes",
        other if other.starts_with("struct ") => "a table",
        other => match other.strip_prefix("an array of length ") {
            Some(count) => &format!("a list of {count} values"),
            None => other,
        },
    };
    format!("must be {expected}, not {given}")
}

/// The parts of a message in backticks.
fn quoted(message: &str) -> Vec<String> {
    let parts = message.split('`').skip(1).step_by(2);
    parts.map(String::from).collect()
}
