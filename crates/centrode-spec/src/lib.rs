//! The design file: converts TOML to the description of a mechanism of one family.
//!
//! The crate has keys and their paths, rules for the values of numbers, errors with line and remedy, drawings, and the
//! schema. It knows no gear and no machine: a family adds its keys by [`DesignSpec`].

mod csv;
mod cut;
pub mod degrees;
pub mod digits;
mod drawing;
mod family;
mod fault;
mod file;
mod given;
pub mod goals;
mod keys;
mod number;
mod path;
mod reader;
pub mod rule;
mod sample_file;
mod schema;
mod text;
mod word;

pub use csv::{CsvLine, NotNumber, csv_lines};
pub use cut::CutSpec;
pub use digits::shortened;
pub use drawing::{DrawingSpec, Projection, SheetSize};
pub use family::{Design, DesignFamily, DesignSpec};
pub use fault::{DesignError, DesignFault, MechanismError};
pub use file::DesignFile;
pub use given::Given;
pub use goals::{FigureGoalSpec, Named};
pub use number::{NumberedDesign, numbers_of};
pub use rule::{Rule, SpecError};
pub use sample_file::{Column, OpenFile, SampleTable};
pub use schema::json_schema;
pub use text::{is_control, visible};
