use std::sync::{Mutex, PoisonError};

use super::{MotionJet, Transmission};
use crate::machine::Piecewise;

/// Maximum number of cached values, a power of two: a machine is sampled at some thousand inputs, by several analyses one after
/// the other.
const MOST: usize = 1 << BITS;
const BITS: u32 = 12;

/// A transmission that caches its values, for a costly one on which several others depend.
///
/// A cached value equals the computed one, bit by bit. Each input has one entry, which it shares with other inputs: the entry
/// holds the value that was computed last.
#[derive(Debug)]
pub struct Remembered<T> {
    of: T,
    values: Mutex<Vec<Option<(u64, MotionJet)>>>,
}

impl<T: Transmission> Remembered<T> {
    /// Caches the values of a transmission.
    pub fn new(of: T) -> Self {
        let values = Mutex::new(Vec::new());
        Self { of, values }
    }
}

/// Index of an input's entry.
fn place(bits: u64) -> usize {
    // Multiplied by the golden ratio: inputs that follow each other get entries far apart.
    (bits.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (u64::BITS - BITS)) as usize
}

impl<T: Transmission> Transmission for Remembered<T> {
    fn at(&self, input: f64) -> MotionJet {
        let bits = input.to_bits();
        let known = |values: &Vec<_>| values.get(place(bits)).copied().flatten();
        match known(&self.values.lock().unwrap_or_else(PoisonError::into_inner)) {
            Some((of, value)) if of == bits => return value,
            _ => {}
        }
        // Computed without the lock: it takes long, and may be cancelled.
        let value = self.of.at(input);
        let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        if values.is_empty() {
            values.resize(MOST, None);
        }
        values[place(bits)] = Some((bits, value));
        value
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
    use crate::transmission::FromFn;

    #[test]
    fn most_values_of_a_sweep_are_computed_once() {
        let calls = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&calls);
        let sine = FromFn::new(1.0, 0.5, vec![0.25], move |t: f64| {
            counted.fetch_add(1, Ordering::Relaxed);
            MotionJet::uniform(t.sin(), t.cos())
        });
        let law = Remembered::new(sine);
        let inputs: Vec<f64> = (0..500).map(|i| 0.01 * f64::from(i)).collect();
        for _ in 0..3 {
            for &input in &inputs {
                assert_eq!(law.at(input).position, input.sin());
            }
        }
        // Those that share a position push each other out in every round.
        let places = |input: &f64| place(input.to_bits());
        let shared = |input: &&f64| {
            let same = inputs.iter().filter(|other| places(other) == places(input));
            same.count() > 1
        };
        let anew = inputs.iter().filter(shared).count();
        assert!(anew < 100, "{anew}");
        assert_eq!(calls.load(Ordering::Relaxed), 500 + 2 * anew);
        assert_eq!(
            (law.period(), law.advance(), law.breaks()),
            (1.0, 0.5, vec![0.25])
        );
        // Zero has two signs and two values.
        assert!(law.at(-0.0).position.is_sign_negative());
    }
}
