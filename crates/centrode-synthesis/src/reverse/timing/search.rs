use std::sync::Arc;

use centrode_geometry::checkpoint;

use super::order::{Placed, Swing};
use super::{Course, Required, Timing, TimingError};
use crate::reverse::curvature::curvatures;
use centrode_kinematics::transmission::Transmission;

/// Samples per free stretch.
const SAMPLES: u32 = 48;
/// First and last step of the search, and maximum number of rounds.
const STEPS: [f64; 2] = [0.25, 1e-3];
const ROUNDS: u32 = 200;
/// Maximum share of half a rest that the stretch next to it may use.
const MAX_SHARE: f64 = 0.95;
/// Maximum skew in either direction.
const MAX_SKEW: f64 = 4.0;

/// Free numbers of a section and of the stretch after it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct StretchShape {
    /// Shares of the two halves of a rest, from the ends of its band, through which the crank turns before and after the section.
    pub(super) late: f64,
    pub(super) early: f64,
    /// Measure by which the logarithm of the speed is greater in the second half of the stretch after the section.
    pub(super) skew: f64,
}

/// One of the numbers of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Late,
    Early,
    Skew,
}

const NUMBERS: [Number; 3] = [Number::Late, Number::Early, Number::Skew];

impl StretchShape {
    /// The shape with a number increased by a step, within the limits of the number.
    fn moved(mut self, number: Number, by: f64) -> Self {
        match number {
            Number::Late => self.late = (self.late + by).clamp(0.0, MAX_SHARE),
            Number::Early => self.early = (self.early + by).clamp(0.0, MAX_SHARE),
            Number::Skew => self.skew = (self.skew + by).clamp(-MAX_SKEW, MAX_SKEW),
        }
        self
    }
}

/// The law with the pitch curves of minimum curvature, and its maximum convex curvature for a centre distance of 1, which comes first.
///
/// For every free number a larger and a smaller value is tried, with smaller and smaller steps.
pub(super) fn mildest(
    output: &Arc<dyn Transmission>,
    swing: &Swing,
    placed: &[Placed<'_>],
) -> Result<(f64, Timing), TimingError> {
    let mut shapes = vec![StretchShape::default(); placed.len()];
    let made = |shapes: &[StretchShape]| {
        let law = Timing::through(output, swing, placed, shapes)?;
        Ok::<_, TimingError>((sharpest(&law), law))
    };
    let mut best = made(&shapes);
    let mut step = STEPS[0];
    for _ in 0..ROUNDS {
        let mut is_better = false;
        let moves = (0..placed.len()).flat_map(|i| NUMBERS.map(|number| (i, number)));
        let moves = moves.flat_map(|(i, number)| [step, -step].map(|by| (i, number, by)));
        for (i, number, by) in moves {
            checkpoint();
            let rests = matches!(placed[i].section.required, Required::Rest(_));
            let moved = shapes[i].moved(number, by);
            if moved == shapes[i] || (number != Number::Skew && !rests) {
                continue;
            }
            let mut tried = shapes.clone();
            tried[i] = moved;
            let found = made(&tried);
            let blunter = match (&found, &best) {
                (Ok(found), Ok(best)) => found.0 < best.0,
                (found, best) => found.is_ok() && best.is_err(),
            };
            if blunter {
                (best, shapes, is_better) = (found, tried, true);
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

/// Maximum convex curvature of both pitch curves; where the output moves evenly no shape changes it.
fn sharpest(law: &Timing) -> f64 {
    let speeds = law
        .stretches
        .iter()
        .flat_map(|stretch| match &stretch.course {
            Course::Free(free) => {
                let share = |i: u32| f64::from(i) / f64::from(SAMPLES);
                (0..=SAMPLES).map(|i| free.speed(share(i))).collect()
            }
            Course::Turn => {
                let rate = law.jet(stretch, stretch.within[0]).velocity;
                vec![[rate.ln(), 0.0, 0.0]]
            }
            Course::Even(_) => Vec::new(),
        });
    let curves = speeds.flat_map(|w| curvatures(w).map(|(kappa, _)| kappa));
    curves.fold(0.0, f64::max)
}
