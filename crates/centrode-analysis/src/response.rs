use std::borrow::Cow;

use centrode_geometry::Cancel;
use centrode_spec::{Design, DesignError, MechanismError};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde::Serialize;

use crate::{Report, Unit, figure};

/// Response of the figures of a mechanism to one number of its design: the parameter response of Yin et al. 2021,
/// Figure 5, DOI 10.25165/j.ijabe.20211405.6844, for any number of any family.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Response {
    /// Key of the number in the design file.
    pub key: String,
    /// Values of the number with which the design was checked, in the file's unit; whole numbers for a count.
    pub values: Vec<f64>,
    /// Report at each value, or the reason why the value gives no mechanism.
    pub reports: Vec<Result<Report, String>>,
}

/// A figure at each value of a [`Response`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// Name of the goal or figure.
    pub name: Cow<'static, str>,
    /// Unit of the figures.
    pub unit: Unit,
    /// The figure at each value; `None` if there is none.
    #[serde(serialize_with = "figure::options")]
    pub figures: Vec<Option<f64>>,
}

impl Response {
    /// Checks a design with each of the values, in the file's unit, at the key `key`; all other numbers stay. `report` checks
    /// one such design.
    ///
    /// # Errors
    /// [`DesignError`] if the key does not name a number of the design. A value that gives no mechanism is not an error: it
    /// has the reason instead of a report.
    pub fn evaluate(
        design: &dyn Design,
        key: &str,
        values: &[f64],
        report: impl Fn(&dyn Design) -> Result<Report, MechanismError> + Sync,
    ) -> Result<Self, DesignError> {
        let numbered = design.numbered(key)?;
        let cancel = Cancel::current();
        let report = |&value: &f64| {
            let _scope = cancel.enter();
            let design = numbered.with(value).map_err(|error| error.message())?;
            report(design.as_ref()).map_err(|error| error.message())
        };
        Ok(Self {
            key: key.to_owned(),
            values: values.iter().map(|&value| numbered.taken(value)).collect(),
            reports: values.into_par_iter().panic_fuse().map(report).collect(),
        })
    }

    /// Whether the design has goals.
    #[must_use]
    pub fn has_goals(&self) -> bool {
        self.reports
            .iter()
            .flatten()
            .any(|report| !report.goals.is_empty())
    }

    /// The figures of the goals, then all other figures by name.
    #[must_use]
    pub fn answers(&self) -> Vec<Answer> {
        let mut found: Vec<Answer> = Vec::new();
        let add = |found: &mut Vec<Answer>, name: Cow<'static, str>, unit, at: usize, figure| {
            let place = found.iter().position(|answer| answer.name == name);
            let place = place.unwrap_or_else(|| {
                let figures = vec![None; self.values.len()];
                found.push(Answer {
                    name,
                    unit,
                    figures,
                });
                found.len() - 1
            });
            found[place].figures[at] = figure;
        };
        for (at, report) in self.reports.iter().enumerate() {
            for goal in report.iter().flat_map(|report| &report.goals) {
                add(&mut found, goal.name.clone(), goal.unit, at, goal.value);
            }
        }
        for (at, report) in self.reports.iter().enumerate() {
            let Ok(report) = report else { continue };
            for (name, value) in &report.values {
                // The figure of a goal is already listed.
                if !found
                    .iter()
                    .any(|a| a.name == *name && a.figures[at].is_some())
                {
                    let unit = report.unit(name).unwrap_or(Unit::Number);
                    add(&mut found, Cow::Borrowed(*name), unit, at, Some(*value));
                }
            }
        }
        found
    }
}
