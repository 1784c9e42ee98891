use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Time before a bar is shown: shorter work shows none.
const PATIENCE: Duration = Duration::from_secs(1);

/// Progress bar on the terminal's standard error, shown only during long work.
pub(crate) struct Progress {
    bar: ProgressBar,
    done: Option<Sender<()>>,
    watch: Option<JoinHandle<()>>,
}

impl Progress {
    /// A bar for `steps` steps.
    pub(crate) fn new(steps: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden());
        // Without a terminal no bar is written to standard error.
        if !std::io::IsTerminal::is_terminal(&std::io::stderr()) {
            return Self {
                bar,
                done: None,
                watch: None,
            };
        }
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {pos}/{len} {msg} {elapsed}") {
            bar.set_style(style);
        }
        let (done, finished) = channel();
        let shown = bar.clone();
        // If its thread cannot start, there is no bar.
        let watch = std::thread::Builder::new().spawn(move || show_late(&shown, &finished));
        Self {
            bar,
            done: Some(done),
            watch: watch.ok(),
        }
    }

    /// Begins the next step.
    pub(crate) fn step(&self, what: &'static str) {
        if !self.bar.message().is_empty() {
            self.bar.inc(1);
        }
        self.bar.set_message(what);
    }

    /// Shows the progress of a step.
    pub(crate) fn report(&self, words: String) {
        self.bar.set_message(words);
    }
}

fn show_late(bar: &ProgressBar, finished: &Receiver<()>) {
    if finished.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(Duration::from_millis(100));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.done.take());
        if let Some(watch) = self.watch.take() {
            // The thread ends now, because its sender has just been dropped.
            let _ = watch.join();
        }
        self.bar.finish_and_clear();
    }
}
