use std::f64::consts::TAU;

use centrode_geometry::{Antiderivative, minimum};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::finite;
use super::mean::{MOST_SCALING, driven_turns, nearest_ratio, scaling, turns};
use super::noise::Effect;
use super::periodic::{Interpolation, Periodic};
use super::plane::{Derivatives, Direction, PolarCurve, RadiusLaw};
use super::points::count;
use super::polar::{formula_parts, read_formula, seam};
use super::size::{OwnSize, Size};
use super::table::{Smooth, SmoothAngle, Table, TableLaw, is_turn, not_read};
use super::{Draft, PitchError, SampledLaw, Scaled, sampled};
use centrode_kinematics::formula::{Formula, Taylor};
use centrode_spec::{Column, degrees};

/// The driven gear's angle as a function of the driver's; the pitch curve follows.
///
/// `r = a f' / (1 + f')`, where `f` is the driven angle, `a` the centre distance. Only differences of
/// `f` count: it is taken to start at zero.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Transmission {
    /// Driven angle, rad, as a formula in the driver angle `phi`, rad.
    pub expression: Option<String>,
    /// Driven angles, rad (degrees in the file), over equal steps of one driver turn if `angle_deg` is omitted. The last one may be
    /// that of the whole turn: the first plus the turn of the driven gear.
    #[serde(
        rename = "driven_angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub driven_angle: Vec<f64>,
    /// Driver angles of the samples, rad (degrees in the file), increasing within one turn.
    #[serde(
        rename = "angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub angle: Vec<f64>,
    /// CSV file with the driven angles, degrees, instead of the lists: its path from the folder of the design file. If it has several
    /// columns, the first has the driver angles, degrees.
    pub file: Option<String>,
    /// Column of the file: its heading, or its number from one; default: the second one, or the only one.
    pub column: Option<Column>,
    /// Interpolation between the samples; default: "quintic" over equal steps, "cubic" over others.
    pub interpolation: Option<Interpolation>,
    /// Smoothing of the samples by a Fourier series, instead of an interpolation.
    pub smooth: Option<SmoothAngle>,
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

    pub(super) fn draft(&self, ratio: Option<(u32, u32)>) -> Result<Draft, PitchError> {
        not_read(self.file.as_deref(), self.column.is_some())?;
        let size = self.size()?;
        let Some(text) = &self.expression else {
            return self.sampled(ratio, size);
        };
        formula_alone(&[
            ("driven_angle_deg", !self.driven_angle.is_empty()),
            ("angle_deg", !self.angle.is_empty()),
            ("interpolation", self.interpolation.is_some()),
            ("smooth", self.smooth.is_some()),
        ])?;
        let formula = read_formula("expression", text)?;
        let total = formula.at(TAU).0[0] - formula.at(0.0).0[0];
        let definition = format!("driven angle = {text}");
        draft(
            RatioForm::Driven(formula),
            "expression",
            Some(total),
            definition,
            size,
            self.center_distance,
        )
    }

    fn sampled(&self, ratio: Option<(u32, u32)>, size: Size) -> Result<Draft, PitchError> {
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
        let (turn, values) = self.turn(ratio);
        let angle = &self.angle[..self.angle.len().min(values.len())];
        let (scaling, factor) = scaling(key, turn / TAU, ratio)?;
        let total = turn * factor;
        let steps = values.len();
        let uniform = |i: usize| match angle.get(i) {
            Some(at) => total * (at - angle[0]) / TAU,
            None => total * i as f64 / steps as f64,
        };
        let swing: Vec<f64> = (0..steps)
            .map(|i| (values[i] - values[0]) * factor - uniform(i))
            .collect();
        let table = Table::at(key, angle, &swing)?;
        let folds = ratio.map_or(1, |(_, n2)| n2);
        let smooth = self.smooth.map(Smooth::from);
        let law = table.law(self.interpolation, smooth, folds)?;
        let sampled = SampledLaw {
            corners: match smooth {
                None => sampled::of_ratios(&mean_ratios(&table.samples(), total)),
                Some(_) => Vec::new(),
            },
            scaling,
            noise: table.noise(&law, effect(3, total / TAU)),
        };
        let TableLaw { law, words, .. } = law;
        let draft = draft(
            RatioForm::Swing(total / TAU, law),
            key,
            Some(total),
            format!("driven angle, {words} steps"),
            size,
            self.center_distance,
        );
        let draft = draft.map_err(|error| sampled.blamed(error))?;
        Ok(draft.with_samples(sampled))
    }

    /// Turn of the driven gear in one driver turn, rad, and the samples without the one that ends the turn.
    ///
    /// If the table has no angles, its last sample ends the turn if the turn of the driven gear is nearer to this sample than to
    /// the next step. A table that omits the last sample has the turn of the mean ratio. Without a mean ratio, a last sample at a
    /// ratio of whole numbers ends the turn.
    fn turn(&self, ratio: Option<(u32, u32)>) -> (f64, &[f64]) {
        let values = self.driven_angle.as_slice();
        let last = values.len() - 1;
        let shown = values[last] - values[0];
        let step = 0.5 * (values[1] - values[0] + values[last] - values[last - 1]);
        let nearest = ratio.unwrap_or_else(|| nearest_ratio((shown + step) / TAU));
        let required = TAU * driven_turns(nearest);
        let ends = match self.angle.as_slice() {
            [first, .., last] => is_turn(last - first),
            _ if ratio.is_none() && turns("driven_angle_deg", shown / TAU).is_ok() => true,
            _ => (required - shown).abs() <= (required - shown - step).abs(),
        };
        match ends {
            true => (shown, &values[..last]),
            // The step that is missing is not measured: it makes the turn whole, unless the samples are far from it.
            false if (required - shown - step).abs() <= MOST_SCALING * required => {
                (required, values)
            }
            false => (shown + step, values),
        }
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

/// Effect of samples whose derivative of an order is the second derivative of the ratio, about the mean ratio: that of
/// `r = a q / (1 + q)` is `r''/r = q''/(q (1 + q))`.
pub(super) fn effect(order: i32, mean: f64) -> Effect {
    Effect {
        order,
        curvature: 1.0 / (mean * (1.0 + mean)),
        unit: if order == 3 {
            1.0_f64.to_degrees()
        } else {
            1.0
        },
    }
}

/// Mean ratio of every step of the deviations of the driven angle from uniform motion, at the middle of the step.
fn mean_ratios(swing: &[[f64; 2]], total: f64) -> Vec<[f64; 2]> {
    let [first, ..] = swing else {
        return Vec::new();
    };
    let end = [first[0] + TAU, first[1]];
    let after = swing.iter().skip(1).chain([&end]);
    let steps = swing.iter().zip(after);
    steps
        .map(|([from, low], [to, high])| {
            let ratio = (high - low) / (to - from) + total / TAU;
            [0.5 * (from + to), ratio]
        })
        .collect()
}

/// Refuses keys of samples next to a formula.
pub(super) fn formula_alone(keys: &[(&'static str, bool)]) -> Result<(), PitchError> {
    let rule = "cannot be given together with expression: give one of them";
    match keys.iter().find(|(_, given)| *given) {
        Some((key, _)) => Err(PitchError::Key { key, rule }),
        None => Ok(()),
    }
}

pub(super) fn size(
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
pub(super) fn draft(
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

#[derive(Debug)]
pub(super) enum RatioForm {
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
