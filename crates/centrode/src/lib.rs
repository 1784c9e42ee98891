//! Non-circular gears, cams and linkages: geometry, proof and shop files.
//!
//! One dependency for the whole toolkit: every crate under its own name.

pub use centrode_analysis as analysis;
pub use centrode_export as export;
pub use centrode_geometry as geometry;
pub use centrode_mechanism as mechanism;
