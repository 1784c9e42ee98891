use std::ops::{Deref, DerefMut};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::body::BodySpec;
use super::tool::ToolSpec;
use centrode_spec::rule::{SpecError, in_range, positive};

/// Range of a profile shift coefficient.
pub const SHIFTS: [f64; 2] = [-2.0, 2.0];

/// One gear of a pair: shift, heights and tool of its teeth, and its body.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct GearSpec {
    /// Profile shift coefficient: distance in modules by which the tool is moved away from the axis. Default: opposite to that
    /// of the mate, or for circular gears the shift that gives the centre distance.
    #[schemars(extend("x-symbol" = "x"))]
    pub shift: Option<f64>,
    /// Height of the teeth above the pitch curve without profile shift, in modules. Default: that of the tool.
    pub addendum: Option<f64>,
    /// Depth of the spaces below the pitch curve without profile shift, in modules. Default: that of the tool.
    pub dedendum: Option<f64>,
    /// The tool that cuts this gear, of the same pressure angle. Default: the tool of the pair.
    pub tool: Option<ToolSpec>,
    /// Body of the gear.
    #[serde(flatten)]
    pub body: BodySpec,
}

impl GearSpec {
    /// Checks the ranges, and that the keyway fits the bore.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        if let Some(shift) = self.shift {
            in_range("shift", shift, SHIFTS, "")?;
        }
        for (key, height) in [("addendum", self.addendum), ("dedendum", self.dedendum)] {
            if let Some(height) = height {
                positive(key, height)?;
                in_range(key, height, [0.0, 3.0], "")?;
            }
        }
        if let Some(tool) = &self.tool {
            tool.validate().map_err(|e| e.inside("tool"))?;
        }
        self.body.validate()
    }
}

impl From<BodySpec> for GearSpec {
    fn from(body: BodySpec) -> Self {
        Self {
            body,
            ..Self::default()
        }
    }
}

impl Deref for GearSpec {
    type Target = BodySpec;

    fn deref(&self) -> &BodySpec {
        &self.body
    }
}

impl DerefMut for GearSpec {
    fn deref_mut(&mut self) -> &mut BodySpec {
        &mut self.body
    }
}
