//! The design page without a server: its scripts and styles, and the answers to their requests.
//!
//! Requests and answers are text. The input is a design file. The output is JSON, a changed design file or HTML
//! ([`Subject`], [`edited`], [`report`]). The texts of the page for each family are here. The server of the page
//! provides HTTP, files and threads.
//! It may not know: sockets and requests, the command line, folders, Python. The only thing that it computes itself is
//! the picture of a path for which there is no machine yet.

mod bundle;
mod design;
mod html;
mod meshes;
pub mod path;
mod policy;
pub mod response;
pub mod reverse;
pub mod search;
pub mod words;

pub use design::{
    Composed, EMPTY_MACHINE, Edit, EditError, Fault, Gesture, Goals, LeftOut, Made, Other, Pin,
    Refusal, Snapshot, Subject, composed, drawn, edited, with_table,
};
pub use html::{Asset, INDEX, PATH, Packed, START, asset, packed, report};
pub use meshes::meshes;
