use std::panic::resume_unwind;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::{PyResult, Python};

/// How often a waiting call looks whether the user has had enough.
const PATIENCE: Duration = Duration::from_millis(50);

/// As much stack as a main thread has.
const STACK: usize = 8 << 20;

/// Does a job that may take long: other Python threads run meanwhile, and Ctrl-C ends the wait.
///
/// Nothing asks the job itself to stop: after Ctrl-C it runs out unheard, so it must change nothing
/// but its answer.
pub(crate) fn wait<T: Send + 'static>(
    py: Python<'_>,
    job: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (answer, mut mailbox) = channel();
    let worker = Builder::new().stack_size(STACK).spawn(move || {
        // Whoever asked may have gone.
        let _ = answer.send(job());
    })?;
    loop {
        let (back, mail) = py.detach(move || {
            let mail = mailbox.recv_timeout(PATIENCE);
            (mailbox, mail)
        });
        mailbox = back;
        match mail {
            Ok(answer) => return Ok(answer),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    match worker.join() {
        Err(panic) => resume_unwind(panic),
        Ok(()) => Err(PyRuntimeError::new_err("the worker gave no answer")),
    }
}
