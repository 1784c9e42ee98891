use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::eccentricity;
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, Scaled, Symmetry};

/// A circle around the shaft axis: an ordinary gear.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Circle {
    /// Radius, mm; or leave it out and give module and `tooth_count`.
    pub radius: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

/// A circle whose shaft axis is not at its centre.
///
/// `r(phi) = R (e cos phi + sqrt(1 - e^2 sin^2 phi))`; the far side is at `phi = 0`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct EccentricCircle {
    /// Offset of the centre from the shaft axis over the radius `R`, at least 0 and less than 1.
    pub eccentricity: f64,
    /// Radius `R`, mm; or leave it out and give module and `tooth_count`.
    pub radius: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

impl Circle {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::of("radius", self.radius)?,
        );
        let law = Eccentric {
            radius: self.radius.unwrap_or(1.0),
            eccentricity: 0.0,
        };
        let radius = law.radius;
        let draft = Draft::new("radius", PolarCurve::new(law), size, "circle".into())?;
        Ok(draft.scaled(Scaled::Length("R", radius)))
    }
}

impl EccentricCircle {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let law = Eccentric {
            radius: self.radius.unwrap_or(1.0),
            eccentricity: eccentricity(self.eccentricity)?,
        };
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::of("radius", self.radius)?,
        );
        let definition = format!(
            "eccentric circle, r = R (e cos phi + sqrt(1 - e^2 sin^2 phi)), e = {}",
            self.eccentricity
        );
        let radius = law.radius;
        let draft = Draft::new("eccentricity", PolarCurve::new(law), size, definition)?;
        Ok(draft.scaled(Scaled::Length("R", radius)))
    }
}

#[derive(Debug)]
struct Eccentric {
    radius: f64,
    eccentricity: f64,
}

impl RadiusLaw for Eccentric {
    // An axis inside the circle: eccentricity below 1.
    fn is_positive_by_form(&self) -> bool {
        true
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::of_cosine(1, self.eccentricity)
    }

    fn radius(&self, phi: &Direction) -> Derivatives {
        let Direction { sin, cos, .. } = *phi;
        let e = self.eccentricity;
        let square = e * e;
        // w^2 = 1 - e^2 sin^2 phi, differentiated: w w' = g, w'^2 + w w'' = g', ...
        let w = (1.0 - square * sin * sin).sqrt();
        let g = -square * sin * cos;
        let g1 = -square * (cos * cos - sin * sin);
        let g2 = 4.0 * square * sin * cos;
        let w1 = g / w;
        let w2 = (g1 - w1 * w1) / w;
        let w3 = (g2 - 3.0 * w1 * w2) / w;
        [
            self.radius * (e * cos + w),
            self.radius * (w1 - e * sin),
            self.radius * (w2 - e * cos),
            self.radius * (w3 + e * sin),
        ]
    }
}
