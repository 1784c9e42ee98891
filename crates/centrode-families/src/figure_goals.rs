//! Goals for figures of the check.

use std::sync::{Arc, OnceLock};

use centrode_analysis::{FigureGroup, Goal, Report, Table};
use centrode_spec::{Design, FigureGoalSpec, MechanismError, Named};
use centrode_synthesis::optimise::{DesignProblem, NotSearched, VaryProblem};

use super::{Depth, Mechanism, Resolved};

/// Checks that the goals in a table of a design name figures of the check.
pub(crate) fn check_names(
    table: &str,
    goals: &Named<FigureGoalSpec>,
    groups: &[&[FigureGroup]],
) -> Result<(), MechanismError> {
    let rows = groups
        .iter()
        .copied()
        .flatten()
        .flat_map(|group| group.rows);
    let keys = rows.flat_map(|row| row.keys).filter(|key| !key.is_empty());
    let known: Vec<&str> = keys.copied().collect();
    for (name, goal) in goals {
        if !known.contains(&&*goal.figure) {
            let key = format!("{table}.{name}.figure");
            return Err(MechanismError::unknown_word(key, &goal.figure, &known));
        }
    }
    Ok(())
}

/// The figures of a report that goals can name, one table per unit, in the order of the report.
pub(crate) fn figures(report: &Report) -> Vec<Table> {
    let rows = report.groups.iter().flat_map(|group| group.rows);
    let figures = rows.flat_map(|row| row.keys.iter().map(|key| (row.unit, *key)));
    let known = figures.filter_map(|(unit, key)| {
        let value = *report.values.get(key)?;
        Some((unit, key.to_owned(), vec![value]))
    });
    Table::of_figures(["value"], known)
}

/// Whether all goals have figures.
fn are_known(goals: &[Goal]) -> bool {
    goals.iter().all(|goal| goal.value.is_some())
}

/// Report of the smallest depth at which all goals of a mechanism have figures.
pub(crate) fn check_goals(mechanism: &dyn Mechanism) -> Report {
    let mut report = Report::default();
    for depth in Depth::ALL {
        report = mechanism.report(depth);
        if are_known(&report.goals) {
            break;
        }
    }
    report
}

/// Search problem of a design with goals for figures. Its points are checked as deep as these figures need.
pub(crate) fn problem<M: Resolved>(
    design: &M::Design,
    count: usize,
    vary: &Named<[f64; 2]>,
) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
    let goals = |design: &dyn Design, depth: Depth| {
        let report = M::report(design.downcast_ref().ok_or(f64::MAX)?, depth);
        Ok::<Vec<Goal>, f64>(report.map_err(|_| f64::MAX)?.goals)
    };
    let start = design.clone();
    let deep_enough = OnceLock::new();
    let goals_of = Box::new(move |design: &dyn Design| {
        let depth = deep_enough.get_or_init(|| {
            let mut depths = Depth::ALL.into_iter();
            let depth =
                depths.find(|&depth| goals(&start, depth).is_ok_and(|goals| are_known(&goals)));
            depth.unwrap_or(Depth::Whole)
        });
        goals(design, *depth)
    });
    let design_of: Arc<dyn Design> = Arc::new(design.clone());
    let problem = VaryProblem::new(design_of, count, vary, goals_of)?;
    Ok(Box::new(problem))
}
