use std::borrow::Cow;
use std::collections::BTreeMap;

use centrode_geometry::Cancel;
use centrode_spec::{Design, DesignError, MechanismError};
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;

use crate::{Report, Unit, figure};

/// Figures of a mechanism as functions of numbers of its design. With one number it is the parameter response of Yin et al. 2021,
/// Figure 5, DOI 10.25165/j.ijabe.20211405.6844, for any number of any family.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Keys of the numbers in the design file.
    pub keys: Vec<String>,
    /// Values of the numbers of each variant, in the order of the keys and in the file's units; whole numbers for counts.
    pub variants: Vec<Vec<f64>>,
    /// Report of each variant, or the reason why it gives no mechanism.
    pub reports: Vec<Result<Report, String>>,
}

/// A figure of each variant of a [`Sweep`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// Name of the goal or figure.
    pub name: Cow<'static, str>,
    /// Unit of the figures.
    pub unit: Unit,
    /// The figure of each variant; `None` if there is none.
    #[serde(serialize_with = "figure::options")]
    pub figures: Vec<Option<f64>>,
}

impl Sweep {
    /// Checks variants of a design, on all cores: each has its own values at the keys, in the file's units; all other numbers
    /// stay. `report` checks one variant.
    ///
    /// # Errors
    /// [`DesignError`] if a key does not name a number of the design, or is given twice. A variant that gives no mechanism is not
    /// an error: it has the reason instead of a report.
    pub fn evaluate(
        design: &dyn Design,
        keys: &[&str],
        variants: &[Vec<f64>],
        report: impl Fn(&dyn Design) -> Result<Report, MechanismError> + Sync,
    ) -> Result<Self, DesignError> {
        let numbered = design.numbered(keys)?;
        let cancel = Cancel::current();
        let one = |values: &Vec<f64>| {
            let _scope = cancel.enter();
            let design = numbered.with(values).map_err(|error| error.message())?;
            report(design.as_ref()).map_err(|error| error.message())
        };
        let taken = |values: &Vec<f64>| {
            let values = values.iter().enumerate();
            values
                .map(|(at, &value)| numbered.taken(at, value))
                .collect()
        };
        Ok(Self {
            keys: keys.iter().map(|&key| key.to_owned()).collect(),
            variants: variants.iter().map(taken).collect(),
            reports: variants.par_iter().panic_fuse().map(one).collect(),
        })
    }

    /// Whether the design has goals.
    #[must_use]
    pub fn has_goals(&self) -> bool {
        let mut reports = self.reports.iter().flatten();
        reports.any(|report| !report.goals.is_empty())
    }

    /// The figures of the goals, then all other figures by name. A figure with the name of a goal is the goal's.
    #[must_use]
    pub fn answers(&self) -> Vec<Answer> {
        let mut answers = Answers::default();
        let reports = || self.reports.iter().enumerate();
        for (at, report) in reports() {
            for goal in report.iter().flat_map(|report| &report.goals) {
                *answers.figure(goal.name.clone(), goal.unit, at, self.reports.len()) = goal.value;
            }
        }
        for (at, report) in reports() {
            let Ok(report) = report else { continue };
            for (name, value) in &report.values {
                let unit = report.unit(name).unwrap_or(Unit::Number);
                let name = Cow::Borrowed(*name);
                let figure = answers.figure(name, unit, at, self.reports.len());
                figure.get_or_insert(*value);
            }
        }
        answers.found
    }
}

/// Answers in the order in which their names were first found.
#[derive(Default)]
struct Answers {
    found: Vec<Answer>,
    places: BTreeMap<Cow<'static, str>, usize>,
}

impl Answers {
    /// Place of a figure of one of `count` variants.
    fn figure(
        &mut self,
        name: Cow<'static, str>,
        unit: Unit,
        at: usize,
        count: usize,
    ) -> &mut Option<f64> {
        let place = self.places.get(&name).copied().unwrap_or_else(|| {
            self.places.insert(name.clone(), self.found.len());
            self.found.push(Answer {
                name,
                unit,
                figures: vec![None; count],
            });
            self.found.len() - 1
        });
        &mut self.found[place].figures[at]
    }
}
