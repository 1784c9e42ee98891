//! Closed outlines and the regions they enclose.
//!
//! Reading order:
//!
//! 1. [`outline`], and [`position`] (a point of an outline).
//! 2. [`placement`]: move, circle, polygon.
//! 3. [`moments`] (area, length, centroid), [`extent`] and [`containment`].
//! 4. [`hull`] and [`rounded_polygon`] (new outlines), and [`convex`] (convex pieces).
//! 5. [`self_crossing`]: a test.
//! 6. [`loops`]: removal of loops from a chain that crosses itself.
//! 7. [`bound_tree`]: search for items near each other by bounds such as a [`disc`].
//!
//! Uses `numeric` and `curve`.

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
