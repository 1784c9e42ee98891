use centrode_geometry::Recent;

use super::{MotionJet, Transmission};
use crate::machine::Piecewise;

/// A transmission that remembers its last few values, as many as are evaluated side by side, for one that is costly and on
/// which several others are built.
///
/// What is remembered is equal to what is computed, bit by bit.
#[derive(Debug)]
pub(crate) struct Remembered<T> {
    of: T,
    last: Recent<u64, MotionJet>,
}

impl<T: Transmission> Remembered<T> {
    /// Remembers the values of a transmission.
    pub(crate) fn new(of: T) -> Self {
        let last = Recent::new();
        Self { of, last }
    }
}

impl<T: Transmission> Transmission for Remembered<T> {
    fn at(&self, input: f64) -> MotionJet {
        self.last.get(&input.to_bits(), || self.of.at(input))
    }

    fn period(&self) -> f64 {
        self.of.period()
    }

    fn advance(&self) -> f64 {
        self.of.advance()
    }

    fn breaks(&self) -> Vec<f64> {
        self.of.breaks()
    }

    fn pieces(&self) -> Piecewise {
        self.of.pieces()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::formula::LANES;
    use crate::transmission::FromFn;

    #[test]
    fn a_value_is_computed_once_while_it_is_among_the_last() {
        let calls = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&calls);
        let sine = FromFn::new(1.0, 0.5, vec![0.25], move |t: f64| {
            counted.fetch_add(1, Ordering::Relaxed);
            MotionJet {
                position: t.sin(),
                velocity: t.cos(),
                ..MotionJet::default()
            }
        });
        let law = Remembered::new(sine);
        let inputs: Vec<f64> = (0..LANES).map(|i| 0.1 * i as f64).collect();
        for _ in 0..3 {
            for &input in &inputs {
                assert_eq!(law.at(input).position, input.sin());
            }
        }
        assert_eq!(calls.load(Ordering::Relaxed), LANES);
        // One more pushes out the first.
        assert_eq!(law.at(7.0).velocity, 7.0_f64.cos());
        assert_eq!(law.at(inputs[1]).position, inputs[1].sin());
        assert_eq!(calls.load(Ordering::Relaxed), LANES + 1);
        assert_eq!(law.at(inputs[0]).position, 0.0);
        assert_eq!(calls.load(Ordering::Relaxed), LANES + 2);
        assert_eq!(
            (law.period(), law.advance(), law.breaks()),
            (1.0, 0.5, vec![0.25])
        );
        // Zero has two signs and two values.
        assert!(law.at(-0.0).position.is_sign_negative());
    }
}
