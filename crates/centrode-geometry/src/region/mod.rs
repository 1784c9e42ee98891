//! Closed outlines and the regions they enclose.
//!
//! Reading order: [`outline`], [`position`] (a point of an outline), [`placement`] (move, circle, polygon), [`moments`] (area,
//! length, centroid), [`extent`], [`containment`]; then [`hull`] and [`rounded_polygon`] (new outlines), [`convex`] (pieces), the
//! test [`self_crossing`], and [`loops`], which cuts the loops off a chain that crosses itself; [`bound_tree`] finds near items,
//! with bounds such as a [`disc`]. Uses `numeric` and `curve`.

mod bound_tree;
mod containment;
mod convex;
mod disc;
mod extent;
mod hull;
mod loops;
mod moments;
mod outline;
mod placement;
mod position;
mod rounded_polygon;
mod self_crossing;

pub use bound_tree::{BoundTree, Run};
pub use convex::{ConvexPieces, convex_hull, convex_pieces};
pub use disc::Disc;
pub use loops::{LoopError, without_loops};
pub use moments::AreaMoments;
pub use outline::{OpenOutline, Outline};
pub(crate) use position::{CORNER, Position};
pub use rounded_polygon::ShortSide;
pub use self_crossing::Crossing;
