//! Contours of bodies and obstacles as drawn by hand.

use centrode_geometry::{Outline, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ComposedError;
use crate::gear::design::SpecError;
use crate::gear::design::rule::{Rule, broken, finite, not_negative, positive};

/// A circle on a body.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedCircleSpec {
    /// Centre: x and y in the body's axes, mm.
    pub center: [f64; 2],
    /// Radius, mm.
    pub radius: f64,
}

impl Default for ComposedCircleSpec {
    fn default() -> Self {
        Self {
            center: [0.0; 2],
            radius: 10.0,
        }
    }
}

/// A contour as written: a polygon or a circle, or none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn<'a> {
    pub(super) outline: &'a [[f64; 2]],
    pub(super) corner_radius: Option<f64>,
    pub(super) circle: Option<&'a ComposedCircleSpec>,
}

impl Drawn<'_> {
    pub(super) fn is_given(&self) -> bool {
        !self.outline.is_empty() || self.circle.is_some()
    }

    pub(super) fn validate(&self) -> Result<(), SpecError> {
        for coordinate in self.outline.iter().flatten() {
            finite("outline", *coordinate)?;
        }
        if !self.outline.is_empty() && self.outline.len() < 3 {
            return broken("outline", Rule::Needed("with three corners or more"));
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
            Some(radius) => not_negative("corner_radius", radius),
            None => Ok(()),
        }
    }

    /// The contour, counter-clockwise; `key` is that of the table it is written in.
    pub(super) fn contour(&self, key: &str) -> Result<Option<Outline>, ComposedError> {
        let wrong = |of: &str, why: String| ComposedError::Refused {
            key: format!("{key}.{of}"),
            why,
        };
        if let Some(circle) = self.circle {
            return Ok(Some(Outline::circle(circle.center.into(), circle.radius)));
        }
        if self.outline.is_empty() {
            return Ok(None);
        }
        let corners: Vec<Point> = self.outline.iter().map(|p| Point::from(*p)).collect();
        if let Some(at) = Outline::polygon(&corners).crossing() {
            let [x, y] = [at.point.x, at.point.y];
            return Err(wrong(
                "outline",
                format!("the outline crosses or touches itself at {x:.6}, {y:.6} mm"),
            ));
        }
        let radius = self.corner_radius.unwrap_or(0.0);
        let rounded = Outline::rounded_polygon(&corners, radius);
        let rounded = rounded.map_err(|short| {
            let [from, to] = [short.side, (short.side + 1) % corners.len()];
            let [from, to] = [from, to].map(|i| self.outline[i]);
            let fits = radius * short.length / short.taken;
            wrong(
                "corner_radius",
                format!("corners of {radius} mm radius take {:.6} mm of the side from {from:?} to {to:?}, which is {:.6} mm long: at most {fits:.6} mm fits there", short.taken, short.length),
            )
        })?;
        Ok(Some(if rounded.is_counter_clockwise() {
            rounded
        } else {
            rounded.reversed()
        }))
    }
}
