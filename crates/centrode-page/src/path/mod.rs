//! The page on which a machine is made from a path: its questions and answers.

mod answer;
mod drawing;
pub mod field;
mod made;
mod opened;
mod sought;
mod stages;
mod wish;

pub use answer::{Answer, GoalAnswer};
pub use made::{Machine, machine};
pub use opened::{Opened, opened};
pub use sought::Kept;
pub use wish::Wish;
