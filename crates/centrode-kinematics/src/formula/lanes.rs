//! Two numbers side by side: every processor computes two at once, and holds the series of a linkage in its registers. Four do
//! not fit there and take twice the time. The result of a number has the same bits for any neighbour.

use wide::f64x2;

use super::number::Number;

/// Count of numbers side by side.
pub(crate) const LANES: usize = 2;

/// Vector of that many numbers.
pub(crate) type Lanes = f64x2;

/// Inputs side by side; the last one pads an incomplete group.
#[inline(always)]
pub(crate) fn groups(inputs: &[f64]) -> impl Iterator<Item = Lanes> + '_ {
    let input = |index: usize| inputs[index.min(inputs.len() - 1)];
    let firsts = (0..inputs.len()).step_by(LANES);
    firsts.map(move |first| Lanes::from(std::array::from_fn(|lane| input(first + lane))))
}

/// Angle below which the vector's own functions subtract whole turns without loss of the last digit, rad.
const FARTHEST: f64 = 100_000.0;

/// Sine and cosine of a number if it or its neighbour is beyond `FARTHEST` or NaN: its bits do not depend on its neighbour.
#[cold]
#[inline(never)]
fn sin_cos_alone(x: f64) -> (f64, f64) {
    if x.abs() < FARTHEST {
        let (sin, cos) = f64x2::from(x).sin_cos();
        (sin.lane(0), cos.lane(0))
    } else {
        x.sin_cos()
    }
}

impl Number for f64x2 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if self.abs().simd_lt(Self::from(FARTHEST)).all() {
            return self.sin_cos();
        }
        let each = self.to_array().map(sin_cos_alone);
        (each.map(|e| e.0).into(), each.map(|e| e.1).into())
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.atan2(x)
    }

    const COUNT: usize = LANES;

    #[inline(always)]
    fn of_lanes(value: impl Fn(usize) -> f64) -> Self {
        Self::from(std::array::from_fn(value))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.as_array()[lane]
    }

    #[inline(always)]
    fn if_below(self, bound: f64, then: f64, otherwise: f64) -> Self {
        let below = self.simd_lt(Self::from(bound));
        below.bitselect(Self::from(then), Self::from(otherwise))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::{prop_assert, proptest};

    use super::{FARTHEST, LANES, Lanes, Number};

    fn lanes(of: [f64; LANES]) -> Lanes {
        Lanes::from(of)
    }

    proptest! {
        #[test]
        fn lanes_turn_as_single_numbers_do(x in proptest::array::uniform2(-300.0..300.0_f64), far in 1.0..1e4_f64) {
            for scale in [1e-3, 0.1, 1.0, far] {
                let inputs = x.map(|x| x * scale);
                let (sin, cos) = Number::sin_cos(lanes(inputs));
                for (lane, input) in inputs.into_iter().enumerate() {
                    let expected = input.sin_cos();
                    let found = (sin.to_array()[lane], cos.to_array()[lane]);
                    prop_assert!((found.0 - expected.0).abs() <= 2.0 * f64::EPSILON * expected.0.abs(), "sin {input}");
                    prop_assert!((found.1 - expected.1).abs() <= 2.0 * f64::EPSILON * expected.1.abs(), "cos {input}");
                }
            }
        }

        #[test]
        fn lanes_point_as_single_numbers_do(
            direction in proptest::array::uniform2(0.0..TAU),
            length in proptest::array::uniform2(1e-9..1e9_f64),
        ) {
            let x: [f64; LANES] = std::array::from_fn(|i| length[i] * direction[i].cos());
            let y: [f64; LANES] = std::array::from_fn(|i| length[i] * direction[i].sin());
            let found = Number::atan2(lanes(y), lanes(x)).to_array();
            for lane in 0..LANES {
                let expected = y[lane].atan2(x[lane]);
                prop_assert!((found[lane] - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{} {}", y[lane], x[lane]);
            }
        }
    }

    #[test]
    fn lanes_are_exact_on_the_axes_and_keep_to_themselves() {
        for (y, x) in [([0.0, 2.0], [5.0, 0.0]), ([0.0, -3.0], [-1.0, 0.0])] {
            let found = Number::atan2(lanes(y), lanes(x)).to_array();
            for lane in 0..LANES {
                assert_eq!(found[lane], y[lane].atan2(x[lane]));
            }
        }
        // Beyond FARTHEST and where there is no value, a lane takes no other with it.
        for inputs in [
            [f64::NAN, 1.0],
            [2.0, f64::INFINITY],
            [1.0, 3.0 * FARTHEST],
            [0.1, -2.0],
        ] {
            let (sin, _) = Number::sin_cos(lanes(inputs));
            for (found, input) in sin.to_array().into_iter().zip(inputs) {
                let bound = 2.0 * f64::EPSILON * input.sin().abs();
                assert!(
                    (found - input.sin()).abs() <= bound || (found.is_nan() && !input.is_finite())
                );
            }
        }
        for (y, x) in [([f64::NAN, 1.0], [1.0, 2.0]), ([1.0; 2], [f64::NAN, 2.0])] {
            let [none, some] = Number::atan2(lanes(y), lanes(x)).to_array();
            assert!(none.is_nan() && (some - 0.5_f64.atan()).abs() < 1e-15);
        }
    }
}
