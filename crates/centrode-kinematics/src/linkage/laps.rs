use std::f64::consts::{PI, TAU};

use crate::formula::{Number, Taylor};

/// Unwraps principal angles into [middle - pi, middle + pi): adds `before` below `cut` and `after` above it, both multiples of 2
/// pi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unwrap {
    cut: f64,
    before: f64,
    after: f64,
}

impl Unwrap {
    pub(super) fn about(middle: f64) -> Self {
        // The range begins at middle - pi, a number of turns after its principal value.
        let turns = (middle / TAU).floor();
        Self {
            cut: middle - PI - TAU * turns,
            before: TAU * (turns + 1.0),
            after: TAU * turns,
        }
    }

    #[inline(always)]
    pub(super) fn unwrapped<const N: usize, T: Number>(
        &self,
        direction: Taylor<N, T>,
    ) -> Taylor<N, T> {
        let mut angle = direction;
        let principal = direction.0[0];
        angle.0[0] = principal + principal.if_below(self.cut, self.before, self.after);
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::{PI, TAU, Taylor, Unwrap};

    #[test]
    fn directions_lie_within_half_a_turn_of_the_middle() {
        for middle in [-9.5, -PI, -1.0, 0.0, 0.3, 3.0, PI, 4.0, 6.0, TAU, 40.0] {
            for i in -31..=31 {
                let angle: f64 = middle + 0.1 * f64::from(i);
                let direction = Taylor([angle.sin().atan2(angle.cos())]);
                let [unwrapped] = Unwrap::about(middle).unwrapped(direction).0;
                assert!(
                    (unwrapped - angle).abs() < 1e-13,
                    "{middle} {angle}: {unwrapped}"
                );
            }
        }
    }
}
