//! Certificate of a pair's contact at every real driver angle, for another program to check.
//!
//! The cycle is divided into stretches. The certificate describes each stretch by Chebyshev series. Two series are the
//! seats of the driven gear: pushed forward and pushed back. The others are the parameters of every two features of the
//! contours that meet or nearly meet.
//!
//! Where two features meet, a parabola separates the two contours. A checker proves two statements:
//!
//! 1. Each contour stays on its own side of the parabola while the driven gear is half a width beyond the seat.
//! 2. The contours cross when the driven gear is half a width before the seat.
//!
//! The proof uses only the contours and the law. The checker need not rely on anything else in the certificate.
//!
//! Reading order:
//!
//! 1. `certificate`: the file.
//! 2. `prover`: divides the cycle into stretches and fills the file.
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
