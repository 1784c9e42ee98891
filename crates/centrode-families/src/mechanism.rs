use super::Limit;
use super::figure_goals::figures;
use centrode_analysis::{Report, Table};
use centrode_export::picture::{Curve, Picture};
use centrode_export::{ExportError, Options};
use centrode_formats::{Bundle, Format};
use centrode_gear::{GearPair, GearPairError};
use centrode_kinematics::machine::LinkedMachine;
use centrode_spec::Design;
use centrode_synthesis::reverse::{GearDrive, GearDriveError, GearDriveSpec};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// Finest useful tolerance, mm, for curves that do not have a step of their own.
pub const FINEST: f64 = 1e-9;

/// A resolved mechanism of any family.
pub trait Mechanism: Any + Debug + Send + Sync {
    /// Design of the mechanism.
    fn design(&self) -> &dyn Design;

    /// Definition of the machine in one line.
    fn definition(&self) -> String;

    /// Checks everything.
    fn check(&self) -> Report;

    /// Checks the motion alone: goals, figures and findings without any tooth or cam, about ten times faster.
    fn check_motion(&self) -> Report {
        self.check_made()
    }

    /// Checks the motion and the parts as they are made, without contact; by default everything.
    fn check_made(&self) -> Report {
        self.check()
    }

    /// Checks the goals alone: those of [`Mechanism::check_motion`]. The report may hold more.
    fn check_goals(&self) -> Report {
        self.check_motion()
    }

    /// Whether the mechanism has goals that [`Mechanism::check_goals`] checks much sooner than [`Mechanism::check`].
    fn goals_come_first(&self) -> bool {
        false
    }

    /// Report of [`Mechanism::check`] with the curves along the cycle that this check computes.
    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        (self.check(), Vec::new())
    }

    /// Figures that the goals of a design can name: those of the check with their values, those along the cycle with their
    /// extremes.
    fn figures(&self) -> Vec<Table> {
        figures(&self.check())
    }

    /// Changed designs that fix the findings of the check, each with a description of its effect; empty if none is known.
    fn remedies(&self) -> Vec<(String, Box<dyn Design>)> {
        Vec::new()
    }

    /// Reason why no change of the teeth fixes the findings; `None` if no reason is known.
    fn no_remedy(&self) -> Option<String> {
        None
    }

    /// The mechanism cut with another kerf, mm, for a check of what remains; `None` if the family's check knows no kerf.
    fn with_kerf(&self, _kerf: f64) -> Option<Arc<dyn Mechanism>> {
        None
    }

    /// Pairs of gears that mesh all along the cycle, each once with its name; empty in a family without such pairs.
    ///
    /// # Errors
    /// [`GearPairError`] if the teeth cannot be cut.
    fn pairs(&self) -> Result<Vec<(String, Arc<GearPair>)>, GearPairError> {
        Ok(Vec::new())
    }

    /// Machine whose crank is driven by gears so that its output meets its goals; `None` in a family without such a drive.
    fn gear_drive(&self, _spec: &GearDriveSpec) -> Option<Result<GearDrive, GearDriveError>> {
        None
    }

    /// Values that the report requires of figures that are drawn along the cycle.
    fn limits(&self, _report: &Report) -> Vec<Limit> {
        Vec::new()
    }

    /// Speed of the input, rad/s; `None` if designs of the family give no speed.
    fn input_speed(&self) -> Option<f64> {
        None
    }

    /// Curves that are available at once.
    fn curves(&self) -> Vec<Curve>;

    /// Picture that is available at once, with the handles of the design's numbers.
    fn picture(&self) -> Picture;

    /// Whether [`Mechanism::picture`] lacks details that take longer to make.
    fn is_coarse(&self) -> bool {
        false
    }

    /// Picture with details that take longer to make; `None` if nothing is omitted at first, or nothing can be made.
    fn detailed(&self) -> Option<Picture> {
        None
    }

    /// Model of the machine as links and joints.
    ///
    /// # Errors
    /// [`ExportError`] if a part cannot be made.
    fn machine(&self) -> Result<LinkedMachine, ExportError>;

    /// Finest useful tolerance of the files, mm.
    fn accuracy(&self) -> f64 {
        FINEST
    }

    /// The files in the requested formats, not yet on disk.
    ///
    /// # Errors
    /// [`ExportError`], for instance if the tolerance is too coarse.
    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError>;
}

/// Depth of a check. A deeper report has all figures of a shallower one, with the same values, and more.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Depth {
    /// Depth of [`Mechanism::check_motion`]: all goals. Parts need not be made.
    #[default]
    Motion,
    /// Depth of [`Mechanism::check_made`]: parts and teeth as they are made.
    Made,
    /// Depth of [`Mechanism::check`].
    Whole,
}

centrode_spec::words!(Depth {
    Motion = "motion",
    Made = "made",
    Whole = "whole",
});

impl dyn Mechanism {
    /// Checks to a depth.
    #[must_use]
    pub fn report(&self, depth: Depth) -> Report {
        match depth {
            Depth::Motion => self.check_motion(),
            Depth::Made => self.check_made(),
            Depth::Whole => self.check(),
        }
    }

    /// Casts to the mechanism of a family; `None` for another family.
    #[must_use]
    pub fn downcast<M: Mechanism>(self: Arc<Self>) -> Option<Arc<M>> {
        let any: Arc<dyn Any + Send + Sync> = self;
        any.downcast().ok()
    }
}
