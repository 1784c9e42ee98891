use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_gear::cam::law::LawSpec;
use centrode_gear::design::BodySpec;
use centrode_kinematics::machine::{Dowel, preferred_size};
use centrode_spec::rule::{in_range, positive, single_line};
use centrode_spec::{SpecError, degrees};

/// The cam, fixed to the carrier about a planet's axis, that draws the push rod back and lets it go.
///
/// The clamp closes at picking, when the rod has been drawn back, and opens from planting on, when the
/// spring throws the rod out and the seedling with it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct PusherCamSpec {
    /// Radius of the base circle, on which the roller lies with the rod thrown out, mm.
    pub base_radius: f64,
    /// Carrier turn over which the rod is drawn back, up to picking, rad (degrees in the file).
    #[serde(rename = "closing_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub closing: f64,
    /// Motion law of the rod drawn back.
    pub closing_law: LawSpec,
    /// Carrier turn over which the rod is thrown out, from planting on, rad (degrees in the file).
    #[serde(rename = "release_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub release: f64,
    /// Motion law of the rod thrown out.
    pub release_law: LawSpec,
    /// Width, bore and material.
    pub body: BodySpec,
}

impl Default for PusherCamSpec {
    fn default() -> Self {
        Self {
            base_radius: 18.0,
            closing: 60.0_f64.to_radians(),
            closing_law: LawSpec::Polynomial345,
            release: 30.0_f64.to_radians(),
            release_law: LawSpec::Polynomial345,
            body: BodySpec {
                width: 7.0,
                bore: 16.0,
                ..BodySpec::default()
            },
        }
    }
}

impl PusherCamSpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        positive("base_radius", self.base_radius)?;
        for (key, span) in [("closing_deg", self.closing), ("release_deg", self.release)] {
            positive(key, span)?;
            in_range(key, span.to_degrees(), [0.1, 359.0], " deg")?;
        }
        self.closing_law
            .validate()
            .map_err(|e| e.inside("closing_law"))?;
        self.release_law
            .validate()
            .map_err(|e| e.inside("release_law"))?;
        self.body.validate().map_err(|e| e.inside("body"))
    }

    /// The default cam with every length multiplied by `k`; width and bore are preferred sizes.
    #[must_use]
    pub fn usual(k: f64) -> Self {
        let usual = Self::default();
        Self {
            base_radius: k * usual.base_radius,
            body: BodySpec {
                width: preferred_size(k * usual.body.width),
                bore: preferred_size(k * usual.body.bore),
                ..usual.body
            },
            ..usual
        }
    }
}

/// The fork: a lever hinged on the arm, with the cam's roller on one side and a slot for the push rod's
/// pin on the other.
///
/// Its pivot is on the line from the planet's axis square to the pusher's axis.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct ForkSpec {
    /// Distance of the pivot from the planet's axis, mm: less than the pusher's.
    pub pivot_distance: f64,
    /// Distance of the roller's axis from the pivot, mm.
    pub arm_length: f64,
    /// Radius of the roller, mm.
    pub roller_radius: f64,
    /// Diameter of the hole for the roller's pin, mm.
    pub roller_bore: f64,
    /// Diameter of the pivot's hole, mm.
    pub pivot_bore: f64,
    /// Width of the slot for the push rod's pin, mm.
    pub slot_width: f64,
    /// Width of material round holes and slot, mm.
    pub wall: f64,
    /// Thickness, mm.
    pub width: f64,
    /// Heat treatment of fork and roller, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Heat treatment of the pins of fork, roller and push rod, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub pin_heat_treatment: String,
}

impl Default for ForkSpec {
    fn default() -> Self {
        Self {
            pivot_distance: 24.0,
            arm_length: 7.0,
            roller_radius: 4.0,
            roller_bore: 3.0,
            pivot_bore: 5.0,
            slot_width: 4.0,
            wall: 2.5,
            width: 4.0,
            heat_treatment: String::new(),
            pin_heat_treatment: String::new(),
        }
    }
}

impl ForkSpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        for (key, size) in [
            ("pivot_distance", self.pivot_distance),
            ("arm_length", self.arm_length),
            ("roller_radius", self.roller_radius),
            ("roller_bore", self.roller_bore),
            ("pivot_bore", self.pivot_bore),
            ("slot_width", self.slot_width),
            ("wall", self.wall),
            ("width", self.width),
        ] {
            positive(key, size)?;
        }
        in_range(
            "roller_bore",
            self.roller_bore,
            [0.0, 2.0 * self.roller_radius],
            " mm",
        )?;
        single_line("heat_treatment", &self.heat_treatment)?;
        single_line("pin_heat_treatment", &self.pin_heat_treatment)
    }

    /// The default fork with every length multiplied by `k`. Its holes and slot fit pins that can be bought; its roller and
    /// thickness are preferred sizes.
    #[must_use]
    pub fn usual(k: f64) -> Self {
        let usual = Self::default();
        Self {
            pivot_distance: k * usual.pivot_distance,
            arm_length: k * usual.arm_length,
            roller_radius: 0.5 * preferred_size(2.0 * k * usual.roller_radius),
            roller_bore: Dowel::nearest_diameter(k * usual.roller_bore),
            pivot_bore: Dowel::nearest_diameter(k * usual.pivot_bore),
            slot_width: 2.0 * Dowel::nearest_diameter(0.5 * k * usual.slot_width),
            wall: k * usual.wall,
            width: preferred_size(k * usual.width),
            ..usual
        }
    }
}
