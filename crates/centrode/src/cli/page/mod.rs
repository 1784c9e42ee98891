//! Snapshot of a design for the page: its numbers, picture, curves, figures and findings, as one JSON value.

mod composed;
mod edit;
mod family;
mod field;
mod follower;
mod kind;
mod plane;
mod schema;
mod snapshot;
mod start;

pub(crate) use edit::{Edit, edited};
pub(crate) use field::{Table, tables};
pub(crate) use snapshot::{Fault, Snapshot, Subject, drawn};
