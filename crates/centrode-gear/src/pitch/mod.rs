//! Pitch curves: the description of each kind, and the exact curve that it defines.
//!
//! `module` and `tooth_count` in a description scale the curve to the length `pi * module * tooth_count`.

use std::f64::consts::PI;
use std::sync::Arc;

use centrode_geometry::{Antiderivative, Curve};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::{SampleTable, digits};

mod bezier;
mod bspline;
mod circle;
mod conjugate;
mod ellipse;
mod error;
mod limacon;
mod mean;
mod noise;
mod periodic;
mod piecewise;
mod plane;
mod points;
mod polar;
mod proof;
mod ratio;
mod sampled;
mod size;
mod symmetry;
mod table;
mod transmission;

pub use bezier::Bezier;
pub use bspline::{Bspline, basis as spline_basis, closed_spline};
pub use circle::{Circle, EccentricCircle};
pub use conjugate::Conjugate;
pub use ellipse::{Ellipse, LobedEllipse};
pub use error::PitchError;
pub use limacon::Limacon;
pub use noise::SampleNoise;
pub use periodic::{Interpolation, Periodic};
pub use points::Plane;
pub use polar::{Polar, formula_parts, read_formula};
pub use ratio::Ratio;
pub use sampled::{MeanScaling, SampledCorner, SampledLaw};
pub use table::{Smooth, SmoothAngle};
pub use transmission::Transmission;

pub use piecewise::HIGHEST_DEGREE;
use plane::ScalableCurve;
use size::Size;
pub use symmetry::{Symmetry, gcd};

/// A pitch curve as written: one of the kinds, by the key `kind`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum PitchSpec {
    /// Circle around the shaft axis.
    Circle(Circle),
    /// Circle whose shaft axis is not at its centre.
    EccentricCircle(EccentricCircle),
    /// Ellipse turning about a focus.
    Ellipse(Ellipse),
    /// Focal ellipse drawn together so that it repeats several times in one turn.
    LobedEllipse(LobedEllipse),
    /// Limacon of Pascal, if with several lobes.
    Limacon(Limacon),
    /// Closed uniform B-spline.
    Bspline(Bspline),
    /// Closed chain of Bezier arcs.
    Bezier(Bezier),
    /// Radius as a function of the polar angle.
    Polar(Polar),
    /// Driven angle as a function of the driver angle.
    Transmission(Transmission),
    /// Ratio as a function of the driver angle.
    Ratio(Ratio),
    /// The curve that rolls on another.
    Conjugate(Conjugate),
}

/// Kinds of pitch curve whose samples may be in a file, with the key of the samples.
pub const SAMPLE_TABLES: [SampleTable; 3] = [
    SampleTable {
        kind: "polar",
        values: "radius",
    },
    SampleTable {
        kind: "transmission",
        values: "driven_angle_deg",
    },
    SampleTable {
        kind: "ratio",
        values: "ratio",
    },
];

/// A resolved pitch curve.
#[derive(Clone, Debug)]
pub struct Pitch {
    /// The exact curve, mm, around the shaft axis at the origin: once round, counter-clockwise, the
    /// polar angle strictly increasing, the radius above zero.
    pub curve: Arc<dyn Curve>,
    /// Number of teeth, if given.
    pub tooth_count: Option<u32>,
    /// Module, mm, if the tooth count is given: the length of the curve is `pi * module * tooth_count`.
    pub module: Option<f64>,
    /// Definition of the curve in one line, for reports and drawings.
    pub definition: String,
    /// Turns of driver and driven gear that the description requires, in lowest terms.
    pub implied_ratio: Option<(u32, u32)>,
    /// Facts about the samples that the curve follows.
    pub sampled: SampledLaw,
    pub(crate) symmetry: Symmetry,
}

/// Evaluates an expression for the spec of any kind of curve.
macro_rules! of_kind {
    ($curve:expr, $spec:ident => $expression:expr) => {
        match $curve {
            Self::Circle($spec) => $expression,
            Self::EccentricCircle($spec) => $expression,
            Self::Ellipse($spec) => $expression,
            Self::LobedEllipse($spec) => $expression,
            Self::Limacon($spec) => $expression,
            Self::Bspline($spec) => $expression,
            Self::Bezier($spec) => $expression,
            Self::Polar($spec) => $expression,
            Self::Transmission($spec) => $expression,
            Self::Ratio($spec) => $expression,
            Self::Conjugate($spec) => $expression,
        }
    };
}

impl PitchSpec {
    /// Exact curve, proved to wind once round the shaft axis with an increasing polar angle. A law from samples is scaled to the
    /// nearest simple mean ratio.
    ///
    /// # Errors
    /// [`PitchError`] naming the violated rule and its numbers.
    pub fn resolve(&self) -> Result<Pitch, PitchError> {
        self.draft(None)?.finish()
    }

    /// Exact curve like [`resolve`](Self::resolve), of a pair with a mean ratio: turns of driver and driven gear. A law from
    /// samples is scaled to it, and a smoothed law repeats as often per turn as it requires.
    ///
    /// # Errors
    /// [`PitchError`] naming the violated rule and its numbers.
    pub fn resolve_for(&self, ratio: (u32, u32)) -> Result<Pitch, PitchError> {
        self.draft(Some(ratio))?.finish()
    }

    /// Number of teeth written with the curve.
    #[must_use]
    pub fn tooth_count(&self) -> Option<u32> {
        of_kind!(self, spec => spec.tooth_count)
    }

    /// Changes the number of teeth, if one is written. The curve has the same size, so that the module changes.
    pub(crate) fn set_tooth_count(&mut self, teeth: u32) {
        let (module, diametral_pitch, count) = of_kind!(self, spec => (
            &mut spec.module,
            &mut spec.diametral_pitch,
            &mut spec.tooth_count,
        ));
        let Some(count) = count else { return };
        if let Some(module) = module {
            *module *= f64::from(*count) / f64::from(teeth);
        }
        if let Some(diametral_pitch) = diametral_pitch {
            *diametral_pitch *= f64::from(teeth) / f64::from(*count);
        }
        *count = teeth;
    }

    fn draft(&self, ratio: Option<(u32, u32)>) -> Result<Draft, PitchError> {
        match self {
            Self::Polar(spec) => spec.draft(ratio),
            Self::Transmission(spec) => spec.draft(ratio),
            Self::Ratio(spec) => spec.draft(ratio),
            Self::Circle(spec) => spec.draft(),
            Self::EccentricCircle(spec) => spec.draft(),
            Self::Ellipse(spec) => spec.draft(),
            Self::LobedEllipse(spec) => spec.draft(),
            Self::Limacon(spec) => spec.draft(),
            Self::Bspline(spec) => spec.draft(),
            Self::Bezier(spec) => spec.draft(),
            Self::Conjugate(spec) => spec.draft(),
        }
    }
}

/// How a definition in words states the scale of its curve.
#[derive(Debug)]
enum Scaled {
    /// The definition holds at every scale.
    Not,
    /// By a length that the definition leaves open: its symbol, and its value before scaling, mm.
    Length(&'static str, f64),
    /// By a factor, if the curve is not drawn as it is written.
    Written,
}

/// Proved shape, before scaling.
#[derive(Debug)]
pub(crate) struct Draft {
    /// Key of the shape.
    key: &'static str,
    curve: Box<dyn ScalableCurve>,
    size: Size,
    definition: String,
    scaled: Scaled,
    implied_ratio: Option<(u32, u32)>,
    sampled: SampledLaw,
}

impl Draft {
    fn new(
        key: &'static str,
        curve: impl ScalableCurve + 'static,
        size: Size,
        definition: String,
    ) -> Result<Self, PitchError> {
        size.check()?;
        proof::goes_round_once(&curve, key)?;
        Ok(Self {
            key,
            curve: Box::new(curve),
            size,
            definition,
            scaled: Scaled::Written,
            implied_ratio: None,
            sampled: SampledLaw::default(),
        })
    }

    /// The draft with a form in which its definition states the scale.
    fn scaled(self, scaled: Scaled) -> Self {
        Self { scaled, ..self }
    }

    /// The draft with facts about the samples that it follows.
    fn with_samples(self, sampled: SampledLaw) -> Self {
        Self { sampled, ..self }
    }

    fn finish(mut self) -> Result<Pitch, PitchError> {
        let written = sized(self.key, perimeter(self.curve.as_ref()))?;
        let tooth_count = self.size.tooth_count;
        let mut factor = 1.0;
        let module = match (self.size.module(), tooth_count) {
            (Some(module), Some(z)) => {
                let length = sized(self.size.module_key(), PI * module * f64::from(z))?;
                factor = length / written;
                self.curve.rescale(factor);
                Some(module)
            }
            (None, Some(z)) => Some(written / (PI * f64::from(z))),
            (_, None) => None,
        };
        let symmetry = self.curve.symmetry();
        let shape: Arc<dyn ScalableCurve> = Arc::from(self.curve);
        let stated = |value: f64| match value {
            ..1e-3 => digits::stated(value),
            _ => ((value * 1e9).round() / 1e9).to_string(),
        };
        self.definition += &match self.scaled {
            Scaled::Length(symbol, length) => {
                format!(", {symbol} = {} mm", stated(length * factor))
            }
            Scaled::Written if stated(factor) != "1" => format!(", times {}", stated(factor)),
            Scaled::Written | Scaled::Not => String::new(),
        };
        Ok(Pitch {
            curve: shape,
            tooth_count,
            module,
            definition: self.definition,
            implied_ratio: self.implied_ratio,
            sampled: self.sampled,
            symmetry,
        })
    }
}

/// Minimum and maximum length of a pitch curve, mm: its moments, up to the fourth power, are normal numbers.
const LENGTHS: [f64; 2] = [1e-50, 1e50];

/// Checks that the length of a pitch curve is within the range of the computation.
fn sized(key: &'static str, length: f64) -> Result<f64, PitchError> {
    let [minimum, maximum] = LENGTHS;
    if (minimum..=maximum).contains(&length) {
        return Ok(length);
    }
    Err(PitchError::Size {
        key,
        length,
        minimum,
        maximum,
    })
}

/// Length of one turn of a curve, mm.
fn perimeter(curve: &dyn Curve) -> f64 {
    Antiderivative::new(|t| curve.at(t).first.norm(), &proof::piece_ends(curve)).total()
}

#[cfg(test)]
mod tests;
