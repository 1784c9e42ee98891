use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{bracketed_root, checkpoint};

use super::{EXACT, Split, SplitError, SplitKind};
use crate::machine::Piecewise;
use crate::reverse::TwoBar;
use crate::transmission::Transmission as _;

/// Greatest denominator of a fraction near which no law is sought, and how near, in turns.
const GREATEST_DENOMINATOR: i64 = 11;
const NEAREST: f64 = 1e-3;
/// Steps of the orbit by which the offset is sought, and of the one that measures the rotation number found.
const SOUGHT: u32 = 4_000;
const MEASURED: u32 = 100_000;
/// Nodes of the law, about: steps of all orbits.
const NODES: u32 = 20_000;
/// Steps of an orbit: a denominator of a fraction near the rotation number, so that they are spread evenly. Where the rotation
/// number is a fraction itself they are its denominator.
const LONG: i64 = 300;
const SHORT: i64 = 12;
/// Laps of an orbit over which its place in the law is averaged.
const LAPS: u32 = 60;
/// Nodes of an interpolating polynomial.
const LOCAL: usize = 6;
/// Distance of neighbouring nodes that are one, as a share of their mean distance.
const NEAR: f64 = 0.05;
/// Greatest gap of neighbouring nodes: more is an orbit that closes.
const WIDEST: f64 = 0.02;
/// Places at which the law is checked, and its greatest miss, rad.
const CHECKS: u32 = 2_000;
const GREATEST_MISS: f64 = 1e-7;

/// Splits into one pair twice: `f(G(psi) + offset) = f(psi) - c` with c = bend + pi, an equation of Abel.
///
/// f turns the map G + offset of the circle into the turn by -c, so the offset is the one at which the rotation number is -c;
/// it grows with the offset. Along an orbit f falls by c each step; the average of `G^k(x) + k c` gives f at its start, but for
/// one constant. Averages are weighted by exp(-1/(t (1 - t))): for smooth f they converge faster than any power of the number
/// of steps (Das, Saiki, Sander and Yorke, Nonlinearity 30, 2017). Where c is a fraction of a turn many laws do it, if any;
/// the average is the smoothest.
pub(super) fn split(chain: &TwoBar, bend: f64) -> Result<Split, SplitError> {
    let turns = (bend + PI) / TAU;
    let resonance = |(numerator, denominator): (i64, i64)| SplitError::Resonance {
        turns,
        numerator,
        denominator,
        miss: (turns - numerator as f64 / denominator as f64).abs(),
    };
    if let Some(fraction) = fraction_near(turns) {
        return Err(resonance(fraction));
    }
    let law = chain.law()?;
    let wanted = -(bend + PI);
    let mut map = CircleMap { law, offset: 0.0 };
    map.offset = map.offset_for(wanted);
    let step = map.polish(wanted);
    let fraction = convergent(turns);
    let orbits = Orbits::of(&map, step, turns).ok_or_else(|| resonance(fraction))?;
    let check = |i: u32| {
        let x = TAU * f64::from(i) / f64::from(CHECKS);
        (orbits.at(map.at(x)) - orbits.at(x) - wanted).abs()
    };
    let miss = (0..CHECKS).map(check).fold(0.0, f64::max);
    if miss > GREATEST_MISS {
        let (numerator, denominator) = fraction;
        return Err(SplitError::Inexact {
            turns,
            miss,
            numerator,
            denominator,
        });
    }
    let law: super::StageLaw = Arc::new(move |x| orbits.at(x));
    Ok(Split {
        kind: SplitKind::OnePair,
        bend,
        first: Arc::clone(&law),
        second: law,
        planet_offset: map.offset,
        idler_offset: 0.0,
    })
}

/// The total law with an offset, as a map of the circle onto itself.
struct CircleMap {
    law: Piecewise,
    offset: f64,
}

impl CircleMap {
    fn at(&self, x: f64) -> f64 {
        self.law.at(x).position + self.offset
    }

    /// Weighted averages along an orbit, rad: of its steps, which is the rotation number, and of its points less so many times
    /// the step given.
    fn averages(&self, start: f64, steps: u32, step: f64) -> [f64; 2] {
        let (mut moved, mut placed, mut weights) = (0.0, 0.0, 0.0);
        // Place beyond that of an even turn.
        let (mut x, mut beyond) = (start, start);
        for k in 0..steps {
            if k.is_multiple_of(1024) {
                checkpoint();
            }
            let t = (f64::from(k) + 0.5) / f64::from(steps);
            let weight = (-1.0 / (t * (1.0 - t))).exp();
            let next = self.at(x);
            moved += weight * (next - x);
            placed += weight * beyond;
            weights += weight;
            beyond += next - x - step;
            x = next.rem_euclid(TAU);
        }
        [moved / weights, placed / weights]
    }

    /// Rotation number, rad a step.
    fn rotation(&self, steps: u32) -> f64 {
        self.averages(0.0, steps, 0.0)[0]
    }

    /// Brings the rotation number nearer to the one wanted by secant steps over many more points; returns what it is.
    fn polish(&mut self, wanted: f64) -> f64 {
        let mut slope = 1.0;
        let mut now = self.rotation(MEASURED);
        for _ in 0..2 {
            let (before, offset) = (now, self.offset);
            self.offset -= (now - wanted) / slope;
            now = self.rotation(MEASURED);
            let moved = self.offset - offset;
            if moved.abs() <= 4.0 * f64::EPSILON * TAU || now == before {
                break;
            }
            if ((now - before) / moved) > 0.0 {
                slope = (now - before) / moved;
            }
        }
        now
    }

    /// Offset at which the rotation number is the one wanted, rad.
    fn offset_for(&self, wanted: f64) -> f64 {
        let shift = |i: u32| {
            let x = TAU * f64::from(i) / f64::from(CHECKS);
            self.law.at(x).position - x
        };
        let shifts = (0..CHECKS).map(shift);
        let (low, high) = shifts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
            (low.min(s), high.max(s))
        });
        // At the ends every step is at most, or at least, the one wanted.
        let room = 1e-3 * TAU;
        let [low, high] = [wanted - high - room, wanted - low + room];
        let miss = |offset: f64| {
            let map = CircleMap {
                law: self.law.clone(),
                offset,
            };
            map.rotation(SOUGHT) - wanted
        };
        bracketed_root(miss, low, high, miss(low), miss(high))
    }
}

/// Law at the points of some orbits in the order of their places in the turn.
struct Orbits {
    /// Places, with some repeated a turn before and after.
    places: Vec<f64>,
    /// Law less its argument there.
    rests: Vec<f64>,
}

impl Orbits {
    /// None where the points are not dense, or not in the order of the turn by the step.
    fn of(map: &CircleMap, step: f64, turns: f64) -> Option<Self> {
        let length = length(turns)?;
        let first = Self::walk(map, (0.0, 0.0), step, length);
        // Gaps of its points have two sizes or three, of which the greatest is less than any two side by side: orbits that
        // start over the first two gaps leave none.
        let mut ahead: Vec<f64> = first.iter().map(|node| node.0).collect();
        ahead.sort_by(f64::total_cmp);
        let next = *ahead.get(2)?;
        let count = 2 * NODES.div_ceil(length);
        let mut nodes = Vec::with_capacity((count * length) as usize);
        for i in 0..count {
            let x = next * f64::from(i) / f64::from(count);
            let [_, start] = map.averages(x, LAPS * length, step);
            nodes.extend(Self::walk(map, (x, start), step, length));
        }
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Of two that nearly coincide, as where an orbit meets another's start, rounding decides which comes first.
        let near = NEAR * TAU / f64::from(NODES);
        nodes.dedup_by(|b, a| b.0 - a.0 < near);
        let wraps = |nodes: &Vec<(f64, f64)>| {
            let [first, last] = [nodes.first()?, nodes.last()?];
            Some(first.0 + TAU - last.0)
        };
        if wraps(&nodes)? < near {
            nodes.pop();
        }
        let count = nodes.len() as isize;
        if count <= LOCAL as isize {
            return None;
        }
        let turn = |i: isize| {
            let (x, f) = nodes[i.rem_euclid(count) as usize];
            let shift = i.div_euclid(count) as f64 * TAU;
            (x + shift, f + shift)
        };
        let in_order =
            |(a, b): ((f64, f64), (f64, f64))| a.0 < b.0 && a.1 < b.1 && b.0 - a.0 < WIDEST;
        if !(0..count).all(|i| in_order((turn(i), turn(i + 1)))) {
            return None;
        }
        let margin = LOCAL as isize;
        let all = (-margin..count + margin).map(turn);
        let (places, rests) = all.map(|(x, f)| (x, f - x)).unzip();
        Some(Self { places, rests })
    }

    /// Places in the turn and the law there along an orbit.
    fn walk(map: &CircleMap, (start, law): (f64, f64), step: f64, length: u32) -> Vec<(f64, f64)> {
        let (mut x, mut turns) = (start, 0.0);
        let mut node = |k: u32| {
            if k.is_multiple_of(1024) {
                checkpoint();
            }
            let here = (x, law + f64::from(k) * step - TAU * turns);
            let next = map.at(x);
            let whole = (next / TAU).floor();
            (x, turns) = (next - whole * TAU, turns + whole);
            here
        };
        (0..length).map(&mut node).collect()
    }

    /// Law at any angle: by Neville's scheme through the nodes nearest to it.
    fn at(&self, x: f64) -> f64 {
        let inside = x.rem_euclid(TAU);
        let after = self.places.partition_point(|&p| p <= inside);
        let most = self.places.len() - LOCAL;
        let first = after.saturating_sub(LOCAL / 2).min(most);
        let places = &self.places[first..first + LOCAL];
        let mut values = [0.0; LOCAL];
        values.copy_from_slice(&self.rests[first..first + LOCAL]);
        for level in 1..LOCAL {
            for i in 0..LOCAL - level {
                let (a, b) = (places[i], places[i + level]);
                values[i] += (values[i + 1] - values[i]) * ((inside - a) / (b - a));
            }
        }
        x + values[0]
    }
}

/// The fraction with a small denominator within reach of a number of turns.
fn fraction_near(turns: f64) -> Option<(i64, i64)> {
    let near = |q: &i64| (turns - (turns * *q as f64).round() / *q as f64).abs() < NEAREST;
    let q = (1..=GREATEST_DENOMINATOR).find(near)?;
    Some(((turns * q as f64).round() as i64, q))
}

/// Convergents of the continued fraction with denominators up to 10,000.
fn convergents(turns: f64) -> Vec<(i64, i64)> {
    const GREATEST: i64 = 10_000;
    let (mut before, mut last) = ((1, 0), (turns.floor() as i64, 1));
    let mut found = vec![last];
    loop {
        let (p, q) = last;
        // Within rounding it is the number itself.
        let off = (turns - p as f64 / q as f64).abs();
        if off < 1e-14 * turns.abs().max(1.0) {
            return found;
        }
        let (p0, q0) = before;
        // By how much the last two miss it, over each other.
        let miss = |p: i64, q: i64| (turns * q as f64 - p as f64).abs();
        let a = (miss(p0, q0) / miss(p, q)).floor();
        if a.is_nan() || a >= GREATEST as f64 {
            return found;
        }
        let a = a as i64;
        (before, last) = (last, (a * p + p0, a * q + q0));
        if last.1 > GREATEST {
            return found;
        }
        found.push(last);
    }
}

/// The convergent that is nearest for its size.
fn convergent(turns: f64) -> (i64, i64) {
    let closeness = |(p, q): &(i64, i64)| (turns * *q as f64 - *p as f64).abs() * *q as f64;
    let all = convergents(turns).into_iter();
    let nearest = all.min_by(|a, b| closeness(a).total_cmp(&closeness(b)));
    nearest.unwrap_or((turns.round() as i64, 1))
}

/// Steps of an orbit that spreads evenly over the turn, if there is one.
fn length(turns: f64) -> Option<u32> {
    let all = convergents(turns);
    let (p, q) = *all.last()?;
    let length = if (turns - p as f64 / q as f64).abs() < EXACT {
        q
    } else {
        all.iter().map(|c| c.1).find(|&q| q >= LONG).unwrap_or(q)
    };
    (length >= SHORT).then_some(length as u32)
}
