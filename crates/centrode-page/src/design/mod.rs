//! Snapshot of a design for the page: its numbers, picture, curves, figures and findings, as one JSON value.

mod detail;
mod edit;
mod family;
mod field;
mod follower;
mod kind;
mod machine;
mod plane;
mod schema;
mod snapshot;
mod start;

pub use detail::{LeftOut, Made};
pub use edit::{Edit, EditError, edited, with_table};
pub use machine::compose::{Composed, EMPTY_MACHINE, Gesture, Other, Pin, Refusal, composed};
pub use snapshot::{Fault, Goals, Snapshot, Subject, drawn};
