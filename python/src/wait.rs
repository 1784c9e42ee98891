use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::Builder;
use std::time::Duration;

use centrode_geometry::Cancel;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::{PyErr, PyResult, Python};

/// Interval at which a waiting call checks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(25);

/// Stack size, that of a main thread.
const STACK: usize = 8 << 20;

/// Does a job that may take long: other Python threads run meanwhile, and Ctrl-C cancels it.
///
/// After Ctrl-C the call ends when the job has: at its next checkpoint. A second Ctrl-C does not wait for that.
pub(crate) fn wait<T: Send + 'static>(
    py: Python<'_>,
    job: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    attend(py, |_: &Sender<()>| job(), |()| Ok(()))
}

/// Does a job that reports its progress, like [`wait`]; an error of `heed` cancels it, too.
pub(crate) fn attend<T: Send + 'static, N: Send + 'static>(
    py: Python<'_>,
    job: impl FnOnce(&Sender<N>) -> T + Send + 'static,
    mut heed: impl FnMut(N) -> PyResult<()>,
) -> PyResult<T> {
    let cancel = Cancel::default();
    let (told, mut news) = channel();
    let under = cancel.clone();
    let worker = Builder::new()
        .stack_size(STACK)
        .spawn(move || under.run(|| job(&told)))?;
    let ended = loop {
        let heard;
        (news, heard) = next(py, news);
        let fine = match heard {
            Ok(told) => heed(told),
            Err(RecvTimeoutError::Timeout) => Ok(()),
            Err(RecvTimeoutError::Disconnected) => break Ok(()),
        };
        if let Err(error) = fine.and_then(|()| py.check_signals()) {
            cancel.cancel();
            break Err(error);
        }
    };
    ended.or_else(|error| ended_after(py, news, error))?;
    match worker.join() {
        Ok(Ok(answer)) => Ok(answer),
        Ok(Err(cancelled)) => Err(PyRuntimeError::new_err(cancelled.to_string())),
        Err(panic) => resume_unwind(panic),
    }
}

/// Waits for news with other Python threads running.
fn next<N: Send>(py: Python<'_>, news: Receiver<N>) -> (Receiver<N>, Result<N, RecvTimeoutError>) {
    py.detach(move || {
        let heard = news.recv_timeout(PATIENCE);
        (news, heard)
    })
}

/// The error that ended a job, once the job has ended; or the next error, if that comes first.
fn ended_after<N: Send>(py: Python<'_>, mut news: Receiver<N>, error: PyErr) -> PyResult<()> {
    loop {
        let heard;
        (news, heard) = next(py, news);
        if heard.is_err_and(|e| e == RecvTimeoutError::Disconnected) {
            return Err(error);
        }
        py.check_signals()?;
    }
}
