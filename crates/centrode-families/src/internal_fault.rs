use std::panic::{AssertUnwindSafe, catch_unwind};

/// A panic of the library: the program is at fault, not the input.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[error(
    "the program failed: this is a fault of centrode, not of the input. Please report it with the input; standard error has the details"
)]
pub struct InternalFault;

impl InternalFault {
    /// Result of a job; a panic in it becomes this error.
    ///
    /// Data that the job was changing stays in its state at the panic. A job that runs within a
    /// [`Cancel`](centrode_geometry::Cancel) must not call this: cancelling unwinds, too.
    ///
    /// # Errors
    /// [`InternalFault`] if the job panics.
    pub fn catch<T>(job: impl FnOnce() -> T) -> Result<T, Self> {
        catch_unwind(AssertUnwindSafe(job)).map_err(|_| Self)
    }
}
