use std::io::{self, Write};

use crate::analysis::Goal;
use centrode_optimise::{Ended, Progress};
use centrode_spec::Design;
use centrode_synthesis::optimise::{DesignProblem, DesignSearch, GuidedStep};
use serde::Serialize;

use crate::page::words::goal_words;

/// Result of a search.
#[derive(Serialize)]
pub(super) struct Outcome<'a> {
    ended: Ended,
    seconds: f64,
    progress: Option<Progress>,
    parameters: Vec<Moved>,
    before: Vec<Goal>,
    after: Vec<Goal>,
    steps: &'a [GuidedStep],
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<String>,
}

/// Change of a parameter, in the file's unit.
#[derive(Serialize)]
struct Moved {
    name: String,
    key: String,
    before: f64,
    after: f64,
    /// Change as a share of the range between the bounds.
    share: f64,
}

impl<'a> Outcome<'a> {
    pub(super) fn new(
        problem: &dyn DesignProblem,
        search: &'a DesignSearch,
        (before, design): (Vec<Goal>, &dyn Design),
        best: &[f64],
        ended: Ended,
        seconds: f64,
    ) -> Self {
        let start = problem.start().unwrap_or_else(|| best.to_vec());
        let moved = problem.variables().iter().zip(start.iter().zip(best));
        let parameters = moved.map(|(variable, (&start, &after))| {
            let written = design.numbered(&[&variable.key]).ok();
            let written = written.and_then(|numbered| numbered.value(0));
            let [from, to] = [start, after].map(|value| variable.written(value));
            let [low, high] = variable.bounds.map(|value| variable.written(value));
            let before = written.unwrap_or(from);
            Moved {
                name: variable.name.clone(),
                key: variable.key.clone(),
                before,
                after: to,
                share: (to - before) / (high - low),
            }
        });
        // Constraints of the search are no goals of the file.
        let mut before = before;
        let others = problem.goals(&start).unwrap_or_default();
        before.extend(others.into_iter().filter(|goal| goal.number == 0));
        Self {
            ended,
            seconds,
            progress: search.progress(),
            parameters: parameters.collect(),
            before,
            after: problem.goals(best).unwrap_or_default(),
            steps: search.log(),
            remark: problem.remark(best),
        }
    }

    /// Whether every goal is met.
    pub(super) fn reached(&self) -> bool {
        !self.after.is_empty() && self.after.iter().all(|goal| goal.met() == Some(true))
    }

    pub(super) fn json(&self, out: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        writeln!(out)
    }

    pub(super) fn write(&self, method: &str, out: &mut impl Write) -> io::Result<()> {
        for step in self.steps {
            writeln!(out, "{step}")?;
        }
        if !self.steps.is_empty() {
            writeln!(out)?;
        }
        let how = match self.ended {
            Ended::Target if self.reached() => "every goal is reached",
            Ended::Target => "target reached",
            Ended::Evaluations => "maximum number of evaluations reached",
            Ended::Stopped => "stopped",
            Ended::Stuck => "no further step improves the design",
        };
        let evaluations = self.progress.map_or(0, |p| p.evaluations);
        writeln!(
            out,
            "{method}: {evaluations} evaluations in {:.1} s, {:.0} per second; {how}",
            self.seconds,
            evaluations as f64 / self.seconds.max(1e-9)
        )?;
        if let Some(remark) = &self.remark {
            writeln!(out, "{remark}")?;
        }
        writeln!(out, "\n{:40} {:>12} {:>12}", "Goals", "before", "after")?;
        for goal in &self.after {
            let words = goal_words(goal);
            let before = self.before.iter().find(|b| b.name == goal.name);
            let before = before.map_or("-".into(), |b| goal_words(b).value);
            let number = match goal.number {
                0 => String::new(),
                number => number.to_string(),
            };
            writeln!(
                out,
                "  {number:>2} {:<35} {before:>12} {:>12} {:<3}  {:<14} {}",
                goal.title, words.value, words.unit, words.required, words.verdict
            )?;
        }
        writeln!(
            out,
            "\n{:40} {:>12} {:>12} {:>12}",
            "Parameters", "before", "after", "of range"
        )?;
        for moved in &self.parameters {
            writeln!(
                out,
                "     {:<35} {:>12.3} {:>12.3} {:>+11.1}%",
                moved.name,
                moved.before,
                moved.after,
                100.0 * moved.share
            )?;
        }
        Ok(())
    }
}
