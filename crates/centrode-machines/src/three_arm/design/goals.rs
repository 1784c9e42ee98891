use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ordered;
use centrode_spec::rule::finite;
use centrode_spec::{SpecError, degrees};

/// Goals of a good mechanism; the defaults are the eight goals of the 2021 machine.
///
/// Source: Yin et al., Int J Agric & Biol Eng 14(5), 2021, section 4.1, DOI 10.25165/j.ijabe.20211405.6844. The paper
/// names the first and the fifth without a figure; theirs are clearances of zero.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct GoalsSpec {
    /// 1: minimum clearance between two arms, mm.
    pub arm_clearance: f64,
    /// 2: range of the clamp's elevation above the horizontal at picking, rad (degrees in the file).
    #[serde(rename = "pick_angle_deg", with = "degrees")]
    #[schemars(with = "[f64; 2]")]
    pub pick_angle: [f64; 2],
    /// 3: range of the clamp's depression below the horizontal at planting, rad (degrees in the file).
    #[serde(rename = "push_angle_deg", with = "degrees")]
    #[schemars(with = "[f64; 2]")]
    pub push_angle: [f64; 2],
    /// 4: range of the clamp's turn from picking to planting, rad (degrees in the file).
    #[serde(rename = "angle_difference_deg", with = "degrees")]
    #[schemars(with = "[f64; 2]")]
    pub angle_difference: [f64; 2],
    /// 5: minimum clearance of the clamp from planted seedlings, mm.
    pub seedling_clearance: f64,
    /// 6: minimum clearance of the gearbox above the ground, mm.
    pub gearbox_clearance: f64,
    /// 7: minimum height of the tip's trajectory, mm.
    pub trajectory_height: f64,
    /// 8: minimum module, mm.
    pub module: f64,
}

impl Default for GoalsSpec {
    fn default() -> Self {
        let range = |minimum: f64, maximum: f64| [minimum.to_radians(), maximum.to_radians()];
        Self {
            arm_clearance: 0.0,
            pick_angle: range(-5.0, 15.0),
            push_angle: range(45.0, 65.0),
            angle_difference: range(50.0, 60.0),
            seedling_clearance: 0.0,
            gearbox_clearance: 20.0,
            trajectory_height: 260.0,
            module: 2.5,
        }
    }
}

impl GoalsSpec {
    /// Checks that the ranges are in order and the numbers finite.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        for (key, range) in [
            ("pick_angle_deg", self.pick_angle),
            ("push_angle_deg", self.push_angle),
            ("angle_difference_deg", self.angle_difference),
        ] {
            ordered(key, range)?;
        }
        for (key, minimum) in [
            ("arm_clearance", self.arm_clearance),
            ("seedling_clearance", self.seedling_clearance),
            ("gearbox_clearance", self.gearbox_clearance),
            ("trajectory_height", self.trajectory_height),
            ("module", self.module),
        ] {
            finite(key, minimum)?;
        }
        Ok(())
    }
}
