//! From requirements to machines: paths and poses, gears for a required output, and searches for dimensions.
//!
//! It may use everything below it, and judges what it found by the checks of the analysis alone. It draws nothing and writes
//! no file.

pub mod machine;
pub mod optimise;
pub mod reverse;
