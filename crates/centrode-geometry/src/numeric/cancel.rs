use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::ScopedJoinHandle;

thread_local! {
    static CURRENT: RefCell<Option<Cancel>> = const { RefCell::new(None) };
}

/// Whether no more threads may start.
static SINGLE_THREAD: AtomicBool = AtomicBool::new(false);

/// Makes every later job of [`run_both`] and [`parallel_map`] run on the calling thread.
///
/// A program that cannot start threads must call it: otherwise a job could wait for a thread that never starts.
pub fn stay_on_one_thread() {
    SINGLE_THREAD.store(true, Ordering::Relaxed);
}

/// Token that stops a long computation from another thread, by cooperative unwinding.
///
/// A computation under [`Cancel::run`] passes a [`checkpoint`] every few microseconds. Once the token is cancelled, the
/// next checkpoint unwinds the stack to `run`: destructors run and no panic is reported. The functions between need
/// neither an argument nor an error for it. Clones share the token and nothing else.
///
/// A program built with `panic = "abort"` cannot unwind: every computation runs to its end.
///
/// ```
/// use centrode_geometry::{Cancel, Cancelled, checkpoint};
///
/// let cancel = Cancel::default();
/// assert_eq!(cancel.run(|| 6 * 7), Ok(42));
/// let endless = || loop {
///     checkpoint();
///     cancel.cancel();
/// };
/// assert_eq!(cancel.run(endless), Err::<(), _>(Cancelled));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

/// The computation was cancelled before its end.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[error("cancelled before the end")]
pub struct Cancelled;

/// Payload of the unwinding, with its token.
struct Unwinding(Cancel);

/// Guard that puts a thread under a token. Dropping it restores the previous token.
#[derive(Debug)]
pub struct Scope {
    before: Option<Cancel>,
}

impl Cancel {
    /// Stops every computation under this token, running or later.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`Cancel::cancel`] has been called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Runs a job that stops at its next [`checkpoint`] once the token is cancelled.
    ///
    /// Data that the job changes through references or locks stays as it was at that checkpoint. In nested runs only the
    /// innermost token counts. Panics pass through.
    ///
    /// # Errors
    /// [`Cancelled`] if the job was stopped.
    pub fn run<T>(&self, job: impl FnOnce() -> T) -> Result<T, Cancelled> {
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            let _scope = self.enter();
            job()
        }));
        outcome.map_err(|payload| match payload.downcast::<Unwinding>() {
            Ok(unwinding) if Arc::ptr_eq(&unwinding.0.0, &self.0) => Cancelled,
            Ok(of_another) => resume_unwind(of_another),
            Err(panic) => resume_unwind(panic),
        })
    }

    /// Token of the calling thread, to pass to threads that work for it; a new one if the thread has none.
    #[must_use]
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone).unwrap_or_default()
    }

    /// Puts the calling thread, a worker of a computation under [`Cancel::run`], under the same token.
    ///
    /// The thread that waits for the worker must pass its unwinding on, as rayon does. With rayon's `panic_fuse` no further
    /// item begins.
    #[must_use]
    pub fn enter(&self) -> Scope {
        let before = CURRENT.replace(Some(self.clone()));
        let scope = Scope { before };
        checkpoint();
        scope
    }
}

impl Drop for Scope {
    fn drop(&mut self) {
        CURRENT.set(self.before.take());
    }
}

/// Point at which the token of a computation can stop it; costs about a nanosecond.
///
/// Call it in every loop that may take long, but not in code that must finish once it has begun.
#[inline]
pub fn checkpoint() {
    let cancelled = |current: &Option<Cancel>| current.as_ref().is_some_and(Cancel::is_cancelled);
    // The token of a thread that ends is already dropped; nothing computes there.
    if cfg!(panic = "unwind") && CURRENT.try_with(|c| cancelled(&c.borrow())) == Ok(true) {
        stop();
    }
}

/// Results of two jobs that run in parallel, each on its own thread, both under the token of the calling thread.
///
/// A job whose thread cannot be started runs on the calling thread.
///
/// ```
/// assert_eq!(centrode_geometry::run_both(|| 6, || 7), (6, 7));
/// ```
pub fn run_both<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    let cancel = Cancel::current();
    let (one, other) = (Mutex::new(Some(one)), Mutex::new(Some(other)));
    std::thread::scope(|scope| {
        // Both jobs get a new thread and the caller waits: one new thread next to a busy caller often shares its core for some
        // milliseconds.
        let started = (
            started(scope, &cancel, &one),
            started(scope, &cancel, &other),
        );
        match (finished(started.0, &one), finished(started.1, &other)) {
            (Ok(one), Ok(other)) => (one, other),
            (Err(unwound), _) | (_, Err(unwound)) => resume_unwind(unwound),
        }
    })
}

/// A job that no thread has taken yet.
type Waiting<F> = Mutex<Option<F>>;

/// Starts a thread for a job under a token; `None` if it cannot start: then the job still waits.
fn started<'scope, T: Send + 'scope, F: FnOnce() -> T + Send + 'scope>(
    scope: &'scope std::thread::Scope<'scope, '_>,
    cancel: &'scope Cancel,
    job: &'scope Waiting<F>,
) -> Option<ScopedJoinHandle<'scope, Option<T>>> {
    if SINGLE_THREAD.load(Ordering::Relaxed) {
        return None;
    }
    let run = move || {
        let _scope = cancel.enter();
        taken(job).map(|job| job())
    };
    std::thread::Builder::new().spawn_scoped(scope, run).ok()
}

/// Result of a job: from its thread or, if the job still waits, computed on the calling thread.
fn finished<T, F: FnOnce() -> T>(
    thread: Option<ScopedJoinHandle<'_, Option<T>>>,
    job: &Waiting<F>,
) -> std::thread::Result<T> {
    let ended = thread.and_then(|thread| thread.join().transpose());
    match (ended, taken(job)) {
        (Some(result), _) => result,
        (None, Some(job)) => Ok(job()),
        (None, None) => Err(Box::new("the result of a job is lost")),
    }
}

fn taken<F>(job: &Waiting<F>) -> Option<F> {
    job.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// Results for several things, in their order, computed by two threads: each takes the next free thing.
///
/// A [`Cancel`] stops both threads. A panic in either comes out of this call.
///
/// ```
/// assert_eq!(centrode_geometry::parallel_map(&[1, 2, 3], |x| x * x), [1, 4, 9]);
/// ```
pub fn parallel_map<T: Sync, R: Send + Sync>(
    things: &[T],
    make: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    if things.len() < 2 {
        return things.iter().map(make).collect();
    }
    let made: Vec<OnceLock<R>> = things.iter().map(|_| OnceLock::new()).collect();
    let taken = AtomicUsize::new(0);
    let work = || {
        while let Some((thing, made)) = next(&taken, things, &made) {
            made.get_or_init(|| make(thing));
        }
    };
    run_both(work, work);
    made.into_iter().filter_map(OnceLock::into_inner).collect()
}

/// The next thing that no thread has taken, and the slot of its result.
fn next<'a, T, P>(taken: &AtomicUsize, things: &'a [T], slots: &'a [P]) -> Option<(&'a T, &'a P)> {
    let next = taken.fetch_add(1, Ordering::Relaxed);
    things.get(next).zip(slots.get(next))
}

#[cold]
fn stop() {
    // Destructors that run while the stack unwinds must end normally.
    if !std::thread::panicking() {
        resume_unwind(Box::new(Unwinding(Cancel::current())));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    fn endless() {
        loop {
            checkpoint();
            std::thread::sleep(Duration::from_micros(50));
        }
    }

    #[test]
    fn a_job_without_a_thread_runs_once_on_the_calling_thread() {
        let own = std::thread::current().id();
        for number in 0..10 {
            let runs = AtomicUsize::new(0);
            let job = Mutex::new(Some(|| {
                runs.fetch_add(1, Ordering::Relaxed);
                (number, std::thread::current().id())
            }));
            let found = finished(None, &job).expect("it runs");
            assert_eq!(found, (number, own));
            assert_eq!(runs.load(Ordering::Relaxed), 1);
            assert!(finished(None, &job).is_err(), "it is gone");
        }
        let job = Mutex::new(Some(|| std::thread::current().id()));
        let cancel = Cancel::default();
        let elsewhere = std::thread::scope(|scope| {
            let thread = started(scope, &cancel, &job);
            assert!(thread.is_some());
            finished(thread, &job).expect("it runs")
        });
        assert_ne!(elsewhere, own);
        let job = Mutex::new(Some(endless));
        cancel.cancel();
        assert_eq!(cancel.run(|| finished(None, &job).is_ok()), Err(Cancelled));
    }

    #[test]
    fn a_job_stops_soon_after_its_token_is_cancelled_and_unwinds_its_values() {
        struct Held<'a>(&'a AtomicBool);
        impl Drop for Held<'_> {
            fn drop(&mut self) {
                // A checkpoint in a destructor does not disturb the unwinding.
                checkpoint();
                self.0.store(true, Ordering::Relaxed);
            }
        }
        let (cancel, dropped) = (Cancel::default(), AtomicBool::new(false));
        let (begun, started) = channel();
        std::thread::scope(|scope| {
            let job = scope.spawn(|| {
                cancel.run(|| {
                    let _held = Held(&dropped);
                    begun.send(()).expect("heard");
                    endless();
                })
            });
            started.recv().expect("begun");
            cancel.cancel();
            assert_eq!(job.join().expect("no panic"), Err(Cancelled));
        });
        assert!(dropped.load(Ordering::Relaxed));
        assert_eq!(cancel.run(|| 1), Err(Cancelled));
        // The thread itself is free again.
        checkpoint();
    }

    #[test]
    fn only_its_own_token_stops_a_job() {
        let (outer, inner) = (Cancel::default(), Cancel::default());
        inner.cancel();
        let nested = outer.run(|| (inner.run(endless), outer.run(checkpoint)));
        assert_eq!(nested, Ok((Err(Cancelled), Ok(()))));
        let other = Cancel::default();
        // A token does not catch the unwinding of another token or of a panic.
        let passed = outer.run(|| {
            let worker = outer.clone();
            worker.cancel();
            other.run(|| worker.enter()).map(drop)
        });
        assert_eq!(passed, Err(Cancelled));
        let panic = catch_unwind(|| Cancel::default().run(|| resume_unwind(Box::new("fault"))));
        let payload = panic.expect_err("a panic").downcast::<&str>();
        assert_eq!(*payload.expect("its own payload"), "fault");
    }

    #[test]
    fn a_lock_held_by_a_cancelled_job_can_be_taken_again() {
        let lock = std::sync::Mutex::new(1);
        let cancel = Cancel::default();
        let stopped = cancel.run(|| {
            let mut held = lock.lock().expect("free");
            *held = 2;
            cancel.cancel();
            checkpoint();
        });
        assert_eq!(stopped, Err(Cancelled));
        let value = lock.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        assert_eq!(*value, 2);
    }
}
