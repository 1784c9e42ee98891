use std::io::Write;
use std::path::{Path, PathBuf};

use crate::formats::{Bundle, BundleError};

use crate::cli::failure::Failure;
use crate::cli::interrupt::{Interrupt, has_descriptors};

/// Writes files by calling `writer`, each whole or not at all; after Ctrl-C before the last file is written there is no new file.
pub(crate) fn write(
    writer: impl FnOnce() -> Result<Vec<PathBuf>, BundleError>,
) -> Result<Vec<PathBuf>, Failure> {
    let interrupt = Interrupt::watch();
    let written = interrupt.cancel.run(writer);
    Ok(written.map_err(|_| Failure::Interrupted)??)
}

/// Writes one file, whole or not at all, and prints its path.
pub(crate) fn write_one(path: &Path, bytes: Vec<u8>, out: &mut impl Write) -> Result<(), Failure> {
    for path in put(path, bytes)? {
        writeln!(out, "{}", path.display())?;
    }
    Ok(())
}

/// Writes one file, whole or not at all, and returns its path.
pub(crate) fn put(path: &Path, bytes: Vec<u8>) -> Result<Vec<PathBuf>, Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let name = path.file_name().and_then(|name| name.to_str());
    let mut bundle = Bundle::default();
    bundle.add(name.unwrap_or_default(), bytes)?;
    write(|| bundle.write_to(folder))
}

/// Makes a write beyond the system's limit of file size fail with an error: if its signal were not caught, it would end the
/// program.
#[cfg(unix)]
pub(crate) fn heed_file_limit() -> std::io::Result<()> {
    use tokio::signal::unix::{SignalKind, signal};

    /// Number of the signal on Linux, macOS and the BSDs.
    const SIGXFSZ: i32 = 25;
    if !has_descriptors() {
        return Err(std::io::ErrorKind::QuotaExceeded.into());
    }
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .build()?;
    let _inside = runtime.enter();
    signal(SignalKind::from_raw(SIGXFSZ)).map(drop)
}
