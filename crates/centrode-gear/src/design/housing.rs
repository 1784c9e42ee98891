use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::rule::{SpecError, not_negative, positive};

/// Housing of a flow meter or pump: a plate around both gears.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct HousingSpec {
    /// Gap between the tips and the chamber, and between the gears and each cover, mm; default: no housing.
    pub gap: Option<f64>,
    /// Thickness of the wall around the chamber, mm.
    pub wall: f64,
}

impl Default for HousingSpec {
    fn default() -> Self {
        Self {
            gap: None,
            wall: 10.0,
        }
    }
}

impl HousingSpec {
    /// Checks both lengths.
    ///
    /// # Errors
    /// [`SpecError`] if the gap is negative or the wall not positive.
    pub fn validate(&self) -> Result<(), SpecError> {
        positive("wall", self.wall)?;
        self.gap.map_or(Ok(()), |gap| not_negative("gap", gap))
    }

    /// Whether every value is the default.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
