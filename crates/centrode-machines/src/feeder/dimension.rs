use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::LinkageSpec;

/// A dimension of the six-bar that a search may move, mm.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, Hash, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Dimension {
    /// Crank AB.
    Crank,
    /// Coupler BC.
    Coupler,
    /// Rocker CD.
    Rocker,
    /// Frame AD.
    Frame,
    /// The effector's pivot F, along x.
    PivotX,
    /// The effector's pivot F, along y.
    PivotY,
}

/// A word that names no dimension.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[error("`{0}` is not a dimension; known are crank, coupler, rocker, frame, pivot_x and pivot_y")]
pub struct UnknownDimension(pub String);

impl Dimension {
    /// The four lengths, then the coordinates of the pivot.
    pub const ALL: [Self; 6] = [
        Self::Crank,
        Self::Coupler,
        Self::Rocker,
        Self::Frame,
        Self::PivotX,
        Self::PivotY,
    ];

    /// Name, as written in `optimise.hold`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Crank => "crank",
            Self::Coupler => "coupler",
            Self::Rocker => "rocker",
            Self::Frame => "frame",
            Self::PivotX => "pivot_x",
            Self::PivotY => "pivot_y",
        }
    }

    /// Key in the design file.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Crank => "linkage.crank",
            Self::Coupler => "linkage.coupler",
            Self::Rocker => "linkage.rocker",
            Self::Frame => "linkage.frame",
            Self::PivotX => "linkage.pivot[0]",
            Self::PivotY => "linkage.pivot[1]",
        }
    }

    /// Whether the dimension is a coordinate of the pivot.
    #[must_use]
    pub fn is_of_pivot(self) -> bool {
        matches!(self, Self::PivotX | Self::PivotY)
    }

    /// Value of the dimension in a linkage, mm.
    #[must_use]
    pub fn of(self, linkage: &LinkageSpec) -> f64 {
        match self {
            Self::Crank => linkage.crank,
            Self::Coupler => linkage.coupler,
            Self::Rocker => linkage.rocker,
            Self::Frame => linkage.frame,
            Self::PivotX => linkage.pivot[0],
            Self::PivotY => linkage.pivot[1],
        }
    }

    /// Sets the value of the dimension in a linkage, mm.
    pub fn set(self, linkage: &mut LinkageSpec, value: f64) {
        let place = match self {
            Self::Crank => &mut linkage.crank,
            Self::Coupler => &mut linkage.coupler,
            Self::Rocker => &mut linkage.rocker,
            Self::Frame => &mut linkage.frame,
            Self::PivotX => &mut linkage.pivot[0],
            Self::PivotY => &mut linkage.pivot[1],
        };
        *place = value;
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

impl FromStr for Dimension {
    type Err = UnknownDimension;

    fn from_str(word: &str) -> Result<Self, UnknownDimension> {
        let named = Self::ALL.into_iter().find(|d| d.name() == word);
        named.ok_or_else(|| UnknownDimension(word.chars().take(40).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feeder::FeederDesign;
    use centrode_spec::{Design as _, DesignSpec as _};

    #[test]
    fn names_and_keys_are_those_of_the_file() {
        let design = FeederDesign::from_toml(FeederDesign::TEMPLATE).expect("a feeder");
        for (i, dimension) in Dimension::ALL.into_iter().enumerate() {
            assert_eq!(dimension.name().parse(), Ok(dimension));
            let word = serde_json::to_value(dimension).expect("a word");
            assert_eq!(word, dimension.name());
            let value = dimension.of(&design.linkage) + 1.0 + i as f64;
            let open = design.numbered(&[dimension.key()]).expect("a number");
            let moved = open.with(&[value]).expect("still a feeder");
            let moved: &FeederDesign = moved.downcast_ref().expect("a feeder");
            let mut linkage = design.linkage.clone();
            dimension.set(&mut linkage, value);
            assert_eq!(moved.linkage, linkage, "{dimension}");
            assert_eq!(dimension.of(&linkage), value);
        }
        assert!("Crank".parse::<Dimension>().is_err());
    }
}
