//! Searches for the dimensions of a design: its variables, goals and methods, by family.

mod design;
mod design_search;
pub mod feeder;
mod guided;
mod reach;
mod relaxed_path;
pub mod three_arm;
mod vary;

pub use design::{DesignProblem, NotSearched, Variable};
pub use design_search::{DesignSearch, Strategy};
pub use guided::{GuidedSearch, GuidedStep};
pub use relaxed_path::{EasedPath, Easing, EasingError, EasingSpec, axis_at_border, reached};
pub use vary::{GoalsOf, NO_MACHINE, VaryProblem};
