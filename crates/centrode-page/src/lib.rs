//! The design page without a server: its scripts and styles, and the answers to their requests.
//!
//! A question and its answer are text: a design file goes in, JSON, a changed design file or HTML comes out ([`Subject`],
//! [`edited`], [`report`]). The words of the page for each family are here. Whoever serves the page brings HTTP, files, threads.
//! It may not know: sockets and requests, the command line, folders, Python. It computes nothing of its own but the picture
//! of a path, before there is a machine.

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

pub use design::{Edit, EditError, Fault, Goals, LeftOut, Made, Snapshot, Subject, drawn, edited};
pub use html::{Asset, INDEX, PATH, Packed, START, asset, packed, report};
pub use meshes::meshes;
