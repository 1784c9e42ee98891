//! What the page shows of a design: its numbers, picture, curves, figures and findings, as one JSON value.

mod edit;
mod family;
mod feeder;
mod field;
mod gear_pair;
mod handles;
mod kind;
mod schema;
mod shaft;
mod snapshot;
mod start;
mod three_arm;

pub(crate) use edit::{Edit, edited};
pub(crate) use snapshot::{Fault, Snapshot, Subject};
