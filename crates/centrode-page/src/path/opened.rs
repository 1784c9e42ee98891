use crate::reverse::{WITHIN, drawn};
use centrode_analysis::Unit;
use centrode_spec::DesignSpec as _;
use centrode_synthesis::reverse::{PathDesign, RequiredPoints, Wishes};
use serde::Serialize;

/// Most points that the page shows, each with a row and a handle.
const MOST: usize = 200;

/// Contents of a file, for the page.
#[derive(Debug, Serialize)]
pub struct Opened {
    /// The design; from a file of points, the points and their tolerances and directions.
    design: PathDesign,
    /// Whether it is a design file: the page then takes the whole design, not the points alone.
    whole: bool,
    /// Remark on the file for the user.
    note: String,
}

/// Reads a design of family path or the points of a CSV file, or lays points along the one path of an SVG file.
///
/// # Errors
/// The reason in words if the text has no path of 3 to 200 points.
pub fn opened(text: &str) -> Result<Opened, String> {
    let opened = read(text)?;
    let points = &opened.design.path.points;
    let count = points.len();
    let is_number = |point: &[f64; 2]| point.iter().all(|x| x.is_finite());
    if let Some(i) = points.iter().position(|point| !is_number(point)) {
        return Err(format!("point {} is not a finite number", i + 1));
    }
    match count {
        0..3 => Err(format!(
            "the path has {count} points; it must have at least 3"
        )),
        3..=MOST => Ok(opened),
        _ => Err(format!(
            "the path has {count} points; the page shows up to {MOST}: use fewer points, or the command centrode reverse"
        )),
    }
}

fn read(text: &str) -> Result<Opened, String> {
    let bytes = text.as_bytes();
    let has_family = |line: &str| line.trim_start().starts_with("family") && line.contains('=');
    if text.lines().any(has_family) {
        let design = PathDesign::from_toml(text).map_err(|error| error.to_string())?;
        if let Some(file) = &design.path.file {
            return Err(format!(
                "its points are in another file, {file}: open that file, or write the points at path.points"
            ));
        }
        let note = format!("{} points, with all requirements", design.path.points.len());
        return Ok(Opened {
            design,
            whole: true,
            note,
        });
    }
    let mut design = PathDesign::default();
    let drawn = drawn(bytes, WITHIN).map_err(|error| error.to_string())?;
    let (points, note) = if let Some(drawn) = drawn {
        let off = Unit::Millimetre.with_unit(drawn.deviation.value);
        let count = drawn.points.len();
        let note = format!("{count} points, within {off} of the drawing");
        (drawn.points, note)
    } else {
        let read = RequiredPoints::from_csv(bytes).map_err(|error| error.to_string())?;
        let mut note = format!("{} points", read.points.len());
        if read.tolerances.is_some() {
            note += ", each with a tolerance";
        }
        match read.directions.len() {
            0 => {}
            1 => note += ", 1 direction",
            count => note += &format!(", {count} directions"),
        }
        design.path.tolerance = read.tolerances.unwrap_or_default();
        design.wishes = Wishes {
            directions: read.directions,
            ..Wishes::default()
        };
        (read.points, note)
    };
    design.path.points = points.iter().map(|p| [p.x, p.y]).collect();
    Ok(Opened {
        design,
        whole: false,
        note,
    })
}
