use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use centrode::export::{Bundle, BundleError};
use centrode::mechanism::design::DesignFile;
use serde::Serialize;

use crate::failure::Failure;
use crate::input::Source;

/// The design file the page was started with, and its autosave beside it: all that is ever written.
pub(crate) struct Document {
    folder: PathBuf,
    name: String,
    /// What the file held when it was last read or written here.
    known: Mutex<String>,
}

/// Work that was not saved before the program ended.
#[derive(Debug, Serialize)]
pub(crate) struct Recovered {
    text: String,
    file: String,
}

/// Why the file is not saved.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SaveError {
    #[error("{name} has been changed on disk since it was opened here")]
    Changed { name: String },
    #[error(transparent)]
    Bundle(#[from] BundleError),
    #[error(
        "the design has {bytes} bytes; a design file has at most {}",
        DesignFile::LARGEST
    )]
    TooLarge { bytes: usize },
}

impl Document {
    /// Opens a design file; it need not be a good design.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        if path == Path::new("-") {
            let message = "the page saves into the file it shows: give a file, not standard input";
            return Err(Failure::Usage(message.into()));
        }
        let source = Source::open(path)?;
        let text = source.text()?;
        // A link is followed once: saving replaces the file it leads to, not the link.
        let path = path.canonicalize().map_err(|error| Failure::Input {
            name: path.display().to_string(),
            error,
        })?;
        let folder = path.parent().unwrap_or(Path::new("/")).to_owned();
        let name = path.file_name().and_then(|n| n.to_str()).map(str::to_owned);
        let name = name.ok_or_else(|| Failure::Usage("the file's name is not text".into()))?;
        // A name that could not be written is refused before work goes into it.
        Bundle::default().add(&name, Vec::new())?;
        Ok(Self {
            folder,
            name,
            known: Mutex::new(text),
        })
    }

    /// Name of the file.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// What the file held when it was last read or written here.
    pub(crate) fn text(&self) -> String {
        self.known().clone()
    }

    /// What the file holds now, if that is something else.
    pub(crate) fn changed(&self) -> Option<String> {
        let known = self.known();
        let disk = self.disk();
        (disk != *known).then_some(disk)
    }

    /// Takes what the file holds now as read.
    pub(crate) fn reread(&self) -> String {
        let mut known = self.known();
        *known = self.disk();
        known.clone()
    }

    /// Writes the file, whole or not at all; a file changed by others only if `over` says so.
    pub(crate) fn save(&self, text: &str, over: bool) -> Result<(), SaveError> {
        if text.len() > DesignFile::LARGEST {
            return Err(SaveError::TooLarge { bytes: text.len() });
        }
        let mut known = self.known();
        if self.disk() != *known && !over {
            return Err(SaveError::Changed {
                name: self.name.clone(),
            });
        }
        write(&self.folder, &self.name, text)?;
        text.clone_into(&mut known);
        drop(known);
        self.forget();
        Ok(())
    }

    /// Writes what is not saved yet beside the file; takes it away once it is what the file holds.
    pub(crate) fn keep(&self, text: &str) -> Result<(), SaveError> {
        if text.len() > DesignFile::LARGEST {
            return Err(SaveError::TooLarge { bytes: text.len() });
        }
        if *self.known() == text {
            self.forget();
            return Ok(());
        }
        Ok(write(&self.folder, &self.autosave(), text)?)
    }

    /// What an autosave holds, if it is not what the file holds.
    pub(crate) fn recovered(&self) -> Option<Recovered> {
        let file = self.autosave();
        let text = fs::read_to_string(self.folder.join(&file)).ok()?;
        (text != *self.known()).then_some(Recovered { text, file })
    }

    /// Takes the autosave away.
    pub(crate) fn forget(&self) {
        // Usually there is none.
        let _ = fs::remove_file(self.folder.join(self.autosave()));
    }

    fn autosave(&self) -> String {
        format!("{}.autosave", self.name)
    }

    /// The file as it is now; a file that has gone or cannot be read is empty.
    fn disk(&self) -> String {
        let path = self.folder.join(&self.name);
        match fs::metadata(&path) {
            Ok(meta) if meta.len() > DesignFile::LARGEST as u64 => String::new(),
            Ok(_) => fs::read(&path)
                .map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
                .unwrap_or_default(),
            Err(_) => String::new(),
        }
    }

    fn known(&self) -> MutexGuard<'_, String> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), BundleError> {
    let mut bundle = Bundle::default();
    bundle.add(name, text.as_bytes().to_vec())?;
    bundle.write_to(folder).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn opened() -> (tempfile::TempDir, PathBuf, Document) {
        let folder = tempfile::tempdir().expect("a place to write");
        let path = folder.path().join("pair.toml");
        fs::write(&path, "a = 1\n").expect("written");
        let document = Document::open(&path).expect("opened");
        (folder, path, document)
    }

    #[test]
    fn a_file_changed_by_others_is_kept() {
        let (_folder, path, document) = opened();
        assert!(document.changed().is_none());
        fs::write(&path, "a = 2\n").expect("written");
        assert_eq!(document.changed().as_deref(), Some("a = 2\n"));
        let refused = document.save("a = 3\n", false);
        assert!(matches!(refused, Err(SaveError::Changed { .. })));
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 2\n");
        document.save("a = 3\n", true).expect("written over");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 3\n");
        fs::write(&path, "a = 4\n").expect("written");
        assert_eq!(document.reread(), "a = 4\n");
        document.save("a = 5\n", false).expect("saved");
        fs::remove_file(&path).expect("gone");
        assert!(matches!(
            document.save("a = 6\n", false),
            Err(SaveError::Changed { .. })
        ));
    }

    #[test]
    fn what_is_not_saved_is_found_again() {
        let (folder, path, document) = opened();
        assert!(document.recovered().is_none());
        document.keep("a = 2\n").expect("kept");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 1\n");
        let again = Document::open(&path).expect("opened");
        assert_eq!(again.recovered().expect("kept").text, "a = 2\n");
        again.save("a = 2\n", false).expect("saved");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
        again.keep("a = 3\n").expect("kept");
        again.keep("a = 2\n").expect("nothing to keep");
        assert!(again.recovered().is_none());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let (folder, path, _) = opened();
        let link = folder.path().join("link.toml");
        std::os::unix::fs::symlink(&path, &link).expect("linked");
        let document = Document::open(&link).expect("opened");
        document.save("a = 9\n", false).expect("saved");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 9\n");
    }

    #[test]
    fn a_failed_save_leaves_the_file() {
        let (folder, path, document) = opened();
        let way = folder
            .path()
            .join(format!(".pair.toml.{}.part", std::process::id()));
        fs::create_dir(way).expect("in the way");
        let error = document.save("a = 2\n", false).expect_err("in the way");
        assert!(error.to_string().contains("pair.toml"), "{error}");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 1\n");
        assert!(document.changed().is_none());
    }
}
