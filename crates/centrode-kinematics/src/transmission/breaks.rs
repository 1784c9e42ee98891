//! Inputs at which a derivative of a motion jumps.

use std::f64::consts::TAU;

use centrode_geometry::{bracketed_root, piece_ends};

use super::Transmission;

/// Parts of a turn of the input. A motion is assumed to pass a position at most once in each part.
const PARTS: u32 = 720;
/// Maximum rounding error of a position at the ends of a period, relative to the cycle or to the position.
const ROUNDING: f64 = 1e-13;

/// Breaks of a motion over a period that is a whole number of the motion's own periods.
pub fn repeated(law: &(impl Transmission + ?Sized), period: f64) -> Vec<f64> {
    let (own, jumps) = (law.period(), law.breaks());
    let repeats = (period / own).round().max(1.0) as u32;
    let shifted = |i: u32| jumps.iter().map(move |jump| jump + f64::from(i) * own);
    (0..repeats).flat_map(shifted).collect()
}

/// Inputs of a period, ascending, at which a position equals one of `values` plus a whole number of cycles.
///
/// The position is smooth but for `breaks`, and repeats with the period up to whole cycles.
pub fn crossings(
    position: impl Fn(f64) -> f64,
    values: &[f64],
    cycle: f64,
    period: f64,
    breaks: &[f64],
) -> Vec<f64> {
    let mut found = Vec::new();
    if values.is_empty() {
        return found;
    }
    let parts = PARTS * (period / TAU).round().max(1.0) as u32;
    let ends = piece_ends(0.0, period, parts, breaks);
    let mut before = position(0.0);
    for pair in ends.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let after = position(to);
        // Inside the period, neighbouring parts share a sample; at the ends of the period rounding may leave a gap between them.
        let margin = if from == 0.0 || to == period {
            ROUNDING * cycle.max(before.abs()).max(after.abs())
        } else {
            0.0
        };
        let range = before.min(after) - margin..before.max(after) + margin;
        for value in values {
            let number = |at: f64| ((at - value) / cycle).round() as i64;
            // One more cycle on either side: rounding must not hide a value that is met exactly at a sample.
            let numbers = number(range.start) - 1..=number(range.end) + 1;
            let met = numbers.map(|n| value + cycle * n as f64);
            for at in met.filter(|at| range.contains(at)) {
                let [low, high] = [before - at, after - at];
                found.push(match low * high > 0.0 {
                    true if low.abs() < high.abs() => from,
                    true => to,
                    false => bracketed_root(|input| position(input) - at, from, to, low, high),
                });
            }
        }
        before = after;
    }
    found
        .iter_mut()
        .for_each(|input| *input = input.rem_euclid(period));
    sorted(found.into_iter(), period)
}

/// Ascending breaks, without those that differ by rounding only.
pub fn sorted(breaks: impl Iterator<Item = f64>, period: f64) -> Vec<f64> {
    let mut breaks: Vec<f64> = breaks.collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|b, a| *b - *a <= 1e-12 * period);
    if breaks.len() > 1 && breaks[0] + period - breaks[breaks.len() - 1] <= 1e-12 * period {
        breaks.pop();
    }
    breaks
}

#[cfg(test)]
mod tests {
    use super::crossings;
    use std::f64::consts::TAU;

    #[test]
    fn a_place_met_where_the_period_begins_is_met_once_either_way_round() {
        for sign in [1.0, -1.0] {
            for start in [0.25, 0.25 - 1e-16, 0.25 + 1e-16] {
                let position = |t: f64| start + sign * 3.0 * t;
                let found = crossings(position, &[0.25], TAU, TAU, &[]);
                assert_eq!(found.len(), 3, "{sign} {start} {found:?}");
                for (i, input) in found.iter().enumerate() {
                    let off = input - TAU / 3.0 * i as f64;
                    assert!(off.abs().min(TAU - off.abs()) < 1e-14);
                }
            }
        }
    }

    #[test]
    fn nothing_is_met_without_values() {
        assert!(crossings(|t| t, &[], TAU, TAU, &[]).is_empty());
    }
}
