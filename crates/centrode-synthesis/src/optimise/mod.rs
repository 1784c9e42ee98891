//! Searches for the dimensions of a design: its variables, goals and methods, by family.

pub mod composed;
mod design;
mod design_search;
mod eased;
pub mod feeder;
mod guided;
pub mod three_arm;

pub use design::{DesignProblem, NotSearched, Variable};
pub use design_search::{DesignSearch, Strategy};
pub use eased::{EasedPath, Easing, EasingError, EasingSpec, axis_at_border, reached};
pub use guided::{GuidedSearch, GuidedStep};
