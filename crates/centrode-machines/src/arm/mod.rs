//! The body of a transplanting arm: housing, clamp, push rod, spring.

mod contour;
mod parts;
mod spec;
mod usual;

pub use parts::{ArmBody, ArmError, ArmPart};
pub use spec::{ArmBodySpec, ClampSpec, HousingSpec, PushRodSpec, SpringSpec};
pub use usual::UsualArm;

#[cfg(test)]
mod tests;
