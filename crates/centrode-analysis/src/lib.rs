//! Questions asked of a mechanism: contact, clearance, undercut, goals.

mod check;
mod contact;
mod remedy;
pub mod optimise;
mod report;

pub use check::{check, check_contact};
pub use contact::Contact;
pub use report::{Finding, Place, Report, Severity};
