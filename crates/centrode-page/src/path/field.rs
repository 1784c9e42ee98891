//! Axes around a path: the possible ones, and the best one.

use super::wish::path;
use centrode_synthesis::reverse::{AxisFault, AxisMap, AxisRange, PossibleAxis};
use serde::{Deserialize, Serialize};

/// Most axes along a side of a map.
const MOST: u32 = 200;

/// Request of the map.
#[derive(Debug, Deserialize)]
pub struct Ask {
    points: Vec<[f64; 2]>,
    bend_deg: f64,
    /// Axes along each side.
    count: u32,
}

/// Map of possible axes, row by row from the minimum y, each row from the minimum x.
#[derive(Debug, Serialize)]
pub struct Field {
    x: [f64; 2],
    y: [f64; 2],
    count: [u32; 2],
    /// Maximum factor between the ratio and 1; `None` if the axis is not possible.
    factor: Vec<Option<f64>>,
    /// Minimum and maximum ratio.
    ratios: Vec<Option<[f64; 2]>>,
    /// Minimum convex radius of the split by powers, mm.
    radius: Vec<Option<f64>>,
    /// Number of the reason why an axis is not possible.
    fault: Vec<Option<usize>>,
    /// The reasons found: name, words, and number of axes that each forbids.
    faults: Vec<(&'static str, &'static str, usize)>,
    possible: usize,
    /// Number of possible axes inside the path.
    inside: usize,
}

impl Field {
    /// Map around a path.
    ///
    /// # Errors
    /// The reason in words if the points make no path, or the count is out of range.
    pub fn new(ask: &Ask) -> Result<Self, String> {
        let required = path(&ask.points).map_err(|error| error.to_string())?;
        if !(2..=MOST).contains(&ask.count) {
            return Err(format!(
                "a map must have 2 to {MOST} axes per side, not {}",
                ask.count
            ));
        }
        let range = AxisRange {
            count: [ask.count; 2],
            ..AxisRange::about(&required)
        };
        let map = AxisMap::new(&required, range);
        let bend = ask.bend_deg.to_radians();
        let mut faults: Vec<(&'static str, &'static str, usize)> = Vec::new();
        let mut number = |fault: &AxisFault| {
            let name = fault.name();
            let known = faults.iter().position(|(known, ..)| *known == name);
            let number = known.unwrap_or_else(|| {
                faults.push((name, words(name), 0));
                faults.len() - 1
            });
            faults[number].2 += 1;
            number
        };
        let found = map.found();
        let fault = found
            .iter()
            .map(|one| one.as_ref().err().map(&mut number))
            .collect();
        let figure = |of: &dyn Fn(&PossibleAxis) -> f64| {
            let figures = found
                .iter()
                .map(|one| one.as_ref().ok().map(|axis| short(of(axis))));
            figures.collect()
        };
        let ratios = found
            .iter()
            .map(|one| one.as_ref().ok().map(|axis| axis.ratios.map(short)));
        let possible = found.iter().flatten();
        Ok(Self {
            x: range.x,
            y: range.y,
            count: range.count,
            factor: figure(&|axis| axis.unevenness().exp()),
            ratios: ratios.collect(),
            radius: figure(&|axis| axis.minimum_radius(bend)),
            fault,
            faults,
            possible: map.possible(),
            inside: possible.filter(|axis| axis.carrier > axis.arm).count(),
        })
    }
}

/// Five digits after the point: more cannot be seen in a map.
fn short(value: f64) -> f64 {
    (value * 1e5).round() / 1e5
}

/// A reason in words that fit any axis.
fn words(name: &str) -> &'static str {
    match name {
        "extremes" => "the distance of the path from this axis has several maxima and minima",
        "circle" => "the path is a circle about the axis",
        "on-axis" => "the path passes through the axis",
        "winding" => "the path goes round the axis more than once",
        "carrier-turns-back" => "the carrier would turn back",
        "arm-stops" => "the arm would stop on the carrier",
        "too-far" => {
            "the distance of the axis from the path is more than 1000 times the size of the path"
        }
        _ => "the axis is not possible for this path",
    }
}

/// Request of the best axis.
#[derive(Debug, Deserialize)]
pub struct Best {
    points: Vec<[f64; 2]>,
    bend_deg: f64,
    /// Whether the gears of minimum curvature are required instead of the gentlest ratio.
    bluntest: bool,
}

/// The axis with the gentlest ratio, or the one with the gears of minimum curvature.
///
/// # Errors
/// The reason in words if the points make no path, or no axis is possible.
pub fn best(ask: &Best) -> Result<[f64; 2], String> {
    let required = path(&ask.points).map_err(|error| error.to_string())?;
    let map = AxisMap::new(&required, AxisRange::about(&required));
    let axis = if ask.bluntest {
        map.bluntest(ask.bend_deg.to_radians())
    } else {
        map.mildest(&required).map(|chain| chain.axis())
    };
    let tried = map.found().len();
    let axis = axis.ok_or_else(|| {
        format!(
            "none of the {tried} axes tried on and around the path is possible: change the path"
        )
    })?;
    // As many digits as the page shows.
    Ok([axis.x, axis.y].map(|x| (x * 1e4).round() / 1e4))
}
