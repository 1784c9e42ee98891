use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::document::DesignText;
use crate::InternalFault;
use crate::analysis::Progress;
use crate::geometry::{Cancel, Cancelled};
use serde::Deserialize;
use serde_json::json;
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};

use crate::page::{Snapshot, Subject};

/// Solves the designs of the open pages, for each page the latest one requested.
///
/// A solve ends early if its page requests another one, or if nobody waits for its answer any more.
#[derive(Default)]
pub(crate) struct Solver {
    /// Request being solved for each page.
    under_way: Mutex<HashMap<String, UnderWay>>,
    /// Last design solved: the page first requests its picture, then its checks.
    last: Mutex<Option<Arc<Subject>>>,
}

/// A request that is being solved: its turn, the token that cancels it, and its progress.
#[derive(Debug)]
struct UnderWay {
    turn: u64,
    cancel: Cancel,
    progress: Progress,
}

/// Depth to which a design is solved.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Depth {
    /// Numbers alone, for a design whose solving was cancelled.
    Numbers,
    /// Picture that is available at once.
    Picture,
    /// Goals alone, by the checks of the motion: fast enough to follow a drag.
    Goals,
    /// Picture with details that take longer to make.
    Detail,
    /// Results of the checks, too.
    Checks,
}

/// Reason why a design has no answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Unsolved {
    #[error("a later change has replaced this one")]
    Overtaken,
    #[error("solving this design has failed: {0}")]
    Fault(String),
    #[error(transparent)]
    Internal(#[from] InternalFault),
}

/// Answer to a page, one JSON value whose parts are sent as soon as they are known.
pub(crate) struct Answer {
    first: Option<String>,
    later: UnboundedReceiver<Result<String, Unsolved>>,
    _wait: Wait,
}

impl Answer {
    /// The next part; `None` after the last.
    pub(crate) async fn next(&mut self) -> Option<String> {
        if self.first.is_some() {
            return self.first.take();
        }
        let failed = match self.later.recv().await? {
            Ok(part) => return Some(part),
            Err(Unsolved::Overtaken) => json!({ "overtaken": true }),
            Err(fault) => json!({ "message": fault.to_string() }),
        };
        // The error ends the JSON value that has begun.
        Some(failed.to_string().replacen('{', ",", 1))
    }
}

/// Guard of a solve that somebody waits for; dropped, it cancels the solve.
struct Wait {
    solver: Arc<Solver>,
    page: String,
    cancel: Cancel,
    progress: Progress,
}

impl Wait {
    /// Replaces the request being solved for the page; `None` if a later request arrived before this one.
    fn begin(solver: &Arc<Solver>, page: &str, turn: u64) -> Option<Self> {
        let (cancel, progress) = (Cancel::default(), Progress::default());
        let mut under_way = held(&solver.under_way);
        if under_way.get(page).is_some_and(|later| later.turn > turn) {
            return None;
        }
        let now = UnderWay {
            turn,
            cancel: cancel.clone(),
            progress: progress.clone(),
        };
        if let Some(before) = under_way.insert(page.to_owned(), now) {
            before.cancel.cancel();
        }
        drop(under_way);
        Some(Self {
            solver: Arc::clone(solver),
            page: page.to_owned(),
            cancel,
            progress,
        })
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        let mut under_way = held(&self.solver.under_way);
        // A cancelled request has been replaced by the next one of its page.
        if !self.cancel.is_cancelled() {
            under_way.remove(&self.page);
        }
        self.cancel.cancel();
    }
}

impl Solver {
    /// Snapshot of a design. If the answer is dropped before its end, the solve is cancelled.
    ///
    /// A page numbers its requests by `turn`, because a request can arrive after the next one.
    pub(crate) async fn solve(
        self: &Arc<Self>,
        page: &str,
        turn: u64,
        text: DesignText,
        depth: Depth,
    ) -> Result<Answer, Unsolved> {
        let wait = Wait::begin(self, page, turn).ok_or(Unsolved::Overtaken)?;
        let (solver, cancel) = (Arc::clone(self), wait.cancel.clone());
        let progress = wait.progress.clone();
        let (teller, mut later) = unbounded_channel();
        let job = move || {
            let parts = teller.clone();
            let stated = || solver.answer(text, depth, &|part| drop(parts.send(Ok(part))));
            if let Err(error) = outcome(|| progress.during(|| cancel.run(stated))) {
                // The receiver may be gone.
                drop(teller.send(Err(error)));
            }
        };
        let task = tokio::task::spawn_blocking(job);
        match later.recv().await {
            Some(first) => Ok(Answer {
                first: Some(first?),
                later,
                _wait: wait,
            }),
            None => Err(match task.await {
                Ok(()) => Unsolved::Fault("there is no answer".into()),
                Err(_) => InternalFault.into(),
            }),
        }
    }

    /// Completed share of the checks that run for a page; `None` if nothing is being solved for it.
    pub(crate) fn share(&self, page: &str) -> Option<f64> {
        let under_way = held(&self.under_way);
        Some(under_way.get(page)?.progress.share())
    }

    fn answer(
        &self,
        DesignText { text, whole }: DesignText,
        depth: Depth,
        send: &dyn Fn(String),
    ) -> serde_json::Result<()> {
        if depth == Depth::Numbers {
            send(Snapshot::cancelled(text).json()?);
            return Ok(());
        }
        let last = held(&self.last).clone();
        let is_last = |subject: &Arc<Subject>| {
            let same = |whole: &String| subject.is_of(&text, whole);
            whole.as_ref().is_ok_and(same)
        };
        let subject = match last.filter(is_last) {
            Some(subject) => subject,
            None => match Subject::without_faulty_details(text, whole) {
                Ok(subject) => Arc::new(subject),
                Err(snapshot) => {
                    send(snapshot.json()?);
                    return Ok(());
                }
            },
        };
        *held(&self.last) = Some(Arc::clone(&subject));
        match depth {
            Depth::Numbers | Depth::Picture => subject.drawn(send)?,
            // The page already has the rest.
            Depth::Goals => send(serde_json::to_string(&subject.goals())?),
            Depth::Detail => send(subject.detailed().json()?),
            Depth::Checks => send(subject.checked().json()?),
        }
        Ok(())
    }
}

/// Outcome of a solve that may be cancelled, fail or panic.
fn outcome(
    solve: impl FnOnce() -> Result<serde_json::Result<()>, Cancelled>,
) -> Result<(), Unsolved> {
    match InternalFault::catch(solve)? {
        Ok(stated) => stated.map_err(|error| Unsolved::Fault(error.to_string())),
        Err(Cancelled) => Err(Unsolved::Overtaken),
    }
}

fn held<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FAMILIES;
    use serde_json::Value;
    use std::time::{Duration, Instant};

    const PAGE: &str = "one";

    impl From<String> for DesignText {
        fn from(text: String) -> Self {
            Self {
                whole: Ok(text.clone()),
                text,
            }
        }
    }

    impl From<&str> for DesignText {
        fn from(text: &str) -> Self {
            text.to_owned().into()
        }
    }

    /// A design that takes minutes to solve.
    const SLOW: &str = r#"
        family = "gear-pair"
        [pitch]
        kind = "circle"
        module = 1
        tooth_count = 2000
    "#;

    async fn solved(
        solver: &Arc<Solver>,
        page: &str,
        turn: u64,
        text: String,
        depth: Depth,
    ) -> Result<String, Unsolved> {
        let mut answer = solver.solve(page, turn, text.into(), depth).await?;
        let mut whole = String::new();
        while let Some(part) = answer.next().await {
            whole += &part;
        }
        Ok(whole)
    }

    fn block_on<T>(task: impl Future<Output = T>) -> T {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_time()
            .build()
            .expect("a runtime");
        let done = runtime.block_on(task);
        // A thread that still computes would be waited for here: minutes, where one that stops takes a tenth of a second.
        let ended = Instant::now();
        drop(runtime);
        assert!(ended.elapsed() < Duration::from_secs(10));
        done
    }

    #[test]
    fn a_later_change_or_nobody_waiting_stops_a_slow_solve_at_once() {
        block_on(async {
            let solver = Arc::new(Solver::default());
            let slow = |page: &'static str| {
                let solver = Arc::clone(&solver);
                tokio::spawn(
                    async move { solved(&solver, page, 1, SLOW.into(), Depth::Picture).await },
                )
            };
            let (ours, others, left) = (slow(PAGE), slow("another"), slow("closed"));
            tokio::time::sleep(Duration::from_millis(300)).await;
            assert!(!ours.is_finished() && !others.is_finished());
            let requested = Instant::now();
            let quick = solved(&solver, PAGE, 2, "family = 1".into(), Depth::Picture).await;
            assert!(quick.expect("the latest").contains("family"));
            let overtaken = ours.await.expect("no panic");
            assert!(matches!(overtaken, Err(Unsolved::Overtaken)));
            assert!(requested.elapsed() < Duration::from_secs(10));
            // A delayed request replaces no later one.
            let latest = slow(PAGE);
            tokio::time::sleep(Duration::from_millis(50)).await;
            let late = solved(&solver, PAGE, 0, "family = 1".into(), Depth::Picture).await;
            assert!(matches!(late, Err(Unsolved::Overtaken)));
            assert!(!latest.is_finished());
            latest.abort();
            // What another page waits for goes on.
            assert!(!others.is_finished());
            others.abort();
            left.abort();
        });
    }

    #[test]
    fn a_panic_is_reported_in_plain_words_also_after_a_first_part() {
        // Whatever was thrown.
        let panics: [fn(); 5] = [
            || panic!("{}", 1),
            || panic!("thread 'main' panicked"),
            || assert!(std::env::args().count() > 999),
            || std::panic::panic_any(7),
            || std::panic::resume_unwind(Box::new("called `Option::unwrap()`")),
        ];
        for panic in panics {
            let fault = outcome(|| {
                panic();
                Ok(Ok(()))
            });
            let fault = fault.expect_err("a panic");
            assert_eq!(fault.to_string(), InternalFault.to_string());
            assert_eq!(InternalFault::catch(panic), Err(InternalFault));
            block_on(async {
                let solver = Arc::new(Solver::default());
                let (teller, later) = unbounded_channel();
                let wait = Wait::begin(&solver, PAGE, 1).expect("the first");
                let first = Some("{\"picture\":{}".to_owned());
                let mut answer = Answer {
                    first,
                    later,
                    _wait: wait,
                };
                teller.send(Err(fault)).expect("heard");
                drop(teller);
                let mut whole = String::new();
                while let Some(part) = answer.next().await {
                    whole += &part;
                }
                let whole: Value = serde_json::from_str(&whole).expect("JSON");
                assert_eq!(whole["message"], InternalFault.to_string());
            });
        }
        for word in ["panic", "thread", "unwrap", "rust"] {
            assert!(!InternalFault.to_string().contains(word));
        }
        assert!(matches!(
            outcome(|| Err(Cancelled)),
            Err(Unsolved::Overtaken)
        ));
        assert!(outcome(|| Ok(Ok(()))).is_ok());
    }

    #[test]
    fn a_cancelled_design_shows_its_numbers() {
        block_on(async {
            let solver = Arc::new(Solver::default());
            let answer = solved(&solver, PAGE, 1, SLOW.into(), Depth::Numbers).await;
            let answer = answer.expect("at once");
            assert!(answer.contains("cancelled") && answer.contains("pitch.tooth_count"));
        });
    }

    #[test]
    fn the_picture_is_told_before_numbers_and_curves() {
        block_on(async {
            let solver = Arc::new(Solver::default());
            let text = FAMILIES.template("gear-pair").expect("a template");
            let answer = solver.solve(PAGE, 1, text.into(), Depth::Picture).await;
            let mut answer = answer.expect("solved");
            let first = answer.next().await.expect("a part");
            let second = answer.next().await.expect("another");
            assert_eq!(answer.next().await, None);
            let known: Value =
                serde_json::from_str(&format!("{}}}", first.trim_end())).expect("JSON");
            assert!(first.ends_with('\n') && known["picture"].is_object());
            assert_eq!(
                (&known["tables"], &known["curves"]),
                (&Value::Null, &Value::Null)
            );
            let whole: Value = serde_json::from_str(&(first + &second)).expect("JSON");
            assert!(whole["tables"].is_array() && whole["curves"].is_array());
            // Overtaken on its way, it ends as what it is.
            let cut = solver.solve(PAGE, 2, text.into(), Depth::Picture).await;
            let mut cut = cut.expect("solved");
            let first = cut.next().await.expect("a part");
            cut.later.close();
            while cut.later.try_recv().is_ok() {}
            let (teller, later) = unbounded_channel();
            teller.send(Err(Unsolved::Overtaken)).expect("heard");
            cut.later = later;
            let end = cut.next().await.expect("an end");
            let whole: Value = serde_json::from_str(&(first + &end)).expect("JSON");
            assert_eq!(whole["overtaken"], true);
        });
    }

    #[test]
    fn the_latest_design_is_answered_and_no_queue_builds_up() {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let solver = Arc::new(Solver::default());
            let template = FAMILIES.template("gear-pair").expect("a template");
            let mut requested = Vec::new();
            for z in 20..60 {
                let text = template.replace("tooth_count = 23", &format!("tooth_count = {z}"));
                let solver = Arc::clone(&solver);
                requested.push(tokio::spawn(async move {
                    solved(&solver, PAGE, z, text, Depth::Checks).await
                }));
                tokio::task::yield_now().await;
            }
            let mut answers = Vec::new();
            for task in requested {
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
            let solver = Arc::new(Solver::default());
            // Its checks take some seconds in a debug build.
            let slow = FAMILIES.template("three-arm").expect("a template");
            let quick = FAMILIES.template("gear-pair").expect("a template");
            let first = solved(&solver, PAGE, 1, slow.to_owned(), Depth::Picture).await;
            assert!(first.expect("nothing overtakes it").contains("\"picture\""));
            let checker = Arc::clone(&solver);
            let checks = tokio::spawn(async move {
                solved(&checker, PAGE, 2, slow.to_owned(), Depth::Checks).await
            });
            tokio::task::yield_now().await;
            let picture = solved(&solver, PAGE, 3, quick.to_owned(), Depth::Picture).await;
            assert!(picture.expect("the latest").contains("tooth_count"));
            // The checks are still under way, or were dropped before they began; had the picture waited, they would be done.
            let waited = checks.is_finished() && checks.await.expect("no panic").is_ok();
            assert!(!waited, "the picture has waited for them");
        });
    }
}
