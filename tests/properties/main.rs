//! What holds for every design.

mod design;
mod pitch;
