//! The contact along a whole cycle: figures at samples, and their extremes between the samples.
//!
//! Reading order:
//!
//! 1. `contact`: the figures of all samples, and the number of samples.
//! 2. `cycle_samples`, `sample`: the driver angles, and the figures at one of them.
//! 3. `extremes`: the minimum and maximum of each figure, searched between the samples; `clearances` for clearances.
//! 4. `backlash_position`, `pose_sampling`: poses of the driven gear by the law, without a search for the seat.
//! 5. `edge_contacts`: driver angles at which a contact reaches the end of a flank. `contact_count` and `sliding` use
//!    them.
//! 6. `edge_to_fillet`: the distance of tooth edges from fillets.
//! 7. `seat_jumps`: driver angles at which the driven angle jumps within the backlash.

mod backlash_position;
mod clearances;
mod contact;
mod contact_count;
mod cycle_samples;
mod edge_contacts;
mod edge_to_fillet;
mod extremes;
mod pose_sampling;
mod sample;
mod seat_jumps;
mod sliding;

pub use contact::Contact;
pub(crate) use contact::oscillates_per_tooth;
#[cfg(test)]
pub(super) use cycle_samples::at_angle;
pub use extremes::ContactExtremes;
pub use seat_jumps::SeatJump;
