//! Questions asked of a mechanism: contact, clearance, undercut, goals.

mod check;
mod contact;
mod kinetostatics;
pub mod optimise;
mod remedy;
mod report;
mod shaft;
mod swing_spread;

pub use check::{check, check_contact};
pub use contact::Contact;
pub use kinetostatics::{CrankMotion, ForceError, Forces, Kinetostatics, LinkMass, Load, Reaction};
pub use report::{Finding, Place, Report, Severity};
pub use shaft::{check_moving_box, check_shaft};
pub use swing_spread::{SixBarTolerances, SwingSpread};
