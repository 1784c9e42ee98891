//! One writer for each file format: DXF, SVG, PDF, STL, STEP, 3MF, CSV, URDF, MJCF.
//!
//! Writers are pure: they turn a plain value into bytes. Only [`Bundle`], [`write_file`] and [`write_new_file`] touch the disk.

mod bundle;
pub mod cam;
pub mod composed;
pub mod csv;
pub mod drawing;
pub mod dxf;
mod error;
pub mod feeder;
mod format;
pub mod gear_pair;
mod hash;
pub mod machine;
pub mod mjcf;
pub mod model;
mod options;
mod package;
pub mod page;
pub mod pdf;
mod plate;
pub mod shaft;
pub mod sheet;
mod stage;
pub mod step;
pub mod stl;
pub mod svg;
pub mod three_arm;
pub mod threemf;
mod turned;
pub mod urdf;
mod xml;

pub use bundle::{Bundle, BundleError, write_file, write_new_file};
pub use error::ExportError;
pub use format::{Format, UnknownFormat};
pub use options::{Options, SheetOptions};
pub use package::Package;
