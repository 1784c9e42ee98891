use crate::numeric::{bracketed_minimum, rounding};

/// A maximum or minimum of a function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// Argument of the function.
    pub input: f64,
    /// Value of the function at that argument.
    pub value: f64,
}

/// Samples per piece. Each local extreme of a smooth piece must show among them: with a tenth, narrow peaks are missed;
/// with ten times as many, every search takes ten times as long.
const SAMPLES: usize = 48;
/// Minimum number of samples per piece of a range with pieces of different length.
const MIN_SAMPLES: usize = 12;

/// Ends of the pieces of an interval, ascending: those of `count` equal parts, and the breaks inside.
#[must_use]
pub fn piece_ends(from: f64, to: f64, count: u32, breaks: &[f64]) -> Vec<f64> {
    let even = |i: u32| from + (to - from) * f64::from(i) / f64::from(count.max(1));
    let mut ends: Vec<f64> = (0..count.max(1)).map(even).collect();
    ends.extend(breaks.iter().filter(|&&b| b > from && b < to));
    ends.push(to);
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    ends
}

/// Maximum of each of several functions that one call evaluates, over the range from the first to the last of `ends`.
///
/// The functions are smooth between neighbouring ends; see [`maxima`].
pub fn maximum_of_each<const N: usize>(f: impl Fn(f64) -> [f64; N], ends: &[f64]) -> [Extreme; N] {
    let all = |x: f64, values: &mut Vec<f64>| values.extend(f(x));
    let found = sampled_maxima(
        N,
        all,
        |k, x| f(x)[k],
        |_, v| rounding(v),
        &parts(ends, |_| SAMPLES),
    );
    std::array::from_fn(|k| found[k])
}

/// Maximum of each of `count` functions over the range from the first to the last of `ends`.
///
/// The functions are smooth between neighbouring ends.
/// - `all` appends the value of every function at an argument to a list;
/// - `one` returns the value of one function;
/// - `noise` returns the rounding error of a function near a value: [`rounding`] if it is computed without loss.
///
/// The longest piece has 48 samples, a shorter one fewer, down to 12. Brent's method refines the local maxima among
/// the samples of a piece: the value is exact to the float limit, the input of a smooth function to its square root. A
/// local maximum is not refined if several times the height of the parabola through its samples, or of a kink between
/// them, does not reach the maximum sample. At a break both limits count. A value that is not a number never counts; if
/// there is no other, the result is minus infinity.
pub fn maxima(
    count: usize,
    all: impl Fn(f64, &mut Vec<f64>),
    one: impl Fn(usize, f64) -> f64,
    noise: impl Fn(usize, f64) -> f64,
    ends: &[f64],
) -> Vec<Extreme> {
    let lengths = ends.windows(2).map(|pair| pair[1] - pair[0]);
    let longest = lengths.fold(0.0, f64::max);
    let samples = |length: f64| (SAMPLES as f64 * length / longest).ceil() as usize;
    let parts = parts(ends, |length| samples(length).max(MIN_SAMPLES));
    sampled_maxima(count, all, one, noise, &parts)
}

/// A piece of a range on which a function is smooth, sampled in equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledPiece {
    /// Start of the piece.
    pub from: f64,
    /// End of the piece.
    pub to: f64,
    /// Number of steps, one less than the number of samples.
    pub steps: usize,
}

impl SampledPiece {
    /// Argument of sample `i`, counted from 0. The last one is the limit at the end.
    #[must_use]
    pub fn at(&self, i: usize) -> f64 {
        let share = i as f64 / self.steps as f64;
        (self.from + (self.to - self.from) * share).min(self.to.next_down())
    }
}

/// The pieces between neighbouring ends; `steps` returns the number of steps for a length.
fn parts(ends: &[f64], steps: impl Fn(f64) -> usize) -> Vec<SampledPiece> {
    let part = |pair: &[f64]| SampledPiece {
        from: pair[0],
        to: pair[1],
        steps: steps(pair[1] - pair[0]),
    };
    ends.windows(2).map(part).collect()
}

/// Samples `count` functions on all pieces and refines their maxima.
fn sampled_maxima(
    count: usize,
    all: impl Fn(f64, &mut Vec<f64>),
    one: impl Fn(usize, f64) -> f64,
    noise: impl Fn(usize, f64) -> f64,
    parts: &[SampledPiece],
) -> Vec<Extreme> {
    let total: usize = parts.iter().map(|part| part.steps + 1).sum();
    let mut values = Vec::with_capacity(total * count);
    for part in parts {
        crate::checkpoint();
        (0..=part.steps).for_each(|i| all(part.at(i), &mut values));
    }
    let of_function = |k: usize| {
        let samples: Vec<f64> = values.iter().skip(k).step_by(count).copied().collect();
        maximum_of_samples(&samples, |x| one(k, x), |value| noise(k, value), parts)
    };
    (0..count).map(of_function).collect()
}

/// Maximum of a function whose samples are known, piece by piece.
///
/// Its local maxima are refined as in [`maxima`]; `noise` returns the rounding error near a value.
pub fn maximum_of_samples(
    samples: &[f64],
    f: impl Fn(f64) -> f64,
    noise: impl Fn(f64) -> f64,
    parts: &[SampledPiece],
) -> Extreme {
    let mut best = Extreme {
        input: parts.first().map_or(0.0, |part| part.from),
        value: f64::NEG_INFINITY,
    };
    let mut take = |input: f64, value: f64| {
        if value > best.value {
            best = Extreme { input, value };
        }
        best.value
    };
    let known = samples.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut rest = samples;
    for part in parts {
        let (own, after) = rest.split_at(part.steps + 1);
        rest = after;
        for (i, &sample) in own.iter().enumerate() {
            let reached = take(part.at(i), sample).max(known);
            let Some(above) = peak(own, i) else {
                continue;
            };
            if sample + above <= reached + noise(reached) {
                continue;
            }
            let [low, high] = [i.saturating_sub(1), (i + 1).min(part.steps)].map(|i| part.at(i));
            let (input, value) = bracketed_minimum(|x| -f(x), low, high);
            take(input, -value);
        }
    }
    best
}

/// Maximum height of the function above a sample that is a local maximum of its piece; `None` for any other sample.
///
/// The estimate is eight times the height of the parabola through three samples, or twice that of a kink.
fn peak(samples: &[f64], i: usize) -> Option<f64> {
    let sample = samples[i];
    let neighbours = [i.checked_sub(1), Some(i + 1)].map(|j| samples.get(j?).copied());
    let is_peak = neighbours.iter().flatten().all(|&v| v <= sample)
        && neighbours.iter().flatten().any(|&v| v < sample);
    if !is_peak {
        return None;
    }
    match neighbours {
        [Some(before), Some(after)] => Some(2.0 * sample - before - after),
        _ => {
            let inwards = |step: usize| samples[if i == 0 { step } else { i - step }];
            let [next, second] = [1, 2].map(inwards);
            Some((sample - 2.0 * next + second).abs() + (sample - next))
        }
    }
}

/// Maximum of a function over the range of `ends`, between which it is smooth; see [`maximum_of_each`].
pub fn maximum(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let [maximum] = maximum_of_each(|x| [f(x)], ends);
    maximum
}

/// Minimum of a function over the range of `ends`, between which it is smooth; see [`maximum_of_each`].
pub fn minimum(f: impl Fn(f64) -> f64, ends: &[f64]) -> Extreme {
    let Extreme { input, value } = maximum(|x| -f(x), ends);
    Extreme {
        input,
        value: -value,
    }
}

/// Minimum and maximum of a function over the range of `ends`, between which it is smooth; see [`maximum_of_each`].
pub fn extremes(f: impl Fn(f64) -> f64, ends: &[f64]) -> [Extreme; 2] {
    let both = |x: f64| {
        let value = f(x);
        [-value, value]
    };
    let [mut minimum, maximum] = maximum_of_each(both, ends);
    minimum.value = -minimum.value;
    [minimum, maximum]
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
        let [low, high] = extremes(f, &piece_ends(0.0, TAU, 4, &[]));
        let peak = (turn + 6.0 * TAU) / 7.0;
        let trough = (TAU - turn) / 7.0;
        assert!((high.value - f(peak)).abs() < 1e-15 && (high.input - peak).abs() < 1e-7);
        assert!((low.value - f(trough)).abs() < 1e-15 && (low.input - trough).abs() < 1e-7);
        assert_eq!(maximum(f, &piece_ends(0.0, TAU, 4, &[])), high);
        assert_eq!(minimum(f, &piece_ends(0.0, TAU, 4, &[])), low);
    }

    #[test]
    fn the_highest_of_near_peaks_is_found_whichever_sample_is_highest() {
        // A sharp peak of height 1 moves between samples, near a flat peak that is a little lower.
        for i in 0..40 {
            let at = 1.0 + 0.002 * f64::from(i);
            for width in [0.03, 0.1, 0.3] {
                let bell =
                    |x: f64, middle: f64, width: f64| (-((x - middle) / width).powi(2)).exp();
                let f = |x: f64| bell(x, at, width) + 0.995 * bell(x, 3.0, 0.6);
                let found = maximum(f, &piece_ends(0.0, 4.0, 4, &[]));
                assert!((found.input - at).abs() < 1e-2, "{at} {width}: {found:?}");
                assert!(found.value >= f(at) - 1e-15, "{at} {width}: {found:?}");
            }
            let kink = |x: f64| (0.3 - (x - at).abs()).max(0.299 - 0.01 * (x - 3.0).powi(2));
            let found = maximum(kink, &piece_ends(0.0, 4.0, 4, &[]));
            assert!((found.value - 0.3).abs() < 1e-10, "{at}: {found:?}");
        }
    }

    #[test]
    fn a_function_that_is_noise_is_not_refined() {
        let calls = std::cell::Cell::new(0);
        let noise = |x: f64| {
            calls.set(calls.get() + 1);
            1.0 + f64::EPSILON * (1e6 * x).sin().round()
        };
        let found = maximum(noise, &piece_ends(0.0, 4.0, 4, &[]));
        assert!((found.value - 1.0).abs() <= 2.0 * f64::EPSILON);
        assert!(calls.get() <= 4 * (SAMPLES + 1), "{}", calls.get());
    }

    #[test]
    fn both_limits_at_a_break_count() {
        let saw = |x: f64| x - x.floor();
        let [low, high] = extremes(saw, &piece_ends(0.0, 3.0, 1, &[1.0, 2.0, 7.0]));
        assert_eq!(low.value, 0.0);
        assert_eq!(high.value, 1.0_f64.next_down());
    }

    #[test]
    fn functions_evaluated_together_have_their_own_maxima() {
        let f = |x: f64| [x.cos(), x.sin(), f64::NAN];
        let [a, b, none] = maximum_of_each(f, &piece_ends(-1.0, 4.0, 3, &[]));
        assert!(a.input.abs() < 1e-7 && (b.input - 0.5 * PI).abs() < 1e-7);
        assert_eq!(
            [a.value, b.value, none.value],
            [1.0, 1.0, f64::NEG_INFINITY]
        );
    }
}
