use super::machine::Parts;
use crate::ExportError;
use crate::picture::Curve;
use centrode_groove::{MovingBox, SpiralShaft};
use std::f64::consts::PI;

/// Step of the curves, rad.
const STEP: f64 = PI / 30.0;

/// Position, speed, acceleration, lead angle and forces over the cycle.
#[must_use]
pub fn shaft_curves(shaft: &SpiralShaft) -> Vec<Curve> {
    curves(&Parts::of_shaft(shaft))
}

/// Curves of a moving box over its own input.
///
/// # Errors
/// [`ExportError`] where the elliptic gears make no pair.
pub fn box_curves(machine: &MovingBox) -> Result<Vec<Curve>, ExportError> {
    Ok(curves(&Parts::of_box(machine)?))
}

fn curves(machine: &Parts<'_>) -> Vec<Curve> {
    let input = machine.shaft.groove().steps(STEP);
    let omega = machine.shaft.load().speed();
    let curve = |chart, unit, f: &dyn Fn(f64) -> f64| {
        let value = input.iter().map(|&t| f(t));
        Curve::new([chart, "", unit], &input, value.collect())
    };
    vec![
        curve("Position of the box", "mm", &|t| machine.motion(t).position),
        curve("Speed of the box", "mm/s", &|t| {
            omega * machine.motion(t).velocity
        }),
        curve("Acceleration of the box", "m/s²", &|t| {
            1e-3 * omega * omega * machine.motion(t).acceleration
        }),
        curve("Lead angle", "°", &|t| {
            machine.swivel(t).position.to_degrees()
        }),
        curve("Force on the groove's wall", "N", &|t| {
            machine.force(t).normal
        }),
        curve("Torque of the shaft", "N·m", &|t| {
            1e-3 * machine.force(t).torque
        }),
    ]
}
