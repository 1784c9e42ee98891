use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::{Rule, SpecError, broken, line, not_negative, positive};

/// The body of a gear: what is not teeth.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodySpec {
    /// Face width, mm.
    pub width: f64,
    /// Diameter of the bore, mm; 0 for none.
    pub bore: f64,
    /// Keyway in the bore.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keyway: Option<Keyway>,
    /// Density, kg/m^3.
    pub density: f64,
    /// Material, for the drawing.
    pub material: String,
    /// Tolerance class of the bore, ISO 286, for the drawing.
    pub bore_fit: String,
    /// Tolerance class of the keyway's width, ISO 286, for the drawing.
    pub keyway_fit: String,
    /// Heat treatment, for the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Accuracy class of the teeth, for the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub accuracy: String,
}

/// A keyway in the bore, along the body's x axis.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Keyway {
    /// Width, mm.
    pub width: f64,
    /// Depth below the bore's circle, mm, measured on the middle of the keyway.
    pub depth: f64,
}

impl Default for BodySpec {
    fn default() -> Self {
        Self {
            width: 10.0,
            bore: 0.0,
            keyway: None,
            density: 7850.0,
            material: "steel".into(),
            bore_fit: "H7".into(),
            keyway_fit: "JS9".into(),
            heat_treatment: String::new(),
            accuracy: String::new(),
        }
    }
}

impl BodySpec {
    /// Ranges, and a keyway that fits the bore.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        positive("width", self.width)?;
        not_negative("bore", self.bore)?;
        positive("density", self.density)?;
        let words = [
            ("material", &self.material),
            ("bore_fit", &self.bore_fit),
            ("keyway_fit", &self.keyway_fit),
            ("heat_treatment", &self.heat_treatment),
            ("accuracy", &self.accuracy),
        ];
        for (key, word) in words {
            line(key, word)?;
        }
        let Some(Keyway { width, depth }) = self.keyway else {
            return Ok(());
        };
        positive("keyway.width", width)?;
        positive("keyway.depth", depth)?;
        if self.bore == 0.0 {
            return broken("keyway", Rule::NoBore);
        }
        if width >= self.bore {
            return broken("keyway.width", Rule::KeywayWidth(width, self.bore));
        }
        Ok(())
    }
}
