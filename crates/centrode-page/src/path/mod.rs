//! The page that makes a machine from a path: its requests and answers.

mod answer;
mod cache;
mod drawing;
pub mod field;
mod made;
mod opened;
mod stages;
mod wish;

pub use answer::{Answer, GoalAnswer};
pub use cache::Cached;
pub use made::{PathMachine, machine};
pub use opened::{Opened, opened};
pub use wish::Wish;
