//! Goals for figures of the check.

use std::sync::Arc;

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
    let mut tables: Vec<Table> = Vec::new();
    for row in report.groups.iter().flat_map(|group| group.rows) {
        for key in row.keys {
            let Some(&value) = report.values.get(key) else {
                continue;
            };
            let row_of = ((*key).to_owned(), vec![value]);
            match tables.iter_mut().find(|table| table.unit == row.unit) {
                Some(table) => table.rows.push(row_of),
                None => tables.push(
                    Table::new("figures", "Figure", row.unit)
                        .columns(["value"])
                        .rows(vec![row_of]),
                ),
            }
        }
    }
    tables
}

/// Report of the smallest depth at which all goals of a mechanism have figures.
pub(crate) fn check_goals(mechanism: &dyn Mechanism) -> Report {
    let is_known = |report: &Report| report.goals.iter().all(|goal| goal.value.is_some());
    let reports = Depth::ALL.into_iter().map(|depth| mechanism.report(depth));
    let mut reports = reports.skip_while(|report| !is_known(report));
    reports.next().unwrap_or_else(|| mechanism.check())
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
    let all_known = |depth: &Depth| {
        let goals = goals(design, *depth);
        goals.is_ok_and(|goals| goals.iter().all(|goal| goal.value.is_some()))
    };
    // A design without goals has no problem.
    let depths = Depth::ALL.into_iter().filter(|_| count > 0);
    let depth = { depths }.find(all_known);
    let depth = depth.unwrap_or(Depth::Whole);
    let goals_of = Box::new(move |design: &dyn Design| goals(design, depth));
    let design_of: Arc<dyn Design> = Arc::new(design.clone());
    let problem = VaryProblem::new(design_of, count, vary, goals_of)?;
    Ok(Box::new(problem))
}
