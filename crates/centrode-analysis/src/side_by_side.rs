use centrode_geometry::{Cancel, shared_out};

/// Results of two jobs that run side by side where a core is free, both under the token of the calling thread.
pub(crate) fn both<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    let under = Cancel::current();
    rayon::join(
        || {
            let _scope = under.enter();
            one()
        },
        || {
            let _scope = under.enter();
            other()
        },
    )
}

/// Results for each of several things, in their order, on two cores where the caller is no worker of a pool itself: what is
/// made may ask the pool, whose workers must not wait for it.
pub(crate) fn each<T: Sync, R: Send + Sync>(things: &[T], make: impl Fn(&T) -> R + Sync) -> Vec<R> {
    match rayon::current_thread_index() {
        Some(_) => things.iter().map(make).collect(),
        None => shared_out(things, make),
    }
}
