use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PitchError;
use super::error::positive;
use super::noise::{self, Effect, SampleNoise};
use super::periodic::{Fourier, Interpolation, MAX_HARMONICS, Periodic};
use super::points::{angles_in_order, count};
use centrode_spec::degrees;

/// Difference of two samples, as a share of the largest sample, up to which they are equal: rounding. Ten thousand times more
/// takes neighbours of a dense table for equal; a thousand times less misses the repeated end of a computed table.
const EQUAL: f64 = 1e-9;

/// Distance of a position from equal steps, in turns, up to which the steps are equal: rounding of tables with four decimals of a
/// degree. A hundred times more moves samples by a visible part of a step; a hundred times less treats such tables as unequal.
const EVEN: f64 = 1e-6;

/// Ratio of the roughness of two readings of a table from which the smoother one is right. At 10 the end of coarse tables is not
/// recognised, at 1 rounding decides about dwells.
const ROUGHER: f64 = 1.5;

/// Number of even steps per sample at which the spline through unequal steps is sampled for its Fourier series. Fewer steps mix
/// high harmonics into the low ones; more take longer.
const FINER: usize = 4;

/// Smoothing of samples by a Fourier series: give one of both keys.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Smooth {
    /// Highest harmonic of the series.
    pub harmonics: Option<u32>,
    /// Maximum distance of the series from every sample, in the unit of the samples. The series has the fewest harmonics within
    /// it.
    pub tolerance: Option<f64>,
}

/// Smoothing of driven angles by a Fourier series: give one of both keys.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SmoothAngle {
    /// Highest harmonic of the series.
    pub harmonics: Option<u32>,
    /// Maximum distance of the series from every sample, rad (degrees in the file). The series has the fewest harmonics within
    /// it.
    #[serde(rename = "tolerance_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub tolerance: Option<f64>,
}

impl From<SmoothAngle> for Smooth {
    fn from(angle: SmoothAngle) -> Self {
        Self {
            harmonics: angle.harmonics,
            tolerance: angle.tolerance,
        }
    }
}

/// Samples of a function of period one turn, each at its angle.
#[derive(Debug)]
pub(super) struct Table {
    key: &'static str,
    /// Angles of the samples, rad; `None` for equal steps from the angle zero.
    angle: Option<Vec<f64>>,
    values: Vec<f64>,
}

/// Function through or near the samples of a table.
#[derive(Debug)]
pub(super) struct TableLaw {
    pub(super) law: Periodic,
    /// The law in words.
    pub(super) words: String,
    /// Highest harmonic of a smoothed law.
    pub(super) highest: Option<usize>,
}

impl Table {
    /// Table of samples at the given angles, rad, or at equal steps if there are none. A repeated first sample at the end is
    /// dropped.
    ///
    /// # Errors
    /// [`PitchError`] for angles that do not increase within one turn, or whose number is not that of the samples.
    pub(super) fn new(
        key: &'static str,
        angle: &[f64],
        values: &[f64],
    ) -> Result<Self, PitchError> {
        let repeated = usize::from(repeats(angle, values));
        let count = |list: &[f64]| list.len().saturating_sub(repeated);
        Self::at(key, &angle[..count(angle)], &values[..count(values)])
    }

    /// Table of samples of which none is repeated.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub(super) fn at(key: &'static str, angle: &[f64], values: &[f64]) -> Result<Self, PitchError> {
        let mut table = Self {
            key,
            angle: None,
            values: values.to_vec(),
        };
        if angle.is_empty() {
            return Ok(table);
        }
        if angle.len() != values.len() {
            return Err(PitchError::LengthMismatch {
                first: key,
                first_length: values.len(),
                second: "angle_deg",
                second_length: angle.len(),
            });
        }
        angles_in_order(angle)?;
        let step = TAU / values.len() as f64;
        let mut angles = angle.iter().enumerate();
        if !angles.all(|(k, a)| (a - step * k as f64).abs() <= EVEN * TAU) {
            table.angle = Some(angle.to_vec());
        }
        Ok(table)
    }

    /// Number of samples.
    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    /// Angle of a sample, rad.
    fn angle(&self, k: usize) -> f64 {
        match &self.angle {
            Some(angle) => angle[k],
            None => TAU / self.count() as f64 * k as f64,
        }
    }

    /// Angle and value of every sample, in order of the angle.
    pub(super) fn samples(&self) -> Vec<[f64; 2]> {
        let values = self.values.iter().enumerate();
        values.map(|(k, &value)| [self.angle(k), value]).collect()
    }

    /// Function through the samples, or near them if they are smoothed. A smoothed function repeats `folds` times per turn.
    ///
    /// # Errors
    /// [`PitchError`] with the key, for too few or too many samples or an impossible smoothing.
    pub(super) fn law(
        &self,
        interpolation: Option<Interpolation>,
        smooth: Option<Smooth>,
        folds: u32,
    ) -> Result<TableLaw, PitchError> {
        let count = self.count();
        if let Some(smooth) = smooth {
            if interpolation.is_some() {
                return Err(PitchError::Key {
                    key: "interpolation",
                    rule: "cannot be given together with smooth: a smoothed law is a Fourier series",
                });
            }
            let (series, harmonics) = self.smoothed(smooth, folds as usize)?;
            return Ok(TableLaw {
                law: Periodic::from(series),
                words: format!("Fourier series up to harmonic {harmonics} of {count}"),
                highest: Some(harmonics),
            });
        }
        let usual = match self.angle {
            Some(_) => Interpolation::Cubic,
            None => Interpolation::Quintic,
        };
        let interpolation = interpolation.unwrap_or(usual);
        let law = match &self.angle {
            None => Periodic::even(self.key, &self.values, interpolation)?,
            Some(angle) if interpolation == Interpolation::Cubic => {
                Periodic::uneven(self.key, angle, &self.values)?
            }
            Some(_) => {
                return Err(PitchError::Key {
                    key: "interpolation",
                    rule: "must be \"cubic\" if the steps of angle_deg are not equal",
                });
            }
        };
        let words = format!("{} through {count}", interpolation.name());
        Ok(TableLaw {
            law,
            words,
            highest: None,
        })
    }

    /// Noise of the samples, if it dominates the curvature of their pitch curve.
    pub(super) fn noise(&self, law: &TableLaw, effect: Effect) -> Option<SampleNoise> {
        noise::of_samples(&self.evenly(1).ok()?, law.highest, effect)
    }

    /// Samples at equal steps from the angle zero: those of the table, or `finer` times as many of the spline through them.
    fn evenly(&self, finer: usize) -> Result<Vec<f64>, PitchError> {
        let Some(angle) = &self.angle else {
            return Ok(self.values.clone());
        };
        let spline = Periodic::uneven(self.key, angle, &self.values)?;
        let count = finer * self.count();
        let at = |k: usize| spline.at(TAU * k as f64 / count as f64).0[0];
        Ok((0..count).map(at).collect())
    }

    /// The first harmonics of the samples, and the highest one.
    fn smoothed(&self, smooth: Smooth, folds: usize) -> Result<(Fourier, usize), PitchError> {
        count(self.key, self.count(), 3)?;
        let limit = MAX_HARMONICS.min(self.count() / 2);
        let even = self.evenly(FINER)?;
        let series = |highest: usize| Fourier::of_samples(&even, highest, folds);
        match (smooth.harmonics, smooth.tolerance) {
            (Some(highest), None) => {
                let highest = highest as usize;
                if !(1..=limit).contains(&highest) {
                    return Err(PitchError::OutOfRange {
                        key: "smooth.harmonics",
                        value: highest as u64,
                        minimum: 1,
                        maximum: limit as u64,
                    });
                }
                Ok((series(highest), highest))
            }
            (None, Some(tolerance)) => {
                positive("smooth.tolerance", tolerance)?;
                let series = series(limit);
                match self.within(&series, tolerance) {
                    Ok(highest) => Ok((series.cut(highest), highest)),
                    Err(residual) => Err(PitchError::NotSmoothed {
                        tolerance,
                        limit,
                        residual,
                    }),
                }
            }
            _ => Err(PitchError::Key {
                key: "smooth",
                rule: "needs one of harmonics and tolerance",
            }),
        }
    }

    /// Fewest harmonics of a series, one or more, within a distance of every sample; the distance of all of them if they are
    /// farther.
    fn within(&self, series: &Fourier, tolerance: f64) -> Result<usize, f64> {
        let mut rest: Vec<f64> = self.values.iter().map(|v| v - series.mean()).collect();
        let mut residual = f64::INFINITY;
        for (n, [a, b]) in (1..).zip(series.harmonics()) {
            for (k, rest) in rest.iter_mut().enumerate() {
                let (sin, cos) = (n as f64 * self.angle(k)).sin_cos();
                *rest -= a * cos + b * sin;
            }
            residual = rest.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
            if residual <= tolerance {
                return Ok(n);
            }
        }
        Err(residual)
    }
}

/// Refuses a file that was not read with the design, and a column without a file.
pub(super) fn not_read(file: Option<&str>, column: bool) -> Result<(), PitchError> {
    match file {
        Some(file) => Err(PitchError::NotRead(file.to_owned())),
        None if column => Err(PitchError::Key {
            key: "column",
            rule: "is of no use without file",
        }),
        None => Ok(()),
    }
}

/// Whether the last sample repeats the first one: a turn later, or, if there are no angles, as far as the values show.
fn repeats(angle: &[f64], values: &[f64]) -> bool {
    let size = values.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
    let equal = |a: f64, b: f64| (a - b).abs() <= EQUAL * size;
    let [first, rest @ .., last] = values else {
        return false;
    };
    if !equal(*first, *last) || rest.is_empty() {
        return false;
    }
    if let [first, .., last] = angle {
        return is_turn(last - first);
    }
    let [with, without] = [values, &values[..values.len() - 1]].map(seam_roughness);
    // Equality is no accident if no other neighbours are equal, unless the table is smooth with the last sample. If others are
    // equal, as in dwells and rounded tables, the last sample is dropped only if the table is smoother without it.
    match values.windows(2).any(|pair| equal(pair[0], pair[1])) {
        false => without < ROUGHER * with,
        true => with > ROUGHER * without,
    }
}

/// Whether an angle, rad, is one turn, within rounding.
pub(super) fn is_turn(angle: f64) -> bool {
    (angle - TAU).abs() <= EQUAL * TAU
}

/// Root of the sum of the squared fourth differences over the end of a periodic list.
fn seam_roughness(values: &[f64]) -> f64 {
    /// Weights of the fourth difference.
    const FOURTH: [f64; 5] = [1.0, -4.0, 6.0, -4.0, 1.0];
    let count = values.len();
    let difference = |start: usize| -> f64 {
        let terms = FOURTH.iter().enumerate();
        terms.map(|(k, w)| w * values[(start + k) % count]).sum()
    };
    let starts = (count.saturating_sub(5)..count).map(difference);
    starts.map(|d| d * d).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests;
