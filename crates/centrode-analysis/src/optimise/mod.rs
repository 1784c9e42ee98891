//! Search for the best dimensions: one small interface, three methods.
//!
//! A [`Problem`] gives bounds and evaluates a point; a [`Search`] improves a population generation by
//! generation. Randomness comes from the seed and the number of the generation alone, and the points of
//! a generation are drawn before any of them is evaluated: the same seed gives the same answer on any
//! number of cores, and a stored search continues as if it had never stopped.

mod cma_es;
pub mod composed;
mod design;
mod design_search;
mod differential_evolution;
mod eased;
pub mod feeder;
mod genetic;
mod guided;
mod problem;
mod random;
mod search;
pub mod six_bar;
#[cfg(test)]
mod tests;
pub mod three_arm;

pub use design::{DesignProblem, NotSearched, Variable};
pub use design_search::{DesignSearch, Strategy};
pub use eased::{EasedPath, Easing, EasingError, EasingSpec, axis_at_border, reached};
pub use guided::{GuidedSearch, GuidedStep};
pub use problem::{Candidate, Evaluation, Problem};
pub(crate) use random::Random;
pub use search::{Ended, Method, Progress, Search, SearchError, Settings, minimise};
