//! Transmission function of a joint: its position as a function of the machine's input.

mod breaks;
mod chain;
mod inverse;
mod remembered;

use std::fmt;

use crate::formula::{Number, Taylor};
use crate::machine::Piecewise;

pub use breaks::{crossings, repeated, sorted};
pub use chain::Chain;
pub use inverse::Inverse;
pub use remembered::Remembered;

/// A position and its first three derivatives with respect to the input.
///
/// For an input in radians the velocity is mm/rad or rad/rad, whatever the speed of the shaft: times
/// the shaft's speed (rad/s) once, twice and three times it is velocity, acceleration and jerk by time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionJet {
    /// Position: mm of a slide, rad of a turning joint.
    pub position: f64,
    /// First derivative.
    pub velocity: f64,
    /// Second derivative.
    pub acceleration: f64,
    /// Third derivative.
    pub jerk: f64,
}

impl MotionJet {
    /// Jet of a position that does not change.
    #[must_use]
    pub fn at_rest(position: f64) -> Self {
        Self::uniform(position, 0.0)
    }

    /// Jet of a position that changes at a constant velocity.
    #[must_use]
    pub fn uniform(position: f64, velocity: f64) -> Self {
        Self {
            position,
            velocity,
            ..Self::default()
        }
    }

    /// Jet of this motion's output by the variable on which the input depends.
    ///
    /// `self` is f at g(t), `inner` is g at t: the result is f(g(t)), by the chain rule to third order.
    #[must_use]
    pub fn after(&self, inner: &Self) -> Self {
        let (g1, g2, g3) = (inner.velocity, inner.acceleration, inner.jerk);
        Self {
            position: self.position,
            velocity: self.velocity * g1,
            acceleration: self.acceleration * g1 * g1 + self.velocity * g2,
            jerk: self.jerk * g1 * g1 * g1 + 3.0 * self.acceleration * g1 * g2 + self.velocity * g3,
        }
    }

    /// The sum of this jet and `factor` times another.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            position: self.position + factor * other.position,
            velocity: self.velocity + factor * other.velocity,
            acceleration: self.acceleration + factor * other.acceleration,
            jerk: self.jerk + factor * other.jerk,
        }
    }

    /// The jet of the inverse function at `self.position`, whose value there is `input`.
    ///
    /// Not finite where the velocity is zero.
    #[must_use]
    pub fn inverse(&self, input: f64) -> Self {
        let (g1, g2, g3) = (self.velocity, self.acceleration, self.jerk);
        Self {
            position: input,
            velocity: 1.0 / g1,
            acceleration: -g2 / (g1 * g1 * g1),
            jerk: (3.0 * g2 * g2 - g1 * g3) / g1.powi(5),
        }
    }

    /// The jet of a series of the input.
    #[must_use]
    pub fn from_series<const N: usize>(series: &Taylor<N>) -> Self {
        Self::of_lane(series, 0)
    }

    /// Jet of one lane of a series.
    #[inline(always)]
    pub(crate) fn of_lane<const N: usize, T: Number>(series: &Taylor<N, T>, lane: usize) -> Self {
        let [position, velocity, acceleration, jerk] = series.derivatives();
        Self {
            position: position.lane(lane),
            velocity: velocity.lane(lane),
            acceleration: acceleration.lane(lane),
            jerk: jerk.lane(lane),
        }
    }

    /// The first `N` Taylor coefficients of this jet; those above the third are not known and set to zero.
    pub(crate) fn coefficients<const N: usize>(&self) -> Taylor<N> {
        let known = self.series().0;
        Taylor(std::array::from_fn(|k| {
            known.get(k).copied().unwrap_or(0.0)
        }))
    }

    /// The series of this jet; its last coefficient is not known and set to zero.
    pub fn series(&self) -> Taylor {
        Taylor([
            self.position,
            self.velocity,
            0.5 * self.acceleration,
            self.jerk / 6.0,
            0.0,
        ])
    }
}

/// A joint's position as a function of the machine's input.
///
/// `at(input + period)` is `at(input)` with `advance` added to the position. Between two neighbouring
/// [`breaks`](Self::breaks) the function is analytic; at a break the jet is the limit from the right.
pub trait Transmission: fmt::Debug + Send + Sync {
    /// Position and derivatives at any input.
    fn at(&self, input: f64) -> MotionJet;

    /// Input after which the motion repeats.
    fn period(&self) -> f64 {
        std::f64::consts::TAU
    }

    /// Growth of the position over one period: zero for a motion that comes back.
    fn advance(&self) -> f64 {
        0.0
    }

    /// Inputs in `[0, period)` where a derivative may jump, ascending.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Approximation in pieces, within rounding.
    fn pieces(&self) -> Piecewise {
        Piecewise::fit(self)
    }
}

/// A transmission given by a function.
pub struct FromFn<F> {
    function: F,
    period: f64,
    advance: f64,
    breaks: Vec<f64>,
}

impl<F: Fn(f64) -> MotionJet + Send + Sync> FromFn<F> {
    /// The transmission of `function`, which must repeat with `period` up to `advance`.
    #[must_use]
    pub fn new(period: f64, advance: f64, breaks: Vec<f64>, function: F) -> Self {
        Self {
            function,
            period,
            advance,
            breaks,
        }
    }
}

impl<F> fmt::Debug for FromFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FromFn")
            .field("period", &self.period)
            .field("advance", &self.advance)
            .field("breaks", &self.breaks)
            .finish_non_exhaustive()
    }
}

impl<F: Fn(f64) -> MotionJet + Send + Sync> Transmission for FromFn<F> {
    fn at(&self, input: f64) -> MotionJet {
        (self.function)(input)
    }

    fn period(&self) -> f64 {
        self.period
    }

    fn advance(&self) -> f64 {
        self.advance
    }

    fn breaks(&self) -> Vec<f64> {
        self.breaks.clone()
    }
}

/// Reason why transmissions cannot be combined.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransmissionError {
    /// One cycle of the driving motion is not one cycle of the driven motion.
    #[error(
        "the driving motion advances by {advance} per cycle, but the driven motion has a period of {period}"
    )]
    Periods {
        /// Advance of the driving one in a period.
        advance: f64,
        /// Period of the driven one.
        period: f64,
    },
    /// No number of cycles of the driving one is a whole number of cycles of the driven one.
    #[error(
        "the driving motion advances by {advance} per cycle and the driven motion has a period of {period}: no number of driving cycles up to {most} gives a whole number of driven cycles"
    )]
    NoCommonCycle {
        /// Advance of the driving one in a period.
        advance: f64,
        /// Period of the driven one.
        period: f64,
        /// Maximum number tried.
        most: u32,
    },
    /// A motion that must run in one direction stops or runs back.
    #[error(
        "the motion must run in one direction, but at the input {input} rad its velocity is {velocity}"
    )]
    StandsStill {
        /// Input at which it stops or runs back, rad.
        input: f64,
        /// Velocity at this input.
        velocity: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use std::sync::Arc;

    /// t + 0.3 sin t, and its mirror image.
    fn wavy(sign: f64) -> Arc<dyn Transmission> {
        Arc::new(FromFn::new(TAU, sign * TAU, vec![1.0], move |t: f64| {
            MotionJet {
                position: sign * (0.2 + t + 0.3 * t.sin()),
                velocity: sign * (1.0 + 0.3 * t.cos()),
                acceleration: -sign * 0.3 * t.sin(),
                jerk: -sign * 0.3 * t.cos(),
            }
        }))
    }

    fn close(a: &MotionJet, b: &MotionJet) {
        for (x, y) in [
            (a.position, b.position),
            (a.velocity, b.velocity),
            (a.acceleration, b.acceleration),
            (a.jerk, b.jerk),
        ] {
            assert!((x - y).abs() < 1e-12 * (1.0 + x.abs()), "{a:?} {b:?}");
        }
    }

    #[test]
    fn an_inverse_undoes_either_way_round() {
        for sign in [1.0, -1.0] {
            let law = wavy(sign);
            let inverse: Arc<dyn Transmission> =
                Arc::new(Inverse::new(law.clone()).expect("monotone"));
            let there_and_back = Chain::cycle_for_cycle(inverse, law).expect("fits");
            for i in -20..=20 {
                let t = 0.7 * f64::from(i);
                let expected = MotionJet {
                    position: t,
                    velocity: 1.0,
                    acceleration: 0.0,
                    jerk: 0.0,
                };
                close(&there_and_back.at(t), &expected);
            }
            assert_eq!(there_and_back.advance(), TAU);
            assert_eq!(there_and_back.breaks().len(), 1);
            assert!((there_and_back.breaks()[0] - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn an_inverse_is_found_to_rounding_everywhere() {
        for sign in [1.0, -1.0] {
            let law = wavy(sign);
            let inverse = Inverse::new(law.clone()).expect("monotone");
            for i in 0..=5000 {
                let t = TAU * f64::from(i) / 5000.0;
                let found = inverse.at(law.at(t).position).position;
                // Where a period ends the next begins.
                let off = (found - t).abs();
                assert!(off.min((off - TAU).abs()) < 4e-15, "{t}: {found}");
            }
            assert!(inverse.at(f64::NAN).position.is_nan());
        }
    }

    #[test]
    fn what_does_not_fit_or_stands_still_is_refused() {
        let half = Arc::new(FromFn::new(TAU, 0.5, vec![], |t: f64| MotionJet {
            position: t.sin() + 0.5 * t / TAU,
            velocity: t.cos() + 0.5 / TAU,
            acceleration: -t.sin(),
            jerk: -t.cos(),
        }));
        assert!(matches!(
            Chain::cycle_for_cycle(wavy(1.0), half.clone()),
            Err(TransmissionError::Periods { .. })
        ));
        assert!(matches!(
            Inverse::new(half),
            Err(TransmissionError::StandsStill { .. })
        ));
    }
}
