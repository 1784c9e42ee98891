//! What holds for every design.

mod design;
mod linkage;
mod mesh;
mod pitch;
mod shaft;
mod sheet;
mod teeth;
