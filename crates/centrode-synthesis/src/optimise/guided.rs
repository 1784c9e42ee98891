use std::fmt;
use std::ops::ControlFlow;

use centrode_geometry::Cancel;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde::{Deserialize, Serialize};

use super::DesignProblem;
use centrode_analysis::Goal;
use centrode_optimise::{Ended, Progress};

/// First step of a parameter, as a share of its bounds; and minimum step, below which the search goes on to the next goal.
const FIRST_STEP: f64 = 0.04;
const MIN_STEP: f64 = 1e-4;
/// Share of the gain of a step's own goal that all other goals together may lose.
const PRICE: f64 = 0.5;
/// Minimum gain of a step, as a share of the goal's scale.
const MIN_GAIN: f64 = 1e-9;
/// Share of the maximum influence above which a parameter is moved together with other parameters.
const TOGETHER: f64 = 0.3;

/// Step of a guided search: its goal, the parameters moved, and the gain.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct GuidedStep {
    /// Number and title of the goal it was made for.
    pub goal: (u32, String),
    /// Moves: name, and value before and after in the file's unit.
    pub moves: Vec<(String, [f64; 2])>,
    /// The goal's miss before and after, as a share of its scale.
    pub miss: [f64; 2],
    /// Growth of the total miss of all other goals; negative if the total fell.
    pub others: f64,
    /// Number of the parameters that would have helped this goal.
    pub helpful: usize,
}

impl fmt::Display for GuidedStep {
    /// Step in words: its goal, the moves, and the gain.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (number, title) = &self.goal;
        match number {
            0 => write!(out, "{title}: ")?,
            number => write!(out, "goal {number} {title}: ")?,
        }
        for (i, (name, [from, to])) in self.moves.iter().enumerate() {
            let comma = if i > 0 { ", " } else { "" };
            write!(out, "{comma}{name} {from} -> {to}")?;
        }
        let [before, after] = self.miss;
        write!(
            out,
            ": miss {before:.4} -> {after:.4} of its scale, the best of {} parameters that help; ",
            self.helpful
        )?;
        match self.others {
            others if others.abs() < 5e-5 => {
                write!(out, "the total miss of the other goals does not change")
            }
            others if others > 0.0 => write!(
                out,
                "the total miss of the other goals grows by {others:.4}"
            ),
            others => write!(
                out,
                "the total miss of the other goals falls by {:.4}",
                -others
            ),
        }
    }
}

/// Parameter-guided search: goal by goal, each missed goal moves the parameters that influence it most, step by step.
///
/// At each step every free parameter is tried a little in either direction. The one that brings the goal nearest is moved, as
/// long as all other goals together do not lose more than half of what it gains, and is moved on with twice the step while that
/// helps. If several have a similar influence on the goal, moving them together is tried, too. If nothing helps, the step is
/// halved; if no step helps, the search goes on to the next goal. So the misses fall with every step, and the search ends. It is
/// deterministic.
///
/// Source: the "parameter guide" of Yin et al. 2021, section 4, DOI 10.25165/j.ijabe.20211405.6844, whose rules the paper
/// does not print; these are ours.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct GuidedSearch {
    point: Vec<f64>,
    evaluations: u64,
    misses: Vec<f64>,
    log: Vec<GuidedStep>,
    #[serde(default)]
    history: Vec<Progress>,
    /// State in which a run ended, to go on from there; `None` before the first run, and if every goal is met.
    #[serde(default)]
    under_way: Option<UnderWay>,
}

/// Position in a guided search at which it can break off.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
struct UnderWay {
    /// Index of the current goal; the number of goals if no further step improves the design.
    goal: usize,
    /// Step tried next for it, as a share of the bounds.
    step: f64,
    /// Steps made before this round over the goals.
    before: usize,
}

/// Evaluation of a point: the goals, and the miss of each as a share of its scale.
struct Seen {
    goals: Vec<Goal>,
    misses: Vec<f64>,
}

/// Candidate: a point that was tried.
struct Candidate {
    point: Vec<f64>,
    /// Displacement of each variable, as shares of the bounds.
    moved: Vec<f64>,
    seen: Seen,
}

impl Seen {
    fn new(problem: &dyn DesignProblem, point: &[f64]) -> Option<Self> {
        let goals = problem.guides(point)?;
        let miss = |goal: &Goal| {
            goal.margin
                .map_or(0.0, |margin| (-margin / goal.scale).max(0.0))
        };
        Some(Self {
            misses: goals.iter().map(miss).collect(),
            goals,
        })
    }

    /// Gain of a goal, and loss of all other goals together, from this point to another.
    fn change(&self, to: &Self, goal: usize) -> (f64, f64) {
        let gain = self.misses[goal] - to.misses[goal];
        let grown: f64 = to.misses.iter().sum::<f64>() - self.misses.iter().sum::<f64>();
        (gain, grown + gain)
    }

    /// Whether a step is worth making for a goal.
    fn allows(&self, to: &Self, goal: usize) -> bool {
        let (gain, lost) = self.change(to, goal);
        gain > MIN_GAIN && lost <= PRICE * gain
    }
}

impl GuidedSearch {
    /// Starts a search from the problem's start.
    #[must_use]
    pub fn new(problem: &dyn DesignProblem) -> Self {
        let bounds = problem.bounds();
        let middle = || bounds.iter().map(|b| 0.5 * (b.0 + b.1)).collect();
        let start = problem.start().unwrap_or_else(middle);
        let inside = |(x, &(low, high)): (f64, &(f64, f64))| x.clamp(low, high);
        Self {
            point: start.into_iter().zip(&bounds).map(inside).collect(),
            evaluations: 0,
            misses: Vec::new(),
            log: Vec::new(),
            history: Vec::new(),
            under_way: None,
        }
    }

    /// Current point.
    #[must_use]
    pub fn point(&self) -> &[f64] {
        &self.point
    }

    /// The steps made.
    #[must_use]
    pub fn log(&self) -> &[GuidedStep] {
        &self.log
    }

    /// Progress at the start and after each step.
    #[must_use]
    pub fn history(&self) -> &[Progress] {
        &self.history
    }

    /// Number of points evaluated.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Progress: the steps made count as generations, the misses as violation.
    #[must_use]
    pub fn progress(&self) -> Progress {
        Progress {
            generation: self.log.len() as u64,
            evaluations: self.evaluations,
            objective: 0.0,
            violation: self.misses.iter().sum(),
        }
    }

    /// Makes steps until every goal is met, no further step improves the design, maximum number of evaluations reached, or `observe` breaks off. The
    /// next run goes on as if there had been no break.
    pub fn run(
        &mut self,
        problem: &dyn DesignProblem,
        evaluations: u64,
        observe: &mut dyn FnMut(&Self) -> ControlFlow<()>,
    ) -> Ended {
        let Some(mut seen) = Seen::new(problem, &self.point) else {
            return Ended::Stuck;
        };
        let mut broken_off = self.under_way.take();
        // After a break the point is evaluated once more, which does not count.
        if self.history.is_empty() {
            self.evaluations += 1;
            self.misses.clone_from(&seen.misses);
            self.history.push(self.progress());
        }
        loop {
            let resumed = broken_off.take();
            let before = resumed.map_or(self.log.len(), |at| at.before);
            let first = resumed.map_or(0, |at| at.goal);
            for goal in first..seen.goals.len() {
                let at_goal = resumed.filter(|at| at.goal == goal);
                let mut step = at_goal.map_or(FIRST_STEP, |at| at.step);
                while seen.misses[goal] > 0.0 && step >= MIN_STEP {
                    self.misses.clone_from(&seen.misses);
                    self.under_way = Some(UnderWay { goal, step, before });
                    if observe(self).is_break() {
                        return Ended::Stopped;
                    }
                    if self.evaluations >= evaluations {
                        return Ended::Evaluations;
                    }
                    self.under_way = None;
                    match self.best_step(problem, &seen, goal, step) {
                        Some((candidate, helpful)) => {
                            self.record(problem, &seen, &candidate, goal, helpful);
                            self.point = candidate.point;
                            seen = candidate.seen;
                            self.misses.clone_from(&seen.misses);
                            self.history.push(self.progress());
                        }
                        None => step *= 0.5,
                    }
                }
            }
            self.misses.clone_from(&seen.misses);
            if seen.misses.iter().all(|&miss| miss <= 0.0) {
                return Ended::Target;
            }
            if self.log.len() == before {
                // Another run has no goal left to try.
                self.under_way = Some(UnderWay {
                    goal: seen.goals.len(),
                    step: FIRST_STEP,
                    before,
                });
                return Ended::Stuck;
            }
        }
    }

    /// Best step for a goal, continued while it helps, and how many parameters would have helped.
    fn best_step(
        &mut self,
        problem: &dyn DesignProblem,
        seen: &Seen,
        goal: usize,
        step: f64,
    ) -> Option<(Candidate, usize)> {
        let count = self.point.len();
        let single = |k: usize| {
            let mut moved = vec![0.0; count];
            moved[k / 2] = if k.is_multiple_of(2) { step } else { -step };
            moved
        };
        let candidates = self.tried(problem, (0..2 * count).map(single).collect());
        let gain = |candidate: &Candidate| seen.change(&candidate.seen, goal).0;
        let mut influence = vec![0.0_f64; count];
        for candidate in candidates
            .iter()
            .filter(|candidate| gain(candidate) > MIN_GAIN)
        {
            for (best, moved) in influence.iter_mut().zip(&candidate.moved) {
                if *moved != 0.0 && gain(candidate) > best.abs() {
                    *best = gain(candidate) * moved.signum();
                }
            }
        }
        let helpful = influence.iter().filter(|i| **i != 0.0).count();
        let most = influence.iter().fold(0.0_f64, |most, i| most.max(i.abs()));
        let allowed = |candidates: Vec<Candidate>| {
            candidates
                .into_iter()
                .filter(|t| seen.allows(&t.seen, goal))
        };
        let better = |a: &Candidate, b: &Candidate| gain(a).total_cmp(&gain(b));
        // Two joint moves: all parameters of large influence, in proportion to it; and all whose own step is allowed.
        let mut own = vec![0.0; count];
        for candidate in candidates.iter().filter(|t| seen.allows(&t.seen, goal)) {
            for (own, moved) in own.iter_mut().zip(&candidate.moved) {
                if *moved != 0.0 {
                    *own = *moved;
                }
            }
        }
        let together: Vec<f64> = influence
            .iter()
            .map(|i| {
                if i.abs() >= TOGETHER * most {
                    step * i / most
                } else {
                    0.0
                }
            })
            .collect();
        let joint = if most > 0.0 {
            self.tried(problem, vec![together, own])
        } else {
            Vec::new()
        };
        let mut best = allowed(candidates).chain(allowed(joint)).max_by(better)?;
        // Further in the direction of the best step, with twice the step each time.
        while best.seen.misses[goal] > 0.0 {
            let further = best.moved.iter().map(|moved| 2.0 * moved).collect();
            let Some(next) = self.tried(problem, vec![further]).pop() else {
                break;
            };
            if gain(&next) <= gain(&best) || !seen.allows(&next.seen, goal) {
                break;
            }
            best = next;
        }
        Some((best, helpful))
    }

    /// Evaluates points moved from here by shares of the bounds, in their order; those that give no mechanism are omitted.
    fn tried(&mut self, problem: &dyn DesignProblem, moves: Vec<Vec<f64>>) -> Vec<Candidate> {
        self.evaluations += moves.len() as u64;
        let bounds = problem.bounds();
        let here = &self.point;
        let cancel = Cancel::current();
        let candidate = |moved: Vec<f64>| {
            let _scope = cancel.enter();
            let place = |((x, share), &(low, high)): ((&f64, &f64), &(f64, f64))| {
                (x + share * (high - low)).clamp(low, high)
            };
            let point: Vec<f64> = here.iter().zip(&moved).zip(&bounds).map(place).collect();
            let seen = Seen::new(problem, &point)?;
            Some(Candidate { point, moved, seen })
        };
        moves
            .into_par_iter()
            .panic_fuse()
            .filter_map(candidate)
            .collect()
    }

    fn record(
        &mut self,
        problem: &dyn DesignProblem,
        seen: &Seen,
        candidate: &Candidate,
        goal: usize,
        helpful: usize,
    ) {
        let pairs = problem
            .variables()
            .iter()
            .zip(self.point.iter().zip(&candidate.point));
        let moves = pairs
            .map(|(v, (&from, &to))| (v.name.clone(), [v.written(from), v.written(to)]))
            .filter(|(_, [from, to])| from != to)
            .collect();
        let what = &seen.goals[goal];
        self.log.push(GuidedStep {
            goal: (what.number, what.title.clone().into_owned()),
            moves,
            miss: [seen.misses[goal], candidate.seen.misses[goal]],
            others: seen.change(&candidate.seen, goal).1,
            helpful,
        });
    }
}

#[cfg(test)]
mod tests;
