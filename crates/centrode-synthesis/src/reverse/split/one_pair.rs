use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{bracketed_root, checkpoint};

use super::conjugacy::{Conjugacy, MIN_DIVISOR};
use super::{Split, SplitError, SplitKind};
use crate::reverse::TwoBar;
use centrode_kinematics::machine::Piecewise;
use centrode_kinematics::transmission::Transmission as _;

/// Maximum denominator of a fraction near which no law is searched, and the distance from it, turns.
const MAX_DENOMINATOR: i64 = 11;
const NEAREST: f64 = 1e-3;
/// Maximum denominator of a fraction exactly at which no law is searched: harmonics that matter are not determined there.
const CLOSED: u32 = 314;
/// Steps of the orbits by which the offset is searched, and of the orbit that gives the first guess of the law.
const SAMPLES: u32 = 4_000;
/// Steps of the grids on which the law is searched; each starts from the result of the grid before. The last is for rough laws
/// only.
const GRIDS: [usize; 4] = [1 << 10, 1 << 13, 1 << 15, 1 << 17];
/// Number of nodes of an interpolating polynomial.
const LOCAL: usize = 6;
/// Number of positions at which the law is checked; maximum error, rad; and error below which no finer grid is tried, rad.
const CHECKS: u32 = 2_000;
const MAX_MISS: f64 = 1e-7;
const FINE: f64 = 1e-11;

/// Splits into one pair twice: `f(G(psi) + offset) = f(psi) - c` with c = bend + pi, an equation of Abel.
///
/// f makes the map G + offset of the circle a rotation by -c, so the rotation number of the map must be -c. The rotation number
/// grows with the offset; a first offset is searched by averages along orbits, weighted by exp(-1/(t (1 - t))) (Das, Saiki,
/// Sander and Yorke, Nonlinearity 30, 2017). Along an orbit f falls by c in each step, so its points give a first guess of the
/// inverse of f. Newton steps on the harmonics of this inverse and on the offset then refine it to rounding. They divide by
/// `e^(i k c) - 1`: near a fraction with the denominator k digits are lost, and at a fraction only the smoothest law can be
/// found.
pub(super) fn split(chain: &TwoBar, bend: f64) -> Result<Split, SplitError> {
    let turns = (bend + PI) / TAU;
    if let Some((numerator, denominator)) = fraction_near(turns) {
        let miss = (turns - numerator as f64 / denominator as f64).abs();
        return Err(SplitError::Resonance {
            turns,
            numerator,
            denominator,
            miss,
        });
    }
    let law = chain.law()?;
    let required = -(bend + PI);
    let mut map = CircleMap { law, offset: 0.0 };
    let offset = map.offset_for(required);
    map.offset = offset;
    let guess = map.guess(required, GRIDS[0]);
    let mut found = Conjugacy::new(required, offset, &guess);
    let map = |x: f64| map.law.at(x).position;
    let mut best: Option<(f64, f64, Nodes)> = None;
    for (level, count) in GRIDS.into_iter().enumerate() {
        found = found.finer(count);
        let rough = found.refine(map);
        if level + 2 < GRIDS.len() {
            continue;
        }
        let Some(nodes) = Nodes::new(&found.rests) else {
            break;
        };
        let check = |i: u32| {
            let x = TAU * f64::from(i) / f64::from(CHECKS);
            (nodes.at(map(x) + found.offset) - nodes.at(x) - required).abs()
        };
        let miss = (0..CHECKS).map(check).fold(0.0, f64::max);
        if best.as_ref().is_none_or(|(minimum, ..)| miss < *minimum) {
            best = Some((miss, found.offset, nodes));
        }
        // A finer grid does not reduce an error that is left at the grid's own points.
        if miss <= FINE || rough > FINE {
            break;
        }
    }
    match best {
        Some((miss, offset, nodes)) if miss <= MAX_MISS => {
            let law: super::StageLaw = Arc::new(move |x| nodes.at(x));
            Ok(Split {
                kind: SplitKind::OnePair,
                bend,
                first: Arc::clone(&law),
                second: law,
                planet_offset: offset,
                idler_offset: 0.0,
                miss,
            })
        }
        best => {
            let (numerator, denominator) = convergent(turns);
            Err(SplitError::Inexact {
                turns,
                miss: best.map_or(f64::INFINITY, |(miss, ..)| miss),
                numerator,
                denominator,
            })
        }
    }
}

/// The total law plus an offset, as a map of the circle onto itself.
struct CircleMap {
    law: Piecewise,
    offset: f64,
}

impl CircleMap {
    fn at(&self, x: f64) -> f64 {
        self.law.at(x).position + self.offset
    }

    /// Rotation number, rad per step: weighted average of the steps of an orbit.
    fn rotation(&self, steps: u32) -> f64 {
        let (mut moved, mut weights) = (0.0, 0.0);
        let mut x = 0.0;
        for k in 0..steps {
            if k.is_multiple_of(1024) {
                checkpoint();
            }
            let t = (f64::from(k) + 0.5) / f64::from(steps);
            let weight = (-1.0 / (t * (1.0 - t))).exp();
            let next = self.at(x);
            moved += weight * (next - x);
            weights += weight;
            x = next.rem_euclid(TAU);
        }
        moved / weights
    }

    /// Inverse of the law minus its argument at equal steps of a turn, interpolated linearly between the points of an orbit.
    fn guess(&self, step: f64, count: usize) -> Vec<f64> {
        let mut x = 0.0;
        let mut turned = 0.0;
        let mut nodes: Vec<(f64, f64)> = Vec::with_capacity(SAMPLES as usize + 2);
        for k in 0..SAMPLES {
            nodes.push((x, f64::from(k) * step - turned));
            let next = self.at(x);
            let whole = (next / TAU).floor() * TAU;
            (x, turned) = (next - whole, turned + whole);
        }
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        // If the rotation number is slightly different, the points of the orbit are not quite in order.
        let mut reached = f64::NEG_INFINITY;
        for (_, f) in &mut nodes {
            reached = reached.max(*f);
            *f = reached;
        }
        let shifted = |(x, f): (f64, f64), turns: f64| (x + turns * TAU, f + turns * TAU);
        let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
        nodes.insert(0, shifted(last, -1.0));
        nodes.push(shifted(first, 1.0));
        let start = nodes[0].1;
        let at = |i: usize| {
            let theta = TAU * i as f64 / count as f64;
            let turns = ((theta - start) / TAU).floor();
            let inside = theta - turns * TAU;
            let after = nodes.partition_point(|node| node.1 <= inside);
            let after = after.clamp(1, nodes.len() - 1);
            let ((x, f), (x2, f2)) = (nodes[after - 1], nodes[after]);
            let share = if f2 > f { (inside - f) / (f2 - f) } else { 0.0 };
            x + share.clamp(0.0, 1.0) * (x2 - x) - inside
        };
        (0..count).map(at).collect()
    }

    /// Offset at which the rotation number is the one required, rad.
    fn offset_for(&self, required: f64) -> f64 {
        let shift = |i: u32| {
            let x = TAU * f64::from(i) / f64::from(CHECKS);
            self.law.at(x).position - x
        };
        let shifts = (0..CHECKS).map(shift);
        let (low, high) = shifts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
            (low.min(s), high.max(s))
        });
        // At the lower end every step is below the required one, at the upper end above it.
        let room = 1e-3 * TAU;
        let [low, high] = [required - high - room, required - low + room];
        let miss = |offset: f64| {
            let map = CircleMap {
                law: self.law.clone(),
                offset,
            };
            map.rotation(SAMPLES) - required
        };
        bracketed_root(miss, low, high, miss(low), miss(high))
    }
}

/// Law at samples of the turn.
struct Nodes {
    /// Positions, with some repeated a turn before and after.
    places: Vec<f64>,
    /// Law minus its argument at these positions.
    rests: Vec<f64>,
}

impl Nodes {
    /// From the inverse of the law minus its argument at equal steps of a turn; `None` if the inverse turns back.
    fn new(inverse: &[f64]) -> Option<Self> {
        let count = inverse.len();
        let theta = |i: usize| TAU * i as f64 / count as f64;
        let place = |i: usize| theta(i) + inverse[i % count];
        if !(0..count).all(|i| place(i + 1) > place(i)) {
            return None;
        }
        let mut nodes: Vec<(f64, f64)> = inverse
            .iter()
            .enumerate()
            .map(|(i, rest)| (place(i).rem_euclid(TAU), -rest))
            .collect();
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let turn = |i: isize| {
            let (x, rest) = nodes[i.rem_euclid(count as isize) as usize];
            (x + i.div_euclid(count as isize) as f64 * TAU, rest)
        };
        let margin = LOCAL as isize;
        let (places, rests) = (-margin..count as isize + margin).map(turn).unzip();
        Some(Self { places, rests })
    }

    /// Law at any angle, interpolated by Neville's scheme through the nearest nodes.
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

/// The fraction with a small denominator near a number of turns, or with a larger denominator equal to it within rounding.
fn fraction_near(turns: f64) -> Option<(i64, i64)> {
    let nearest = |q: i64| (turns * q as f64).round() as i64;
    let off = |q: i64| (turns - nearest(q) as f64 / q as f64).abs();
    let is_near = |q: &i64| off(*q) < NEAREST;
    let is_at = |q: &i64| TAU * off(*q) * (*q as f64) < MIN_DIVISOR;
    let near = (1..=MAX_DENOMINATOR).find(is_near);
    let q = near.or_else(|| (1..=i64::from(CLOSED)).find(is_at))?;
    Some((nearest(q), q))
}

/// Convergents of the continued fraction with denominators up to 10,000.
fn convergents(turns: f64) -> Vec<(i64, i64)> {
    const MAXIMUM: i64 = 10_000;
    let (mut before, mut last) = ((1, 0), (turns.floor() as i64, 1));
    let mut found = vec![last];
    loop {
        let (p, q) = last;
        // The convergent equals the number within rounding.
        let off = (turns - p as f64 / q as f64).abs();
        if off < 1e-14 * turns.abs().max(1.0) {
            return found;
        }
        let (p0, q0) = before;
        // Ratio of the errors of the last two convergents.
        let miss = |p: i64, q: i64| (turns * q as f64 - p as f64).abs();
        let a = (miss(p0, q0) / miss(p, q)).floor();
        if a.is_nan() || a >= MAXIMUM as f64 {
            return found;
        }
        let a = a as i64;
        (before, last) = (last, (a * p + p0, a * q + q0));
        if last.1 > MAXIMUM {
            return found;
        }
        found.push(last);
    }
}

/// The convergent with the smallest error relative to its denominator.
fn convergent(turns: f64) -> (i64, i64) {
    let closeness = |(p, q): &(i64, i64)| (turns * *q as f64 - *p as f64).abs() * *q as f64;
    let all = convergents(turns).into_iter();
    let nearest = all.min_by(|a, b| closeness(a).total_cmp(&closeness(b)));
    nearest.unwrap_or((turns.round() as i64, 1))
}
