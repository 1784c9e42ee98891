//! Files, pictures and curves of each family of machine and of machines in general.
//!
//! This crate makes the drawings, sheets, solids, tables and models of each machine. It draws plates, turned parts and
//! general arrangements. `centrode-formats` writes them in the file formats.
//! It may not know: checks and searches (`centrode-analysis`), the list of families, the command line, the page's
//! server.
//! Nothing here writes to the disk. A [`Package`] collects files in a bundle.

pub mod cam;
mod cutting;
mod error;
pub mod feeder;
mod fit;
pub mod gear_pair;
mod grade;
pub mod linked;
pub mod machine;
mod number;
mod options;
mod package;
pub mod picture;
mod plate;
pub mod shaft;
pub mod three_arm;
mod treatment;
mod turned;

pub use error::ExportError;
pub use options::{Layers, Options, SheetOptions};
pub use package::Package;
