use centrode_geometry::{Arc, Outline, Point, Segment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Groove;
use centrode_kinematics::machine::{hole_class, shaft_class};
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, not_negative, positive, single_line};

/// The slider: an oblong follower with round ends that turns in its sleeve to lie along the groove.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SliderSpec {
    /// Length over both round ends, mm.
    pub length: f64,
    /// Difference of the groove's width and its own, mm.
    pub clearance: f64,
    /// Tolerance class of the groove's width, ISO 286, for the drawing.
    pub groove_fit: String,
    /// Tolerance class of its own width, ISO 286, for the drawing.
    pub slider_fit: String,
    /// Depth to which it reaches into the groove, mm.
    pub reach: f64,
    /// Diameter of the bore for the pin it turns on, mm.
    pub pin_diameter: f64,
    /// Tolerance class of that bore, ISO 286, for the drawing.
    pub hole_fit: String,
    /// Tolerance class of the pin, ISO 286, for the drawing.
    pub pin_fit: String,
    /// Material, for the drawing.
    pub material: String,
    /// Heat treatment, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Density, kg/m^3.
    pub density: f64,
}

impl Default for SliderSpec {
    fn default() -> Self {
        Self {
            length: 42.0,
            clearance: 1.0,
            groove_fit: "H11".into(),
            slider_fit: "h11".into(),
            reach: 3.5,
            pin_diameter: 5.0,
            hole_fit: "H8".into(),
            pin_fit: "f7".into(),
            material: "steel".into(),
            heat_treatment: String::new(),
            density: 7850.0,
        }
    }
}

impl SliderSpec {
    /// Checks the ranges, for a groove of this width and depth (mm).
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self, width: f64, depth: f64) -> Result<(), SpecError> {
        not_negative("clearance", self.clearance)?;
        positive("length", self.length)?;
        positive("reach", self.reach)?;
        positive("pin_diameter", self.pin_diameter)?;
        positive("density", self.density)?;
        hole_class("groove_fit", &self.groove_fit)?;
        hole_class("hole_fit", &self.hole_fit)?;
        shaft_class("slider_fit", &self.slider_fit)?;
        shaft_class("pin_fit", &self.pin_fit)?;
        single_line("material", &self.material)?;
        single_line("heat_treatment", &self.heat_treatment)?;
        let minimum = width - self.clearance;
        let range = |value, minimum, maximum| Rule::OutOfRange {
            value,
            minimum,
            maximum,
            unit: " mm",
        };
        if minimum <= 0.0 {
            return broken("clearance", range(self.clearance, 0.0, width));
        }
        if self.length < minimum {
            return broken("length", range(self.length, minimum, f64::INFINITY));
        }
        if self.pin_diameter >= minimum {
            return broken("pin_diameter", range(self.pin_diameter, 0.0, minimum));
        }
        if self.reach > depth {
            return broken("reach", range(self.reach, 0.0, depth));
        }
        Ok(())
    }

    /// Width of the slider for a groove of the width `groove`, mm.
    #[must_use]
    pub fn width(&self, groove: f64) -> f64 {
        groove - self.clearance
    }

    /// The outline, mm, seen from outside along its pin, its length along x: two straight sides and two
    /// half circles.
    #[must_use]
    pub fn outline(&self, groove: f64) -> Outline {
        let half = 0.5 * self.width(groove);
        let straight = (0.5 * self.length - half).max(0.0);
        let p = Point::new;
        let round = |from: Point, to: Point| {
            Segment::Arc(Arc {
                start: from,
                end: to,
                bulge: 1.0,
            })
        };
        let corners = [
            p(-straight, -half),
            p(straight, -half),
            p(straight, half),
            p(-straight, half),
        ];
        let [a, b, c, d] = corners;
        let mut segments = vec![round(b, c), round(d, a)];
        if straight > 0.0 {
            segments.insert(1, Segment::Line(c, d));
            segments.insert(0, Segment::Line(a, b));
        }
        Outline::new(segments).unwrap_or_else(|_| Outline::circle(Point::origin(), half))
    }

    /// Length over which a flat slider reaches below the surface of a shaft of this radius (mm), mm: beyond
    /// it, its foot has left the groove.
    ///
    /// `2 sqrt(R^2 - (R - h)^2)` with `h` the reach, at most the slider's length. The lead angle, which
    /// flattens the curve under the slider, is not counted: the true length is greater by its
    /// cosine's inverse, at 16 deg by 4 %.
    #[must_use]
    pub fn guided_length(&self, radius: f64) -> f64 {
        let reach = self.reach.min(radius);
        let chord = 2.0 * (reach * (2.0 * radius - reach)).sqrt();
        chord.min(self.length)
    }

    /// Clearance a straight slider of this length needs where the groove's curvature is largest, mm: the height of
    /// the bend over the chord between the centres of its round ends.
    ///
    /// `rho - sqrt(rho^2 - l^2 / 4)` with `l` the length less the groove's width; infinite where the bend
    /// is shorter than the slider.
    #[must_use]
    pub fn needed_clearance(&self, groove: &Groove) -> f64 {
        let half = (0.5 * (self.length - groove.width())).max(0.0);
        let bend = groove.tightest().value;
        let share = half * bend;
        if share >= 1.0 {
            return f64::INFINITY;
        }
        // rho (1 - sqrt(1 - x^2)) without cancellation.
        half * share / (1.0 + (1.0 - share * share).sqrt())
    }
}
