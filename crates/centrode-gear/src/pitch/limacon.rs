use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{finite, in_range, positive};
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, Scaled, Symmetry};

/// A limacon of Pascal, if with several lobes: `r(phi) = b + c cos(N phi)`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Limacon {
    /// Mean radius `b`, mm.
    pub mean_radius: f64,
    /// Swing of the radius `c`, mm: less than the mean radius.
    pub amplitude: f64,
    /// Number of lobes `N`, 1 to 60.
    #[serde(default = "one")]
    pub lobes: u32,
    /// Module, mm, with `tooth_count`: scales the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth; alone, the module follows from the size of the curve.
    pub tooth_count: Option<u32>,
}

fn one() -> u32 {
    1
}

impl Default for Limacon {
    fn default() -> Self {
        Self {
            mean_radius: 1.0,
            amplitude: 0.0,
            lobes: 1,
            module: None,
            diametral_pitch: None,
            tooth_count: None,
        }
    }
}

impl Limacon {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let law = Cosine {
            mean: positive("mean_radius", self.mean_radius)?,
            amplitude: finite("amplitude", self.amplitude)?,
            lobes: in_range("lobes", self.lobes, 1, 60)?,
        };
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::Written,
        );
        let definition = format!(
            "limacon, r = b + c cos({} phi), c/b = {}",
            self.lobes,
            self.amplitude / self.mean_radius
        );
        let draft = Draft::new("amplitude", PolarCurve::new(law), size, definition)?;
        Ok(draft.scaled(Scaled::Length("b", self.mean_radius)))
    }
}

#[derive(Debug)]
struct Cosine {
    mean: f64,
    amplitude: f64,
    lobes: u32,
}

impl RadiusLaw for Cosine {
    fn radius(&self, phi: &Direction) -> Derivatives {
        let n = f64::from(self.lobes);
        let (sin, cos) = phi.times(n);
        let (c, s) = (self.amplitude * cos, self.amplitude * sin);
        [self.mean + c, -n * s, -n * n * c, n * n * n * s]
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::of_cosine(self.lobes, self.amplitude)
    }
}
