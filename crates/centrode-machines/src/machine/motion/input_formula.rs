//! Formulas of the input as motions and loads.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::machine::MachineLawError;
use centrode_geometry::COMPUTED;
use centrode_kinematics::formula::Formula;
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};

/// A formula, checked to have finite values and derivatives over a period.
pub(in crate::machine) fn formula_of(
    text: &str,
    period: f64,
) -> Result<impl Fn(f64) -> MotionJet + Send + Sync + use<>, MachineLawError> {
    const SAMPLES: u32 = 720;
    let formula = Formula::read(text).map_err(|e| MachineLawError::Formula(e.to_string()))?;
    let jet = move |input: f64| MotionJet::from_series(&formula.at(input));
    for i in 0..=SAMPLES {
        let input = period * f64::from(i) / f64::from(SAMPLES);
        let MotionJet {
            position,
            velocity,
            acceleration,
            jerk,
        } = jet(input);
        if !(position + velocity + acceleration + jerk).is_finite() {
            let degrees = input.to_degrees();
            return Err(MachineLawError::NoValue { degrees });
        }
    }
    Ok(jet)
}

/// A formula as a law that repeats after a period, apart from a constant growth.
pub(in crate::machine) fn expression(
    text: &str,
    start: f64,
    period: f64,
) -> Result<Arc<dyn Transmission>, MachineLawError> {
    let formula = formula_of(text, period)?;
    let jet = move |input: f64| {
        let mut jet = formula(input);
        jet.position += start;
        jet
    };
    let (first, last) = (jet(0.0), jet(period));
    for (what, start, end) in [
        ("its first derivative", first.velocity, last.velocity),
        (
            "its second derivative",
            first.acceleration,
            last.acceleration,
        ),
    ] {
        if (start - end).abs() > COMPUTED * start.abs().max(1.0) {
            return Err(MachineLawError::Open { what, start, end });
        }
    }
    let advance = last.position - first.position;
    // Growth that is a whole number of turns (also zero) within rounding is set to this number.
    let whole = TAU * (advance / TAU).round();
    let advance = if (advance - whole).abs() <= COMPUTED * first.position.abs().max(1.0) {
        whole
    } else {
        advance
    };
    Ok(Arc::new(FromFn::new(
        period,
        advance,
        Vec::new(),
        move |input| {
            let turns = (input / period).floor();
            let mut jet = jet(input - turns * period);
            jet.position += turns * advance;
            jet
        },
    )))
}
