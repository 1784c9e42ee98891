//! Planar linkages as compositions of Assur groups, in closed form with exact derivatives.
//!
//! A linkage with one input has a frame, a crank and dyads (groups of two links and three joints). The dyads are added
//! one after the other: each closes on the joints before it. Every dyad has two assembly branches. A sign in the closed
//! form selects the branch, so it cannot change along the cycle (Erdman and Sandor, *Mechanism Design*, 1984, chapter
//! 3). Velocity, acceleration and jerk come from Taylor series of the closed forms, not from differences.

mod assembly;
mod closing;
mod cycle;
mod driven;
mod dyad;
mod error;
mod four_bar;
mod laps;
mod parts;
mod pivots;
mod places;
mod point_series;
mod pose;
mod refilled;
mod series;
mod six_bar;
mod six_bar_motion;
mod slider_arc;
mod slider_crank;
#[cfg(test)]
mod tests;

pub use assembly::Linkage;
pub use closing::NotClosing;
pub use cycle::{Coordinate, LinkTransmission};
pub use dyad::Branch;
pub use error::LinkageError;
pub use four_bar::{DeadCenters, FourBar, FourBarError, Grashof};
pub use parts::{JointId, Line, LinkId, SliderDyad, TwoBars};
pub use pose::{BodyMotion, Pose};
pub use six_bar::{EffectorExtremes, SixBar, SixBarError, SwingSensitivity};
pub use six_bar_motion::SixBarPosition;
pub use slider_crank::SliderCrank;
