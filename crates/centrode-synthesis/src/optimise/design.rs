use std::sync::Arc;

use centrode_spec::Design;

use centrode_analysis::Goal;
use centrode_optimise::Problem;

/// Number of a design that a search changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name, `r1`.
    pub name: String,
    /// Key in the design file, `pitch.radius[0]`.
    pub key: String,
    /// Minimum and maximum value, rad or mm.
    pub bounds: [f64; 2],
    /// Whether it is an angle, in rad, and in degrees in the file.
    pub is_angle: bool,
    /// Decimals of its values in the file, degrees or mm: the file then holds the evaluated values exactly.
    pub decimals: u32,
}

impl Variable {
    /// Converts a value to the file's unit and rounds it to its decimals.
    #[must_use]
    pub fn written(&self, value: f64) -> f64 {
        let value = if self.is_angle {
            value.to_degrees()
        } else {
            value
        };
        let grid = 10_f64.powi(self.decimals as i32);
        // Division by the integer gives the nearest number to those decimals.
        (value * grid).round() / grid
    }

    /// Value as read back from the file, rad or mm.
    #[must_use]
    pub fn rounded(&self, value: f64) -> f64 {
        let written = self.written(value);
        if self.is_angle {
            written.to_radians()
        } else {
            written
        }
    }
}

/// Problem whose points are designs: the interface of an optimiser of design files, of whatever family.
pub trait DesignProblem: Problem {
    /// Variables; the points of the problem hold their values, rad or mm.
    fn variables(&self) -> &[Variable];

    /// Design at a point, values rounded to those a file holds.
    fn design(&self, point: &[f64]) -> Arc<dyn Design>;

    /// Numbers of the design at a point that follow from its variables: key in the file, and value as written.
    fn followers(&self, point: &[f64]) -> Vec<(String, f64)>;

    /// Goals at a point, and all other constraints, each with figure, range and margin; `None` if the point gives no
    /// mechanism.
    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>>;

    /// Goals at a point for a guided search: smooth figures. They may be missed by more or less than those of
    /// [`DesignProblem::goals`], but are met only if those are met.
    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>>;

    /// Objective at which a point that breaks no constraint is good enough; `None` if less is always better.
    fn target(&self) -> Option<f64> {
        None
    }

    /// Remark of the problem on a point at which a search has ended: why there is no better one, or why the result means little.
    fn remark(&self, _point: &[f64]) -> Option<String> {
        None
    }
}

/// Reason why there is no search for a better design.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotSearched {
    /// A family without goals.
    #[error("there is no search for designs of this family: it has no goals")]
    Family,
    /// A design that the search of its family does not accept.
    #[error("no search: {0}")]
    Design(String),
}
