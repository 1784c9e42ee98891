use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::degrees;
use crate::gear::design::SpecError;
use crate::gear::design::rule::{between, positive, within};
use crate::gear::{IncompleteDrive, IncompleteError};

/// The incomplete gear and its mate as written.
///
/// The default turns the mate once while the driver turns three quarters of a turn and an entry angle, and locks
/// it for the rest: 30 teeth on 40 pitches drive 30 pitches.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct GearsSpec {
    /// Pitches all round the driver, with teeth or not.
    pub driver_pitches: u32,
    /// Pitches all round the driven gear.
    pub driven_pitches: u32,
    /// Pitches by which the driver turns the driven gear in one turn of its own.
    pub teeth: u32,
    /// Driver angle over which the driven gear is brought to speed and, at the end, to rest, rad (degrees in
    /// the file); without it the speed jumps.
    #[serde(rename = "entry_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub entry: f64,
    /// Module, mm.
    pub module: f64,
}

impl Default for GearsSpec {
    fn default() -> Self {
        Self {
            driver_pitches: 40,
            driven_pitches: 30,
            teeth: 30,
            entry: 20_f64.to_radians(),
            module: 3.0,
        }
    }
}

impl GearsSpec {
    /// Most pitches round a gear.
    const MOST: u32 = 1000;

    pub(super) fn validate(&self) -> Result<(), SpecError> {
        within("driver_pitches", self.driver_pitches, 1, Self::MOST)?;
        within("driven_pitches", self.driven_pitches, 1, Self::MOST)?;
        within("teeth", self.teeth, 1, Self::MOST)?;
        between("entry_deg", self.entry.to_degrees(), [0.0, 180.0], " deg")?;
        positive("module", self.module)
    }

    /// The motion they make.
    ///
    /// # Errors
    /// [`IncompleteError`], for instance for equal pitch circles, which leave nothing to dwell.
    pub fn drive(&self) -> Result<IncompleteDrive, IncompleteError> {
        let (driver, driven) = (self.driver_pitches, self.driven_pitches);
        IncompleteDrive::new(driver, driven, self.teeth, self.entry)
    }
}
