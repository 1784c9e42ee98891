use serde::Serialize;

use crate::analysis::Unit;
use crate::cli::reverse::asked::{WITHIN, drawn};
use crate::mechanism::reverse::WantedPoints;

/// Most points that the page shows, each with a row and a handle.
const MOST: usize = 200;

/// Points of a file, for the page.
#[derive(Debug, Serialize)]
pub(super) struct Points {
    points: Vec<[f64; 2]>,
    /// How they were found.
    note: String,
}

/// Reads the points of a CSV file, or lays points along the one path of an SVG file.
pub(super) fn points(text: &str) -> Result<Points, String> {
    let bytes = text.as_bytes();
    let drawn = drawn(bytes, WITHIN).map_err(|error| error.to_string())?;
    let (points, note) = if let Some(drawn) = drawn {
        let off = Unit::Millimetre.tell(drawn.deviation.value);
        let count = drawn.points.len();
        let note = format!("{count} points, within {off} of the drawing");
        (drawn.points, note)
    } else {
        let read = WantedPoints::from_csv(bytes).map_err(|error| error.to_string())?;
        let note = format!("{} points", read.points.len());
        (read.points, note)
    };
    let count = points.len();
    if count > MOST {
        return Err(format!(
            "the path has {count} points; the page shows up to {MOST}: take fewer, or use centrode reverse"
        ));
    }
    let points = points.iter().map(|p| [p.x, p.y]).collect();
    Ok(Points { points, note })
}
