use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::degrees;
use centrode_spec::rule::{
    Rule, SpecError, broken, count_in_range, in_range, not_negative, positive,
};

/// The tool that cuts both gears, by the key `kind`; its module is that of the pitch curve.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ToolSpec {
    /// A straight-sided rack: hob or rack cutter.
    Rack(Rack),
    /// A pinion-type cutter.
    Shaper(Shaper),
}

impl Default for ToolSpec {
    fn default() -> Self {
        Self::Rack(Rack::default())
    }
}

/// A basic rack; the defaults are ISO 53, profile A. Lengths are multiples of the module.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rack {
    /// Pressure angle, rad (degrees in the file).
    #[serde(rename = "pressure_angle_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub pressure_angle: f64,
    /// Height of the gear's tooth above the pitch curve.
    pub addendum_coefficient: f64,
    /// Depth of the gear's tooth below the pitch curve; the tool cuts this far.
    pub dedendum_coefficient: f64,
    /// Radius of the tool's tip, which leaves the fillet.
    pub tip_radius_coefficient: f64,
}

impl Default for Rack {
    fn default() -> Self {
        Self {
            pressure_angle: 20.0_f64.to_radians(),
            addendum_coefficient: 1.0,
            dedendum_coefficient: 1.25,
            tip_radius_coefficient: 0.38,
        }
    }
}

/// A pinion-type cutter with involute teeth. Lengths are multiples of the module.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Shaper {
    /// Teeth of the cutter.
    pub tooth_count: u32,
    /// Pressure angle, rad (degrees in the file).
    #[serde(
        rename = "pressure_angle_deg",
        with = "degrees",
        default = "pressure_angle"
    )]
    #[schemars(with = "f64")]
    pub pressure_angle: f64,
    /// Height of the gear's tooth above the pitch curve.
    #[serde(default = "addendum_coefficient")]
    pub addendum_coefficient: f64,
    /// Depth of the gear's tooth below the pitch curve; the cutter's own addendum.
    #[serde(default = "dedendum_coefficient")]
    pub dedendum_coefficient: f64,
    /// Radius of the cutter's tip corner, which leaves the fillet.
    #[serde(default = "shaper_tip_radius_coefficient")]
    pub tip_radius_coefficient: f64,
}

fn pressure_angle() -> f64 {
    Rack::default().pressure_angle
}

fn addendum_coefficient() -> f64 {
    Rack::default().addendum_coefficient
}

fn dedendum_coefficient() -> f64 {
    Rack::default().dedendum_coefficient
}

/// Default tip radius of a shaper, whose teeth are narrower at the tip than a rack's.
fn shaper_tip_radius_coefficient() -> f64 {
    0.2
}

impl Default for Shaper {
    fn default() -> Self {
        Self {
            tooth_count: 20,
            pressure_angle: pressure_angle(),
            addendum_coefficient: addendum_coefficient(),
            dedendum_coefficient: dedendum_coefficient(),
            tip_radius_coefficient: shaper_tip_radius_coefficient(),
        }
    }
}

impl ToolSpec {
    /// Checks the ranges, and that the tip rounding fits the tool.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        match self {
            Self::Rack(rack) => rack.validate(),
            Self::Shaper(shaper) => shaper.validate(),
        }
    }

    /// Height of the teeth above the pitch curve, in modules.
    #[must_use]
    pub fn addendum_coefficient(&self) -> f64 {
        match self {
            Self::Rack(rack) => rack.addendum_coefficient,
            Self::Shaper(shaper) => shaper.addendum_coefficient,
        }
    }

    /// Pressure angle, rad.
    #[must_use]
    pub fn pressure_angle(&self) -> f64 {
        match self {
            Self::Rack(rack) => rack.pressure_angle,
            Self::Shaper(shaper) => shaper.pressure_angle,
        }
    }

    /// Pressure angle, rad, to be changed.
    pub(crate) fn pressure_angle_mut(&mut self) -> &mut f64 {
        match self {
            Self::Rack(rack) => &mut rack.pressure_angle,
            Self::Shaper(shaper) => &mut shaper.pressure_angle,
        }
    }
}

impl Rack {
    fn validate(&self) -> Result<(), SpecError> {
        heights(
            self.pressure_angle,
            self.addendum_coefficient,
            self.dedendum_coefficient,
        )?;
        let key = "tip_radius_coefficient";
        let value = self.tip_radius_coefficient;
        not_negative(key, value)?;
        // Half the rack's tip land is pi/4 - h tan(alpha); the round must end on it and above the
        // pitch line.
        let (sin, cos) = self.pressure_angle.sin_cos();
        let half_land = 0.25 * PI - self.dedendum_coefficient * sin / cos;
        if half_land < 0.0 {
            let maximum = 0.25 * PI * cos / sin;
            let key = "dedendum_coefficient";
            return in_range(key, self.dedendum_coefficient, [0.0, maximum], "");
        }
        let maximum = (half_land * cos / (1.0 - sin)).min(self.dedendum_coefficient / (1.0 - sin));
        if value > maximum {
            return broken(key, Rule::TipRadius { value, maximum });
        }
        Ok(())
    }
}

impl Shaper {
    fn validate(&self) -> Result<(), SpecError> {
        count_in_range("tooth_count", self.tooth_count, 3, 1000)?;
        heights(
            self.pressure_angle,
            self.addendum_coefficient,
            self.dedendum_coefficient,
        )?;
        not_negative("tip_radius_coefficient", self.tip_radius_coefficient)
    }
}

fn heights(angle: f64, addendum: f64, dedendum: f64) -> Result<(), SpecError> {
    in_range(
        "pressure_angle_deg",
        degrees::rounded(angle),
        [5.0, 40.0],
        " deg",
    )?;
    positive("addendum_coefficient", addendum)?;
    in_range("addendum_coefficient", addendum, [0.0, 3.0], "")?;
    positive("dedendum_coefficient", dedendum)?;
    in_range("dedendum_coefficient", dedendum, [0.0, 3.0], "")
}
