use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use serde::Deserialize;
use tokio::sync::oneshot;

use crate::page::{Snapshot, Subject};

/// Solves designs, the latest asked for first; those it overtakes are dropped.
///
/// Pictures and checks have a thread each: a picture never waits until an old design has been checked.
pub(crate) struct Solver {
    pictures: Arc<Queue>,
    checks: Arc<Queue>,
    shared: Arc<Shared>,
}

/// What both threads know.
#[derive(Default)]
struct Shared {
    /// Number of the latest job.
    latest: AtomicU64,
    /// The last design solved: after its picture its checks are asked for.
    last: Mutex<Option<Arc<Subject>>>,
}

#[derive(Default)]
struct Queue {
    waiting: Mutex<Option<Job>>,
    arrived: Condvar,
}

struct Job {
    number: u64,
    text: String,
    depth: Depth,
    reply: oneshot::Sender<String>,
}

/// How much of a design is asked for.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Depth {
    /// What is drawn at once.
    Picture,
    /// The picture with what takes longer to make.
    Detail,
    /// What the checks say, too.
    Checks,
}

/// A later design has been asked for, or solving has failed in a way it never should.
#[derive(Debug, thiserror::Error)]
#[error("a later change has taken the place of this one")]
pub(crate) struct Overtaken;

impl Solver {
    /// Starts the threads.
    pub(crate) fn start() -> io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let start = |name: &str| {
            let queue = Arc::new(Queue::default());
            let (own, shared) = (Arc::clone(&queue), Arc::clone(&shared));
            std::thread::Builder::new()
                .name(name.into())
                .spawn(move || work(&own, &shared))?;
            io::Result::Ok(queue)
        };
        Ok(Self {
            pictures: start("pictures")?,
            checks: start("checks")?,
            shared,
        })
    }

    /// The snapshot of a design as JSON.
    pub(crate) async fn solve(&self, text: String, depth: Depth) -> Result<String, Overtaken> {
        let (reply, answer) = oneshot::channel();
        let number = self.shared.latest.fetch_add(1, Ordering::Relaxed) + 1;
        let queue = match depth {
            Depth::Picture => &self.pictures,
            Depth::Detail | Depth::Checks => &self.checks,
        };
        *held(&queue.waiting) = Some(Job {
            number,
            text,
            depth,
            reply,
        });
        queue.arrived.notify_one();
        answer.await.map_err(|_| Overtaken)
    }
}

fn held<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Queue {
    fn next(&self) -> Job {
        let mut waiting = held(&self.waiting);
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

impl Shared {
    fn answer(&self, job: &Job) -> Option<String> {
        let stale = || job.reply.is_closed() || self.latest.load(Ordering::Relaxed) != job.number;
        if stale() {
            return None;
        }
        let last = held(&self.last).clone();
        let subject = match last.filter(|subject| subject.is_of(&job.text)) {
            Some(subject) => subject,
            None => match Subject::of(job.text.clone()) {
                Ok(subject) => Arc::new(subject),
                Err(snapshot) => return snapshot.json().ok(),
            },
        };
        *held(&self.last) = Some(Arc::clone(&subject));
        if stale() {
            return None;
        }
        let snapshot: Snapshot = match job.depth {
            Depth::Picture => subject.drawn(),
            Depth::Detail => subject.detailed(),
            Depth::Checks => subject.checked(),
        };
        snapshot.json().ok()
    }
}

fn work(queue: &Queue, shared: &Shared) {
    loop {
        let job = queue.next();
        // A fault of one design must not end the work on the next.
        let json = catch_unwind(AssertUnwindSafe(|| shared.answer(&job)));
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
                asked.push(tokio::spawn(async move {
                    solver.solve(text, Depth::Checks).await
                }));
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

    #[test]
    fn a_picture_does_not_wait_for_the_checks_of_an_older_design() {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let solver = Arc::new(Solver::start().expect("a thread"));
            // Its checks take some seconds in a debug build.
            let slow = Design::template("three-arm").expect("a template");
            let quick = Design::template("gear-pair").expect("a template");
            let first = solver.solve(slow.to_owned(), Depth::Picture).await;
            assert!(first.expect("nothing overtakes it").contains("\"picture\""));
            let checker = Arc::clone(&solver);
            let checks =
                tokio::spawn(async move { checker.solve(slow.to_owned(), Depth::Checks).await });
            tokio::task::yield_now().await;
            let picture = solver.solve(quick.to_owned(), Depth::Picture).await;
            assert!(picture.expect("the latest").contains("tooth_count"));
            // The checks are still under way, or were dropped before they began; had the picture waited, they would be done.
            let waited = checks.is_finished() && checks.await.expect("no panic").is_ok();
            assert!(!waited, "the picture has waited for them");
        });
    }
}
