//! Greatest values of functions that are smooth between known places.

use centrode_geometry::bracketed_minimum;

/// A greatest or least value and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Where: an input, rad.
    pub input: f64,
    /// The value there.
    pub value: f64,
}

/// Looks between two neighbouring places: a motion law has a few extremes on each.
const LOOKS: u32 = 48;

/// The greatest value of `f` over the range from the first to the last of `ends`, between which it is
/// smooth; at an end the limit from inside counts.
pub(crate) fn greatest(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let mut best = Extreme {
        input: ends.first().copied().unwrap_or(0.0),
        value: f64::NEG_INFINITY,
    };
    let mut take = |input: f64, value: f64| {
        if value > best.value {
            best = Extreme { input, value };
        }
    };
    for pair in ends.windows(2) {
        let last = pair[1].next_down();
        let at =
            |i: u32| (pair[0] + (pair[1] - pair[0]) * f64::from(i) / f64::from(LOOKS)).min(last);
        let values: Vec<f64> = (0..=LOOKS).map(|i| f(at(i))).collect();
        for (i, &value) in (0..).zip(&values) {
            take(at(i), value);
            let before = values.get((i as usize).wrapping_sub(1));
            let after = values.get(i as usize + 1);
            let is_peak = before.is_none_or(|&v| v <= value) && after.is_none_or(|&v| v <= value);
            if is_peak && (before.is_some_and(|&v| v < value) || after.is_some_and(|&v| v < value))
            {
                let (low, high) = (at(i.saturating_sub(1)), at((i + 1).min(LOOKS)));
                let (input, value) = bracketed_minimum(|x| -f(x), low, high);
                take(input, -value);
            }
        }
    }
    best
}

/// The least value, likewise.
pub(crate) fn least(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let Extreme { input, value } = greatest(|x| -f(x), ends);
    Extreme {
        input,
        value: -value,
    }
}
