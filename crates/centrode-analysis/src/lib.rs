//! Questions asked of a mechanism: contact, clearance, undercut, goals.

mod report;

pub use report::{Finding, Place, Report, Severity};
