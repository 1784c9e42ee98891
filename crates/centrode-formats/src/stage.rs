use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// Beginning and end of a stage's name, with its own number between them.
const NAME: [&str; 2] = [".centrode-", ".part"];

/// File of a stage that is locked as long as its writer lives.
const LOCK: &str = "lock";

/// Hidden folder in which files are written completely before they are renamed into the folder around it.
///
/// Each has its own name and a lock, which the system releases when the writer ends for any reason. So a stage that others can
/// lock is dead, and the next stage in the same folder removes it.
#[derive(Debug)]
pub(crate) struct Stage {
    path: PathBuf,
    /// Locked until the stage is gone.
    _lock: File,
}

impl Stage {
    /// Removes the dead stages of a folder and opens a new one.
    pub(crate) fn open(folder: &Path) -> io::Result<Self> {
        clear(folder);
        loop {
            let number = RandomState::new().build_hasher().finish();
            let path = folder.join(format!("{}{number:016x}{}", NAME[0], NAME[1]));
            match fs::create_dir(&path) {
                Err(taken) if taken.kind() == io::ErrorKind::AlreadyExists => continue,
                made => made?,
            }
            // Until the stage is locked it looks dead: if another writer removes it, the next name is tried.
            let lock = match lock_of(&path) {
                Err(cleared) if cleared.kind() == io::ErrorKind::NotFound => continue,
                lock => lock?,
            };
            // On a system without locks no stage counts as dead.
            if !matches!(lock.try_lock(), Err(TryLockError::WouldBlock)) && path.join(LOCK).exists()
            {
                return Ok(Self { path, _lock: lock });
            }
        }
    }

    /// Path of a file of that name while it is written.
    pub(crate) fn place(&self, name: &str) -> PathBuf {
        // Without the suffix a file could have the name of the lock.
        self.path.join(format!("{name}.part"))
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        // Files that cannot be removed now are cleared by the next stage.
        let _ = fs::remove_dir_all(&self.path);
    }
}

/// Path to which a file is written: `target` itself, or the end of its links.
pub(crate) fn destination(target: &Path) -> io::Result<PathBuf> {
    /// Maximum number of links in a chain, as on Linux.
    const LINKS: u32 = 40;
    match fs::metadata(target) {
        Ok(there) if there.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(there) if !there.is_file() => Err(io::Error::other("it is not a regular file")),
        Ok(there) if there.permissions().readonly() => Err(io::Error::new(
            io::ErrorKind::PermissionDenied,
            "it is read-only",
        )),
        Ok(_) if target.is_symlink() => target.canonicalize(),
        // Links to a file that does not exist yet.
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

/// Writes and flushes a new file that is to replace another, with its permissions.
pub(crate) fn put(bytes: &[u8], place: &Path, target: &Path) -> io::Result<()> {
    let mut file = File::create_new(place)?;
    if let Ok(before) = fs::metadata(target) {
        fs::set_permissions(place, before.permissions())?;
    }
    file.write_all(bytes)?;
    file.sync_all()
}

/// Lock file of a stage; created if it is missing, but never through a symbolic link.
fn lock_of(stage: &Path) -> io::Result<File> {
    let path = stage.join(LOCK);
    match File::create_new(&path) {
        Err(taken)
            if taken.kind() == io::ErrorKind::AlreadyExists
                && fs::symlink_metadata(&path)?.is_file() =>
        {
            File::options().write(true).open(path)
        }
        made => made,
    }
}

/// Removes the stages in a folder whose writers ended without removing them.
fn clear(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let number = name
            .to_str()
            .and_then(|name| name.strip_prefix(NAME[0])?.strip_suffix(NAME[1]));
        let ours = number.is_some_and(|n| n.len() == 16 && u64::from_str_radix(n, 16).is_ok());
        if ours
            && entry.file_type().is_ok_and(|kind| kind.is_dir())
            && let Ok(lock) = lock_of(&entry.path())
            && lock.try_lock().is_ok()
        {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let entries = fs::read_dir(directory).expect("readable").flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Folders that look like stages and lead elsewhere: nothing is made or removed there.
    #[cfg(unix)]
    #[test]
    fn a_lock_is_never_made_through_a_symbolic_link() {
        use std::os::unix::fs::symlink;

        let [root, other] = [(); 2].map(|()| tempfile::tempdir().expect("a place to write"));
        let stage = |number: u32| root.path().join(format!(".centrode-{number:016x}.part"));
        let elsewhere = |name: &str| other.path().join(name);
        fs::write(elsewhere("full"), b"kept").expect("written");
        fs::create_dir(elsewhere("folder")).expect("a folder");
        for (number, target) in ["missing", "full", "folder", "no/such/folder"]
            .into_iter()
            .enumerate()
        {
            let stage = stage(number as u32);
            fs::create_dir(&stage).expect("a folder");
            symlink(elsewhere(target), stage.join(LOCK)).expect("linked");
        }
        fs::create_dir(stage(4)).expect("a folder");
        symlink("lock", stage(4).join(LOCK)).expect("a link to itself");
        fs::create_dir(stage(5)).expect("a folder");
        symlink(stage(5).join("chain"), stage(5).join(LOCK)).expect("linked");
        symlink(elsewhere("end"), stage(5).join("chain")).expect("linked");
        for (number, target) in ["folder", "gone", "full"].into_iter().enumerate() {
            symlink(elsewhere(target), stage(6 + number as u32)).expect("linked");
        }
        fs::create_dir_all(stage(9).join(LOCK)).expect("a folder instead of a lock");
        let before = names(root.path());
        drop(Stage::open(root.path()).expect("a stage"));
        assert_eq!(names(root.path()), before, "none is a stage");
        assert_eq!(names(other.path()), ["folder", "full"]);
        assert_eq!(names(&elsewhere("folder")), [""; 0]);
        assert_eq!(fs::read(elsewhere("full")).expect("there"), b"kept");
    }

    #[test]
    fn what_a_dead_writer_left_is_cleared_and_nothing_else() {
        let root = tempfile::tempdir().expect("a place to write");
        let dead = std::mem::ManuallyDrop::new(Stage::open(root.path()).expect("a stage"));
        let alive = Stage::open(root.path()).expect("a stage");
        for stage in [&*dead, &alive] {
            fs::write(stage.place("one.txt"), b"half").expect("written");
        }
        let others = [
            ".centrode-0123456789abcdef",
            ".centrode-notes.part",
            ".one.txt.1.part",
        ];
        for other in others {
            fs::create_dir(root.path().join(other)).expect("a folder");
        }
        drop(Stage::open(root.path()).expect("a stage"));
        assert_eq!(names(root.path()).len(), 5, "both are alive");
        // The lock is lifted, as by the system for a killed program.
        dead._lock.unlock().expect("unlocked");
        drop(Stage::open(root.path()).expect("a stage"));
        assert!(alive.place("one.txt").exists() && !dead.path.exists());
        // One that was killed before it had a lock.
        fs::create_dir(root.path().join(".centrode-0123456789abcdef.part")).expect("a folder");
        drop((Stage::open(root.path()).expect("a stage"), alive));
        assert_eq!(names(root.path()), others);
    }
}
