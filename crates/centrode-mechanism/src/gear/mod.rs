//! Non-circular gears.

pub mod design;
pub mod pitch;
