use std::sync::Arc;

use centrode_geometry::checkpoint;

use super::order::{Placed, Swing};
use super::{Course, Timing, TimingError, Wanted};
use crate::reverse::curvature::curvatures;
use crate::transmission::Transmission;

/// Looks at a free stretch, and at an even one.
const LOOKS: u32 = 48;
/// First and last step of the search, and greatest number of rounds.
const STEPS: [f64; 2] = [0.25, 1e-3];
const ROUNDS: u32 = 200;
/// Greatest share of a rest's half that is left to the stretch beside it.
const MOST_SHARE: f64 = 0.95;
/// Greatest skew either way.
const MOST_SKEW: f64 = 4.0;

/// Numbers that are free of a section and of the stretch after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shape {
    /// Shares of a rest's halves, from the ends of its band on, through which the crank goes before and after the section.
    pub(super) late: f64,
    pub(super) early: f64,
    /// By how much the logarithm of the speed is greater in the second half of the stretch after it.
    pub(super) skew: f64,
}

/// The law whose pitch curves are blunt: its sharpest convex curvature, of a centre distance of 1, and it.
///
/// Of every number that is free a greater and a less one is tried, with ever smaller steps.
pub(super) fn mildest(
    output: &Arc<dyn Transmission>,
    swing: &Swing,
    placed: &[Placed<'_>],
) -> Result<(f64, Timing), TimingError> {
    let mut shapes = vec![Shape::default(); placed.len()];
    let made = |shapes: &[Shape]| {
        let law = Timing::through(output, swing, placed, shapes)?;
        Ok::<_, TimingError>((sharpest(&law), law))
    };
    let mut best = made(&shapes);
    let mut step = STEPS[0];
    for _ in 0..ROUNDS {
        let mut is_better = false;
        for i in 0..placed.len() {
            let rests = matches!(placed[i].section.wanted, Wanted::Rest(_));
            for number in 0..3 {
                for by in [step, -step] {
                    checkpoint();
                    let mut tried = shapes.clone();
                    let shape = &mut tried[i];
                    match number {
                        0 if rests => shape.late = (shape.late + by).clamp(0.0, MOST_SHARE),
                        1 if rests => shape.early = (shape.early + by).clamp(0.0, MOST_SHARE),
                        2 => shape.skew = (shape.skew + by).clamp(-MOST_SKEW, MOST_SKEW),
                        _ => continue,
                    }
                    let found = made(&tried);
                    let blunter = match (&found, &best) {
                        (Ok(found), Ok(best)) => found.0 < best.0,
                        (found, best) => found.is_ok() && best.is_err(),
                    };
                    if blunter {
                        (best, shapes, is_better) = (found, tried, true);
                    }
                }
            }
        }
        if !is_better {
            step *= 0.5;
            if step < STEPS[1] {
                break;
            }
        }
    }
    best
}

/// Greatest convex curvature of both pitch curves.
fn sharpest(law: &Timing) -> f64 {
    let mut sharpest = 0.0_f64;
    for stretch in &law.stretches {
        let [from, to] = stretch.within;
        for i in 0..=LOOKS {
            let share = f64::from(i) / f64::from(LOOKS);
            let w = match &stretch.course {
                Course::Free(free) => free.speed(share),
                // Its ends are those of free stretches, and its inside no shape changes.
                Course::Even(_) => continue,
                Course::Turn => [
                    law.jet(stretch, from + share * (to - from)).velocity.ln(),
                    0.0,
                    0.0,
                ],
            };
            let both = curvatures(w).map(|(kappa, _)| kappa);
            sharpest = both.into_iter().fold(sharpest, f64::max);
        }
    }
    sharpest
}
