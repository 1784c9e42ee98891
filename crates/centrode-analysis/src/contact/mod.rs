//! Contact analysis of a finished pair: the driven angle, the backlash, and all clearances.
//!
//! The analysis uses only the two outlines and the centre distance, not the generation of the teeth. Reading order:
//!
//! 1. `contour`: the outline of a gear as pieces with bounds of position, tangent and curvature.
//! 2. `seat`: one driver angle. It finds the points at which the outlines face each other. It finds the driven angle at
//!    which the driven gear rests against the driver on either side of its teeth.
//! 3. `cycle`: one whole cycle. The figures at samples, then their extremes between the samples.
//! 4. `proof`: a certificate of the contact at every driver angle, for another program to check.
//!
//! `seat` uses only `contour`. `cycle` and `proof` use both, but not each other.

mod contour;
mod cycle;
mod proof;
mod seat;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use cycle::oscillates_per_tooth;
pub use cycle::{Contact, ContactExtremes, SeatJump};
pub use proof::{Proof, ProofError, ProofMeeting, ProofStretch, prove};
pub(crate) use seat::Meshing;

/// Samples per pitch if no flank is undercut or short. Fewer miss extremes between the samples, more take longer.
const SAMPLES_PER_PITCH: u32 = 4;
