//! Points of a body as the design file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::body::contour::Drawn;
use crate::machine::{MachineCircleSpec, MachineCornerSpec};
use centrode_spec::Named;
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, finite, part_name, positive};

/// The frame: its points by name, and its contour if it is a plate.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachinePointsSpec {
    /// Points by name: x and y in the body's axes, mm.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub points: Named<[f64; 2]>,
    /// Points by name, each the third corner of a triangle.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub corners: Named<CornerSpec>,
    /// Contour of its plate: corners in order, x and y, mm, each with an optional bulge of the side that begins there.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<MachineCornerSpec>,
    /// Radius of the corners of the contour, mm.
    pub corner_radius: Option<f64>,
    /// Contour of a round plate.
    pub circle: Option<MachineCircleSpec>,
    /// Thickness of its plate, mm; that of the other plates by default.
    pub thickness: Option<f64>,
}

/// A point of a body by its distances from two others.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CornerSpec {
    /// The two points of the body from which it is measured.
    pub from: [String; 2],
    /// Distances from them, mm.
    pub lengths: [f64; 2],
    /// Side of the line from the first to the second on which it lies, left or right.
    pub side: Side,
}

/// Choice between the two ways in which lengths go together.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// To the left of the line from the first point to the second.
    Left,
    /// To the right of it.
    Right,
    /// Forward along the line.
    Forward,
    /// Backward along the line.
    Backward,
}

impl Side {
    /// Whether it is a side of a line, not a direction along it.
    #[must_use]
    pub fn is_across(self) -> bool {
        matches!(self, Self::Left | Self::Right)
    }

    /// +1 for left and forward, -1 for right and backward.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left | Self::Forward => 1.0,
            Self::Right | Self::Backward => -1.0,
        }
    }
}

impl CornerSpec {
    fn validate(&self) -> Result<(), SpecError> {
        for length in self.lengths {
            positive("lengths", length)?;
        }
        if !self.side.is_across() {
            return broken("side", Rule::Needed("as left or right"));
        }
        Ok(())
    }
}

impl MachinePointsSpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        points(&self.points, &self.corners)?;
        self.drawn().validate()?;
        self.thickness
            .map_or(Ok(()), |mm| positive("thickness", mm))
    }

    /// Contour of the frame's plate as the design file gives it.
    pub(in crate::machine) fn drawn(&self) -> Drawn<'_> {
        Drawn {
            outline: &self.outline,
            corner_radius: self.corner_radius,
            circle: self.circle.as_ref(),
        }
    }
}

/// Checks the names and numbers of a body's points.
pub(in crate::machine) fn points(
    points: &Named<[f64; 2]>,
    corners: &Named<CornerSpec>,
) -> Result<(), SpecError> {
    for (name, at) in points {
        let key = format!("points.{name}");
        part_name(&key, name)?;
        for coordinate in at {
            finite(&key, *coordinate)?;
        }
    }
    for (name, corner) in corners {
        let key = format!("corners.{name}");
        part_name(&key, name)?;
        if points.contains_key(name) {
            return broken(&key, Rule::Excludes("a point of the same name"));
        }
        corner.validate().map_err(|e| e.inside(&key))?;
    }
    Ok(())
}
