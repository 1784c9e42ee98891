use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, Builder, scope};
use std::time::Duration;

use centrode::InternalFault;
use centrode_geometry::{Cancel, Cancelled};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::{PyErr, PyResult, Python, pyfunction};

use crate::error::class;

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
    heed: impl FnMut(N) -> PyResult<()>,
) -> PyResult<T> {
    let cancel = Cancel::default();
    let (stated, news) = channel();
    let under = cancel.clone();
    let worker = Builder::new()
        .stack_size(STACK)
        .spawn(move || under.run(|| job(&stated)))?;
    hear(py, news, &cancel, heed)?;
    outcome(worker.join())
}

/// Does a job on what the caller holds, like [`wait`], which ends with the job in any case.
pub(crate) fn wait_here<T: Send>(py: Python<'_>, job: impl FnOnce() -> T + Send) -> PyResult<T> {
    let cancel = Cancel::default();
    let (end, news) = channel::<()>();
    let under = cancel.clone();
    scope(|scope| {
        let job = move || {
            let _end = end;
            under.run(job)
        };
        let worker = Builder::new().stack_size(STACK).spawn_scoped(scope, job)?;
        hear(py, news, &cancel, |()| Ok(()))?;
        // Its last news is that it has ended: it holds nobody up.
        outcome(worker.join())
    })
}

/// Does a job that takes no time on the calling thread.
pub(crate) fn at_once<T>(job: impl FnOnce() -> T) -> PyResult<T> {
    InternalFault::catch(job).map_err(|fault| raised(&fault))
}

/// Panics in a job that is done by `wait`, `wait_here` or `at_once`. For tests only.
#[pyfunction]
pub(crate) fn _panic(py: Python<'_>, by: &str) -> PyResult<()> {
    let panics = || panic!("a test");
    match by {
        "wait" => wait(py, panics),
        "wait_here" => wait_here(py, panics),
        _ => at_once(panics),
    }
}

/// Heeds the news of a job till it has ended.
fn hear<N: Send>(
    py: Python<'_>,
    mut news: Receiver<N>,
    cancel: &Cancel,
    mut heed: impl FnMut(N) -> PyResult<()>,
) -> PyResult<()> {
    loop {
        let heard;
        (news, heard) = next(py, news);
        let fine = match heard {
            Ok(stated) => heed(stated),
            Err(RecvTimeoutError::Timeout) => Ok(()),
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        if let Err(error) = fine.and_then(|()| py.check_signals()) {
            cancel.cancel();
            return ended_after(py, news, error);
        }
    }
}

/// The answer of a job that has ended.
fn outcome<T>(joined: thread::Result<Result<T, Cancelled>>) -> PyResult<T> {
    match joined {
        Ok(Ok(answer)) => Ok(answer),
        Ok(Err(cancelled)) => Err(PyRuntimeError::new_err(cancelled.to_string())),
        Err(_) => Err(raised(&InternalFault)),
    }
}

/// The exception of a panic.
fn raised(fault: &InternalFault) -> PyErr {
    class::InternalError::new_err(fault.to_string())
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
