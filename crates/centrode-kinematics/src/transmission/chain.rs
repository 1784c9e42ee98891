use centrode_geometry::COMPUTED;
use std::sync::{Arc, OnceLock};

use super::{MotionJet, Transmission, TransmissionError, crossings, repeated, sorted};

/// Maximum number of cycles of the driving motion per cycle of the chain.
const MOST: u32 = 1000;
/// One transmission driven by another: `outer` of `inner`, which may stop and run back.
#[derive(Clone, Debug)]
pub struct Chain {
    inner: Arc<dyn Transmission>,
    outer: Arc<dyn Transmission>,
    /// Numbers of cycles of the driving and of the driven motion per cycle of the chain; the second is below zero if the driven
    /// one runs backwards.
    cycles: (f64, f64),
    /// Inputs at which a derivative may jump, computed at the first request.
    breaks: OnceLock<Vec<f64>>,
}

impl Chain {
    /// Chains two transmissions. The chain repeats after the minimum number of the driving one's cycles in which the driven one
    /// runs through a whole number of cycles, or through none.
    ///
    /// # Errors
    /// [`TransmissionError::NoCommonCycle`] if there is no such number up to 1,000.
    pub fn new(
        outer: Arc<dyn Transmission>,
        inner: Arc<dyn Transmission>,
    ) -> Result<Self, TransmissionError> {
        let (advance, period) = (inner.advance(), outer.period());
        let once = advance / period;
        let whole = |cycles: &f64| {
            let turned = cycles * once;
            (turned - turned.round()).abs() <= COMPUTED * turned.abs().max(1.0)
        };
        let cycles = (1..=MOST).map(f64::from).find(whole);
        let most = MOST;
        let cycles = cycles.ok_or(TransmissionError::NoCommonCycle {
            advance,
            period,
            most,
        })?;
        let cycles = (cycles, (cycles * once).round());
        Ok(Self {
            inner,
            outer,
            cycles,
            breaks: OnceLock::new(),
        })
    }

    /// Chains two transmissions: the driven one must run through one cycle, in either direction, per cycle of the driving one.
    ///
    /// # Errors
    /// [`TransmissionError::Periods`] if it does not.
    pub fn cycle_for_cycle(
        outer: Arc<dyn Transmission>,
        inner: Arc<dyn Transmission>,
    ) -> Result<Self, TransmissionError> {
        let (advance, period) = (inner.advance().abs(), outer.period());
        match Self::new(outer, inner) {
            Ok(chain) if chain.cycles.0 == 1.0 && chain.cycles.1.abs() == 1.0 => Ok(chain),
            _ => Err(TransmissionError::Periods { advance, period }),
        }
    }
}

impl Transmission for Chain {
    fn at(&self, input: f64) -> MotionJet {
        let inner = self.inner.at(input);
        self.outer.at(inner.position).after(&inner)
    }

    fn period(&self) -> f64 {
        self.cycles.0 * self.inner.period()
    }

    fn advance(&self) -> f64 {
        self.cycles.1 * self.outer.advance()
    }

    fn breaks(&self) -> Vec<f64> {
        let found = || {
            let period = self.period();
            let own = repeated(&*self.inner, period);
            let (values, cycle) = (self.outer.breaks(), self.outer.period());
            let place = |input: f64| self.inner.at(input).position;
            let met = crossings(place, &values, cycle, period, &own);
            sorted(own.into_iter().chain(met), period)
        };
        self.breaks.get_or_init(found).clone()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::machine::Linear;
    use crate::transmission::FromFn;

    /// Swing of 2 rad to either side.
    fn swing() -> Arc<dyn Transmission> {
        Arc::new(FromFn::new(TAU, 0.0, Vec::new(), |t: f64| {
            let (sin, cos) = t.sin_cos();
            MotionJet {
                position: 2.0 * sin,
                velocity: 2.0 * cos,
                acceleration: -2.0 * sin,
                jerk: -2.0 * cos,
            }
        }))
    }

    fn broken_at(at: f64) -> Arc<dyn Transmission> {
        Arc::new(FromFn::new(TAU, TAU, vec![at], |t: f64| {
            MotionJet::uniform(t, 1.0)
        }))
    }

    #[test]
    fn a_swing_passes_a_break_on_its_way_there_and_back() {
        let chain = Chain::new(broken_at(1.0), swing()).expect("a swing comes back");
        let half = 0.5_f64.asin();
        let required = [half, std::f64::consts::PI - half];
        assert_eq!(chain.advance(), 0.0);
        let found = chain.breaks();
        assert_eq!(found.len(), 2, "{found:?}");
        for (one, other) in found.iter().zip(required) {
            assert!((one - other).abs() < 1e-14);
        }
    }

    #[test]
    fn a_slow_drive_takes_several_cycles_for_one() {
        let slow = Arc::new(Linear::new(0.0, -2.0 / 3.0));
        let chain = Chain::new(broken_at(1.0), slow).expect("three cycles");
        assert_eq!(chain.period(), 3.0 * TAU);
        assert_eq!(chain.advance(), -2.0 * TAU);
        let found = chain.breaks();
        assert_eq!(found.len(), 2);
        for b in found {
            let place = (-2.0 / 3.0 * b).rem_euclid(TAU);
            assert!((place - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn cycles_without_a_common_one_are_refused() {
        let odd = Arc::new(Linear::new(0.0, 0.5_f64.sqrt()));
        let error = Chain::new(broken_at(1.0), odd).expect_err("no common cycle");
        assert!(error.to_string().contains("whole number"), "{error}");
    }
}
