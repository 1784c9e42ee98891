//! Searches for the dimensions of a design: its variables, goals and methods, by family.

mod design;
mod design_search;
pub mod feeder;
mod guided;
pub mod machine;
mod relaxed_path;
pub mod three_arm;

pub use design::{DesignProblem, NotSearched, Variable};
pub use design_search::{DesignSearch, Strategy};
pub use guided::{GuidedSearch, GuidedStep};
pub use relaxed_path::{EasedPath, Easing, EasingError, EasingSpec, axis_at_border, reached};
