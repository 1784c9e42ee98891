use std::ops::Range;

use centrode_geometry::bracketed_root;
use wide::f64x4;

use super::panel::{LANES, Monotone, Panel, inverse_quintic};
use super::stage::{LAST, Param, settled};

/// Parameters of increasing targets along the pitch curve, over one turn. The targets in one panel form a run and are solved
/// together.
#[derive(Clone, Debug)]
pub(super) struct Track {
    /// Position of each target in its panel, with room for the lanes beyond the last.
    places: Vec<f64>,
    runs: Vec<Run>,
    count: usize,
}

/// The targets of one panel.
#[derive(Clone, Debug)]
struct Run {
    panel: usize,
    turns: f64,
    targets: Range<usize>,
}

/// Function that increases along the pitch curve: its values at the panels' ends over a turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Monotonicity<'a, G> {
    pub(super) of: G,
    pub(super) panels: &'a [Panel],
    pub(super) ends: &'a [f64],
}

impl<G: Monotone> Monotonicity<'_, G> {
    /// Increase per turn.
    pub(super) fn whole(&self) -> f64 {
        self.ends[self.panels.len()] - self.ends[0]
    }

    /// Panel at a value, and the number of whole turns before.
    fn start(&self, value: f64) -> (usize, f64) {
        let turns = ((value - self.ends[0]) / self.whole()).floor();
        let rest = value - turns * self.whole();
        let after = self.ends.partition_point(|&end| end <= rest);
        (after.clamp(1, self.panels.len()) - 1, turns)
    }

    /// Parameter at any value, without a first guess.
    pub(super) fn param<const C: usize>(&self, value: f64) -> Param {
        let (panel, turns) = self.start(value);
        let s = self.place::<C>(panel, value - turns * self.whole());
        Param { panel, s, turns }
    }

    /// Position of a value in a panel.
    fn place<const C: usize>(&self, index: usize, value: f64) -> f64 {
        let evaluate = |s: f64| self.of.evaluate::<C, _>(&self.panels[index], s);
        let (low, high) = (self.ends[index], self.ends[index + 1]);
        let mut s = 2.0 * (value - low) / (high - low) - 1.0;
        for _ in 0..8 {
            let step = evaluate(s).step(value);
            s = (s + step).clamp(-1.0, 1.0);
            if settled(step) {
                return s;
            }
        }
        let off = |s: f64| evaluate(s).value - value;
        let ends = (off(-1.0).min(0.0), off(1.0).max(0.0));
        bracketed_root(off, -1.0, 1.0, ends.0, ends.1)
    }
}

impl Track {
    pub(super) fn new(count: usize) -> Self {
        Self {
            places: vec![0.0; count + LANES],
            runs: Vec::new(),
            count,
        }
    }

    /// Finds the targets; returns whether all were found. The last target is at most one turn beyond the first, and [`LANES`]
    /// further numbers follow it.
    #[inline]
    pub(super) fn find<const C: usize, G: Monotone>(
        &mut self,
        growth: Monotonicity<'_, G>,
        targets: &[f64],
    ) -> bool {
        let whole = growth.whole();
        let (mut panel, mut turns) = growth.start(targets[0]);
        self.runs.clear();
        let mut first = 0;
        for _ in 0..growth.panels.len() + 2 {
            let high = growth.ends[panel + 1] + turns * whole;
            let inside = targets[first..self.count]
                .iter()
                .take_while(|&&target| target < high);
            let end = first + inside.count();
            if end > first {
                self.runs.push(Run {
                    panel,
                    turns,
                    targets: first..end,
                });
                self.solve::<C, _>(growth, targets);
            }
            first = end;
            if first == self.count {
                return true;
            }
            panel += 1;
            if panel == growth.panels.len() {
                panel = 0;
                turns += 1.0;
            }
        }
        false
    }

    /// Solves each target of the last run by one step of Halley's method. The first guess is the quintic that has the values
    /// and two derivatives of the inverse function at the panel's ends. If a step is too long to be the last, more steps follow.
    #[inline]
    fn solve<const C: usize, G: Monotone>(&mut self, growth: Monotonicity<'_, G>, targets: &[f64]) {
        let Some(run) = self.runs.last() else { return };
        let panel = &growth.panels[run.panel];
        let shift = run.turns * growth.whole();
        let (low, high) = (growth.ends[run.panel], growth.ends[run.panel + 1]);
        let width = high - low;
        let guess = inverse_quintic([-1.0, 1.0].map(|end| {
            let evaluation = growth.of.evaluate::<C, _>(panel, end);
            let slope = width / evaluation.rate;
            [slope, -slope * slope * evaluation.change / evaluation.rate]
        }));
        let scale = f64x4::from(1.0 / width);
        let mut long = f64x4::from(0.0);
        for start in run.targets.clone().step_by(LANES) {
            // Lanes beyond the run's last target are limited to the panel's end.
            let target = (lanes(targets, start) - f64x4::from(shift)).fast_min(f64x4::from(high));
            let u = (target - f64x4::from(low)) * scale;
            let s = guess
                .into_iter()
                .rev()
                .fold(f64x4::ZERO, |s, c| s * u + f64x4::from(c));
            let step = growth.of.evaluate::<C, _>(panel, s).step(target);
            long |= !step.abs().simd_lt(f64x4::from(LAST));
            self.places[start..start + LANES].copy_from_slice((s + step).as_array());
        }
        if long.any() {
            for i in run.targets.clone() {
                self.places[i] = growth.place::<C>(run.panel, targets[i] - shift);
            }
        }
    }

    /// Evaluates an increasing function at every target, with `first` and the increase of all whole turns added.
    #[inline]
    pub(super) fn map<const C: usize, G: Monotone>(
        &self,
        growth: Monotonicity<'_, G>,
        first: f64,
        out: &mut [f64],
    ) {
        for run in &self.runs {
            let panel = &growth.panels[run.panel];
            let added = f64x4::from(first + run.turns * growth.whole());
            for start in run.targets.clone().step_by(LANES) {
                let places = lanes(&self.places, start);
                let value = growth.of.evaluate::<C, _>(panel, places).value + added;
                out[start..start + LANES].copy_from_slice(value.as_array());
            }
        }
    }

    /// The parameter of a target.
    pub(super) fn param(&self, index: usize) -> Param {
        let after = self.runs.partition_point(|run| run.targets.start <= index);
        let run = &self.runs[after.max(1) - 1];
        Param {
            panel: run.panel,
            s: self.places[index],
            turns: run.turns,
        }
    }
}

/// Loads [`LANES`] numbers from an index on.
#[inline]
pub(super) fn lanes(all: &[f64], start: usize) -> f64x4 {
    f64x4::from(std::array::from_fn::<_, LANES, _>(|lane| all[start + lane]))
}
