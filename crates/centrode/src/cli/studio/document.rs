use crate::cli::failure::Failure;
use crate::cli::input::{self, Source};
use crate::formats::{Bundle, BundleError};
use centrode_spec::{DesignError, DesignFile};
use serde::Serialize;
use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Design file of a page, and its autosaves next to it: no other file is ever written.
pub(crate) struct Document {
    folder: PathBuf,
    name: String,
    /// Text of the file when it was last read or written here.
    known: Mutex<String>,
    /// Whether the autosave holds work of the page that is open now: earlier work is not overwritten.
    own: AtomicBool,
}

/// Text of a design, and the same with the samples of the files that it names.
#[derive(Debug)]
pub(crate) struct DesignText {
    /// Text as the page shows it.
    pub(crate) text: String,
    /// Text that is read.
    pub(crate) whole: Result<String, DesignError>,
}

/// State of the file on disk.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Disk {
    /// Text of the file.
    Text(String),
    /// Reason why there is no text, to be shown after the file's name.
    Missing(String),
}

/// Work that was not saved before the program ended.
#[derive(Debug, Serialize)]
pub(crate) struct Recovered {
    text: String,
    file: String,
}

/// Reason why the file is not saved.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SaveError {
    #[error("{name} was changed on disk after it was opened here")]
    Changed { name: String },
    #[error("{name} {how}")]
    Missing { name: String, how: String },
    #[error(transparent)]
    Bundle(#[from] BundleError),
    #[error(
        "the design has {bytes} bytes; the limit for a design file is {}",
        DesignFile::LARGEST
    )]
    TooLarge { bytes: usize },
}

impl Document {
    /// Opens a design file; the design may have errors.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        if path == Path::new("-") {
            let message = "the page saves the design file: give a file, not standard input";
            return Err(Failure::Usage(message.into()));
        }
        let source = Source::open(path)?;
        let text = source.text()?;
        // A link is followed once: saving replaces the file to which it leads, not the link.
        let path = path.canonicalize().map_err(|error| Failure::Input {
            name: path.display().to_string(),
            error,
        })?;
        let folder = path.parent().unwrap_or(Path::new("/")).to_owned();
        let name = path.file_name().and_then(|n| n.to_str()).map(str::to_owned);
        let name = name.ok_or_else(|| Failure::Usage("the file name is not valid text".into()))?;
        // A name that could not be written is refused before the user begins to work.
        Bundle::default().add(&name, Vec::new())?;
        Ok(Self {
            folder,
            name,
            known: Mutex::new(text),
            own: AtomicBool::new(false),
        })
    }

    /// Name of the file.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Path of the file.
    pub(crate) fn path(&self) -> PathBuf {
        self.folder.join(&self.name)
    }

    /// A text of the design with the samples of the files that it names, which are relative to the folder of the design file.
    pub(crate) fn with_files(&self, text: String) -> DesignText {
        let whole = input::with_files(&text, &self.folder).map(Cow::into_owned);
        DesignText { text, whole }
    }

    /// Text of the file when it was last read or written here.
    pub(crate) fn text(&self) -> String {
        self.known().clone()
    }

    /// Reads the file as it is now.
    pub(crate) fn reread(&self) -> Result<String, SaveError> {
        let mut known = self.known();
        *known = self.found(self.disk())?;
        Ok(known.clone())
    }

    fn found(&self, disk: Disk) -> Result<String, SaveError> {
        let name = self.name.clone();
        match disk {
            Disk::Text(text) => Ok(text),
            Disk::Missing(how) => Err(SaveError::Missing { name, how }),
        }
    }

    /// Writes the file, whole or not at all; a file that no longer holds `base` is overwritten only if `over` is set.
    pub(crate) fn save(&self, text: &str, base: &str, over: bool) -> Result<(), SaveError> {
        if text.len() > DesignFile::LARGEST {
            return Err(SaveError::TooLarge { bytes: text.len() });
        }
        let mut known = self.known();
        if !over && self.found(self.disk())? != base {
            return Err(SaveError::Changed {
                name: self.name.clone(),
            });
        }
        write(&self.folder, &self.name, text)?;
        text.clone_into(&mut known);
        drop(known);
        // An autosave that was neither restored nor discarded stays.
        if self.own.load(Ordering::Relaxed) || self.kept().as_deref() == Some(text.as_bytes()) {
            self.forget(&self.autosave());
        }
        Ok(())
    }

    /// Writes unsaved work next to the file; removes the autosave once the file holds this work.
    ///
    /// An existing autosave of earlier work is first renamed.
    pub(crate) fn keep(&self, text: &str) -> Result<(), SaveError> {
        if text.len() > DesignFile::LARGEST {
            return Err(SaveError::TooLarge { bytes: text.len() });
        }
        let known = self.known();
        let saved = *known == text;
        if !self.own.load(Ordering::Relaxed) {
            let settled = [text.as_bytes(), known.as_bytes()];
            let left = self.kept().filter(|left| !settled.contains(&&**left));
            if saved && left.is_some() {
                return Ok(());
            }
            if left.is_some() {
                self.set_aside()?;
            }
            self.own.store(true, Ordering::Relaxed);
        }
        if saved {
            self.forget(&self.autosave());
            return Ok(());
        }
        Ok(write(&self.folder, &self.autosave(), text)?)
    }

    /// Contents of the autosaves that differ from the file; none of them is overwritten from now on.
    pub(crate) fn recovered(&self) -> Vec<Recovered> {
        let known = self.known();
        self.own.store(false, Ordering::Relaxed);
        let names = fs::read_dir(&self.folder).into_iter().flatten();
        let names = names.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut files: Vec<String> = names.filter(|name| self.is_autosave(name)).collect();
        files.sort_by_key(|name| (name.len(), name.clone()));
        files
            .into_iter()
            .filter_map(|file| {
                let bytes = input::read(&self.folder.join(&file), DesignFile::LARGEST).ok()?;
                let text = String::from_utf8_lossy(&bytes).into_owned();
                (text != *known).then_some(Recovered { text, file })
            })
            .collect()
    }

    /// Removes an autosave; any other file stays.
    pub(crate) fn forget(&self, file: &str) {
        if self.is_autosave(file) {
            // Usually there is none.
            let _ = fs::remove_file(self.folder.join(file));
        }
    }

    fn autosave(&self) -> String {
        format!("{}.autosave", self.name)
    }

    /// Content of the autosave, if there is one.
    fn kept(&self) -> Option<Vec<u8>> {
        input::read(&self.folder.join(self.autosave()), DesignFile::LARGEST).ok()
    }

    /// Whether this is the name of an autosave, or of an earlier one that has been set aside.
    fn is_autosave(&self, file: &str) -> bool {
        let rest = file.strip_prefix(&self.autosave());
        rest.is_some_and(|rest| {
            let number = rest.strip_prefix('-').unwrap_or_default();
            rest.is_empty() || number.parse::<u32>().is_ok_and(|n| n.to_string() == number)
        })
    }

    /// Renames the autosave that was found to an unused name.
    fn set_aside(&self) -> Result<(), BundleError> {
        let found = self.folder.join(self.autosave());
        let place = |number: u32| {
            let name = format!("{}-{number}", self.autosave());
            self.folder.join(name)
        };
        let free = (1..)
            .map(place)
            .find(|path| fs::symlink_metadata(path).is_err());
        let Some(free) = free else { return Ok(()) };
        fs::rename(&found, &free).map_err(|source| BundleError::Disk {
            action: "set aside",
            path: found,
            source,
        })
    }

    /// State of the file now.
    pub(crate) fn disk(&self) -> Disk {
        let path = self.path();
        let most = DesignFile::LARGEST;
        match fs::metadata(&path) {
            Ok(meta) if meta.len() > most as u64 => Disk::Missing(format!(
                "has {} bytes on disk; the limit for a design file is {most}",
                meta.len()
            )),
            Ok(_) => match input::read(&path, most).map(String::from_utf8) {
                Ok(Ok(text)) => Disk::Text(text),
                Ok(Err(_)) => Disk::Missing("is not UTF-8 text on disk".into()),
                Err(error) => Disk::Missing(format!("cannot be read: {error}")),
            },
            Err(_) => Disk::Missing("has been deleted or moved".into()),
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
        assert_eq!(document.disk(), Disk::Text("a = 1\n".into()));
        fs::write(&path, "a = 2\n").expect("written");
        assert_eq!(document.disk(), Disk::Text("a = 2\n".into()));
        let refused = document.save("a = 3\n", "a = 1\n", false);
        assert!(matches!(refused, Err(SaveError::Changed { .. })));
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 2\n");
        document
            .save("a = 3\n", "a = 1\n", true)
            .expect("written over");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 3\n");
        fs::write(&path, "a = 4\n").expect("written");
        assert_eq!(document.reread().expect("read"), "a = 4\n");
        document.save("a = 5\n", "a = 4\n", false).expect("saved");
        // Another window has not read that.
        let refused = document.save("a = 6\n", "a = 4\n", false);
        assert!(matches!(refused, Err(SaveError::Changed { .. })));
        fs::remove_file(&path).expect("gone");
        let refused = document
            .save("a = 6\n", "a = 5\n", false)
            .expect_err("gone");
        assert!(refused.to_string().contains("deleted"), "{refused}");
        assert!(document.reread().is_err());
        document
            .save("a = 6\n", "a = 5\n", true)
            .expect("written anew");
        fs::write(&path, vec![b' '; DesignFile::LARGEST + 1]).expect("written");
        let refused = document.reread().expect_err("too large");
        assert!(refused.to_string().contains("bytes"), "{refused}");
    }

    #[test]
    fn a_file_that_is_not_text_is_neither_read_nor_written_over() {
        let (folder, path, document) = opened();
        let refused = |bytes: &[u8]| {
            fs::write(&path, bytes).expect("written");
            let reread = document.reread().expect_err("no text").to_string();
            assert_eq!(reread, "pair.toml is not UTF-8 text on disk", "{bytes:?}");
            assert!(matches!(document.disk(), Disk::Missing(_)));
            assert!(document.save("a = 2\n", "a = 1\n", false).is_err());
            assert_eq!(fs::read(&path).expect("there"), bytes);
            assert_eq!(document.text(), "a = 1\n");
        };
        refused(b"\xff");
        refused(b"a = 1\n\xff");
        refused(b"title = \"\xe9\"\n");
        refused(b"\xc0\x80");
        refused(b"\xed\xa0\x80");
        refused(b"a = 1\n\xe2\x82");
        refused(b"\xff\xfea\0 \0=\0");
        refused(b"\xf8\x88\x80\x80\x80");
        for good in [
            "",
            "a = 1\n",
            "title = \"\u{e9}\u{1f600}\u{fffd}\"\n",
            "\u{feff}a = 1\n",
        ] {
            fs::write(&path, good).expect("written");
            assert_eq!(document.reread().expect("text"), good);
        }
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    fn texts(document: &Document) -> Vec<String> {
        let recovered = document.recovered().into_iter();
        recovered.map(|found| found.text).collect()
    }

    #[test]
    fn what_is_not_saved_is_found_again() {
        let (folder, path, document) = opened();
        assert!(texts(&document).is_empty());
        document.keep("a = 2\n").expect("kept");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 1\n");
        let again = Document::open(&path).expect("opened");
        assert_eq!(texts(&again), ["a = 2\n"]);
        again.save("a = 2\n", "a = 1\n", false).expect("saved");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
        again.keep("a = 3\n").expect("kept");
        again.keep("a = 2\n").expect("nothing to keep");
        assert!(texts(&again).is_empty());
    }

    #[test]
    fn work_found_again_stays_until_it_is_restored_or_discarded() {
        let (folder, path, document) = opened();
        document.keep("a = 2\n").expect("kept");
        let again = Document::open(&path).expect("opened");
        // Nobody decides about it, and work goes on.
        again.keep("a = 3\n").expect("kept");
        again.keep("a = 4\n").expect("kept");
        again.keep("a = 1\n").expect("back to the file");
        assert_eq!(texts(&again), ["a = 2\n"]);
        again.keep("a = 5\n").expect("kept");
        assert_eq!(texts(&again), ["a = 5\n", "a = 2\n"]);
        // After a reload this page's own work is treated likewise.
        again.keep("a = 6\n").expect("kept");
        assert_eq!(texts(&again), ["a = 6\n", "a = 2\n", "a = 5\n"]);
        again.save("a = 7\n", "a = 1\n", false).expect("saved");
        assert_eq!(texts(&again), ["a = 6\n", "a = 2\n", "a = 5\n"]);
        for found in again.recovered() {
            again.forget(&found.file);
        }
        again.forget("pair.toml");
        again.forget("pair.toml.autosave-01");
        let left = fs::read_dir(folder.path()).expect("readable").count();
        assert_eq!(
            (left, fs::read_to_string(&path).expect("there")),
            (1, "a = 7\n".into())
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let (folder, path, _) = opened();
        let link = folder.path().join("link.toml");
        std::os::unix::fs::symlink(&path, &link).expect("linked");
        let document = Document::open(&link).expect("opened");
        document.save("a = 9\n", "a = 1\n", false).expect("saved");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 9\n");
    }

    #[test]
    fn a_save_cut_short_leaves_the_file() {
        let (folder, path, document) = opened();
        let cancel = crate::geometry::Cancel::default();
        cancel.cancel();
        let cut = cancel.run(|| document.save("a = 2\n", "a = 1\n", false));
        assert!(cut.is_err());
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 1\n");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
        document.save("a = 2\n", "a = 1\n", false).expect("saved");
        assert_eq!(fs::read_to_string(&path).expect("there"), "a = 2\n");
    }
}
