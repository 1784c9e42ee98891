//! What the page shows of a design: its numbers, picture, curves, figures and findings, as one JSON value.

mod edit;
mod field;
mod kind;
mod schema;
mod snapshot;
mod start;

pub(crate) use edit::{Edit, edited};
pub(crate) use snapshot::{Fault, Snapshot, Subject};
