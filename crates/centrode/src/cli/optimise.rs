mod outcome;
mod stored;
mod widen;

use std::io::Write;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use centrode_optimise::{Ended, SearchError, Settings};
use centrode_synthesis::optimise::{DesignProblem, DesignSearch, Strategy};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::Status;
use crate::cli::args::Optimise;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::interrupt::Interrupt;
use crate::page::search::better;
use outcome::Outcome;
use stored::Stored;

/// Interval at which the search is stored while it runs.
const STORE: Duration = Duration::from_secs(10);

/// Interval of the lines of progress if standard error is no terminal.
const LINE: Duration = Duration::from_secs(5);

/// Searches for a better design and writes it, with its search next to it.
pub(crate) fn run(command: &Optimise, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    source.keep_from(&command.output)?;
    let file = source.design()?;
    // A design that gives no mechanism is reported as by a check.
    let mechanism = file.mechanism().map_err(|error| source.blame(error))?;
    if command.widen {
        return widen::run(command, &file, &source.text()?, out);
    }
    let problem = file.family().problem(file.design());
    let problem = problem.map_err(|e| Failure::Usage(e.to_string()))?;
    let problem = problem.as_ref();
    let stored = Stored::beside(&command.output);
    let begun = Instant::now();
    let mut search = if command.resume {
        let mut search = stored.read(problem)?;
        if !search.is_of(problem) {
            let name = stored.name();
            let other =
                format!("{name} is a search of another design: its parameters or bounds differ");
            return Err(Failure::Usage(other));
        }
        same(command, &search, &stored.name())?;
        if let Some(evaluations) = command.evaluations {
            search.allow(evaluations);
        }
        search
    } else {
        let strategy = Strategy::NAMES
            .iter()
            .find(|(name, _)| *name == command.method());
        let Some(&(_, strategy)) = strategy else {
            return Err(Failure::Usage(format!(
                "unknown method {:?}",
                command.method()
            )));
        };
        let usual = Settings::default();
        let settings = Settings {
            seed: command.seed.unwrap_or(usual.seed),
            population: command.population,
            evaluations: command.evaluations.unwrap_or(usual.evaluations),
            target: command.polish.then_some(Settings::POLISH),
            ..usual
        };
        DesignSearch::new(problem, strategy, settings).map_err(|error| {
            let flag = match error {
                SearchError::Population { .. } => "--population: ",
                _ => "",
            };
            Failure::Usage(format!("{flag}{error}"))
        })?
    };
    let text = source.text()?;
    let (ended, seconds) = watched(problem, &mut search, &stored, begun)?;
    let best = search.best();
    let better = better(&text, problem, &best);
    stored.write_design(&better.map_err(|error| Failure::Usage(error.to_string()))?)?;
    stored.write(problem, &search)?;
    let before = mechanism.check_goals().goals;
    let outcome = Outcome::new(
        problem,
        &search,
        (before, file.design()),
        &best,
        ended,
        seconds,
    );
    if command.json {
        outcome.json(out)?;
    } else {
        outcome.write(search.strategy().name(), out)?;
        writeln!(out, "\n{}", command.output.display())?;
    }
    Ok(Status::new(outcome.reached()))
}

/// Checks that method and seed of the command line are those of the stored search: they cannot change when it is resumed.
fn same(command: &Optimise, search: &DesignSearch, name: &str) -> Result<(), Failure> {
    let differs = |flag: &str, requested: &str, stored: &str| {
        let message = format!(
            "--{flag} {requested}: the search in {name} has {flag} {stored}, which cannot change"
        );
        Err(Failure::Usage(message))
    };
    match (&command.method, search.strategy().name()) {
        (Some(method), stored) if method != stored => return differs("method", method, stored),
        _ => {}
    }
    match (command.seed, search.seed()) {
        (Some(seed), Some(stored)) if seed != stored => {
            differs("seed", &seed.to_string(), &stored.to_string())
        }
        _ => Ok(()),
    }
}

/// Runs the search with a bar on the terminal; Ctrl-C ends it.
fn watched(
    problem: &dyn DesignProblem,
    search: &mut DesignSearch,
    stored: &Stored,
    begun: Instant,
) -> Result<(Ended, f64), Failure> {
    let interrupt = Interrupt::watch();
    let bar = ProgressBar::with_draw_target(Some(search.allowed()), target());
    let allowed = search.allowed();
    let style = "{bar:24} {pos}/{len} {msg} {elapsed}, at most {eta} left";
    if let Ok(style) = ProgressStyle::with_template(style) {
        bar.set_style(style);
    }
    let mut due = Instant::now() + STORE;
    let mut next_line = Instant::now() + LINE;
    let mut store = false;
    let ended = loop {
        if store {
            stored.write(problem, search)?;
            due = Instant::now() + STORE;
            store = false;
        }
        let ended = search.run(problem, &mut |progress| {
            let words = if progress.violation > 0.0 {
                format!("total miss of goals {:.4}", progress.violation)
            } else {
                format!("goals reached, objective {:.6}", progress.objective)
            };
            if bar.is_hidden() && Instant::now() >= next_line {
                next_line = Instant::now() + LINE;
                let (done, seconds) = (progress.evaluations, begun.elapsed().as_secs());
                // A closed standard error is no reason to stop.
                let _ = writeln!(
                    std::io::stderr(),
                    "{done} of at most {} evaluations, {words}, {seconds} s",
                    allowed
                );
            }
            bar.set_position(progress.evaluations);
            bar.set_message(words);
            store = Instant::now() >= due;
            if store || interrupt.came() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        if !store || interrupt.came() {
            break ended;
        }
    };
    bar.finish_and_clear();
    Ok((ended, begun.elapsed().as_secs_f64()))
}

fn target() -> ProgressDrawTarget {
    // Without a terminal no bar is written to standard error.
    if std::io::IsTerminal::is_terminal(&std::io::stderr()) {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    }
}
