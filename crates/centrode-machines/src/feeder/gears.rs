use std::f64::consts::FRAC_PI_4;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_gear::design::{BodySpec, GearPairDesign, TeethSpec};
use centrode_gear::pitch::{Circle, PitchSpec};
use centrode_gear::{IntermittentDrive, IntermittentError, IntermittentPairSpec, Pins};
use centrode_kinematics::machine::{Keyway, preferred_size};
use centrode_spec::rule::{count_in_range, in_range, not_negative, positive};
use centrode_spec::{SpecError, degrees};

/// The intermittent gear and its mate as written.
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
    /// Normal backlash of the teeth, mm.
    pub backlash: f64,
    /// Clearance between locking arc and notch, mm.
    pub lock_clearance: f64,
    /// Radius of the locking arc, mm. Default: the driver's pitch radius.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lock_radius: Option<f64>,
    /// Diameter of the pins that run on the cams, mm. Default: the preferred size (ISO 497, R''20) nearest to two and a
    /// half modules.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_diameter: Option<f64>,
    /// Diameter of the circle through the pins' centres, mm. Default: three quarters of that of the driven pitch
    /// circle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_circle: Option<f64>,
    /// Angle of each pin from the line of centres at rest, rad (degrees in the file).
    #[serde(rename = "pin_angle_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub pin_angle: f64,
    /// Face width of gears and cam, mm.
    pub width: f64,
    /// Diameter of the bores, and of the shafts in them, mm.
    #[schemars(extend("x-detail" = true))]
    pub bore: f64,
    /// Keyway in the bores, along the x axis of each gear and cam. Default: that of DIN 6885-1 for the bore.
    #[schemars(extend("x-detail" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keyway: Option<Keyway>,
    /// Heat treatment of gears and cams, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    #[schemars(extend("x-detail" = true))]
    pub heat_treatment: String,
    /// Heat treatment of their shafts and of the cams' pins, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    #[schemars(extend("x-detail" = true))]
    pub shaft_heat_treatment: String,
    /// Accuracy class of the teeth, for the drawing: a flank tolerance class of ISO 1328-1, or one of another system in words;
    /// left empty, 8.
    #[serde(skip_serializing_if = "String::is_empty")]
    #[schemars(extend("x-detail" = true))]
    pub accuracy: String,
    /// Upper and lower deviation of the tooth thickness from the nominal one along the pitch circle, mm, each within half a
    /// module: for the drawing, which has limits of the measures over pins by them. Default: zero and minus the tolerance of
    /// DIN 3967 for the accuracy class.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-detail" = true))]
    pub thickness_deviations: Option<[f64; 2]>,
}

impl Default for GearsSpec {
    fn default() -> Self {
        Self {
            driver_pitches: 40,
            driven_pitches: 30,
            teeth: 30,
            entry: 20_f64.to_radians(),
            module: 3.0,
            backlash: 0.1,
            lock_clearance: 0.05,
            lock_radius: None,
            pin_diameter: None,
            pin_circle: None,
            pin_angle: FRAC_PI_4,
            width: 15.0,
            bore: 16.0,
            keyway: None,
            heat_treatment: String::new(),
            shaft_heat_treatment: String::new(),
            accuracy: String::new(),
            thickness_deviations: None,
        }
    }
}

impl GearsSpec {
    /// Maximum number of pitches of a gear.
    const MOST: u32 = 1000;

    pub(super) fn validate(&self) -> Result<(), SpecError> {
        count_in_range("driver_pitches", self.driver_pitches, 1, Self::MOST)?;
        count_in_range("driven_pitches", self.driven_pitches, 1, Self::MOST)?;
        count_in_range("teeth", self.teeth, 1, Self::MOST)?;
        in_range("entry_deg", self.entry.to_degrees(), [0.0, 180.0], " deg")?;
        for (key, value) in [
            ("module", Some(self.module)),
            ("lock_radius", self.lock_radius),
            ("pin_diameter", self.pin_diameter),
            ("pin_circle", self.pin_circle),
            ("width", Some(self.width)),
            ("bore", Some(self.bore)),
        ] {
            if let Some(value) = value {
                positive(key, value)?;
            }
        }
        self.body().validate()?;
        let teeth = TeethSpec {
            thickness_deviations: self.thickness_deviations,
            ..TeethSpec::default()
        };
        teeth.validate()?;
        not_negative("backlash", self.backlash)?;
        not_negative("lock_clearance", self.lock_clearance)?;
        in_range(
            "pin_angle_deg",
            self.pin_angle.to_degrees(),
            [5.0, 85.0],
            " deg",
        )
    }

    /// Body of the gears and cams; each is keyed to its shaft.
    #[must_use]
    pub fn body(&self) -> BodySpec {
        BodySpec {
            width: self.width,
            bore: self.bore,
            keyway: self.keyway.or_else(|| Keyway::of_bore(self.bore)),
            heat_treatment: self.heat_treatment.clone(),
            shaft_heat_treatment: self.shaft_heat_treatment.clone(),
            accuracy: self.accuracy.clone(),
            ..BodySpec::default()
        }
    }

    /// Diameter of the pins that run on the cams, mm.
    #[must_use]
    pub fn cam_pin(&self) -> f64 {
        let usual = || preferred_size(2.5 * self.module);
        self.pin_diameter.unwrap_or_else(usual)
    }

    /// Distance between the two shafts, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        0.5 * self.module * f64::from(self.driver_pitches + self.driven_pitches)
    }

    /// The gears with their teeth.
    #[must_use]
    pub fn pair(&self) -> IntermittentPairSpec {
        let (driver, driven) = (self.driver_pitches, self.driven_pitches);
        let divisor = greatest_common_divisor(driver, driven);
        let mut pair = GearPairDesign::new(PitchSpec::Circle(Circle {
            module: Some(self.module),
            tooth_count: Some(driver),
            ..Circle::default()
        }));
        pair.mean_ratio = [driven / divisor, driver / divisor];
        [pair.driver, pair.driven] = [self.body().into(), self.body().into()];
        pair.teeth.thickness_deviations = self.thickness_deviations;
        IntermittentPairSpec {
            lock_radius: self.lock_radius,
            lock_clearance: self.lock_clearance,
            backlash: self.backlash,
            pins: Pins {
                diameter: Some(self.cam_pin()),
                circle: self.pin_circle,
                angle: self.pin_angle,
            },
            ..IntermittentPairSpec::new(pair, self.teeth, self.entry)
        }
    }

    /// Motion of the gears.
    ///
    /// # Errors
    /// [`IntermittentError`], for instance for equal pitch circles, which leave no dwell.
    pub fn drive(&self) -> Result<IntermittentDrive, IntermittentError> {
        let (driver, driven) = (self.driver_pitches, self.driven_pitches);
        IntermittentDrive::new(driver, driven, self.teeth, self.entry)
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 {
        a.max(1)
    } else {
        greatest_common_divisor(b, a % b)
    }
}
