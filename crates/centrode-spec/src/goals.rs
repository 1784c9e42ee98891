//! Goals for figures of the check, and the numbers that a search may vary.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::rule::{Rule, broken, finite, part_name, positive, single_line};
use crate::{Design, DesignFault, MechanismError, SpecError};

/// Entries of a table by name, in the order of the file.
pub type Named<T> = IndexMap<String, T>;

/// Goal: a figure of the check and the range in which it is required, in the unit that the check shows: mm, deg, N.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FigureGoalSpec {
    /// Figure by its key in the check: `ratio_max`, `contact_ratio_mean`; `centrode check --figures` lists the keys.
    pub figure: String,
    /// Goal in a few words, for reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Minimum required figure.
    pub minimum: Option<f64>,
    /// Maximum required figure.
    pub maximum: Option<f64>,
    /// Minimum and maximum required figure.
    pub between: Option<[f64; 2]>,
    /// Miss that is halfway to the goal, for a search; default: the size of the required figures.
    pub scale: Option<f64>,
}

impl FigureGoalSpec {
    /// Required figures as the file gives them.
    #[must_use]
    pub fn range(&self) -> RequiredRange {
        RequiredRange {
            minimum: self.minimum,
            maximum: self.maximum,
            between: self.between,
        }
    }

    fn validate(&self) -> Result<(), SpecError> {
        single_line("title", &self.title)?;
        self.range().validate()?;
        self.scale.map_or(Ok(()), |scale| positive("scale", scale))
    }
}

/// Required figures of a goal: a minimum, a maximum, or both by `between`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RequiredRange {
    /// Minimum, in the unit of the file.
    pub minimum: Option<f64>,
    /// Maximum, in the unit of the file.
    pub maximum: Option<f64>,
    /// Minimum and maximum, in the unit of the file.
    pub between: Option<[f64; 2]>,
}

impl RequiredRange {
    /// Minimum and maximum; `None` for an end without a limit.
    #[must_use]
    pub fn ends(self) -> [Option<f64>; 2] {
        match self.between {
            Some(ends) => ends.map(Some),
            None => [self.minimum, self.maximum],
        }
    }

    /// Checks that there is a limit, and that the limits are finite and in order.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(self) -> Result<(), SpecError> {
        for (key, value) in [("minimum", self.minimum), ("maximum", self.maximum)] {
            if value.is_some() && self.between.is_some() {
                return broken(key, Rule::Excludes("between"));
            }
            finite(key, value.unwrap_or(0.0))?;
        }
        for end in self.between.iter().flatten() {
            finite("between", *end)?;
        }
        match self.ends() {
            [None, None] => broken("minimum", Rule::NeedsOneOf("minimum, maximum and between")),
            [Some(minimum), Some(maximum)] if minimum > maximum => {
                let key = self.between.map_or("maximum", |_| "between");
                broken(key, Rule::NotInOrder(minimum, maximum))
            }
            _ => Ok(()),
        }
    }
}

/// Checks the tables `goals` and `vary` of a design.
///
/// # Errors
/// [`SpecError`] with the key at fault.
pub fn check_search(
    goals: &Named<FigureGoalSpec>,
    vary: &Named<[f64; 2]>,
) -> Result<(), SpecError> {
    check_goals("goals", goals)?;
    check_bounds(vary)
}

/// Checks the goals in a table of a design, and that no two of them contradict each other.
///
/// # Errors
/// [`SpecError`] with the key at fault.
pub fn check_goals(table: &str, goals: &Named<FigureGoalSpec>) -> Result<(), SpecError> {
    for (name, goal) in goals {
        let key = format!("{table}.{name}");
        part_name(&key, name)?;
        goal.validate().map_err(|e| e.inside(&key))?;
    }
    let ranges = goals
        .iter()
        .map(|(name, goal)| (name.as_str(), goal.figure.clone(), goal.range()));
    check_contradictions(table, ranges)
}

/// Checks that the ranges of no two goals of one figure exclude each other; the goals have a name, a figure in words and a range.
///
/// # Errors
/// [`SpecError`] with the key of the second goal.
pub fn check_contradictions<'a>(
    table: &str,
    goals: impl IntoIterator<Item = (&'a str, String, RequiredRange)>,
) -> Result<(), SpecError> {
    let mut first: BTreeMap<String, [Option<(f64, &str)>; 2]> = BTreeMap::new();
    for (name, figure, range) in goals {
        let [minimum, maximum] = range.ends();
        let ends = first.entry(figure.clone()).or_default();
        if let Some(own) = minimum
            && ends[0].is_none_or(|(earlier, _)| own > earlier)
        {
            ends[0] = Some((own, name));
        }
        if let Some(own) = maximum
            && ends[1].is_none_or(|(earlier, _)| own < earlier)
        {
            ends[1] = Some((own, name));
        }
        if let [Some((minimum, one)), Some((maximum, other))] = *ends
            && minimum > maximum
        {
            let other = if one == name { other } else { one };
            let rule = Rule::Contradicts {
                other: format!("{table}.{other}"),
                figure,
                minimum,
                maximum,
            };
            return broken(&format!("{table}.{name}"), rule);
        }
    }
    Ok(())
}

/// Checks that the numbers that a search may vary have bounds in order.
///
/// # Errors
/// [`SpecError`] with the key at fault.
pub fn check_bounds(vary: &Named<[f64; 2]>) -> Result<(), SpecError> {
    for (name, [low, high]) in vary {
        let key = format!("vary.{name}");
        finite(&key, *low)?;
        finite(&key, *high)?;
        if low >= high {
            return broken(&key, Rule::NotInOrder(*low, *high));
        }
    }
    Ok(())
}

/// Tables whose numbers are requirements, not properties of the machine.
const REQUIRED: [&str; 3] = ["goals", "figure_goals", "vary"];

/// Checks that every key of `vary` names a number of the machine. A key in `fixed` has no meaning there.
///
/// # Errors
/// [`MechanismError`] with the key at fault.
pub fn check_varied(
    design: &dyn Design,
    vary: &Named<[f64; 2]>,
    fixed: &[&str],
) -> Result<(), MechanismError> {
    for key in vary.keys() {
        let refused = |why: String| MechanismError {
            key: format!("vary.{key}"),
            fault: DesignFault::WrongType(why),
        };
        let table = key.split('.').next().unwrap_or_default();
        if REQUIRED.contains(&table) || fixed.contains(&key.as_str()) {
            let why = "is a requirement: a search varies only numbers of the machine";
            return Err(refused(why.into()));
        }
        let numbered = design.numbered(&[key]);
        numbered.map_err(|error| refused(error.message()))?;
    }
    Ok(())
}
