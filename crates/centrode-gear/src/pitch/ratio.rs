use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::positive;
use super::mean::scaling;
use super::periodic::Interpolation;
use super::polar::read_formula;
use super::table::{Smooth, Table, TableLaw, not_read};
use super::transmission::{RatioForm, draft, effect, formula_alone, size};
use super::{Draft, PitchError, SampledLaw, sampled};
use centrode_spec::{Column, degrees};

/// The ratio `q = d driven / d driver` as a function of the driver angle; the pitch curve follows.
///
/// `r = a q / (1 + q)`, where `a` is the centre distance.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ratio {
    /// Ratio as a formula in the driver angle `phi`, rad.
    pub expression: Option<String>,
    /// Ratios over equal steps of one driver turn if `angle_deg` is omitted. The last one may repeat the first, a turn later.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ratio: Vec<f64>,
    /// Driver angles of the samples, rad (degrees in the file), increasing within one turn.
    #[serde(
        rename = "angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub angle: Vec<f64>,
    /// CSV file with the ratios, instead of the lists: its path from the folder of the design file. If it has several
    /// columns, the first has the driver angles, degrees.
    pub file: Option<String>,
    /// Column of the file: its heading, or its number from one; default: the second one, or the only one.
    pub column: Option<Column>,
    /// Interpolation between the samples; default: "quintic" over equal steps, "cubic" over others.
    pub interpolation: Option<Interpolation>,
    /// Smoothing of the samples by a Fourier series, instead of an interpolation.
    pub smooth: Option<Smooth>,
    /// Centre distance `a`, mm; or leave it out and give module and `tooth_count`.
    pub center_distance: Option<f64>,
    /// Module, mm, with `tooth_count`: sets the size of the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth.
    pub tooth_count: Option<u32>,
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

    pub(super) fn draft(&self, ratio: Option<(u32, u32)>) -> Result<Draft, PitchError> {
        not_read(self.file.as_deref(), self.column.is_some())?;
        let key = "ratio";
        let size = size(
            self.center_distance,
            self.module,
            self.diametral_pitch,
            self.tooth_count,
        )?;
        if let Some(text) = &self.expression {
            formula_alone(&[
                (key, !self.ratio.is_empty()),
                ("angle_deg", !self.angle.is_empty()),
                ("interpolation", self.interpolation.is_some()),
                ("smooth", self.smooth.is_some()),
            ])?;
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
            positive(key, q)?;
        }
        let table = Table::new(key, &self.angle, &self.ratio)?;
        let folds = ratio.map_or(1, |(_, n2)| n2);
        let law = table.law(self.interpolation, self.smooth, folds)?;
        let mean = law.law.mean();
        let (scaling, factor) = scaling(key, mean, ratio)?;
        let sampled = SampledLaw {
            corners: match self.smooth {
                None => sampled::of_ratios(&table.samples()),
                Some(_) => Vec::new(),
            },
            scaling,
            noise: table.noise(&law, effect(2, mean)),
        };
        let TableLaw { law, words, .. } = law;
        let law = match scaling {
            Some(_) => law.scaled(factor),
            None => law,
        };
        let draft = draft(
            RatioForm::Table(law),
            key,
            None,
            format!("d driven / d driver, {words} samples"),
            size,
            self.center_distance,
        );
        let draft = draft.map_err(|error| sampled.blamed(error))?;
        Ok(draft.with_samples(sampled))
    }
}
