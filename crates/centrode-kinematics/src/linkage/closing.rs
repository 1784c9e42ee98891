use std::f64::consts::TAU;

use centrode_geometry::{Extreme, bracketed_minimum, bracketed_root, maximum, piece_ends};

use super::assembly::{Linkage, Step};
use super::error::LinkageError;
use super::places::Needed;
use super::series::{Series, SeriesItem};

/// Samples per turn of the input in the search for the inputs at which dyads cease to close.
const SAMPLES: u32 = 720;
/// Parts of a gap in which the maximum missing distance is searched.
const PARTS: u32 = 4;
/// Squared sine of the transmission angle below which it counts as zero: at an angle below 2e-4 deg both branches of a dyad meet.
/// Ten times more calls linkages flat that just close; ten times less takes rounding of long chains for gaps.
const FLAT: f64 = 1e-11;
/// Distance from the end of the cycle within which a change point is moved to input 0, rad: an extreme is found to the square
/// root of rounding.
const NEAR: f64 = 1e-6;

/// Intervals of inputs, ascending, rad.
type Intervals = Vec<(f64, f64)>;

/// A dyad of a linkage that does not close over the whole cycle, or whose branches meet.
#[derive(Clone, Debug, PartialEq)]
pub struct NotClosing {
    /// Its number, from 0 in the order of building.
    pub dyad: usize,
    /// Inputs at which it closes, as intervals, ascending, rad; for a dyad that depends on others, only where these close.
    pub open: Vec<(f64, f64)>,
    /// Change points, rad: inputs at which its links lie in one line and both its branches meet, or its two guides are parallel,
    /// while it closes on either side.
    pub change_points: Vec<f64>,
    /// Input at which the missing distance is largest, or the first change point if none is missing, rad.
    pub input: f64,
    /// Distance that is missing there for it to close, mm: 0 if its links lie in one line; infinite for two parallel guides.
    pub missing: f64,
}

/// Where a dyad closes.
#[derive(Default)]
struct Closing {
    /// Inputs at which all dyads close on which it depends.
    given: Intervals,
    open: Intervals,
    change_points: Vec<f64>,
    /// Whether at some input it does not close, even flat.
    misses: bool,
}

impl Linkage {
    /// Inputs in `[0, period]` at which the linkage closes, as intervals, ascending; the whole cycle for a crank that turns.
    ///
    /// An end that is a limit of the crank is exact to the float limit. Gaps and islands narrower than half a degree are found if
    /// the discriminant of a dyad has its minimum or maximum in them. A change point, where both branches of a dyad meet, is no
    /// gap: see [`not_closing`](Self::not_closing).
    #[must_use]
    pub fn closing_inputs(&self) -> Vec<(f64, f64)> {
        let whole = vec![(0.0, self.period)];
        let closing = self.closing().into_iter();
        closing.fold(whole, |open, dyad| common(&open, &dyad.open))
    }

    /// The dyads that do not close over the whole cycle, or that have change points, in the order of building; empty if each
    /// dyad has one branch over the whole cycle.
    #[must_use]
    pub fn not_closing(&self) -> Vec<NotClosing> {
        let closing = self.closing().into_iter().enumerate();
        let failing = closing.filter(|(_, c)| c.open != c.given || !c.change_points.is_empty());
        let described = failing.map(|(dyad, closing)| self.described(dyad, closing));
        described.collect()
    }

    /// Describes where a dyad does not close: the input at which the missing distance is largest, and that distance.
    fn described(&self, dyad: usize, closing: Closing) -> NotClosing {
        let missing = |input: f64| self.missing(dyad, input).max(0.0);
        let gaps = gaps(&closing.given, &closing.open).into_iter();
        let found =
            gaps.map(|(low, high)| maximum(missing, &piece_ends(low, high, PARTS, &self.breaks)));
        let worst = found.reduce(|worst, found| {
            if found.value > worst.value {
                found
            } else {
                worst
            }
        });
        let first = closing.change_points.first().copied().unwrap_or(0.0);
        let is_of_guides = missing(first).is_infinite();
        let worst = worst.unwrap_or(Extreme {
            input: first,
            value: missing(first),
        });
        NotClosing {
            dyad,
            open: closing.open,
            change_points: closing.change_points,
            input: worst.input,
            missing: if closing.misses || is_of_guides {
                worst.value
            } else {
                0.0
            },
        }
    }

    /// Where each dyad closes, in the order of building.
    fn closing(&self) -> Vec<Closing> {
        let mut all: Vec<Closing> = Vec::new();
        let steps = self.steps.iter().enumerate();
        let numbers: Vec<usize> = steps.filter(|(_, s)| s.is_dyad()).map(|(i, _)| i).collect();
        for (dyad, step) in self.dyads().enumerate() {
            let needed = self.needed_by_dyad(dyad);
            let before = all.iter().zip(&numbers);
            let before = before.filter(|(_, number)| needed.has(SeriesItem::Step(**number)));
            let whole = vec![(0.0, self.period)];
            let given = before.fold(whole, |given, (dyad, _)| common(&given, &dyad.open));
            let level = self.level(step, &needed);
            let mut closing = Closing {
                given,
                ..Closing::default()
            };
            for &interval in &closing.given {
                let cycle = (interval == (0.0, self.period)).then_some(self.period);
                let found = found_in(&level, interval, cycle);
                closing.open.extend(found.open);
                closing.change_points.extend(found.change_points);
                closing.misses |= found.misses;
            }
            all.push(closing);
        }
        all
    }

    /// Margin with which a dyad closes at an input: the square of the sine of its transmission angle, below zero where it does
    /// not close. For two guides: the sine of their angle, above zero on the side on which the cycle begins.
    fn level<'a>(&'a self, step: &'a Step, needed: &'a Needed) -> impl Fn(f64) -> f64 + use<'a> {
        let series = |input: f64| {
            let mut series = Series::<1>::default();
            self.find(input, |part| needed.has(part), &mut series);
            series
        };
        // This dyad is the last of the needed ones.
        let room = |series: &Series<1>| series.room.last().copied().unwrap_or(f64::NAN);
        let inputs = || (0..SAMPLES).map(|i| self.period * f64::from(i) / f64::from(SAMPLES));
        // If the guides are parallel at the start, the side is that of the first input at which they are not.
        let mut slants = inputs().map_while(|input| slant(step, &series(input)));
        let side = slants
            .find(|slant| slant.abs() > FLAT)
            .map_or(1.0, f64::signum);
        let scale = match step {
            Step::Rrr { lengths, .. } => 4.0 * (lengths.0 * lengths.1).powi(2),
            Step::Rrp { length, .. } => length * length,
            Step::Rpr { offset, .. } => {
                let reach = inputs().map(|input| room(&series(input)));
                offset * offset + reach.fold(0.0, f64::max)
            }
            _ => 1.0,
        };
        move |input: f64| {
            let series = series(input);
            let level = slant(step, &series).map(|slant| side * slant);
            level.unwrap_or_else(|| room(&series) / scale)
        }
    }

    /// The steps on which a dyad depends, including its own.
    fn needed_by_dyad(&self, dyad: usize) -> Needed {
        let (mut link, mut before) = (1, 0);
        for step in &self.steps {
            if step.is_dyad() {
                if before == dyad {
                    break;
                }
                before += 1;
            }
            link += step.makes()[0];
        }
        self.needed_among(&[link])
    }

    /// First input at which the linkage does not close or a dyad has a change point, and the dyad at fault.
    pub(super) fn limit(&self) -> Option<LinkageError> {
        let limits = self.not_closing().into_iter().map(|found| {
            let stop = match found.open.first() {
                Some(&(0.0, high)) => high,
                _ => 0.0,
            };
            let flat = found.change_points.first().copied();
            (found.dyad, stop, flat.unwrap_or(f64::INFINITY))
        });
        let (dyad, stop, flat) = limits.min_by(|a, b| a.1.min(a.2).total_cmp(&b.1.min(b.2)))?;
        Some(match stop < flat.min(self.period) {
            true => LinkageError::DoesNotClose {
                dyad,
                input: stop,
                missing: if stop > 0.0 {
                    0.0
                } else {
                    self.missing(dyad, stop).max(0.0)
                },
            },
            false => LinkageError::Flat { dyad, input: flat },
        })
    }

    /// Transmission angle of each dyad, in the order of building, rad: a right angle where force is transmitted best, 0 where its
    /// links are stretched, folded or slide without effect, and for two bars also pi.
    ///
    /// Two bars: the angle between them at their joint, from 0 to pi. The others are angles between lines, from 0 to a right
    /// angle. A bar and a slider: that of the bar with the normal of the guide. A guided link: that of its guide with the normal
    /// of the line from pivot to block. Two guides: the angle between them.
    #[must_use]
    pub fn transmission_angles(&self, input: f64) -> Vec<f64> {
        let series = self.series::<1>(input);
        let steps = self.steps.iter();
        steps
            .filter_map(|step| series.holding_angle(step))
            .collect()
    }

    /// Sine of the [transmission angle](Self::transmission_angles) of each dyad: 1 where force is transmitted best.
    #[must_use]
    pub fn holds(&self, input: f64) -> Vec<f64> {
        let angles = self.transmission_angles(input).into_iter();
        angles.map(f64::sin).collect()
    }
}

/// Sine of the angle of a dyad's two guides, with its sign; `None` for another dyad.
fn slant(step: &Step, series: &Series<1>) -> Option<f64> {
    match step {
        Step::Prp {
            lines: (one, other),
        } => {
            let (_, e) = series.line(one);
            let (_, f) = series.line(other);
            Some(e.cross(f).0[0])
        }
        _ => None,
    }
}

/// Inputs that are in both of two lists of intervals.
fn common(one: &Intervals, other: &Intervals) -> Intervals {
    let pairs = one
        .iter()
        .flat_map(|a| other.iter().map(move |b| (a.0.max(b.0), a.1.min(b.1))));
    pairs.filter(|(low, high)| low < high).collect()
}

/// Parts of `intervals` that are not in `open`, whose intervals lie within them.
fn gaps(intervals: &Intervals, open: &Intervals) -> Intervals {
    let mut gaps = Vec::new();
    for &(low, high) in intervals {
        let mut at = low;
        for &(from, to) in open.iter().filter(|(from, to)| *from >= low && *to <= high) {
            gaps.push((at, from));
            at = to;
        }
        gaps.push((at, high));
    }
    gaps.retain(|(low, high)| low < high);
    gaps
}

/// Closing of a dyad in an interval.
#[derive(Default)]
struct Found {
    open: Intervals,
    change_points: Vec<f64>,
    /// Whether at some input it does not close, even flat.
    misses: bool,
}

/// The parts of an interval on which `level` is above zero, and the inputs at which it only touches zero.
///
/// `cycle` is the period if the interval is the whole cycle and so has no ends.
fn found_in(level: &dyn Fn(f64) -> f64, (low, high): (f64, f64), cycle: Option<f64>) -> Found {
    let count = (f64::from(SAMPLES) * (high - low) / TAU).ceil().max(4.0) as usize;
    let step = (high - low) / count as f64;
    let look = |i: usize| {
        let input = match i == count {
            true => high,
            false => low + step * i as f64,
        };
        (input, level(input))
    };
    let mut looks: Vec<(f64, f64)> = (0..=count).map(look).collect();
    if let Some(period) = cycle {
        from_best(&mut looks, period);
    }
    let [start, end] = [looks[0].0, looks[count].0];
    looks.extend(dips(level, &looks));
    // Exactly at the end of an interval, a dyad before this one may fail to close.
    looks.retain(|(_, level)| !level.is_nan());
    looks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let edge = |above: (f64, f64), other: (f64, f64)| match other.1 > 0.0 {
        true => other.0,
        false => bracketed_root(level, above.0, other.0, above.1, other.1),
    };
    let mut found = Found::default();
    let mut from = Some(start);
    let runs: Vec<&[(f64, f64)]> = looks
        .chunk_by(|a, b| (a.1 > FLAT) == (b.1 > FLAT))
        .collect();
    for (i, run) in runs.iter().enumerate().filter(|(_, run)| run[0].1 <= FLAT) {
        let [before, after] = [i.checked_sub(1), Some(i + 1)].map(|j| runs.get(j?));
        let (one, other) = (run[0], run[run.len() - 1]);
        let is_flat = run.iter().all(|(_, level)| *level >= -FLAT);
        found.misses |= !is_flat;
        if is_flat && other.0 - one.0 <= 2.0 * step && before.is_some() && after.is_some() {
            let lowest = run.iter().min_by(|a, b| a.1.total_cmp(&b.1));
            found.change_points.extend(lowest.map(|(input, _)| *input));
            continue;
        }
        let end = before.map(|run| edge(run[run.len() - 1], one));
        found.open.extend(from.take().zip(end));
        from = after.map(|run| edge(run[0], other));
    }
    found.open.extend(from.map(|from| (from, end)));
    match cycle {
        Some(period) => found.within(period),
        None => found,
    }
}

/// Shifts the samples of a cycle so that they begin where a dyad closes best, or worst if it closes nowhere: then no dip lies
/// across the ends.
fn from_best(looks: &mut Vec<(f64, f64)>, period: f64) {
    let by_level = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let best = looks.iter().max_by(by_level).copied();
    let first = best.filter(|best| best.1 > FLAT);
    let Some(first) = first.or(looks.iter().min_by(by_level).copied()) else {
        return;
    };
    looks.pop();
    let before = looks.iter().take_while(|look| look.0 < first.0).count();
    let shifted: Vec<_> = looks[..before]
        .iter()
        .map(|(x, y)| (x + period, *y))
        .collect();
    looks.drain(..before);
    looks.extend(shifted);
    looks.push((first.0 + period, first.1));
}

/// Extremes of a function between samples where it may change its sign or touch zero.
fn dips(level: &dyn Fn(f64) -> f64, looks: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let dip = |looks: &[(f64, f64)]| {
        let [a, b, c] = [looks[0], looks[1], looks[2]];
        let sign = if b.1 > 0.0 { 1.0 } else { -1.0 };
        // Eight times the maximum depth of a parabola through the samples below the middle one; twice that of a kink.
        let deep = sign * (a.1 - 2.0 * b.1 + c.1);
        let dips = a.1 * sign > b.1 * sign && c.1 * sign >= b.1 * sign && a.1 * sign > 0.0;
        if !dips || sign * b.1 > deep.max(FLAT) {
            return None;
        }
        let (at, minimum) = bracketed_minimum(|x| sign * level(x), a.0, c.0);
        (minimum < FLAT).then_some((at, sign * minimum))
    };
    looks.windows(3).filter_map(dip).collect()
}

impl Found {
    /// Shifts the results of a cycle that began at another input than 0 into `[0, period]`.
    fn within(mut self, period: f64) -> Self {
        let parts = self.open.into_iter().flat_map(|(low, high)| {
            [
                (low, high.min(period)),
                ((low - period).max(0.0), high - period),
            ]
        });
        let mut parts: Intervals = parts.filter(|(low, high)| low < high).collect();
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.open = Vec::new();
        for (low, high) in parts {
            match self.open.last_mut() {
                Some(last) if low - last.1 <= NEAR * NEAR => last.1 = high,
                _ => self.open.push((low, high)),
            }
        }
        for input in &mut self.change_points {
            *input = input.rem_euclid(period);
            if period - *input < NEAR {
                *input = 0.0;
            }
        }
        self.change_points.sort_by(f64::total_cmp);
        self
    }
}
