use std::f64::consts::TAU;

use centrode::export::page::{Curve, Handle, HandlePlane, Picture};
use centrode::export::shaft;
use centrode::geometry::Tolerance;
use centrode::mechanism::shaft::{MovingBox, ShaftSolid, SpiralShaft};
use centrode::mechanism::transmission::MotionJet;

use super::handles::degrees;

/// Tolerance of the picture, as a share of the groove's width.
const DRAWN: f64 = 5e-3;

fn tolerance(part: &SpiralShaft) -> Option<Tolerance> {
    Tolerance::new(DRAWN * part.groove().width()).ok()
}

/// The developed groove with its slider.
pub(super) fn picture(part: &SpiralShaft) -> Picture {
    let drawn = tolerance(part).and_then(|t| shaft::shaft_picture(part, t).ok());
    let mut picture = drawn.unwrap_or_default();
    let even = |input: f64| MotionJet {
        position: input,
        velocity: 1.0,
        ..MotionJet::default()
    };
    picture.handles = window(part, "", even);
    picture
}

/// The same by the input of the machine.
pub(super) fn box_picture(machine: &MovingBox) -> Picture {
    let part = machine.shaft();
    let drawn = tolerance(part).and_then(|t| shaft::box_picture(machine, t).ok());
    let mut picture = drawn.unwrap_or_default();
    picture.handles = window(part, "shaft.", |input| machine.shaft_turn(input));
    picture
}

/// Motion and forces of the machine along its input.
pub(super) fn box_curves(machine: &MovingBox) -> Vec<Curve> {
    shaft::box_curves(machine).unwrap_or_default()
}

/// Middle and end of the window in which a seedling is picked, at the near and the far end of the development:
/// side by side they would lie on one another.
fn window(part: &SpiralShaft, table: &str, turn: impl Fn(f64) -> MotionJet) -> Vec<Handle> {
    let Ok(solid) = ShaftSolid::new(part.groove(), part.body()) else {
        return Vec::new();
    };
    let (design, radius) = (part.design(), part.groove().radius());
    let handle = |name: &str, key: &str, value: f64, input: f64, [x, share]: [f64; 2]| {
        let at = turn(input);
        // One degree of the number moves the point so far; the turned surface runs downwards.
        let scale = -radius * at.velocity * share * 1.0_f64.to_radians();
        let place = -radius * at.position.rem_euclid(TAU);
        Handle {
            name: name.into(),
            link: 0,
            plane: HandlePlane::Cartesian,
            keys: [String::new(), format!("{table}{key}")],
            values: [0.0, value],
            scale,
            origin: [x, place - scale * value],
            chained: false,
        }
    };
    let [near, far] = solid.ends();
    let (middle, end) = (design.pick, design.pick + 0.5 * design.window);
    let (pick, width) = (degrees(middle), degrees(design.window));
    vec![
        handle(
            "middle of the picking",
            "pick_deg",
            pick,
            middle,
            [near, 1.0],
        ),
        handle("end of the picking", "window_deg", width, end, [far, 0.5]),
    ]
}
