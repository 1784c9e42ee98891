use std::sync::Mutex;

use centrode_analysis::Goal;

/// Minimum number of evaluated points from which contradictions are reported: a few points show nothing.
const MIN_POINTS: u64 = 50;
/// Maximum number of sentences of a remark: more are no easier to act on.
const MAX_SENTENCES: usize = 3;

/// Record of the goals that the points of a search reach, alone and in pairs. It does not depend on the order of the points.
#[derive(Debug, Default)]
pub(super) struct Reach(Mutex<Record>);

#[derive(Debug, Default)]
struct Record {
    points: u64,
    /// The goals, each with the figure nearest to its range.
    nearest: Vec<Goal>,
    /// Whether a point reached both goals; the diagonal is one goal alone.
    both: Vec<Vec<bool>>,
}

impl Reach {
    /// Adds a point by its goals, which are the same ones in the same order for every point.
    pub(super) fn record(&self, goals: &[Goal]) {
        let Ok(mut record) = self.0.lock() else {
            return;
        };
        if record.nearest.is_empty() {
            record.nearest = goals.to_vec();
            record.both = vec![vec![false; goals.len()]; goals.len()];
        }
        record.points += 1;
        for (nearest, goal) in record.nearest.iter_mut().zip(goals) {
            let is_nearer = |own: f64| nearest.margin.is_none_or(|nearest| own > nearest);
            if goal.margin.is_some_and(is_nearer) {
                nearest.clone_from(goal);
            }
        }
        let met: Vec<bool> = goals.iter().map(|goal| goal.met() == Some(true)).collect();
        for (row, &one) in record.both.iter_mut().zip(&met) {
            for (both, &other) in row.iter_mut().zip(&met) {
                *both |= one && other;
            }
        }
    }

    /// Goals that no point reached, and pairs of goals that no point reached together, in sentences; `None` if there is neither, or
    /// if there are too few points.
    pub(super) fn contradictions(&self) -> Option<String> {
        let record = self.0.lock().ok()?;
        if record.points < MIN_POINTS {
            return None;
        }
        let words = |goal: &Goal| match goal.number {
            0 => goal.title.to_string(),
            number => format!("goal {number} ({})", goal.title),
        };
        let count = record.nearest.len();
        let reached = |i: usize, j: usize| record.both[i][j];
        let never = (0..count).filter(|&i| !reached(i, i)).map(|i| {
            let goal = &record.nearest[i];
            let nearest = goal
                .value
                .map_or("no figure".to_owned(), |value| goal.unit.with_unit(value));
            format!(
                "{} is reached by none of {} evaluated designs, the nearest has {nearest}",
                words(goal),
                record.points
            )
        });
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
        let apart = pairs.filter(|&(i, j)| reached(i, i) && reached(j, j) && !reached(i, j));
        let apart = apart.map(|(i, j)| {
            format!(
                "{} and {} contradict each other: each is reached by some of {} evaluated designs, none reaches both",
                words(&record.nearest[i]),
                words(&record.nearest[j]),
                record.points
            )
        });
        let sentences: Vec<String> = never.chain(apart).take(MAX_SENTENCES).collect();
        (!sentences.is_empty()).then(|| {
            format!(
                "probably infeasible within the bounds: {}",
                sentences.join("; ")
            )
        })
    }
}
