//! What holds for every design.

mod design;
mod mesh;
mod pitch;
mod sheet;
mod teeth;
