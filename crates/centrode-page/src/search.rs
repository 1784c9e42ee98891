//! Searches for a better design, for the page.

use crate::words::{GoalWords, goal_words};
use crate::{Edit, EditError, edited};
use centrode_analysis::Goal;
use centrode_families::{FAMILIES, InternalFault};
use centrode_optimise::{Ended, Progress, Settings};
use centrode_synthesis::optimise::{DesignProblem, DesignSearch, Strategy};
use serde::{Deserialize, Serialize};
use std::io;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Interval at which the best design found is prepared for the page.
const SHOW: Duration = Duration::from_millis(400);

/// Maximum number of points of the history that the page draws.
const DRAWN: usize = 400;

/// Search for a better design, on a thread of its own; there is one at a time.
#[derive(Debug, Default)]
pub struct Searching(Mutex<Option<Arc<Run>>>);

/// Request of the page.
#[derive(Debug, Deserialize)]
pub struct Ask {
    /// Text of the design, as the page shows it.
    pub text: String,
    method: String,
    seed: u64,
    evaluations: u64,
}

/// Progress of a search.
#[derive(Clone, Debug, Serialize)]
pub struct State {
    method: String,
    /// Maximum number of evaluations.
    evaluations: u64,
    running: bool,
    ended: Option<Ended>,
    /// Remark of the problem on the point at which the search ended.
    remark: Option<String>,
    /// Progress at the ends of the generations, thinned out.
    history: Vec<Progress>,
    /// The best design found, as a file.
    text: String,
    /// Goals of that design.
    goals: Vec<GoalWords>,
    /// Goals and constraints missed at the start or by the best design.
    missed: Vec<Missed>,
}

/// Goal or constraint that a search counts as missed, figures in `unit`.
#[derive(Clone, Debug, Serialize)]
struct Missed {
    title: String,
    unit: &'static str,
    start: String,
    best: String,
    /// Required range.
    required: String,
    met: bool,
}

#[derive(Debug)]
struct Run {
    stop: AtomicBool,
    state: Mutex<State>,
}

impl Run {
    /// Ends a search that panicked; the best design found stays.
    fn fail(&self, fault: InternalFault) {
        let mut state = self.state();
        state.running = false;
        state.remark = Some(fault.to_string());
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn report(&self, progress: Progress) {
        let history = &mut self.state().history;
        if history.len() >= DRAWN {
            let mut odd = false;
            history.retain(|_| {
                odd = !odd;
                odd
            });
        }
        history.push(progress);
    }
}

impl Searching {
    fn run(&self) -> MutexGuard<'_, Option<Arc<Run>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts a search; a search that is running is stopped. `whole` is the text of the design with the samples of its files.
    ///
    /// # Errors
    /// The reason in words if no search can start.
    pub fn start(&self, ask: Ask, whole: String) -> Result<(), String> {
        let file = FAMILIES
            .read(whole.as_bytes())
            .map_err(|error| error.message())?;
        let problem = file.family().problem(file.design());
        let problem = problem.map_err(|error| error.to_string())?;
        let strategy = Strategy::NAMES.iter().find(|(name, _)| *name == ask.method);
        let Some(&(_, strategy)) = strategy else {
            return Err(format!("unknown method {:?}", ask.method));
        };
        let settings = Settings {
            seed: ask.seed,
            evaluations: ask.evaluations,
            ..Settings::default()
        };
        let search = DesignSearch::new(problem.as_ref(), strategy, settings)
            .map_err(|error| error.to_string())?;
        self.stop();
        let run = Arc::new(Run {
            stop: AtomicBool::new(false),
            state: Mutex::new(State {
                method: ask.method,
                evaluations: ask.evaluations,
                running: true,
                ended: None,
                remark: None,
                history: Vec::new(),
                goals: goals(&whole),
                missed: Vec::new(),
                text: ask.text.clone(),
            }),
        });
        let own = Arc::clone(&run);
        let thread: io::Result<_> =
            std::thread::Builder::new()
                .name("search".into())
                .spawn(move || {
                    let texts = [ask.text.as_str(), &whole];
                    let done = InternalFault::catch(|| work(&own, texts, problem.as_ref(), search));
                    if let Err(fault) = done {
                        own.fail(fault);
                    }
                });
        thread.map_err(|error| error.to_string())?;
        *self.run() = Some(run);
        Ok(())
    }

    /// Progress of the last search; `None` before the first.
    pub fn state(&self) -> Option<State> {
        self.run().as_ref().map(|run| run.state().clone())
    }

    /// Stops at the end of the generation; the best found is shown until it is dismissed by stopping once more.
    pub fn dismiss(&self) {
        self.stop();
        let mut run = self.run();
        if run.as_ref().is_some_and(|run| !run.state().running) {
            *run = None;
        }
    }

    /// Stops at once and discards everything, the best design included.
    pub fn forget(&self) {
        self.stop();
        *self.run() = None;
    }

    fn stop(&self) {
        if let Some(run) = self.run().as_ref() {
            run.stop.store(true, Ordering::Relaxed);
        }
    }
}

/// The goals of a design; empty if there is no mechanism.
fn goals(text: &str) -> Vec<GoalWords> {
    let mechanism = FAMILIES
        .read(text.as_bytes())
        .and_then(|file| file.mechanism());
    mechanism.map_or_else(
        |_| Vec::new(),
        |mechanism| {
            mechanism
                .check_goals()
                .goals
                .iter()
                .map(goal_words)
                .collect()
        },
    )
}

/// Goals and constraints that a search counts as missed, at its start and at a point.
fn missed(start: &[Goal], best: &[Goal]) -> Vec<Missed> {
    let fails = |goal: &Goal| goal.met() == Some(false);
    let pairs = start.iter().filter_map(|before| {
        let now = best.iter().find(|goal| goal.name == before.name)?;
        (fails(before) || fails(now)).then_some((before, now))
    });
    let missed = pairs.map(|(before, now)| {
        let [stated, words] = [before, now].map(goal_words);
        Missed {
            title: now.title.clone().into_owned(),
            unit: words.unit,
            start: stated.value.to_owned(),
            best: words.value.to_owned(),
            required: words.required.to_owned(),
            met: !fails(now),
        }
    });
    missed.collect()
}

/// Runs a search. The design is given as the page shows it, and with the samples of its files.
fn work(
    run: &Run,
    [text, whole]: [&str; 2],
    problem: &dyn DesignProblem,
    mut search: DesignSearch,
) {
    let at = |point: &[f64]| problem.goals(point).unwrap_or_default();
    let start = problem.start().map(|point| at(&point)).unwrap_or_default();
    run.state().missed = missed(&start, &start);
    // Checks of all constraints may be slow: they may take at most a tenth of the time.
    let mut next = Instant::now();
    let ended = loop {
        let due = Instant::now() + SHOW;
        let mut shown = false;
        let ended = search.run(problem, &mut |progress| {
            run.report(*progress);
            shown = Instant::now() >= due;
            if shown || run.stopped() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        if let Ok(best) = better(text, problem, &search.best())
            && best != run.state().text
        {
            let whole = better(whole, problem, &search.best());
            let goals = goals(&whole.unwrap_or_default());
            let mut state = run.state();
            (state.text, state.goals) = (best, goals);
            drop(state);
            let requested = Instant::now();
            if requested >= next {
                let now = missed(&start, &at(&search.best()));
                run.state().missed = now;
                next = Instant::now() + 9 * requested.elapsed();
            }
        }
        if !shown || run.stopped() {
            break ended;
        }
    };
    let remark = problem.remark(&search.best());
    let last = missed(&start, &at(&search.best()));
    let mut state = run.state();
    state.missed = last;
    state.remark = remark;
    state.running = false;
    state.ended = Some(ended);
}

/// Text of the design with the numbers of a point.
///
/// # Errors
/// [`EditError`] if a key of the search cannot be set in the text.
pub fn better(text: &str, problem: &dyn DesignProblem, point: &[f64]) -> Result<String, EditError> {
    let variables = problem.variables().iter().zip(point);
    let moved = variables.map(|(v, &value)| Edit::number(&v.key, v.written(value), false));
    let followers = problem.followers(point).into_iter();
    let followers = followers.map(|(key, value)| Edit::number(&key, value, value.fract() == 0.0));
    let edits: Vec<Edit> = moved.chain(followers).collect();
    edited(text, &edits)
}
