//! Search, run on a thread of its own.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

use centrode::family::{Family, Mechanism};
use centrode_analysis::Goal;
use centrode_optimise::{Ended, Progress, Settings};
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::{DesignSearch, GuidedStep, Strategy};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, Python};

use crate::design::object;
use crate::error::{Answer, Raised};
use crate::record;
use crate::wait::attend;

/// Result of a search.
pub(crate) struct Found {
    pub(crate) mechanism: Result<Arc<dyn Mechanism>, MechanismError>,
    pub(crate) goals: Vec<Goal>,
    pub(crate) steps: Vec<GuidedStep>,
    pub(crate) history: Vec<Progress>,
    pub(crate) remark: Option<String>,
    pub(crate) progress: Option<Progress>,
    pub(crate) ended: Ended,
}

/// Searches around the design of a machine.
pub(crate) fn optimised<'py>(
    py: Python<'py>,
    family: Family,
    machine: Arc<dyn Mechanism>,
    strategy: Strategy,
    settings: Settings,
    callback: Option<&Bound<'py, PyAny>>,
) -> Answer<Bound<'py, PyAny>> {
    let found = search(py, family, machine, strategy, settings, callback)?;
    let Ok(best) = &found.mechanism else {
        return Err(Raised::no_search("the best point found gives no mechanism"));
    };
    Ok(record::optimised(py, object(py, best)?, &found)?)
}

/// Searches until the end, Ctrl-C, or a callback that returns False or raises. After the end, and where the callback
/// returns False, the best found is the answer.
fn search(
    py: Python<'_>,
    family: Family,
    machine: Arc<dyn Mechanism>,
    strategy: Strategy,
    settings: Settings,
    callback: Option<&Bound<'_, PyAny>>,
) -> Answer<Found> {
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let job = move |stated: &Sender<Progress>| {
        searched(
            &family,
            machine.design(),
            strategy,
            settings,
            &mut |progress| {
                // The receiver may be gone.
                let gone = stated.send(*progress).is_err();
                if gone || stopped.load(Ordering::Relaxed) {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            },
        )
    };
    attend(py, job, |progress| {
        if let Some(callback) = callback {
            let Progress {
                evaluations,
                violation,
                objective,
                ..
            } = progress;
            let answer = callback.call1((evaluations, violation, objective))?;
            if answer.extract::<bool>().is_ok_and(|go_on| !go_on) {
                stop.store(true, Ordering::Relaxed);
            }
        }
        Ok(())
    })?
}

fn searched(
    family: &Family,
    design: &dyn Design,
    strategy: Strategy,
    settings: Settings,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Answer<Found> {
    let problem = family.problem(design)?;
    let problem = problem.as_ref();
    let mut search = DesignSearch::new(problem, strategy, settings)?;
    let ended = search.run(problem, observe);
    let best = search.best();
    Ok(Found {
        mechanism: family.resolve(problem.design(&best).as_ref()),
        goals: problem.goals(&best).unwrap_or_default(),
        steps: search.log().to_vec(),
        history: search.history().to_vec(),
        remark: problem.remark(&best),
        progress: search.progress(),
        ended,
    })
}
