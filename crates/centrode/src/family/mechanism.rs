use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

use centrode_analysis::Report;
use centrode_export::page::{Curve, Picture};
use centrode_export::{Bundle, ExportError, Format, Options};
use centrode_mechanism::design::Design;
use centrode_mechanism::machine::Machine;

/// Finest tolerance that has a meaning for curves without a step of their own, mm.
pub const FINEST: f64 = 1e-9;

/// A resolved mechanism of whatever family.
pub trait Mechanism: Any + Debug + Send + Sync {
    /// The design it was made from.
    fn design(&self) -> &dyn Design;

    /// The machine in one line.
    fn definition(&self) -> String;

    /// Checks all there is to check.
    fn check(&self) -> Report;

    /// Goals, figures and findings of the motion, without what every tooth and cam is asked for: some ten times sooner.
    fn check_motion(&self) -> Report {
        self.check()
    }

    /// The report of [`Mechanism::check`] with the curves along the cycle that it leaves.
    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        (self.check(), Vec::new())
    }

    /// The curves that are there at once.
    fn curves(&self) -> Vec<Curve>;

    /// The picture that is there at once, with the points that can be drawn aside.
    fn picture(&self) -> Picture;

    /// Whether that lacks what takes longer to make.
    fn is_coarse(&self) -> bool {
        false
    }

    /// The picture with what takes longer to make; none where nothing is left out at first, or nothing can be made.
    fn detailed(&self) -> Option<Picture> {
        None
    }

    /// The machine as links and joints.
    ///
    /// # Errors
    /// [`ExportError`] where a part cannot be made.
    fn machine(&self) -> Result<Machine, ExportError>;

    /// Finest tolerance of its files that has a meaning, mm.
    fn accuracy(&self) -> f64 {
        FINEST
    }

    /// The files in the formats asked for, not yet on disk.
    ///
    /// # Errors
    /// [`ExportError`], for instance where the tolerance is too coarse.
    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError>;
}

/// How much is asked of a mechanism.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Depth {
    /// The answer of [`Mechanism::check_motion`]: all goals.
    #[default]
    Motion,
    /// The answer of [`Mechanism::check`].
    Whole,
}

impl dyn Mechanism {
    /// Checks as much as is asked.
    #[must_use]
    pub fn report(&self, depth: Depth) -> Report {
        match depth {
            Depth::Motion => self.check_motion(),
            Depth::Whole => self.check(),
        }
    }

    /// The mechanism of a family, where it is of that.
    #[must_use]
    pub fn downcast<M: Mechanism>(self: Arc<Self>) -> Option<Arc<M>> {
        let any: Arc<dyn Any + Send + Sync> = self;
        any.downcast().ok()
    }
}
