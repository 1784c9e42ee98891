mod kept;
mod manifest;

use centrode_geometry::{Solid, checkpoint};
use std::{
    ffi::OsStr,
    fs,
    io::{self, Cursor, Write as _},
    path::{Path, PathBuf},
};
use thiserror::Error;
use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

use self::manifest::MANIFEST;
use crate::stage::{Stage, destination, put};

/// Files ready to be written: names and contents, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bundle {
    files: Vec<(String, Vec<u8>)>,
    solids: Vec<(String, Solid)>,
    /// Names of notes on these files that an earlier export may have written.
    notes: Vec<&'static str>,
}

/// Reason why a bundle could not be built or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BundleError {
    /// A file name that could lead out of the directory.
    #[error("{name:?} is not a plain file name or a relative path of plain names")]
    Name {
        /// The name.
        name: String,
    },
    /// Two files of one name.
    #[error("two files are named {name:?}")]
    Twice {
        /// The name.
        name: String,
    },
    /// Files that no export wrote, or that were changed since, would be replaced.
    #[error(
        "{} contains files that are not from an export, or that were changed since: {files}; choose another folder, or replace them with force",
        folder.display()
    )]
    Foreign {
        /// Names of the files.
        files: String,
        /// The folder.
        folder: PathBuf,
    },
    /// The archive would be larger than the format holds.
    #[error("the archive cannot be created: {0}")]
    Archive(#[from] zip::result::ZipError),
    /// The system refused an action.
    #[error("cannot {action} {}: {source}", path.display())]
    Disk {
        /// Action that failed.
        action: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl Bundle {
    /// Adds a file; its name may begin with folders, such as `collision/hub.stl`.
    ///
    /// # Errors
    /// [`BundleError::Name`] unless folders and file have plain names, [`BundleError::Twice`] if the bundle has a file of that
    /// name already (letter case is ignored).
    pub fn add(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), BundleError> {
        if !name.split('/').all(is_plain) {
            return Err(BundleError::Name {
                name: name.to_owned(),
            });
        }
        if self
            .files
            .iter()
            .any(|(other, _)| other.eq_ignore_ascii_case(name))
        {
            return Err(BundleError::Twice {
                name: name.to_owned(),
            });
        }
        self.files.push((name.to_owned(), bytes));
        Ok(())
    }

    /// Adds the files of another bundle.
    ///
    /// # Errors
    /// [`BundleError::Twice`] if this bundle has a file of one of these names already.
    pub fn append(&mut self, mut other: Self) -> Result<(), BundleError> {
        self.solids.append(&mut other.solids);
        for (name, bytes) in other.into_files() {
            self.add(&name, bytes)?;
        }
        Ok(())
    }

    /// Names and contents, in order.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.files
            .iter()
            .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
    }

    /// Names and contents, in order; consumes the bundle.
    pub fn into_files(self) -> impl Iterator<Item = (String, Vec<u8>)> {
        self.files.into_iter()
    }

    /// Packs every file into one zip archive; equal files give equal bytes.
    ///
    /// # Errors
    /// [`BundleError::Archive`] if it would be larger than the format holds.
    pub fn zip(&self) -> Result<Vec<u8>, BundleError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .unix_permissions(0o644);
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in &self.files {
            archive.start_file(name.as_str(), options)?;
            archive
                .write_all(bytes)
                .map_err(zip::result::ZipError::from)?;
        }
        Ok(archive.finish()?.into_inner())
    }

    /// Writes every file like [`write_to`](Self::write_to). Unless `force` is set, it refuses to replace a file that no export
    /// wrote into this directory, or that was changed since. The hidden file `.centrode-files` there lists the written files.
    ///
    /// # Errors
    /// [`BundleError::Foreign`] if such a file would be replaced, [`BundleError::Disk`] with the path and the system's reason.
    pub fn export_to(&self, directory: &Path, force: bool) -> Result<Vec<PathBuf>, BundleError> {
        let manifest = self.manifest(directory, force)?;
        let files = std::iter::once((MANIFEST, &*manifest)).chain(self.files());
        let files: Vec<(&str, &[u8])> = files.collect();
        let mut written = write_all(&files, directory)?;
        written.remove(0);
        self.remove_old_notes(directory)?;
        Ok(written)
    }

    /// Writes every file into a directory and returns the paths. The directory and folders in it are created if they are missing.
    ///
    /// All contents are first written and flushed in hidden folders, then renamed: a file is complete or, after an error, as it
    /// was before; nothing else remains. The next program that writes there removes the remains of a killed one; several may
    /// write at the same time. A replaced file keeps its permissions and the links to it; a target that is read-only or no
    /// regular file is not replaced. Cancelled by [`Cancel`](centrode_geometry::Cancel), the export leaves no new file.
    ///
    /// # Errors
    /// [`BundleError::Disk`] with the path and the system's reason.
    pub fn write_to(&self, directory: &Path) -> Result<Vec<PathBuf>, BundleError> {
        write_all(&self.files().collect::<Vec<_>>(), directory)
    }
}

/// Writes files into a directory: all contents first, then all names in their order.
fn write_all(files: &[(&str, &[u8])], directory: &Path) -> Result<Vec<PathBuf>, BundleError> {
    fs::create_dir_all(directory).map_err(failed("create the directory", directory))?;
    let mut stages: Vec<(PathBuf, Stage)> = Vec::new();
    let mut staged = Vec::with_capacity(files.len());
    for (name, bytes) in files {
        checkpoint();
        let target = directory.join(name);
        let real = destination(&target).map_err(failed("write", &target))?;
        let folder = real.parent().unwrap_or(directory);
        if !stages.iter().any(|(of, _)| of == folder) {
            fs::create_dir_all(folder).map_err(failed("create the directory", folder))?;
            let stage = Stage::open(folder).map_err(failed("create a file in", folder))?;
            stages.push((folder.to_owned(), stage));
        }
        let Some((_, stage)) = stages.iter().find(|(of, _)| of == folder) else {
            continue;
        };
        let file = real.file_name().unwrap_or_default();
        let place = stage.place(&file.to_string_lossy());
        put(bytes, &place, &real).map_err(failed("write", &target))?;
        staged.push((place, real, target));
    }
    let mut written = Vec::with_capacity(files.len());
    for (place, real, target) in staged {
        fs::rename(place, &real).map_err(failed("write", &target))?;
        written.push(target);
    }
    Ok(written)
}

/// Writes one complete file or, after an error, leaves the old one; its folder is created if it is missing.
///
/// # Errors
/// [`BundleError::Name`] if the path does not end in a plain file name, [`BundleError::Disk`] with the
/// system's reason.
pub fn write_file(path: &Path, bytes: Vec<u8>) -> Result<(), BundleError> {
    let (folder, name) = split(path)?;
    let mut bundle = Bundle::default();
    bundle.add(name, bytes)?;
    bundle.write_to(folder)?;
    Ok(())
}

/// Writes a new complete file or, after an error, none; an existing file is not changed.
///
/// # Errors
/// [`BundleError::Name`] if the path does not end in a plain file name, [`BundleError::Disk`] with the
/// system's reason, of kind [`AlreadyExists`](io::ErrorKind::AlreadyExists) if the name is taken.
pub fn write_new_file(path: &Path, bytes: &[u8]) -> Result<(), BundleError> {
    let (folder, name) = split(path)?;
    Bundle::default().add(name, Vec::new())?;
    let made = Stage::open(folder).and_then(|stage| {
        let place = stage.place(name);
        put(bytes, &place, path)?;
        match fs::hard_link(&place, path) {
            // A file system without links: rename instead. Only another program could take the name in between.
            Err(error)
                if error.kind() != io::ErrorKind::AlreadyExists
                    && fs::symlink_metadata(path).is_err() =>
            {
                fs::rename(&place, path)
            }
            linked => linked,
        }
    });
    made.map_err(failed("make", path))
}

/// Folder and name of a file.
fn split(path: &Path) -> Result<(&Path, &str), BundleError> {
    let name = path.file_name().and_then(OsStr::to_str);
    let name = name.ok_or_else(|| BundleError::Name {
        name: path.display().to_string(),
    })?;
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    Ok((folder.unwrap_or(Path::new(".")), name))
}

/// Whether a name stays inside its folder, and is visible, on every system.
fn is_plain(name: &str) -> bool {
    let apart = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    !name.is_empty() && !name.starts_with('.') && !name.chars().any(apart)
}

fn failed(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> BundleError {
    let path = path.to_owned();
    move |source| BundleError::Disk {
        action,
        path,
        source,
    }
}

#[cfg(test)]
mod tests;
