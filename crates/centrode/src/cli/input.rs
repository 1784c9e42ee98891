use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::family::{FAMILIES, OpenDesign};
use crate::mechanism::design::{DesignError, DesignFile};

use crate::cli::failure::Failure;

/// Text of a design file, kept for its errors.
pub(crate) struct Source {
    name: String,
    bytes: Vec<u8>,
}

impl Source {
    /// Reads a file, or standard input for `-`; a little more than a design may have is enough.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        Self::open_up_to(path, DesignFile::LARGEST)
    }

    /// Reads a file, or standard input for `-`, up to one byte more than a limit.
    pub(crate) fn open_up_to(path: &Path, limit: usize) -> Result<Self, Failure> {
        let standard = path == Path::new("-");
        let name = if standard {
            "standard input".into()
        } else {
            path.display().to_string()
        };
        let mut bytes = Vec::new();
        let limit = limit as u64 + 1;
        let read = if standard {
            io::stdin().lock().take(limit).read_to_end(&mut bytes)
        } else {
            File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes))
        };
        match read {
            Ok(_) => Ok(Self { name, bytes }),
            Err(error) => Err(Failure::Input { name, error }),
        }
    }

    /// The bytes read.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Name of the file, for its errors.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Failure of an error that tells its place in the file itself.
    pub(crate) fn refused(&self, error: &dyn std::error::Error) -> Failure {
        Failure::Usage(format!("{}: {error}", self.name))
    }

    /// Refuses to write over the design.
    pub(crate) fn keep_from(&self, output: &Path) -> Result<(), Failure> {
        self.keep(output, "the design")
    }

    /// Refuses to write over the file read.
    pub(crate) fn keep(&self, output: &Path, noun: &str) -> Result<(), Failure> {
        let [own, other] = [Path::new(&self.name), output].map(|path| path.canonicalize().ok());
        if own.is_some() && own == other {
            let path = output.display();
            return Err(Failure::Usage(format!(
                "{path} is {noun}: name another file to write"
            )));
        }
        Ok(())
    }

    /// Source of a text that is in no file.
    pub(crate) fn of_text(text: &str) -> Self {
        Self {
            name: "design".into(),
            bytes: text.as_bytes().to_vec(),
        }
    }

    /// Text of the file, whatever it means.
    pub(crate) fn text(&self) -> Result<String, Failure> {
        match std::str::from_utf8(&self.bytes) {
            Ok(text) if text.len() <= DesignFile::LARGEST => Ok(text.to_owned()),
            // Reading such a file always fails, and says why.
            _ => self
                .design()
                .and(Err(Failure::Usage("not a design".into()))),
        }
    }

    /// Design of the file.
    pub(crate) fn design(&self) -> Result<OpenDesign, Failure> {
        FAMILIES
            .read(&self.bytes)
            .map_err(|error| self.blame(error))
    }

    /// Failure of an error, shown at its line of this file.
    pub(crate) fn blame(&self, error: DesignError) -> Failure {
        Failure::Design {
            name: self.name.clone(),
            text: String::from_utf8_lossy(&self.bytes).into_owned(),
            error: Box::new(error),
        }
    }
}
