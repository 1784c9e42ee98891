//! Motions of bodies as laws of the input.

pub(super) mod drive;
pub(super) mod input_formula;
pub(super) mod law;
pub(super) mod table;
