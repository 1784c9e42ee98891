use std::borrow::Cow;
use std::f64::consts::PI;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};

/// Figures below this value, in the shown unit, are rounding of larger figures: figures of a machine are not so small.
const ROUNDING: f64 = 1e-9;

/// Unit of a figure, which determines how the figure is shown.
///
/// Figures are stored in mm, rad, s and N; [`Unit::symbol`] names that unit, also in JSON. A person reads angles in degrees:
/// [`Unit::shown`] and [`Unit::show`].
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum Unit {
    /// A whole number of things.
    Count,
    /// A plain number.
    Number,
    /// Length, mm.
    Millimetre,
    /// Curvature, 1/mm.
    PerMillimetre,
    /// Angle, stored in rad and shown in degrees.
    Angle,
    /// Angle stored and shown in rad: errors too small for degrees.
    Radian,
    /// Angular speed, rad/s.
    RadianPerSecond,
    /// Angular acceleration, rad/s².
    RadianPerSecondSquared,
    /// Speed, mm/s.
    MillimetrePerSecond,
    /// Acceleration, m/s².
    MetrePerSecondSquared,
    /// Force, N.
    Newton,
    /// Torque, N·mm.
    NewtonMillimetre,
    /// Pressure, N/mm².
    NewtonPerSquareMillimetre,
    /// Speed of a shaft, r/min.
    TurnsPerMinute,
    /// Rate of work, 1/min.
    PerMinute,
    /// Time, s.
    Second,
    /// Length along a pitch curve in pitches of its teeth.
    Pitch,
}

impl Unit {
    /// Symbol of the unit that figures are stored in; empty for a plain number.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Count | Self::Number => "",
            Self::Millimetre => "mm",
            Self::PerMillimetre => "1/mm",
            Self::Angle | Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::RadianPerSecondSquared => "rad/s²",
            Self::MillimetrePerSecond => "mm/s",
            Self::MetrePerSecondSquared => "m/s²",
            Self::Newton => "N",
            Self::NewtonMillimetre => "N·mm",
            Self::NewtonPerSquareMillimetre => "N/mm²",
            Self::TurnsPerMinute => "r/min",
            Self::PerMinute => "1/min",
            Self::Second => "s",
            Self::Pitch => "pitches",
        }
    }

    /// Symbol of the unit that a person reads the figure in.
    #[must_use]
    pub fn shown(self) -> &'static str {
        match self {
            Self::Angle => "deg",
            other => other.symbol(),
        }
    }

    /// Factor from the stored unit to the shown one.
    #[must_use]
    pub fn factor(self) -> f64 {
        match self {
            Self::Angle => 180.0 / PI,
            _ => 1.0,
        }
    }

    /// The figure in the shown unit, with few digits. A small figure keeps its leading digits, and a figure below 1e-9 is 0.
    /// Errors in rad keep their leading digits, however small.
    #[must_use]
    pub fn show(self, value: f64) -> String {
        if self != Self::Radian && (value * self.factor()).abs() < ROUNDING {
            return "0".into();
        }
        self.digits(value)
    }

    /// The figure in the unit shown, however small.
    fn digits(self, value: f64) -> String {
        let decimals = match self {
            Self::Count => return format!("{value:.0}"),
            Self::Number | Self::PerMillimetre => 6,
            Self::RadianPerSecond | Self::RadianPerSecondSquared => 6,
            Self::MetrePerSecondSquared => 6,
            Self::MillimetrePerSecond | Self::Newton => 2,
            Self::NewtonMillimetre | Self::NewtonPerSquareMillimetre | Self::TurnsPerMinute => 2,
            Self::Second | Self::Millimetre | Self::Pitch | Self::Angle | Self::PerMinute => 4,
            Self::Radian => 0,
        };
        decimal(value * self.factor(), decimals)
    }

    /// The figure as shown by [`Unit::show`], with its unit. A figure below 1e-9 keeps its leading digits: a goal is not
    /// missed by 0.
    #[must_use]
    pub fn with_unit(self, value: f64) -> String {
        format!("{} {}", self.digits(value), self.shown())
            .trim_end()
            .to_owned()
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

impl Serialize for Unit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.symbol())
    }
}

impl JsonSchema for Unit {
    fn schema_name() -> Cow<'static, str> {
        "Unit".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Symbol of a unit; empty for a plain number.",
            "type": "string",
        })
    }
}

/// Number with `decimals` decimals, or in powers of ten if it is below 50 units of the last decimal or at least 1e9.
fn decimal(value: f64, decimals: i32) -> String {
    let hidden = 50.0 * 0.1_f64.powi(decimals);
    if value == 0.0 {
        "0".into()
    } else if value.is_infinite() {
        if value > 0.0 { "infinite" } else { "-infinite" }.into()
    } else if value.is_nan() {
        "none".into()
    } else if value.abs() < hidden || value.abs() >= 1e9 {
        format!("{value:.1e}")
    } else {
        format!("{value:.0$}", usize::try_from(decimals).unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_keep_what_matters() {
        assert_eq!(Unit::Millimetre.show(52.709_221), "52.7092");
        assert_eq!(Unit::Millimetre.show(-3.2e-7), "-3.2e-7");
        assert_eq!(Unit::Millimetre.show(-3.2e-12), "0");
        assert_eq!(Unit::NewtonMillimetre.show(3.5e-12), "0");
        assert_eq!(Unit::Radian.show(1.6e-15), "1.6e-15");
        assert_eq!(Unit::Angle.show(PI), "180.0000");
        assert_eq!(Unit::Count.show(23.0), "23");
        assert_eq!(Unit::Radian.show(f64::INFINITY), "infinite");
        assert_eq!(Unit::Radian.show(-0.0), "0");
        assert_eq!(Unit::Radian.show(2.489e-7), "2.5e-7");
        assert_eq!(Unit::Angle.with_unit(PI), "180.0000 deg");
        assert_eq!(Unit::Count.with_unit(3.0), "3");
        assert_eq!(Unit::Millimetre.with_unit(3.5e-12), "3.5e-12 mm");
    }
}
