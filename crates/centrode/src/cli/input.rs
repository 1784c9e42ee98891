use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::family::{FAMILIES, OpenDesign};
use centrode_spec::{DesignError, DesignFile, shortened};

use crate::cli::failure::Failure;

/// Reads a file up to one byte more than a limit. A named pipe is refused: without a writer it would never be read.
pub(crate) fn read(path: &Path, limit: usize) -> io::Result<Vec<u8>> {
    // A pipe of the shell, as in `<(...)`, has no name that can be resolved.
    if let Ok(there) = path.canonicalize().and_then(fs::metadata)
        && is_pipe(there.file_type())
    {
        let words = "it is a named pipe: redirect it to standard input, and give - as the file";
        return Err(io::Error::other(words));
    }
    up_to(File::open(path)?, limit)
}

fn up_to(from: impl Read, limit: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[cfg(unix)]
fn is_pipe(kind: fs::FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&kind)
}

#[cfg(not(unix))]
fn is_pipe(_: fs::FileType) -> bool {
    false
}

/// Text of a design file with the samples of the files that it names. `folder` is the folder of the design.
///
/// # Errors
/// [`DesignError`] at the key of a file that cannot be read.
pub(crate) fn with_files<'t>(text: &'t str, folder: &Path) -> Result<Cow<'t, str>, DesignError> {
    FAMILIES.with_files(text, &|file| {
        let bytes = read(&folder.join(file), DesignFile::LARGEST);
        bytes.map_err(|error| error.to_string())
    })
}

/// Text of a design file, stored for its errors.
#[derive(Clone)]
pub(crate) struct Source {
    name: String,
    bytes: Vec<u8>,
    /// The text as it is on disk, if `bytes` have the samples of other files.
    written: Option<Vec<u8>>,
}

impl Source {
    /// Reads a file, or standard input for `-`; at most one byte more than a design may have.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        Self::open_up_to(path, DesignFile::LARGEST)
    }

    /// Reads a design file with the samples of the files that it names; a design from standard input has no folder for them.
    pub(crate) fn open_design(path: &Path) -> Result<Self, Failure> {
        let mut source = Self::open(path)?;
        if path != Path::new("-")
            && let Ok(text) = std::str::from_utf8(&source.bytes)
        {
            let folder = path.parent().unwrap_or(Path::new(""));
            let whole = with_files(text, folder).map_err(|error| source.blame(error))?;
            if let Cow::Owned(whole) = whole {
                source.written = Some(std::mem::replace(&mut source.bytes, whole.into_bytes()));
            }
        }
        Ok(source)
    }

    /// Reads a file, or standard input for `-`, up to one byte more than a limit.
    pub(crate) fn open_up_to(path: &Path, limit: usize) -> Result<Self, Failure> {
        let standard = path == Path::new("-");
        let name = if standard {
            "standard input".into()
        } else {
            path.display().to_string()
        };
        let read = if standard {
            up_to(io::stdin().lock(), limit)
        } else {
            read(path, limit)
        };
        match read {
            Ok(bytes) => Ok(Self {
                name,
                bytes,
                written: None,
            }),
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

    /// Failure of an error whose text already states its position in the file.
    pub(crate) fn refused(&self, error: &dyn std::error::Error) -> Failure {
        Failure::Usage(format!("{}: {}", self.name, shortened(&error.to_string())))
    }

    /// Refuses an output that would overwrite the design.
    pub(crate) fn keep_from(&self, output: &Path) -> Result<(), Failure> {
        self.keep(output, "the design")
    }

    /// Refuses an output that would overwrite the input file.
    pub(crate) fn keep(&self, output: &Path, noun: &str) -> Result<(), Failure> {
        let [own, other] = [Path::new(&self.name), output].map(|path| path.canonicalize().ok());
        if own.is_some() && own == other {
            let path = output.display();
            return Err(Failure::Usage(format!(
                "{path} is {noun}: choose another output file"
            )));
        }
        Ok(())
    }

    /// Source of a text that is in no file.
    pub(crate) fn of_text(text: &str) -> Self {
        Self {
            name: "design".into(),
            bytes: text.as_bytes().to_vec(),
            written: None,
        }
    }

    /// Text of the file, which need not be a design.
    pub(crate) fn text(&self) -> Result<String, Failure> {
        match std::str::from_utf8(&self.bytes) {
            Ok(text) if text.len() <= DesignFile::LARGEST => Ok(text.to_owned()),
            // Reading such a file as a design always fails, with the reason.
            _ => self
                .design()
                .and(Err(Failure::Usage("not a design".into()))),
        }
    }

    /// Design of the file.
    pub(crate) fn design(&self) -> Result<OpenDesign, Failure> {
        FAMILIES.read(&self.bytes).map_err(|_| {
            let errors = FAMILIES.mistakes(&self.bytes);
            self.failure(errors)
        })
    }

    /// Failure of an error, shown at its line of this file.
    pub(crate) fn blame(&self, error: DesignError) -> Failure {
        self.failure(vec![error])
    }

    fn failure(&self, errors: Vec<DesignError>) -> Failure {
        Failure::Design {
            name: self.name.clone(),
            text: String::from_utf8_lossy(self.written.as_ref().unwrap_or(&self.bytes))
                .into_owned(),
            errors,
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_named_pipe_is_refused_at_once_and_other_files_are_read() {
        let folder = tempfile::tempdir().expect("a place to write");
        let at = |name: &str| folder.path().join(name);
        let made = std::process::Command::new("mkfifo")
            .arg(at("pipe.toml"))
            .status();
        assert!(made.expect("mkfifo runs").success());
        fs::write(at("file.toml"), "a = 1\n").expect("written");
        fs::create_dir(at("folder")).expect("a folder");
        for (name, target) in [
            ("to-pipe", "pipe.toml"),
            ("to-link", "to-pipe"),
            ("to-file", "file.toml"),
            ("to-nothing", "missing"),
            ("folder/to-pipe", "../pipe.toml"),
        ] {
            std::os::unix::fs::symlink(target, at(name)).expect("linked");
        }
        for name in [
            "pipe.toml",
            "to-pipe",
            "to-link",
            "folder/to-pipe",
            "folder/../pipe.toml",
        ] {
            let error = read(&at(name), 10).expect_err(name);
            assert!(error.to_string().contains("named pipe"), "{name}: {error}");
            assert!(Source::open(&at(name)).is_err());
        }
        for name in ["file.toml", "to-file", "folder/../file.toml"] {
            assert_eq!(read(&at(name), 10).expect(name), b"a = 1\n");
        }
        assert_eq!(
            read(&at("file.toml"), 2).expect("read"),
            b"a =",
            "one byte more"
        );
        for name in ["to-nothing", "folder", "missing", "file.toml/a"] {
            assert!(read(&at(name), 10).is_err(), "{name}");
        }
        assert!(read(Path::new("/dev/null"), 10).expect("read").is_empty());
    }

    #[test]
    fn a_pipe_of_the_shell_is_read() {
        use std::os::fd::AsRawFd as _;

        let (from, mut to) = io::pipe().expect("a pipe");
        io::Write::write_all(&mut to, b"a = 1\n").expect("written");
        drop(to);
        let path = format!("/dev/fd/{}", from.as_raw_fd());
        assert_eq!(read(Path::new(&path), 10).expect("read"), b"a = 1\n");
    }
}
