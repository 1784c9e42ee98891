use crate::Wall;

/// A wall of one turn of the groove, at one level below the surface: a height as a function of the angle round the shaft, because
/// the groove never runs back in this angle.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(in crate::solid) struct Edge {
    /// Turn of the cycle.
    pub(in crate::solid) turn: usize,
    pub(in crate::solid) wall: Wall,
    /// Index into the levels of the plan.
    pub(in crate::solid) level: usize,
}
