use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::angle;
use crate::arm::{ArmBodySpec, UsualArm};
use centrode_kinematics::machine::screw_size;
use centrode_spec::rule::{in_range, not_negative, positive, single_line};
use centrode_spec::{SpecError, degrees};

/// An arm, fixed to its planet.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ArmSpec {
    /// Direction of the tip from the planet's axis, from the planet's zero, rad (degrees in the file).
    #[serde(rename = "mounting_angle_deg", with = "degrees")]
    #[schemars(with = "f64", extend("x-symbol" = "beta_0"))]
    pub mounting_angle: f64,
    /// Distance of the tip from the planet's axis, mm.
    #[schemars(extend("x-symbol" = "S"))]
    pub tip_distance: f64,
    /// Distance of the pusher's axis, which ends at the tip, from the planet's axis, mm: positive where the clamp
    /// points more counter-clockwise than the tip lies.
    #[schemars(extend("x-symbol" = "H_1"))]
    pub pusher_offset: f64,
    /// Length of the clamp back from the tip along the pusher's axis, mm: the part that passes between seedlings.
    #[serde(default = "default_clamp_length")]
    pub clamp_length: f64,
    /// Housing, clamp, push rod and spring; default: the usual sizes in proportion to `tip_distance`, or smaller
    /// where clamp and pusher's axis leave less room.
    pub body: Option<ArmBodySpec>,
}

fn default_clamp_length() -> f64 {
    60.0
}

impl ArmSpec {
    /// Makes an arm with the default length of the clamp and the default body.
    #[must_use]
    pub fn new(mounting_angle: f64, tip_distance: f64, pusher_offset: f64) -> Self {
        Self {
            mounting_angle,
            tip_distance,
            pusher_offset,
            clamp_length: default_clamp_length(),
            body: None,
        }
    }

    /// The default sizes that fit this arm.
    #[must_use]
    pub fn usual(&self) -> UsualArm {
        UsualArm::new(self.tip_distance, self.pusher_offset, self.clamp_length)
    }

    /// Checks the ranges, and that the pusher's axis reaches the tip.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        angle("mounting_angle_deg", self.mounting_angle)?;
        positive("tip_distance", self.tip_distance)?;
        let reach = self.tip_distance;
        in_range("pusher_offset", self.pusher_offset, [-reach, reach], " mm")?;
        positive("clamp_length", self.clamp_length)?;
        let body = self.body.as_ref();
        body.map_or(Ok(()), ArmBodySpec::validate)
            .map_err(|e| e.inside("body"))
    }
}

/// The gearbox: the carrier's housing around sun, intermediate gears and planets.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct GearboxSpec {
    /// Distance of the housing's outside from the largest radius of the pitch curve in it, mm.
    pub housing_offset: f64,
    /// Thickness of its plates, mm.
    pub wall: f64,
    /// Clearance between the gears' faces and the plates, mm.
    pub clearance: f64,
    /// Whether the shafts turn in ball bearings in the plates, where bearings of their bores are as narrow as these are thick.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub bearings: bool,
    /// Nominal diameter of the screws of the plates, ISO 4762, mm: 6 for M6, 0 for none; default: the largest no thicker than a
    /// plate that finds room.
    pub screw: Option<f64>,
    /// Heat treatment of its plates, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
}

impl Default for GearboxSpec {
    fn default() -> Self {
        Self {
            housing_offset: 10.0,
            wall: 6.0,
            clearance: 2.0,
            bearings: false,
            screw: None,
            heat_treatment: String::new(),
        }
    }
}

impl GearboxSpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        not_negative("housing_offset", self.housing_offset)?;
        positive("wall", self.wall)?;
        not_negative("clearance", self.clearance)?;
        screw_size("screw", self.screw)?;
        single_line("heat_treatment", &self.heat_treatment)
    }
}
