use centrode_geometry::{Cancel, shared_out};

use crate::progress::Part;

/// Results of two jobs that run side by side where a core is free, both under the token of the calling thread; what either tells of
/// its progress is told as there.
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

/// Results for each of several things, in their order, on two cores where the caller is no worker of a pool itself: what is
/// made may ask the pool, whose workers must not wait for it.
pub(crate) fn each<T: Sync, R: Send + Sync>(things: &[T], make: impl Fn(&T) -> R + Sync) -> Vec<R> {
    match rayon::current_thread_index() {
        Some(_) => things.iter().map(make).collect(),
        None => shared_out(things, make),
    }
}
