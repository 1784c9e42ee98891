//! Search and response, run on a thread of their own.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

use centrode::family::{Depth, Family, Mechanism, Resolved};
use centrode_analysis::Goal;
use centrode_analysis::optimise::{DesignSearch, Ended, GuidedStep, Progress, Settings, Strategy};
use centrode_mechanism::design::{Design, MechanismError};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python};
use pyo3::types::PyDict;

use crate::design::{Class, made};
use crate::error::{no_search, of_design, unknown_word};
use crate::record;
use crate::wait::{attend, wait};

/// The design of a class's family.
type DesignOf<C> = <<C as Class>::Mechanism as Resolved>::Design;

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

/// Searches around a design of a class's family.
pub(crate) fn optimised<'py, C: Class>(
    py: Python<'py>,
    design: &DesignOf<C>,
    method: &str,
    settings: Settings,
    callback: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let design = Arc::new(design.clone());
    let strategy = strategy(method)?;
    let found = search(py, C::family(), design, strategy, settings, callback)?;
    let found = found.map_err(|reason| no_search(&reason))?;
    let best = found.mechanism.as_ref().ok();
    let best = best.and_then(|mechanism| made::<C>(py, mechanism));
    let best = best.ok_or_else(|| no_search("the best point is no mechanism"))??;
    record::optimised(py, best, &found)
}

/// The strategy of a name.
fn strategy(name: &str) -> PyResult<Strategy> {
    let found = Strategy::NAMES.iter().find(|(word, _)| *word == name);
    found.map(|&(_, strategy)| strategy).ok_or_else(|| {
        let known = Strategy::NAMES.map(|(word, _)| word);
        unknown_word("method", name, &known)
    })
}

/// Searches until the end, Ctrl-C, or a callback that returns False or raises. After the end, and where the callback
/// returns False, the best so far is the answer.
fn search(
    py: Python<'_>,
    family: Family,
    design: Arc<dyn Design>,
    strategy: Strategy,
    settings: Settings,
    callback: Option<&Bound<'_, PyAny>>,
) -> PyResult<Result<Found, String>> {
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let job = move |told: &Sender<Progress>| {
        searched(
            &family,
            design.as_ref(),
            strategy,
            settings,
            &mut |progress| {
                // Whoever asked may have gone.
                let gone = told.send(*progress).is_err();
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
    })
}

fn searched(
    family: &Family,
    design: &dyn Design,
    strategy: Strategy,
    settings: Settings,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Found, String> {
    let problem = family.problem(design).map_err(|error| error.to_string())?;
    let problem = problem.as_ref();
    let search = DesignSearch::new(problem, strategy, settings);
    let mut search = search.map_err(|error| error.to_string())?;
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

/// Figures by name at values of a number of a design; NaN where there is none.
pub(crate) fn response<'py, C: Class>(
    py: Python<'py>,
    design: &DesignOf<C>,
    parameter: &str,
    values: Vec<f64>,
    whole: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let (design, key) = (design.clone(), Design::key_of(design, parameter));
    let depth = if whole { Depth::Whole } else { Depth::Motion };
    let found = wait(py, move || {
        C::family().response(&design, &key, &values, depth)
    })?;
    let found = found.map_err(|error| of_design(&error))?;
    let named = PyDict::new(py);
    for answer in found.answers() {
        let figures = answer.figures.iter().map(|f| f.unwrap_or(f64::NAN));
        let figures = numpy::PyArray1::from_iter(py, figures);
        named.set_item(answer.name, figures)?;
    }
    Ok(named)
}
