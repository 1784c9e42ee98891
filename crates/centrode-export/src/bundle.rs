mod kept;

use centrode_geometry::{Solid, checkpoint};
use std::{
    ffi::OsStr,
    fs::{self, File},
    io::{self, Cursor, Write},
    path::{Path, PathBuf},
};
use thiserror::Error;
use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

use crate::stage::Stage;

/// Files ready to be written: names and contents, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bundle {
    files: Vec<(String, Vec<u8>)>,
    solids: Vec<(String, Solid)>,
}

/// Reason why a bundle could not be built or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BundleError {
    /// A file name that could lead out of the directory.
    #[error("{name:?} is not a plain file name, alone or after those of folders")]
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
    /// The archive would be larger than the format holds.
    #[error("the archive cannot be made: {0}")]
    Archive(#[from] zip::result::ZipError),
    /// The system refused an action.
    #[error("cannot {action} {}: {source}", path.display())]
    Disk {
        /// Action tried.
        action: &'static str,
        /// Path of it.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl Bundle {
    /// Adds a file; its name may begin with folders, such as `collision/hub.stl`.
    ///
    /// # Errors
    /// [`BundleError::Name`] unless folders and file have plain names,
    /// [`BundleError::Twice`] if a file of that name (letter case aside) is there already.
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
    /// [`BundleError::Twice`] if a file of one of these names is there already.
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

    /// Names and contents, in order, no longer in a bundle.
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

    /// Writes every file into a directory, which is made if it is missing, as are folders in it.
    /// Returns the paths.
    ///
    /// All contents are first written and flushed in hidden folders, then renamed: a file is there whole or, after an
    /// error, as it was before; nothing else is left behind. Remains of a killed program are cleared by the next one that
    /// writes there; several may write at the same time. A file written over keeps its permissions, and links to it still
    /// lead there; what is no regular file is not written over. Cancelled by [`Cancel`](centrode_geometry::Cancel) it leaves
    /// no new file.
    ///
    /// # Errors
    /// [`BundleError::Disk`] with the path and the system's reason.
    pub fn write_to(&self, directory: &Path) -> Result<Vec<PathBuf>, BundleError> {
        fs::create_dir_all(directory).map_err(failed("create the directory", directory))?;
        let mut stages: Vec<(PathBuf, Stage)> = Vec::new();
        let mut staged = Vec::with_capacity(self.files.len());
        for (name, bytes) in &self.files {
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
        let mut written = Vec::with_capacity(self.files.len());
        for (place, real, target) in staged {
            fs::rename(place, &real).map_err(failed("write", &target))?;
            written.push(target);
        }
        Ok(written)
    }
}

/// Writes one file whole or, after an error, leaves the old one; its folder is made if it is missing.
///
/// # Errors
/// [`BundleError::Name`] if the path does not end in a plain file name, [`BundleError::Disk`] with the
/// system's reason.
pub fn write_file(path: &Path, bytes: Vec<u8>) -> Result<(), BundleError> {
    let name = path.file_name().and_then(OsStr::to_str);
    let name = name.ok_or_else(|| BundleError::Name {
        name: path.display().to_string(),
    })?;
    let mut bundle = Bundle::default();
    bundle.add(name, bytes)?;
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    bundle.write_to(folder.unwrap_or(Path::new(".")))?;
    Ok(())
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

/// Where a file of that name is written: itself, or where its links lead.
fn destination(target: &Path) -> io::Result<PathBuf> {
    /// Most links in a row, as on Linux.
    const LINKS: u32 = 40;
    match fs::metadata(target) {
        Ok(there) if there.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(there) if !there.is_file() => Err(io::Error::other("it is no regular file")),
        Ok(_) if target.is_symlink() => target.canonicalize(),
        // Links to what is still to be made.
        Err(error) if error.kind() == io::ErrorKind::NotFound && target.is_symlink() => {
            let mut path = target.to_owned();
            for _ in 0..LINKS {
                if !path.is_symlink() {
                    return Ok(path);
                }
                let next = fs::read_link(&path)?;
                path = path.parent().unwrap_or(Path::new("")).join(next);
            }
            Err(error)
        }
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(target.to_owned()),
    }
}

/// Writes and flushes a new file that is to take the place of another, with its permissions.
fn put(bytes: &[u8], place: &Path, target: &Path) -> io::Result<()> {
    let mut file = File::create_new(place)?;
    if let Ok(before) = fs::metadata(target) {
        fs::set_permissions(place, before.permissions())?;
    }
    file.write_all(bytes)?;
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(directory)
            .expect("readable")
            .map(|entry| {
                entry
                    .expect("entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    #[test]
    fn files_are_written_whole_into_a_new_directory_and_over_old_ones() {
        let root = tempfile::tempdir().expect("a place to write");
        let directory = root.path().join("a").join("b");
        let mut bundle = Bundle::default();
        bundle.add("one.txt", b"first".to_vec()).expect("plain");
        bundle.add("two.txt", vec![7; 100_000]).expect("plain");
        let paths = bundle.write_to(&directory).expect("written");
        assert_eq!(paths.len(), 2);
        assert_eq!(names(&directory), ["one.txt", "two.txt"]);
        let mut second = Bundle::default();
        second.add("one.txt", b"second".to_vec()).expect("plain");
        second.write_to(&directory).expect("written over");
        assert_eq!(
            fs::read(directory.join("one.txt")).expect("there"),
            b"second"
        );
        assert_eq!(names(&directory), ["one.txt", "two.txt"]);
    }

    #[test]
    fn a_failure_leaves_old_files_and_no_temporaries() {
        let root = tempfile::tempdir().expect("a place to write");
        fs::write(root.path().join("one.txt"), b"old").expect("written");
        fs::create_dir(root.path().join("two.txt")).expect("a directory in the way");
        let mut bundle = Bundle::default();
        bundle.add("one.txt", b"new".to_vec()).expect("plain");
        bundle.add("two.txt", b"new".to_vec()).expect("plain");
        let error = bundle.write_to(root.path()).expect_err("in the way");
        assert!(error.to_string().contains("two.txt"), "{error}");
        assert_eq!(
            fs::read(root.path().join("one.txt")).expect("there"),
            b"old"
        );
        assert_eq!(names(root.path()), ["one.txt", "two.txt"]);
        let file = root.path().join("one.txt");
        let error = bundle.write_to(&file).expect_err("a file, not a directory");
        assert!(matches!(error, BundleError::Disk { .. }) && error.to_string().contains("one.txt"));
    }

    #[test]
    fn folders_of_a_bundle_are_made() {
        let root = tempfile::tempdir().expect("a place to write");
        let mut bundle = Bundle::default();
        bundle.add("top.txt", b"top".to_vec()).expect("plain");
        bundle.add("a/b/low.txt", b"low".to_vec()).expect("plain");
        bundle.write_to(root.path()).expect("written");
        assert_eq!(names(root.path()), ["a", "top.txt"]);
        let low = root.path().join("a").join("b");
        assert_eq!(names(&low), ["low.txt"]);
        assert_eq!(fs::read(low.join("low.txt")).expect("there"), b"low");
    }

    #[test]
    fn one_file_is_written_over_the_old_one_or_not_at_all() {
        let root = tempfile::tempdir().expect("a place to write");
        let path = root.path().join("new").join("gear.step");
        write_file(&path, b"first".to_vec()).expect("written");
        write_file(&path, b"second".to_vec()).expect("written over");
        assert_eq!(fs::read(&path).expect("there"), b"second");
        for bad in ["..", "/", "new/gear.step/below", "new/.hidden"] {
            assert!(write_file(&root.path().join(bad), vec![]).is_err(), "{bad}");
        }
        assert_eq!(names(path.parent().expect("a folder")), ["gear.step"]);
    }

    #[test]
    fn many_threads_write_the_same_files_into_one_folder() {
        let root = tempfile::tempdir().expect("a place to write");
        let bundle = |letter: u8| {
            let mut bundle = Bundle::default();
            for name in ["one.txt", "two.txt", "deep/three.txt"] {
                bundle.add(name, vec![letter; 20_000]).expect("plain");
            }
            bundle
        };
        std::thread::scope(|scope| {
            for thread in 0..8 {
                let (root, bundle) = (root.path(), bundle(b'a' + thread));
                scope.spawn(move || {
                    for _ in 0..12 {
                        bundle.write_to(root).expect("written");
                        let read = fs::read(root.join("deep/three.txt")).expect("there");
                        assert_eq!(read, vec![read[0]; 20_000]);
                    }
                });
            }
        });
        assert_eq!(names(root.path()), ["deep", "one.txt", "two.txt"]);
        assert_eq!(names(&root.path().join("deep")), ["three.txt"]);
    }

    #[test]
    fn a_cancelled_write_leaves_what_was_there() {
        let root = tempfile::tempdir().expect("a place to write");
        fs::write(root.path().join("one.txt"), b"old").expect("written");
        let mut bundle = Bundle::default();
        bundle.add("one.txt", b"new".to_vec()).expect("plain");
        let cancel = centrode_geometry::Cancel::default();
        cancel.cancel();
        assert!(cancel.run(|| bundle.write_to(root.path())).is_err());
        assert_eq!(names(root.path()), ["one.txt"]);
        assert_eq!(
            fs::read(root.path().join("one.txt")).expect("there"),
            b"old"
        );
    }

    #[test]
    fn an_archive_holds_every_file() {
        let mut bundle = Bundle::default();
        bundle.add("one.txt", b"first".to_vec()).expect("plain");
        bundle.add("two.bin", vec![7; 100_000]).expect("plain");
        let bytes = bundle.zip().expect("small");
        assert_eq!(bytes, bundle.zip().expect("small"));
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).expect("a zip");
        assert_eq!(archive.len(), 2);
        for (name, content) in bundle.files() {
            let mut file = archive.by_name(name).expect("there");
            let mut read = Vec::new();
            io::Read::read_to_end(&mut file, &mut read).expect("readable");
            assert_eq!(read, content);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_private_file_stays_private() {
        use std::os::unix::fs::PermissionsExt as _;
        let root = tempfile::tempdir().expect("a place to write");
        let path = root.path().join("one.txt");
        fs::write(&path, b"old").expect("written");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("set");
        let mut bundle = Bundle::default();
        bundle.add("one.txt", b"new".to_vec()).expect("plain");
        bundle.write_to(root.path()).expect("written");
        let mode = fs::metadata(&path).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        assert_eq!(fs::read(&path).expect("there"), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_written_through_and_what_is_no_file_is_refused() {
        use std::os::unix::{fs::symlink, net::UnixListener};
        let root = tempfile::tempdir().expect("a place to write");
        let [deep, link, socket] = ["deep", "link", "socket"].map(|name| root.path().join(name));
        fs::create_dir(&deep).expect("made");
        symlink("deep/between", &link).expect("linked");
        symlink("one.txt", deep.join("between")).expect("linked");
        for text in [b"first", b"other"] {
            // First made, then written over.
            write_file(&link, text.to_vec()).expect("written");
            assert_eq!(fs::read(deep.join("one.txt")).expect("there"), text);
            assert!(link.is_symlink() && deep.join("between").is_symlink());
        }
        assert_eq!(names(&deep), ["between", "one.txt"]);
        symlink("loop", root.path().join("loop")).expect("linked");
        assert!(write_file(&root.path().join("loop"), vec![]).is_err());
        let _listener = UnixListener::bind(&socket).expect("bound");
        symlink("socket", root.path().join("to-socket")).expect("linked");
        for name in ["socket", "to-socket"] {
            let error = write_file(&root.path().join(name), vec![]).expect_err("a socket");
            assert!(error.to_string().contains("no regular file"), "{error}");
        }
        assert!(!socket.is_file() && root.path().join("to-socket").is_symlink());
        let all = ["deep", "link", "loop", "socket", "to-socket"];
        assert_eq!(names(root.path()), all);
    }

    #[test]
    fn names_that_lead_elsewhere_or_repeat_are_refused() {
        let mut bundle = Bundle::default();
        for name in [
            "", "..", ".hidden", "a//b", "a\\b", "c:d", "/etc", "a\nb", "../x", "a/../b", "a/",
            "a/.b",
        ] {
            assert!(
                matches!(bundle.add(name, vec![]), Err(BundleError::Name { .. })),
                "{name}"
            );
        }
        bundle.add("a.dxf", vec![]).expect("plain");
        assert!(matches!(
            bundle.add("A.DXF", vec![]),
            Err(BundleError::Twice { .. })
        ));
    }
}
