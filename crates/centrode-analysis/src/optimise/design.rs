use centrode_mechanism::design::Design;
use centrode_mechanism::three_arm::SweepError;

use super::Problem;
use super::three_arm::ThreeArmProblem;
use crate::Goal;

/// A number of a design that a search moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name, `r1`.
    pub name: String,
    /// Its key in the design file, `pitch.radius[0]`.
    pub key: String,
    /// Least and greatest value, rad or mm.
    pub bounds: [f64; 2],
    /// True for an angle, in rad, and in degrees in the file.
    pub is_angle: bool,
}

/// Finest step of a variable: a thousandth of a degree, or of a millimetre. A file then holds what was evaluated, and
/// a machinist can read it.
const STEP: f64 = 1e-3;

impl Variable {
    /// The value in the file's unit, on the grid of the finest step.
    #[must_use]
    pub fn written(&self, value: f64) -> f64 {
        let value = if self.is_angle {
            value.to_degrees()
        } else {
            value
        };
        // Divided, not multiplied: the nearest number to three decimals.
        (value / STEP).round() / STEP.recip()
    }

    /// The value on the grid of the finest step, rad or mm.
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

/// A problem whose points are designs: what an optimiser of design files needs to know, of whatever family.
pub trait DesignProblem: Problem {
    /// What is moved; the points of the problem hold their values, rad or mm.
    fn variables(&self) -> &[Variable];

    /// The design at a point, values rounded to what a file holds.
    fn design(&self, point: &[f64]) -> Design;

    /// Numbers of the design at a point that follow from its variables: key in the file, and value as written.
    fn followers(&self, point: &[f64]) -> Vec<(String, f64)>;

    /// The goals at a point, and whatever else must be kept, each with figure, range and margin; none where the point
    /// gives no mechanism.
    fn goals(&self, point: &[f64]) -> Option<Vec<Goal>>;

    /// The goals at a point as a guide needs them: smooth figures, which may be nearer or farther than those of
    /// [`DesignProblem::goals`] but are met only where those are.
    fn guides(&self, point: &[f64]) -> Option<Vec<Goal>>;
}

/// Why there is no search for a better design.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotSearched {
    /// A family without goals.
    #[error("there is no search for designs of this family: it has no goals")]
    Family,
    /// A three-arm mechanism of another kind.
    #[error("no search: {0}")]
    ThreeArm(#[from] SweepError),
}

/// The search problem around a design, of whatever family.
///
/// # Errors
/// [`NotSearched`] for a design that no search knows.
pub fn problem_of(design: &Design) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
    match design {
        Design::ThreeArm(design) => Ok(Box::new(ThreeArmProblem::new(design)?)),
        _ => Err(NotSearched::Family),
    }
}
