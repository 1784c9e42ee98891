use std::f64::consts::TAU;

use centrode_geometry::{Extreme, bracketed_minimum, bracketed_root, greatest, pieces};

use super::assembly::{Linkage, Step};
use super::error::LinkageError;
use super::places::Needed;
use super::series::Series;

/// Samples over a turn of the input in the search for where dyads cease to close.
const LOOKS: u32 = 720;
/// Parts of a gap in which the greatest distance between a dyad's ends is looked for.
const PARTS: u32 = 4;

/// The first dyad of a linkage that does not close over the whole cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct NotClosing {
    /// Its number, from 0 in the order of building.
    pub dyad: usize,
    /// Inputs at which it closes, as intervals, ascending, rad.
    pub open: Vec<(f64, f64)>,
    /// Input at which most is missing, rad.
    pub input: f64,
    /// Distance between its ends there, mm; for two parallel guides not finite.
    pub missing: f64,
}

impl Linkage {
    /// Inputs in `[0, period]` at which the linkage closes, as intervals, ascending; the whole cycle for a crank that turns.
    ///
    /// An end that is a limit of the crank is exact to the float limit. Gaps and islands narrower than
    /// half a degree are found where the room of a dyad has its least or greatest value there.
    #[must_use]
    pub fn closing_inputs(&self) -> Vec<(f64, f64)> {
        let mut open = vec![(0.0, self.period)];
        for dyad in 0..self.dyads().count() {
            open = self.opened(dyad, open);
        }
        open
    }

    /// The first dyad that does not close over the whole cycle; none where all do.
    #[must_use]
    pub fn not_closing(&self) -> Option<NotClosing> {
        let whole = vec![(0.0, self.period)];
        let found = (0..self.dyads().count()).find_map(|dyad| {
            let open = self.opened(dyad, whole.clone());
            (open != whole).then_some((dyad, open))
        });
        let (dyad, open) = found?;
        let mut at = 0.0;
        let mut worst = Extreme {
            input: 0.0,
            value: f64::NEG_INFINITY,
        };
        for (low, high) in open.iter().copied().chain([(self.period, self.period)]) {
            if low > at {
                let missing = |input: f64| self.missing(dyad, input);
                let found = greatest(missing, &pieces(at, low, PARTS, &self.breaks));
                worst = if found.value > worst.value {
                    found
                } else {
                    worst
                };
            }
            at = high;
        }
        Some(NotClosing {
            dyad,
            open,
            input: worst.input,
            missing: worst.value,
        })
    }

    /// The parts of intervals on which a dyad closes, where all before it do.
    fn opened(&self, dyad: usize, intervals: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
        let Some(step) = self.dyads().nth(dyad) else {
            return intervals;
        };
        let needed = self.needed_by_dyad(dyad);
        let series = |input: f64| {
            let mut series = Series::<1>::default();
            self.find(input, |part| needed.has(part), &mut series);
            series
        };
        // Two guides close but where they are parallel: on the side on which the cycle begins.
        let side = slant(step, &series(0.0)).map(f64::signum);
        let room = |input: f64| {
            let series = series(input);
            match (side, slant(step, &series)) {
                (Some(side), Some(slant)) => side * slant,
                // Of the dyads that are needed it is the last.
                _ => series.room.last().copied().unwrap_or(f64::NAN),
            }
        };
        let parts = intervals.into_iter();
        parts
            .flat_map(|interval| positive(&room, interval))
            .collect()
    }

    /// The steps on which a dyad depends, itself among them.
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

    /// First input above zero at which the linkage does not close, and the dyad at fault.
    pub(super) fn limit(&self) -> Option<LinkageError> {
        let open = self.closing_inputs();
        let input = match open.first() {
            None => 0.0,
            Some(&(low, _)) if low > 0.0 => 0.0,
            Some(&(_, high)) if high < self.period => high,
            Some(_) => return None,
        };
        let past = if input > 0.0 { input + 1e-9 } else { input };
        let rooms = self.series::<1>(past).room;
        let dyad = rooms.iter().position(|&r| r <= 0.0 || r.is_nan())?;
        let missing = self.missing(dyad, past).max(0.0);
        Some(LinkageError::DoesNotClose {
            dyad,
            input,
            missing,
        })
    }

    /// Sine of the angle at which each dyad holds, in the order of building: 0 where its links are stretched, folded or
    /// slide in vain, 1 where it holds best. The transmission angle is its arc sine.
    ///
    /// Two bars: the angle between them. A bar and a slider: that of the bar with the normal of the guide. A guided link:
    /// that of its guide with the normal of the way from pivot to block. Two guides: the angle between them.
    #[must_use]
    pub fn holds(&self, input: f64) -> Vec<f64> {
        let series = self.series::<1>(input);
        let holds = self.steps.iter();
        holds.filter_map(|step| series.hold(step)).collect()
    }
}

/// Sine of the angle of a dyad's two guides, with its sign; none for another dyad.
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

/// The parts of an interval on which `room` is above zero.
fn positive(room: &dyn Fn(f64) -> f64, (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    let count = (f64::from(LOOKS) * (high - low) / TAU).ceil().max(4.0) as u32;
    let even = |i: u32| low + (high - low) * f64::from(i) / f64::from(count);
    let mut looks: Vec<(f64, f64)> = (0..=count).map(|i| (even(i), room(even(i)))).collect();
    // A gap or an island between two samples shows as an extreme with a change of sign.
    for i in 1..count as usize {
        let [a, b, c] = [looks[i - 1], looks[i], looks[i + 1]];
        let sign = if b.1 > 0.0 { 1.0 } else { -1.0 };
        // Eight times the depth of the parabola through the samples, twice that of a kink.
        let deep = sign * (a.1 - 2.0 * b.1 + c.1);
        let dips = a.1 * sign > b.1 * sign && c.1 * sign >= b.1 * sign && a.1 * sign > 0.0;
        if dips && sign * b.1 <= deep {
            let (at, least) = bracketed_minimum(|x| sign * room(x), a.0, c.0);
            if least < 0.0 {
                looks.push((at, sign * least));
            }
        }
    }
    looks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts = Vec::new();
    let mut start = (looks[0].1 > 0.0).then_some(looks[0].0);
    for pair in looks.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        match (a.1 > 0.0, b.1 > 0.0) {
            (true, false) => {
                let end = bracketed_root(room, a.0, b.0, a.1, b.1);
                parts.extend(start.take().map(|s| (s, end)));
            }
            (false, true) => start = Some(bracketed_root(room, a.0, b.0, a.1, b.1)),
            _ => {}
        }
    }
    parts.extend(start.map(|s| (s, high)));
    parts
}
