use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::ScopedJoinHandle;

thread_local! {
    static CURRENT: RefCell<Option<Cancel>> = const { RefCell::new(None) };
}

/// Whether no thread is started any more.
static ALONE: AtomicBool = AtomicBool::new(false);

/// From now on every job of [`together`] and [`shared_out`] runs on the thread that calls them.
///
/// For a program that cannot start threads: work that is handed to another thread could wait for one that never comes.
pub fn stay_on_one_thread() {
    ALONE.store(true, Ordering::Relaxed);
}

/// Token that stops a long computation from another thread, by cooperative unwinding.
///
/// A computation under [`Cancel::run`] passes a [`checkpoint`] every few microseconds. Once the token is cancelled, the
/// next checkpoint unwinds the stack to `run`: destructors run, no panic is reported, and every function on the way
/// needs neither an argument nor an error for it. Tokens are shared by cloning; nothing else is shared.
///
/// A program built with `panic = "abort"` cannot unwind: there every computation runs to its end.
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

/// Payload of the unwinding, with the token it is for.
struct Unwinding(Cancel);

/// Guard that holds a thread under a token; when it is dropped the token before it holds again.
#[derive(Debug)]
pub struct Scope {
    before: Option<Cancel>,
}

impl Cancel {
    /// Stops whatever runs under this token, now and from now on.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`Cancel::cancel`] has been called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Result of a job that stops at its next [`checkpoint`] once the token is cancelled.
    ///
    /// What the job was changing through references or locks stays as it was at that checkpoint. Where runs are nested
    /// the innermost token alone is heeded. Panics pass through.
    ///
    /// # Errors
    /// [`Cancelled`] where the job was stopped.
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

    /// Token the calling thread is under, to be carried to threads that work for it; a new one where there is none.
    #[must_use]
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone).unwrap_or_default()
    }

    /// Puts the calling thread, a worker of a computation under [`Cancel::run`], under its token too.
    ///
    /// Whoever waits for the worker must pass its unwinding on, as rayon does; with its `panic_fuse` no further item begins.
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

/// Point at which a computation can be stopped by the token it runs under; costs about a nanosecond.
///
/// Belongs in every loop that may take long, and not in code that must not be left half done.
#[inline]
pub fn checkpoint() {
    let cancelled = |current: &Option<Cancel>| current.as_ref().is_some_and(Cancel::is_cancelled);
    // While a thread ends its token has gone: nothing computes there.
    if cfg!(panic = "unwind") && CURRENT.try_with(|c| cancelled(&c.borrow())) == Ok(true) {
        stop();
    }
}

/// Results of two jobs that run side by side, each on a thread of its own, both under the token of the calling thread.
///
/// A job whose thread cannot be started runs on the calling thread.
///
/// ```
/// assert_eq!(centrode_geometry::together(|| 6, || 7), (6, 7));
/// ```
pub fn together<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    let cancel = Cancel::current();
    let (one, other) = (Mutex::new(Some(one)), Mutex::new(Some(other)));
    std::thread::scope(|scope| {
        // The caller waits: a single new thread beside one that works is often left on the same core, for some milliseconds.
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

/// A job, until a thread takes it.
type Waiting<F> = Mutex<Option<F>>;

/// Thread of a job under a token; `None` if it cannot be started, and the job still waits.
fn started<'scope, T: Send + 'scope, F: FnOnce() -> T + Send + 'scope>(
    scope: &'scope std::thread::Scope<'scope, '_>,
    cancel: &'scope Cancel,
    job: &'scope Waiting<F>,
) -> Option<ScopedJoinHandle<'scope, Option<T>>> {
    if ALONE.load(Ordering::Relaxed) {
        return None;
    }
    let run = move || {
        let _scope = cancel.enter();
        taken(job).map(|job| job())
    };
    std::thread::Builder::new().spawn_scoped(scope, run).ok()
}

/// Result of a job: that of its thread or, if it still waits, that of the calling thread.
fn finished<T, F: FnOnce() -> T>(
    thread: Option<ScopedJoinHandle<'_, Option<T>>>,
    job: &Waiting<F>,
) -> std::thread::Result<T> {
    let ended = thread.and_then(|thread| thread.join().transpose());
    match (ended, taken(job)) {
        (Some(result), _) => result,
        (None, Some(job)) => Ok(job()),
        (None, None) => Err(Box::new("a job is gone")),
    }
}

fn taken<F>(job: &Waiting<F>) -> Option<F> {
    job.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// Results for each of several things, in their order, worked out by two threads: each takes the next that is left.
///
/// A [`Cancel`] stops both, and a panic in either comes out of this call.
///
/// ```
/// assert_eq!(centrode_geometry::shared_out(&[1, 2, 3], |x| x * x), [1, 4, 9]);
/// ```
pub fn shared_out<T: Sync, R: Send + Sync>(things: &[T], make: impl Fn(&T) -> R + Sync) -> Vec<R> {
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
    together(work, work);
    made.into_iter().filter_map(OnceLock::into_inner).collect()
}

/// The next thing that nobody has taken, and its place.
fn next<'a, T, P>(taken: &AtomicUsize, things: &'a [T], places: &'a [P]) -> Option<(&'a T, &'a P)> {
    let next = taken.fetch_add(1, Ordering::Relaxed);
    things.get(next).zip(places.get(next))
}

#[cold]
fn stop() {
    // A destructor that runs while the stack unwinds must end normally.
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
    fn a_job_stops_soon_after_its_token_is_cancelled_and_unwinds_what_it_held() {
        struct Held<'a>(&'a AtomicBool);
        impl Drop for Held<'_> {
            fn drop(&mut self) {
                // Not even here is the unwinding disturbed.
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
        // What unwinds for another token, or from a panic, is not this one's to catch.
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
