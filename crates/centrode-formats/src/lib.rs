//! One writer for each file format: DXF, SVG, PDF, STL, STEP, 3MF, CSV, URDF, MJCF; and the layout of drawing sheets.
//!
//! Writers are pure: they convert a plain value ([`drawing::Drawing`], [`sheet::Sheet`], a solid, [`model::Model`]) to
//! bytes, and equal values give equal bytes. Only [`Bundle`], [`write_file`] and [`write_new_file`] write to the disk.
//! It may not know: mechanisms, gears, machines, families. Of the design file it knows only the table `[drawing]`
//! ([`DrawingSpec`](centrode_spec::DrawingSpec), sheet size and projection), which a title block prints.

mod bundle;
pub mod csv;
pub mod drawing;
pub mod dxf;
mod format;
pub mod hash;
pub mod mjcf;
pub mod model;
pub mod pdf;
pub mod sheet;
mod stage;
pub mod step;
pub mod stl;
pub mod svg;
pub mod threemf;
pub mod urdf;
mod xml;

pub use bundle::{Bundle, BundleError, write_file, write_new_file};
pub use format::{Format, Purpose, UnknownFormat};
