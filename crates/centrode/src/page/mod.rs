//! What the page shows of a design: its numbers, picture, curves, figures and findings, as one JSON value.

mod edit;
mod field;
mod gear_pair;
mod schema;
mod snapshot;

pub(crate) use edit::{Edit, edited};
pub(crate) use snapshot::{Snapshot, Subject};
