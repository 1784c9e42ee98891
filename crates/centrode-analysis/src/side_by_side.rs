use centrode_geometry::{Cancel, parallel_map, stay_on_one_thread};
use rayon::ThreadPoolBuilder;

use crate::progress::Part;

/// Prepares all computations for a system that cannot start threads: then the calling thread does everything.
///
/// A program calls it once, on its main thread, and must not call it if its other threads wait for computations.
pub fn prepare_threads() {
    // The global thread pool can be built only once: another pool of the same size is tried instead.
    if ThreadPoolBuilder::new().build().is_err() {
        let one = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
        if one.build_global().is_ok() {
            stay_on_one_thread();
        }
    }
}

/// Results of two jobs that run in parallel if a core is free. Both use the cancellation token of the calling thread, and
/// report their progress to the part that this thread fills.
pub(crate) fn both<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    let under = Cancel::current();
    let part = Part::current();
    rayon::join(
        || {
            let _scope = under.enter();
            filled(part.clone(), one)
        },
        || {
            let _scope = under.enter();
            filled(part.clone(), other)
        },
    )
}

fn filled<T>(part: Option<Part>, job: impl FnOnce() -> T) -> T {
    match part {
        Some(part) => part.fill(job),
        None => job(),
    }
}

/// Results for several things, in their order, computed by two threads, or by the caller alone if it is a worker of a thread
/// pool: `make` may use the pool, and its workers must not wait for `make`.
pub(crate) fn each<T: Sync, R: Send + Sync>(things: &[T], make: impl Fn(&T) -> R + Sync) -> Vec<R> {
    match rayon::current_thread_index() {
        Some(_) => things.iter().map(make).collect(),
        None => parallel_map(things, make),
    }
}
