//! The design file: TOML in, a description of one family of mechanism out.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod drawing;
mod family;
mod fault;
mod file;
mod keys;
mod number;

pub use drawing::{DrawingSpec, Projection, SheetSize};
pub use fault::{DesignError, DesignFault};
pub use file::DesignFile;
pub use number::NumberedDesign;

use crate::feeder::FeederDesign;
use crate::gear::design::GearPairDesign;
use crate::shaft::{MovingBoxDesign, SpiralShaftDesign};
use crate::three_arm::design::ThreeArmDesign;

/// A mechanism as written: one of the families, by the key `family`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "family", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Design {
    /// A non-circular gear pair.
    GearPair(Box<GearPairDesign>),
    /// A three-arm transplanting mechanism.
    ThreeArm(Box<ThreeArmDesign>),
    /// A variable-speed spiral shaft.
    SpiralShaft(Box<SpiralShaftDesign>),
    /// A seedling box moved at a variable speed.
    MovingBox(Box<MovingBoxDesign>),
    /// A willow-cutting feeder.
    Feeder(Box<FeederDesign>),
}

impl Design {
    /// The names of the families, as written in `family`.
    pub const FAMILIES: [&'static str; 5] = [
        "gear-pair",
        "three-arm",
        "spiral-shaft",
        "moving-box",
        "feeder",
    ];

    /// A commented design file of a family to start from, itself a good design.
    #[must_use]
    pub fn template(family: &str) -> Option<&'static str> {
        match family {
            "gear-pair" => Some(include_str!("../design/gear_pair.toml")),
            "three-arm" => Some(include_str!("../design/three_arm.toml")),
            "spiral-shaft" => Some(include_str!("../design/spiral_shaft.toml")),
            "moving-box" => Some(include_str!("../design/moving_box.toml")),
            "feeder" => Some(include_str!("../design/feeder.toml")),
            _ => None,
        }
    }

    /// The JSON schema of the design file, of whatever family.
    #[must_use]
    pub fn json_schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }

    /// The JSON schema of the design files of one family.
    #[must_use]
    pub fn json_schema_of(family: &str) -> Option<serde_json::Value> {
        let mut schema = match family {
            "gear-pair" => schemars::schema_for!(GearPairDesign),
            "three-arm" => schemars::schema_for!(ThreeArmDesign),
            "spiral-shaft" => schemars::schema_for!(SpiralShaftDesign),
            "moving-box" => schemars::schema_for!(MovingBoxDesign),
            "feeder" => schemars::schema_for!(FeederDesign),
            _ => return None,
        };
        let word = serde_json::json!({ "type": "string", "const": family });
        if let Some(properties) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) {
            properties.insert("family".into(), word);
        }
        match schema.get_mut("required").and_then(|r| r.as_array_mut()) {
            Some(required) => required.push("family".into()),
            None => {
                schema.insert("required".into(), serde_json::json!(["family"]));
            }
        }
        Some(schema.to_value())
    }

    /// Reads a design file and checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`DesignError`] naming key, line and column.
    pub fn from_toml(text: &str) -> Result<Self, DesignError> {
        DesignFile::read(text.as_bytes()).map(DesignFile::into_design)
    }

    /// The design as a file; reads back as the same design.
    ///
    /// # Errors
    /// [`DesignFault::NotWritable`] for a number no file can hold, such as a tooth count above the
    /// greatest whole number of TOML.
    pub fn to_toml(&self) -> Result<String, DesignError> {
        toml::to_string(self).map_err(|e| DesignError {
            fault: DesignFault::NotWritable(e.to_string()),
            key: String::new(),
            line: 1,
            column: 1,
        })
    }

    /// Checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`SpecError`](crate::gear::design::SpecError) with the key at fault.
    pub fn validate(&self) -> Result<(), crate::gear::design::SpecError> {
        match self {
            Self::GearPair(design) => design.validate(),
            Self::ThreeArm(design) => design.validate(),
            Self::SpiralShaft(design) => design.validate(),
            Self::MovingBox(design) => design.validate(),
            Self::Feeder(design) => design.validate(),
        }
    }
}

#[cfg(test)]
mod tests;
