use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::finite;
use super::noise::Effect;
use super::periodic::{Fourier, Interpolation, Periodic};
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::size::{OwnSize, Size};
use super::table::{Smooth, Table, TableLaw, not_read};
use super::{Draft, PitchError, SampledLaw, Symmetry, sampled};
use centrode_kinematics::formula::{Formula, FormulaError, Steep};
use centrode_spec::{Column, degrees};

/// A radius as a function of the polar angle: a formula, a table or a Fourier series.
///
/// Give one of: `expression`; `radius` (equal steps from the angle zero, or with `angle_deg`);
/// `mean` with `cos` and `sin`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Polar {
    /// Radius, mm, as a formula in `phi` (rad): `+ - * / ^`, `pi`, sin, cos, tan, asin, acos, atan,
    /// sinh, cosh, tanh, exp, ln, sqrt.
    pub expression: Option<String>,
    /// Radii, mm; over equal steps from the angle zero if `angle_deg` is omitted. The last one may repeat the first, a turn later.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub radius: Vec<f64>,
    /// Polar angles of the radii, rad (degrees in the file), increasing within one turn.
    #[serde(
        rename = "angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub angle: Vec<f64>,
    /// CSV file with the radii, instead of the lists: its path from the folder of the design file. If it has several
    /// columns, the first has the polar angles, degrees.
    pub file: Option<String>,
    /// Column of the file: its heading, or its number from one; default: the second one, or the only one.
    pub column: Option<Column>,
    /// Interpolation between the radii; default: "quintic" over equal steps, "cubic" over others.
    pub interpolation: Option<Interpolation>,
    /// Smoothing of the radii by a Fourier series, instead of an interpolation.
    pub smooth: Option<Smooth>,
    /// Mean radius of a Fourier series, mm.
    pub mean: Option<f64>,
    /// Cosine coefficients from the first harmonic, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cos: Vec<f64>,
    /// Sine coefficients from the first harmonic, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sin: Vec<f64>,
    /// Module, mm, with `tooth_count`: scales the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth; alone, the module follows from the size of the curve.
    pub tooth_count: Option<u32>,
}

impl Polar {
    /// Curve of a formula for the radius.
    #[must_use]
    pub fn expression(formula: impl Into<String>) -> Self {
        Self {
            expression: Some(formula.into()),
            ..Self::default()
        }
    }

    pub(super) fn draft(&self, ratio: Option<(u32, u32)>) -> Result<Draft, PitchError> {
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::Written,
        );
        not_read(self.file.as_deref(), self.column.is_some())?;
        if let Some(text) = &self.expression {
            self.nothing_of(&["radius", "mean"])?;
            let law = FormulaLaw::read("expression", text)?;
            let definition = format!("polar, r = {text}");
            return Draft::new("expression", PolarCurve::new(law), size, definition);
        }
        if let Some(mean) = self.mean {
            self.nothing_of(&["radius"])?;
            finite("mean", mean)?;
            for (key, list) in [("cos", &self.cos), ("sin", &self.sin)] {
                list.iter().try_for_each(|&c| finite(key, c).map(drop))?;
            }
            let series = Fourier::new(mean, &self.cos, &self.sin)?;
            let definition = format!(
                "polar, Fourier series of {} harmonics",
                self.cos.len().max(self.sin.len())
            );
            let law = RadiusTable(Periodic::from(series));
            return Draft::new("mean", PolarCurve::new(law), size, definition);
        }
        if self.radius.is_empty() {
            let rule = "is missing: give expression, or radius, or mean with cos and sin";
            let key = "expression";
            return Err(PitchError::Key { key, rule });
        }
        self.nothing_of(&["mean"])?;
        for &r in &self.radius {
            super::error::positive("radius", r)?;
        }
        let table = Table::new("radius", &self.angle, &self.radius)?;
        let folds = ratio.map_or(1, |(_, n2)| n2);
        let law = table.law(self.interpolation, self.smooth, folds)?;
        let effect = Effect {
            order: 2,
            curvature: 1.0 / law.law.mean(),
            unit: 1.0,
        };
        let sampled = SampledLaw {
            corners: match self.smooth {
                None => sampled::of_radii(&table.samples()),
                Some(_) => Vec::new(),
            },
            noise: table.noise(&law, effect),
            scaling: None,
        };
        let TableLaw { law, words, .. } = law;
        let definition = format!("polar, {words} radii");
        let curve = PolarCurve::new(RadiusTable(law));
        let draft = Draft::new("radius", curve, size, definition);
        let draft = draft.map_err(|error| sampled.blamed(error))?;
        Ok(draft.with_samples(sampled))
    }

    /// Refuses keys of another definition of the radius than the one in use.
    fn nothing_of(&self, ways: &[&str]) -> Result<(), PitchError> {
        let given = [
            ("radius", "radius", !self.radius.is_empty()),
            ("radius", "angle_deg", !self.angle.is_empty()),
            ("radius", "interpolation", self.interpolation.is_some()),
            ("radius", "smooth", self.smooth.is_some()),
            ("mean", "mean", self.mean.is_some()),
            ("mean", "cos", !self.cos.is_empty()),
            ("mean", "sin", !self.sin.is_empty()),
        ];
        let stray = given.iter().find(|(way, _, on)| *on && ways.contains(way));
        match stray {
            Some((_, key, _)) => Err(PitchError::Key {
                key,
                rule: "cannot be given together with the other keys: give one of expression, radius (with angle_deg, interpolation, smooth), mean (with cos, sin)",
            }),
            None => Ok(()),
        }
    }
}

impl Interpolation {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Cubic => "periodic cubic spline",
            Self::Quintic => "periodic quintic spline",
            Self::Trigonometric => "trigonometric polynomial",
        }
    }
}

/// Reads a formula; the error names the position at which it cannot be read.
///
/// # Errors
/// [`PitchError`] with the key.
pub fn read_formula(key: &'static str, text: &str) -> Result<Formula, PitchError> {
    Formula::read(text).map_err(|FormulaError { reason, column }| PitchError::Expression {
        key,
        reason,
        column,
    })
}

/// Angles at which a formula is divided so that no narrow feature is stepped over.
///
/// # Errors
/// [`PitchError`] with the key, for features too narrow to be followed.
pub fn formula_parts(key: &'static str, formula: &Formula) -> Result<Vec<f64>, PitchError> {
    let steep = |Steep { width, minimum }| PitchError::Steep {
        key,
        width,
        minimum,
    };
    formula.parts(TAU).map_err(steep)
}

#[derive(Debug)]
struct FormulaLaw {
    formula: Formula,
    breaks: Vec<f64>,
}

impl FormulaLaw {
    fn read(key: &'static str, text: &str) -> Result<Self, PitchError> {
        let formula = read_formula(key, text)?;
        let (start, end) = (formula.at(0.0).derivatives(), formula.at(TAU).derivatives());
        for (angle, value) in [(0.0, start[0]), (360.0, end[0])] {
            if !value.is_finite() {
                return Err(PitchError::Undefined { key, angle, value });
            }
        }
        let size = start[0].abs().max(end[0].abs());
        if (start[0] - end[0]).abs() > 1e-9 * size {
            return Err(PitchError::OpenCurve {
                key,
                what: "the radius",
                start: start[0],
                end: end[0],
            });
        }
        let mut breaks = seam(&start, &end);
        breaks.extend(formula_parts(key, &formula)?);
        Ok(Self { formula, breaks })
    }
}

/// A break at the angle zero, unless all derivatives of both ends of the turn agree.
pub(crate) fn seam(start: &Derivatives, end: &Derivatives) -> Vec<f64> {
    let size = start.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    let smooth = start
        .iter()
        .zip(end)
        .all(|(a, b)| (a - b).abs() <= 1e-9 * size);
    if smooth { Vec::new() } else { vec![0.0] }
}

impl RadiusLaw for FormulaLaw {
    fn radius(&self, phi: &Direction) -> Derivatives {
        self.formula.at(phi.angle.rem_euclid(TAU)).derivatives()
    }

    fn breaks(&self) -> Vec<f64> {
        self.breaks.clone()
    }
}

#[derive(Debug)]
struct RadiusTable(Periodic);

impl RadiusLaw for RadiusTable {
    fn radius(&self, phi: &Direction) -> Derivatives {
        self.0.at(phi.angle).derivatives()
    }

    fn breaks(&self) -> Vec<f64> {
        self.0.breaks()
    }

    fn symmetry(&self) -> Symmetry {
        self.0.symmetry()
    }
}
