use centrode::export::page::{Curve, Picture};
use centrode::export::shaft;
use centrode::geometry::Tolerance;
use centrode::mechanism::shaft::{MovingBox, SpiralShaft};

/// Tolerance of the picture, as a share of the groove's width.
const DRAWN: f64 = 5e-3;

fn tolerance(part: &SpiralShaft) -> Option<Tolerance> {
    Tolerance::new(DRAWN * part.groove().width()).ok()
}

/// The developed groove with its slider.
pub(super) fn picture(part: &SpiralShaft) -> Picture {
    let drawn = tolerance(part).and_then(|t| shaft::shaft_picture(part, t).ok());
    drawn.unwrap_or_default()
}

/// The same by the input of the machine.
pub(super) fn box_picture(machine: &MovingBox) -> Picture {
    let drawn = tolerance(machine.shaft()).and_then(|t| shaft::box_picture(machine, t).ok());
    drawn.unwrap_or_default()
}

/// Motion and forces of the machine along its input.
pub(super) fn box_curves(machine: &MovingBox) -> Vec<Curve> {
    shaft::box_curves(machine).unwrap_or_default()
}
