use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Groove, ShaftError};
use centrode_kinematics::machine::{Keyway, hole_class, shaft_class};
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, not_negative, positive, single_line};

/// Body of the shaft, apart from its groove.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct ShaftBody {
    /// Length of full cylinder beyond the groove at each end, mm.
    pub margin: f64,
    /// Radius between the groove's walls and its floor, mm.
    pub fillet: f64,
    /// Diameter of the journals at both ends, mm.
    pub journal_diameter: f64,
    /// Tolerance class of the journals, ISO 286, for the drawing.
    pub journal_fit: String,
    /// Length of each journal, mm.
    pub journal_length: f64,
    /// Chamfers at 45 deg on every end, mm.
    pub chamfer: f64,
    /// Keyway in the near journal, along x, open at the tip and half round at its other end; depth from the journal's surface.
    pub keyway: Option<Keyway>,
    /// Tolerance class of the keyway's width, ISO 286, for the drawing.
    pub keyway_fit: String,
    /// Length of the keyway, its half round end included, mm.
    pub keyway_length: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Material, for the drawing.
    pub material: String,
    /// Heat treatment, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
}

impl Default for ShaftBody {
    fn default() -> Self {
        Self {
            margin: 8.0,
            fillet: 0.5,
            journal_diameter: 16.0,
            journal_fit: "h6".into(),
            journal_length: 25.0,
            chamfer: 1.0,
            keyway: Some(Keyway {
                width: 5.0,
                depth: 3.0,
            }),
            keyway_fit: "N9".into(),
            keyway_length: 18.0,
            density: 7850.0,
            material: "steel".into(),
            heat_treatment: String::new(),
        }
    }
}

impl ShaftBody {
    /// Checks the ranges, and that everything fits the groove's shaft.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn validate(&self, groove: &Groove) -> Result<(), ShaftError> {
        self.ranges(groove).map_err(|e| e.inside("body").into())
    }

    fn ranges(&self, groove: &Groove) -> Result<(), SpecError> {
        positive("margin", self.margin)?;
        not_negative("fillet", self.fillet)?;
        positive("journal_diameter", self.journal_diameter)?;
        positive("journal_length", self.journal_length)?;
        not_negative("chamfer", self.chamfer)?;
        positive("density", self.density)?;
        hole_class("keyway_fit", &self.keyway_fit)?;
        shaft_class("journal_fit", &self.journal_fit)?;
        single_line("material", &self.material)?;
        single_line("heat_treatment", &self.heat_treatment)?;
        let below = |key: &str, value: f64, limit: f64| {
            if value < limit {
                return Ok(());
            }
            let rule = Rule::OutOfRange {
                value,
                minimum: 0.0,
                maximum: limit,
                unit: " mm",
            };
            broken(key, rule)
        };
        below("fillet", self.fillet, 0.5 * groove.width())?;
        below("fillet", self.fillet, groove.depth())?;
        let (radius, journal) = (groove.radius(), 0.5 * self.journal_diameter);
        below("journal_diameter", self.journal_diameter, 2.0 * radius)?;
        below("chamfer", self.chamfer, radius - journal)?;
        below("chamfer", self.chamfer, self.margin)?;
        below("chamfer", self.chamfer, 0.5 * journal)?;
        below("chamfer", self.chamfer, self.journal_length)?;
        if let Some(Keyway { width, depth }) = self.keyway {
            positive("keyway.width", width)?;
            positive("keyway.depth", depth)?;
            positive("keyway_length", self.keyway_length)?;
            let end = journal - self.chamfer;
            below("keyway.width", width, 1.8 * end)?;
            let edge = (end * end - 0.25 * width * width).sqrt();
            below("keyway.depth", depth, journal)?;
            below("keyway.depth", journal - depth, edge)?;
            below("keyway_length", self.keyway_length, self.journal_length)?;
            below("chamfer", self.chamfer, self.keyway_length)?;
        }
        Ok(())
    }

    /// Length of the keyway's half round end beyond its straight walls, mm: half its width, as an end mill makes it. Zero, for a
    /// plane end, without a keyway or if no straight walls are left beyond the chamfer.
    #[must_use]
    pub fn keyway_rounding(&self) -> f64 {
        let half = 0.5 * self.keyway.map_or(0.0, |key| key.width);
        if self.keyway_length - self.chamfer > half {
            half
        } else {
            0.0
        }
    }
}
