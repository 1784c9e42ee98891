use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_kinematics::machine::{Fit, Keyway, Stock, hole_class, shaft_class};
use centrode_spec::degrees;
use centrode_spec::rule::{
    Rule, SpecError, broken, in_range, is_zero, not_negative, positive, single_line,
};

/// Body of a gear: all but its teeth.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct BodySpec {
    /// Face width, mm.
    pub width: f64,
    /// Diameter of the bore, mm; 0 for none.
    pub bore: f64,
    /// Keyway in the bore.
    pub keyway: Option<Keyway>,
    /// Direction of the keyway from the body's x axis, rad (degrees in the file).
    #[serde(rename = "keyway_angle_deg", with = "degrees")]
    #[serde(skip_serializing_if = "is_zero")]
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
    /// Heat treatment, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Heat treatment of the shaft in the bore, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub shaft_heat_treatment: String,
    /// Accuracy class of the teeth, for the drawing: a flank tolerance class of ISO 1328-1, or one of another system in words;
    /// left empty, 8.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub accuracy: String,
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
            shaft_heat_treatment: String::new(),
            accuracy: String::new(),
        }
    }
}

impl BodySpec {
    /// Fit of its bore on its shaft, under a name.
    #[must_use]
    pub fn seat(&self, name: &str) -> Fit {
        Fit::new(name, self.bore, [&self.bore_fit, &self.shaft_fit])
    }

    /// Material of the shaft in its bore.
    #[must_use]
    pub fn shaft_stock(&self) -> Stock<'_> {
        Stock::new(&self.material, self.density).treated(&self.shaft_heat_treatment)
    }

    /// The body with the keyway that DIN 6885-1 has for its bore, or without one if the standard has none. The body is mounted at
    /// an angle, rad; the keyway is along the x axis of the part that carries it.
    pub fn keyed(self, mount: f64) -> Self {
        let keyway = Keyway::of_bore(self.bore);
        let turned = TAU * (mount / TAU).round() - mount;
        Self {
            keyway,
            keyway_angle: keyway.map_or(0.0, |_| turned),
            ..self
        }
    }

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
        hole_class("bore_fit", &self.bore_fit)?;
        hole_class("keyway_fit", &self.keyway_fit)?;
        shaft_class("shaft_fit", &self.shaft_fit)?;
        let words = [
            ("material", &self.material),
            ("heat_treatment", &self.heat_treatment),
            ("shaft_heat_treatment", &self.shaft_heat_treatment),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_keyed_along_the_x_axis_of_what_carries_it() {
        let body = |bore: f64| BodySpec {
            bore,
            ..BodySpec::default()
        };
        for mount in [0.0, 0.3, -2.0, 3.0, -7.1, 40.0] {
            let keyed = body(16.0).keyed(mount);
            let hub = keyed.keyway.expect("a keyway");
            assert_eq!((hub.width, hub.depth), (5.0, 2.3));
            // Mounted by the angle, its keyway is a whole number of turns from the x axis.
            let turns = (keyed.keyway_angle + mount) / TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{mount}");
            assert!(keyed.keyway_angle.abs() <= TAU && keyed.validate().is_ok());
            // Below the minimum bore of the standard there is no keyway, and no angle of one.
            let small = body(5.0).keyed(mount);
            assert_eq!((small.keyway, small.keyway_angle), (None, 0.0));
        }
    }
}
