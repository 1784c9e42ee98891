//! The body of a transplanting arm: housing, clamp, push rod, spring.

mod contour;
mod parts;
mod spec;

pub use parts::{ArmBody, ArmError, ArmPart};
pub use spec::{ArmBodySpec, ClampSpec, HousingSpec, PushRodSpec, SpringSpec};

#[cfg(test)]
mod tests;
