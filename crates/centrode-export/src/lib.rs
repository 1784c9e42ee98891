//! Files, pictures and curves of each family of machine and of machines in general.
//!
//! Here is decided which drawings, sheets, solids, tables and models a machine has, and how a plate, a turned part and a
//! general arrangement are drawn. The bytes are written by `centrode-formats`.
//! It may not know: checks and searches (`centrode-analysis`), the list of families, the command line, the page's server.
//! Nothing here touches the disk; a [`Package`] collects files in a bundle.

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
