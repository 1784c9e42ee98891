use crate::bracketed_minimum;

/// A greatest or least value of a function and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Argument of the function.
    pub input: f64,
    /// The value there.
    pub value: f64,
}

/// Samples a piece, among which each local extreme is bracketed: a smooth piece has a few.
const SAMPLES: u32 = 48;

/// Ends of pieces of an interval: those of `count` even parts and the breaks inside, ascending.
#[must_use]
pub fn pieces(from: f64, to: f64, count: u32, breaks: &[f64]) -> Vec<f64> {
    let even = |i: u32| from + (to - from) * f64::from(i) / f64::from(count.max(1));
    let mut ends: Vec<f64> = (0..count.max(1)).map(even).collect();
    ends.extend(breaks.iter().filter(|&&b| b > from && b < to));
    ends.push(to);
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    ends
}

/// The greatest value of each of several functions that are evaluated together, over the range from the first to
/// the last of `ends`, between which they are smooth.
///
/// Every local extreme among the samples of a piece is refined by Brent's method: the value is exact to the float
/// limit, the input to its square root where the function is smooth. At a break both limits count. A value that is
/// no number never counts; where there is none at all the value is minus infinity.
pub fn greatest_each<const N: usize>(f: impl Fn(f64) -> [f64; N], ends: &[f64]) -> [Extreme; N] {
    let start = Extreme {
        input: ends.first().copied().unwrap_or(0.0),
        value: f64::NEG_INFINITY,
    };
    let mut best = [start; N];
    for pair in ends.windows(2) {
        let last = pair[1].next_down();
        let at = |i: u32| {
            let share = f64::from(i) / f64::from(SAMPLES);
            (pair[0] + (pair[1] - pair[0]) * share).min(last)
        };
        let values: Vec<[f64; N]> = (0..=SAMPLES).map(|i| f(at(i))).collect();
        for (k, best) in best.iter_mut().enumerate() {
            let mut take = |input: f64, value: f64| {
                if value > best.value {
                    *best = Extreme { input, value };
                }
            };
            for (i, sample) in (0..).zip(&values) {
                take(at(i), sample[k]);
                let beside = [i.checked_sub(1), Some(i + 1)]
                    .map(|j| j.and_then(|j| values.get(j as usize)).map(|v| v[k]));
                let is_peak = beside.iter().flatten().all(|&v| v <= sample[k]);
                if is_peak && beside.iter().flatten().any(|&v| v < sample[k]) {
                    let (low, high) = (at(i.saturating_sub(1)), at((i + 1).min(SAMPLES)));
                    let (input, value) = bracketed_minimum(|x| -f(x)[k], low, high);
                    take(input, -value);
                }
            }
        }
    }
    best
}

/// The greatest value of a function over the range of `ends`, between which it is smooth; see [`greatest_each`].
pub fn greatest(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let [greatest] = greatest_each(|x| [f(x)], ends);
    greatest
}

/// The least value of a function over the range of `ends`, between which it is smooth; see [`greatest_each`].
pub fn least(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let Extreme { input, value } = greatest(|x| -f(x), ends);
    Extreme {
        input,
        value: -value,
    }
}

/// The least and the greatest value of a function over the range of `ends`, between which it is smooth; see
/// [`greatest_each`].
pub fn extremes(f: impl Fn(f64) -> f64, ends: &[f64]) -> [Extreme; 2] {
    let both = |x: f64| {
        let value = f(x);
        [-value, value]
    };
    let [mut least, greatest] = greatest_each(both, ends);
    least.value = -least.value;
    [least, greatest]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn extremes_of_waves_are_exact() {
        let f = |x: f64| (7.0 * x).sin() + 0.1 * (x - 2.0);
        // Where 7 cos 7x = -0.1, the last peak and the first trough.
        let turn = (-0.1_f64 / 7.0).acos();
        let [low, high] = extremes(f, &pieces(0.0, TAU, 4, &[]));
        let peak = (turn + 6.0 * TAU) / 7.0;
        let trough = (TAU - turn) / 7.0;
        assert!((high.value - f(peak)).abs() < 1e-15 && (high.input - peak).abs() < 1e-7);
        assert!((low.value - f(trough)).abs() < 1e-15 && (low.input - trough).abs() < 1e-7);
        assert_eq!(greatest(f, &pieces(0.0, TAU, 4, &[])), high);
        assert_eq!(least(f, &pieces(0.0, TAU, 4, &[])), low);
    }

    #[test]
    fn both_limits_at_a_break_count() {
        let saw = |x: f64| x - x.floor();
        let [low, high] = extremes(saw, &pieces(0.0, 3.0, 1, &[1.0, 2.0, 7.0]));
        assert_eq!(low.value, 0.0);
        assert_eq!(high.value, 1.0_f64.next_down());
    }

    #[test]
    fn functions_evaluated_together_have_their_own_places() {
        let f = |x: f64| [x.cos(), x.sin(), f64::NAN];
        let [a, b, none] = greatest_each(f, &pieces(-1.0, 4.0, 3, &[]));
        assert!(a.input.abs() < 1e-7 && (b.input - 0.5 * PI).abs() < 1e-7);
        assert_eq!(
            [a.value, b.value, none.value],
            [1.0, 1.0, f64::NEG_INFINITY]
        );
    }
}
