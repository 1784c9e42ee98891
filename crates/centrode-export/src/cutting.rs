//! Layers of a part to cut.

use std::fmt::Write as _;

use centrode_formats::drawing::{Color, Drawing, EntityShape, LineType};
use centrode_formats::sheet::number;
use centrode_geometry::{LoopError, Outline, Point, Tolerance, UncutCorner};

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

/// Moves each contour to the path of the middle of a cut as wide as `kerf`, mm: outside the profile, inside holes. Returns the
/// corners that the cut does not reach.
pub(crate) fn along_the_cut(
    drawing: &mut Drawing,
    kerf: f64,
    tolerance: Tolerance,
) -> Result<Vec<UncutCorner>, (String, LoopError)> {
    let mut uncut = Vec::new();
    for entity in &mut drawing.entities {
        let offset = match &*entity.layer {
            PROFILE => 0.5 * kerf,
            HOLE => -0.5 * kerf,
            _ => continue,
        };
        match &mut entity.shape {
            EntityShape::Contour(outline) => {
                let path = outline.cutter_path(offset, tolerance);
                let path = path.map_err(|error| (words(outline, offset), error))?;
                *outline = path.path;
                uncut.extend(path.uncut);
            }
            EntityShape::Circle { radius, .. } => {
                if *radius + offset <= tolerance.mm() {
                    let circle = Outline::circle(Point::origin(), *radius);
                    return Err((words(&circle, offset), LoopError::Everywhere));
                }
                *radius += offset;
            }
            _ => {}
        }
    }
    Ok(uncut)
}

/// A contour in words: the outline, or a hole with its size.
fn words(outline: &Outline, offset: f64) -> String {
    if offset > 0.0 {
        return "the outline".to_owned();
    }
    if let Some((_, radius)) = outline.as_circle() {
        return format!("a hole of {} mm", number(2.0 * radius, 3));
    }
    let bounds = outline.bounds();
    let [width, height] = (bounds.max - bounds.min).into();
    format!("a hole of {} x {} mm", number(width, 3), number(height, 3))
}

/// Text that goes with cutting files along the middle of a cut: its width, and the corners that it does not reach, part by
/// part.
pub(crate) fn notes(kerf: f64, parts: &[(String, Vec<UncutCorner>)]) -> String {
    let mut text = format!(
        "Width of the cut (kerf): {kerf} mm\nContours are the path of its middle: {} mm outside each part, inside each hole.\nDrawings of assemblies and contours for a lathe are not changed.\n",
        0.5 * kerf
    );
    for (part, uncut) in parts {
        let thickest = uncut
            .iter()
            .map(|corner| corner.thickness)
            .fold(0.0, f64::max);
        // Writing to a string cannot fail.
        let _ = match uncut.len() {
            0 => writeln!(text, "\n{part}: every corner is reached"),
            count => writeln!(
                text,
                "\n{part}: up to {thickest:.4} mm remain in {count} corners narrower than the cut\n{:>12} {:>12} {:>12}",
                "x, mm", "y, mm", "remains, mm"
            ),
        };
        for UncutCorner { point, thickness } in uncut {
            let _ = writeln!(text, "{:12.4} {:12.4} {thickness:12.4}", point.x, point.y);
        }
    }
    text
}
