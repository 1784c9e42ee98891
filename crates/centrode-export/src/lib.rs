//! One writer for each file format: DXF, SVG, STL, CSV, URDF, MJCF.
//!
//! Writers are pure: they turn a plain value into bytes. Only [`Bundle`] touches the disk.

mod bundle;
pub mod csv;
pub mod drawing;
pub mod dxf;
pub mod gear_pair;
pub mod mjcf;
pub mod model;
pub mod stl;
pub mod svg;
pub mod urdf;

pub use bundle::{Bundle, BundleError};
