use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::degrees;

/// Gear of a pair.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GearRole {
    /// The driver of the pair.
    Driver,
    /// The driven gear.
    Driven,
}

/// A gear of a pair on a body.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ComposedGearSpec {
    /// Name of the pair.
    pub pair: String,
    /// Gear of the pair: driver or driven; whichever of the two moves the other in this machine.
    pub role: GearRole,
    /// Point of a body on which its axis is, `frame.O`; or the body alone for its origin.
    pub on: String,
    /// Angle at which it is mounted, of its own axes against the body's, rad (degrees in the file).
    #[serde(default, rename = "mount_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub mount: f64,
}

/// Mesh that holds a body on the one that carries it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ComposedMeshSpec {
    /// Gear of the body, with its axis at the body's origin.
    pub gear: String,
    /// Gear of another body of the same pair, whose axis the carrier carries, too.
    pub with: String,
    /// Direction from that gear's axis to the body's, in the carrier's axes, rad (degrees in the file); they are the pair's
    /// centre distance apart.
    #[serde(rename = "direction_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub direction: f64,
}

/// Two gears that mesh beside those by which bodies are held: checked.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ComposedLoopSpec {
    /// The two gears.
    pub gears: [String; 2],
}
