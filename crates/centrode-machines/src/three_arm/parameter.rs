use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::design::ThreeArmDesign;
use centrode_gear::pitch::{Bspline, PitchSpec};

/// A parameter of a three-arm mechanism that a search may move: one of the 17 of the 2021 machine, an angle of a control
/// point, or a working point.
///
/// Its name is `r1` to `r99` and `theta1` to `theta99` for radius and polar angle of a control point, counted from
/// one, and else the last word of its key in the design file without `_deg`. The paper's letters are understood, too.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, Hash, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(try_from = "String", into = "String")]
#[schemars(with = "String")]
#[non_exhaustive]
pub enum Parameter {
    /// Radius of a control point of the sun's pitch curve, counted from zero.
    Radius(u8),
    /// Polar angle of a control point.
    Angle(u8),
    /// Direction of the first intermediate gear's axis at the start, `phi_0`.
    CarrierStart,
    /// Bend of each chain, `gamma_0`.
    Bend,
    /// Direction of the tip from the planet's zero, `beta_0`.
    MountingAngle,
    /// Distance of the tip from the planet's axis, S.
    TipDistance,
    /// Distance of the pusher's axis from the planet's axis, H1.
    PusherOffset,
    /// Angle from the planet's zero to the second leg at the start, `phi_30`.
    PlanetReference,
    /// Carrier turn at which the first arm picks.
    Picking,
    /// Carrier turn at which it plants.
    Planting,
}

/// Error of a word that does not name a parameter.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[error(
    "`{0}` is not a parameter; known are r1, r2, ..., theta1, theta2, ..., carrier_start, bend, mounting_angle, tip_distance, pusher_offset, planet_reference, picking and planting"
)]
pub struct UnknownParameter(pub String);

/// Parameters with a name of their own: parameter, name, the paper's letters, and key in the design file.
const NAMED: [(Parameter, &str, &str, &str); 8] = [
    (
        Parameter::CarrierStart,
        "carrier_start",
        "phi0",
        "carrier_start_deg",
    ),
    (Parameter::Bend, "bend", "gamma0", "bend_deg"),
    (
        Parameter::MountingAngle,
        "mounting_angle",
        "beta0",
        "arm.mounting_angle_deg",
    ),
    (
        Parameter::TipDistance,
        "tip_distance",
        "S",
        "arm.tip_distance",
    ),
    (
        Parameter::PusherOffset,
        "pusher_offset",
        "H1",
        "arm.pusher_offset",
    ),
    (
        Parameter::PlanetReference,
        "planet_reference",
        "phi30",
        "planet_reference_deg",
    ),
    (
        Parameter::Picking,
        "picking",
        "picking_deg",
        "work.picking_deg",
    ),
    (
        Parameter::Planting,
        "planting",
        "planting_deg",
        "work.planting_deg",
    ),
];

impl Parameter {
    /// Key of the parameter in the design file.
    #[must_use]
    pub fn key(self) -> String {
        match self {
            Self::Radius(i) => format!("pitch.radius[{i}]"),
            Self::Angle(i) => format!("pitch.angle_deg[{i}]"),
            named => NAMED
                .iter()
                .find(|row| row.0 == named)
                .map_or("", |row| row.3)
                .into(),
        }
    }

    /// Whether the parameter is an angle (rad; degrees in the file), not a length (mm).
    #[must_use]
    pub fn is_angle(self) -> bool {
        !matches!(
            self,
            Self::Radius(_) | Self::TipDistance | Self::PusherOffset
        )
    }

    /// Value of the parameter in a design, rad or mm; `None` if the design does not give it.
    #[must_use]
    pub fn of(self, design: &ThreeArmDesign) -> Option<f64> {
        let spline = || match &design.pitch {
            PitchSpec::Bspline(spline) => Some(spline),
            _ => None,
        };
        match self {
            Self::Radius(i) => spline()?.radius.get(usize::from(i)).copied(),
            Self::Angle(i) => spline()?.angle.get(usize::from(i)).copied(),
            Self::CarrierStart => Some(design.carrier_start),
            Self::Bend => Some(design.bend),
            Self::MountingAngle => Some(design.arm.mounting_angle),
            Self::TipDistance => Some(design.arm.tip_distance),
            Self::PusherOffset => Some(design.arm.pusher_offset),
            Self::PlanetReference => design.planet_reference,
            Self::Picking => design.work.picking,
            Self::Planting => design.work.planting,
        }
    }

    /// Sets the parameter in a design, rad or mm; does nothing for a control point that does not exist.
    pub fn set(self, design: &mut ThreeArmDesign, value: f64) {
        fn put(list: Option<&mut Vec<f64>>, index: u8, value: f64) {
            if let Some(place) = list.and_then(|list| list.get_mut(usize::from(index))) {
                *place = value;
            }
        }
        fn spline(design: &mut ThreeArmDesign) -> Option<&mut Bspline> {
            match &mut design.pitch {
                PitchSpec::Bspline(spline) => Some(spline),
                _ => None,
            }
        }
        match self {
            Self::Radius(i) => put(spline(design).map(|s| &mut s.radius), i, value),
            Self::Angle(i) => put(spline(design).map(|s| &mut s.angle), i, value),
            Self::CarrierStart => design.carrier_start = value,
            Self::Bend => design.bend = value,
            Self::MountingAngle => design.arm.mounting_angle = value,
            Self::TipDistance => design.arm.tip_distance = value,
            Self::PusherOffset => design.arm.pusher_offset = value,
            Self::PlanetReference => design.planet_reference = Some(value),
            Self::Picking => design.work.picking = Some(value),
            Self::Planting => design.work.planting = Some(value),
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Radius(i) => write!(out, "r{}", u32::from(i) + 1),
            Self::Angle(i) => write!(out, "theta{}", u32::from(i) + 1),
            named => {
                let row = NAMED.iter().find(|row| row.0 == named);
                out.write_str(row.map_or("", |row| row.1))
            }
        }
    }
}

impl FromStr for Parameter {
    type Err = UnknownParameter;

    fn from_str(word: &str) -> Result<Self, UnknownParameter> {
        let unknown = || UnknownParameter(word.chars().take(40).collect());
        if let Some(row) = NAMED
            .iter()
            .find(|row| [row.1, row.2, row.3].contains(&word))
        {
            return Ok(row.0);
        }
        let numbered = |prefix: &str| {
            let digits = word.strip_prefix(prefix)?;
            let plain = digits.chars().all(|c| c.is_ascii_digit()) && !digits.starts_with('0');
            digits
                .parse::<u8>()
                .ok()
                .filter(|n| plain && (1..=99).contains(n))
        };
        match (numbered("r"), numbered("theta")) {
            (Some(n), _) => Ok(Self::Radius(n - 1)),
            (_, Some(n)) => Ok(Self::Angle(n - 1)),
            _ => Err(unknown()),
        }
    }
}

impl TryFrom<String> for Parameter {
    type Error = UnknownParameter;

    fn try_from(word: String) -> Result<Self, UnknownParameter> {
        word.parse()
    }
}

impl From<Parameter> for String {
    fn from(parameter: Parameter) -> Self {
        parameter.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::published;
    use super::*;

    #[test]
    fn names_read_back_and_so_do_values() {
        let mut design = published();
        let mut all: Vec<Parameter> = NAMED.iter().map(|row| row.0).collect();
        all.extend((0..12).flat_map(|i| [Parameter::Radius(i), Parameter::Angle(i)]));
        for parameter in all {
            let name = parameter.to_string();
            assert_eq!(name.parse(), Ok(parameter), "{name}");
            let value = parameter.of(&design).unwrap_or(0.25) * 1.01;
            parameter.set(&mut design, value);
            assert_eq!(parameter.of(&design), Some(value), "{name}");
        }
        assert_eq!("gamma0".parse(), Ok(Parameter::Bend));
        assert_eq!("S".parse(), Ok(Parameter::TipDistance));
    }

    #[test]
    fn words_that_name_nothing_are_refused() {
        for word in ["", "r", "r0", "r01", "r-1", "r100", "theta", "radius", "R1"] {
            assert!(word.parse::<Parameter>().is_err(), "{word}");
        }
        assert_eq!(Parameter::Radius(12).of(&published()), None);
    }
}
