//! Questions asked of a mechanism: contact, clearance, undercut, goals.

mod check;
mod contact;
mod remedy;
mod kinetostatics;
pub mod optimise;
mod report;
mod swing_spread;
mod shaft;

pub use check::{check, check_contact};
pub use contact::Contact;
pub use kinetostatics::{CrankMotion, ForceError, Forces, Kinetostatics, LinkMass, Load, Reaction};
pub use report::{Finding, Place, Report, Severity};
pub use swing_spread::{SixBarTolerances, SwingSpread};
pub use shaft::{check_moving_box, check_shaft};
