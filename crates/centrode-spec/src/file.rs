use std::borrow::Cow;
use std::sync::Arc;

use toml::de::DeTable;

use super::keys::{Keys, line_and_column};
use super::reader::Reader;
use super::sample_file::{self, OpenFile, SampleTable};
use super::{Design, DesignError, DesignFamily, DesignFault, MechanismError};

/// Maximum number of mistakes of a file that are reported at once: ten times more would hide the first.
const MOST_MISTAKES: usize = 10;

/// A design together with the positions of its keys, so that later errors find their line.
#[derive(Clone, Debug)]
pub struct DesignFile {
    design: Arc<dyn Design>,
    text: String,
    keys: Keys,
}

impl DesignFile {
    /// Maximum size of a design file, bytes.
    pub const LARGEST: usize = 1 << 20;

    /// Reads a design file of one of the families, returns that family, and checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`DesignError`] with key, line and column.
    pub fn read<'f, F: AsRef<DesignFamily>>(
        bytes: &[u8],
        families: &'f [F],
    ) -> Result<(Self, &'f F), DesignError> {
        let text = Self::text_of(bytes)?;
        let mut reader = Reader::new(text);
        let (root, family) = reader.root(families)?;
        let file = Self {
            design: (family.as_ref().read)(&reader, root)?,
            text: text.into(),
            keys: reader.into_keys(),
        };
        Ok((file, family))
    }

    /// Text of a design file with the samples of the files that it names instead of their names, on the same lines. `open` reads
    /// a file by its name in the design.
    ///
    /// A text that is not TOML is returned as it is: reading it gives the error.
    ///
    /// # Errors
    /// [`DesignError`] at the key `file` or `column`, with the line of the file.
    pub fn with_files<'t>(
        text: &'t str,
        tables: &[SampleTable],
        open: OpenFile<'_>,
    ) -> Result<Cow<'t, str>, DesignError> {
        sample_file::with_files(text, tables, open)
    }

    /// Mistakes of a design file, ten at most. To find the next one, a wrong word or key is replaced by the nearest known one, and
    /// any other wrong entry is removed.
    #[must_use]
    pub fn mistakes<F: AsRef<DesignFamily>>(bytes: &[u8], families: &[F]) -> Vec<DesignError> {
        let mut text = String::from_utf8_lossy(bytes).into_owned();
        let mut found: Vec<DesignError> = Vec::new();
        while found.len() < MOST_MISTAKES {
            // The first pass reads the bytes themselves: if they are no text, the error states this.
            let read = if found.is_empty() {
                bytes
            } else {
                text.as_bytes()
            };
            let Err(error) = Self::read(read, families) else {
                break;
            };
            // An error that the corrections themselves cause is not reported.
            let mended = |key: &str| found.iter().any(|one| one.key == key);
            if !found.is_empty()
                && (matches!(error.fault, DesignFault::Syntax(_)) || mended(&error.key))
            {
                break;
            }
            let keys = DeTable::parse(&text).map(|root| Keys::new(root.get_ref()));
            let line = keys.ok().and_then(|keys| keys.line(&error.key, &text));
            let word = match &error.fault {
                DesignFault::UnknownWord { near, .. } => near.clone(),
                _ => None,
            };
            let key = match &error.fault {
                DesignFault::UnknownKey { near, .. } => near.clone(),
                _ => None,
            };
            found.push(error);
            match (line, word.or(key.clone())) {
                (None, _) => break,
                (Some([written, _]), Some(near)) if key.is_some() => {
                    let start = text[written.clone()].rfind('.').map_or(0, |dot| dot + 1);
                    text.replace_range(written.start + start..written.end, &near);
                }
                (Some([_, value]), Some(word)) => text.replace_range(value, &format!("{word:?}")),
                (Some([key, value]), None) => {
                    let blank: String = text[key.start..value.end]
                        .chars()
                        .map(|c| if c == '\n' { c } else { ' ' })
                        .collect();
                    text.replace_range(key.start..value.end, &blank);
                }
            }
        }
        found
    }

    pub(super) fn text_of(bytes: &[u8]) -> Result<&str, DesignError> {
        if bytes.len() > Self::LARGEST {
            let (bytes, limit) = (bytes.len(), Self::LARGEST);
            return Err(DesignError::at_start(DesignFault::TooLarge {
                bytes,
                limit,
            }));
        }
        std::str::from_utf8(bytes).map_err(|e| {
            let good = std::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
            let (line, column) = line_and_column(good, good.len());
            DesignError {
                line,
                column,
                ..DesignError::at_start(DesignFault::NotText)
            }
        })
    }

    /// The design.
    #[must_use]
    pub fn design(&self) -> &Arc<dyn Design> {
        &self.design
    }

    /// Line and column of a key, `teeth.backlash`, or of the innermost table around it that is in the file; the first line if
    /// there is no such table.
    #[must_use]
    pub fn place(&self, key: &str) -> (usize, usize) {
        let offset = self.keys.offset(key).unwrap_or(0);
        line_and_column(&self.text, offset)
    }

    /// The error of a design whose mechanism is not possible, at the position of its key.
    #[must_use]
    pub fn blame(&self, error: MechanismError) -> DesignError {
        let MechanismError { key, fault } = error;
        let (line, column) = self.place(&key);
        DesignError {
            fault,
            key,
            line,
            column,
        }
    }
}
