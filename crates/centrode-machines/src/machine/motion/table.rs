//! Laws from tables of values at equal steps.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::machine::MachineLawError;
use centrode_gear::pitch::{Interpolation, Periodic};
use centrode_geometry::COMPUTED;
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use centrode_spec::digits::stated;

/// Maximum last step of a table, as a multiple of the largest step within it, for which `turns` may be omitted.
const LARGEST: f64 = 2.0;

/// Reading of a table of angles: the step of the body from the last angle to the first one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableReading {
    /// Whole turns of the body over the table; below zero clockwise.
    pub turns: i32,
    /// Largest step between two neighbouring angles of the table, rad.
    pub largest_step: f64,
    /// Step from the last angle to the first one, `turns` further on, with its sign, rad.
    pub last_step: f64,
}

impl TableReading {
    /// The reading of a table of angles, rad, with the given whole turns, or by default with those that follow from its steps.
    ///
    /// They follow if exactly one reading has a last step of at most twice the largest step within the table.
    ///
    /// # Errors
    /// The two readings with the smallest last steps, if none or both of them have such a last step.
    pub(in crate::machine) fn of(angles: &[f64], turns: Option<i32>) -> Result<Self, [Self; 2]> {
        let steps = angles.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let largest_step = steps.fold(0.0, f64::max);
        let back = angles.first().unwrap_or(&0.0) - angles.last().unwrap_or(&0.0);
        let with = |turns: i32| Self {
            turns,
            largest_step,
            last_step: back + TAU * f64::from(turns),
        };
        if let Some(turns) = turns {
            return Ok(with(turns));
        }
        let near = with((-back / TAU).round() as i32);
        let next = near.last_step.signum() as i32;
        let far = with(near.turns.saturating_sub(next));
        let limit = LARGEST * largest_step + COMPUTED * largest_step.max(1.0);
        match near.last_step.abs() <= limit && far.last_step.abs() > limit {
            true => Ok(near),
            false => Err([near, far]),
        }
    }

    /// Text of the reading.
    pub(in crate::machine) fn words(&self) -> String {
        let step = stated(self.last_step.to_degrees());
        match self.turns {
            0 => format!("with turns = 0 the body swings back, in a last step of {step} deg"),
            turns => {
                format!("with turns = {turns} the body turns on, in a last step of {step} deg")
            }
        }
    }
}

/// The law through values at equal steps of `period`, rad, whose value grows by `advance` over the period.
///
/// A periodic quintic spline interpolates the values less their even growth; the growth is then added.
pub(in crate::machine) fn through(
    key: &'static str,
    values: &[f64],
    period: f64,
    advance: f64,
) -> Result<Arc<dyn Transmission>, MachineLawError> {
    let share = |i: usize| i as f64 / values.len() as f64;
    let rest = values.iter().enumerate();
    let rest: Vec<f64> = rest.map(|(i, value)| value - advance * share(i)).collect();
    let curve = Periodic::even(key, &rest, Interpolation::Quintic);
    let why = |error: centrode_gear::pitch::PitchError| error.to_string();
    let curve = curve.map_err(|error| MachineLawError::Table {
        key,
        why: why(error),
    })?;
    let scale = TAU / period;
    let jumps = curve.breaks().into_iter().map(|b| b / scale).collect();
    let at = move |input: f64| {
        let rest = MotionJet::from_series(&curve.at(input * scale));
        let even = MotionJet::uniform(advance * input / period, advance / period);
        even.plus(1.0, &stretched(&rest, scale))
    };
    Ok(Arc::new(FromFn::new(period, advance, jumps, at)))
}

/// A jet whose input is multiplied by `scale`.
fn stretched(jet: &MotionJet, scale: f64) -> MotionJet {
    jet.after(&MotionJet::uniform(0.0, scale))
}
