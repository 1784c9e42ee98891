//! Spiral shaft and moving box, and the motion of the box that both have.

mod box_drive;
mod moving_box;
mod spiral_shaft;

pub(crate) use box_drive::BoxDrive;
pub(crate) use moving_box::MovingBox;
pub(crate) use spiral_shaft::SpiralShaft;
