use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

thread_local! {
    static CURRENT: RefCell<Option<Part>> = const { RefCell::new(None) };
}

/// Number of steps in which a share is stored as an integer: finer than any display.
const WHOLE: f64 = 1e6;

/// Share of a check that is done, reported by the check to its listener. A clone belongs to the same check.
///
/// Contact analyses take longest and report every input. Other steps have fixed shares: the time that they take in most
/// designs.
///
/// ```
/// use centrode_analysis::Progress;
///
/// let progress = Progress::default();
/// let answer = progress.during(|| {
///     assert_eq!(progress.share(), 0.0);
///     42
/// });
/// assert_eq!((answer, progress.share()), (42, 1.0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<AtomicU32>);

/// Part of a progress that a computation on a thread fills.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    progress: Progress,
    from: f64,
    to: f64,
}

/// Guard while a thread fills a part. When it is dropped, the thread fills the previous part again.
struct Filling(Option<Part>);

impl Progress {
    /// Result of a check whose share is reported here.
    pub fn during<T>(&self, check: impl FnOnce() -> T) -> T {
        let whole = Part {
            progress: self.clone(),
            from: 0.0,
            to: 1.0,
        };
        let result = whole.clone().fill(check);
        whole.report(1.0);
        result
    }

    /// Share that is done, from 0 to 1; it never falls.
    #[must_use]
    pub fn share(&self) -> f64 {
        f64::from(self.0.load(Ordering::Relaxed)) / WHOLE
    }
}

impl Part {
    /// The part that the calling thread fills; `None` if nothing listens to the progress.
    pub(crate) fn current() -> Option<Self> {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Result of a job that fills this part.
    pub(crate) fn fill<T>(self, job: impl FnOnce() -> T) -> T {
        let _filling = Filling(CURRENT.replace(Some(self)));
        job()
    }

    fn report(&self, share: f64) {
        let whole = self.from + share.clamp(0.0, 1.0) * (self.to - self.from);
        self.progress
            .0
            .fetch_max((WHOLE * whole).round() as u32, Ordering::Relaxed);
    }
}

impl Drop for Filling {
    fn drop(&mut self) {
        CURRENT.set(self.0.take());
    }
}

/// Result of a job that fills the shares `from` to `to` of the part that the calling thread fills.
pub(crate) fn filling<T>([from, to]: [f64; 2], job: impl FnOnce() -> T) -> T {
    let Some(part) = Part::current() else {
        return job();
    };
    let span = part.to - part.from;
    let narrow = Part {
        from: part.from + from * span,
        to: part.from + to * span,
        progress: part.progress.clone(),
    };
    let result = narrow.clone().fill(job);
    narrow.report(1.0);
    result
}

/// Counter of equal steps of a computation on any number of threads.
pub(crate) struct Steps {
    part: Option<Part>,
    count: usize,
    done: AtomicUsize,
}

impl Steps {
    /// A number of steps of the part that the calling thread fills.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            part: Part::current(),
            count: count.max(1),
            done: AtomicUsize::new(0),
        }
    }

    /// Reports that one more step is done.
    pub(crate) fn step(&self) {
        let Some(part) = &self.part else { return };
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        part.report(done as f64 / self.count as f64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_steps_of_threads_add_up_to_the_whole() {
        let progress = Progress::default();
        let mut seen = Vec::new();
        progress.during(|| {
            filling([0.0, 0.5], || {
                let steps = Steps::new(4);
                std::thread::scope(|scope| {
                    scope.spawn(|| steps.step());
                });
                seen.push(progress.share());
                steps.step();
                seen.push(progress.share());
                filling([0.5, 0.6], || ());
                seen.push(progress.share());
            });
            seen.push(progress.share());
            // A late report does not lower the share.
            filling([0.0, 0.1], || Steps::new(1).step());
            seen.push(progress.share());
        });
        seen.push(progress.share());
        assert_eq!(seen, [0.125, 0.25, 0.3, 0.5, 0.5, 1.0]);
        // Without a listener nothing is reported.
        Steps::new(1).step();
        assert_eq!(filling([0.2, 0.3], || 7), 7);
    }
}
