use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::angle;
use centrode_spec::rule::{count_in_range, finite, in_range, not_negative, positive};
use centrode_spec::{SpecError, degrees};

/// Picking, planting and feed.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct WorkSpec {
    /// Carrier turn at which the first arm picks, rad (degrees in the file); default: where its tip enters the tray,
    /// or without a tray's distance where it reaches farthest towards it.
    #[serde(rename = "picking_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub picking: Option<f64>,
    /// Carrier turn at which the first arm plants, rad (degrees in the file); default: where its tip is lowest.
    #[serde(rename = "planting_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub planting: Option<f64>,
    /// Seedlings planted per minute.
    pub rate_per_minute: f64,
    /// Distance of the plants along the row, mm; the machine moves towards the tray's side, by this much from plant
    /// to plant.
    pub plant_spacing: f64,
    /// Depth below the ground that the tip reaches at its lowest, mm.
    pub planting_depth: f64,
}

impl Default for WorkSpec {
    fn default() -> Self {
        Self {
            picking: None,
            planting: None,
            rate_per_minute: 180.0,
            plant_spacing: 140.0,
            planting_depth: 10.0,
        }
    }
}

impl WorkSpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        for (key, input) in [
            ("picking_deg", self.picking),
            ("planting_deg", self.planting),
        ] {
            if let Some(input) = input {
                angle(key, input)?;
            }
        }
        positive("rate_per_minute", self.rate_per_minute)?;
        not_negative("plant_spacing", self.plant_spacing)?;
        finite("planting_depth", self.planting_depth)
    }
}

/// The tray the seedlings are picked from.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct TraySpec {
    /// Distance of the tray's surface from the carrier's axis, mm, along the direction in which the arms enter it.
    pub distance: Option<f64>,
    /// Elevation of the direction in which the arms enter the tray, rad (degrees in the file).
    #[serde(rename = "inclination_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub inclination: f64,
    /// Holes across.
    pub columns: u32,
    /// Holes down.
    pub rows: u32,
    /// Distance of the holes, mm.
    pub hole_spacing: f64,
    /// Rows that are still full, as seen from the one that is picked.
    pub unpicked: Unpicked,
    /// Length by which an unpicked seedling's stem projects from the tray's surface, mm; it is as wide as a planted one.
    pub stem_length: f64,
}

/// Rows of a tray that are still full while one is picked.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unpicked {
    /// All above it: the tray is emptied from below, as arms that draw seedlings out downwards need.
    #[default]
    Above,
    /// All below it.
    Below,
    /// All on both sides.
    Both,
    /// None.
    None,
}

impl Default for TraySpec {
    fn default() -> Self {
        Self {
            distance: None,
            inclination: 0.0,
            columns: 14,
            rows: 29,
            hole_spacing: 20.0,
            unpicked: Unpicked::default(),
            stem_length: 60.0,
        }
    }
}

impl TraySpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        if let Some(distance) = self.distance {
            finite("distance", distance)?;
        }
        let inclination = self.inclination.to_degrees();
        in_range("inclination_deg", inclination, [-89.0, 89.0], " deg")?;
        count_in_range("columns", self.columns, 1, 1000)?;
        count_in_range("rows", self.rows, 1, 1000)?;
        positive("hole_spacing", self.hole_spacing)?;
        not_negative("stem_length", self.stem_length)
    }
}

/// A planted seedling: a vertical stem.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SeedlingSpec {
    /// Height above the ground up to which a stem must not be pushed, mm; above it the leaves give way.
    pub height: f64,
    /// Width of the stem, mm.
    pub width: f64,
}

impl Default for SeedlingSpec {
    fn default() -> Self {
        Self {
            height: 60.0,
            width: 4.0,
        }
    }
}

impl SeedlingSpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        not_negative("height", self.height)?;
        not_negative("width", self.width)
    }
}
