use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_kinematics::machine::{Stock, hole_class, screw_size, shaft_class};
use centrode_spec::SpecError;
use centrode_spec::rule::{in_range, not_negative, positive, single_line};

/// The links as plates, stacked along the shafts: crank, coupler, rocker, effector.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct PlatesSpec {
    /// Thickness of a plate, mm.
    pub thickness: f64,
    /// Distance of neighbouring plates, mm.
    pub gap: f64,
    /// Width of a plate, mm: it ends in half circles about its joints.
    pub width: f64,
    /// Diameter of the pins, mm.
    pub pin_diameter: f64,
    /// Width of the slot in the effector, in which the slider runs, mm.
    pub slot_width: f64,
    /// Length of the slider along the slot, mm.
    pub slider_length: f64,
    /// Clearance of the slider at the ends of the slot, mm.
    pub slot_clearance: f64,
    /// Nominal diameter of the screws of the frame, ISO 4762, mm: 6 for M6, 0 for none. Default: the largest no thicker
    /// than a plate that finds room.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub screw: Option<f64>,
    /// Tolerance class of the holes for the pins, ISO 286, for the drawing.
    pub hole_fit: String,
    /// Tolerance class of the frame's holes in which the gears' shafts turn, ISO 286, for the drawing.
    pub bearing_fit: String,
    /// Tolerance class of the pins, ISO 286, for the drawing.
    pub pin_fit: String,
    /// Tolerance class of the slot's width, ISO 286, for the drawing.
    pub slot_fit: String,
    /// Tolerance class of the slider's width, ISO 286, for the drawing.
    pub slider_fit: String,
    /// Material, for the drawing.
    pub material: String,
    /// Heat treatment of the plates, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Heat treatment of the pins, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub pin_heat_treatment: String,
    /// Density, kg/m^3.
    pub density: f64,
}

impl Default for PlatesSpec {
    fn default() -> Self {
        Self {
            thickness: 8.0,
            gap: 2.0,
            width: 30.0,
            pin_diameter: 10.0,
            slot_width: 16.0,
            slider_length: 16.0,
            slot_clearance: 1.0,
            screw: None,
            hole_fit: "H8".into(),
            bearing_fit: "F8".into(),
            pin_fit: "f7".into(),
            slot_fit: "H9".into(),
            slider_fit: "e9".into(),
            material: "steel".into(),
            heat_treatment: String::new(),
            pin_heat_treatment: String::new(),
            density: 7850.0,
        }
    }
}

impl PlatesSpec {
    /// Material of the pins.
    #[must_use]
    pub fn pin_stock(&self) -> Stock<'_> {
        Stock::new(&self.material, self.density).treated(&self.pin_heat_treatment)
    }

    pub(super) fn validate(&self) -> Result<(), SpecError> {
        for (key, value) in [
            ("thickness", self.thickness),
            ("width", self.width),
            ("pin_diameter", self.pin_diameter),
            ("slot_width", self.slot_width),
            ("slider_length", self.slider_length),
            ("density", self.density),
        ] {
            positive(key, value)?;
        }
        // There must be material around the holes, and room in the slider for its pin.
        in_range(
            "pin_diameter",
            self.pin_diameter,
            [0.0, 0.9 * self.width],
            " mm",
        )?;
        in_range(
            "slot_width",
            self.slot_width,
            [1.1 * self.pin_diameter, 0.9 * self.width],
            " mm",
        )?;
        in_range(
            "slider_length",
            self.slider_length,
            [self.slot_width, f64::INFINITY],
            " mm",
        )?;
        not_negative("gap", self.gap)?;
        not_negative("slot_clearance", self.slot_clearance)?;
        screw_size("screw", self.screw)?;
        hole_class("hole_fit", &self.hole_fit)?;
        hole_class("bearing_fit", &self.bearing_fit)?;
        hole_class("slot_fit", &self.slot_fit)?;
        shaft_class("pin_fit", &self.pin_fit)?;
        shaft_class("slider_fit", &self.slider_fit)?;
        single_line("material", &self.material)?;
        single_line("heat_treatment", &self.heat_treatment)?;
        single_line("pin_heat_treatment", &self.pin_heat_treatment)?;
        Ok(())
    }
}
