use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use tokio::sync::oneshot;

use crate::page::{Snapshot, Subject};

/// One thread that solves designs; the latest asked for comes next, and those it overtakes are dropped.
pub(crate) struct Solver(Arc<Queue>);

#[derive(Default)]
struct Queue {
    waiting: Mutex<Option<Job>>,
    arrived: Condvar,
    latest: AtomicU64,
}

struct Job {
    number: u64,
    text: String,
    check: bool,
    reply: oneshot::Sender<String>,
}

/// A later design has been asked for, or solving has failed in a way it never should.
#[derive(Debug, thiserror::Error)]
#[error("a later change has taken the place of this one")]
pub(crate) struct Overtaken;

impl Solver {
    /// Starts the thread.
    pub(crate) fn start() -> io::Result<Self> {
        let queue = Arc::new(Queue::default());
        let own = Arc::clone(&queue);
        std::thread::Builder::new()
            .name("solver".into())
            .spawn(move || work(&own))?;
        Ok(Self(queue))
    }

    /// The snapshot of a design as JSON, with the checks or without.
    pub(crate) async fn solve(&self, text: String, check: bool) -> Result<String, Overtaken> {
        let (reply, answer) = oneshot::channel();
        let number = self.0.latest.fetch_add(1, Ordering::Relaxed) + 1;
        *self.0.waiting() = Some(Job {
            number,
            text,
            check,
            reply,
        });
        self.0.arrived.notify_one();
        answer.await.map_err(|_| Overtaken)
    }
}

impl Queue {
    fn waiting(&self) -> MutexGuard<'_, Option<Job>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn next(&self) -> Job {
        let mut waiting = self.waiting();
        loop {
            if let Some(job) = waiting.take() {
                return job;
            }
            waiting = self
                .arrived
                .wait(waiting)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }
}

fn work(queue: &Queue) {
    // A drag asks for the picture first and for the checks of the same text after.
    let mut last: Option<Subject> = None;
    loop {
        let job = queue.next();
        let stale = || job.reply.is_closed() || queue.latest.load(Ordering::Relaxed) != job.number;
        // A fault of one design must not end the work on the next.
        let json = catch_unwind(AssertUnwindSafe(|| {
            let same = last.take().filter(|subject| subject.is_of(&job.text));
            let subject = match same.map_or_else(|| Subject::of(job.text.clone()), Ok) {
                Ok(subject) => subject,
                Err(snapshot) => return snapshot.json().ok(),
            };
            if stale() {
                return None;
            }
            let snapshot: Snapshot = if job.check {
                subject.checked()
            } else {
                subject.drawn()
            };
            last = Some(subject);
            snapshot.json().ok()
        }));
        if let Ok(Some(json)) = json {
            // Nobody waits for what has been overtaken.
            let _ = job.reply.send(json);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode::mechanism::design::Design;

    #[test]
    fn the_latest_design_is_answered_and_no_queue_builds_up() {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let solver = Arc::new(Solver::start().expect("a thread"));
            let template = Design::template("gear-pair").expect("a template");
            let mut asked = Vec::new();
            for z in 20..60 {
                let text = template.replace("tooth_count = 23", &format!("tooth_count = {z}"));
                let solver = Arc::clone(&solver);
                asked.push(tokio::spawn(async move { solver.solve(text, true).await }));
                tokio::task::yield_now().await;
            }
            let mut answers = Vec::new();
            for task in asked {
                answers.push(task.await.expect("no panic"));
            }
            let last = answers
                .pop()
                .expect("asked")
                .expect("the latest is answered");
            assert!(last.contains("tooth_count = 59"));
            let done = answers.iter().filter(|a| a.is_ok()).count();
            assert!(done < 39, "{done} stale designs were solved");
        });
    }
}
