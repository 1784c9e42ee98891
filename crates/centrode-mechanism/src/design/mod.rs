//! The design file: TOML in, a description of one family of mechanism out.

mod drawing;
mod family;
mod fault;
mod file;
mod keys;
mod number;
mod path;
mod reader;
mod schema;
mod text;

pub use crate::digits::shortened;
pub use drawing::{DrawingSpec, Projection, SheetSize};
pub use family::{Design, DesignFamily, DesignSpec};
pub use fault::{DesignError, DesignFault, MechanismError};
pub use file::DesignFile;
pub use number::NumberedDesign;
pub(crate) use number::numbers_of;
pub use schema::json_schema;
pub use text::{is_control, visible};

#[cfg(test)]
mod tests;
