use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::eccentricity;
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, Scaled, Symmetry};

/// An ellipse turning about one of its foci.
///
/// `r(phi) = A (1 - k^2) / (1 - k cos phi)`; the far end is at `phi = 0`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Ellipse {
    /// Distance of the focus from the centre over the semi-major axis, `k`: at least 0, less than 1.
    pub eccentricity: f64,
    /// Semi-major axis `A`, mm; or leave it out and give module and `tooth_count`.
    pub semi_major_axis: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

/// A focal ellipse drawn together so that it repeats several times in one turn.
///
/// `r(phi) = A (1 - k^2) / (1 - k cos(N phi))`; a far end is at `phi = 0`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LobedEllipse {
    /// Number of lobes `N`, 1 to 60.
    pub lobes: u32,
    /// Eccentricity `k`: at least 0, less than 1.
    pub eccentricity: f64,
    /// Mean of the maximum and minimum radius, `A`, mm; or leave it out and give module and `tooth_count`.
    pub semi_major_axis: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

impl Default for LobedEllipse {
    fn default() -> Self {
        Self {
            lobes: 2,
            eccentricity: 0.0,
            semi_major_axis: None,
            module: None,
            diametral_pitch: None,
            tooth_count: None,
        }
    }
}

impl Ellipse {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let definition = format!(
            "focal ellipse, r = A (1 - k^2) / (1 - k cos phi), k = {}",
            self.eccentricity
        );
        draft(
            Focal::new(1, self.eccentricity, self.semi_major_axis)?,
            self.semi_major_axis,
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            definition,
        )
    }
}

impl LobedEllipse {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        super::error::in_range("lobes", self.lobes, 1, 60)?;
        let definition = format!(
            "lobed ellipse, r = A (1 - k^2) / (1 - k cos {} phi), k = {}",
            self.lobes, self.eccentricity
        );
        draft(
            Focal::new(self.lobes, self.eccentricity, self.semi_major_axis)?,
            self.semi_major_axis,
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            definition,
        )
    }
}

fn draft(
    law: Focal,
    own: Option<f64>,
    module: Option<f64>,
    diametral_pitch: Option<f64>,
    tooth_count: Option<u32>,
    definition: String,
) -> Result<Draft, PitchError> {
    let size = Size::new(
        module,
        diametral_pitch,
        tooth_count,
        OwnSize::of("semi_major_axis", own)?,
    );
    let draft = Draft::new("eccentricity", PolarCurve::new(law), size, definition)?;
    Ok(draft.scaled(Scaled::Length("A", own.unwrap_or(1.0))))
}

#[derive(Debug)]
struct Focal {
    parameter: f64,
    eccentricity: f64,
    lobes: u32,
}

impl Focal {
    fn new(lobes: u32, k: f64, axis: Option<f64>) -> Result<Self, PitchError> {
        let k = eccentricity(k)?;
        Ok(Self {
            parameter: axis.unwrap_or(1.0) * (1.0 - k * k),
            eccentricity: k,
            lobes,
        })
    }
}

impl RadiusLaw for Focal {
    // An ellipse about its focus: eccentricity below 1.
    fn is_positive_by_form(&self) -> bool {
        true
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            // Two equal ellipses roll on each other about their foci.
            mates_itself: self.lobes == 1 || self.eccentricity == 0.0,
            ..Symmetry::of_cosine(self.lobes, self.eccentricity)
        }
    }

    fn radius(&self, phi: &Direction) -> Derivatives {
        let n = f64::from(self.lobes);
        let (sin, cos) = phi.times(n);
        let k = self.eccentricity;
        let r = self.parameter / (1.0 - k * cos);
        // d = 1 - k cos(N phi): r d = p, so r' = -r d'/d and so on by Leibniz.
        let q = r / self.parameter;
        let (d1, d2, d3) = (
            k * sin * n * q,
            k * cos * n * n * q,
            -k * sin * n * n * n * q,
        );
        let r1 = -r * d1;
        let r2 = -(2.0 * r1 * d1 + r * d2);
        let r3 = -(3.0 * r2 * d1 + 3.0 * r1 * d2 + r * d3);
        [r, r1, r2, r3]
    }
}
