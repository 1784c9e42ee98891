//! The mean ratio of a law: that of samples is scaled to the mean ratio of the pair.

use super::{MeanScaling, PitchError};

/// Largest number of turns in the mean ratio of a law.
const MAX_TURNS: u32 = 60;

/// Maximum relative change of samples to the mean ratio: a measured table is off by a few percent. Ten times more accepts a
/// wrong column, ten times less refuses digitised curves.
pub(super) const MOST_SCALING: f64 = 0.05;

/// Relative difference of two mean ratios up to which they are equal: rounding.
const EQUAL_RATIO: f64 = 1e-9;

/// Maximum number of turns of the nearest simple ratio, for samples without a given mean ratio. With more, almost every mean is
/// near a ratio.
const SIMPLE_TURNS: u32 = 12;

/// Turns of the driven gear per turn of the driver.
pub(super) fn driven_turns((driver, driven): (u32, u32)) -> f64 {
    f64::from(driven) / f64::from(driver)
}

/// The ratio of small whole numbers nearest to the driven turns of one driver turn.
pub(super) fn nearest_ratio(turns: f64) -> (u32, u32) {
    let candidates = (1..=SIMPLE_TURNS).map(|driver| {
        let driven = (turns * f64::from(driver)).round();
        (driver, driven.clamp(1.0, SIMPLE_TURNS.into()) as u32)
    });
    let miss = |ratio: (u32, u32)| (driven_turns(ratio) - turns).abs();
    candidates
        .min_by(|&a, &b| miss(a).total_cmp(&miss(b)))
        .unwrap_or((1, 1))
}

/// Scaling of samples with a mean ratio to that of the pair, or to the nearest simple one, and its factor. There is none within
/// rounding, and none for the simple mean ratio of another pair.
pub(super) fn scaling(
    key: &'static str,
    mean: f64,
    ratio: Option<(u32, u32)>,
) -> Result<(Option<MeanScaling>, f64), PitchError> {
    let exact = turns(key, mean).ok();
    let ratio = ratio.or(exact).unwrap_or_else(|| nearest_ratio(mean));
    let factor = driven_turns(ratio) / mean;
    if (factor - 1.0).abs() <= EQUAL_RATIO {
        return Ok((None, 1.0));
    }
    if (factor - 1.0).abs() <= MOST_SCALING {
        let scaling = MeanScaling {
            mean,
            factor,
            ratio,
        };
        return Ok((Some(scaling), factor));
    }
    match exact {
        Some((driver, driven)) if driver.max(driven) <= SIMPLE_TURNS => Ok((None, 1.0)),
        _ => Err(PitchError::MeanOff {
            key,
            mean,
            ratio,
            limit: MOST_SCALING,
        }),
    }
}

/// Turns of driver and driven gear, in lowest terms, if the driven gear makes `turns` turns per driver turn.
pub(super) fn turns(key: &'static str, turns: f64) -> Result<(u32, u32), PitchError> {
    for driver in 1..=MAX_TURNS {
        let driven = (turns * f64::from(driver)).round();
        if driven >= 1.0
            && driven <= MAX_TURNS.into()
            && (turns * f64::from(driver) - driven).abs() <= 1e-9 * driven
        {
            return Ok((driver, driven as u32));
        }
    }
    let limit = MAX_TURNS;
    Err(PitchError::RatioNotRational { key, turns, limit })
}
