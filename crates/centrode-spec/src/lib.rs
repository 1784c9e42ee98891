//! The design file: TOML in, a description of one family of mechanism out.
//!
//! Keys and their paths, rules that a number can break, faults with line and remedy, drawings, schema. It knows no gear and
//! no machine: a family adds its keys by [`DesignSpec`].

pub mod degrees;
pub mod digits;
mod drawing;
mod family;
mod fault;
mod file;
mod keys;
mod number;
mod path;
mod reader;
pub mod rule;
mod schema;
mod text;
mod word;

pub use digits::shortened;
pub use drawing::{DrawingSpec, Projection, SheetSize};
pub use family::{Design, DesignFamily, DesignSpec};
pub use fault::{DesignError, DesignFault, MechanismError};
pub use file::DesignFile;
pub use number::{NumberedDesign, numbers_of};
pub use rule::{Rule, SpecError};
pub use schema::json_schema;
pub use text::{is_control, visible};
