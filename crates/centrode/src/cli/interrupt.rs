use std::io;

use crate::geometry::Cancel;

/// Watch for Ctrl-C; a second one ends the program at once.
pub(crate) struct Interrupt {
    /// Token that Ctrl-C cancels.
    pub(crate) cancel: Cancel,
    /// Runtime of the watch, which ends when it is dropped.
    runtime: Option<tokio::runtime::Runtime>,
}

impl Interrupt {
    /// Starts the watch.
    pub(crate) fn watch() -> io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .enable_all()
            .build()?;
        let cancel = Cancel::default();
        let told = cancel.clone();
        // Heard from here on, not only once the task runs.
        let mut presses = {
            let _inside = runtime.enter();
            presses()?
        };
        runtime.spawn(async move {
            if presses.recv().await.is_none() {
                return;
            }
            told.cancel();
            if presses.recv().await.is_some() {
                std::process::exit(130);
            }
        });
        Ok(Self {
            cancel,
            runtime: Some(runtime),
        })
    }

    pub(crate) fn came(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

#[cfg(unix)]
fn presses() -> io::Result<tokio::signal::unix::Signal> {
    tokio::signal::unix::signal(tokio::signal::unix::SignalKind::interrupt())
}

#[cfg(windows)]
fn presses() -> io::Result<tokio::signal::windows::CtrlC> {
    tokio::signal::windows::ctrl_c()
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}
