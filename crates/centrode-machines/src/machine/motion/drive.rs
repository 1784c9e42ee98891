//! Laws of joints that an intermittent gear or a grooved shaft drives.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_gear::IntermittentDrive;
use centrode_groove::{Reversal, SpeedLaw, Traverse};
use centrode_kinematics::transmission::Transmission;
use centrode_spec::rule::{count_in_range, finite, in_range, positive};
use centrode_spec::{SpecError, degrees};

/// Maximum number of pitches of a gear.
const MAX_PITCHES: u32 = 1000;

/// Motion of a gear driven by an intermittent one: it turns and rests.
///
/// N teeth turn the driven gear by N of its pitches while the driver turns by N of its own and the entry angle; over the rest of
/// the driver's turn it is locked. Entry and exit bring it to speed along 10 u³ - 15 u⁴ + 6 u⁵.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct IntermittentSpec {
    /// Pitches all round the driver, with teeth or not.
    pub driver_pitches: u32,
    /// Pitches all round the driven gear.
    pub driven_pitches: u32,
    /// Pitches by which the driver turns the driven gear in one turn of its own.
    pub teeth: u32,
    /// Driver angle over which the driven gear is brought to speed and, at the end, to rest, rad (degrees in the file); 0: its
    /// speed jumps.
    #[serde(rename = "entry_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub entry: f64,
}

/// Motion of a slider in the groove of a variable-speed spiral shaft: strokes out and back with a reversal at either end.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct TraverseSpec {
    /// Lead, mm per turn of the shaft.
    pub lead: f64,
    /// Positions a lead apart from one end of a stroke to the other.
    pub holes: u32,
    /// Radius of the shaft, mm, which a law along the helix needs.
    pub radius: f64,
    /// Turn of the shaft at which the stroke out begins, rad (degrees in the file).
    #[serde(rename = "pick_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub pick: f64,
    /// Distance of the stroke back from the stroke out, mm towards the near end.
    pub return_offset: f64,
    /// Speed along the shaft.
    pub law: SpeedLaw,
    /// Reversal at both ends.
    pub reversal: Reversal,
}

impl Default for IntermittentSpec {
    fn default() -> Self {
        Self {
            driver_pitches: 40,
            driven_pitches: 30,
            teeth: 30,
            entry: 0.0,
        }
    }
}

impl Default for TraverseSpec {
    fn default() -> Self {
        Self {
            lead: 20.0,
            holes: 14,
            radius: 15.0,
            pick: 0.0,
            return_offset: 0.0,
            law: SpeedLaw::default(),
            reversal: Reversal::default(),
        }
    }
}

impl IntermittentSpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        for (key, count) in [
            ("driver_pitches", self.driver_pitches),
            ("driven_pitches", self.driven_pitches),
            ("teeth", self.teeth),
        ] {
            count_in_range(key, count, 1, MAX_PITCHES)?;
        }
        in_range("entry_deg", self.entry.to_degrees(), [0.0, 180.0], " deg")
    }

    /// The motion as a function of the driver's turn, or the reason why there is none.
    pub(in crate::machine) fn resolve(&self) -> Result<Arc<dyn Transmission>, String> {
        let (driver, driven) = (self.driver_pitches, self.driven_pitches);
        let drive = IntermittentDrive::new(driver, driven, self.teeth, self.entry);
        Ok(Arc::new(drive.map_err(|e| e.to_string())?.transmission()))
    }
}

impl TraverseSpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        positive("lead", self.lead)?;
        positive("radius", self.radius)?;
        count_in_range("holes", self.holes, 2, 1000)?;
        finite("pick_deg", self.pick)?;
        finite("return_offset", self.return_offset)
    }

    /// The motion as a function of the shaft's turn, or the reason why there is none.
    pub(in crate::machine) fn resolve(&self) -> Result<Arc<dyn Transmission>, String> {
        let law = self.law.resolve(self.lead, self.radius);
        let made = law.and_then(|law| {
            let offset = self.return_offset;
            Traverse::starting_at(self.pick, law, self.holes, &self.reversal, offset)
        });
        Ok(Arc::new(made.map_err(|e| e.to_string())?))
    }
}
