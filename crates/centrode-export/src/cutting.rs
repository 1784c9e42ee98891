//! Layers of a part to cut.

use centrode_formats::drawing::{Color, Drawing, LineType};

use crate::Layers;

/// Layer of the outer contour that is cut.
pub(crate) const PROFILE: &str = "PROFILE";
/// Layer of the contours that are cut out of the part.
pub(crate) const HOLE: &str = "HOLE";
/// Layer of centre lines.
pub(crate) const CENTER: &str = "CENTER";

/// Empty drawing with the layers of a part to cut: centre lines, holes, and the profile last, above the others.
pub(crate) fn drawing() -> Drawing {
    Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(HOLE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}

/// A part's drawing as a cutting file: only the contours to cut, or all layers, where the other layers do not plot.
pub(crate) fn file(mut drawing: Drawing, layers: Layers) -> Drawing {
    let cut = [PROFILE, HOLE];
    match layers {
        Layers::Cut => drawing.keep(&cut),
        Layers::All => {
            for layer in &mut drawing.layers {
                layer.plots = cut.contains(&&*layer.name);
            }
        }
    }
    drawing
}
