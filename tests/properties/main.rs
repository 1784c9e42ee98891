//! What holds for every design.

mod design;
mod mesh;
mod pitch;
mod shaft;
mod sheet;
mod teeth;
