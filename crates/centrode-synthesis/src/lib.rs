//! From requirements to machines: paths and poses, gears for a required output, and searches for dimensions.
//!
//! The crate may use all crates below it. It evaluates its results only by the checks of the analysis. It draws nothing
//! and writes no file.

pub mod machine;
pub mod optimise;
pub mod reverse;
