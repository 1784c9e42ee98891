use std::f64::consts::TAU;

use centrode_geometry::{Antiderivative, minimum};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{finite, positive};
use super::periodic::{Interpolation, Periodic};
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::points::count;
use super::polar::{even_steps, formula_parts, read_formula, seam};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, Scaled, sampled};
use centrode_kinematics::formula::{Formula, Taylor};
use centrode_spec::degrees;

/// Largest number of turns in the mean ratio of a law.
const MAX_TURNS: u32 = 60;

/// The driven gear's angle as a function of the driver's; the pitch curve follows.
///
/// `r = a f' / (1 + f')`, where `f` is the driven angle, `a` the centre distance. Only differences of
/// `f` count: it is taken to start at zero.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Transmission {
    /// Driven angle, rad, as a formula in the driver angle `phi`, rad.
    pub expression: Option<String>,
    /// Driven angles, rad (degrees in the file), over equal steps of one driver turn, both ends included.
    #[serde(
        rename = "driven_angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub driven_angle: Vec<f64>,
    /// Interpolation between the samples; default: "quintic".
    pub interpolation: Option<Interpolation>,
    /// Centre distance `a`, mm; or leave it out and give module and `tooth_count`.
    pub center_distance: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

/// The ratio `q = d driven / d driver` as a function of the driver angle; the pitch curve follows.
///
/// `r = a q / (1 + q)`, where `a` is the centre distance.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ratio {
    /// Ratio as a formula in the driver angle `phi`, rad.
    pub expression: Option<String>,
    /// Ratios over equal steps of one driver turn, without the repeated end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ratio: Vec<f64>,
    /// Interpolation between the samples; default: "quintic".
    pub interpolation: Option<Interpolation>,
    /// Centre distance `a`, mm; or leave it out and give module and `tooth_count`.
    pub center_distance: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
}

impl Transmission {
    /// Curve of a formula for the driven angle.
    #[must_use]
    pub fn expression(formula: impl Into<String>) -> Self {
        Self {
            expression: Some(formula.into()),
            ..Self::default()
        }
    }

    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let (law, key, total, definition) = match &self.expression {
            Some(text) => {
                let samples = !self.driven_angle.is_empty();
                formula_alone("driven_angle_deg", samples, self.interpolation)?;
                let formula = read_formula("expression", text)?;
                let total = formula.at(TAU).0[0] - formula.at(0.0).0[0];
                let law = RatioForm::Driven(formula);
                (law, "expression", total, format!("driven angle = {text}"))
            }
            None => self.sampled()?,
        };
        let size = self.size()?;
        let corners = sampled::of_ratios(&self.mean_ratios());
        let draft = draft(
            law,
            key,
            Some(total),
            definition,
            size,
            self.center_distance,
        )?;
        Ok(draft.with_corners(corners))
    }

    /// Mean ratio of every step of the samples, at its middle.
    fn mean_ratios(&self) -> Vec<[f64; 2]> {
        let step = TAU / self.driven_angle.len().saturating_sub(1) as f64;
        let steps = self.driven_angle.windows(2).enumerate();
        steps
            .map(|(k, ends)| [step * (k as f64 + 0.5), (ends[1] - ends[0]) / step])
            .collect()
    }

    fn sampled(&self) -> Result<(RatioForm, &'static str, f64, String), PitchError> {
        let key = "driven_angle_deg";
        if self.driven_angle.is_empty() {
            let rule = "is missing: give expression or driven_angle_deg";
            let key = "expression";
            return Err(PitchError::Key { key, rule });
        }
        count(key, self.driven_angle.len(), 7)?;
        for &angle in &self.driven_angle {
            finite(key, angle.to_degrees())?;
        }
        let steps = self.driven_angle.len() - 1;
        let first = self.driven_angle[0];
        let total = self.driven_angle[steps] - first;
        let mean = total / TAU;
        let swing: Vec<f64> = (0..steps)
            .map(|i| self.driven_angle[i] - first - total * i as f64 / steps as f64)
            .collect();
        let interpolation = self.interpolation.unwrap_or(Interpolation::Quintic);
        let swing = Periodic::even(key, &swing, interpolation)?;
        let definition = format!(
            "driven angle, {} through {steps} steps",
            interpolation.name()
        );
        Ok((RatioForm::Swing(mean, swing), key, total, definition))
    }

    fn size(&self) -> Result<Size, PitchError> {
        size(
            self.center_distance,
            self.module,
            self.diametral_pitch,
            self.tooth_count,
        )
    }
}

impl Ratio {
    /// Curve of a formula for the ratio.
    #[must_use]
    pub fn expression(formula: impl Into<String>) -> Self {
        Self {
            expression: Some(formula.into()),
            ..Self::default()
        }
    }

    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let size = size(
            self.center_distance,
            self.module,
            self.diametral_pitch,
            self.tooth_count,
        )?;
        if let Some(text) = &self.expression {
            formula_alone("ratio", !self.ratio.is_empty(), self.interpolation)?;
            let law = RatioForm::Ratio(read_formula("expression", text)?);
            let definition = format!("d driven / d driver = {text}");
            return draft(
                law,
                "expression",
                None,
                definition,
                size,
                self.center_distance,
            );
        }
        if self.ratio.is_empty() {
            let rule = "is missing: give expression or ratio";
            let key = "expression";
            return Err(PitchError::Key { key, rule });
        }
        for &q in &self.ratio {
            positive("ratio", q)?;
        }
        let interpolation = self.interpolation.unwrap_or(Interpolation::Quintic);
        let law = RatioForm::Table(Periodic::even("ratio", &self.ratio, interpolation)?);
        let definition = format!(
            "d driven / d driver, {} through {} samples",
            interpolation.name(),
            self.ratio.len()
        );
        let corners = sampled::of_ratios(&even_steps(&self.ratio));
        let draft = draft(law, "ratio", None, definition, size, self.center_distance)?;
        Ok(draft.with_corners(corners))
    }
}

fn formula_alone(
    list: &'static str,
    given: bool,
    interpolation: Option<Interpolation>,
) -> Result<(), PitchError> {
    let rule = "cannot be given together with expression: give one of them";
    let interpolated = interpolation.map(|_| "interpolation");
    match given.then_some(list).or(interpolated) {
        Some(key) => Err(PitchError::Key { key, rule }),
        None => Ok(()),
    }
}

fn size(
    own: Option<f64>,
    module: Option<f64>,
    diametral_pitch: Option<f64>,
    tooth_count: Option<u32>,
) -> Result<Size, PitchError> {
    let size = Size::new(
        module,
        diametral_pitch,
        tooth_count,
        OwnSize::of("center_distance", own)?,
    );
    size.check().map(|()| size)
}

/// The pitch curve of a law whose driven gear makes the angle `total` in one driver turn.
fn draft(
    law: RatioForm,
    key: &'static str,
    total: Option<f64>,
    definition: String,
    size: Size,
    center_distance: Option<f64>,
) -> Result<Draft, PitchError> {
    let (start, end) = (law.ratio(0.0).derivatives(), law.ratio(TAU).derivatives());
    for (angle, q) in [(0.0, start[0]), (360.0, end[0])] {
        if !q.is_finite() {
            return Err(PitchError::Undefined {
                key,
                angle,
                value: q,
            });
        }
        if q <= 0.0 {
            return Err(PitchError::RatioNotPositive {
                key,
                angle,
                ratio: q,
            });
        }
    }
    if (start[0] - end[0]).abs() > 1e-9 * start[0].abs() {
        return Err(PitchError::OpenCurve {
            key,
            what: "d driven / d driver",
            start: start[0],
            end: end[0],
        });
    }
    let mut breaks = law.breaks(key)?;
    if breaks.first().is_none_or(|&first| first > 0.0) {
        breaks.splice(0..0, seam(&start, &end));
    }
    let mut ends = breaks.clone();
    ends.retain(|&t| t > 0.0);
    ends.insert(0, 0.0);
    ends.push(TAU);
    let low = minimum(|t| law.ratio(t).derivatives()[0], &ends);
    if low.value <= 0.0 {
        return Err(PitchError::RatioNotPositive {
            key,
            angle: low.input.to_degrees(),
            ratio: low.value,
        });
    }
    let a = center_distance.unwrap_or(1.0);
    let radius = LawRadius { law, a, breaks };
    let curve = PolarCurve::new(radius);
    let draft = Draft::new(key, curve, size, definition);
    let mut draft = draft.map_err(|error| match error {
        PitchError::RadiusNotPositive { key, angle, radius } => PitchError::RatioNotPositive {
            key,
            angle,
            ratio: radius / (a - radius),
        },
        other => other,
    })?;
    let total = total.unwrap_or_else(|| {
        let q = |t: f64| {
            let radius = draft.curve.at(t).point.coords.norm();
            radius / (a - radius)
        };
        Antiderivative::new(q, &ends).total()
    });
    draft.scaled = Scaled::Not;
    draft.implied_ratio = Some(turns(key, total / TAU)?);
    Ok(draft)
}

/// Turns of driver and driven gear, in lowest terms, if the driven gear makes `turns` turns per driver turn.
fn turns(key: &'static str, turns: f64) -> Result<(u32, u32), PitchError> {
    for driver in 1..=MAX_TURNS {
        let driven = (turns * f64::from(driver)).round();
        if driven >= 1.0
            && driven <= MAX_TURNS.into()
            && (turns * f64::from(driver) - driven).abs() <= 1e-9 * driven
        {
            return Ok((driver, driven as u32));
        }
    }
    let limit = MAX_TURNS;
    Err(PitchError::RatioNotRational { key, turns, limit })
}

#[derive(Debug)]
enum RatioForm {
    /// Driven angle.
    Driven(Formula),
    /// Mean ratio, and the deviation of the driven angle from it.
    Swing(f64, Periodic),
    /// Ratio.
    Ratio(Formula),
    Table(Periodic),
}

impl RatioForm {
    /// d driven / d driver; its first four coefficients are known.
    fn ratio(&self, phi: f64) -> Taylor {
        match self {
            Self::Driven(f) => f.at(phi).differentiated(),
            Self::Swing(mean, swing) => swing.at(phi).differentiated() + Taylor::constant(*mean),
            Self::Ratio(q) => q.at(phi),
            Self::Table(q) => q.at(phi),
        }
    }

    fn breaks(&self, key: &'static str) -> Result<Vec<f64>, PitchError> {
        match self {
            Self::Driven(f) | Self::Ratio(f) => formula_parts(key, f),
            Self::Swing(_, p) | Self::Table(p) => Ok(p.breaks()),
        }
    }
}

#[derive(Debug)]
struct LawRadius {
    law: RatioForm,
    a: f64,
    breaks: Vec<f64>,
}

impl RadiusLaw for LawRadius {
    fn radius(&self, phi: &Direction) -> Derivatives {
        let q = self.law.ratio(phi.angle.rem_euclid(TAU));
        let share = q / (Taylor::constant(1.0) + q);
        share.derivatives().map(|d| d * self.a)
    }

    fn breaks(&self) -> Vec<f64> {
        self.breaks.clone()
    }
}
