//! Contours of bodies and obstacles as the design file gives them.

use std::borrow::Cow;

use centrode_geometry::{Arc, OpenOutline, Outline, Point, Segment};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use crate::machine::MachineError;
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, finite, in_range, not_negative, positive};

/// Maximum bulge of a side: that of a circle less 2.3 degrees.
const MAX_SAGITTA: f64 = 100.0;

/// A circle on a body.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineCircleSpec {
    /// Centre: x and y in the body's axes, mm.
    pub center: [f64; 2],
    /// Radius, mm.
    pub radius: f64,
}

impl Default for MachineCircleSpec {
    fn default() -> Self {
        Self {
            center: [0.0; 2],
            radius: 10.0,
        }
    }
}

/// A corner of a contour, with the bulge of the side that begins there: `[x, y]` or `[x, y, bulge]` in the file.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct MachineCornerSpec {
    /// x and y in the body's axes, mm.
    pub at: [f64; 2],
    /// Tangent of a quarter of the angle of the arc that begins here, positive counter-clockwise, as in a DXF polyline; 0 for
    /// a straight side.
    pub bulge: f64,
}

impl From<MachineCornerSpec> for Vec<f64> {
    fn from(corner: MachineCornerSpec) -> Self {
        let bulge = (corner.bulge != 0.0).then_some(corner.bulge);
        corner.at.into_iter().chain(bulge).collect()
    }
}

impl TryFrom<Vec<f64>> for MachineCornerSpec {
    type Error = String;

    fn try_from(numbers: Vec<f64>) -> Result<Self, String> {
        match numbers[..] {
            [x, y] => Ok(Self {
                at: [x, y],
                bulge: 0.0,
            }),
            [x, y, bulge] => Ok(Self { at: [x, y], bulge }),
            _ => Err(format!(
                "a corner is x and y, or x, y and the bulge of the side that starts there, not {} numbers",
                numbers.len()
            )),
        }
    }
}

impl JsonSchema for MachineCornerSpec {
    fn schema_name() -> Cow<'static, str> {
        "MachineCornerSpec".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A corner: x and y in mm, and optionally the bulge of the arc that starts there. The bulge is the tangent of a quarter of the arc's angle, counter-clockwise positive, as in a DXF polyline.",
            "type": "array",
            "items": { "type": "number" },
            "minItems": 2,
            "maxItems": 3
        })
    }
}

/// A contour as the design file gives it: lines and arcs, a circle, or none.
#[derive(Clone, Copy, Debug)]
pub(in crate::machine) struct Drawn<'a> {
    pub(in crate::machine) outline: &'a [MachineCornerSpec],
    pub(in crate::machine) corner_radius: Option<f64>,
    pub(in crate::machine) circle: Option<&'a MachineCircleSpec>,
}

impl Drawn<'_> {
    pub(in crate::machine) fn is_given(&self) -> bool {
        !self.outline.is_empty() || self.circle.is_some()
    }

    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        for corner in self.outline {
            corner.at.iter().try_for_each(|x| finite("outline", *x))?;
            in_range("outline", corner.bulge, [-MAX_SAGITTA, MAX_SAGITTA], "")?;
        }
        let is_bent = self.outline.iter().any(|corner| corner.bulge != 0.0);
        match self.outline.len() {
            0 => {}
            1 => return broken("outline", Rule::Needed("with two corners or more")),
            2 if !is_bent => {
                return broken("outline", Rule::Needed("with three corners or more"));
            }
            _ => {}
        }
        if let Some(circle) = self.circle {
            if !self.outline.is_empty() {
                return broken("circle", Rule::Excludes("outline"));
            }
            circle
                .center
                .iter()
                .try_for_each(|x| finite("circle.center", *x))?;
            positive("circle.radius", circle.radius)?;
        }
        match self.corner_radius {
            Some(_) if self.outline.is_empty() => {
                broken("corner_radius", Rule::Unused("without an outline"))
            }
            Some(_) if is_bent => broken("corner_radius", Rule::Excludes("arcs in the outline")),
            Some(radius) => not_negative("corner_radius", radius),
            None => Ok(()),
        }
    }

    /// The contour, counter-clockwise; `key` is the key of its table.
    pub(in crate::machine) fn contour(&self, key: &str) -> Result<Option<Outline>, MachineError> {
        let wrong = |of: &str, why: String| MachineError::refused(format!("{key}.{of}"), why);
        if let Some(circle) = self.circle {
            return Ok(Some(Outline::circle(circle.center.into(), circle.radius)));
        }
        if self.outline.is_empty() {
            return Ok(None);
        }
        let sides = self
            .sides()
            .map_err(|error| wrong("outline", error.to_string()))?;
        if let Some(at) = sides.crossing() {
            let [x, y] = [at.point.x, at.point.y];
            return Err(wrong(
                "outline",
                format!("the outline crosses or touches itself at {x:.6}, {y:.6} mm"),
            ));
        }
        let contour = match self.corner_radius {
            Some(radius) if radius > 0.0 => self
                .rounded(radius)
                .map_err(|why| wrong("corner_radius", why))?,
            _ => sides,
        };
        Ok(Some(if contour.is_counter_clockwise() {
            contour
        } else {
            contour.reversed()
        }))
    }

    /// Lines and arcs from corner to corner.
    fn sides(&self) -> Result<Outline, OpenOutline> {
        let ends = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let side = |(from, to): (&MachineCornerSpec, &MachineCornerSpec)| {
            let [start, end] = [from, to].map(|corner| Point::from(corner.at));
            match from.bulge {
                0.0 => Segment::Line(start, end),
                bulge => Segment::Arc(Arc { start, end, bulge }),
            }
        };
        Outline::new(ends.map(side).collect())
    }

    /// The polygon with its corners rounded, or the reason why they cannot be rounded.
    fn rounded(&self, radius: f64) -> Result<Outline, String> {
        let corners: Vec<Point> = self.outline.iter().map(|p| Point::from(p.at)).collect();
        Outline::rounded_polygon(&corners, radius).map_err(|short| {
            let [from, to] = [short.side, (short.side + 1) % corners.len()];
            let [from, to] = [from, to].map(|i| self.outline[i].at);
            let fits = radius * short.length / short.taken;
            format!("corners of {radius} mm radius take {:.6} mm of the side from {from:?} to {to:?}, which is {:.6} mm long: at most {fits:.6} mm fits there", short.taken, short.length)
        })
    }
}
