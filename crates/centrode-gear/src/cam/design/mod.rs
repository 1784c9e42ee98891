//! The design of a disc cam, with the same keys in the file, in Rust and in Python.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod follower;
mod motion;

pub use follower::{
    Follower, SwingingFlat, SwingingRoller, TranslatingFlat, TranslatingRoller, Turn,
};
pub use motion::{Dwell, MotionSpec, SegmentSpec, Transition, Travel};

use crate::design::BodySpec;
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, design_name, positive};

/// A disc cam and its follower.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CamSpec {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Radius of the base circle, mm: the largest about the axis that fits in a cam without undercut.
    pub base_radius: f64,
    /// Sense in which the cam turns, seen from the follower.
    #[serde(default)]
    pub rotation: Turn,
    /// Follower that rides on the cam.
    pub follower: Follower,
    /// Motion of the follower.
    pub motion: MotionSpec,
    /// Width, bore and material.
    #[serde(default)]
    pub body: BodySpec,
}

fn default_name() -> String {
    "cam".into()
}

impl CamSpec {
    /// A cam with every other value at its default.
    #[must_use]
    pub fn new(base_radius: f64, follower: Follower, motion: MotionSpec) -> Self {
        Self {
            name: default_name(),
            title: String::new(),
            base_radius,
            rotation: Turn::default(),
            follower,
            motion,
            body: BodySpec::default(),
        }
    }

    /// Checks the rules that need no geometry: ranges, and keys that contradict each other.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault and the rule it breaks.
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        positive("base_radius", self.base_radius)?;
        self.follower.validate().map_err(|e| e.inside("follower"))?;
        self.motion.validate().map_err(|e| e.inside("motion"))?;
        self.body.validate().map_err(|e| e.inside("body"))?;
        match (self.follower.swings(), self.motion.swings()) {
            (true, Some(false)) => broken("motion", Rule::Stroke("swing_deg")),
            (false, Some(true)) => broken("motion", Rule::Stroke("lift")),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
