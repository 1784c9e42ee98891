//! Non-circular gears, cams and linkages: geometry, proof and files for manufacture.
//!
//! This crate is the only dependency for the whole toolkit. It re-exports every other crate. The command line, with the
//! local server of the design page, is in `cli`, behind the feature of that name.
//! The crate knows no formula: the other crates do all computation.

pub use centrode_analysis as analysis;
pub use centrode_export as export;
pub use centrode_families as family;
pub use centrode_formats as formats;
pub use centrode_gear as gear;
pub use centrode_geometry as geometry;
pub use centrode_groove as groove;
pub use centrode_kinematics as kinematics;
pub use centrode_machines as machines;
pub use centrode_optimise as optimise;
pub use centrode_spec as spec;
pub use centrode_synthesis as synthesis;

#[cfg(feature = "cli")]
pub use centrode_page as page;

#[cfg(feature = "cli")]
pub mod cli;

pub use family::{FAMILIES, InternalFault};

use centrode_export::gear_pair::contact_data;
use centrode_kinematics::machine::Datum;

/// Figures of a report for drawing sheets: the pairs of teeth in contact, and the normal backlash, mm.
///
/// Empty if the report has no finite numbers for them: for gears out of mesh, and for machines without a gear pair of their own.
#[must_use]
pub fn sheet_data(report: &analysis::Report) -> Vec<Datum> {
    let range = |minimum: &str, maximum: &str| {
        let ends = [report.values.get(minimum)?, report.values.get(maximum)?];
        ends.iter().all(|x| x.is_finite()).then(|| ends.map(|x| *x))
    };
    let contact_ratio = range("pairs_in_contact_min", "pairs_in_contact_max");
    let backlash = range("normal_backlash_min", "normal_backlash_max");
    contact_ratio
        .zip(backlash)
        .map_or_else(Vec::new, |(ratio, backlash)| contact_data(ratio, backlash))
}

/// Its examples are tested.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
