//! Record of the files that exports wrote into a folder, so that no other file is replaced.

use std::fs;
use std::path::Path;

use super::{Bundle, BundleError, failed};
use crate::hash::hex;

/// Hidden file with one line per written file: the SHA-256 of its contents, two spaces and its name.
pub(super) const MANIFEST: &str = ".centrode-files";

/// Number of names that a message lists.
const LISTED: usize = 5;

impl Bundle {
    /// Names a note on the files of this bundle. If the bundle does not contain it, an export removes that of an earlier export.
    pub fn has_note(&mut self, name: &'static str) {
        self.notes.push(name);
    }

    /// Removes notes of earlier exports that do not belong to the files of this bundle.
    pub(super) fn remove_old_notes(&self, folder: &Path) -> Result<(), BundleError> {
        let written = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
        for name in &self.notes {
            let path = folder.join(name);
            let line = fs::read(&path).map(|bytes| format!("{}  {name}", hex(&bytes)));
            let is_ours = line.is_ok_and(|line| written.lines().any(|known| known == line));
            if is_ours && !self.files.iter().any(|(own, _)| own == name) {
                fs::remove_file(&path).map_err(failed("remove", &path))?;
            }
        }
        Ok(())
    }

    /// The manifest of a folder after this bundle is written there.
    ///
    /// It also lists the present versions of files that the old manifest lists: if the program is killed while it renames files,
    /// old and new versions are both listed.
    ///
    /// # Errors
    /// [`BundleError::Foreign`] if a file would be replaced that no export wrote, or that was changed since.
    pub(super) fn manifest(&self, folder: &Path, force: bool) -> Result<Vec<u8>, BundleError> {
        let written = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
        let is_ours = |name: &str| self.files.iter().any(|(own, _)| own == name);
        let name = |line: &str| Some(line.split_once("  ")?.1.to_owned());
        let others = written
            .lines()
            .filter(|line| name(line).is_some_and(|name| !is_ours(&name)));
        let mut lines: Vec<String> = others.map(str::to_owned).collect();
        let mut foreign = Vec::new();
        for (name, bytes) in &self.files {
            let line = |bytes: &[u8]| format!("{}  {name}", hex(bytes));
            let new = line(bytes);
            let old = fs::read(folder.join(name)).ok().map(|bytes| line(&bytes));
            if let Some(old) = old.filter(|old| *old != new) {
                match written.lines().any(|line| line == old) {
                    true => lines.push(old),
                    false if force => {}
                    false => foreign.push(name.as_str()),
                }
            }
            lines.push(new);
        }
        if foreign.is_empty() {
            return Ok((lines.join("\n") + "\n").into_bytes());
        }
        let mut files = foreign[..foreign.len().min(LISTED)].join(", ");
        if foreign.len() > LISTED {
            files += &format!(" and {} more", foreign.len() - LISTED);
        }
        Err(BundleError::Foreign {
            files,
            folder: folder.to_owned(),
        })
    }
}
