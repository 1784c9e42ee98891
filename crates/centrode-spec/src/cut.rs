use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::SpecError;
use crate::rule::in_range;

/// How parts are cut from a plate.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct CutSpec {
    /// Width of the cut, mm: cutting files then contain the path of its middle, half of this outside contours and inside holes.
    pub kerf: f64,
}

impl CutSpec {
    /// Maximum width of a cut, mm: that of a thick plate cut by a torch. Wider ones are typing errors.
    pub const MAX_KERF: f64 = 20.0;

    /// Checks the width.
    ///
    /// # Errors
    /// [`SpecError`] unless it is 0 to 20 mm.
    pub fn validate(&self) -> Result<(), SpecError> {
        in_range("kerf", self.kerf, [0.0, Self::MAX_KERF], " mm")
    }

    /// Whether every value is the default.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
