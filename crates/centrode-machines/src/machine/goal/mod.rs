//! Goals as written in the design file.

pub(super) mod clearance_end;
pub(super) mod figure;
pub(super) mod obstacle;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::goals::RequiredRange;
use centrode_spec::rule::{Rule, broken, finite, positive, single_line};
use centrode_spec::{SpecError, degrees};

/// A goal: a figure, where in the cycle it counts, and the range in which it is required, in the figure's unit: mm, deg, mm/s.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineGoalSpec {
    /// Figure by its words: `foot.x`, `crank.angle`, `transmission(knee)`; `centrode schema figures` lists them.
    pub figure: String,
    /// Goal in a few words, for reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Extreme over the cycle that counts; default: the figure counts at an input.
    pub over: Option<Over>,
    /// Input at which it counts, rad (degrees in the file).
    #[serde(default, rename = "at_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub at: Option<f64>,
    /// Inputs between which the extreme is searched, rad (degrees in the file); default: the cycle.
    #[serde(
        default,
        rename = "within_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub within: Vec<f64>,
    /// Figure required at the first and at the last of these inputs, between which it must change evenly: what a departure
    /// counts from.
    pub uniform: Option<[f64; 2]>,
    /// Minimum required figure.
    pub minimum: Option<f64>,
    /// Maximum required figure.
    pub maximum: Option<f64>,
    /// Minimum and maximum required figure.
    pub between: Option<[f64; 2]>,
    /// Miss that is halfway to the goal, for a search; default: the size of what is required.
    pub scale: Option<f64>,
}

/// Value of a figure over a cycle.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Over {
    /// The minimum.
    Minimum,
    /// The maximum.
    Maximum,
    /// The maximum less the minimum.
    Span,
    /// The maximum distance from an even course.
    Deviation,
}

impl MachineGoalSpec {
    /// Goal of a minimum clearance of two bodies, or of a body and an obstacle, mm.
    pub fn clearance([one, other]: [&str; 2], minimum: f64) -> Self {
        Self {
            figure: format!("clearance({one}, {other})"),
            title: format!("clearance of {one} from {other}"),
            over: Some(Over::Minimum),
            at: None,
            within: Vec::new(),
            uniform: None,
            minimum: Some(minimum),
            maximum: None,
            between: None,
            scale: None,
        }
    }

    /// Text of the figure and of the inputs at which it counts.
    #[must_use]
    pub fn words(&self) -> String {
        let figure = &self.figure;
        match (self.over, self.at) {
            (Some(Over::Minimum), _) => format!("minimum {figure}"),
            (Some(Over::Maximum), _) => format!("maximum {figure}"),
            (Some(Over::Span), _) => format!("span of {figure}"),
            (Some(Over::Deviation), _) => format!("deviation of {figure} from uniform motion"),
            (None, at) => format!("{figure} at {} deg", at.unwrap_or(0.0).to_degrees()),
        }
    }

    /// Text of the figure with everything that its value depends on: goals with equal texts are for one value.
    pub(in crate::machine) fn subject(&self) -> String {
        let within = match self.within[..] {
            [from, to] => {
                let [from, to] = [from, to].map(degrees::rounded);
                format!(" within {from} to {to} deg")
            }
            _ => String::new(),
        };
        let uniform = self
            .uniform
            .map(|[first, last]| format!(" from {first} to {last}"));
        self.words() + &within + &uniform.unwrap_or_default()
    }

    /// Required figures as the file gives them.
    #[must_use]
    pub fn range(&self) -> RequiredRange {
        RequiredRange {
            minimum: self.minimum,
            maximum: self.maximum,
            between: self.between,
        }
    }

    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        single_line("title", &self.title)?;
        match (self.over, self.at) {
            (Some(_), Some(_)) => return broken("at_deg", Rule::Excludes("over")),
            (None, None) => return broken("over", Rule::NeedsOneOf("over and at_deg")),
            _ => {}
        }
        finite("at_deg", self.at.unwrap_or(0.0))?;
        for &end in &self.within {
            finite("within_deg", end)?;
        }
        match self.within[..] {
            [] => {}
            _ if self.over.is_none() => return broken("within_deg", Rule::Unused("without over")),
            [from, to] if from < to => {}
            [from, to] => {
                let rule = Rule::NotInOrder(degrees::rounded(from), degrees::rounded(to));
                return broken("within_deg", rule);
            }
            _ => return broken("within_deg", Rule::Needed("with two inputs, from and to")),
        }
        self.validate_uniform()?;
        self.range().validate()?;
        match self.scale {
            Some(scale) => positive("scale", scale),
            None => Ok(()),
        }
    }

    fn validate_uniform(&self) -> Result<(), SpecError> {
        let departs = self.over == Some(Over::Deviation);
        match self.uniform {
            None if departs => broken("uniform", Rule::Needed("for a deviation")),
            Some(_) if !departs => broken("uniform", Rule::Unused("except for a deviation")),
            Some(_) if self.within.is_empty() => broken("within_deg", Rule::Needed("with uniform")),
            Some(ends) => ends.iter().try_for_each(|&end| finite("uniform", end)),
            None => Ok(()),
        }
    }
}
