//! Certificate of a pair's contact at every real driver angle, for another program to check.
//!
//! The cycle is cut into stretches. On each of them the seat of the driven gear, pushed on and pushed back, is a Chebyshev series. So are
//! the parameters of every two features of the contours that meet or nearly do.
//!
//! Where two features meet, a parabola separates the two contours. A checker proves two things: each contour stays on its own side of the
//! parabola while the driven gear is half a width beyond the seat, and the contours cross when it is half a width before the seat. The
//! proof uses the contours and the law alone; the checker need not trust anything else in the certificate.
//!
//! Read it in this order:
//!
//! 1. `certificate`: the file.
//! 2. `prover`: cuts the cycle into stretches and fills the file.
//! 3. `features`, `feature_track`: features of the contours that meet, and their series along a stretch.
//! 4. `parabolas`: curves between two contours that meet.
//! 5. `seat_continuity`, `sectors`: checks of the whole cycle.

mod certificate;
mod feature_track;
mod features;
mod parabolas;
mod prover;
mod seat_continuity;
mod sectors;

pub use certificate::{Proof, ProofError, ProofMeeting, ProofStretch};
pub use prover::prove;
