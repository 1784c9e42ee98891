use std::io;

use crate::geometry::Cancel;

/// Watch for Ctrl-C and for the system's request to terminate; a second one ends the program at once.
pub(crate) struct Interrupt {
    /// Token that Ctrl-C cancels.
    pub(crate) cancel: Cancel,
    /// Runtime of the watch, which ends when it is dropped.
    runtime: Option<tokio::runtime::Runtime>,
}

/// Number of free file descriptors required before a signal is watched. The watch takes half of them; without these its library
/// would end the program. The work needs the others.
const DESCRIPTORS: usize = 16;

/// Whether the system has free descriptors for a watch.
pub(crate) fn has_descriptors() -> bool {
    let pipes = (0..DESCRIPTORS / 2).map(|_| io::pipe());
    pipes.collect::<io::Result<Vec<_>>>().is_ok()
}

/// Whether the system starts another thread.
fn has_threads() -> bool {
    let thread = std::thread::Builder::new().spawn(|| ());
    thread.is_ok_and(|thread| thread.join().is_ok())
}

impl Interrupt {
    /// Starts the watch. If threads or descriptors for it are missing, Ctrl-C ends the program at once, as it does without a
    /// watch.
    pub(crate) fn watch() -> Self {
        let cancel = Cancel::default();
        let can_watch = has_descriptors() && has_threads();
        let runtime = can_watch.then(|| watched(cancel.clone()));
        Self {
            cancel,
            runtime: runtime.and_then(Result::ok),
        }
    }

    pub(crate) fn came(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

fn watched(stated: Cancel) -> io::Result<tokio::runtime::Runtime> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .enable_all()
        .build()?;
    // Ctrl-C is caught from here on, not only when the task runs.
    let watches = {
        let _inside = runtime.enter();
        watches()?
    };
    for mut watch in watches {
        let stated = stated.clone();
        runtime.spawn(async move {
            while watch.recv().await.is_some() {
                if stated.is_cancelled() {
                    std::process::exit(130);
                }
                stated.cancel();
            }
        });
    }
    Ok(runtime)
}

#[cfg(unix)]
fn watches() -> io::Result<[tokio::signal::unix::Signal; 2]> {
    use tokio::signal::unix::{SignalKind, signal};
    Ok([
        signal(SignalKind::interrupt())?,
        signal(SignalKind::terminate())?,
    ])
}

#[cfg(windows)]
fn watches() -> io::Result<[tokio::signal::windows::CtrlC; 1]> {
    Ok([tokio::signal::windows::ctrl_c()?])
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}
