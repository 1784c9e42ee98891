//! Four numbers side by side: processors work on two or four at once, and on the next while one waits. Sums, products, quotients and roots alone, each rounded by itself: every processor finds
//! the same bits.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, FRAC_PI_8, PI};

use wide::f64x4;

use super::number::Number;

/// Numbers side by side.
pub(crate) const LANES: usize = 4;

/// Vector of that many numbers.
pub(crate) type Lanes = f64x4;

/// Inputs side by side; the last one pads an incomplete group.
#[inline(always)]
pub(crate) fn groups(inputs: &[f64]) -> impl Iterator<Item = Lanes> + '_ {
    let input = |index: usize| inputs[index.min(inputs.len() - 1)];
    let firsts = (0..inputs.len()).step_by(LANES);
    firsts.map(move |first| Lanes::from(std::array::from_fn(|lane| input(first + lane))))
}

/// Magic number that rounds: added and subtracted again it leaves a whole number, halves to the even one.
const ROUNDING: f64 = 6_755_399_441_055_744.0;
/// Greatest angle with less than 2^16 quarter turns, whose number times the first part of one is exact.
const FARTHEST: f64 = 100_000.0;
/// A quarter turn in parts of 33, 20 and 53 bits.
const QUARTER: [f64; 3] = {
    let high = f64::from_bits(FRAC_PI_2.to_bits() & !0xF_FFFF);
    [high, FRAC_PI_2 - high, 6.123_233_995_736_766e-17]
};

/// (1 - sin r / r) / r² and (1 - cos r) / r² in powers of -r², an even number of them: up to an eighth of a turn the rest is below 1e-18.
const SINE: [f64; 8] = inverse_factorials(3);
const COSINE: [f64; 8] = inverse_factorials(2);
/// (1 - atan t / t) / t² in powers of -t²: up to tan(pi/16) the rest is below 1e-17.
const ARCTANGENT: [f64; 10] = {
    let mut c = [0.0; 10];
    let mut k = 0;
    while k < c.len() {
        c[k] = 1.0 / (2 * k + 3) as f64;
        k += 1;
    }
    c
};

/// Coefficients 1 / first!, 1 / (first + 2)! and so on.
const fn inverse_factorials(first: usize) -> [f64; 8] {
    let mut c = [0.0; 8];
    let (mut factorial, mut n, mut k) = (1.0, 1, 0);
    while k < c.len() {
        while n <= first + 2 * k {
            factorial *= n as f64;
            n += 1;
        }
        c[k] = 1.0 / factorial;
        k += 1;
    }
    c
}

const TAN_PI_16: f64 = 0.198_912_367_379_658;
const TAN_3_PI_16: f64 = 0.668_178_637_919_298_9;
const SIN_PI_8: f64 = 0.382_683_432_365_089_8;
const COS_PI_8: f64 = 0.923_879_532_511_286_7;

/// Sum of `c[k]` (-z)^k: even and odd powers apart, two short chains instead of a long one.
#[inline(always)]
fn alternating<const COUNT: usize>(c: [f64; COUNT], z: f64x4) -> f64x4 {
    let zz = z * z;
    let (mut even, mut odd) = (f64x4::from(c[COUNT - 2]), f64x4::from(c[COUNT - 1]));
    for pair in c[..COUNT - 2].rchunks_exact(2) {
        even = f64x4::from(pair[0]) + zz * even;
        odd = f64x4::from(pair[1]) + zz * odd;
    }
    even - z * odd
}

/// Nearest whole number of each lane.
#[inline(always)]
fn whole(x: f64x4) -> f64x4 {
    let shift = f64x4::from(ROUNDING);
    (x + shift) - shift
}

#[inline(always)]
fn near_sin_cos(x: f64x4) -> (f64x4, f64x4) {
    let n = whole(x * FRAC_2_PI);
    let r = QUARTER.into_iter().fold(x, |r, part| r - n * part);
    let z = r * r;
    let sin = r - r * z * alternating(SINE, z);
    let cos = f64x4::ONE - z * alternating(COSINE, z);
    // n = 2 half + odd, half = 2 turns + opposite; odd and opposite are -1, 0 or 1.
    let half = whole(n * 0.5);
    let odd = n - (half + half);
    let turns = whole(half * 0.5);
    let opposite = half - (turns + turns);
    let sign = f64x4::ONE - (opposite + opposite) * opposite;
    let even = odd.simd_eq(f64x4::ZERO);
    (
        sign * even.bitselect(sin, odd * cos),
        sign * even.bitselect(cos, -(odd * sin)),
    )
}

/// The sine and cosine of a number beside which one is far away or none: its bits do not depend on its neighbour.
#[cold]
#[inline(never)]
fn sin_cos_alone(x: f64) -> (f64, f64) {
    if x.abs() < FARTHEST {
        let (sin, cos) = near_sin_cos(x.into());
        (sin.lane(0), cos.lane(0))
    } else {
        x.sin_cos()
    }
}

impl Number for f64x4 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if self.abs().simd_lt(Self::from(FARTHEST)).all() {
            return near_sin_cos(self);
        }
        let each = self.to_array().map(sin_cos_alone);
        (each.map(|e| e.0).into(), each.map(|e| e.1).into())
    }

    /// Two-argument arctangent: a series from the octant's start, middle or end, whichever is nearest.
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (across, along) = (self.abs(), x.abs());
        let steep = across.simd_gt(along);
        let (high, low) = (
            steep.bitselect(across, along),
            steep.bitselect(along, across),
        );
        let inside = (high * TAN_PI_16).simd_lt(low);
        let beyond = (high * TAN_3_PI_16).simd_lt(low);
        let nearest = |start: f64, middle: f64, end: f64| {
            let first = inside.bitselect(Self::from(middle), Self::from(start));
            beyond.bitselect(Self::from(end), first)
        };
        let sin = nearest(0.0, SIN_PI_8, FRAC_1_SQRT_2);
        let cos = nearest(1.0, COS_PI_8, FRAC_1_SQRT_2);
        let t = (low * cos - high * sin) / (high * cos + low * sin);
        let z = t * t;
        let angle = nearest(0.0, FRAC_PI_8, FRAC_PI_4) + (t - t * z * alternating(ARCTANGENT, z));
        let angle = steep.bitselect(Self::from(FRAC_PI_2) - angle, angle);
        let angle = x
            .simd_lt(Self::ZERO)
            .bitselect(Self::from(PI) - angle, angle);
        self.simd_lt(Self::ZERO).bitselect(-angle, angle)
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
        fn lanes_turn_as_single_numbers_do(x in proptest::array::uniform4(-300.0..300.0_f64), far in 1.0..1e4_f64) {
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
            direction in proptest::array::uniform4(0.0..TAU),
            length in proptest::array::uniform4(1e-9..1e9_f64),
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
        let (y, x) = ([0.0, 2.0, 0.0, -3.0], [5.0, 0.0, -1.0, 0.0]);
        let found = Number::atan2(lanes(y), lanes(x)).to_array();
        for lane in 0..LANES {
            assert_eq!(found[lane], y[lane].atan2(x[lane]));
        }
        // Beyond FARTHEST and where there is no value, a lane takes no other with it.
        for inputs in [
            [f64::NAN, 1.0, 2.0, f64::INFINITY],
            [1.0, 3.0 * FARTHEST, 0.1, -2.0],
        ] {
            let (sin, _) = Number::sin_cos(lanes(inputs));
            for (found, input) in sin.to_array().into_iter().zip(inputs) {
                assert!(found == input.sin() || (found.is_nan() && !input.is_finite()));
            }
        }
        let (y, x) = ([f64::NAN, 1.0, 1.0, 1.0], [1.0, 2.0, f64::NAN, 2.0]);
        let [none, some, neither, other] = Number::atan2(lanes(y), lanes(x)).to_array();
        assert!(none.is_nan() && neither.is_nan());
        for found in [some, other] {
            assert!((found - 0.5_f64.atan()).abs() < 1e-15);
        }
    }
}
