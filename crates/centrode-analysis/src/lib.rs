//! Questions asked of a mechanism: contact, clearance, undercut, goals.

mod contact;
mod report;

pub use contact::Contact;
pub use report::{Finding, Place, Report, Severity};
