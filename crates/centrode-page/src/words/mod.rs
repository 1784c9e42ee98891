//! Texts of a report, for the page and the terminal.

mod figures;
mod findings;
mod goals;

pub use figures::{Cell, Line, Section, sections};
pub use findings::{FindingWords, finding_words, summary};
pub use goals::{GoalWords, goal_words};
