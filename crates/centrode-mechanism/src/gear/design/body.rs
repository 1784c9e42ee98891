use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::{Rule, SpecError, broken, in_range, not_negative, positive, single_line};
use crate::degrees;

/// Body of a gear: all but its teeth.
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
    /// Direction of the keyway from the body's x axis, rad (degrees in the file).
    #[serde(rename = "keyway_angle_deg", with = "degrees")]
    #[serde(skip_serializing_if = "is_along_x")]
    #[schemars(with = "f64")]
    pub keyway_angle: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Material, for the drawing.
    pub material: String,
    /// Tolerance class of the bore, ISO 286, for the drawing.
    pub bore_fit: String,
    /// Tolerance class of the shaft in the bore, ISO 286, for the drawing.
    pub shaft_fit: String,
    /// Tolerance class of the keyway's width, ISO 286, for the drawing.
    pub keyway_fit: String,
    /// Heat treatment, for the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Accuracy class of the teeth, for the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub accuracy: String,
}

/// A keyway in the bore, along the body's x axis unless its body says otherwise.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Keyway {
    /// Width, mm.
    pub width: f64,
    /// Depth below the bore's circle, mm, measured on the middle of the keyway.
    pub depth: f64,
}

/// Whether a keyway's angle is zero and need not be written.
fn is_along_x(angle: &f64) -> bool {
    *angle == 0.0
}

impl Keyway {
    /// The keyway of a hub whose parallel key lies in this one of a shaft: as wide, and as deep as DIN 6885-1 asks for
    /// keys of its widths; for others, a square key with room above it.
    #[must_use]
    pub fn of_hub(self) -> Self {
        // Width and height of the key, depth left to the hub beyond that of the shaft.
        const KEYS: [(f64, f64, f64); 15] = [
            (2.0, 2.0, 0.2),
            (3.0, 3.0, 0.2),
            (4.0, 4.0, 0.3),
            (5.0, 5.0, 0.3),
            (6.0, 6.0, 0.3),
            (8.0, 7.0, 0.3),
            (10.0, 8.0, 0.3),
            (12.0, 8.0, 0.3),
            (14.0, 9.0, 0.3),
            (16.0, 10.0, 0.3),
            (18.0, 11.0, 0.4),
            (20.0, 12.0, 0.4),
            (22.0, 14.0, 0.4),
            (25.0, 14.0, 0.4),
            (28.0, 16.0, 0.4),
        ];
        let Self { width, depth } = self;
        let standard = KEYS.into_iter().find(|(b, ..)| *b == width);
        let (_, height, room) = standard.unwrap_or((width, width, 0.06 * width));
        Self {
            width,
            depth: (height - depth + room).max(room),
        }
    }
}

impl Default for BodySpec {
    fn default() -> Self {
        Self {
            width: 10.0,
            bore: 0.0,
            keyway: None,
            keyway_angle: 0.0,
            density: 7850.0,
            material: "steel".into(),
            bore_fit: "H7".into(),
            shaft_fit: "h6".into(),
            keyway_fit: "JS9".into(),
            heat_treatment: String::new(),
            accuracy: String::new(),
        }
    }
}

impl BodySpec {
    /// Checks the ranges, and that the keyway fits the bore.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        positive("width", self.width)?;
        not_negative("bore", self.bore)?;
        positive("density", self.density)?;
        let angle = self.keyway_angle.to_degrees();
        in_range("keyway_angle_deg", angle, [-360.0, 360.0], " deg")?;
        let words = [
            ("material", &self.material),
            ("bore_fit", &self.bore_fit),
            ("shaft_fit", &self.shaft_fit),
            ("keyway_fit", &self.keyway_fit),
            ("heat_treatment", &self.heat_treatment),
            ("accuracy", &self.accuracy),
        ];
        for (key, word) in words {
            single_line(key, word)?;
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
